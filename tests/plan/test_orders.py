"""Which of several likes is meant by its place in an order: relations hold it, or a note says that nothing does."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.relations import OPPOSITE


def _plan(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def _beside(plan: ScenePlan, name: str, kind: str) -> set[str]:
    """The objects to which object `name` stands in relation `kind`, from whichever side the plan says so."""
    children = {rel.parent for rel in plan.relations if rel.child == name and rel.kind == kind}
    return children | {rel.child for rel in plan.relations if rel.parent == name and rel.kind == OPPOSITE[kind]}


@pytest.mark.parametrize(
    ("prompt", "task", "kind", "before", "behind"),
    [
        ("Three bottles are on the shelf. Pick up the middle bottle.", "pick:bottle 2", "left_of", 1, 1),
        ("There are three cups on the tray. Take the middle one and set it on the saucer.",
         "place:cup 2:saucer", "left_of", 1, 1),
        ("On the table are five cubes. Grab the one in the middle.", "pick:cube 3", "left_of", 2, 2),
        ("Three mugs are on a table. Take the central mug.", "pick:mug 2", "left_of", 1, 1),
        ("Three mugs are on a table. Take the mug between the other two.", "pick:mug 2", "left_of", 1, 1),
        ("Pick up the middle cup of the three cups.", "pick:cup 2", "left_of", 1, 1),
        ("Four jars stand on the shelf. Pick the third one from the left.", "pick:jar 3", "left_of", 2, 1),
        ("Five blocks are on the tray. Put the second from the right in the bowl.",
         "place:block 4:bowl", "left_of", 3, 1),
        ("Four cans on a shelf. Pick up the can on the far left.", "pick:can 1", "left_of", 0, 3),
        ("Four cans on a shelf. Pick up the can at the right end.", "pick:can 4", "left_of", 3, 0),
        ("There are three cans on the tray. Take the front one.", "pick:can 1", "in_front_of", 0, 2),
        ("There are three bowls on the desk. Take the bowl at the back.", "pick:bowl 3", "in_front_of", 2, 0),
        ("Three vases on a table. Pick up the rear one.", "pick:vase 3", "in_front_of", 2, 0),
        ("Four cups on a table. Pick up the second cup from the front.", "pick:cup 2", "in_front_of", 1, 2),
        ("Four cups on a table. Pick up the second cup from the back.", "pick:cup 3", "in_front_of", 2, 1),
    ],
)  # fmt: skip
def test_what_is_told_by_its_place_has_its_likes_on_the_sides_that_the_place_says(prompt, task, kind, before, behind):
    plan = _plan(prompt)
    name = task.split(":")[1]
    assert plan.task == task
    assert len(_beside(plan, name, OPPOSITE[kind])) == before
    assert len(_beside(plan, name, kind)) == behind
    assert not plan.notes
    assert not any(each.kind == "row" for each in plan.arrangements), "no row is said"


def test_colours_told_by_place_are_in_that_order():
    plan = _plan("Three cups on a tray. The left one is red, the middle one is green, the other is blue.")
    assert _beside(plan, "green cup", "right_of") == {"red cup"}
    assert _beside(plan, "green cup", "left_of") == {"blue cup"}
    plan = _plan("Three jars on a table. The front one is red, the middle one green and the back one blue.")
    assert _beside(plan, "green jar", "behind") == {"red jar"}
    assert _beside(plan, "green jar", "in_front_of") == {"blue jar"}


def test_the_left_one_and_the_front_one_are_two():
    plan = _plan("Three cups on a table. The left one is red, and the front one is blue.")
    assert _beside(plan, "red cup", "left_of") == {"blue cup", "cup"}
    assert _beside(plan, "blue cup", "in_front_of") == {"red cup", "cup"}


@pytest.mark.parametrize(
    ("prompt", "words"),
    [
        ("Three eggs are in a bowl. Pick up the leftmost egg.", "the leftmost egg"),
        ("Three cups are in a crate. Pick up the middle one.", "the middle one"),
        ("Three mugs hang from a mug tree. Take the left mug.", "the left mug"),
        ("Five chairs in a circle. The leftmost chair is red.", "The leftmost chair"),
        ("Six chairs stand around a table. The leftmost chair is red.", "The leftmost chair"),
        ("A stack of three books. Take the left one.", "the left one"),
    ],
)
def test_where_no_order_can_be_held_a_note_names_the_words(prompt, words):
    plan = _plan(prompt)
    assert any(note.startswith(f'not arranged: "{words}"') for note in plan.notes)
    assert not {rel.kind for rel in plan.relations} & {"left_of", "right_of", "in_front_of", "behind"}


@pytest.mark.parametrize(
    "prompt",
    [
        "Three boxes: the first holds an egg, the second a ball and the third is empty.",
        "Three cups stand on the shelf. The first one is red.",
        "The second of three trays has a cup on it; the other trays have a spoon on them.",
        "Three boxes are on the desk. Put the ball in the first box and the pen in the second.",
    ],
)
def test_what_is_only_counted_off_stands_in_no_order(prompt):
    assert not any(rel.kind in OPPOSITE for rel in _plan(prompt).relations)


def test_a_rank_of_which_no_side_is_said_is_counted_from_the_left():
    plan = _plan("Four cups on a shelf. Pick up the second cup.")
    assert _beside(plan, "cup 2", "right_of") == {"cup 1"}
    assert 'assumed: "the second cup" is counted from the left' in plan.notes
    plan = _plan("Four cups on a shelf. Pick up the second to last cup.")
    assert (plan.task, _beside(plan, "cup 3", "left_of")) == ("pick:cup 3", {"cup 4"})


@pytest.mark.parametrize(
    ("prompt", "task", "relation", "assumed"),
    [
        ("A red cup, a green cup and a blue cup are on the table. Take the middle cup.",
         "pick:green cup", ("green cup", "left_of", "blue cup"), True),
        ("A red cup and a blue cup are on the table. Take the left cup.",
         "pick:red cup", ("red cup", "left_of", "blue cup"), True),
        ("A red cup and a blue cup are on the table. Take the front cup.",
         "pick:red cup", ("red cup", "in_front_of", "blue cup"), True),
        ("A red cup is to the right of a blue cup. Take the left cup.",
         "pick:blue cup", ("red cup", "right_of", "blue cup"), False),
        ("A red cup is behind a blue cup. Take the front cup.",
         "pick:blue cup", ("red cup", "behind", "blue cup"), False),
    ],
)  # fmt: skip
def test_likes_named_one_by_one_are_told_by_their_places_too(prompt, task, relation, assumed):
    plan = _plan(prompt)
    child, kind, parent = relation
    assert plan.task == task
    assert parent in _beside(plan, child, kind)
    assert bool(plan.notes) == assumed


def test_one_is_in_front_and_one_behind():
    plan = _plan("Two cars: the one in front is red and the one behind is blue.")
    assert _beside(plan, "red car", "in_front_of") == {"blue car"}


def test_a_side_on_one_surface_is_none_of_what_stands_on_another():
    plan = _plan("There are two cups on the table and two cups on the shelf. Take the left cup on the shelf.")
    assert _beside(plan, "cup 3", "left_of") == {"cup 4"}
    assert not any("to the left of" in note for note in plan.notes)


def test_of_a_stack_the_second_from_the_top_is_the_last_but_one():
    assert _plan("A stack of four books. Pick up the second book from the top.").task == "pick:book 3"
    assert _plan("A stack of four books. Pick up the second book from the bottom.").task == "pick:book 2"
    assert _plan("A stack of three books. Pick up the middle book of the stack.").task == "pick:book 2"


def test_a_row_keeps_its_own_order_and_runs_to_the_back_where_its_front_is_told():
    plan = _plan("A row of five cups. Pick up the second from the right.")
    assert plan.task == "pick:cup 4"
    assert [each.objects for each in plan.arrangements] == [("cup 1", "cup 2", "cup 3", "cup 4", "cup 5")]
    plan = _plan("Three cups in a row on a table. The front one is red.")
    assert [each.objects for each in plan.arrangements] == [("red cup", "cup 1", "cup 2")]
    assert _beside(plan, "red cup", "in_front_of") == {"cup 1"}
    assert not any(rel.kind == "left_of" for rel in plan.relations)


def test_the_middle_of_rows_is_noted_where_they_have_none():
    plan = _plan("Six blocks in two rows of three. The middle block is red.")
    assert 'not arranged: "The middle block"' in plan.notes
    plan = _plan("Nine blocks in three rows of three. The middle block is red.")
    assert not plan.notes
    rows = [each.objects for each in plan.arrangements]
    assert ("block 4", "red block", "block 5") in rows


def test_of_two_or_four_none_is_the_middle_one():
    assert _plan("Two cups on a table. Take the middle one.").notes
    assert _plan("Four cups on a table. Take the middle one.").notes
