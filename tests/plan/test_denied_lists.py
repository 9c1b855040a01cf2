"""How far a list goes that is said not to be there: "no cup, plate or fork" has none of the three."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(scope="module")
def planner() -> GrammarPlanner:
    return GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("A bench without a lamp, a book, or a plant.", ["bench"]),
        ("A mug on a desk, and without a spoon, a straw, and a lid.", ["desk", "mug"]),
        ("A hot dog, without onions, pickles, and a drink.", ["hot dog"]),
        ("A shelf with no vase, clock or candle.", ["shelf"]),
        ("A desk with a laptop, but no mouse, keyboard or lamp.", ["desk", "laptop"]),
        ("No bottles, cups or bowls, just a tray on a table.", ["table", "tray"]),
        ("A crate lacking a hammer, a saw or a wrench.", ["crate"]),
        ("A desk devoid of books and pens.", ["desk"]),
        ("The shelf is free of vases, clocks and candles.", ["shelf"]),
        ("A bench minus its cushions.", ["bench"]),
        ("Without a spoon, a fork and a napkin, a bowl is on the table.", ["bowl", "table"]),
        ("A mug without its saucer and spoon is on a tray.", ["mug", "tray"]),
        ("A tray without a cup, a bowl and a jar is on the desk.", ["desk", "tray"]),
    ],
)
def test_a_denied_list_is_denied_to_its_end(planner: GrammarPlanner, sentence: str, nouns: list[str]):
    plan = planner.plan(sentence)
    assert sorted(obj.noun for obj in plan.objects) == nouns
    assert not any("read as there" in note or "read as not there" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("A mug without a handle, a fork and a knife on a table.", ["fork", "knife", "mug", "table"]),
        ("A pot without a lid, a pan and a ladle are on a stove.", ["ladle", "pan", "pot", "stove"]),
        ("A sofa without cushions, a table and a lamp.", ["lamp", "sofa", "table"]),
        ("A mug, without a spoon, and a plate are on a tray.", ["mug", "plate", "tray"]),
        ("There is a mug without a spoon, and a plate is on the tray.", ["mug", "plate", "tray"]),
        ("A plate without a fork and another with a knife.", ["knife", "plate", "plate"]),
        ("No cups, two plates and a fork.", ["fork", "plate", "plate"]),
    ],
)
def test_a_list_goes_on_behind_what_one_of_it_is_without(planner: GrammarPlanner, sentence: str, nouns: list[str]):
    plan = planner.plan(sentence)
    assert sorted(obj.noun for obj in plan.objects) == nouns
    assert not any("read as there" in note or "read as not there" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "doubtful"),
    [
        ("A bench without a lamp, a book and a plant.", '"a book and a plant" is read as not there, like "a lamp"'),
        ("A mug without a spoon and a plate on a tray.", '"a plate" is read as there, unlike "a spoon"'),
    ],
)
def test_a_list_that_may_be_denied_or_not_is_named(planner: GrammarPlanner, sentence: str, doubtful: str):
    assert any(note.startswith(doubtful) for note in planner.plan(sentence).notes)
