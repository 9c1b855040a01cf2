"""What a sentence denies is not made, what a word stands for is not lost, and a task moves what its verb named."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


def nouns(plan: ScenePlan) -> list[str]:
    return [obj.noun for obj in plan.objects]


def edges(plan: ScenePlan) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


@pytest.mark.parametrize(
    "prompt",
    ["A basket with no plums or limes.", "There is a basket but no plum or lime.", "A basket without limes or plums."],
)
def test_all_that_is_denied_is_left_out(prompt):
    assert nouns(PLANNER.plan(prompt)) == ["basket"]


def test_what_is_without_something_stands_where_it_is_said():
    assert ("mug", "on", "shelf") in edges(PLANNER.plan("A mug without a spoon on a shelf."))


def test_things_without_a_name_are_noted():
    assert any("five things" in note for note in PLANNER.plan("A crate with five things.").notes)


@pytest.mark.parametrize("carrier", ["cracker box", "tray", "stack of plates"])
def test_it_is_what_was_picked(carrier):
    plan = PLANNER.plan(f"Pick up the yellow bowl on the {carrier} and put it on the stove.")
    assert plan.task == "place:yellow bowl:stove"


def test_what_is_taken_away_from_a_table_is_on_it_before():
    plan = PLANNER.plan("Take the jar away from the table.")
    assert edges(plan) == {("jar", "on", "table")}
    assert plan.task == "pick:jar"


def test_a_drawer_is_no_shelf():
    plan = PLANNER.plan("Put forks in the drawer and cups on the shelf.")
    assert [obj.name for obj in plan.objects if "fork" not in obj.name and "cup" not in obj.name] == [
        "cabinet",
        "drawer",
        "shelf",
    ]


@pytest.mark.parametrize(
    "prompt",
    [
        "A tray. On it, from left to right: a cup, a jar and a spoon.",
        "There is a tray. On it stand, in a row, a cup, a jar and a spoon.",
        "A tray with, from left to right, a cup, a jar and a spoon on it.",
    ],
)
def test_an_order_that_is_set_off_is_of_what_is_listed(prompt):
    plan = PLANNER.plan(prompt)
    assert [one.objects for one in plan.arrangements if one.kind == "row"] == [("cup", "jar", "spoon")]
    assert {(name, "on", "tray") for name in ("cup", "jar", "spoon")} <= edges(plan)


def test_a_smaller_one_is_another():
    plan = PLANNER.plan("A suitcase stands next to the sofa, and a smaller one lies on the wardrobe.")
    assert nouns(plan).count("suitcase") == 2
    assert not any(child == "sofa" and kind == "on" for child, kind, _ in edges(plan))


@pytest.mark.parametrize("some", ["one", "the smallest"])
def test_of_which_some_are_told_apart(some):
    plan = PLANNER.plan(f"Three plums, of which {some} is green, lie on a board.")
    assert [obj.colours for obj in plan.objects if obj.noun == "plum"] == [("green",), (), ()]


def test_it_is_coloured_and_the_next_one_is_another():
    plan = PLANNER.plan("The jar is on the shelf. It is red. Next to it is a blue one.")
    assert [(obj.noun, obj.colours) for obj in plan.objects if obj.noun == "jar"] == [
        ("jar", ("red",)),
        ("jar", ("blue",)),
    ]


def test_both_sides_of_one_landmark():
    plan = PLANNER.plan("A cup left and a jar right of a plate.")
    assert {("cup", "left_of", "plate"), ("jar", "right_of", "plate")} <= edges(plan)


@pytest.mark.parametrize(
    ("prompt", "said"), [("A fridge with two bottles.", "inside"), ("A piece of pizza on a plate.", "pizza")]
)
def test_what_is_made_otherwise_is_noted(prompt, said):
    assert any(said in note for note in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize("holder", ["egg carton", "test tube rack"])
def test_what_a_rack_has_is_in_it(holder):
    plan = PLANNER.plan(f"A {holder} with two test tubes.")
    assert [rel.kind for rel in plan.relations] == ["in", "in"]


def test_one_upon_the_other():
    assert [rel.kind for rel in PLANNER.plan("Two cubes, one on the other.").relations] == ["on"]


def test_one_and_the_other_carrier():
    plan = PLANNER.plan("A hat lies on one chair and a bag on the other.")
    assert nouns(plan).count("chair") == 2
    assert len({rel.parent for rel in plan.relations if rel.supports}) == 2


def test_the_mugs_are_all_mugs():
    plan = PLANNER.plan("Three red mugs and two blue mugs; the mugs are on a tray.")
    assert sum(rel.parent == "tray" for rel in plan.relations) == 5


def test_each_of_two_kinds():
    plan = PLANNER.plan("Two mugs and two bowls, each with a spoon in it.")
    assert nouns(plan).count("spoon") == 4


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        ("The jar on the left holds pears, the jar on the right plums.", "are read as one"),
        ("A tray lies with its bowl in the box.", "a thing of its own"),
        ("A plate of pasta stands next to a fork, with a glass in the background.", "in the background"),
        ("A vase with flowers, one of which lies beside it.", "one of which"),
        ("Make a sandwich: bread, cheese, bread.", "bread"),
        ("The third book from the bottom of a stack of five books is red.", "counted otherwise"),
        ("Two dogs on the left and right, one on its bed.", "bed"),
        ("A basket on each of the two chairs, with a plum in one and a fig in the other.", "counted otherwise"),
        ("Two cups with saucers and a teapot on a tray.", '"a tray" on "saucers"'),
        ("Move the plate to the other side of the bowl.", "side"),
        ("Small wooden jars and cups on a table.", '"wooden" is read as said of "jars"'),
    ],
)
def test_what_the_plan_has_otherwise_is_noted(prompt, said):
    assert any(said in note for note in PLANNER.plan(prompt).notes)


def test_one_on_each_is_one_of_those_named():
    plan = PLANNER.plan("Three bowls, one on each of three trays.")
    assert nouns(plan).count("bowl") == 3
    assert len({rel.parent for rel in plan.relations}) == 3


def test_all_stand_around_what_one_of_them_does():
    plan = PLANNER.plan("One of the four chairs around the table has a hat on it.")
    assert sum(rel.kind == "around" for rel in plan.relations) == 4


def test_the_second_thing_of_an_instruction_has_its_own_goal():
    plan = PLANNER.plan("Put the jam jar to the right of the plate and the red cup on the plate.")
    assert plan.task == chain("beside:jam jar:right_of:plate", "place:red cup:plate")
    assert not plan.relations


def test_what_is_nearest_is_next_to_and_what_is_furthest_is_noted():
    assert edges(PLANNER.plan("The cup nearest to the plate is red.")) == {("red cup", "next_to", "plate")}
    plan = PLANNER.plan("Pick up the can that is furthest from the robot.")
    assert nouns(plan) == ["can"]
    assert any("furthest" in note for note in plan.notes)


def test_a_mouse_beside_a_computer_mouse_is_an_animal():
    assert nouns(PLANNER.plan("A mouse sits next to a computer mouse.")) == ["mouse", "computer mouse"]


@pytest.mark.parametrize(
    ("prompt", "expected", "said"),
    [
        ('A cup with the word "pepper" stands on a box labelled "apples".', ["cup", "box"], "with the word pepper"),
        ("A jar with a label saying 'salt' beside a spoon.", ["jar", "spoon"], "salt"),
        ('Put the jar that says "honey" on the shelf.', ["jar", "shelf"], "that says honey"),
    ],
)
def test_what_is_written_on_a_thing_is_no_object(prompt, expected, said):
    plan = PLANNER.plan(prompt)
    assert nouns(plan) == expected
    assert any(said in note for note in plan.notes)


def test_how_it_is_to_be_put_down_is_not_said_of_where():
    plan = PLANNER.plan("Pick up the cup and place it upside down in the crate.")
    assert plan.task == "place:cup:crate"
    assert not plan.postures
    assert any("upside down" in note for note in plan.notes)


def test_it_is_never_the_place_from_which_something_unknown_was_picked():
    with pytest.raises(PromptError, match="names no object of the scene"):
        PLANNER.plan("Pick the item from the crate and place it on the plate.")


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        ("Two green cubes and a yellow cube are stacked.", '"stacked" of all'),
        ("Three jars are in a row on the desk with the blue one in the middle.", "at the end of the row"),
        ("A blue cube and a red cube are stacked.", None),
        ("Two plates and three bowls are stacked on a shelf.", None),
        ("Three jars are in a row in the middle of the table.", None),
    ],
)
def test_what_is_left_out_of_a_stack_or_of_the_middle_of_a_row_is_noted(prompt, said):
    notes = [note for note in PLANNER.plan(prompt).notes if "not as said" in note]
    assert any(said in note for note in notes) if said else not notes


def test_a_note_names_everything_that_is_not_arranged():
    notes = PLANNER.plan("The jar and the cup are inside the suitcase.").notes
    assert any('"The jar" and "the cup"' in note for note in notes)
