"""What a sentence says of places and postures is what the scene is to hold; what it says otherwise is not."""

import itertools

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def held(plan: ScenePlan) -> set[str]:
    """The arrangements and the postures that the scene is to hold."""
    return {*map(str, plan.held()), *map(str, plan.turned())}


@pytest.mark.parametrize(
    ("sentence", "wanted"),
    [
        # between
        ("A mug between the bowl and the vase.", {"mug between bowl, vase"}),
        ("A mug stands between a bowl, a can and a vase.", {"mug between bowl, can, vase"}),
        ("There is a lamp in between two books on the desk.", {"lamp between book 1, book 2"}),
        ("A table with a fork between a plate and a bowl.", {"fork between plate, bowl"}),
        # far from
        ("A mug far from the bowl.", {"mug far_from bowl"}),
        ("A bowl is on a table. A mug is far away from the bowl.", {"mug far_from bowl"}),
        ("Two vases far from each other.", {"vase 1, vase 2 far_from"}),
        # places on a surface
        ("A cup at the edge of the table.", {"cup at_edge table"}),
        ("Two cups on the edge of a desk.", {"cup 1, cup 2 at_edge desk"}),
        ("A table with a vase near the edge of it.", {"vase at_edge table"}),
        ("A can in the corner of the table.", {"can in_corner table"}),
        ("A lamp stands at the corner of a desk.", {"lamp in_corner desk"}),
        ("There is a mug on the corner of the tray.", {"mug in_corner tray"}),
        ("A bottle stands in each of the four corners of a tray.",
         {"bottle 1, bottle 2, bottle 3, bottle 4 in_corners tray"}),
        ("A bench with a box at each corner.", {"box 1, box 2, box 3, box 4 in_corners bench"}),
        ("Three cans are in the corners of a desk.", {"can 1, can 2, can 3 in_corners desk"}),
        ("Four dice, one in each corner of a tray.", {"dice 1, dice 2, dice 3, dice 4 in_corners tray"}),
        ("Six dogs sit in a row, facing a lamp.",
         {"dog 1, dog 2, dog 3, dog 4, dog 5, dog 6 row", "dog 1, dog 2, dog 3, dog 4, dog 5, dog 6 facing lamp"}),
        # around several
        ("Seven cans stand in a ring around a vase and a lamp on a desk.",
         {"can 1, can 2, can 3, can 4, can 5, can 6, can 7 circle vase, lamp"}),
        ("Five mugs form a circle around two cans.", {"mug 1, mug 2, mug 3, mug 4, mug 5 circle can 1, can 2"}),
        # under, several at once
        ("A stool and a box are under a desk.", {"stool, box under desk"}),
        ("A bowl in the middle of the table.", {"bowl in_middle table"}),
        ("A vase stands in the centre of a desk.", {"vase in_middle desk"}),
        ("A vase is on a table, in the middle.", {"vase in_middle table"}),
        ("At the center of the tray is a candle.", {"candle in_middle tray"}),
        # rows, circles, each other
        ("Four cups in a row.", {"cup 1, cup 2, cup 3, cup 4 row"}),
        ("A mug, a can and a vase are lined up.", {"mug, can, vase row"}),
        ("A laptop and a book side by side.", {"laptop, book side_by_side"}),
        ("Two mugs side by side on a tray.", {"mug 1, mug 2 side_by_side"}),
        ("Three vases stand side-by-side.", {"vase 1, vase 2, vase 3 side_by_side"}),
        ("Four candles in a circle around the vase.", {"candle 1, candle 2, candle 3, candle 4 circle vase"}),
        ("A vase surrounded by three cups in a circle.", {"cup 1, cup 2, cup 3 circle vase"}),
        ("Five balls in a ring.", {"ball 1, ball 2, ball 3, ball 4, ball 5 circle"}),
        ("Three stools arranged in a circle around a table.", {"stool 1, stool 2, stool 3 circle table"}),
        # facing
        ("Two chairs facing each other.", {"chair 1, chair 2 facing"}),
        ("A cat and a dog face each other.", {"cat, dog facing"}),
        ("A chair faces the television.", {"chair facing television"}),
        ("A chair turned towards a table.", {"chair facing table"}),
        # leaning
        ("A book leaning against a box.", {"book leaning_against box"}),
        ("A ruler leans on a stack of two crates.", {"ruler leaning_against crate 1, crate 2"}),
        ("Two umbrellas are leaning against a sofa.",
         {"umbrella 1 leaning_against sofa", "umbrella 2 leaning_against sofa"}),
        ("An umbrella leans on a chair.", {"umbrella leaning_against chair"}),
        ("A tablet is propped up against a vase on a desk.", {"tablet leaning_against vase"}),
        # under
        ("A ball under the table.", {"ball under table"}),
        ("Under the bench is a shoe.", {"shoe under bench"}),
        ("A dog lies beneath a desk.", {"dog under desk"}),
        ("Two balls under a table.", {"ball 1, ball 2 under table"}),
        # postures
        ("A bottle lying on its side on a table.", {"bottle on_its_side"}),
        ("Two toppled cans.", {"can 1 on_its_side", "can 2 on_its_side"}),
        ("A vase is on its side.", {"vase on_its_side"}),
        ("An upside-down mug on a towel.", {"mug upside_down"}),
        ("A tray that carries two cups, one upside down.", {"cup 1 upside_down"}),
        ("An inverted bowl on a plate.", {"bowl upside_down"}),
        ("A bottle standing upright on a table.", {"bottle upright"}),
        ("A book on end on a shelf.", {"book on_its_side"}),
    ],
)  # fmt: skip
def test_what_is_said_is_held(sentence: str, wanted: set[str]):
    plan = PLANNER.plan(sentence)
    assert held(plan) == wanted
    assert not any(note.startswith("not arranged") for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "note"),
    [
        ("A bear gazing at a mug.", "facing"),
        ("A mug is in the middle of a box.", ""),
        ("A book leaning against the wall.", ""),
        ("Two books leaning against each other.", "leaning against each other"),
        ("Two books lean on a box.", "leaning against"),
        ("A table stands next to a lamp. A can and a bowl on the table are facing the lamp.", "facing"),
        ("A chair hanging from a tree, with a ball under it.", "under"),
        ("A book under a lamp.", ""),
        ("Two balls in a circle.", "in a circle"),
        ("Three forks standing upright.", "upright"),
        ("A bear lying on its back.", "lying on its back"),
        ("A mug rotated by 45 degrees.", "rotated by 45 degrees"),
        ("A cup tilted to one side.", "tilted"),
        ("A ruler across a box and a chair.", "across"),
        ("A lamp on two books.", "together"),
        ("Three chairs facing each other.", "facing each other"),
        ("A chair at the corner of a rug, a box in the corner of a bed.", ""),
        ("A clock with a white face.", ""),
        ("Four chairs around a table.", ""),
    ],
)  # fmt: skip
def test_what_is_said_otherwise_is_not_held(sentence: str, note: str):
    plan = PLANNER.plan(sentence)
    near = {one for one in held(plan) if "in_corner" not in one}
    assert not near
    assert not note or any(each.startswith("not arranged") and note in each for each in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "carriers"),
    [
        ("A plank across two blocks.", ("block 1", "block 2")),
        ("A board lies across two boxes.", ("box 1", "box 2")),
        ("A plank on two crates.", ("crate 1", "crate 2")),
        ("A box on top of two other boxes.", ("box 2", "box 3")),
    ],
)  # fmt: skip
def test_what_lies_across_is_carried_by_all(sentence: str, carriers: tuple[str, ...]):
    plan = PLANNER.plan(sentence)
    (child,) = {rel.child for rel in plan.relations if rel.supports}
    assert sorted(rel.parent for rel in plan.relations if rel.child == child) == sorted(carriers)
    assert not plan.notes


