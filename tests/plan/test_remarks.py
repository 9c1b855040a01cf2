"""What a sentence remarks of its things, amounts that are worked out, and words before the scene begins."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "objects", "relations", "noted"),
    [
        ("A desk fan, switched off, stands on a filing cabinet.", "desk fan, filing cabinet",
         "desk fan on filing cabinet", "switched off"),
        ('A cardboard box marked "fragile" on a pallet.', "cardboard box, pallet", "cardboard box on pallet",
         "marked fragile"),
        ("A phone charges on top of a book.", "phone, book", "phone on book", "charges"),
        ("Two slices of pizza on a plate.", "pizza 1, pizza 2, plate", "pizza 1 on plate, pizza 2 on plate", "slices"),
        ("Lift the bucket to an upright position.", "bucket", "", "to an upright position"),
        ("Take the cake out of the toaster.", "cake, toaster", "cake on toaster", "inside"),
        ("A laptop open on a desk.", "laptop, desk", "laptop on desk", "open"),
        ("Three candles, though of different heights, stand on a tray.", "candle 1, candle 2, candle 3, tray",
         "candle 1 on tray, candle 2 on tray, candle 3 on tray", "though of different heights"),
        ("A desk: monitor, keybord.", "desk, monitor, keyboard", "monitor on desk, keyboard on desk", "keybord"),
        ("Put the fork in the ceramicmug.", "fork, ceramic mug", "", "ceramicmug"),
    ],
)  # fmt: skip
def test_what_no_scene_has_is_left_out_and_named(sentence, objects, relations, noted):
    plan = PLANNER.plan(sentence)
    assert ", ".join(obj.name for obj in plan.objects) == objects
    assert ", ".join(map(str, plan.relations)) == relations
    assert any(noted in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "fault"),
    [
        ("A box of tissues is lying on the dashboard.", '"dashboard"'),
        ("A mug is on a table. Next to the mug is a bagpipe.", '"bagpipe"'),
        ("A chair, its back to a desk, with a bagpipe over it.", '"bagpipe"'),
        ("A plate of broccoli, polenta and pasta.", '"polenta"'),
        ("A dial lies on a table.", '"dial"'),
        ("A lemon rolls off the table.", '"rolls"'),
    ],
)
def test_a_thing_that_cannot_be_made_is_no_remark(sentence, fault):
    with pytest.raises(PromptError, match=fault):
        PLANNER.plan(sentence)


def test_a_later_sentence_about_looks_is_named_and_set_aside():
    plan = PLANNER.plan("A red ball lies on a table. Softly and somehow the ball quivers.")
    assert [obj.name for obj in plan.objects] == ["red ball", "table"]
    assert any("quivers" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "plainly"),
    [
        ("Half of the eight blocks are red, the others are blue.", "Eight blocks: four of them red, the others blue."),
        ("Six cups, all but one upside down, on a shelf.", "Six cups, five of them upside down, on a shelf."),
        ("Five candles, all red except the last one.", "Five candles, four of them red."),
        ("Six apples are divided equally between two bowls.", "Three apples are in each of two bowls."),
        ("Eight plums are evenly split among the four jars.", "Two plums are in each of four jars."),
        ("The tray is empty except for a pen.", "A pen is on the tray."),
        (
            "The left cup holds a spoon, the right cup a fork.",
            "The left cup holds a spoon, the right one holds a fork.",
        ),
        (
            "A laptop, to its left a mug, to its right a lamp.",
            "A laptop, to the left of it a mug, to the right of it a lamp.",
        ),
        ("She left her hat on the bed.", "Her hat is on the bed."),
        ("Five cans form a row on a shelf.", "Five cans are in a row on a shelf."),
        ("The tray carries only a cup, and next to that a bowl.", "The tray carries a cup, and next to it a bowl."),
        ("A table (wood); 2 x egg on the table.", "A wood table; 2 eggs on the table."),
    ],
)
def test_a_construction_says_what_plainer_words_say(sentence, plainly):
    said, plain = PLANNER.plan(sentence), PLANNER.plan(plainly)
    assert sorted((obj.noun, *obj.colours) for obj in said.objects) == sorted(
        (obj.noun, *obj.colours) for obj in plain.objects
    )
    nouns = {obj.name: obj.noun for plan in (said, plain) for obj in plan.objects}
    edges = [
        sorted((nouns[rel.child], rel.kind, nouns[rel.parent]) for rel in plan.relations) for plan in (said, plain)
    ]
    assert edges[0] == edges[1]
    assert sorted(str(each.kind) for each in said.postures) == sorted(str(each.kind) for each in plain.postures)


@pytest.mark.parametrize(
    ("sentence", "relations"),
    [
        ("A basket with two figs, a bowl with an egg, and a tray with a cup.",
         ["cup on tray", "egg in bowl", "fig 1 in basket", "fig 2 in basket"]),
        ("Cups and plates on two trays.",
         ["cup 1 on tray 1", "cup 2 on tray 2", "cup 3 on tray 1", "plate 1 on tray 2", "plate 2 on tray 1",
          "plate 3 on tray 2"]),
        ("The left tray carries three muffins, the right one carries a knife.",
         ["knife on tray 2", "muffin 1 on tray 1", "muffin 2 on tray 1", "muffin 3 on tray 1",
          "tray 2 right_of tray 1"]),
        ("Two lamps flank the bed, each on its own nightstand.",
         ["lamp 1 on nightstand 1", "lamp 2 on nightstand 2", "nightstand 1 left_of bed", "nightstand 2 right_of bed"]),
        ("Eight cans are stacked two high on a shelf.",
         ["can 1 on shelf", "can 2 on can 1", "can 3 on shelf", "can 4 on can 3", "can 5 on shelf", "can 6 on can 5",
          "can 7 on shelf", "can 8 on can 7"]),
        ("One cup is on the table, the other two are on the shelf.",
         ["cup 1 on table", "cup 2 on shelf", "cup 3 on shelf"]),
        ("There are two trays: on one a pear, on the other a fig.", ["fig on tray 2", "pear on tray 1"]),
        ("Six balls of different colors are in a box.",
         [f"{hue} ball in box" for hue in ("blue", "green", "orange", "purple", "red", "yellow")]),
        ("Four chairs, two on either side of a table.",
         ["chair 1 left_of table", "chair 2 left_of table", "chair 3 right_of table", "chair 4 right_of table"]),
        ("A table surrounded by two chairs on a rug.",
         ["chair 1 around table", "chair 1 on rug", "chair 2 around table", "chair 2 on rug", "table on rug"]),
        ("Three cups around a teapot on a tray.",
         ["cup 1 around teapot", "cup 1 on tray", "cup 2 around teapot", "cup 2 on tray", "cup 3 around teapot",
          "cup 3 on tray", "teapot on tray"]),
        ("A screw has fallen out of the box and lies beside it.", ["screw next_to box"]),
        ("Stack of books on a desk.", ["book 1 on desk", "book 2 on book 1", "book 3 on book 2", "book 4 on book 3"]),
    ],
)  # fmt: skip
def test_who_stands_where(sentence, relations):
    assert sorted(map(str, PLANNER.plan(sentence).relations)) == relations


def test_colours_in_brackets_are_shared_out():
    plan = PLANNER.plan("There are three boxes of different colors (red, blue, and green) on a table.")
    assert [(obj.noun, *obj.colours) for obj in plan.objects][:3] == [("box", "red"), ("box", "blue"), ("box", "green")]


@pytest.mark.parametrize(
    ("sentence", "fault"),
    [
        ("All the cups but one are on a tray.", r'^"all ... but one" \(word 4\): of how many is not said'),
        ("A beard on a table.", '^"beard" is not in the catalogue'),
        ("Five of the cups, all but the red one, are here.", r'^"all" \(word 5\): a prompt says what is there'),
    ],
)
def test_the_word_at_fault_is_named(sentence, fault):
    with pytest.raises(PromptError, match=fault):
        PLANNER.plan(sentence)


@pytest.mark.parametrize(
    ("sentence", "task", "noted"),
    [
        ("Put the can into the grey bin to discard it.", "place:can:gray bin", ""),
        ("Put the marker in the mug, make sure the marker stands upright.", "place:marker:mug", "make sure"),
        ("Could you hand me the screwdriver lying beside the toolbox?", "pick:screwdriver", ""),
    ],
)
def test_what_is_to_be_done_is_heard_among_purposes_and_care(sentence, task, noted):
    plan = PLANNER.plan(sentence)
    assert plan.task == task
    assert not noted or any(noted in note for note in plan.notes)
