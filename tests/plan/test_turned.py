"""A posture is of what the clause is about, and of what carries that only where it is said so."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


def turned(prompt: str) -> set[str]:
    """The nouns of what the plan of `prompt` turns."""
    plan = PLANNER.plan(prompt)
    posed = {posture.object for posture in plan.postures}
    return {each.noun for each in plan.objects if each.name in posed}


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A jar stands on the counter upside down.", "jar"),
        ("A can lies on the bench, on its side.", "can"),
        ("There is a bucket on the shelf, upside down.", "bucket"),
        ("A vase stands on the table upside down, beside a candle.", "vase"),
        ("A plate is on the table, and a jar stands on the plate upside down.", "jar"),
        ("A jar stands on the bench next to a lamp, on its side.", "jar"),
    ],
)
def test_a_posture_behind_a_place_is_of_what_stands_there(prompt: str, noun: str):
    assert turned(prompt) == {noun}


def test_a_posture_behind_a_place_is_of_all_that_stand_there():
    assert turned("Two jars and a vase lie on the bench on their sides.") == {"jar", "vase"}
    assert turned("On the bench are a jar and a vase, upside down.") == {"jar", "vase"}


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("An orange lies on a cup turned upside down.", "cup"),
        ("A candle stands on a pot that is upside down.", "pot"),
        ("An apple lies on a bucket upside down.", "bucket"),
    ],
)
def test_a_vessel_turned_over_is_named_with_its_posture(prompt: str, noun: str):
    assert turned(prompt) == {noun}


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        ("A crate is on the bench. The crate has a handle on its side.", "a handle on its side"),
        ("A jar with a label on its side stands on a shelf.", "a label on its side"),
        ("The bucket has a sticker on its side and a lid on top.", "a sticker on its side"),
        ("Two cans with labels on their sides are on a tray.", "labels on their sides"),
        ("A mug with a blue stripe on its side is next to a vase.", "blue stripe on its side"),
        ("A bottle with a cap lying on its side", "a cap lying on its side"),
    ],
)
def test_where_a_part_is_turns_nothing(prompt: str, said: str):
    plan = PLANNER.plan(prompt)
    assert plan.postures == ()
    assert any(f'not modelled: "{said}"' in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A can with a red label is on its side.", "can"),
        ("A mug with a handle, lying on its side", "mug"),
        ("A box with a lid on its side", "lid"),
    ],
)
def test_what_has_a_part_is_turned_where_that_is_said(prompt: str, noun: str):
    assert turned(prompt) == {noun}
