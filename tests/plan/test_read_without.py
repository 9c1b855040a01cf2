"""What was a refusal and is read: the rest of the sentence stands as it would alone, and a note names what is left out.

Shapes on a table, what does not work, exceptions before a list, who is hailed, and what was imagined first.
"""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def _scene(plan: ScenePlan) -> tuple[list[str], set[str], str | None]:
    below = [one for one in plan.held() if one.kind == "under"]
    return sorted(obj.name for obj in plan.objects), set(map(str, (*plan.relations, *below))), plan.task


@pytest.mark.parametrize(
    ("said", "same", "left_out"),
    [
        ("Three jars stand in a triangle on a tray.", "Three jars stand on a tray.", "Three jars stand in a triangle"),
        ("Three jars form a triangle on a tray.", "Three jars on a tray.", "Three jars form a triangle"),
        ("A cup, a can and a jar in a triangle on a tray.", "A cup, a can and a jar on a tray.",
         "a can and a jar in a triangle"),
        ("Four stools form a square around a table.", "Four stools around a table.", "Four stools form a square"),
        ("Three jars stand on a shelf, forming a triangle.", "Three jars stand on a shelf.", "forming a triangle"),
        ("A lamp that doesn't work stands on a desk.", "A lamp stands on a desk.", "that doesn't work"),
        ("A cup and a clock that no longer works on a shelf.", "A cup and a clock on a shelf.", "that no longer works"),
        ("A jar, which isn't empty, stands on a tray.", "A jar stands on a tray.", "which isn't empty"),
        ("Take the lamp that does not work off the desk.", "Take the lamp off the desk.", "that does not work"),
        ("Everything but the fork: a plate and a cup on a tray.", "A plate and a cup on a tray.",
         "Everything but the fork"),
        ("On the tray is everything except the fork: plate, cup, knife.", "On the tray is a plate, a cup, a knife.",
         "everything except the fork"),
        ("Three boxes of increasing size in a row on a shelf.", "Three boxes in a row on a shelf.",
         "of increasing size"),
        ("A box stands in front of the mug so that the camera cannot see it.", "A box stands in front of the mug.",
         "so that the camera cannot see it"),
        ("A box stands before the mug so that it isn't visible.", "A box stands before the mug.",
         "so that it isn't visible"),
        ("Picture a quiet breakfast. A plate and a mug on a tray.", "A plate and a mug on a tray.",
         "Picture a quiet breakfast"),
        ("Picture a quiet breakfast: a plate and a mug on a tray.", "A plate and a mug on a tray.",
         "Picture a quiet breakfast"),
        ("Imagine a lazy Sunday. A book is on a chair.", "A book is on a chair.", "Imagine a lazy Sunday"),
    ],
)  # fmt: skip
def test_the_rest_is_read_and_the_note_names_what_is_left_out(said: str, same: str, left_out: str) -> None:
    plan = PLANNER.plan(said)
    assert _scene(plan) == _scene(PLANNER.plan(same))
    assert f'not modelled: "{left_out}"' in plan.notes


@pytest.mark.parametrize(
    "said",
    [
        "Four cups stand in a square on a tray.",
        "Four cups are arranged in a rectangle on a tray.",
        "Four cups form a square on a tray.",
    ],
)
def test_four_in_a_square_are_in_two_rows_of_two(said: str) -> None:
    plan, grid = PLANNER.plan(said), PLANNER.plan("Four cups stand in a 2x2 grid on a tray.")
    assert _scene(plan) == _scene(grid)
    assert plan.arrangements == grid.arrangements != ()


@pytest.mark.parametrize(
    "said",
    [
        "A cup that isn't on the table.",
        "A dog that doesn't sit on the sofa.",
        "A box that doesn't contain a ball.",
        "A ball is in a triangle.",
    ],
)
def test_where_it_is_not_and_what_is_no_arrangement_is_refused(said: str) -> None:
    with pytest.raises(PromptError):
        PLANNER.plan(said)


