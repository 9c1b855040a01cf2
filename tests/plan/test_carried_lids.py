"""What is "on it" and "in it", a lid on a vessel, marbles in a jar; which of several is meant; which sizes are said."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "edge"),
    [
        ("There is a saucepan on the stove with a lid on it.", ("lid", "on", "saucepan")),
        ("A kettle on a tray with a lid on it.", ("lid", "on", "kettle")),
        ("A jar with a lid on a shelf.", ("jar", "on", "shelf")),
        ("A pan on a counter with its lid on.", ("lid", "on", "pan")),
        ("A jar on a desk with marbles in it.", ("marble 1", "in", "jar")),
        ("A vase on a table and another on a shelf with a rose in it.", ("rose", "in", "vase 2")),
        ("A bottle on a bench with a cap on it.", ("cap", "on", "bottle")),
        ("A jar on a shelf with books on it.", ("book 1", "on", "shelf")),
        ("A box that holds two cups and one of the cups is red.", ("red cup", "in", "box")),
        ("The spoon is on the right side of the bowl and the napkin on the left side.", ("napkin", "left_of", "bowl")),
        ("In the basket there exists a pear.", ("pear", "in", "basket")),
        ("Throw in a crate with two pears.", ("pear 2", "in", "crate")),
        ("Three cups in a row. The second cup and the third cup hold an egg.", ("egg 1", "in", "cup 2")),
    ],
)
def test_what_is_at_it(prompt: str, edge: tuple[str, str, str]):
    assert edge in {(rel.child, rel.kind, rel.parent) for rel in PLANNER.plan(prompt).relations}


@pytest.mark.parametrize(
    ("prompt", "colours"),
    [
        ("Three jars in a row. The left jar is red, the middle jar is blue, the right jar is green.",
         ["red", "blue", "green"]),
        ("Four jars in a row. The second and third are white.", ["", "white", "white", ""]),
        ("Four jars in a row. The first and fourth jars are white.", ["white", "", "", "white"]),
        ("Three jars in a row, the first and last ones red.", ["red", "", "red"]),
        ("Three jars in a row, the first one red and the last one red.", ["red", "", "red"]),
        ("Three jars in a row; the second jar is red, the other jars are blue.", ["blue", "red", "blue"]),
    ],
)  # fmt: skip
def test_which_of_a_row_is_meant(prompt: str, colours: list[str]):
    assert ["".join(obj.colours) for obj in PLANNER.plan(prompt).objects] == colours


@pytest.mark.parametrize(
    ("prompt", "metres"),
    [
        ("A cube with an edge of 5 cm on a table.", 0.05),
        ("A ball with a radius of 4 cm.", 0.08),
        ("A cube with sides of 30 mm.", 0.03),
        ("A box with 20 cm sides.", 0.2),
    ],
)
def test_edges_and_radii_are_sizes(prompt: str, metres: float):
    plan = PLANNER.plan(prompt)
    extent = plan.objects[0].extent
    assert extent is not None
    assert extent.metres == pytest.approx(metres)
    assert not plan.notes
    assert sum(obj.noun == plan.objects[0].noun for obj in plan.objects) == 1


def test_a_known_stack_so_that_one_is_on_top_is_no_task_of_other_bricks():
    plan = PLANNER.plan("Stack the two bricks so that the red one is at the bottom and the blue one on top.")
    assert any("so that" in note for note in plan.notes)
    assert not any(obj.colours for obj in plan.objects)


def test_a_side_that_nothing_tells_is_noted():
    notes = PLANNER.plan("white shelf, vase left, 2 books next to it").notes
    assert [note for note in notes if '"vase" on the left' in note]
