"""Sentences whose meaning is known by construction (benchmarks/composed.py): none is misread without a note."""

import pytest

from benchmarks.composed import FAMILIES, compose, judge
from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()
COUNT = 14
"""Sentences of each family: about 0.02 s each."""


@pytest.mark.parametrize("family", FAMILIES)
def test_no_sentence_of_the_family_is_misread_in_silence(family):
    judged = [judge(PLANNER, *compose(family, 2, number)) for number in range(COUNT)]
    assert [(each.text, each.wrong) for each in judged if each.verdict == "silently wrong"] == []
    assert sum(each.verdict != "refused" and not each.wrong for each in judged) >= COUNT // 2


def test_the_same_numbers_give_the_same_sentence():
    for family in FAMILIES:
        assert compose(family, 0, 1)[0] == compose(family, 0, 1)[0] != compose(family, 0, 2)[0]


def test_what_a_plan_lacks_is_told():
    """A sentence judged against the meaning of another is not right."""
    (text, _), (_, meaning) = compose("describe", 0, 1), compose("describe", 0, 2)
    judged = judge(PLANNER, text, meaning)
    assert judged.verdict == "silently wrong"
    assert any(each.startswith("lacks") for each in judged.wrong)