def test_what_lies_across_one_bowl_is_held_to_it():
    plan = PLANNER.plan("A spoon across a bowl on a placemat.")
    assert held(plan) == {"spoon across bowl"}
    assert plan.parent("spoon") == "bowl"
    assert not plan.notes
    two = PLANNER.plan("Two spoons across a bowl.")
    assert not held(two)
    assert any(note.startswith("not arranged") and "across" in note for note in two.notes)
    # On what has no rim, being on it is lying across it.
    assert not held(PLANNER.plan("A pencil across a book."))


def test_what_is_far_from_something_on_a_table_is_on_the_table():
    plan = PLANNER.plan("A bowl is on a table. A mug is far from the bowl.")
    assert plan.parent("mug") == "table"


def test_what_cannot_be_under_is_beside_and_said():
    plan = PLANNER.plan("A chair hanging from a tree, with a ball under it.")
    assert "ball next_to tree" in set(map(str, plan.relations))


def test_what_leans_and_what_is_under_is_told_once():
    from pat3d.plan.telling import tell

    assert tell(PLANNER.plan("A book leaning against a box.")) == (
        "A book and a box stand on the ground. The book is leaning against the box."
    )


@pytest.mark.parametrize(
    ("sentence", "rows", "columns"),
    [
        ("Six dominoes in two rows on a table.", ["123", "456"], ["14", "25", "36"]),
        ("Two rows of three cans.", ["123", "456"], ["14", "25", "36"]),
        ("A 2x3 grid of cups.", ["123", "456"], ["14", "25", "36"]),
        ("A grid of six cups on a tray.", ["123", "456"], ["14", "25", "36"]),
        ("Seven mugs in a grid.", ["1234", "567"], ["15", "26", "37"]),
        ("Five cups in two rows.", ["123", "45"], ["14", "25"]),
        ("A row of four cups.", ["1234"], []),
        ("Two stacks of three plates in a row.", ["14"], []),
    ],
)
def test_every_row_and_every_column_is_a_row_of_the_scene(sentence: str, rows: list[str], columns: list[str]):
    plan = PLANNER.plan(sentence)
    assert not plan.notes
    held = [one for one in plan.held() if one.kind == "row"]
    assert ["".join(name.split()[-1] for name in one.objects) for one in held] == [*rows, *columns]


