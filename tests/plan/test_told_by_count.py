"""What is said of those that were counted: shares set off behind them, ranks, sizes, and where they are to end up."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()
SHARES = (
    ("A desk with three wallets (one yellow, two white) and two blue pens on it.",
     "A yellow wallet, two white wallets and two blue pens are on the desk."),
    ("On a desk there are three wallets (one yellow and two white), two blue pens and a cup.",
     "A yellow wallet, two white wallets, two blue pens and a cup are on the desk."),
    ("There are four erasers, one green, two yellow and one brown, and four white clocks on a shelf.",
     "A green eraser, two yellow erasers, a brown eraser and four white clocks are on the shelf."),
    ("Three jugs (two of them black, the other one green) are on a desk.",
     "Two black jugs and a green jug are on the desk."),
    ("On table: 3 rulers (1 purple and 2 brown), 3x blue shoes.",
     "A purple ruler, two brown rulers and three blue shoes are on the table."),
    ("Three mugs, two red and one blue, stand on a desk.", "Two red mugs and a blue mug are on the desk."),
    ("There are five marbles on a shelf, all of them brown.", "Five brown marbles are on the shelf."),
    ("There are five marbles on a shelf, all brown.", "Five brown marbles are on the shelf."),
    ("Of the six vases on a desk, half are yellow.", "Three yellow vases and three vases are on the desk."),
    ("On a desk there are six cups, half of which are green, and the rest are grey.",
     "Three green cups and three gray cups are on the desk."),
)  # fmt: skip
ENDS = (
    ("A pen and a mug are on a shelf. In the end, the pen should be in the mug.", "place:pen:mug"),
    ("A pen and a mug are on a shelf. I want the pen to be in the mug.", "place:pen:mug"),
    ("A pen and a mug are on a shelf. The pen ought to be in the mug.", "place:pen:mug"),
    ("A pen and a mug are on a shelf. See to it that the pen is in the mug in the end.", "place:pen:mug"),
    ("A ball and a crate are on a bench. The ball goes in the crate.", "place:ball:crate"),
    ("The pen should end up in the mug.", "place:pen:mug"),
    ("The mug should be on the tray.", "place:mug:tray"),
    ("The mug should be on the tray. The tray is on a shelf.", None),
    ("I want a mug on a tray.", None),
    ("A table has a cup and a bowl on it. The cup should be to the left of the bowl.", None),
)
SIZES = (
    ("A large comb and a comb are on a desk. Put the larger of the two combs on the shelf.", "place:large comb:shelf"),
    ("A big comb and a comb are on a desk. Put the larger comb on the shelf.", "place:big comb:shelf"),
    ("A large comb and a small comb are on a desk. Put the smaller one on the shelf.", "place:small comb:shelf"),
    ("A large comb and a comb are on a desk. Put the smaller of the two combs on the shelf.", "place:comb:shelf"),
    ("A wooden spoon and a spoon are on a desk. Put the wooden spoon on the shelf.", "place:wooden spoon:shelf"),
    ("Two combs are on a desk. Put the larger of the two combs on the shelf.", "place:larger comb:shelf"),
    ("Four forks are in a row on a desk. Put the fork at the right end on the shelf.", "place:fork 4:shelf"),
)
RANKS = (
    ("Two trucks stand on a shelf, one in front of the other. The front one is pink and the back one is white.",
     "The white truck is behind the pink truck."),
    ("Two trucks stand on a shelf, one behind the other. The one at the back is red and the one in front is blue.",
     "The red truck is behind the blue truck."),
    ("Three boxes are in a row. From left to right they hold a fig, a pen and two books.",
     "A fig is in the first of the three boxes. A pen is in the second of the three boxes. "
     "Two books are in the third of the three boxes."),
    ("A bench holds two buckets. The first holds a ball and the second a comb.",
     "A ball is in the first of the two buckets. A comb is in the second of the two buckets."),
    ("Four plates are on a desk. One holds a pear, another holds two figs and the rest are empty.",
     "Four plates are on the desk. A pear is on the first of the four plates. "
     "Two figs are on the second of the four plates."),
    ("Three boxes are on a desk. One holds a pear and another a fig.",
     "A pear is in the first of the three boxes. A fig is in the second of the three boxes."),
    ("A jar is to the right of a row of three cups on a desk. The one nearest the jar is red.",
     "The two cups and the red cup are in a row from left to right."),
)  # fmt: skip
CARRIED = (
    ("There is a desk with a bucket on it that holds a comb.", "A bucket is on the desk. A comb is in the bucket."),
    ("There is a desk with a red tray on it which carries two cups.", "Two cups are on the red tray."),
    ("On a desk there is a tray with two lemons on it and a pear on it too.",
     "A tray is on the desk. Two lemons and a pear are on the tray."),
    ("On the desk: brush; a bucket holding a ball; small mug.",
     "A brush, a bucket and a small mug are on the desk. A ball is in the bucket."),
    ("Desk: teapot; tomato; 3 cups (2 blue, 1 green)",
     "A teapot, a tomato, two blue cups and a green cup are on the desk."),
)  # fmt: skip


@pytest.mark.parametrize(("prompt", "told"), [*SHARES, *RANKS, *CARRIED])
def test_what_is_told_of_those_that_were_counted(prompt: str, told: str):
    assert told in tell(PLANNER.plan(prompt))


@pytest.mark.parametrize(("prompt", "task"), [*ENDS, *SIZES])
def test_which_thing_is_to_go_where(prompt: str, task: str | None):
    """What was told of elsewhere before is there still; a prompt that begins so describes its scene."""
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    if task and "are on" in prompt:
        moved = task.split(":")[1]
        assert [rel.kind for rel in plan.relations if rel.child == moved and rel.supports] == ["on"]


def test_before_you_do_one_thing_another_is_done_first():
    plan = PLANNER.plan("Before you put the marker in the box, put the brush in the cup.")
    assert not plan.relations
    assert plan.task == chain("place:brush:cup", "place:marker:box")


def test_the_first_two_are_told_one_by_one():
    prompt = "Four cups on a tray. The first two hold a spoon, the third a pencil and the last is empty."
    inside = {(rel.child, rel.parent) for rel in GrammarPlanner().plan(prompt).relations if rel.kind == "in"}
    assert inside == {("spoon 1", "cup 1"), ("spoon 2", "cup 2"), ("pencil", "cup 3")}
    prompt = "Five bowls are on a table. The first three contain an egg and the others are empty."
    inside = {rel.parent for rel in GrammarPlanner().plan(prompt).relations if rel.kind == "in"}
    assert inside == {"bowl 1", "bowl 2", "bowl 3"}


def test_all_but_two_of_three_is_one():
    for prompt in (
        "All but two of the three cups on a shelf are red.",
        "Of the three cups on a shelf, all but two are red.",
    ):
        plan = GrammarPlanner().plan(prompt)
        assert sorted(obj.colours for obj in plan.objects if obj.noun == "cup") == [(), (), ("red",)]


def test_what_is_cleared_has_on_it_what_is_moved():
    plan = GrammarPlanner().plan("Clear the desk by moving the two books to the shelf.")
    assert {(rel.child, rel.parent) for rel in plan.relations} == {("book 1", "desk"), ("book 2", "desk")}
    plan = GrammarPlanner().plan("Empty the box by placing the ball in the bin.")
    assert str(plan.task) == "place:ball:bin"
    assert ("ball", "in", "box") in {(rel.child, rel.kind, rel.parent) for rel in plan.relations}