@pytest.mark.parametrize(
    ("said", "same"),
    [
        ("A ball has rolled under the sofa.", "A ball is under the sofa."),
        ("Two pears have fallen out of the basket onto the rug.", "There is the basket. Two pears are on the rug."),
        ("A pen has rolled off the desk and under the chair.", "There is the desk. A pen is under the chair."),
        ("The cat has climbed into the box.", "The cat is in the box."),
        ("A cup is on a tray, and a coin has rolled behind the cup.",
         "A cup is on a tray, and a coin is behind the cup."),
        ("Two balls are in a box. One has rolled behind the box.", "Two balls are in a box. One is behind the box."),
        ("A book has fallen off the shelf.", "A book is off the shelf."),
    ],
)  # fmt: skip
def test_what_has_moved_is_where_it_came_to_rest(said: str, same: str) -> None:
    plan, plain = PLANNER.plan(said), PLANNER.plan(same)
    assert _scene(plan) == _scene(plain)
    assert plan.arrangements == plain.arrangements


@pytest.mark.parametrize(
    ("said", "aside"),
    [
        ("Hi Tom, put the cup on the tray.", "Hi Tom"),
        ("Hello Anna! Put the cup on the tray.", "Hello Anna"),
        ("Good morning Tom, could you put the cup on the tray?", "Good morning Tom"),
        ("Okay Maria, put the cup on the tray.", "Okay Maria"),
        ("Tom, put the cup on the tray.", "Tom"),
    ],
)
def test_who_is_hailed_by_name_is_no_object(said: str, aside: str) -> None:
    plan = PLANNER.plan(said)
    assert ([obj.noun for obj in plan.objects], plan.task) == (["cup", "tray"], "place:cup:tray")
    assert (plan.set_aside, plan.notes) == ((aside,), ())


@pytest.mark.parametrize("said", ["Apple, put it in the bowl.", "Cup, plate and fork on a tray."])
def test_a_thing_named_first_is_there(said: str) -> None:
    assert PLANNER.plan(said).objects[0].noun in ("apple", "cup")


@pytest.mark.parametrize(
    ("said", "same"),
    [
        ("A table with a stool at each of its four sides.", "A table with four stools around it."),
        ("Two stools stand at each of the four sides of the table.", "Eight stools stand around the table."),
        ("A shelf with two levels and two cups on each level.", "A shelf with four cups."),
        ("A shelf has three levels. On each level stands a vase.", "A shelf. Three vases are on the shelf."),
        ("A row of jars, five in total, on a tray.", "A row of five jars on a tray."),
        ("Cups stand on a tray, six altogether.", "Six cups stand on a tray."),
        ("Two groups of cups on a tray, four in each group.", "Eight cups on a tray."),
        ("Six blocks in two groups of three on a tray.", "Six blocks on a tray."),
        ("A row of toys on a tray: a car, a ball and a doll.", "A car, a ball and a doll are in a row on a tray."),
        ("Three cans stand in a row, with a jar at the end of the row.",
         "Three cans stand in a row, with a jar at the right end."),
    ],
)  # fmt: skip
def test_numbers_places_and_rows_said_otherwise(said: str, same: str) -> None:
    plan, plain = PLANNER.plan(said), PLANNER.plan(same)
    assert _scene(plan) == _scene(plain)
    assert plan.arrangements == plain.arrangements


@pytest.mark.parametrize(
    ("said", "relation"),
    [
        ("A row of three cans with a jar at the right end.", "jar right_of can 3"),
        ("A row of three cans with a jar at the left end.", "jar left_of can 1"),
        ("A cup, a can and a jar in a row, with a ball at the right end.", "ball right_of jar"),
    ],
)
def test_the_right_end_of_a_row_is_its_last(said: str, relation: str) -> None:
    assert relation in map(str, PLANNER.plan(said).relations)
