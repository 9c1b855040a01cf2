"""What is "on it", beside both, on the other of two, among the others: places as everyday sentences tell them."""

from __future__ import annotations

from collections import Counter

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def told(plan: ScenePlan) -> set[str]:
    return {f"{each.child} {each.kind} {each.parent}" for each in plan.relations}


def counts(plan: ScenePlan) -> Counter[str]:
    return Counter(obj.noun for obj in plan.objects)


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("A tray is in the middle of the table with a cup on it.", {"tray on table", "cup on tray"}),
        ("A plate lies in the corner of the desk with a bun on it.", {"plate on desk", "bun on plate"}),
        ("A bowl stands at the edge of a bench with an egg in it.", {"bowl on bench", "egg in bowl"}),
        ("A chair stands in the middle of a rug with a cat on it.", {"chair on rug", "cat on chair"}),
        ("A cutting board is in the middle of the table with a knife and a tomato on it.",
         {"cutting board on table", "knife on cutting board", "tomato on cutting board"}),
        ("A cutting board lies on the counter with an onion and a tomato on it.",
         {"cutting board on counter", "onion on cutting board", "tomato on cutting board"}),
        # What hardly carries them leaves them to the table.
        ("A vase stands in the corner of the table with a laptop on it.", {"vase on table", "laptop on table"}),
        ("A lamp stands on a desk with a laptop and a book on it.", {"lamp on desk", "laptop on desk", "book on desk"}),
    ],
)  # fmt: skip
def test_what_is_on_it_is_on_what_the_sentence_is_about(prompt: str, there: set[str]):
    assert there <= told(read(prompt))


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("A kettle is to the left of the stove and to the right of the sink.",
         {"kettle left_of stove", "kettle right_of sink"}),
        ("A bin is next to the fridge and to the right of the counter.",
         {"bin next_to fridge", "bin right_of counter"}),
        ("A lamp stands next to the sofa and behind the armchair.", {"lamp next_to sofa", "lamp behind armchair"}),
        ("A drill lies next to its battery and charger on a workbench.",
         {"drill next_to battery", "drill next_to charger", "charger on workbench", "drill on workbench"}),
        ("On a desk, a mug next to a pen and ruler.", {"mug next_to pen", "mug next_to ruler", "mug on desk"}),
        ("A book lies on the sofa next to a cushion and a blanket.",
         {"book on sofa", "book next_to cushion", "book next_to blanket"}),
        # Each has its own place.
        ("A pen is on a book and ruler is on a box.", {"pen on book", "ruler on box"}),
        ("A mug is next to a plate and a bowl is next to a cup.", {"mug next_to plate", "bowl next_to cup"}),
    ],
)  # fmt: skip
def test_one_thing_is_beside_all_that_are_named(prompt: str, there: set[str]):
    plan = read(prompt)
    assert there <= told(plan)
    assert {each for each in told(plan) if " on " not in each} == {each for each in there if " on " not in each}


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("Two trays stand on a desk. The left one carries an apple, and on the other there is a knife.",
         {"apple on tray 1", "knife on tray 2"}),
        ("Two trays lie side by side. The left one carries an apple. On the other is a knife.",
         {"apple on tray 1", "knife on tray 2"}),
        ("Two plates are on a table. The left plate holds a bun. On the other is a pear.",
         {"bun on plate 1", "pear on plate 2"}),
        ("Two plates, a bun on one and a pear on the other.", {"bun on plate 1", "pear on plate 2"}),
        ("Two trays lie side by side. The left one carries an apple, and the other a lemon.",
         {"apple on tray 1", "lemon on tray 2"}),
        # Of a side it is the other side.
        ("On one side of the desk is a lamp, on the other a vase.", {"lamp left_of desk", "vase right_of desk"}),
        ("A desk has a lamp on one side and a vase on the other.", {"lamp left_of vase"}),
    ],
)  # fmt: skip
def test_the_other_of_two_is_a_thing_and_of_a_side_a_side(prompt: str, there: set[str]):
    plan = read(prompt)
    assert there <= told(plan)
    assert counts(plan)["tray"] in (0, 2)


@pytest.mark.parametrize(
    ("prompt", "noun", "colours"),
    [
        ("Five bottles stand in a row on the bench. The middle one is red, the others are green.",
         "bottle", {"red": 1, "green": 4}),
        ("Four cups stand in a row. The left one is red and the rest are blue.", "cup", {"red": 1, "blue": 3}),
        ("A stack of four boxes; the top one is red, the others are blue.", "box", {"red": 1, "blue": 3}),
        ("Five cubes in a line. The first is red, the last is blue, the other three are white.",
         "cube", {"red": 1, "blue": 1, "white": 3}),
        ("Three cups on a tray. The left one is red, the middle one is green, the other is blue.",
         "cup", {"red": 1, "green": 1, "blue": 1}),
    ],
)  # fmt: skip
def test_the_others_of_a_row_are_those_no_place_told_of(prompt: str, noun: str, colours: dict[str, int]):
    plan = read(prompt)
    assert Counter(colour for obj in plan.objects if obj.noun == noun for colour in obj.colours) == colours
    assert counts(plan)[noun] == sum(colours.values())


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("A cup and a plate are on a table. A spoon lies to their left.", {"spoon left_of cup", "spoon left_of plate"}),
        ("A cup and a plate are on a table. To their right is a candle.", {"candle right_of plate"}),
        ("Two mugs stand on a desk with a pen to their left.", {"pen left_of mug 1", "pen left_of mug 2"}),
        ("A plate with a fork on its left side and a knife on its right side.",
         {"fork left_of plate", "knife right_of plate"}),
    ],
)  # fmt: skip
def test_their_left_is_left_of_them(prompt: str, there: set[str]):
    assert there <= told(read(prompt))


