"""What a thing is only compared with is no object of the scene, and a note names the comparison."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "nouns", "said"),
    [
        ("A candle that looks like a pear stands on a plate.", ["candle", "plate"], "that looks like a pear"),
        ("A bottle, as yellow as a lemon, is on the shelf.", ["bottle", "shelf"], "as yellow as a lemon"),
        ("A vase the size of a teapot stands on a table.", ["vase", "table"], "the size of a teapot"),
        ("A pillow shaped like a fish lies on a chair.", ["pillow", "chair"], "shaped like a fish"),
    ],
)
def test_a_simile_makes_nothing_and_is_noted(prompt, nouns, said):
    plan = PLANNER.plan(prompt)
    assert [obj.noun for obj in plan.objects] == nouns
    assert f'not modelled: "{said}"' in plan.notes
    assert [rel.kind for rel in plan.relations] == ["on"]


def test_what_is_there_and_compared_with_stays_there():
    plan = PLANNER.plan("A lamp and a globe stand on a desk. The lamp is as tall as the globe.")
    assert [obj.noun for obj in plan.objects] == ["lamp", "globe", "desk"]
