"""One of several lies on its side, some of several are stacked, and each stands on one of its own."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def relations(plan: ScenePlan) -> set[str]:
    return set(map(str, plan.relations))


@pytest.mark.parametrize(
    ("prompt", "postures"),
    [
        ("Two jars: one lies on its side, the other one is upright.", {"jar 1 on_its_side", "jar 2 upright"}),
        ("Two jars on a bench: one lies on its side, the other stands upright.",
         {"jar 1 on_its_side", "jar 2 upright"}),
        ("Two jars stand on a bench. One lies on its side.", {"jar 1 on_its_side"}),
        ("Two jars on a bench, one lies on its side", {"jar 1 on_its_side"}),
        ("Three jars on a bench, one of them upside down, the rest upright",
         {"jar 1 upside_down", "jar 2 upright", "jar 3 upright"}),
        ("Three jars: one upside down, the others lying on their side",
         {"jar 1 upside_down", "jar 2 on_its_side", "jar 3 on_its_side"}),
    ],
)  # fmt: skip
def test_one_stands_otherwise_than_the_others(prompt: str, postures: set[str]):
    plan = PLANNER.plan(prompt)
    assert sum(obj.noun == "jar" for obj in plan.objects) == (3 if "hree" in prompt else 2)
    assert {f"{one.object} {one.kind}" for one in plan.postures} == postures
    assert plan.notes == ()


def test_two_postures_of_one_thing_are_named():
    plan = PLANNER.plan("Three jars on a bench: one of them upside down, the rest are upright.")
    kinds = {one.kind for one in plan.postures if one.object == "jar 1"}
    assert len(kinds) == 1 or any("upside down" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("A bench with a lamp, two plates stacked on top of each other, a fig on the top plate and a cup",
         {"lamp on bench", "plate 1 on bench", "plate 2 on plate 1", "fig on plate 2", "cup on bench"}),
        ("A bench with a lamp, three plates stacked on one another, a fig on the top plate",
         {"lamp on bench", "plate 1 on bench", "plate 2 on plate 1", "plate 3 on plate 2", "fig on plate 3"}),
    ],
)  # fmt: skip
def test_stacked_ones_stand_beside_what_else_is_listed(prompt: str, expected: set[str]):
    plan = PLANNER.plan(prompt)
    assert relations(plan) == expected
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("Two mugs on coasters, a nut on each coaster",
         {"mug 1 on coaster 1", "mug 2 on coaster 2", "nut 1 on coaster 1", "nut 2 on coaster 2"}),
        ("Two mugs on coasters, a nut on each coaster, all on a tray",
         {"mug 1 on coaster 1", "mug 2 on coaster 2", "nut 1 on coaster 1", "nut 2 on coaster 2",
          "coaster 1 on tray", "coaster 2 on tray"}),
        ("Two red mugs on black coasters, each with a nut",
         {"red mug 1 on black coaster 1", "red mug 2 on black coaster 2", "nut 1 on black coaster 1",
          "nut 2 on black coaster 2"}),
        ("Two lamps on tables, a book on each table",
         {"lamp 1 on table 1", "lamp 2 on table 2", "book 1 on table 1", "book 2 on table 2"}),
    ],
)  # fmt: skip
def test_as_many_carriers_as_things_where_each_is_told_of(prompt: str, expected: set[str]):
    plan = PLANNER.plan(prompt)
    assert relations(plan) == expected
    assert plan.notes == ()
