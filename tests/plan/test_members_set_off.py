"""A group whose members are set off behind it is those members, each with what is said of all."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "names"),
    [
        ("The blue toys, a truck and a doll, are in the crate.", {"blue truck", "blue doll", "crate"}),
        ("The utensils, a fork and a knife, lie on a napkin.", {"fork", "knife", "napkin"}),
        ("The tools - a wrench and a file - are on a bench.", {"wrench", "file", "bench"}),
        ("Two things, a cup and a book, stand on a shelf.", {"cup", "book", "shelf"}),
        ("All of the white objects - a mug, a vase and a plate - are on the desk.",
         {"white mug", "white vase", "white plate", "desk"}),
    ],
)  # fmt: skip
def test_the_members_are_there_once(prompt: str, names: set[str]):
    assert {obj.name for obj in PLANNER.plan(prompt).objects} == names


def test_what_is_done_with_a_group_is_done_with_its_members():
    plan = PLANNER.plan("Put the fruits, a fig and a lemon, on the plate.")
    assert plan.task == "chain:place:fig:plate:then:place:lemon:plate"


@pytest.mark.parametrize(
    ("prompt", "count"),
    [("The fruits, a lamp and a book are on the desk.", 6), ("Three toys, a truck and a doll, are on a mat.", 6)],
)
def test_a_list_that_goes_on_is_no_group_with_members(prompt: str, count: int):
    assert len(PLANNER.plan(prompt).objects) == count
