"""Everyday ways to speak of things: by a wider word, with one article, by a lid or a size; where they are to go."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def told(plan: ScenePlan) -> tuple[str, str, str | None, tuple[str, ...]]:
    """What there is, how it stands, the task, and the notes but for what was never tried."""
    stands = [f"{each.child} {each.kind} {each.parent}" for each in plan.relations]
    stands += [f"{' '.join(each.objects)} {each.kind} {' '.join(each.of)}" for each in plan.arrangements]
    notes = tuple(note for note in plan.notes if not note.startswith("worded like"))
    return ", ".join(obj.name for obj in plan.objects), "; ".join(stands), plan.task, notes


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "put lemon left of bowl and black spoon on bowl",
            "lemon, bowl, black spoon",
            "",
            "chain:beside:lemon:left_of:bowl:then:place:black spoon:bowl",
            ('not arranged: "black spoon" on "bowl"; the task puts it in it',),
        ),
        (
            "move orange behind crate and white mug in crate",
            "orange, crate, white mug",
            "",
            "chain:beside:orange:behind:crate:then:place:white mug:crate",
            (),
        ),
        (
            "place apple next to tray and blue cup on tray",
            "apple, tray, blue cup",
            "",
            "chain:beside:apple:next_to:tray:then:place:blue cup:tray",
            (),
        ),
        (
            "put can in front of basket and green ball in basket",
            "can, basket, green ball",
            "",
            "chain:beside:can:in_front_of:basket:then:place:green ball:basket",
            (),
        ),
        (
            "put pear right of board and red knife on board",
            "pear, cutting board, red knife",
            "",
            "chain:beside:pear:right_of:cutting board:then:place:red knife:cutting board",
            (),
        ),
    ],
)
def test_a_jotted_instruction_has_its_second_thing_at_the_second_place(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "A large plate holds a bun. Next to it is a small plate. A jug stands behind both plates.",
            "large plate, bun, small plate, jug",
            "bun on large plate; small plate next_to large plate; jug behind large plate; jug behind small plate",
            None,
            (),
        ),
        (
            "A soup bowl and a salad bowl are on the bench. The bowls are red.",
            "red soup bowl, red salad bowl, bench",
            "red soup bowl on bench; red salad bowl on bench",
            None,
            (),
        ),
        (
            "A tissue box is on the floor. A wooden box is next to it. A dog sits in front of the two boxes.",
            "tissue box, wooden box, dog",
            "wooden box next_to tissue box; dog in_front_of tissue box; dog in_front_of wooden box",
            None,
            (),
        ),
        (
            "A jar of honey stands next to a jar. A spoon lies right of both jars.",
            "honey jar, jar, spoon",
            "honey jar next_to jar; spoon right_of honey jar; spoon right_of jar",
            None,
            ('"honey" of "A jar of honey" is left out: it is no rigid body.',),
        ),
        (
            "A wine glass and a glass stand on the tray. The glasses are green.",
            "green wine glass, green glass, tray",
            "green wine glass on tray; green glass on tray",
            None,
            (),
        ),
    ],
)
def test_the_plates_are_all_plates_whatever_their_kind(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "A nut is in the tall jar and two bolts in the short jar, both of which have lids.",
            "nut, jar 1, bolt 1, bolt 2, jar 2, lid 1, lid 2",
            "nut in jar 1; bolt 1 in jar 2; bolt 2 in jar 2; lid 1 on jar 1; lid 2 on jar 2",
            None,
            ('"lids": 2 assumed.',),
        ),
        (
            "A ring is in the wooden box and two coins in the jar, both of which have red lids.",
            "ring, wooden box, coin 1, coin 2, jar, red lid 1, red lid 2",
            "ring in wooden box; coin 1 in jar; coin 2 in jar; red lid 1 on wooden box; red lid 2 on jar",
            None,
            ('"red lids": 2 assumed.', '"have red lids" is not read as said of all "box" or "coins" or "jar"'),
        ),
        (
            "A key is in the pot and a marble in the jar. Both have lids.",
            "key, pot, marble, jar, lid 1, lid 2",
            "key in pot; marble in jar; lid 1 on pot; lid 2 on jar",
            None,
            ('"lids": 2 assumed.', '"have lids" is not read as said of all "key" or "pot" or "marble" or "jar"'),
        ),
        (
            "A pencil is in the cup and a comb in the jar, each of which has a lid.",
            "pencil, cup, comb, jar, lid 1, lid 2",
            "pencil in cup; comb in jar; lid 1 on cup; lid 2 on jar",
            None,
            ('"has a lid" is not read as said of all "pencil" or "cup" or "comb" or "jar"',),
        ),
        (
            "Two saucepans on the stove, both of which have lids.",
            "saucepan 1, saucepan 2, stove, lid 1, lid 2",
            "saucepan 1 on stove; saucepan 2 on stove; lid 1 on saucepan 1; lid 2 on saucepan 2",
            None,
            ('"lids": 2 assumed.',),
        ),
    ],
)
def test_what_both_have_is_had_by_what_may_have_it(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "On the shelf are a clock and a rose in a flower pot.",
            "shelf, clock, rose, flower pot",
            "clock on shelf; rose in flower pot; flower pot on shelf",
            None,
            ('"a flower pot" is on "the shelf", with what it carries.',),
        ),
        (
            "A framed photo and a cactus in a pot.",
            "framed photo, cactus, flower pot",
            "cactus in flower pot",
            None,
            ('"A framed photo": "in a pot" is not read as said of it; on the ground',),
        ),
        (
            "On the left stands a radio; on the right, a mirror and a cactus in a flower pot.",
            "radio, mirror, cactus, flower pot",
            "cactus in flower pot; radio left_of mirror",
            None,
            (),
        ),
        (
            "A mug and a tulip in a planter.",
            "mug, tulip, planter",
            "tulip in planter",
            None,
            ('"A mug": "in a planter" is not read as said of it; on the ground',),
        ),
        (
            "On the desk are a book and a succulent in a pot.",
            "desk, book, succulent, pot",
            "book on desk; succulent in pot; pot on desk",
            None,
            ('"a pot" is on "the desk", with what it carries.',),
        ),
    ],
)
def test_what_does_not_grow_is_in_no_flower_pot(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "A frog sits in a bathtub. A mat lies next to the tub.",
            "frog, bathtub, mat",
            "frog in bathtub; mat next_to bathtub",
            None,
            ('"the tub" is read as "a bathtub".',),
        ),
        (
            "A mug is on the bench. A teaspoon lies beside the cup.",
            "mug, bench, teaspoon",
            "mug on bench; teaspoon on bench; teaspoon next_to mug",
            None,
            ('"the cup" is read as "A mug".',),
        ),
        (
            "A green mug and a white mug. A pen is in the white cup.",
            "green mug, white mug, pen",
            "pen in white mug",
            None,
            ('"the white cup" is read as "a white mug".',),
        ),
        (
            "A backpack is on the bench. A cap is on the bag.",
            "backpack, bench, cap",
            "backpack on bench; cap on backpack",
            None,
            ('"the bag" is read as "A backpack".',),
        ),
        (
            "A crate stands on the floor. A cat sits in the box.",
            "crate, cat",
            "cat in crate",
            None,
            ('"the box" is read as "A crate".',),
        ),
        (
            "A notebook is on the desk. A ruler lies on the book.",
            "notebook, desk, ruler",
            "notebook on desk; ruler on notebook",
            None,
            ('"the book" is read as "A notebook".',),
        ),
        (
            "There is a teacup on the shelf. Put the cup on the tray.",
            "teacup, shelf, tray",
            "teacup on shelf",
            "place:teacup:tray",
            ('"the cup" is read as "a teacup".',),
        ),
    ],
)
def test_a_wider_word_speaks_of_what_was_named_by_a_narrower_one(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "A mug is on the shelf. The cup is on the tray.",
            "mug, shelf, cup, tray",
            "mug on shelf; cup on tray",
            None,
            (),
        ),
        (
            "A mug and a cup are on the bench. A pen is in the cup.",
            "mug, cup, bench, pen",
            "mug on bench; cup on bench; pen in cup",
            None,
            (),
        ),
        (
            "A mug is on the shelf. A spoon is in a cup.",
            "mug, shelf, spoon, cup",
            "mug on shelf; spoon in cup",
            None,
            ('"a cup": where is not said; on the ground',),
        ),
        (
            "A blue mug is on the shelf. A spoon is in the red cup.",
            "blue mug, shelf, spoon, red cup",
            "blue mug on shelf; spoon in red cup",
            None,
            (),
        ),
    ],
)
def test_a_wider_word_that_is_told_apart_is_another_thing(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "Two glasses of wine on a tray.",
            "wine glass 1, wine glass 2, tray",
            "wine glass 1 on tray; wine glass 2 on tray",
            None,
            ('"wine" of "Two glasses of wine" is left out: it is no rigid body.',),
        ),
        ("A goblet of wine.", "goblet", "", None, ('"wine" of "A goblet of wine" is left out: it is no rigid body.',)),
        ("A bottle of wine.", "bottle of wine", "", None, ()),
    ],
)
def test_what_a_glass_is_made_without_is_named(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "Carry the mug to the open cupboard.",
            "mug, open cupboard",
            "",
            "place:mug:open cupboard",
            (),
        ),
        (
            "Bring the pan to the dishwasher.",
            "pan, dishwasher",
            "",
            "place:pan:dishwasher",
            ('"the dishwasher" is made open, as what is in it is reached so.',),
        ),
        (
            "Move the shirt to the opened wardrobe.",
            "shirt, opened wardrobe",
            "",
            "place:shirt:opened wardrobe",
            (),
        ),
        (
            "Take the pear to the fridge.",
            "pear, fridge",
            "",
            "place:pear:fridge",
            ('"the fridge" is made open, as what is in it is reached so.',),
        ),
        ("Move the cup to the shelf.", "cup, shelf", "", "place:cup:shelf", ()),
    ],
)
def test_what_is_moved_to_a_cupboard_is_to_be_in_it(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "Put the vase behind the cup, bowl and jug on the bench.",
            "vase, cup, bowl, jug, bench",
            "cup on bench; bowl on bench; jug on bench",
            None,
            (
                'not modelled: "Put the vase behind the cup, bowl and jug on the bench": no task does that.',
                '"jug on the bench" is read as where it is before the task',
            ),
        ),
        (
            "Move the bottle next to the pen, ruler, and eraser on the desk.",
            "bottle, pen, ruler, eraser, desk",
            "pen on desk; ruler on desk; eraser on desk",
            None,
            (
                'not modelled: "Move the bottle next to the pen, ruler, and eraser on the desk": no task does that.',
                '"eraser on the desk" is read as where it is before the task',
            ),
        ),
        (
            "A lamp by the pen, cup and hat on a desk.",
            "lamp, pen, cup, hat, desk",
            "lamp on desk; pen on desk; cup on desk; hat on desk; lamp next_to pen; lamp next_to cup; lamp next_to hat",
            None,
            (),
        ),
        (
            "Place the mug in front of the jar and bottle on the shelf.",
            "mug, jar, bottle, shelf",
            "jar on shelf; bottle on shelf",
            None,
            (
                'not modelled: "Place the mug in front of the jar and bottle on the shelf": no task does that.',
                '"bottle on the shelf" is read as where it is before the task',
            ),
        ),
    ],
)
def test_what_shares_one_article_is_one_list(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "A laptop on a desk, its lid half shut.",
            "laptop, desk",
            "laptop on desk",
            None,
            ('not modelled: "its lid half shut"',),
        ),
        (
            "A laptop, lid closed, on a bench.",
            "laptop, bench",
            "laptop on bench",
            None,
            ('not modelled: "closed"', 'not in the scene: "lid"'),
        ),
        ("A laptop with the lid half open.", "laptop", "", None, ('not modelled: "the lid half open"',)),
        ("A piano with its lid shut.", "piano", "", None, ('not modelled: "its lid shut"',)),
        (
            "A laptop is on the table. Its lid is closed.",
            "laptop, table",
            "laptop on table",
            None,
            ('not understood: how "Its lid" is described', 'not heard: "closed"'),
        ),
        (
            "A laptop and a jar are on the desk. The lid is on the jar.",
            "laptop, jar, desk, lid",
            "laptop on desk; jar on desk; lid on jar",
            None,
            (),
        ),
    ],
)
def test_the_lid_of_a_laptop_is_no_thing(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "A glass is on the shelf. A towel hangs below it.",
            "glass, shelf, towel",
            "glass on shelf; towel on shelf; towel next_to glass; towel under glass",
            None,
            (
                'not modelled: "hangs" after "A towel"',
                'not arranged: "A towel" under "A glass"; it is placed next to it',
            ),
        ),
        (
            "A jar stands on the bench. A napkin hangs below.",
            "jar, bench, napkin",
            "jar on bench; napkin on bench; napkin next_to jar; napkin under jar",
            None,
            (
                'not modelled: "hangs" after "A napkin"',
                'not arranged: "A napkin" under "A jar"; it is placed next to it',
            ),
        ),
        (
            "A mug is on the desk. A towel is under it.",
            "mug, desk, towel",
            "mug on towel; towel on desk; towel under mug",
            None,
            (),
        ),
    ],
)
def test_nothing_stands_on_what_hangs_below_it(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)


@pytest.mark.parametrize(
    ("prompt", "things", "stands", "task", "notes"),
    [
        (
            "There is a tall jar and a short one on the shelf. Put the spoon in the short one.",
            "jar 1, jar 2, shelf, spoon",
            "jar 1 on shelf; jar 2 on shelf",
            "place:spoon:jar 2",
            (),
        ),
        (
            "A thick book and a thin one are on the desk. The thin one is red.",
            "book, red book, desk",
            "book on desk; red book on desk",
            None,
            (),
        ),
        (
            "A round tray and a square one. A cup is on the square one.",
            "tray 1, tray 2, cup",
            "cup on tray 2",
            None,
            (
                'not modelled: "square" of "a square one"',
                'not modelled: "square" of "the square one"',
                'assumed: "A cup" on "a square one"',
            ),
        ),
    ],
)
def test_the_short_one_is_told_by_its_shape(
    prompt: str, things: str, stands: str, task: str | None, notes: tuple[str, ...]
):
    assert told(PLANNER.plan(prompt)) == (things, stands, task, notes)
