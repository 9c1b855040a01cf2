"""Which of two or more is meant: "the other", "the one on the chair", "each on its own plate", "the tall ones"."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import told


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "A green bowl and a white bowl are on a bench. Put the green bowl on the tray and the egg in the other.",
            (
                "green bowl, white bowl, bench, tray, egg",
                "green bowl on bench, white bowl on bench",
                "place:green bowl:tray, place:egg:white bowl",
                [],
            ),
        ),
        (
            "There is a large box and a small box. Put the large box on the shelf, then put the ball in the other.",
            ("large box, small box, shelf, ball", "", "place:large box:shelf, place:ball:small box", []),
        ),
        (
            "There is a wooden crate and a plastic crate. The wooden crate holds a hammer, and a saw is in the other.",
            ("wooden crate, plastic crate, hammer, saw", "hammer in wooden crate, saw in plastic crate", None, []),
        ),
        (
            "A red cup is next to a blue cup. A pen is in the red cup and a ruler is in the other.",
            ("red cup, blue cup, pen, ruler", "pen in red cup, ruler in blue cup, red cup next_to blue cup", None, []),
        ),
    ],
)
def test_the_other_is_one_of_two_alike(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "Put the towel in the basket and the one on the chair on the bench.",
            (
                "towel 1, basket, towel 2, chair, bench",
                "towel 2 on chair",
                "place:towel 1:basket, place:towel 2:bench",
                [],
            ),
        ),
        (
            "Put the mug that is on the tray in the basket and the one on the shelf next to the basket.",
            (
                "mug 1, tray, basket, mug 2, shelf",
                "mug 1 on tray, mug 2 on shelf",
                "place:mug 1:basket, beside:mug 2:next_to:basket",
                [],
            ),
        ),
        (
            "Put the red jar and the one on the stool in the sink.",
            ("red jar, jar, stool, sink", "jar on stool", "place:red jar:sink, place:jar:sink", []),
        ),
        ("Put the jar which has no lid on the tray.", ("jar, tray", "", "place:jar:tray", [])),
    ],
)
def test_what_is_beside_the_one_tells_which_it_is(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "Put each of the three eggs in its own cup.",
            (
                "egg 1, egg 2, egg 3, cup 1, cup 2, cup 3",
                "",
                "place:egg 1:cup 1, place:egg 2:cup 2, place:egg 3:cup 3",
                [],
            ),
        ),
        (
            "Two lemons are on the bench. Put each on its own saucer.",
            (
                "lemon 1, lemon 2, bench, saucer 1, saucer 2",
                "lemon 1 on bench, lemon 2 on bench",
                "place:lemon 1:saucer 1, place:lemon 2:saucer 2",
                [],
            ),
        ),
        (
            "Two shoes are on the rug. Put each shoe in its own box.",
            (
                "shoe 1, shoe 2, rug, box 1, box 2",
                "shoe 1 on rug, shoe 2 on rug",
                "place:shoe 1:box 1, place:shoe 2:box 2",
                [],
            ),
        ),
    ],
)
def test_each_has_one_of_its_own(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "Put the knife on the board and the smaller knife in the bowl.",
            (
                "knife, cutting board, smaller knife, bowl",
                "",
                "place:knife:cutting board, place:smaller knife:bowl",
                [],
            ),
        ),
        (
            "There is a crate on the bench. Put the bigger crate on the shelf.",
            ("crate, bench, bigger crate, shelf", "crate on bench", "place:bigger crate:shelf", []),
        ),
        (
            "There is a large crate and a small crate on the bench. Put the bigger crate on the shelf.",
            (
                "large crate, small crate, bench, shelf",
                "large crate on bench, small crate on bench",
                "place:large crate:shelf",
                [],
            ),
        ),
    ],
)
def test_the_bigger_one_is_another(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "Two tall vases and a short vase are on a bench. The tall ones are behind the short one.",
            (
                "vase 1, vase 2, vase 3, bench",
                "vase 1 on bench, vase 2 on bench, vase 3 on bench, vase 1 behind vase 3, vase 2 behind vase 3",
                None,
                [],
            ),
        ),
        (
            "Three lemons are in the bowl and two lemons are on the tray. The ones on the tray are green.",
            (
                "lemon 1, lemon 2, lemon 3, bowl, green lemon 1, green lemon 2, tray",
                "lemon 1 in bowl, lemon 2 in bowl, lemon 3 in bowl, green lemon 1 on tray, green lemon 2 on tray",
                None,
                [],
            ),
        ),
        (
            "A jar is on a shelf. Two more are on a desk. The one on the shelf is red. The ones on the desk are blue.",
            (
                "red jar, shelf, blue jar 1, blue jar 2, desk",
                "red jar on shelf, blue jar 1 on desk, blue jar 2 on desk",
                None,
                [],
            ),
        ),
        (
            "There is a plate with a bun and a plate without a bun. A fork is on the one without.",
            (
                "plate 1, bun, plate 2, fork",
                "bun on plate 1, fork on plate 2",
                None,
                ['assumed: "A fork" on "a plate"'],
            ),
        ),
        (
            "A jar with a lid and a jar without a lid are on a shelf. Two nuts are in the one without a lid.",
            (
                "jar 1, lid, jar 2, shelf, nut 1, nut 2",
                "jar 1 on shelf, lid on jar 1, jar 2 on shelf, nut 1 in jar 2, nut 2 in jar 2",
                None,
                [],
            ),
        ),
    ],
)
def test_the_ones_told_by_looks_or_place_are_all_of_them(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "A scale is on the bench, with a bowl on it.",
            ("scale, bench, bowl", "scale on bench, bowl on scale", None, []),
        ),
        (
            "The skillet is on the stove, with an egg on it.",
            ("skillet, stove, egg", "skillet on stove, egg on skillet", None, []),
        ),
        (
            "A coffee machine is on the bench, a bag on top of it.",
            (
                "coffee machine, bench, bag",
                "coffee machine on bench, bag on coffee machine",
                None,
                ['"it" (word 13) is read as "A coffee machine"; it may be "the bench".'],
            ),
        ),
        (
            "A doll sits in a cart and a bear stands behind it.",
            ("doll, cart, bear", "doll on cart, bear behind cart", None, []),
        ),
        (
            "Under the lamp is a towel. A pen is on the towel and beside it is a ruler.",
            (
                "lamp, towel, pen, ruler",
                "lamp on towel, pen on towel, ruler next_to towel, towel under lamp",
                None,
                ['"a ruler" next to "A pen": "a ruler" is next to "a towel".'],
            ),
        ),
        (
            "The can sits on a cabinet and beside the cabinet is a bin with a mug on top of its lid.",
            (
                "can, cabinet, bin, mug",
                "can on cabinet, mug on bin, bin next_to cabinet",
                None,
                ['"a bin" beside "a cabinet": it stands on the ground there; say "on" to have it on top.'],
            ),
        ),
    ],
)
def test_what_it_is(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "A stack of coins is on the bench. There are three coins.",
            ("coin 1, coin 2, coin 3, bench", "coin 1 on bench, coin 2 on coin 1, coin 3 on coin 2", None, []),
        ),
        (
            "A row of bottles stands on a shelf. There are two bottles.",
            ("bottle 1, bottle 2, shelf", "bottle 1 on shelf, bottle 2 on shelf, bottle 1 left_of bottle 2", None, []),
        ),
        (
            "One ball is left of the crate, one is in it, one on it, and one behind it.",
            (
                "ball 1, crate, ball 2, ball 3, ball 4",
                "ball 2 in crate, ball 3 on crate, ball 1 left_of crate, ball 4 behind crate",
                None,
                [],
            ),
        ),
    ],
)
def test_a_number_said_later_is_of_what_was_named(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        (
            "A coin is in the left cup and nothing is in the right cup.",
            (
                "coin, cup 1, cup 2",
                "coin in cup 1, cup 2 right_of cup 1",
                None,
                ['not modelled: "nothing is in the right cup"'],
            ),
        ),
        (
            "A fork is on the tray, but nothing is on the plate.",
            ("fork, tray, plate", "fork on tray", None, ['not modelled: "nothing is on the plate"']),
        ),
    ],
)
def test_nothing_is_there(prompt, expected):
    assert told(GrammarPlanner().plan(prompt)) == expected


def test_the_first_step_is_named_where_the_second_is_no_task():
    plan = GrammarPlanner().plan("The pens are in the cup. Get them and hang them on the hook.")
    assert plan.task is None
    assert 'not modelled: "Get them": no task does that.' in plan.notes
