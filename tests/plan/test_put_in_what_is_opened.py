"""What is opened first holds what is then taken out of it, and not what is then put into it."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "edges", "task"),
    [
        ("Open the box, pick up a plum, place it inside the box, and close the lid.", set(), "place:plum:box"),
        ("Open the crate, pick up the ring and put it in the crate.", set(), "place:ring:crate"),
        ("Open the box, take out the ring and put it on the tray.", {("ring", "in", "box")}, "place:ring:tray"),
    ],
)
def test_what_is_put_in_was_not_there(prompt: str, edges: set, task: str):
    plan = PLANNER.plan(prompt)
    assert {(rel.child, rel.kind, rel.parent) for rel in plan.relations} == edges
    assert plan.task == task


@pytest.mark.parametrize(
    ("prompt", "edges"),
    [
        ("Two jars stand on a shelf, one filled with plums, the other empty.", {("plum 1", "in", "jar 1")}),
        ("Three candles on a tray, one lit.", {("candle 3", "on", "tray")}),
    ],
)
def test_a_state_that_goes_on_is_no_remark(prompt: str, edges: set):
    assert edges <= {(rel.child, rel.kind, rel.parent) for rel in PLANNER.plan(prompt).relations}
