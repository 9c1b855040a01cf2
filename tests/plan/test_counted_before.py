"""A number behind a larger one of the same kind: some of those, or further ones beside another place."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def count(plan: ScenePlan, noun: str) -> int:
    return sum(obj.noun == noun for obj in plan.objects)


def relations(plan: ScenePlan) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


@pytest.mark.parametrize(
    ("prompt", "noun", "number", "expected"),
    [
        ("On the tray are two spoons and a bowl. One spoon is in the bowl. The other is beside it.", "spoon", 2,
         {("spoon 1", "in", "bowl"), ("spoon 2", "on", "tray"), ("spoon 2", "next_to", "bowl")}),
        ("There are three candles and a book on the desk. One candle is on the book.", "candle", 3,
         {("candle 1", "on", "book"), ("candle 2", "on", "desk"), ("candle 3", "on", "desk")}),
        ("Two pens and a mug are on the table. One pen is in the mug, the other next to it.", "pen", 2,
         {("pen 1", "in", "mug"), ("pen 2", "next_to", "mug"), ("pen 2", "on", "table")}),
        ("A table with two chairs. One chair is left of the table, the other right of it.", "chair", 2,
         {("chair 1", "left_of", "table"), ("chair 2", "right_of", "table")}),
        ("There are two mugs on the table. One mug contains a pen, the other mug is empty.", "mug", 2,
         {("pen", "in", "mug 1"), ("mug 1", "on", "table"), ("mug 2", "on", "table")}),
        ("There are two mugs on the table, one mug contains a pen, the other mug is empty.", "mug", 2,
         {("pen", "in", "mug 1"), ("mug 1", "on", "table"), ("mug 2", "on", "table")}),
        ("There are two cups and a plate. One cup is on the plate, one cup is behind it.", "cup", 2,
         {("cup 1", "on", "plate"), ("cup 2", "behind", "plate")}),
    ],
)  # fmt: skip
def test_one_of_what_was_counted_is_no_further_one(
    prompt: str, noun: str, number: int, expected: set[tuple[str, str, str]]
):
    plan = read(prompt)
    assert count(plan, noun) == number
    assert expected <= relations(plan)


def test_what_is_told_of_some_is_told_of_those():
    plan = read("Two apples are in the bowl. One apple is red.")
    assert [obj.colours for obj in plan.objects if obj.noun == "apple"] == [("red",), ()]
    plan = read("Six pens are in a cup. Two pens are red.")
    assert [obj.colours for obj in plan.objects if obj.noun == "pen"] == [("red",)] * 2 + [()] * 4
    assert plan.notes == ()
    plan = read("Four cups are on the counter. Two cups are upside down.")
    assert count(plan, "cup") == 4
    assert {posture.object for posture in plan.postures if posture.kind == "upside_down"} == {"cup 1", "cup 2"}
    plan = read("Two cups are on the table: one cup is upside down, the other holds a pen.")
    assert count(plan, "cup") == 2
    assert ("pen", "in", "cup 2") in relations(plan)


@pytest.mark.parametrize(
    ("prompt", "noun", "number"),
    [
        ("Two cups are on the table. One cup is on the shelf.", "cup", 3),
        ("There are two apples in the bowl. One apple is next to the bowl.", "apple", 3),
        ("Five balls are in the box. One ball lies next to it.", "ball", 6),
    ],
)
def test_what_stands_elsewhere_is_a_further_one_and_a_note_says_so(prompt: str, noun: str, number: int):
    plan = read(prompt)
    assert count(plan, noun) == number
    assert any("is read as a further one" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "noun", "number"),
    [
        ("Two cups are on the table, one cup is on the shelf.", "cup", 3),
        ("Three cups are on the table. On the shelf there is one cup.", "cup", 4),
        ("Two cups are on the tray. One cup and a spoon are on the table.", "cup", 3),
    ],
)
def test_a_number_in_a_list_or_behind_a_place_counts_anew(prompt: str, noun: str, number: int):
    assert count(read(prompt), noun) == number


@pytest.mark.parametrize(
    ("prompt", "noun", "number", "expected"),
    [
        ("3 jars stand on a bench, a plum in one jar", "jar", 3, {("plum", "in", "jar 1")}),
        ("Three jars stand on a bench. A plum is in one jar.", "jar", 3, {("plum", "in", "jar 1")}),
        ("Three jars on a bench: a plum in one jar", "jar", 3, {("plum", "in", "jar 1")}),
        ("Three jars on a bench - one jar holds a plum", "jar", 3, {("plum", "in", "jar 1")}),
        ("Three jars on a bench (a plum in one jar)", "jar", 3, {("plum", "in", "jar 1")}),
        ("Three jars on a bench, one jar holding a plum", "jar", 3, {("plum", "in", "jar 1")}),
        ("Two clay jars on a bench, a plum beside one jar", "clay jar", 2, {("plum", "next_to", "clay jar 1")}),
        ("Two green jars and a white jar on a bench, a plum in one green jar", "jar", 3,
         {("plum", "in", "green jar 1")}),
        ("Three jars on a bench, a plum in one jar, a nut in another jar", "jar", 3,
         {("plum", "in", "jar 1"), ("nut", "in", "jar 2")}),
        ("Three jars on a bench. One jar holds a plum. Another jar holds a key.", "jar", 3,
         {("plum", "in", "jar 1"), ("key", "in", "jar 2")}),
        ("Three jars on a bench, a plum in one of the jars, a key in another of the jars", "jar", 3,
         {("plum", "in", "jar 1"), ("key", "in", "jar 2")}),
        ("Two benches: three jars on one bench, two jars on the other bench", "bench", 2,
         {("jar 3", "on", "bench 1"), ("jar 4", "on", "bench 2")}),
    ],
)  # fmt: skip
def test_one_of_them_carries(prompt: str, noun: str, number: int, expected: set[tuple[str, str, str]]):
    plan = read(prompt)
    assert sum(obj.name.rstrip(" 0123456789").endswith(noun) for obj in plan.objects) == number
    assert expected <= relations(plan)
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("prompt", "number"),
    [
        ("Two jars and one jar on a bench", 3),
        ("Two jars on a bench and another jar on a stool", 3),
        ("Three black jars on a bench, a pen in one white jar", 4),
        ("A pen in one jar and a key in one jar", 2),
        ("One jar stands on a bench.", 1),
    ],
)
def test_one_more_stays_one_more(prompt: str, number: int):
    plan = read(prompt)
    assert sum("jar" in obj.name for obj in plan.objects) == number


@pytest.mark.parametrize(
    ("prompt", "noun", "number"),
    [
        ("Four knives and four spoons: four each, on a placemat.", "placemat", 1),
        ("Two lemons, two limes and two kiwis, two each, in a bowl.", "fruit bowl", 1),
        ("Three pens and three pencils, three each, lie on a notebook.", "notebook", 1),
        ("Forks and spoons, five each, on a tray.", "tray", 1),
        ("Forks and spoons, five each, on a tray.", "fork", 5),
        ("As many cups as saucers, four each, on a tray.", "saucer", 4),
        ("On the table are knives and forks, four each.", "knife", 4),
    ],
)
def test_so_many_each_counts_two_kinds_and_not_what_carries_them(prompt: str, noun: str, number: int):
    plan = read(prompt)
    assert count(plan, noun) == number
    assert not any("each" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "counts", "expected"),
    [
        ("beaker x3, flask x2, all on bench, flasks behind beakers", {"beaker": 3, "flask": 2},
         {("flask 1", "behind", "beaker 1"), ("flask 1", "on", "bench")}),
        ("cup x2, plate x3, cups left of plates", {"cup": 2, "plate": 3}, {("cup 1", "left_of", "plate 1")}),
        ("vial x4, syringe x1, all on tray, syringe behind vials", {"vial": 4, "syringe": 1},
         {("syringe", "behind", "vial 1"), ("syringe", "on", "tray")}),
        ("2 cans, 1 bottle; bottle behind cans", {"can": 2, "bottle": 1}, {("bottle", "behind", "can 1")}),
        ("3 cubes, 3 balls, balls on cubes", {"cube": 3, "ball": 3}, {("ball 1", "on", "cube 1")}),
        ("Five books on the shelf, books on the floor.", {"book": 8}, {("book 1", "on", "shelf")}),
    ],
)  # fmt: skip
def test_a_plural_of_what_the_list_has_counted_means_those(
    prompt: str, counts: dict[str, int], expected: set[tuple[str, str, str]]
):
    plan = read(prompt)
    assert {noun: count(plan, noun) for noun in counts} == counts
    assert expected <= relations(plan)


@pytest.mark.parametrize(
    "prompt",
    [
        "The lamp stands on the bedside table left of the bed, and the clock on the one to the right of it.",
        "There are two tables. A lamp is on the table left of the bed and a clock is on the one right of the bed.",
        "The lamp stands on the table left of the bed. The clock is on the one to the right of it.",
    ],
)
def test_the_one_that_carries_is_of_the_kind_of_what_carries(prompt: str):
    plan = read(prompt)
    tables = [obj.name for obj in plan.objects if obj.noun in ("table", "bedside table")]
    assert len(tables) == 2
    assert count(plan, "lamp") == 1
    assert {("lamp", "on", tables[0]), (tables[0], "left_of", "bed")} <= relations(plan)
    assert {rel.parent for rel in plan.relations if "clock" in rel.child and rel.supports} == {tables[1]}


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("Red box left, green box right, blue box on top of both.", "blue box"),
        ("Two books next to each other and a mug on top of both.", "mug"),
        ("A red cube and a blue cube stand side by side. A green cube lies on top of both.", "green cube"),
    ],
)
def test_one_thing_lies_on_top_of_both(prompt: str, noun: str):
    plan = read(prompt)
    assert sum(obj.phrase.lower().endswith(noun) for obj in plan.objects) == 1
    assert any(one.kind == "across" and len(one.of) == 2 for one in plan.arrangements)


def test_of_likes_that_were_named_one_by_one():
    plan = read("A red cup and a blue cup are on the tray. One cup holds a pen, the other a spoon.")
    assert {("pen", "in", "red cup"), ("spoon", "in", "blue cup")} <= relations(plan)
    assert count(plan, "cup") == 2
    plan = read("A stack of four books is on the desk. One book is red.")
    assert [obj.colours for obj in plan.objects if obj.noun == "book"] == [("red",), (), (), ()]
    assert count(read("A cup is on the shelf. One cup is on the table."), "cup") == 2


@pytest.mark.parametrize(
    ("prompt", "noun", "number", "expected"),
    [
        ("a pair of slippers beside a basket, one slipper in the basket", "slipper", 2,
         {("slipper 1", "in", "basket"), ("slipper 2", "next_to", "basket")}),
        ("a pair of brown boots in front of a crate, with one boot partly inside the crate", "boot", 2,
         {("brown boot 1", "in", "crate"), ("brown boot 2", "in_front_of", "crate")}),
        ("three magazines on a desk, one magazine leaning against a vase", "magazine", 3,
         {("vase", "on", "desk"), ("magazine 3", "on", "desk")}),
        ("Three candles on a shelf, one candle behind a clock", "candle", 3,
         {("candle 1", "behind", "clock"), ("clock", "on", "shelf")}),
        ("two crates on the floor, with one crate on a chair", "crate", 2, {("crate 1", "on", "chair")}),
        ("A bench with four pencils, one pencil in a mug.", "pencil", 4,
         {("pencil 1", "in", "mug"), ("mug", "on", "bench"), ("pencil 2", "on", "bench")}),
        ("three forks next to a jar, with one fork in it", "fork", 3,
         {("fork 1", "in", "jar"), ("fork 2", "next_to", "jar")}),
        ("two mugs with one mug holding a fork", "mug", 2, {("fork", "in", "mug 1")}),
        # What stands on another piece of furniture, or in another dish, is one more.
        ("Two mugs are on the table, and one mug is on the shelf.", "mug", 3, {("mug 3", "on", "shelf")}),
        ("two pears on a plate, one pear in a bowl", "pear", 3, {("pear 3", "in", "bowl")}),
        ("three lamps on a table and one lamp on a chair", "lamp", 4, {("lamp 4", "on", "chair")}),
        ("two red jars and one blue jar on a tray", "jar", 3, {("blue jar", "on", "tray")}),
    ],
)  # fmt: skip
def test_one_behind_several_is_one_of_them_where_it_can_stand_among_them(prompt, noun, number, expected):
    plan = read(prompt)
    assert count(plan, noun) == number
    assert expected <= relations(plan)


@pytest.mark.parametrize("opens", [", one can", ", and one can", ", with one can", " with one can"])
def test_one_that_is_upside_down_is_one_of_those_before(opens):
    plan = read(f"Three cans on a bench{opens} upside down")
    assert count(plan, "can") == 3
    assert relations(plan) == {(f"can {n}", "on", "bench") for n in (1, 2, 3)}
    assert [each.object for each in plan.postures] == ["can 1"]
