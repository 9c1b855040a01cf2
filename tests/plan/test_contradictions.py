"""What a prompt asks for and no scene can be is refused, and what is said of a side or of "off" is never dropped."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "named"),
    [
        ("A bowl is left of the plate. The bowl is right of the plate.", ("to the left of", "to the right of")),
        ("The bowl is left of the plate. The plate is left of the bowl.", ('"The bowl"', '"the plate"')),
        ("A mug in front of the box and behind the box.", ("behind", '"the box"')),
        ("Put the bowl on the bowl.", ('"the bowl" and "the bowl"',)),
        ("Put the robot on the table.", ('"the robot"', '"the table"')),
    ],
)
def test_a_contradiction_is_refused_with_what_is_said(prompt, named):
    with pytest.raises(PromptError) as refused:
        PLANNER.plan(prompt)
    assert all(each in str(refused.value) for each in named)


@pytest.mark.parametrize(
    "prompt",
    [
        "A bowl is left of the plate. The plate is right of the bowl.",
        "A bowl is next to the plate. The plate is next to the bowl.",
        "Put the red bowl on the blue bowl.",
        "Move the toy robot to the box.",
        "A mug is left of a mug.",
    ],
)
def test_what_can_be_is_not_refused(prompt):
    assert len(PLANNER.plan(prompt).objects) == 2


@pytest.mark.parametrize(
    ("prompt", "off"),
    [
        ("The handbag is off the couch.", "off the couch"),
        ("The book is off the shelf.", "off the shelf"),
        ("The apple rolled off the table.", "off the table"),
    ],
)
def test_what_is_off_something_is_not_on_it(prompt, off):
    plan = PLANNER.plan(prompt)
    assert [rel.kind for rel in plan.relations] == ["next_to"]
    assert any(f'"{off}"' in note for note in plan.notes)


def test_what_is_taken_off_something_is_on_it_before():
    plan = PLANNER.plan("Take the book off the shelf.")
    assert [str(rel) for rel in plan.relations] == ["book on shelf"]
    assert plan.task == "pick:book"


def test_the_side_that_a_task_has_as_its_goal_is_noted():
    plan = PLANNER.plan("Move the jar to the left side of the desk.")
    assert plan.task == "place:jar:desk"
    assert any("to the left side of" in note for note in plan.notes)


def test_the_side_of_what_nothing_is_put_on_is_beside_it():
    plan = PLANNER.plan("Put the jar to the left side of the bowl.")
    assert (plan.task, plan.relations, plan.notes) == ("beside:jar:left_of:bowl", (), ())


def test_each_of_a_list_has_its_own():
    plan = PLANNER.plan("A cookie jar with three cookies, an egg cup with an egg, and a pallet with four boxes")
    assert {rel.parent for rel in plan.relations if rel.child.startswith("cookie ")} == {"cookie jar"}
    assert [str(rel) for rel in plan.relations if "egg" in rel.child] == ["egg in egg cup"]
    assert len(plan.relations) == 8


def test_one_thing_that_becomes_two_is_noted():
    plan = PLANNER.plan("A hammer between two nails, each of them standing on its head.")
    assert 'counted otherwise: "a hammer", of which there are 2' in plan.notes
    plates = PLANNER.plan("Three plates, a cup on each of them, and a fork.")
    assert not any("counted otherwise" in note for note in plates.notes)


def test_a_verb_behind_a_relative_clause_is_noted():
    plan = PLANNER.plan("A mug, half of whose handle has broken off, sits on a pile of three magazines.")
    assert any("on a pile" in note for note in plan.notes) or any(rel.child == "mug" for rel in plan.relations)


def test_names_that_are_plurals_have_no_other():
    assert tell(PLANNER.plan("Three tongs.")) == "Three tongs stand on the ground."


def test_drawers_are_drawers_and_no_more_than_a_cabinet_has():
    assert tell(PLANNER.plan("Three drawers.")) == "A cabinet stands on the ground. Three drawers are in the cabinet."
    assert any('"fourth"' in note for note in PLANNER.plan("Open the fourth drawer.").notes)
