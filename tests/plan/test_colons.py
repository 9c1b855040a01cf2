"""What stands behind the colon of an instruction: the things it speaks of, or where each of them is to go."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


def nouns(plan: ScenePlan) -> list[str]:
    return sorted(obj.noun for obj in plan.objects)


def relations(plan: ScenePlan) -> set[str]:
    return {str(relation) for relation in plan.relations}


def others(plan: ScenePlan) -> list[str]:
    """Notes but those on how many are assumed, and on wording that was not tried."""
    known = ("assumed.", "worded like nothing", "is made as a")
    return [note for note in plan.notes if not any(word in note for word in known)]


@pytest.mark.parametrize(
    ("prompt", "made", "there", "asked"),
    [
        ("Put the fruit in the bowl: a fig and two limes.", ["bowl", "fig", "lime", "lime"], set[str](),
         ["place:fig:bowl", "place:lime 1:bowl", "place:lime 2:bowl"]),
        ("Tidy the toys into the crate - the doll and a ball.", ["ball", "crate", "doll"], set[str](),
         ["place:doll:crate", "place:ball:crate"]),
        ("Gather the tools from the bench and drop them in the bucket: the saw and the chisel.",
         ["bench", "bucket", "chisel", "saw"], {"saw on bench", "chisel on bench"},
         ["place:saw:bucket", "place:chisel:bucket"]),
        ("Place the following items on the tray: a teapot and a spoon.", ["spoon", "teapot", "tray"], set[str](),
         ["place:teapot:tray", "place:spoon:tray"]),
        ("Put everything on the tray: the teapot and the spoon.", ["spoon", "teapot", "tray"], set[str](),
         ["place:teapot:tray", "place:spoon:tray"]),
        ("Put these on the shelf: a globe and a clock.", ["clock", "globe", "shelf"], set[str](),
         ["place:globe:shelf", "place:clock:shelf"]),
        ("Put the three vegetables in the pot: a potato, a carrot and an onion.", ["carrot", "onion", "pot", "potato"],
         set[str](), ["place:potato:pot", "place:carrot:pot", "place:onion:pot"]),
        ("Put the pots on the stove: the large one first, then the small one.", ["pot", "pot", "stove"], set[str](),
         ["place:large pot:stove", "place:small pot:stove"]),
    ],
)  # fmt: skip
def test_what_is_listed_is_what_the_instruction_speaks_of(
    prompt: str, made: list[str], there: set[str], asked: list[str]
):
    plan = PLANNER.plan(prompt)
    assert (nouns(plan), relations(plan), plan.task) == (made, there, chain(*asked))
    assert not [note for note in others(plan) if "no task does that" not in note]


def test_what_is_listed_behind_some_of_a_kind_is_the_scene_to_make():
    plan = PLANNER.plan("Put two fruits on the tray: a fig and a lime.")
    assert (nouns(plan), relations(plan)) == (["fig", "lime", "tray"], {"fig on tray", "lime on tray"})
    assert plan.task is None


def test_a_list_in_an_order_is_no_list_of_what_is_moved():
    plan = PLANNER.plan("Arrange the following on the bench in order of weight: a vase, a cup, a spoon.")
    assert any("following" in note for note in plan.notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "Put an egg in every cup: three eggs, three cups.",
        "Put an egg in every cup. There are three cups and three eggs.",
        "There are three eggs and three cups. Put one egg in each cup.",
        "There are three eggs. Put one egg in each of the three cups.",
        "Place an egg in each cup - three cups and three eggs.",
    ],
)
def test_as_many_as_are_told_of_are_moved_one_to_each(prompt: str):
    plan = PLANNER.plan(prompt)
    assert (nouns(plan), relations(plan)) == (["cup"] * 3 + ["egg"] * 3, set[str]())
    assert plan.task == chain(*(f"place:egg {n}:cup {n}" for n in (1, 2, 3)))
    assert not others(plan)


@pytest.mark.parametrize(
    ("prompt", "made", "there", "asked", "heading"),
    [
        ("Tidy up: doll in the crate, globe on the shelf.", ["crate", "doll", "globe", "shelf"], set[str](),
         ["place:doll:crate", "place:globe:shelf"], "Tidy up"),
        ("Separate the saw from the drill: saw in the crate, drill on the bench.", ["bench", "crate", "drill", "saw"],
         set[str](), ["place:saw:crate", "place:drill:bench"], "Separate the saw from the drill"),
        ("Put away the toys: put the doll on the bed and the ball in the bucket.", ["ball", "bed", "bucket", "doll"],
         set[str](), ["place:doll:bed", "place:ball:bucket"], "Put away the toys"),
        ("Clear the dishes from the table: cup in the sink, vase on the shelf.",
         ["cup", "shelf", "sink", "table", "vase"], {"cup on table", "vase on table"},
         ["place:cup:sink", "place:vase:shelf"], "Clear the dishes"),
        ("Could you clean up: the fig and the lime in the bowl, the vase on the tray?",
         ["bowl", "fig", "lime", "tray", "vase"], set[str](), ["place:fig:bowl", "place:lime:bowl", "place:vase:tray"],
         "Could you clean up"),
    ],
)  # fmt: skip
def test_where_things_are_to_go_is_asked_and_not_there(
    prompt: str, made: list[str], there: set[str], asked: list[str], heading: str
):
    plan = PLANNER.plan(prompt)
    assert (nouns(plan), relations(plan), plan.task) == (made, there, chain(*asked))
    assert others(plan) == [f'not modelled: "{heading}"']


def test_a_heading_that_names_a_further_thing_has_it_there():
    plan = PLANNER.plan("Lay the desk: put the vase behind the lamp, the cup left of the vase and the pen beside it.")
    assert (nouns(plan), relations(plan)) == (["cup", "desk", "lamp", "pen", "vase"], set[str]())
    assert plan.task == chain("beside:vase:behind:lamp", "beside:cup:left_of:vase", "beside:pen:next_to:cup")
    assert others(plan) == ['not modelled: "Lay the desk": no task does that.']


def test_where_things_are_told_behind_a_colon_is_where_they_are():
    plan = PLANNER.plan("Put the vases in the sink: they are on the bench.")
    assert relations(plan) == {f"vase {n} on bench" for n in (1, 2, 3)}
    assert plan.task == chain(*(f"place:vase {n}:sink" for n in (1, 2, 3)))


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("Create a scene: a ball in a crate, a vase on a tray.", {"ball in crate", "vase on tray"}),
        ("On the bench: a vase on a tray, a ball in a crate.",
         {"tray on bench", "vase on tray", "crate on bench", "ball in crate"}),
    ],
)  # fmt: skip
def test_a_scene_behind_a_colon_stays_one(prompt: str, there: set[str]):
    plan = PLANNER.plan(prompt)
    assert (relations(plan), plan.task) == (there, None)
