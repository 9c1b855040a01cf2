"""Commands as robots are told them: in short and through an arm, with a side that something owns."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain, steps

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("Wipe plate with blue towel", ["plate", "towel"]),
        ("scrub sink with sponge", ["sink", "sponge"]),
        ("stir pot with spoon", ["pot", "spoon"]),
        ("Wipe whiteboard with sponge", ["cardboard sheet", "sponge"]),
        ("Pick up sponge and wipe shoe", ["sponge", "shoe"]),
    ],
)
def test_the_tool_of_a_deed_told_in_short_lies_by_itself(prompt: str, nouns: list[str]):
    plan = PLANNER.plan(prompt)
    assert ([obj.noun for obj in plan.objects], plan.relations) == (nouns, ())
    assert any("no task does that" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("dump pear into sink", "place:pear:sink"),
        ("return book to shelf", "place:book:shelf"),
        ("get pear from shelf", "pick:pear"),
        ("find the pear and place on the plate", "place:pear:plate"),
        ("choose the pear and put in the bowl", "place:pear:bowl"),
    ],
)
def test_a_command_in_short_is_a_task(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


@pytest.mark.parametrize("prompt", ["wash basin next to a mirror", "throw pillow on a sofa", "dump truck on a table"])
def test_what_is_called_by_a_deed_is_no_command(prompt: str):
    plan = PLANNER.plan(prompt)
    assert (len(plan.objects), len(plan.relations), plan.task, plan.notes) == (2, 1, None, ())


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Have the left arm lift the pear and put it on the tray.", "place:pear:tray"),
        ("Let the right arm pick the pear up from the tray.", "pick:pear"),
        ("Have the robot put the pear in the bowl.", "place:pear:bowl"),
        ("Ask the robot to put the pear in the bowl.", "place:pear:bowl"),
        ("Move your right hand to pick the pear up from the tray.", "pick:pear"),
        ("The left arm picks up the pear.", "pick:pear"),
        ("Right arm picks up the pear and places it on the tray.", "place:pear:tray"),
        ("Right arm: grab the pear and place it on the tray.", "place:pear:tray"),
        ("Left arm - reach out and take the pear on the tray.", "pick:pear"),
    ],
)
def test_who_is_told_is_no_object(prompt: str, task: str):
    plan = PLANNER.plan(prompt)
    assert {obj.noun for obj in plan.objects} <= {"pear", "tray", "bowl"}
    assert plan.task == task
    arms = [f"{side} {limb}" for side in ("left", "right") for limb in ("arm", "hand") if f"{side} {limb}" in
            prompt.lower()]  # fmt: skip
    assert not [note for note in plan.notes if not any(arm in note for arm in arms)]
    assert bool(plan.notes) == bool(arms)


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("The robot is next to a box", ["robot", "box"]),
        ("The left arm of the sofa holds a remote control", ["sofa", "remote control"]),
        ("A teddy bear sits on a shelf. Its left arm holds a ball.", ["teddy bear", "shelf", "ball"]),
    ],
)
def test_an_arm_that_is_described_is_told_nothing(prompt: str, nouns: list[str]):
    assert sorted(obj.noun for obj in PLANNER.plan(prompt).objects) == sorted(nouns)


@pytest.mark.parametrize(
    ("prompt", "task", "notes"),
    [
        ("Set the pear on the bottle's right side", "beside:pear:right_of:bottle", ()),
        ("Set the pear on the bottle with a soft golden cap's right side", "beside:pear:right_of:bottle",
         ('not in the scene: "cap"',)),
        ("Put the pear to the red bottle's left", "beside:pear:left_of:red bottle", ()),
        ("Move the pear to the bottle's right side", "beside:pear:right_of:bottle", ()),
    ],
)  # fmt: skip
def test_a_side_that_something_owns_is_beside_it(prompt: str, task: str, notes: tuple[str, ...]):
    plan = PLANNER.plan(prompt)
    assert {obj.noun for obj in plan.objects} == {"pear", "bottle"}
    assert (plan.relations, plan.task, plan.notes) == ((), task, notes)


def test_a_second_goal_is_where_the_same_thing_goes():
    plan = PLANNER.plan("Put the pear on the green plate and then the blue plate.")
    assert (plan.task, steps(plan)) == (None, ["place:pear:green plate", "place:pear:blue plate"])
    plan = PLANNER.plan("Put the pear on the plate and then the plum.")
    assert plan.task == chain("place:pear:plate", "place:plum:plate")


@pytest.mark.parametrize("pair", [("cup", "bowl"), ("red block", "green block")])
def test_what_is_to_be_separated_is_not_on_the_other(pair: tuple[str, str]):
    plan = PLANNER.plan(f"separate the {pair[0]} from the {pair[1]}")
    assert ([obj.name for obj in plan.objects], plan.relations) == (list(pair), ())


@pytest.mark.parametrize("thing", ["rug", "chair"])
def test_what_no_robot_moves_is_named(thing: str):
    plan = PLANNER.plan(f"Put the {thing}, the pear and the plum on the table.")
    assert any(f'that "the {thing}" is moved' in note for note in plan.notes)
    assert plan.task == chain("place:pear:table", "place:plum:table")


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Keep the box on the shelf and put the pear in it.", "place:pear:box"),
    ],
)
def test_what_is_kept_is_what_is_spoken_of(prompt: str, task: str):
    plan = PLANNER.plan(prompt)
    assert (len(plan.relations), plan.task) == (1, task)


@pytest.mark.parametrize("near", ["near right", "near left", "front right"])
def test_a_corner_that_is_near_is_one_of_the_table(near: str):
    assert PLANNER.plan(f"move the pear to the {near} corner of the table").task == "place:pear:table"


def test_a_part_without_articles_is_no_object_of_its_own():
    plan = PLANNER.plan("pick orange can from middle shelf of fridge")
    assert [obj.noun for obj in plan.objects] == ["can", "open fridge"]
    assert [str(relation) for relation in plan.relations] == ["orange can in fridge"]


def test_a_second_command_with_a_verb_of_no_task_is_named():
    plan = PLANNER.plan("Put the ring on the peg. Finally restore it to its place.")
    assert plan.task == "place:ring:peg"
    assert any("restore it to its place" in note for note in plan.notes)


@pytest.mark.parametrize("drink", ["red bull", "pepsi can", "sprite", "7up can"])
def test_drinks_by_their_brand(drink: str):
    plan = PLANNER.plan(f"Put the {drink} on the tray.")
    assert ([obj.noun for obj in plan.objects], plan.notes) == (["soda can", "tray"], ())


def test_a_red_bull_among_cows_is_named():
    assert any('"red bull"' in note for note in PLANNER.plan("A red bull stands next to a cow.").notes)


@pytest.mark.parametrize(
    "talk",
    [
        "Today is a busy day",
        "Dinner is ready",
        "Guests are coming",
        "It is time for dinner",
        "Today is my partner's birthday",
    ],
)
def test_talk_before_a_command_is_named_and_makes_nothing(talk: str):
    plan = PLANNER.plan(f"{talk}. Put the pear in the sink.")
    assert ([obj.noun for obj in plan.objects], plan.task) == (["pear", "sink"], "place:pear:sink")
    assert plan.notes == (f'not modelled: "{talk}"',)


def test_what_is_said_to_be_there_is_no_talk():
    assert [obj.noun for obj in PLANNER.plan("It is a red box. Put the pear in the box.").objects] == [
        "storage box",
        "pear",
    ]


@pytest.mark.parametrize(
    ("name", "noun"), [("dinosaur figure", "dinosaur"), ("horse figure", "horse"), ("cat replica", "cat")]
)
def test_a_figure_of_a_known_thing_is_made_as_that(name: str, noun: str):
    plan = PLANNER.plan(f"Put the {name} in the bin.")
    assert [obj.noun for obj in plan.objects] == [noun, "bin"]
    assert plan.notes == (f'"{name}" is made as a "{noun}"',)


@pytest.mark.parametrize("looks", ["printed text", "golden laces", "white lettering"])
def test_what_is_written_or_laced_on_a_thing_is_named(looks: str):
    plan = PLANNER.plan(f"Pick up the boot with {looks}.")
    assert ([obj.noun for obj in plan.objects], plan.task) == (["boot"], "pick:boot")
    assert any(looks in note for note in plan.notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "Put the small bottle and the tall bottle on the tray",
        "Put the green bottle and the cylindrical bottle on the tray",
        "Put the red bottle and the bottle with a lid on the tray",
        "Put the green plastic bottle and the plastic drink bottle on the tray",
        "Put the green bottle with printed text and the cylindrical bottle on the tray",
        "The large red bottle, the small bottle and the shiny bottle are on the tray",
        "A mug is on the red tray and the large tray is under a lamp",
    ],
)
def test_what_is_listed_by_other_looks_is_another(prompt: str):
    nouns = [obj.noun for obj in PLANNER.plan(prompt).objects]
    assert nouns.count("bottle") == (3 if "shiny" in prompt else 2 if "bottle" in prompt else 0)
    assert nouns.count("tray") == (1 if "bottle" in prompt else 2)


def test_what_is_listed_again_is_the_same():
    plan = PLANNER.plan("Put the cup on the tray and the tray on the table.")
    assert [obj.noun for obj in plan.objects] == ["cup", "tray", "table"]


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("carry a kettle to a lamp", "beside:kettle:next_to:lamp"),
        ("Bring the pear to the plum", "beside:pear:next_to:plum"),
    ],
)
def test_what_cannot_carry_a_thing_is_what_it_is_put_next_to(prompt: str, task: str):
    plan = PLANNER.plan(prompt)
    assert (plan.relations, plan.task, plan.notes) == ((), task, ())


def test_what_is_below_a_thing_is_not_put_on_it():
    plan = PLANNER.plan("put the star to the bottom of the red cube")
    assert (plan.relations, plan.task) == ((), None)
    assert any("no task does that" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Picks up the pear and places it on the tray", "place:pear:tray"),
        ("Places the pear on the tray", "place:pear:tray"),
        ("Bring the pear to the tray", "place:pear:tray"),
        ("Move the pear to the towel", "place:pear:towel"),
        ("Move the pear to the chair", "place:pear:chair"),
    ],
)
def test_what_can_carry_a_thing_is_what_it_is_put_on(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


@pytest.mark.parametrize(
    "where", ["sitting further away", "that is farther away", "located further", "positioned farthest"]
)
def test_what_is_told_by_its_distance_is_not_on_what_it_is_far_from(where: str):
    plan = PLANNER.plan(f"Pick up the pear {where} from the plum.")
    assert (plan.relations, plan.task) == ((), "pick:pear")
    assert any(f"{where.split()[-1]} from the plum" in note for note in plan.notes)


def test_what_is_far_from_a_thing_is_there_beside_it():
    plan = PLANNER.plan("Pick up the pear far away from the plum.")
    assert ([one.kind for one in plan.arrangements], plan.relations, plan.task) == (["far_from"], (), "pick:pear")
    plan = PLANNER.plan("Take the pear away from the bowl.")
    assert ([str(relation) for relation in plan.relations], plan.task) == (["pear in bowl"], "pick:pear")
