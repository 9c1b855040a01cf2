"""Two readings that are nearly as likely are both told, so that a person sees which one is meant."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        (
            "A cutting board lies in the middle of the counter with a knife and six tomatoes on it.",
            ("on the cutting board", "are on the counter"),
        ),
        (
            "A kettle next to a plate of buns and a tea towel.",
            ("next to the plate and the tea towel", "Three buns and a tea towel are on the plate"),
        ),
    ],
)
def test_what_it_is_and_how_far_a_landmark_goes_are_told_both_ways(prompt: str, told: tuple[str, str]):
    plan = PLANNER.plan(prompt)
    assert told[1] in plan.otherwise


def test_a_sentence_with_one_reading_has_no_other():
    for prompt in ("A mug is on a table and a spoon is in the mug.", "Two plates and a bowl stand on a shelf."):
        assert not PLANNER.plan(prompt).otherwise
