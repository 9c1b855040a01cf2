"""What one, both, some or all of several are said to be: another, a kind of its own, all six, the red ones."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


def read(sentence: str) -> tuple[str, str]:
    plan = PLANNER.plan(sentence)
    return ", ".join(sorted(obj.name for obj in plan.objects)), ", ".join(sorted(map(str, plan.relations)))


def each_in(child: str, parent: str, carriers: int, share: int, how: str = "in") -> set[str]:
    """The relations of `carriers` that hold `share` each, handed out in turn."""
    return {f"{child} {n + 1} {how} {parent} {n % carriers + 1}" for n in range(carriers * share)}


@pytest.mark.parametrize(
    ("sentence", "objects", "relations"),
    [
        ("A cup is on the table and one is on the shelf.", "cup 1, cup 2, shelf, table",
         "cup 1 on table, cup 2 on shelf"),
        ("A cup on the table and one on the shelf.", "cup 1, cup 2, shelf, table", "cup 1 on table, cup 2 on shelf"),
        ("A cup is on the table. There is one on the shelf.", "cup 1, cup 2, shelf, table",
         "cup 1 on table, cup 2 on shelf"),
        ("A tray on the left holds a cup, and one on the right holds a can.", "can, cup, tray 1, tray 2",
         "can on tray 2, cup on tray 1, tray 1 left_of tray 2"),
        ("A bowl on the left contains two plums, one on the right contains an egg.", "bowl 1, bowl 2, egg, plum 1, "
         "plum 2", "bowl 1 left_of bowl 2, egg in bowl 2, plum 1 in bowl 1, plum 2 in bowl 1"),
        ("A bench with a lamp on the left and one on the right.", "bench, lamp 1, lamp 2",
         "lamp 1 left_of lamp 2, lamp 1 on bench, lamp 2 on bench"),
        ("A tray near the lamp holds a cup, and one near the clock holds a can.",
         "can, clock, cup, lamp, tray 1, tray 2",
         "can on tray 2, cup on tray 1, tray 1 next_to lamp, tray 2 next_to clock"),
        ("A chair with a cat on it and one with a dog on it.", "cat, chair 1, chair 2, dog",
         "cat on chair 1, dog on chair 2"),
    ],
)  # fmt: skip
def test_one_is_another_where_no_several_were_named(sentence: str, objects: str, relations: str):
    assert read(sentence) == (objects, relations)


@pytest.mark.parametrize(
    ("sentence", "objects", "relations"),
    [
        ("There are two trays; one on the left holds a cup, and one on the right holds a can.",
         "can, cup, tray 1, tray 2", "can on tray 2, cup on tray 1, tray 1 left_of tray 2"),
        ("Three cups, one on a tray.", "cup 1, cup 2, cup 3, tray", "cup 1 on tray"),
        ("A cup, one with a handle, is on the table.", "cup, table", "cup on table"),
        ("A bookshelf holds a book, one on the top shelf.", "book, bookshelf", "book on bookshelf"),
    ],
)  # fmt: skip
def test_one_is_a_member_where_several_were_named(sentence: str, objects: str, relations: str):
    assert read(sentence) == (objects, relations)


@pytest.mark.parametrize(
    ("sentence", "relations"),
    [
        ("Two baskets, both of which contain three pears.", each_in("pear", "basket", 2, 3)),
        ("Three bowls, all of which contain two plums.", each_in("plum", "bowl", 3, 2)),
        ("Two baskets, both of which have two pears in them.", each_in("pear", "basket", 2, 2)),
        ("There are two shelves. Both of them have three books on them.", each_in("book", "shelf", 2, 3, "on")),
        ("Two cups, both of which are on a tray.", {"cup 1 on tray", "cup 2 on tray"}),
    ],
)  # fmt: skip
def test_what_both_of_them_hold_is_in_each(sentence: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(sentence).relations} == relations


@pytest.mark.parametrize(
    ("sentence", "objects", "relations"),
    [
        ("On the shelf there are two clocks, one of them an alarm clock, with a small globe between them.",
         "alarm clock, clock, shelf, small globe", "alarm clock on shelf, alarm clock right_of small globe, "
         "clock left_of small globe, clock on shelf, small globe on shelf"),
        ("Three boxes, one of which is a toolbox, stand on the bench.", "bench, box 1, box 2, toolbox",
         "box 1 on bench, box 2 on bench, toolbox on bench"),
        ("Two red cups, one of them a mug, on a tray.", "red cup, red mug, tray", "red cup on tray, red mug on tray"),
        ("Four fruits in a bowl: two of them apples, one a pear and one a plum.", "apple 1, apple 2, bowl, pear, plum",
         "apple 1 in bowl, apple 2 in bowl, pear in bowl, plum in bowl"),
        ("Two clocks, one an alarm clock and the other a wall clock.", "alarm clock, wall clock", ""),
        ("Three cups, one of them blue, on a tray.", "blue cup, cup 1, cup 2, tray",
         "blue cup on tray, cup 1 on tray, cup 2 on tray"),
        ("Two dogs, one of them with a ball.", "ball, dog 1, dog 2", "ball next_to dog 1"),
    ],
)  # fmt: skip
def test_some_of_several_are_a_kind_of_their_own(sentence: str, objects: str, relations: str):
    assert read(sentence) == (objects, relations)


@pytest.mark.parametrize(
    ("sentence", "noun", "count"),
    [
        ("Cups, six of them, on a tray.", "cup", 6),
        ("On the tray are plums, four of them, and a knife.", "plum", 4),
        ("The cups, six of them, are on the tray.", "cup", 6),
        ("Cans of tuna, six of them, in two stacks of three.", "can of tuna", 6),
        ("2 pair of gloves on a bench.", "glove", 4),
        ("A pair of gloves on a bench.", "glove", 2),
        ("Half a loaf of bread lies on a board.", "loaf", 1),
        ("Half a dozen eggs lie in a bowl.", "egg", 6),
    ],
)  # fmt: skip
def test_how_many_is_said_behind_or_by_what_they_come_in(sentence: str, noun: str, count: int):
    assert sum(noun in obj.name for obj in PLANNER.plan(sentence).objects) == count


@pytest.mark.parametrize(
    ("sentence", "objects", "relations"),
    [
        ("The owl is on the middle one of three books between two bookends.",
         "book 1, book 2, book 3, bookend 1, bookend 2, owl",
         "book 2 left_of book 3, book 2 right_of book 1, bookend 1 left_of book 1, bookend 2 right_of book 1, "
         "owl on book 2"),
        ("One of three chairs next to a table has a cushion on it.", "chair 1, chair 2, chair 3, cushion, table",
         "chair 1 next_to table, chair 2 next_to table, chair 3 next_to table, cushion on chair 1"),
        ("A lamp, one of the books lying next to it.", "book 1, book 2, book 3, lamp", "book 1 next_to lamp"),
        ("One of three chairs is next to a table.", "chair 1, chair 2, chair 3, table", "chair 1 next_to table"),
        ("There are three cups. One of the cups next to the plate is red.", "cup 1, cup 2, plate, red cup",
         "red cup next_to plate"),
    ],
)  # fmt: skip
def test_where_the_several_are_of_which_one_is_meant(sentence: str, objects: str, relations: str):
    assert read(sentence) == (objects, relations)


@pytest.mark.parametrize(
    ("sentence", "relations"),
    [
        ("There is a tray on the table with a fork and a spoon on it and a cup beside it.",
         "cup next_to tray, cup on table, fork on tray, spoon on tray, tray on table"),
        ("A tray on a desk with a fork, a knife and a spoon on it, and a cup beside it.",
         "cup next_to tray, cup on desk, fork on tray, knife on tray, spoon on tray, tray on desk"),
        ("There is a bowl on the table with an apple and a pear in it and a spoon beside it.",
         "apple in bowl, bowl on table, pear in bowl, spoon next_to bowl, spoon on table"),
        ("A desk with a lamp, a book on it and a chair behind it.", "book on desk, chair behind desk, lamp on desk"),
    ],
)  # fmt: skip
def test_what_is_listed_with_what_is_on_it_is_on_it_together(sentence: str, relations: str):
    assert read(sentence)[1] == relations


@pytest.mark.parametrize(
    ("sentence", "objects", "relations"),
    [
        ("Tea for two: two cups on saucers and a jug, all on one tray.", "cup 1, cup 2, jug, saucer 1, saucer 2, tray",
         "cup 1 on saucer 1, cup 2 on saucer 2, jug on tray, saucer 1 on tray, saucer 2 on tray"),
        ("Breakfast for two: a cup on a saucer and a jug.", "cup, jug, saucer", "cup on saucer"),
    ],
)  # fmt: skip
def test_a_meal_before_a_colon_is_a_heading(sentence: str, objects: str, relations: str):
    assert read(sentence) == (objects, relations)
    assert any(sentence.split()[0] in note for note in PLANNER.plan(sentence).notes)


ROW = "clock left_of radio, clock on shelf, radio on shelf, vase left_of clock, vase on shelf"


@pytest.mark.parametrize(
    "sentence",
    [
        "A shelf with, from one side to the other, a vase, a clock and a radio on it.",
        "On the shelf, from one end to the other, are a vase, a clock and a radio.",
        "From one end of the shelf to the other there are a vase, a clock and a radio.",
        "On the shelf, in that order, stand a vase, a clock and a radio.",
        "A vase, a clock and a radio stand on the shelf in this order.",
    ],
)
def test_an_order_without_a_direction_is_from_left_to_right(sentence: str):
    assert read(sentence) == ("clock, radio, shelf, vase", ROW)


def test_the_other_end_is_no_other_thing():
    plan = PLANNER.plan("Slide the block from one end of the table to the other.")
    assert sorted(obj.name for obj in plan.objects) == ["block", "table"]
    assert plan.task is None


@pytest.mark.parametrize(
    ("sentence", "objects", "relations"),
    [
        ("Two red cups are on a tray and two blue ones on a plate.",
         "blue cup 1, blue cup 2, plate, red cup 1, red cup 2, tray",
         "blue cup 1 on plate, blue cup 2 on plate, red cup 1 on tray, red cup 2 on tray"),
        ("The red cup is on a tray and the blue one on a plate.", "blue cup, plate, red cup, tray",
         "blue cup on plate, red cup on tray"),
    ],
)  # fmt: skip
def test_some_told_by_colour_are_where_they_are_said_to_be(sentence: str, objects: str, relations: str):
    assert read(sentence) == (objects, relations)


def test_the_red_ones_are_as_many_as_any_plural():
    plan = PLANNER.plan("The red cups are on a tray and the blue ones on a plate.")
    assert sum("blue cup" in obj.name for obj in plan.objects) == 3
    assert '"the blue ones": 3 assumed.' in plan.notes


@pytest.mark.parametrize(
    ("sentence", "tasks"),
    [
        ("There are three blocks. Stack the other two on the red one.",
         ["stack:block 1:red block", "stack:block 2:block 1"]),
        ("There are three blocks, a red, a blue and a green one. Stack the other two on the red one.",
         ["stack:blue block:red block", "stack:green block:blue block"]),
        ("Put the red block on the mat and stack the other two on it.",
         ["place:red block:mat", "stack:block 1:red block", "stack:block 2:block 1"]),
    ],
)  # fmt: skip
def test_the_other_two_are_stacked_on_the_one_that_is_told(sentence: str, tasks: list[str]):
    plan = PLANNER.plan(sentence)
    assert sum("block" in obj.name for obj in plan.objects) == 3
    assert plan.task == chain(*tasks)


@pytest.mark.parametrize(
    ("sentence", "other"),
    [
        ("The tray has a fork on it. Put it on the shelf.", "a fork"),
        ("There is a bowl with an apple in it. Pick it up.", "an apple"),
    ],
)
def test_a_note_tells_of_what_else_it_may_be(sentence: str, other: str):
    assert any(f'it may be "{other}"' in note for note in PLANNER.plan(sentence).notes)


@pytest.mark.parametrize(
    "sentence", ["The tray has a fork on it. Pick up the tray and put it on the shelf.", "There is a mug. Pick it up."]
)
def test_it_needs_no_note_where_one_thing_is_meant(sentence: str):
    assert not any("it may be" in note for note in PLANNER.plan(sentence).notes)


def test_laying_a_thing_down_is_no_task():
    assert any("no task does that" in note for note in PLANNER.plan("Lay down the cup.").notes)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("A comb is by a hat and a comb is behind a can. A box is on a desk. Pick up the one that is by the hat.",
         "pick:comb 1"),
        ("A desk holds a comb in front of a can and a comb next to a hat. A box is on it too. The robot should "
         "pick up the one that is next to the hat and place it in the box.", "place:comb 2:box"),
        ("A desk holds a comb in front of a can and a comb next to a hat. A box is on it too. Pick up the comb "
         "that is in front of the can and put it in the box.", "place:comb 1:box"),
        ("On a desk there are a pot, a fork and a towel with another fork on it. Grab the one on the towel and "
         "put it in the pot.", "place:fork 2:pot"),
        ("A desk holds a towel, a crate and an onion. Another onion is on the towel. Put the one that is on the "
         "towel in the crate.", "place:onion 2:crate"),
        ("A desk holds a towel, a crate and an onion. Another onion is on the towel. Put the onion that is on "
         "the towel in the crate.", "place:onion 2:crate"),
    ],
)  # fmt: skip
def test_the_one_that_is_somewhere_is_the_one_that_was_told_to_be_there(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


def test_the_one_that_is_somewhere_has_the_colour_and_not_its_neighbour():
    plan = PLANNER.plan("Two clocks are on a desk, one next to a lamp. The one that is next to the lamp is red.")
    assert [obj.name for obj in plan.objects if obj.colours] == ["red clock"]
    assert "red clock next_to lamp" in {str(rel) for rel in plan.relations}


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("One comb is behind a can on the desk, another comb in front of a hat.",
         {"comb 1 behind can", "comb 2 in_front_of hat", "comb 1 on desk", "comb 2 on desk", "can on desk",
          "hat on desk"}),
        ("One tennis ball is by a can on the desk, the other in front of a hat.",
         {"tennis ball 1 next_to can", "tennis ball 2 in_front_of hat", "tennis ball 1 on desk",
          "tennis ball 2 on desk", "can on desk", "hat on desk"}),
    ],
)  # fmt: skip
def test_another_behind_a_comma_is_told_of_in_a_clause_of_its_own(prompt: str, relations: set[str]):
    assert {str(rel) for rel in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    "prompt",
    [
        "A pink can, a red one and a blue one, four green combs and two grey lamps are on a desk.",
        "A desk holds a pink can, a red one and a blue one and four green combs and two grey lamps.",
    ],
)
def test_ones_in_a_list_are_of_the_kind_before_them(prompt: str):
    colours = [obj.colours for obj in PLANNER.plan(prompt).objects if obj.noun == "can"]
    assert colours == [("pink",), ("red",), ("blue",)]