def test_rows_behind_each_other_are_told_as_one_and_what_lies_in_a_vessel_stands_in_no_row():
    from pat3d.plan.telling import tell

    told = tell(PLANNER.plan("Eleven cups in three rows."))
    assert told.endswith("The eleven cups are in three rows of four, four and three, one behind the other.")
    boxed = PLANNER.plan("Two rows of three eggs in a carton.")
    assert not boxed.held()
    assert any(note.startswith("not arranged") for note in boxed.notes)


@pytest.mark.parametrize(
    ("sentence", "standing"),
    [
        ("A row of three books on a shelf.", ["book 1", "book 2", "book 3"]),
        ("Three books side by side on a bookshelf.", ["book 1", "book 2", "book 3"]),
        ("Three books side by side on a shelf, the middle one leaning on the left one.", ["book 1", "book 3"]),
        ("Three books in a row on a table.", []),
        ("A row of three mugs on a shelf.", []),
        ("Two stacks of two books in a row on a shelf.", []),
        ("Two books on a shelf.", []),
        ("A bookshelf with three books and a vase.", ["book 1", "book 2", "book 3"]),
        ("Three books lying on a shelf.", []),
        ("A stack of three books on a shelf.", []),
        ("Three mugs on a shelf.", []),
        ("Three dominoes standing upright in a row on a table.", ["domino 1", "domino 2", "domino 3"]),
    ],
)
def test_books_in_a_row_on_a_shelf_stand(sentence: str, standing: list[str]):
    plan = PLANNER.plan(sentence)
    assert [one.object for one in plan.turned() if one.kind == "on_its_side"] == standing
    assert not plan.notes


@pytest.mark.parametrize(
    ("sentence", "wanted"),
    [
        ("A lamp in the corner of the desk, a laptop in the middle, and a pen at the edge.",
         {"lamp in_corner desk", "laptop in_middle desk", "pen at_edge desk"}),
        ("A desk with a lamp in the corner and a pen at the edge.", {"lamp in_corner desk", "pen at_edge desk"}),
        ("A coffee table with a vase in the corner.", {"vase in_corner coffee table"}),
        ("A bowl in the middle of the table and a mug at the edge.", {"bowl in_middle table", "mug at_edge table"}),
        # A corner is the room's where furniture stands in it, and a middle a row's.
        ("A desk with a lamp, and a chair in the corner.", set()),
        ("A desk and a table with a lamp in the corner.", set()),
    ],
)  # fmt: skip
def test_places_are_on_the_surface_that_is_spoken_of(sentence: str, wanted: set[str]):
    plan = PLANNER.plan(sentence)
    assert held(plan) == wanted
    for arranged in plan.held():
        assert all(plan.parent(name) == arranged.of[0] for name in arranged.objects)


def test_many_books_stand_in_rows_of_a_dozen_at_most():
    rows = [one.objects for one in PLANNER.plan("Thirty books on a bookshelf.").held() if one.kind == "row"]
    assert [len(row) for row in rows] == [10, 10, 10]
    assert len({name for row in rows for name in row}) == 30


@pytest.mark.parametrize(
    ("prompt", "row"),
    [
        ("A pear, a plum and a lemon stand in a row, the lemon in the middle.", ("pear", "lemon", "plum")),
        ("A pear, a plum and a lemon stand in a row, the lemon on the left.", ("lemon", "pear", "plum")),
        ("A pear, a plum and a lemon in a row, the pear at the right end.", ("plum", "lemon", "pear")),
        ("A pear, a plum and a lemon stand in a row from right to left.", ("lemon", "plum", "pear")),
        ("A row of four pens, the third one green.", ("pen 1", "pen 2", "green pen", "pen 3")),
        ("Three pens in a row, the right one green.", ("pen 1", "pen 2", "green pen")),
        ("Three pens are in a row, the green one in the middle.", ("pen 1", "green pen", "pen 2")),
        ("Four pens in a row with the green one at the right end.", ("pen 1", "pen 2", "pen 3", "green pen")),
        ("A red pen, a blue pen and a green pen in a row with the green pen in the middle.",
         ("red pen", "green pen", "blue pen")),
    ],
)  # fmt: skip
def test_who_stands_where_in_a_row(prompt: str, row: tuple[str, ...]):
    plan = PLANNER.plan(prompt)
    assert [one.objects for one in plan.arrangements if one.kind == "row"] == [row]
    assert {str(rel) for rel in plan.relations if rel.kind == "left_of"} >= {
        f"{a} left_of {b}" for a, b in itertools.pairwise(row)
    }


def test_what_is_said_of_two_of_a_row_and_heard_of_one_is_noted():
    notes = PLANNER.plan("Five pens in a row, the first and the last one green.").notes
    assert 'not understood: "the first"' in notes


@pytest.mark.parametrize("prompt", ["A bucket with a board across the top.", "A bucket, and a board across the top."])
def test_across_the_top_is_across_the_one_vessel(prompt: str):
    plan = PLANNER.plan(prompt)
    assert held(plan) == {"board across bucket"}
    assert plan.notes == ()
