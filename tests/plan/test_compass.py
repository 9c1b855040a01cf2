"""Points of the compass as on a map, and words for kinds of things."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "edge"),
    [
        ("A jar is north of a plate.", ("jar", "behind", "plate")),
        ("A jar is to the south of a plate.", ("jar", "in_front_of", "plate")),
        ("A jar is directly east of a plate.", ("jar", "right_of", "plate")),
        ("A jar stands west of a plate.", ("jar", "left_of", "plate")),
    ],
)
def test_a_point_of_the_compass_is_a_side_as_on_a_map(prompt: str, edge: tuple[str, str, str]):
    plan = PLANNER.plan(prompt)
    assert edge in {(rel.child, rel.kind, rel.parent) for rel in plan.relations}
    assert any("as on a map" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("point", "task", "second"),
    [("northwest", "beside:cube:behind:bowl", "left"), ("south-east", "beside:cube:in_front_of:bowl", "right")],
)
def test_between_two_points_the_second_is_noted(point: str, task: str, second: str):
    plan = PLANNER.plan(f"Move the cube {point} of the bowl.")
    assert plan.task == task
    assert any(f'"{point} of"' in note and f"to the {second} of" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("Put the toy vehicle in the box.", "toy car"),
        ("Put the dairy product on the tray.", "milk carton"),
        ("A beverage on a desk.", "soda can"),
    ],
)
def test_a_kind_of_thing_is_one_of_that_kind_and_said_so(prompt: str, noun: str):
    plan = PLANNER.plan(prompt)
    assert noun in {obj.noun for obj in plan.objects}
    assert any(noun in note and "which is not said" in note for note in plan.notes)
