"""What sits on a lid, food of no kind, and places that begin a sentence."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


def edges(prompt: str) -> set[tuple[str, str, str]]:
    return {(each.child, each.kind, each.parent) for each in PLANNER.plan(prompt).relations}


@pytest.mark.parametrize(
    ("prompt", "wanted"),
    [
        ("A shoebox with a teddy bear on its lid.", {("teddy bear", "on", "shoebox")}),
        (
            "A toy car is parked in front of a shoebox with a teddy bear sitting on its lid.",
            {("teddy bear", "on", "shoebox"), ("toy car", "in_front_of", "shoebox")},
        ),
        ("A pot with its lid on a table.", {("pot", "on", "table"), ("lid", "on", "pot")}),
    ],
)
def test_what_is_on_its_lid_is_on_it(prompt: str, wanted: set[tuple[str, str, str]]):
    assert edges(prompt) == wanted


@pytest.mark.parametrize("prompt", ["A plate of food on a table.", "Pastries on a tray.", "A table topped with food."])
def test_food_is_picked_with_a_note(prompt: str):
    plan = PLANNER.plan(prompt)
    assert any("which is not said" in note for note in plan.notes)
    assert sum(rel.supports for rel in plan.relations) >= 3


@pytest.mark.parametrize("prompt", ["Shelf of books in a kitchen.", "Side of meat on a plate.", "Drawer of spoons."])
def test_a_part_that_begins_a_sentence_is_no_crash(prompt: str):
    assert PLANNER.plan(prompt).objects


def test_inside_that_one_is_what_was_named_last():
    assert edges("A tray holds a cup, and inside that one lies a coin.") == {
        ("cup", "on", "tray"),
        ("coin", "in", "cup"),
    }
    assert edges("A box with a ball inside that is red.") == {("red ball", "in", "box")}


def test_counts_behind_more_of_one_kind_are_the_counts():
    plan = PLANNER.plan("There are more forks than knives: five forks and three knives in a drawer.")
    assert [obj.noun for obj in plan.objects].count("fork") == 5
    assert [obj.noun for obj in plan.objects].count("knife") == 3


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("A glass of wine and a wine bottle on a table.", ["wine glass", "wine bottle", "table"]),
        ("A salt and pepper shaker.", ["salt shaker", "salt shaker"]),
    ],
)
def test_what_fills_a_glass_has_no_head_of_its_own(prompt: str, nouns: list[str]):
    assert [obj.noun for obj in PLANNER.plan(prompt).objects] == nouns


def test_what_lies_on_a_bag_from_which_it_is_taken_is_told():
    told = [note for note in PLANNER.plan("Take the apple from the backpack.").notes if "placed on it" in note]
    assert told == ['not arranged: "apple" inside "backpack"; it is placed on it']
    assert not PLANNER.plan("Take the apple from the box.").notes


def test_what_is_not_to_be_lifted_is_not_picked_up():
    plan = PLANNER.plan("Without lifting the lemon, get it next to the bowl.")
    assert (plan.task, plan.relations) == ("beside:lemon:next_to:bowl", ())
    assert plan.notes == ('not modelled: "Without lifting the lemon"',)
