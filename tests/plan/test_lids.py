"""Lids told by what they close."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "edges", "task"),
    [
        ("Lift the lid of the saucepan.", {("lid", "on", "saucepan")}, "pick:lid"),
        ("Remove the lid of the green pot.", {("lid", "on", "green pot")}, "pick:lid"),
        ("Take the jar's lid and put it on the tray.", {("lid", "on", "jar")}, "place:lid:tray"),
        ("Grab the lid of the pan and put it on the counter.", {("lid", "on", "pan")}, "place:lid:counter"),
        ("A jar and the lid of the jar are on a shelf.", {("jar", "on", "shelf"), ("lid", "on", "shelf")}, None),
        ("A pan is on the stove. The pan's lid is on the counter.",
         {("pan", "on", "stove"), ("lid", "on", "counter")}, None),
    ],
)  # fmt: skip
def test_a_lid_of_a_vessel_is_a_thing(prompt: str, edges: set, task: str | None):
    plan = PLANNER.plan(prompt)
    assert {(rel.child, rel.kind, rel.parent) for rel in plan.relations} == edges
    assert plan.task == task


@pytest.mark.parametrize("prompt", ["Lift the lid of the laptop.", "Open the lid of the toolbox."])
def test_a_hinged_lid_is_a_part(prompt: str):
    plan = PLANNER.plan(prompt)
    assert [obj.noun for obj in plan.objects] in (["laptop"], ["toolbox"])
    assert any("has no parts of its own" in note for note in plan.notes)


def test_a_vessel_told_by_its_lid_alone_is_named():
    plan = PLANNER.plan("The lid of the pot is on the table.")
    assert {(rel.child, rel.kind, rel.parent) for rel in plan.relations} == {("lid", "on", "table")}
    assert any('"pot"' in note for note in plan.notes)
