"""Scenes in everyday wording that says what is there by what was, or by fewer words."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import told

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "One rabbit is on the bed, two are beneath it.",
            "rabbit 1, bed, rabbit 2, rabbit 3",
            "rabbit 1 on bed, rabbit 2, rabbit 3 under bed",
            None,
            list[str](),
        ),
        (
            "One fig is in the bowl, three are next to it.",
            "fig 1, bowl, fig 2, fig 3, fig 4",
            "fig 1 in bowl, fig 2 next_to bowl, fig 3 next_to bowl, fig 4 next_to bowl",
            None,
            ['"three" next to "One fig": "three" is next to "the bowl".'],
        ),
        (
            "One ball lies on the rug and two lie under the bench.",
            "ball 1, rug, ball 2, ball 3, bench",
            "ball 1 on rug, ball 2, ball 3 under bench",
            None,
            list[str](),
        ),
        ("One mug is red, two are blue.", "red mug, blue mug 1, blue mug 2", "", None, list[str]()),
        (
            "One hat hangs on a coat rack, two hang on a rail.",
            "hat 1, coat rack, hat 2, hat 3, rail",
            "hat 1 hangs_from coat rack, hat 2 hangs_from rail, hat 3 hangs_from rail",
            None,
            list[str](),
        ),
        (
            "One jar is on the tray. Two are on the shelf.",
            "jar 1, tray, jar 2, jar 3, shelf",
            "jar 1 on tray, jar 2 on shelf, jar 3 on shelf",
            None,
            ['assumed: "Two" on "the shelf"'],
        ),
        (
            "A jar with a fig stands next to two with limes.",
            "jar 1, fig, jar 2, jar 3, lime 1, lime 2, lime 3",
            "fig in jar 1, lime 1 in jar 2, lime 2 in jar 3, lime 3 in jar 2, jar 1 next_to jar 2, jar 1 next_to jar 3",
            None,
            list[str](),
        ),
        (
            "A mug stands behind one with a spoon.",
            "mug 1, mug 2, spoon",
            "spoon in mug 2, mug 1 behind mug 2",
            None,
            list[str](),
        ),
        (
            "There are three rabbits. One rabbit is on the bed, two are on the rug.",
            "rabbit 1, rabbit 2, rabbit 3, bed, rug",
            "rabbit 1 on bed, rabbit 2 on rug, rabbit 3 on rug",
            None,
            list[str](),
        ),
        (
            "Two jars are on the tray and three are on the shelf.",
            "jar 1, jar 2, tray, jar 3, jar 4, jar 5, shelf",
            "jar 1 on tray, jar 2 on tray, jar 3 on shelf, jar 4 on shelf, jar 5 on shelf",
            None,
            ['"three" behind "Two jars" are read as further ones, 5 in all.'],
        ),
        (
            "A red book lies under a blue book, and both lie under a lamp.",
            "red book, blue book, lamp",
            "blue book on red book, red book under blue book",
            None,
            ['not understood: "both" under "a lamp"'],
        ),
    ],
)
def test_a_number_without_a_noun_is_of_more_of_the_kind(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Three mugs: red, green and blue, standing on a tray",
            "red mug, green mug, blue mug, tray",
            "red mug on tray, green mug on tray, blue mug on tray",
            None,
            list[str](),
        ),
        (
            "Three toy cars: red, white and blue, in a crate",
            "red toy car, white toy car, blue toy car, crate",
            "red toy car in crate, white toy car in crate, blue toy car in crate",
            None,
            list[str](),
        ),
        (
            "Two tall candles: black and white, on the desk.",
            "black candle, white candle, desk",
            "black candle on desk, white candle on desk",
            None,
            list[str](),
        ),
        (
            "Three wooden blocks, red, white and blue, lie on the rug.",
            "red wooden block, white wooden block, blue wooden block, rug",
            "red wooden block on rug, white wooden block on rug, blue wooden block on rug",
            None,
            list[str](),
        ),
    ],
)
def test_colours_behind_a_colon_are_one_for_each(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Three jars in a row; the middle one is red, the outer ones are blue.",
            "blue jar 1, red jar, blue jar 2",
            "blue jar 1 left_of red jar, red jar left_of blue jar 2",
            None,
            list[str](),
        ),
        (
            "Five balls in a row; the outer two are yellow.",
            "yellow ball 1, ball 1, ball 2, ball 3, yellow ball 2",
            "yellow ball 1 left_of ball 1, ball 1 left_of ball 2, ball 2 left_of ball 3, ball 3 left_of yellow ball 2",
            None,
            list[str](),
        ),
        (
            "The middle one of three candles is green, the outer ones are white.",
            "white candle 1, green candle, white candle 2",
            "green candle right_of white candle 1, green candle left_of white candle 2",
            None,
            list[str](),
        ),
        (
            "Five mugs in a row; the two outer ones are green.",
            "green mug 1, mug 1, mug 2, mug 3, green mug 2",
            "green mug 1 left_of mug 1, mug 1 left_of mug 2, mug 2 left_of mug 3, mug 3 left_of green mug 2",
            None,
            list[str](),
        ),
        (
            "The outer edge of the plate is blue.",
            "blue plate",
            "",
            None,
            ['not modelled: "outer" of "The outer edge of the plate"'],
        ),
    ],
)
def test_the_outer_ones_are_the_first_and_the_last(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Four books in two equal stacks on the desk",
            "book 1, book 2, book 3, book 4, desk",
            "book 1 on desk, book 2 on book 1, book 3 on desk, book 4 on book 3",
            None,
            list[str](),
        ),
        (
            "Six plates stacked in three neat stacks",
            "plate 1, plate 2, plate 3, plate 4, plate 5, plate 6",
            "plate 2 on plate 1, plate 4 on plate 3, plate 6 on plate 5",
            None,
            list[str](),
        ),
        (
            "Four limes in two equal rows",
            "lime 1, lime 2, lime 3, lime 4",
            "lime 1 left_of lime 2, lime 3 left_of lime 4, lime 3 behind lime 1, lime 4 behind lime 2",
            None,
            list[str](),
        ),
        (
            "Six coins in two separate piles",
            "coin 1, coin 2, coin 3, coin 4, coin 5, coin 6",
            "coin 2 on coin 1, coin 3 on coin 2, coin 5 on coin 4, coin 6 on coin 5",
            None,
            list[str](),
        ),
    ],
)
def test_equal_stacks_are_stacks(prompt: str, objects: str, relations: str, task: str | None, notes: list[str]):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Three jars are nested inside each other.",
            "jar 1, jar 2, jar 3",
            "jar 2 on jar 1, jar 3 on jar 2",
            None,
            ['not modelled: "nested inside each other"'],
        ),
        (
            "Two mugs nested in each other on the bench.",
            "mug 1, mug 2, bench",
            "mug 1 on bench, mug 2 on mug 1",
            None,
            ['not modelled: "nested in each other"', 'assumed: "Two mugs" on "Two mugs"'],
        ),
        (
            "Four crates nested one inside the other",
            "crate 1, crate 2, crate 3, crate 4",
            "crate 2 on crate 1, crate 3 on crate 2, crate 4 on crate 3",
            None,
            ['not modelled: "nested one inside the other"', 'assumed: "Four crates" on "Four crates"'],
        ),
    ],
)
def test_what_is_nested_is_stacked_and_noted(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Take the lids off both jars.",
            "lid 1, lid 2, jar 1, jar 2",
            "lid 1 on jar 1, lid 2 on jar 2",
            None,
            ['not modelled: "Take the lids off both jars": no task does that.'],
        ),
        (
            "Two pots with lids on them",
            "pot 1, pot 2, lid 1, lid 2",
            "lid 1 on pot 1, lid 2 on pot 2",
            None,
            list[str](),
        ),
        (
            "Two pots with plants in them",
            "flower pot 1, flower pot 2, plant 1, plant 2, plant 3, plant 4",
            "plant 1 in flower pot 1, plant 2 in flower pot 2, plant 3 in flower pot 1, plant 4 in flower pot 2",
            None,
            list[str](),
        ),
    ],
)
def test_each_vessel_has_one_lid(prompt: str, objects: str, relations: str, task: str | None, notes: list[str]):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "A bench with a tray on it. On that: a jug and a lamp.",
            "bench, tray, jug, lamp",
            "tray on bench, jug on tray, lamp on tray",
            None,
            list[str](),
        ),
        ("A desk with a box on it. On that, a mug.", "desk, box, mug", "box on desk, mug on box", None, list[str]()),
        (
            "A shelf with a basket on it. In that are two limes.",
            "shelf, basket, lime 1, lime 2",
            "basket on shelf, lime 1 in basket, lime 2 in basket",
            None,
            list[str](),
        ),
        (
            "A chair with a cushion on it. On this sits a rabbit.",
            "chair, cushion, rabbit",
            "cushion on chair, rabbit on cushion",
            None,
            list[str](),
        ),
        (
            "A crate on a pallet. Inside that, two jars.",
            "crate, pallet, jar 1, jar 2",
            "crate on pallet, jar 1 in crate, jar 2 in crate",
            None,
            list[str](),
        ),
        (
            "A mug is next to a bowl, and by that a spoon.",
            "mug, bowl, spoon",
            "mug next_to bowl, spoon next_to mug",
            None,
            list[str](),
        ),
    ],
)
def test_that_is_what_was_named_last(prompt: str, objects: str, relations: str, task: str | None, notes: list[str]):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "There used to be a vase on the bench; now there is a globe.",
            "globe, bench",
            "globe on bench",
            None,
            ['not heard: "used"', 'not in the scene: "vase"', 'assumed: "a globe" on "the bench"'],
        ),
        (
            "There was a mug on the tray, but now there is only a spoon.",
            "spoon, tray",
            "spoon on tray",
            None,
            ['not in the scene: "mug"', 'assumed: "a spoon" on "the tray"'],
        ),
        (
            "The shelf used to hold books; now it holds a clock.",
            "shelf, clock",
            "clock on shelf",
            None,
            ['not heard: "used"', 'not in the scene: "books"'],
        ),
        (
            "There was a fig in the bowl. Now there is a lime in it.",
            "lime, bowl",
            "lime in bowl",
            None,
            ['not in the scene: "fig"'],
        ),
        (
            "There was a mug on the desk. A globe is on the shelf.",
            "mug, desk, globe, shelf",
            "mug on desk, globe on shelf",
            None,
            list[str](),
        ),
    ],
)
def test_what_used_to_be_there_is_not(prompt: str, objects: str, relations: str, task: str | None, notes: list[str]):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "A jug, lying on its side, from which two limes have slipped.",
            "jug, lime 1, lime 2",
            "lime 1 next_to jug, lime 2 next_to jug",
            None,
            [
                '"off A jug": "two limes" is read as next to it, not on it.',
                'not as said: "from which"',
                'not heard: "slipped"',
            ],
        ),
        (
            "A crate out of which three marbles have spilled onto the rug.",
            "crate, marble 1, marble 2, marble 3, rug",
            "marble 1 on rug, marble 2 on rug, marble 3 on rug",
            None,
            ['"A crate": where is not said; on the ground', 'not as said: "out of which"', 'not heard: "spilled"'],
        ),
        (
            "A bag from which a book has fallen.",
            "bag, book",
            "book next_to bag",
            None,
            [
                '"off A bag": "a book" is read as next to it, not on it.',
                'not as said: "from which"',
                'not heard: "fallen"',
            ],
        ),
    ],
)
def test_what_has_rolled_out_lies_beside(prompt: str, objects: str, relations: str, task: str | None, notes: list[str]):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "A desk lamp shines on a book.",
            "desk lamp, book",
            "desk lamp facing book",
            None,
            ['not heard: "shines"', 'not as said: "on a book"'],
        ),
        (
            "A lamp shines onto a globe on the table.",
            "lamp, globe, table",
            "globe on table, lamp facing globe",
            None,
            ['not heard: "shines"', 'not as said: "onto a globe"'],
        ),
        (
            "Two lamps shine on a statue.",
            "lamp 1, lamp 2, statue",
            "lamp 1, lamp 2 facing statue",
            None,
            ['not heard: "shine"', 'not as said: "on a statue"'],
        ),
        (
            "A lamp next to the vase shines on it.",
            "lamp, vase",
            "lamp next_to vase, lamp facing vase",
            None,
            ['not heard: "shines"', 'not as said: "on it"'],
        ),
        ("A lamp shines on the desk.", "lamp, desk", "lamp on desk", None, ['not heard: "shines"']),
    ],
)
def test_a_lamp_faces_what_it_shines_on(prompt: str, objects: str, relations: str, task: str | None, notes: list[str]):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "The stapler, which is out of staples, lies on a stool.",
            "stapler, stool",
            "stapler on stool",
            None,
            list[str](),
        ),
        ("The jar on the shelf is out of cookies.", "jar, shelf", "jar on shelf", None, list[str]()),
        (
            "A soap dispenser that is low on soap stands next to the sink.",
            "soap dispenser, sink",
            "soap dispenser next_to sink",
            None,
            ['not as said: "low" of "soap dispenser"'],
        ),
        ("The pencil case is empty of pencils.", "pencil case", "", None, list[str]()),
        (
            "The pens are out of the box.",
            "pen 1, pen 2, pen 3, box",
            "pen 1 next_to box, pen 2 next_to box, pen 3 next_to box",
            None,
            list[str](),
        ),
    ],
)
def test_what_a_thing_is_out_of_is_not_there(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("A cup of tea on a bench. A spoon is next to the tea.", ["bench", "spoon", "teacup"]),
        ("A glass of juice and a bun behind the juice", ["bun", "glass"]),
        ("A soup bowl and a spoon left of the soup", ["bowl", "spoon"]),
        ("A honey jar beside a lamp. A bun is in front of the honey.", ["bun", "jam jar", "lamp"]),
    ],
)
def test_what_a_vessel_is_full_of_stands_for_the_vessel(prompt: str, nouns: list[str]):
    plan = GrammarPlanner().plan(prompt)
    assert sorted(obj.noun for obj in plan.objects) == nouns
    beside = [each for each in plan.relations if not each.supports]
    assert len(beside) == (2 if "beside" in prompt else 1)
    assert not any("is made as" in note for note in plan.notes)
