"""Names of one kind: when "a short one", "the larger one" and "the clean plate" are further things, and when not."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


def told(plan: ScenePlan, noun: str) -> list[tuple[str, ...]]:
    """What every object of `noun` is told from its like by."""
    return [(*obj.name.rstrip(" 0123456789").split()[:-1], *obj.adjectives) for obj in plan.objects if obj.noun == noun]


@pytest.mark.parametrize(
    ("prompt", "noun", "expected"),
    [
        ("A tall bottle and a short one are on a shelf.", "bottle", [("tall",), ("short",)]),
        ("Two long candles stand left of a short one.", "candle", [("long",), ("long",), ("short",)]),
        ("One big bowl and two little ones on a tray.", "bowl", [("big",), ("little",), ("little",)]),
        ("A wooden stool beside a metal one.", "stool", [("wooden",), ("metal",)]),
        ("One large pan is on the stove, two small ones in the sink.", "pan", [("large",), ("small",), ("small",)]),
        ("The smallest crate stands on the biggest one.", "crate", [("small",), ("big",)]),
        ("The larger plate is below the smaller one.", "plate", [("larger",), ("smaller",)]),
        ("Four jars are on the desk: three large ones and a small one.", "jar", [("large",)] * 3 + [("small",)]),
        ("Three crates are on the floor. The smallest crate is on the largest one.", "crate",
         [("small",), ("large",), ()]),
        ("Put the metal spoon in the cup and the wooden spoon in the jar.", "spoon", [("metal",), ("wooden",)]),
        ("The dirty mug is beside the clean mug.", "mug", [("dirty",), ("clean",)]),
        ("There is a wooden spoon. The spoon is in a cup.", "spoon", [("wooden",)]),
        ("A long spoon is in a jar. The spoon is red.", "spoon", [("red", "long")]),
    ],
)  # fmt: skip
def test_members_of_a_kind(planner: GrammarPlanner, prompt: str, noun: str, expected: list[tuple[str, ...]]):
    plan = planner.plan(prompt)
    assert told(plan, noun) == expected
    assert not any(start in note for note in plan.notes for start in ("counted otherwise", "not understood"))


def test_two_names_of_one_sentence_are_two_things(planner: GrammarPlanner):
    plan = planner.plan("Put the socks in the hamper and the shirts in the laundry basket.")
    assert [obj.name for obj in plan.objects if obj.noun == "laundry basket"] == ["hamper", "laundry basket"]
    assert not any("counted otherwise" in note for note in plan.notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "A sofa stands on a rug. A cushion is on the couch.",
        "A laundry basket is beside the bed and a towel is in the basket.",
        "A dresser is by the bed and a lamp is on the drawer.",
    ],
)
def test_a_name_that_refers_back_makes_nothing_new(planner: GrammarPlanner, prompt: str):
    assert len(planner.plan(prompt).objects) == 3