@pytest.mark.parametrize("joined", [".", ", and the blue one lies next to it.", ". The blue one lies next to them."])
def test_one_of_several_stacked_on_another_leaves_the_rest(joined: str):
    plan = read(
        f"There are three cubes on the table: red, green and blue. The green cube is stacked on the red one{joined}"
    )
    supports = {each for each in told(plan) if " on " in each}
    assert supports == {"red cube on table", "blue cube on table", "green cube on red cube"}


def test_opposite_each_other_is_facing_and_opposite_one_thing_is_noted():
    facing = read("Two chairs stand opposite each other at a table.").arrangements
    assert [each.kind for each in facing] == ["facing"]
    assert any('"opposite"' in note for note in read("A plate is opposite a bowl.").notes)
    sides = told(read("Two chairs stand on opposite sides of a table."))
    assert {"chair 1 left_of table", "chair 2 right_of table"} <= sides


@pytest.mark.parametrize(
    ("prompt", "on", "goal"),
    [
        ("Fill the basket with the oranges lying on the counter.", "orange 1 on counter", "place:orange 1:basket"),
        ("Fill the box with the blocks that are on the rug.", "block 1 on rug", "place:block 1:box"),
        ("Load the tray with the two mugs standing on the shelf.", "mug 1 on shelf", "place:mug 2:tray"),
    ],
)
def test_what_something_is_filled_with_is_moved_from_where_it_is(prompt: str, on: str, goal: str):
    plan = read(prompt)
    assert on in told(plan)
    assert goal in " ".join((str(plan.task), *plan.notes))


def test_all_that_something_is_filled_with_is_moved():
    plan = read("Fill the box with the apple and the pear.")
    assert (plan.task, plan.notes) == (chain("place:apple:box", "place:pear:box"), ())


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("Three glasses stand on the bar.", "counter"),
        ("A cushion lies on the sofa.", "pillow"),
        ("A cushion lies on the floor.", "floor cushion"),
        ("A bar and a towel lie on the sink.", "soap"),
    ],
)
def test_company_tells_which_bar_and_which_cushion(prompt: str, noun: str):
    assert noun in counts(read(prompt))


@pytest.mark.parametrize(
    ("prompt", "there", "objects"),
    [
        ("Pens in a mug, mug on a book.", {"mug on book", "pen 1 in mug"}, 5),
        ("Apples in a bowl, bowl on a table.", {"bowl on table", "apple 1 in bowl"}, 5),
        ("A lamp on a desk, desk next to a bed.", {"lamp on desk", "desk next_to bed"}, 3),
        ("A box is on the table, box is red.", {"red box on table"}, 2),
    ],
)
def test_a_bare_name_behind_a_comma_is_said_of_what_was_named(prompt: str, there: set[str], objects: int):
    plan = read(prompt)
    assert there <= told(plan)
    assert len(plan.objects) == objects


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A mug on a tray, mug on a book.", "mug"),
        ("A knife, fork, and knife on a table.", "knife"),
        ("A red cube and cube.", "cube"),
    ],
)
def test_a_bare_name_in_a_list_or_with_another_place_is_another(prompt: str, noun: str):
    assert counts(read(prompt))[noun] == 2


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("A box is on the floor. In the box there is a smaller box, and inside that one lies a coin.",
         {"smaller box in box", "coin in smaller box"}),
        ("In the box is a smaller box, and in that one is a coin.", {"smaller box in box", "coin in smaller box"}),
        ("A basket holds a bowl. In that one is an apple.", {"bowl in basket", "apple in bowl"}),
    ],
)  # fmt: skip
def test_that_one_is_what_was_named_last(prompt: str, there: set[str]):
    assert there == {each for each in told(read(prompt)) if " in " in each}


@pytest.mark.parametrize(
    "prompt",
    ["Four chairs surround a table, one on each side.", "Four chairs stand around a table, one on each side.",
     "The table is surrounded by four chairs, one at each side.", "A table with four chairs, one on each side."],
)  # fmt: skip
def test_one_on_each_of_four_sides_is_around(prompt: str):
    plan = read(prompt)
    assert counts(plan) == {"chair": 4, "table": 1}
    assert {f"chair {at} around table" for at in range(1, 5)} == told(plan)


def test_one_on_each_side_of_two_is_left_and_right():
    there = told(read("Two lamps stand next to a bed, one on each side."))
    assert {"lamp 1 left_of bed", "lamp 2 right_of bed"} <= there
