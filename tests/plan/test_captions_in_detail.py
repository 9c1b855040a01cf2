"""Captions with sizes of rooms, views, styles, ranks and names: what they say of things, and what is only noted."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


def _nouns(sentence: str) -> list[str]:
    return sorted(f"{' '.join((*obj.colours, obj.noun))}" for obj in PLANNER.plan(sentence).objects)


def _relations(sentence: str) -> set[str]:
    return {str(relation) for relation in PLANNER.plan(sentence).relations}


def _said(sentence: str) -> str:
    """What notes and what is set aside quote."""
    plan = PLANNER.plan(sentence)
    notes = (note for note in plan.notes if not note.startswith("worded like nothing"))
    return " ".join((*notes, *plan.set_aside))


@pytest.mark.parametrize(
    ("sentence", "size"),
    [
        ("a minimalist bedroom with a queen bed and an oak dresser, 4m x 4m", "4m x 4m"),
        ("A fancy restaurant with two tables and a lamp; 7 x 9m", "7 x 9m"),
        ("a 4 by 5 meter office with a desk and a chair", "4 by 5 meter"),
        ("a small kitchen with a stove, 3x4 m", "3x4 m"),
        ("A bathroom, 3 x 2 meters, with a toilet and a sink", "3 x 2 meters"),
        ("A living room (5m x 6m) with a sofa and a lamp.", "5m x 6m"),
        ("A garage with a workbench, 12 x 15 feet.", "12 x 15 feet"),
        ("An office of 4 by 5 meters with a desk", "4 by 5 meters"),
    ],
)
def test_no_thing_is_as_large_as_the_room(sentence: str, size: str):
    assert all(obj.extent is None for obj in PLANNER.plan(sentence).objects)
    assert size in _said(sentence)


@pytest.mark.parametrize(
    "sentence",
    ["a table with a box, 0.6m x 0.8m", "a bedroom with a bed and a rug, 2m x 3m", "a kitchen with a counter, 2 x 1 m"],
)
def test_what_may_be_so_large_is(sentence: str):
    assert sum(obj.extent is not None for obj in PLANNER.plan(sentence).objects) == 1


@pytest.mark.parametrize(
    ("sentence", "nouns", "said"),
    [
        ("A mug with a spoon inside, viewed from the side at table level", ["mug", "spoon"], "at table level"),
        ("A lamp on a desk, photographed at eye level", ["desk", "lamp"], "at eye level"),
        ("a toy car on a rug, camera at floor level", ["rug", "toy car"], "camera at floor level"),
        ("A shot at eye level of a mug on a tray", ["mug", "tray"], "at eye level"),
        ("A vase on a shelf viewed from below", ["shelf", "vase"], "viewed from below"),
        ("A bowl and a mug, shot from an angle", ["bowl", "mug"], "shot from an angle"),
        ("a cat on a chair, as seen in a mirror", ["cat", "chair"], "as seen in a mirror"),
        ("a plate and a fork on a desk in the real scene", ["desk", "fork", "plate"], "the real scene"),
        ("With the style of Disney movie, a lamp and a mug", ["lamp", "mug"], "the style of Disney movie"),
        ("In the style of an oil painting, a bowl and a mug", ["bowl", "mug"], "style of an oil painting"),
        ("With a cinematic look, a mug on a desk", ["desk", "mug"], "With a cinematic look"),
        ("the workbench of an enthusiast with a hammer", ["hammer", "workbench"], "of an enthusiast"),
        ("the desk of a young student with a lamp", ["desk", "lamp"], "of a young student"),
        ("the kitchen of a chef with a pot and a pan", ["pan", "pot"], "of a chef"),
        ("a living room with a staircase, a sofa and a lamp", ["lamp", "sofa"], "a staircase"),
        ("a hallway with stairs and a table", ["table"], "stairs"),
        ("The armchair is the corner chair.", ["armchair"], "corner"),
        ("The table is the coffee table.", ["table"], "is the coffee table"),
        ("a white shelf or rack, filled with two boxes", ["box", "box", "white shelf"], "or rack"),
        ("a mug or cup next to a plate", ["mug", "plate"], "or cup"),
        ("a wooden tray or cutting board with a knife", ["knife", "tray"], "or cutting board"),
    ],
)
def test_what_is_no_thing_is_said(sentence: str, nouns: list[str], said: str):
    assert _nouns(sentence) == nouns
    assert said in _said(sentence)


@pytest.mark.parametrize(
    ("sentence", "nouns"),
    [
        ("A vase stands next to a mirror", ["mirror", "vase"]),
        ("a red ball or a blue ball on a table", ["blue ball", "red ball", "table"]),
        ("A basket with no plums or limes.", ["basket"]),
        ("a group containing a sofa with a lamp", ["lamp", "sofa"]),
        ("a set composed of a table and two chairs", ["chair", "chair", "table"]),
        ("a group made up of a bed and a lamp", ["bed", "lamp"]),
        ("a stack of printer paper", ["stack of paper"]),
        ("a pile of three documents", ["stack of paper"] * 3),
    ],
)
def test_nothing_else_is_there(sentence: str, nouns: list[str]):
    assert _nouns(sentence) == nouns


@pytest.mark.parametrize(
    ("sentence", "relations"),
    [
        # A stack of sheets is one thing.
        ("A pen lies across a stack of parchment paper", {"pen on stack of paper"}),
        ("A ruler is on a pile of documents", {"ruler on pile of paper"}),
        ("a mug on a stack of sheets of paper", {"mug on stack of paper"}),
        ("A pencil on a stack of white paper", {"pencil on white stack of paper"}),
        ("a stapler on a pile of lined papers", {"stapler on pile of paper"}),
        ("Put the key on the stack of manuscripts.", set()),
        # The middle before a side is that of the room.
        ("A room with a sofa, a rug in the middle in front of the sofa", {"rug in_front_of sofa"}),
        ("a coffee table in the center behind the sofa", {"coffee table behind sofa"}),
        ("an office with a desk, a chair in the middle, next to the desk", {"chair next_to desk"}),
        ("a table with a vase in the middle next to a bowl", {"vase on table", "bowl on table", "vase next_to bowl"}),
        # Beside the middle of a surface is on it.
        ("My laptop rests slightly left and back from the center of my desk.", {"laptop on desk"}),
        ("A mug sits a bit to the right of the middle of the table.", {"mug on table"}),
        ("a vase placed just left of the center of the shelf", {"vase on shelf"}),
        ("A jar stands a little behind the centre of the nightstand", {"jar on nightstand"}),
        ("A clock stands slightly off center on the shelf", {"clock on shelf"}),
        # What several objects are is told next.
        ("A table holds several objects. There is a mug. There is a pen.", set()),
        ("The workspace contains several objects placed on a table. There is a mug, a pen.",
         {"mug on table", "pen on table"}),
        ("There are many things on a shelf. There is a jar in front of a book.",
         {"jar on shelf", "book on shelf", "jar in_front_of book"}),
        ("A number of items lie on a desk. There is a pen. There is a mug.", {"pen on desk", "mug on desk"}),
        ("The table has several objects on it. There is a cup and a plate.", {"cup on table", "plate on table"}),
        ("A work surface made of marble with lots of gadgets on it: a toaster and a kettle.",
         {"toaster on marble work surface", "kettle on marble work surface"}),
        ("There are several objects on a table. There is a chair next to the table.", {"chair next_to table"}),
        # What is also there is where the others are.
        ("There is a big fridge and inside it there are two eggs. Also, there is a jar.",
         {"egg 1 in big fridge", "egg 2 in big fridge", "jar in big fridge"}),
        ("On the shelf there is a book. Also, there is a clock.", {"book on shelf", "clock on shelf"}),
        ("There is a table and on it there is a mug. There is also a fork.", {"mug on table", "fork on table"}),
        ("There is a basket with an apple in it. There is a pear as well.", {"apple in basket", "pear in basket"}),
        ("On the desk there is a lamp. There is also a mug. There is a pen too.",
         {"lamp on desk", "mug on desk", "pen on desk"}),
        ("There is a table with a cup on it. There is also a chair.", {"cup on table"}),
        ("On the tray is a cup. There is also a spoon next to the tray.", {"cup on tray", "spoon next_to tray"}),
        # No rug lies on a table.
        ("There is a television on the table and a rug under it.", {"television on table", "table on rug"}),
        ("A vase stands on the coffee table, with a carpet beneath it",
         {"vase on coffee table", "coffee table on carpet"}),
        ("A lamp is on the desk. There is a stool under it.", {"lamp on desk"}),
        ("a cup on the table and a saucer under it", {"saucer on table", "cup on saucer"}),
        # "In the side of" is beside it.
        ("There is a fork in the side of the plate", {"fork next_to plate"}),
        ("A bowl stands on a table. There is a spoon in the side of the bowl.",
         {"bowl on table", "spoon on table", "spoon next_to bowl"}),
        # Screens named behind a desk stand on it.
        ("a small office with a chair, desk and two monitors", {"monitor 1 on desk", "monitor 2 on desk"}),
        ("a bedroom with a bed, desk and laptop", {"laptop on desk"}),
        ("an office with a desk, keyboard and mouse", {"keyboard on desk", "computer mouse on desk"}),
        ("an office with a desk and a filing cabinet", set()),
        # The largest fruit is one of those listed.
        ("A blueberry, an apple, and a watermelon, with the largest fruit in the center, the smallest on its left, and "
         "the remaining fruit on its right", {"blueberry left_of watermelon", "apple right_of watermelon"}),
        ("A pen, a mug and a laptop, the smallest object in front of the largest one", {"pen in_front_of laptop"}),
        ("a coin, a lamp and a mug; the tallest item is to the left of the smallest", {"lamp left_of coin"}),
        ("A ball, a crate and a coin. The smallest is on the largest.", {"coin on crate"}),
        # Terse notes name each thing once.
        ("pen in pot. pot next to cup. cup beside chair. chair next to pot. hat on chair",
         {"pen in pot", "pot next_to cup", "cup next_to chair", "chair next_to pot", "hat on chair"}),
        # Names of counted things.
        ("You have 4 blocks. b3 is on top of b2. b1 is on top of b3. b4 is on the table",
         {"block 3 on block 2", "block 1 on block 3", "block 4 on table"}),
        ("There are two cubes. c1 is to the left of c2.", {"cube 1 left_of cube 2"}),
        ("There are 4 crates: A, B, C and D. A is on B. C is on D.", {"crate 1 on crate 2", "crate 3 on crate 4"}),
        ("There are 3 blocks. Block 1 is on block 2. Block 3 is next to block 2.",
         {"block 1 on block 2", "block 3 next_to block 2"}),
    ],
)  # fmt: skip
def test_each_thing_is_where_it_is_said(sentence: str, relations: set[str]):
    assert _relations(sentence) == relations


def test_what_is_assumed_of_screens_is_noted():
    assert 'assumed: "two monitors" on "desk"' in PLANNER.plan("an office with a chair, desk and two monitors").notes


def test_what_breaks_off_is_no_crash():
    with pytest.raises(PromptError, match="names no object"):
        PLANNER.plan("There is")
    assert [obj.name for obj in PLANNER.plan("A mug. There are").objects] == ["mug"]
