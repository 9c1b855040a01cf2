"""Sentences that were read as something else without a note: each is read as said now, or a note names what is not."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A cup is near the lamp and the clock.", {"cup next_to lamp", "cup next_to clock"}),
        ("The fork is to the left of the plate and the bowl.", {"fork left_of plate", "fork left_of bowl"}),
        ("The green box is smaller than the red box and on top of it.", {"green box on red box"}),
        ("The green box is smaller than the red box and behind it.", {"green box behind red box"}),
        ("a plate with a spoon on the left and a fork on the right, and a mug in front of the fork",
         {"spoon left_of plate", "fork right_of plate", "mug in_front_of fork"}),
        ("a backpack with a doll on top", {"doll on backpack"}),
        ("Put a single apple and pear from the basket onto the plate.", {"apple in basket", "pear in basket"}),
        ("The ball is out of the basket.", {"ball next_to basket"}),
        ("Move the jug from the foot of the lamp to the tray.", {"jug next_to lamp"}),
        ("A cup is on the table and a plate is near the lamp.", {"cup on table", "plate next_to lamp"}),
    ],
)  # fmt: skip
def test_is_read_as_said(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("Two candles stand on a tray. Around them are a vase and a mug.",
         'not arranged: "a vase" and "a mug" around "Two candles" together; it is placed around the first'),
        ("Two candles surrounded by a plate, a vase and a mug.",
         'not arranged: "a vase" around "Two candles" together; it is placed around the first'),
        ("A spoon is under the book and the shelf.",
         'not arranged: "A spoon" under "the book" and "the shelf"; it is placed next to it'),
        ("The egg is on the cup and the plate.",
         'not arranged: "The egg" on "the cup" and "the plate" together; it is placed on the first'),
        ("The tomato is on the round bun and the pizza.",
         'not arranged: "The tomato" on "the round bun" and "the pizza" together; it is placed on the first'),
        ("a box with a brontosaurus stuffed head on top",
         'not modelled: "brontosaurus" of "a brontosaurus stuffed head"'),
        ("Stack the three bowls, the green one at the bottom, the red one on top.",
         'not modelled: "Stack the three bowls, the green one at the bottom, the red one on top": no task does that.'),
        ("Pick up the largest jug.", 'not modelled: "largest" of "jug": there is only one'),
        ("A pen is on the second shelf and a book on the fourth shelf.",
         'counted otherwise: "the fourth shelf"; there are 2'),
        ("The green jug and the yellow jug stand on matching colored trays.",
         'not as said: "matching": "green jug" and "red tray" have two colours'),
        ("A lamp is over a table.", 'not arranged: "A lamp" over "a table"; it is placed on it'),
        ("The tower with three bricks has a red brick at the top.",
         'counted otherwise: "three bricks"; 4 are stacked'),
        ("A caramel-colored jug.", 'not modelled: "caramel-colored" of "A caramel-colored jug"'),
        ("A flock of sheep.", '"A flock of sheep": 3 assumed.'),
        ("A coffee cup with latte art.", '"latte art" is made as a "sculpture"'),
    ],
)  # fmt: skip
def test_what_is_not_as_said_is_in_a_note(prompt: str, note: str):
    assert note in PLANNER.plan(prompt).notes


def test_what_several_stand_around_is_one_of_them():
    relations = PLANNER.plan("Two candles stand on a tray. Around them are a plate, a vase and a mug.").relations
    assert {relation.parent for relation in relations if relation.kind == "around"} == {"candle 1"}


def test_a_ring_of_one_kind_is_shared_out_without_a_note():
    plan = PLANNER.plan("Two tables, each with four chairs around it.")
    assert not [note for note in plan.notes if "together" in note]


def test_what_lies_flat_on_its_side_does():
    plan = PLANNER.plan("A bottle lies flat on its side.")
    assert [(one.object, one.kind) for one in plan.postures] == [("bottle", "on_its_side")]
    assert plan.notes == ()


def test_what_is_at_the_bottom_stands_by_nothing_before_the_task():
    plan = PLANNER.plan("Stack the three bowls, the green one at the bottom, the red one on top.")
    assert plan.relations == ()


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A pan with a steak and a fork next to it.", {"steak in pan", "fork next_to pan"}),
        ("A tray with a jug and a lemon beside it.", {"jug on tray", "lemon next_to tray"}),
        ("A crate on a desk with a ball, a doll and a roll of tape inside.",
         {"crate on desk", "ball in crate", "doll in crate", "roll of tape in crate"}),
        ("The desk holds a vise, a lamp and two coins in a small bowl.",
         {"vise on desk", "lamp on desk", "small bowl on desk", "coin 1 in small bowl", "coin 2 in small bowl"}),
        ("A spoon and a pen in a mug.", {"spoon in mug", "pen in mug"}),
    ],
)  # fmt: skip
def test_what_is_in_something_stays_there(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("On the desk to the right of the lamp lies a pen.", {"pen on desk", "lamp on desk", "pen right_of lamp"}),
        ("On the desk, behind the lamp, there is a pen.", {"pen on desk", "lamp on desk", "pen behind lamp"}),
        ("On the desk next to the lamp are a pen and a book.",
         {"pen on desk", "book on desk", "lamp on desk", "pen next_to lamp", "book next_to lamp"}),
        ("Behind the bed, next to the chair, stands a lamp.", {"lamp behind bed", "lamp next_to chair"}),
        ("On the rug next to the bed stands a lamp.", {"lamp on rug", "rug next_to bed"}),
        ("A pen is left of the lamp, behind the book, and in front of the vase.",
         {"pen left_of lamp", "pen behind book", "pen in_front_of vase"}),
        ("The pen is left of the lamp, it is behind the book, and it is in front of the vase.",
         {"pen left_of lamp", "pen behind book", "pen in_front_of vase"}),
    ],
)  # fmt: skip
def test_every_place_is_that_of_the_subject(prompt: str, relations: set[str]):
    plan = PLANNER.plan(prompt)
    assert {str(relation) for relation in plan.relations} == relations
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("prompt", "carried"),
    [
        ("A shelf with five mugs, two of them on the floor.", 3),
        ("A basket with four lemons, one of them on the ground.", 3),
        ("A lamp on a desk on the floor.", 1),
    ],
)
def test_some_of_what_something_has_stands_on_the_floor(prompt: str, carried: int):
    assert sum(relation.supports for relation in PLANNER.plan(prompt).relations) == carried


def test_in_front_of_what_carries_the_rest_is_said_to_be_read_so():
    notes = PLANNER.plan("A crate with six lemons, two of them in front.").notes
    assert '"in front" is read as said of "A crate".' in notes


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A tray on a desk with a plum on it.", {"tray on desk", "plum on tray"}),
        ("There is a chessboard on the desk with a king on it.", {"chessboard on desk", "chess king on chessboard"}),
        ("A lamp on a desk with a book on it.", {"lamp on desk", "book on desk"}),
        ("A mug next to a plate with a bun on it.", {"mug next_to plate", "bun on plate"}),
    ],
)
def test_what_is_on_it_is_on_the_dish_that_is_told_of(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "name"),
    [
        ("A green chair and a matching stool stand on a mat.", "green stool"),
        ("A wooden crate and two matching bowls are on a desk.", "wooden bowl 2"),
        ("A steel pot and bowl are on a table.", "steel bowl"),
        ("A wooden table and bench.", "wooden bench"),
        ("A wooden bowl and banana.", "banana"),
        ("A wooden table and sofa.", "sofa"),
    ],
)
def test_what_matches_and_what_is_listed_is_of_the_same_colour_and_material(prompt: str, name: str):
    plan = PLANNER.plan(prompt)
    assert name in {obj.name for obj in plan.objects}
    assert not plan.notes


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        ("A blue chair on a mat with two matching stools.", "matching"),
        ("Put the pen in the other drawer.", "other"),
        ("Put the pen in a different mug.", "different"),
        ("Take the remaining fork.", "remaining"),
        ("A jug with a dark circle on it.", "dark circle on it"),
    ],
)
def test_a_word_without_effect_is_in_a_note(prompt: str, said: str):
    assert any(f'"{said}"' in note for note in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize(
    ("prompt", "colour"),
    [
        ("The jug on the tray is green in color.", "green"),
        ("The jug on a tray has a green colour.", "green"),
        ("A jug of a green color stands on a tray.", "green"),
    ],
)
def test_a_colour_by_its_noun_is_that_of_the_thing(prompt: str, colour: str):
    assert {(obj.name, obj.colours) for obj in PLANNER.plan(prompt).objects} == {
        (f"{colour} jug", (colour,)),
        ("tray", ()),
    }


@pytest.mark.parametrize(
    "prompt",
    [
        "A fork is on one plate and a spoon on another plate.",
        "Put the green pen in the mug and the blue pen in the other mug.",
        "Four chairs around a table and a lamp.",
    ],
)
def test_no_further_one_is_missed_where_there_is_one(prompt: str):
    notes = PLANNER.plan(prompt).notes
    assert not any("there is only one" in note or "nothing stands around" in note for note in notes)


@pytest.mark.parametrize("prompt", ["A jug with a square on it.", "A jug with two red circles on it."])
def test_what_is_drawn_on_a_thing_is_no_second_one(prompt: str):
    plan = PLANNER.plan(prompt)
    assert [obj.name for obj in plan.objects] == ["jug"]
    assert any("on it" in note for note in plan.notes)
