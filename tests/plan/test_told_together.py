"""Plain sentences in which "they" are several, two places stand before a thing, or more than one thing is moved."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


def _relations(plan: ScenePlan) -> set[str]:
    return {str(relation) for relation in plan.relations}


@pytest.mark.parametrize(
    ("prompt", "tasks"),
    [
        ("A jar and a mug are on the desk. Put them in the box.", ["place:jar:box", "place:mug:box"]),
        ("A jar and a mug are on the desk. Put both in the box.", ["place:jar:box", "place:mug:box"]),
        ("A jar is on the desk. A mug is on the shelf. Move them to the box.", ["place:jar:box", "place:mug:box"]),
        ("A jar, a mug and a can are on the desk. Put all three in the box.",
         ["place:jar:box", "place:mug:box", "place:can:box"]),
        ("Pick up the jar. Pick up the mug. Put them in the box.", ["place:jar:box", "place:mug:box"]),
        ("Put the red mug on the plate and the blue one in the box.",
         ["place:red mug:plate", "place:blue mug:box"]),
        ("There are two mugs on the desk. Put one in the box and the other on the plate.",
         ["place:mug 1:box", "place:mug 2:plate"]),
        ("Put the jar in the box, then the mug, then the can.", ["place:jar:box", "place:mug:box", "place:can:box"]),
        ("Put the jar in the box, and also the mug.", ["place:jar:box", "place:mug:box"]),
        ("Put the three mugs on the three plates.",
         ["place:mug 1:plate 1", "place:mug 2:plate 2", "place:mug 3:plate 3"]),
        ("Put the jar in the box and the mug as well.", ["place:jar:box", "place:mug:box"]),
        ("Take the jar to the desk.", ["place:jar:desk"]),
        ("Take the jar next to the clock.", ["pick:jar"]),
        ("A jar and a mug are on the desk. Put everything in the box.", ["place:jar:box", "place:mug:box"]),
        ("A jar is on the desk. A mug is on the shelf. Move everything from the desk to the box.", ["place:jar:box"]),
        ("Put the mug on the lower rack of the dishwasher.", ["place:mug:dishwasher"]),
        ("Get the jar from the shelf and take it to the desk.", ["place:jar:desk"]),
        ("Take the jar from the shelf.", ["pick:jar"]),
    ],
)  # fmt: skip
def test_everything_that_is_to_be_moved_has_its_task(prompt: str, tasks: list[str]):
    plan = PLANNER.plan(prompt)
    assert plan.task == (tasks[0] if len(tasks) == 1 else chain(*tasks))
    moved = {task.split(":")[1] for task in tasks}
    goals = {task.split(":")[2] for task in tasks if task.count(":") == 2}
    assert not any(relation.child in moved and relation.parent in goals for relation in plan.relations)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A jar and a mug are on the desk. A ruler is next to them.",
         {"jar on desk", "mug on desk", "ruler on desk", "ruler next_to jar", "ruler next_to mug"}),
        ("A crate and a basket are on a bench. Each contains a lemon.",
         {"crate on bench", "basket on bench", "lemon 1 in crate", "lemon 2 in basket"}),
        ("A red crate and a blue crate are on a bench. The red crate is on the left.",
         {"red crate on bench", "blue crate on bench", "red crate left_of blue crate"}),
        ("There is a jar. There is a mug. They stand on a desk.", {"jar on desk", "mug on desk"}),
        ("A jar and a can are on a shelf. They are next to each other.",
         {"jar on shelf", "can on shelf", "can next_to jar"}),
        ("A crate and a basket stand side by side. Both contain a lemon.",
         {"basket next_to crate", "lemon 1 in crate", "lemon 2 in basket"}),
        ("Two crates are on the cart. They are stacked.", {"crate 1 on cart", "crate 2 on crate 1"}),
        ("On the desk next to the clock is a jar.", {"clock on desk", "jar on desk", "jar next_to clock"}),
        ("On the desk, behind the clock, stands a jar.", {"clock on desk", "jar on desk", "jar behind clock"}),
        ("On the shelf to the right of the radio there is a jar.",
         {"radio on shelf", "jar on shelf", "jar right_of radio"}),
        ("On top of the crate, next to the ball, is a jar.", {"ball on crate", "jar on crate", "jar next_to ball"}),
        ("A jar and a can stand on a desk.", {"jar on desk", "can on desk"}),
        ("A jar is on the desk next to the clock.", {"clock on desk", "jar on desk", "jar next_to clock"}),
        ("On the rug next to the bed stands a chair.", {"rug next_to bed", "chair on rug"}),
        ("A plate with a muffin and a mug beside it.", {"muffin on plate", "mug next_to plate"}),
        ("A vase with roses and a clock next to it.", {"rose 1 in vase", "rose 2 in vase", "rose 3 in vase",
                                                       "clock next_to vase"}),
        ("A plate with a fork and a knife beside it.", {"fork next_to plate", "knife next_to plate"}),
        ("The red crate holds a ball, the blue crate is empty.", {"ball in red crate"}),
        ("A shelf on which there is a box on which there is a clock.", {"box on shelf", "clock on box"}),
        ("A clock is to the left of the bed and a chair to the right of it.",
         {"clock left_of bed", "chair right_of bed"}),
        ("The left jar is red, the middle jar is white and the right jar is blue.",
         {"white jar right_of red jar", "blue jar right_of red jar", "blue jar right_of white jar"}),
        ("A crate on which a clock stands is on the bench.", {"clock on crate", "crate on bench"}),
        ("Two stools facing each other with a crate in between.", {"stool 1 left_of crate", "stool 2 right_of crate"}),
        ("A bench with four stools, two on each side.",
         {"stool 1 left_of bench", "stool 2 right_of bench", "stool 3 left_of bench", "stool 4 right_of bench"}),
        ("A blue jar stands to the left of a red jar, and a ball lies between them.",
         {"blue jar left_of red jar", "blue jar left_of ball", "red jar right_of ball"}),
        ("A burger with fries on a plate.", {"burger on plate", "fries on plate"}),
    ],
)  # fmt: skip
def test_plain_places_are_read_without_a_note(prompt: str, relations: set[str]):
    plan = PLANNER.plan(prompt)
    assert _relations(plan) == relations
    told = [note for note in plan.notes if "assumed" not in note and "empty" not in note and "not said" not in note]
    assert not told


@pytest.mark.parametrize(
    ("prompt", "described"),
    [
        ("A jar and a mug are on the desk. They are green.", ["green jar", "green mug", "desk"]),
        ("A jar and a mug are on the desk. They are both green.", ["green jar", "green mug", "desk"]),
        ("A jar and a mug are on the desk. Both are green.", ["green jar", "green mug", "desk"]),
        ("A desk has two chairs. They are green.", ["desk", "green chair 1", "green chair 2"]),
        ("A jar is on the desk. It is green.", ["green jar", "desk"]),
    ],
)
def test_a_colour_of_them_is_of_all(prompt: str, described: list[str]):
    assert sorted(obj.name for obj in PLANNER.plan(prompt).objects) == sorted(described)


@pytest.mark.parametrize(
    "prompt",
    [
        "A jar and a mug are on the desk. They are upside down.",
        "Two mugs in a row, both upside down.",
        "Two mugs, all upside down, stand on a desk.",
    ],
)
def test_a_posture_of_all_is_of_every_one(prompt: str):
    plan = PLANNER.plan(prompt)
    assert [one.kind for one in plan.postures] == ["upside_down"] * 2


def test_they_who_can_only_be_one_are_named_in_a_note():
    plan = PLANNER.plan("A tray stands on the desk. They are red.")
    assert any(note.startswith('"they" (word 7) is read as') for note in plan.notes)


@pytest.mark.parametrize("prompt", ["Cover the jar with a plate.", "Swap the jar with the mug.",
                                    "Move everything from the desk to the box."])  # fmt: skip
def test_what_is_only_done_later_or_with_something_is_not_there_before(prompt: str):
    plan = PLANNER.plan(prompt)
    assert not plan.relations
    assert plan.notes


def test_what_follows_a_deed_that_is_left_out_gives_no_relation():
    plan = PLANNER.plan("A dog is trying to play with a cat that is on a sofa.")
    assert _relations(plan) == {"cat on sofa"}
    assert 'not modelled: "trying to play"' in plan.notes


def test_a_place_that_may_be_of_two_things_is_told_for_both():
    plan = PLANNER.plan("On the tray between the two mugs is a spoon.")
    assert plan.otherwise
    assert "The spoon is between the two mugs" in plan.otherwise


def test_a_figure_holds_nothing_and_a_note_says_so():
    plan = PLANNER.plan("A statue holding a cup.")
    assert _relations(plan) == {"cup next_to statue"}
    assert plan.notes == ('not arranged: "A statue" holding "a cup", which is placed next to it',)


@pytest.mark.parametrize(
    ("prompt", "row"),
    [
        ("A jar, a can and a mug stand in a row from right to left.", ("mug", "can", "jar")),
        ("A jar, a can and a mug stand in a row, the jar in the middle.", ("can", "jar", "mug")),
    ],
)
def test_a_row_has_the_order_that_is_said(prompt: str, row: tuple[str, ...]):
    plan = PLANNER.plan(prompt)
    assert [one.objects for one in plan.arrangements if one.kind == "row"] == [row]
    assert _relations(plan) == {f"{one} left_of {two}" for one, two in zip(row, row[1:], strict=False)}


@pytest.mark.parametrize("prompt", ["A desk with four chairs and a vase in the middle.",
                                    "A desk with two plates and a vase in the center."])  # fmt: skip
def test_only_what_is_named_last_is_in_the_middle(prompt: str):
    plan = PLANNER.plan(prompt)
    assert [(one.objects, one.of) for one in plan.arrangements if one.kind == "in_middle"] == [(("vase",), ("desk",))]
    assert not [note for note in plan.notes if "middle" in note or "center" in note]
