"""Instructions that say what is to be moved, and where to, elsewhere than behind their verb."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "relations", "task"),
    [
        ("Take the pear to the counter.", set[str](), "place:pear:counter"),
        ("Get the pear from the basket to the counter.", {"pear in basket"}, "place:pear:counter"),
        ("Lift the pear out of the basket and onto the tray.", {"pear in basket"}, "place:pear:tray"),
        ("Take the basket with the pear in it to the counter.", {"pear in basket"}, "place:basket:counter"),
        ("Unload the pear from the basket onto the tray.", {"pear in basket"}, "place:pear:tray"),
        ("Take the pear from the basket.", {"pear in basket"}, "pick:pear"),
        ("Put the pear back in the basket.", set[str](), "place:pear:basket"),
        ("The pear on the tray should be moved to the basket.", {"pear on tray"}, "place:pear:basket"),
        ("The pear belongs in the basket.", set[str](), "place:pear:basket"),
        ("Leave the pear on the tray and put the plum in the basket.", {"pear on tray"}, "place:plum:basket"),
        ("Put the plum in the basket; leave the pear where it is, on the tray.", {"pear on tray"}, "place:plum:basket"),
        ("Pick up the pear and leave it on the tray.", set[str](), "place:pear:tray"),
        ("Pick up the pear and place it on the tray next to the sofa.", set[str](), "place:pear:tray"),
    ],
)
def test_the_task_and_the_scene_before_it(prompt: str, relations: set[str], task: str):
    plan = PLANNER.plan(prompt)
    assert ({str(relation) for relation in plan.relations}, plan.task) == (relations, task)
    assert not [note for note in plan.notes if note != 'not modelled: "next to the sofa"']


@pytest.mark.parametrize(
    ("prompt", "tasks"),
    [
        ("Put the pear on the tray and then the plum.", ["place:pear:tray", "place:plum:tray"]),
        ("Put the pear on the tray, then the plum, then the lime.",
         ["place:pear:tray", "place:plum:tray", "place:lime:tray"]),
        ("Put the red mug on the tray and the blue one in the basket.",
         ["place:red mug:tray", "place:blue mug:basket"]),
        ("Put one of the two mugs on the tray and the other in the basket.",
         ["place:mug 1:tray", "place:mug 2:basket"]),
        ("Both the pear and the plum belong in the basket.", ["place:pear:basket", "place:plum:basket"]),
    ],
)  # fmt: skip
def test_what_is_said_once_is_done_for_each(prompt: str, tasks: list[str]):
    plan = PLANNER.plan(prompt)
    assert (plan.relations, plan.task, plan.notes) == ((), chain(*tasks), ())


@pytest.mark.parametrize(
    "prompt",
    [
        "Move the pens one by one from the mug to the basket.",
    ],
)
def test_what_is_moved_one_by_one_is_where_it_comes_from(prompt: str):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == {f"pen {at} in mug" for at in (1, 2, 3)}
    assert plan.task == chain(*(f"place:pen {at}:basket" for at in (1, 2, 3)))


def test_what_is_sorted_is_put_where_the_sentence_says():
    plan = PLANNER.plan("Sort the mugs by colour: red ones into the left basket, blue ones into the right basket.")
    assert {str(relation) for relation in plan.relations} == {"basket 2 right_of basket 1"}
    assert any("place:red mug 1:basket 1" in note and "place:blue mug 3:basket 2" in note for note in plan.notes)


def test_the_one_of_what_is_sorted_is_one_of_what_it_is_sorted_into():
    plan = PLANNER.plan("Sort the fruit into the bowls: plums in the left one, limes in the right one.")
    assert {obj.noun for obj in plan.objects} == {"plum", "lime", "bowl"}
    assert any("place:plum 1:bowl 1" in note and "place:lime 1:bowl 2" in note for note in plan.notes)


def test_what_is_taken_before_a_deed_that_is_no_task_is_the_task():
    plan = PLANNER.plan("Grasp the plum, then wash it.")
    assert (plan.task, plan.notes) == ("pick:plum", ('not modelled: "wash it": no task does that.',))


def test_a_side_behind_the_goal_is_said_to_be_read_of_the_goal():
    plan = PLANNER.plan("Pick up the plum and put it on the tray to the right of the basket.")
    assert plan.task == "place:plum:tray"
    assert '"to the right of the basket" is read as said of "the tray", not of where on it.' in plan.notes


def test_what_is_beside_something_is_not_moved_to_it():
    plan = PLANNER.plan("Grab the plum next to the lime and drop it in the basket.")
    assert ({str(relation) for relation in plan.relations}, plan.task) == ({"plum next_to lime"}, "place:plum:basket")


def test_a_deed_before_another_is_no_scene():
    plan = PLANNER.plan("Put a plum in the basket, then put the basket on the tray.")
    assert plan.relations == ()
    assert plan.task == chain("place:plum:basket", "place:basket:tray")


@pytest.mark.parametrize(
    ("prompt", "count", "task"),
    [
        ("Take the plate off the stack of plates and put it in the sink.", 4, "place:plate 4:sink"),
        ("Pick up a book from the pile of three books.", 3, "pick:book 3"),
        ("Move the cup from the stack of cups to the tray.", 4, "place:cup 4:tray"),
    ],
)
def test_what_is_taken_from_a_stack_of_its_like_is_the_top_one(prompt: str, count: int, task: str):
    plan = PLANNER.plan(prompt)
    noun = task.split(":")[1].split()[0]
    assert plan.task == task
    assert [str(rel) for rel in plan.relations] == [f"{noun} {n + 1} on {noun} {n}" for n in range(1, count)]


def test_a_shelf_above_something_is_the_goal_and_nothing_is_put_above():
    plan = PLANNER.plan("Put the book on the shelf above the desk.")
    assert (plan.task, plan.relations) == ("place:book:shelf", ())
    assert 'not modelled: "above the desk"' in plan.notes
