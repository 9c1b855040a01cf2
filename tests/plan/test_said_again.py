"""What is said of a thing again, of its contents, of what hangs, of the second of a kind, and of places never made."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell

PLANNER = GrammarPlanner()


def _read(prompt: str) -> tuple[str, list[str]]:
    """What the plan of `prompt` tells, and its notes but for those on wording that was never tried."""
    plan = PLANNER.plan(prompt)
    return tell(plan), [note for note in plan.notes if not note.startswith("worded like nothing")]


@pytest.mark.parametrize(
    ("prompt", "told", "notes"),
    [
        ("A parrot sits in a cage.", "A cage stands on the ground. A parrot is in the cage.", []),
        (
            "A parrot sits on a cage.",
            "A cage stands on the ground. A parrot is in the cage.",
            ['not arranged: "A parrot" on "a cage"; it is placed in it'],
        ),
        ("There is a doll in a dollhouse.", "A dollhouse stands on the ground. A doll is in the dollhouse.", []),
    ],
)
def test_what_stands_on_the_floor_of_a_cage_is_told_to_be_in_it(prompt: str, told: str, notes: list[str]):
    assert _read(prompt) == (told, notes)


@pytest.mark.parametrize(
    ("prompt", "told", "notes"),
    [
        ("A bicycle in front of the garage.", "A bicycle stands", ['not modelled: "in front of the garage"']),
        ("A plant stands beside the kitchen.", "A plant stands", ['not modelled: "beside the kitchen"']),
        (
            "A ball lies between the house and the shed.",
            "A ball stands",
            ['not modelled: "between the house and the shed"'],
        ),
        ("A lamp is next to the bed in the bedroom.", "A lamp and a bed stand", []),
        ("A mug on a table in the kitchen.", "A table stands", []),
    ],
)
def test_a_place_beside_what_is_never_made_is_named(prompt: str, told: str, notes: list[str]):
    text, said = _read(prompt)
    assert text.startswith(told)
    assert said == notes


def test_a_toy_kitchen_is_no_room():
    text, notes = _read("A kettle is on the toy kitchen.")
    assert text.startswith("A toy kitchen stands on the ground. A kettle is on the toy kitchen.")
    assert notes == ['"the toy kitchen" is made as a "stove".']


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        (
            "A pot without its lid and the lid behind it.",
            "A pot and a lid stand on the ground. The lid is behind the pot.",
        ),
        (
            "A jar without a lid and its lid beside it.",
            "A jar and a lid stand on the ground. The lid is next to the jar.",
        ),
        ("A mug without a handle and a spoon beside it.", "A mug and a spoon stand on the ground."),
    ],
)
def test_what_a_thing_is_without_may_stand_beside_it(prompt: str, told: str):
    text, notes = _read(prompt)
    assert text.startswith(told)
    assert notes == []


@pytest.mark.parametrize(
    ("prompt", "told", "notes"),
    [
        (
            "A flower pot and a pot of glue; the pot of glue is on a tray.",
            "A flower pot and a tray stand on the ground. A pot is on the tray. A glue is in the pot.",
            ['"A flower pot": where is not said; on the ground'],
        ),
        (
            "A bowl of figs and a bowl of limes stand on a desk. The bowl of figs is next to a mug.",
            "A desk stands on the ground. Two bowls and a mug are on the desk. Three figs are in the first of the two "
            "bowls. Three limes are in the second of the two bowls. The first of the two bowls is next to the mug.",
            ['"figs": 3 assumed.', '"limes": 3 assumed.'],
        ),
        (
            "A glass of juice and a glass of milk are on a desk. The glass of juice is left of a plate.",
            "A desk stands on the ground. A juice glass, a glass and a plate are on the desk. The juice glass is to "
            "the left of the plate.",
            [
                '"juice" of "A glass of juice" is left out: it is no rigid body.',
                '"milk" of "a glass of milk" is left out: it is no rigid body.',
            ],
        ),
    ],
)
def test_a_vessel_said_again_with_its_contents_is_that_vessel(prompt: str, told: str, notes: list[str]):
    assert _read(prompt) == (told, notes)


@pytest.mark.parametrize(
    ("prompt", "told", "notes"),
    [
        (
            "Two crates, one of melons, one of figs.",
            "Two crates stand on the ground. Three melons are in the first of the two crates. Three figs are in the "
            "second of the two crates.",
            ['"melons": 3 assumed.', '"figs": 3 assumed.'],
        ),
        (
            "Two boxes: one of wood, one of metal.",
            "Two boxes stand on the ground.",
            ['not modelled: "one of wood"', 'not modelled: "one of metal"'],
        ),
    ],
)
def test_one_of_some_stuff_is_one_of_those_counted(prompt: str, told: str, notes: list[str]):
    text, said = _read(prompt)
    assert text == told
    assert [note for note in said if not note.startswith("assumed")] == notes


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        (
            "A clipboard is hanging from a hook with a note on it.",
            "A hook stands on the ground. A clipboard is hanging from the hook.",
        ),
        (
            "A clipboard hangs from a nail with a ruler on it.",
            "A nail stands on the ground. A clipboard is hanging from the nail. A ruler is on the clipboard.",
        ),
    ],
)
def test_a_nail_carries_nothing_but_what_hangs_from_it(prompt: str, told: str):
    assert _read(prompt)[0].startswith(told)


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        (
            "A clock is on a shelf; next to it a vase; next to that a bowl.",
            "The vase is next to the clock. The bowl is next to the vase.",
        ),
        (
            "A crate stands on a rug. Next to it is a jug. Behind that is a basket.",
            "The jug is next to the crate. The basket is behind the jug.",
        ),
        ("A sofa stands by a bench. On the bench lies a doll, under it a ball.", "The ball is under the bench."),
        ("A desk stands by a stool. On the stool sits a cat, under it a shoe.", "The shoe is under the stool."),
    ],
)
def test_that_is_what_was_named_last_and_it_what_the_clause_opens_with(prompt: str, told: str):
    text, notes = _read(prompt)
    assert told in text
    assert notes == []


@pytest.mark.parametrize(
    ("prompt", "told", "notes"),
    [
        (
            "The first crate is full of pears. The second one is empty.",
            "Two crates stand on the ground. Eight pears are in the first of the two crates.",
            ['"pears": 8 assumed.'],
        ),
        (
            "On the first shelf are two jars. On the second is a globe.",
            "Two shelves stand on the ground. Two jars are on the first of the two shelves. A globe is on the second "
            "of the two shelves.",
            [],
        ),
        (
            "There are two trays. On the first are three cups, on the second four.",
            "Two trays stand on the ground. Three cups are on the first of the two trays. Four cups are on the second "
            "of the two trays.",
            ['"four" behind "three cups" are read as further ones, 7 in all.'],
        ),
        (
            "Two plates: on the first, a bun.",
            "Two plates stand on the ground. A bun is on the first of the two plates.",
            [],
        ),
    ],
)
def test_the_second_after_the_first_is_another(prompt: str, told: str, notes: list[str]):
    assert _read(prompt) == (told, notes)


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("Two pears, three figs, in a bowl.", "A bowl stands on the ground. Two pears and three figs are in the bowl."),
        (
            "A jam jar with three pencils and one pencil lying in front.",
            "A jam jar, three pencils and another pencil stand on the ground. The three pencils are next to the jam "
            "jar. The pencil is in front of the jam jar.",
        ),
    ],
)
def test_a_place_behind_a_comma_is_of_the_whole_list(prompt: str, told: str):
    assert _read(prompt)[0] == told


def test_what_is_wrapped_is_what_is_moved():
    plan = PLANNER.plan("Put the jug on the newspaper and place it in the crate.")
    assert plan.task is None
    assert any("place:jug:newspaper, place:jug:crate" in note for note in plan.notes)
