"""What an instruction says of the scene before it, in everyday wording."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import told

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Move the fig from one jar to the other.",
            "fig, jar 1, jar 2",
            "fig in jar 1",
            "place:fig:jar 2",
            list[str](),
        ),
        (
            "Take the pen from one mug and put it in the other.",
            "pen, mug 1, mug 2",
            "pen in mug 1",
            "place:pen:mug 2",
            list[str](),
        ),
        (
            "Carry the candle from one shelf to the other one.",
            "candle, shelf 1, shelf 2",
            "candle on shelf 1",
            "place:candle:shelf 2",
            list[str](),
        ),
        (
            "Move both limes from one green bowl into the other.",
            "lime 1, lime 2, green bowl 1, green bowl 2",
            "lime 1 in green bowl 1, lime 2 in green bowl 1",
            "place:lime 1:green bowl 2, place:lime 2:green bowl 2",
            list[str](),
        ),
        (
            "Take a fig from one crate and a lime from the other.",
            "fig, crate 1, lime, crate 2",
            "fig in crate 1, lime in crate 2",
            None,
            ['not modelled: "Take a fig from one crate and a lime from the other": no task does that.'],
        ),
    ],
)
def test_the_other_is_another_of_the_same_kind(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        ("Take the towel off the crate.", "towel, crate", "towel on crate", "pick:towel", list[str]()),
        (
            "Take the book off the box and put it on the stool.",
            "book, box, stool",
            "book on box",
            "place:book:stool",
            list[str](),
        ),
        ("Take the mug off the dish rack.", "mug, dish rack", "mug in dish rack", "pick:mug", list[str]()),
        ("Take the pen out of the jar.", "pen, jar", "pen in jar", "pick:pen", list[str]()),
        ("Lift the plate off the pot.", "plate, pot", "plate on pot", "pick:plate", list[str]()),
        (
            "Uncover the crate by taking the towel off it and laying it on the bench.",
            "crate, towel, bench",
            "towel on crate",
            "place:towel:bench",
            ['not modelled: "Uncover the crate": no task does that.'],
        ),
    ],
)
def test_what_is_taken_off_a_thing_was_on_it(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Take the muffin out of the jar and serve it on the blue plate.",
            "muffin, jar, blue plate",
            "muffin in jar",
            "place:muffin:blue plate",
            list[str](),
        ),
        ("Serve the pear on the tray.", "pear, tray", "", "place:pear:tray", list[str]()),
        (
            "Get the bagel out of the basket and serve it on a plate.",
            "bagel, basket, plate",
            "bagel in basket",
            "place:bagel:plate",
            list[str](),
        ),
        ("A muffin is served on a plate.", "muffin, plate", "muffin on plate", None, list[str]()),
    ],
)
def test_to_serve_on_a_plate_is_to_put_there(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        ("Place the ruler so that it lies on the book.", "ruler, book", "", "place:ruler:book", list[str]()),
        ("Move the lime so that it rests in the bowl.", "lime, bowl", "", "place:lime:bowl", list[str]()),
        (
            "Put the three mugs so that they stand on the bench.",
            "mug 1, mug 2, mug 3, bench",
            "",
            "place:mug 1:bench, place:mug 2:bench, place:mug 3:bench",
            list[str](),
        ),
        ("Place the pen such that it is in the jar.", "pen, jar", "", "place:pen:jar", list[str]()),
        (
            "Position the jug so it is left of the lamp.",
            "jug, lamp",
            "",
            "beside:jug:left_of:lamp",
            list[str](),
        ),
        (
            "Put the jug on the tray so that it stands next to the lamp.",
            "jug, tray, lamp",
            "lamp on tray",
            "place:jug:tray",
            ['not modelled: "next to the lamp"'],
        ),
    ],
)
def test_what_is_placed_so_that_it_lies_there_is_put_there(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Drop the marble in the mug and stir with the spoon.",
            "marble, mug, spoon",
            "",
            "place:marble:mug",
            ['not modelled: "stir with the spoon": no task does that.'],
        ),
        (
            "Put the pear on the cutting board and slice with the knife.",
            "pear, cutting board, knife",
            "",
            "place:pear:cutting board",
            ['not modelled: "slice with the knife": no task does that.'],
        ),
        (
            "Put the plate in the sink and scrub with the sponge.",
            "plate, sink, sponge",
            "",
            "place:plate:sink",
            ['not modelled: "scrub with the sponge": no task does that.'],
        ),
        (
            "Place the mug on the tray and wipe with the towel.",
            "mug, tray, towel",
            "",
            "place:mug:tray",
            ['not modelled: "wipe with the towel": no task does that.'],
        ),
        (
            "A bowl with a spoon and a plate with a fork.",
            "bowl, spoon, plate, fork",
            "spoon in bowl, fork on plate",
            None,
            list[str](),
        ),
    ],
)
def test_a_deed_with_a_tool_takes_no_part_in_the_one_before(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Fill the jar with the marbles on the tray.",
            "marble 1, marble 2, marble 3, tray, jar",
            "marble 1 on tray, marble 2 on tray, marble 3 on tray",
            "place:marble 1:jar, place:marble 2:jar, place:marble 3:jar",
            list[str](),
        ),
        (
            "Fill the crate with the books under the desk.",
            "book 1, book 2, book 3, desk, crate",
            "book 1, book 2, book 3 under desk",
            "place:book 1:crate, place:book 2:crate, place:book 3:crate",
            list[str](),
        ),
        (
            "Fill the vase with the two roses lying next to it.",
            "rose 1, rose 2, vase",
            "rose 1 next_to vase, rose 2 next_to vase",
            "place:rose 1:vase, place:rose 2:vase",
            list[str](),
        ),
        (
            "Load the basket with the pens in the mug.",
            "pen 1, pen 2, pen 3, mug, basket",
            "pen 1 in mug, pen 2 in mug, pen 3 in mug",
            "place:pen 1:basket, place:pen 2:basket, place:pen 3:basket",
            list[str](),
        ),
        (
            "Fill the bowl with three limes on the mat.",
            "lime 1, lime 2, lime 3, mat, bowl",
            "lime 1 on mat, lime 2 on mat, lime 3 on mat",
            "place:lime 1:bowl, place:lime 2:bowl, place:lime 3:bowl",
            list[str](),
        ),
        (
            "Load the crate with the jars onto the cart.",
            "jar 1, jar 2, jar 3, crate, cart",
            "jar 1 in crate, jar 2 in crate, jar 3 in crate",
            "place:crate:cart",
            list[str](),
        ),
        (
            "Put the bowl with the limes on the mat.",
            "lime 1, lime 2, lime 3, bowl, mat",
            "lime 1 in bowl, lime 2 in bowl, lime 3 in bowl",
            "place:bowl:mat",
            list[str](),
        ),
        (
            "Fill the mug with marbles.",
            "mug, marble 1, marble 2, marble 3",
            "",
            None,
            ['not modelled: "Fill the mug with marbles": no task does that.'],
        ),
    ],
)
def test_what_a_thing_is_filled_with_lies_where_that_is_said(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task", "notes"),
    [
        (
            "Pick up the globe. On the desk are a globe and a jug.",
            "desk, globe, jug",
            "globe on desk, jug on desk",
            "pick:globe",
            list[str](),
        ),
        (
            "Put the lime in the bowl. The bench has a lime, a bowl and a lamp on it.",
            "bench, lime, bowl, lamp",
            "lime on bench, bowl on bench, lamp on bench",
            "place:lime:bowl",
            list[str](),
        ),
        (
            "Put the lime in the bowl. A lime, a bowl and a lamp are on the bench.",
            "lime, bowl, lamp, bench",
            "lime on bench, bowl on bench, lamp on bench",
            "place:lime:bowl",
            list[str](),
        ),
        (
            "Move the red mug to the tray. The shelf holds a red mug and a blue mug.",
            "shelf, red mug, blue mug, tray",
            "red mug on shelf, blue mug on shelf",
            "place:red mug:tray",
            list[str](),
        ),
        (
            "Sort the blocks. On the rug are a red block and a blue block.",
            "rug, red block, blue block",
            "red block on rug, blue block on rug",
            None,
            ['not modelled: "Sort the blocks": no task does that.'],
        ),
        (
            "Put everything except the lime in the box. On the table are a lime, a pear and a fig.",
            "table, lime, pear, fig, box",
            "lime on table, pear on table, fig on table",
            "place:pear:box, place:fig:box",
            list[str](),
        ),
        (
            "Put a mug on the tray. A mug is on the shelf.",
            "mug 1, shelf, mug 2, tray",
            "mug 1 on shelf, mug 2 on tray",
            None,
            ['"Put a mug on the tray" is read as the scene to make; with "the" before what is moved it is a task.'],
        ),
        ("Pick up the globe. Then a jug is on the desk.", "globe, jug, desk", "jug on desk", "pick:globe", list[str]()),
    ],
)
def test_a_scene_told_behind_an_instruction_is_before_it(
    prompt: str, objects: str, relations: str, task: str | None, notes: list[str]
):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, notes)
