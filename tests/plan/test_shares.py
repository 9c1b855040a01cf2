"""Counts and shares: what is made is as many as the sentence says, at each place as many, or a note names it."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


def carried(plan: ScenePlan, carrier: str) -> list[int]:
    """How many each object named `carrier` carries."""
    names = [obj.name for obj in plan.objects if obj.name.rstrip(" 0123456789") == carrier]
    return [sum(rel.parent == name and rel.kind in ("on", "in") for rel in plan.relations) for name in names]


@pytest.mark.parametrize(
    ("prompt", "noun", "carrier", "shares"),
    [
        ("There are eight pears, four in each of two baskets.", "pear", "basket", [4, 4]),
        ("Six pencils: three in each of the two mugs.", "pencil", "mug", [3, 3]),
        ("There are four plums, one in each of four cups.", "plum", "cup", [1, 1, 1, 1]),
        ("Six red pens, with two of them in each of the three mugs.", "pen", "mug", [2, 2, 2]),
        ("There are two boxes on a table. There are six balls, three in each box.", "ball", "box", [3, 3]),
        ("Four lemons are in two bowls, two in each.", "lemon", "bowl", [2, 2]),
        ("Two bowls hold six limes, with three in each bowl.", "lime", "bowl", [3, 3]),
    ],
)
def test_so_many_in_each_of_several(planner: GrammarPlanner, prompt: str, noun: str, carrier: str, shares: list[int]):
    plan = planner.plan(prompt)
    assert sum(obj.name.rstrip(" 0123456789").endswith(noun) for obj in plan.objects) == sum(shares)
    assert carried(plan, carrier) == shares
    assert not any("counted otherwise" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("Seven limes, two in each of three bowls.", '"limes", of which there are 21, with "two in each"'),
        ("Four spoons and two mugs: two spoons in each mug.", '"spoons", of which there are 8'),
        ("Six lemons, three in each of three boxes.", '"three in each"; there are 1'),
    ],
)
def test_shares_that_do_not_make_up_the_whole_are_noted(planner: GrammarPlanner, prompt: str, note: str):
    assert any(f"counted otherwise: {note}" in each for each in planner.plan(prompt).notes)
