"""What is told by the order of a list, what alone is there, and which half of an instruction is no task."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "coloured"),
    [
        ("A mug, a bowl and a plate stand in a row; the last one is red.", {"plate": "red"}),
        ("A cup, a jar and a candle are on the shelf; the last one is white.", {"candle": "white"}),
        ("There is a vase, a lamp and a clock on the shelf. The first is blue, the second one is red.",
         {"vase": "blue", "lamp": "red"}),
        ("On the desk are a mug, a pen and a book. The second one is blue.", {"pen": "blue"}),
        ("A mug, a glass and a bottle. The first one holds a pen, the last one is red.", {"bottle": "red"}),
        ("Cup, bowl, plate on a table, the last one red.", {"plate": "red"}),
        ("A cup, a jar and a can. The first is red, the second green, the third one blue.",
         {"cup": "red", "jar": "green", "can": "blue"}),
        ("A cup and a bowl are on a shelf. Four cans in a line, the second one blue.", {"can": "blue"}),
        ("There are three cups on a table. The second one is red.", {"cup": "red"}),
    ],
)  # fmt: skip
def test_the_last_one_of_a_list_is_the_last_thing_named(prompt: str, coloured: dict[str, str]):
    objects = PLANNER.plan(prompt).objects
    assert {obj.noun: obj.colours[0] for obj in objects if obj.colours} == coloured


@pytest.mark.parametrize("prompt", [
    "A box holds a pen and a ruler. The second one is red.",
    "A tray with a cup, a bowl and a jar on it; the second one is upside down.",
])  # fmt: skip
def test_the_second_of_no_list_is_nothing(prompt: str):
    plan = PLANNER.plan(prompt)
    assert not any(obj.colours for obj in plan.objects)
    assert not plan.postures
    assert any(note.lower() == 'not understood: "the second one"' for note in plan.notes)


def test_the_last_of_several_and_one_is_told():
    assert (
        '"The last one" is read as one of "Two cans".' in PLANNER.plan("Two cans and a mug. The last one is red.").notes
    )


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Nothing remained on the shelf but a candle and a bottle.", {"candle on shelf", "bottle on shelf"}),
        ("Nothing stood on the table except a lamp and a vase.", {"lamp on table", "vase on table"}),
        ("Nothing is in the box but a ball and two pens.", {"ball in box", "pen 1 in box", "pen 2 in box"}),
        ("Nothing else is on the desk than a laptop and a phone.", {"laptop on desk", "phone on desk"}),
        ("Nothing could be seen on the desk except for three books.", {f"book {at} on desk" for at in (1, 2, 3)}),
        ("Nothing besides a spoon is in the cup.", {"spoon in cup"}),
        ("The box holds nothing except a ball.", {"ball in box"}),
        ("Nothing is on the plate.", set()),
    ],
)
def test_nothing_but_some_things_is_these(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "steps"),
    [
        ("Put the apple on the plate, and the fork beside it.", ["place:apple:plate", "beside:fork:next_to:plate"]),
        ("Put the lid back on the pot, and the spoon beside it.", ["place:lid:pot", "beside:spoon:next_to:pot"]),
        ("Move the ball into the box, and the cube in front of the box.",
         ["place:ball:box", "beside:cube:in_front_of:box"]),
        ("Put the red cup next to the jar and the lemon in the bowl.",
         ["beside:red cup:next_to:jar", "place:lemon:bowl"]),
    ],
)  # fmt: skip
def test_the_half_that_is_beside_something_is_a_step(prompt: str, steps: list[str]):
    plan = PLANNER.plan(prompt)
    assert plan.task == chain(*steps)
    assert not [note for note in plan.notes if "no task does that" in note]


@pytest.mark.parametrize(
    ("prompt", "task", "half"),
    [
        ("Put the apple on the plate, and the fork under the bowl.", "place:apple:plate", "the fork under the bowl"),
        ("Move the ball into the box, and the cube far from the box.", "place:ball:box", "the cube far from the box"),
        ("Put the red cup under the lamp and the lemon in the bowl.", "place:lemon:bowl", "the red cup under the lamp"),
    ],
)  # fmt: skip
def test_the_half_that_is_no_task_is_named_alone(prompt: str, task: str, half: str):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert f'not modelled: "{half}": no task does that.' in plan.notes


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Three mugs are on a tray; the fourth stands next to it.",
         {"mug 1 on tray", "mug 2 on tray", "mug 3 on tray", "mug 4 next_to tray"}),
        ("Two cups are on the shelf; the third is on the table and the fourth is in the box.",
         {"cup 1 on shelf", "cup 2 on shelf", "cup 3 on table", "cup 4 in box"}),
        ("Four oranges are in the bowl, the fifth lies next to it.",
         {*(f"orange {at} in bowl" for at in range(1, 5)), "orange 5 next_to bowl"}),
        ("Three of the four cups are on the tray, the fourth is on the table.",
         {"cup 1 on tray", "cup 2 on tray", "cup 3 on tray", "cup 4 on table"}),
    ],
)  # fmt: skip
def test_the_fourth_behind_three_is_one_more(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


def test_the_fourth_of_a_row_of_three_is_told():
    plan = PLANNER.plan("Three cups stand in a row. The fourth is red.")
    assert len(plan.objects) == 3
    assert '"The fourth": there are only 3.' in plan.notes


@pytest.mark.parametrize(
    ("prompt", "turned"),
    [
        ("On the desk stand a white and two black cans, the black ones upside down.", {"black can 1", "black can 2"}),
        ("A red and two blue vases are on the floor, the red one lying on its side.", {"red vase"}),
        ("A white cup and two black cups are on a tray, the white one on its side.", {"white cup"}),
        ("Two white cups and a black bowl on a tray, the cups upside down.", {"white cup 1", "white cup 2"}),
        ("Three mugs and a bowl, the mugs upside down, on a shelf.", {"mug 1", "mug 2", "mug 3"}),
    ],
)
def test_a_posture_of_what_was_named_is_its_posture(prompt: str, turned: set[str]):
    assert {posture.object for posture in PLANNER.plan(prompt).postures} == turned


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("A cup and a can, the can in a box.", {"can in box"}),
        ("A cup and two cans, the cans in a box.", {"can 1 in box", "can 2 in box"}),
        ("A white and two black cups, the black ones in a box.", {"black cup 1 in box", "black cup 2 in box"}),
        ("A cup, a can and a jar; the jar is in a box.", {"jar in box"}),
        ("A box holding a cup, and the cup holds a pen.", {"cup in box", "pen in cup"}),
    ],
)
def test_what_is_named_again_in_a_list_is_told_of_alone(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("On the tray, from the left: a cup, a bowl, a spoon.", {"cup left_of bowl", "bowl left_of spoon"}),
        ("On the tray, from the right: a cup, a bowl, a spoon.", {"bowl left_of cup", "spoon left_of bowl"}),
        ("On the tray are, from left, a cup and a bowl.", {"cup left_of bowl"}),
        ("From the left, there are a cup, a bowl and a spoon on the tray.", {"cup left_of bowl", "bowl left_of spoon"}),
        ("A tray, from the left: a cup, a bowl.", {"cup left_of bowl"}),
    ],
)
def test_from_the_left_is_a_row(prompt: str, relations: set[str]):
    told = {str(relation) for relation in PLANNER.plan(prompt).relations}
    assert {each for each in told if " on tray" not in each} == relations
    assert sum(" on tray" in each for each in told) == len(relations) + 1


def test_what_is_stacked_in_brackets_is_a_stack_of_its_own():
    plan = PLANNER.plan("On the table, from the left: a mug, a kettle, two bowls (stacked), a lamp.")
    carried = {str(relation) for relation in plan.relations if relation.supports}
    assert carried == {"mug on table", "kettle on table", "bowl 1 on table", "bowl 2 on bowl 1", "lamp on table"}


@pytest.mark.parametrize(
    ("prompt", "counts"),
    [
        ("The table is set: at each end a mug, a spoon left of each mug.", {"mug": 2, "spoon": 2}),
        ("At either end of the table is a plate, a fork left of each plate and a knife right of each.",
         {"plate": 2, "fork": 2, "knife": 2}),
        ("At each end of the table is a plate, a knife right of each.", {"plate": 2, "knife": 2}),
        ("At each end of a shelf stands a box; a ball is next to each.", {"box": 2, "ball": 2}),
    ],
)  # fmt: skip
def test_each_of_what_is_at_both_ends_has_its_own(prompt: str, counts: dict[str, int]):
    plan = PLANNER.plan(prompt)
    made = [obj.noun for obj in plan.objects]
    assert {noun: made.count(noun) for noun in counts} == counts
    beside = [rel for rel in plan.relations if not rel.supports]
    assert {rel.parent[:-2] for rel in beside} == {next(iter(counts))}
    assert len(beside) == sum(counts.values()) - 2


@pytest.mark.parametrize(
    ("prompt", "things", "note"),
    [
        ("There isn't any fork, but a spoon and a knife are lying on the napkin.", ["knife", "napkin", "spoon"], ""),
        ("A plate is on the table; there isn't a fork.", ["plate", "table"], ""),
        ("Neither the bowl nor the jar has anything in it; the cup contains a spoon.", ["bowl", "cup", "jar", "spoon"],
         "Neither the bowl nor the jar has anything in it"),
        ("Neither the cup nor the plate is on the tray.", ["cup", "plate", "tray"],
         "Neither the cup nor the plate is on the tray"),
    ],
)  # fmt: skip
def test_what_is_denied_beside_what_is_there_is_left_out(prompt: str, things: list[str], note: str):
    plan = PLANNER.plan(prompt)
    assert sorted(obj.noun for obj in plan.objects) == things
    assert f'not modelled: "{note}"' in plan.notes or not note


@pytest.mark.parametrize(
    "prompt", ["Neither a fork nor a spoon lies on the plate.", "There isn't", "Neither the cup nor"]
)
def test_a_denial_alone_is_refused(prompt: str):
    with pytest.raises(PromptError):
        PLANNER.plan(prompt)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        (
            "The stack consists of, from bottom to top, a book, a magazine and a phone.",
            {"magazine on book", "phone on magazine"},
        ),
        (
            "The pile consists of, from top to bottom, a phone, a magazine and a book.",
            {"magazine on book", "phone on magazine"},
        ),
        ("A tower is made up of a red cube, a blue cube and a ball.", {"blue cube on red cube", "ball on blue cube"}),
        ("We can see one basket with two red apples.", {"red apple 1 in basket", "red apple 2 in basket"}),
    ],
)
def test_what_a_stack_consists_of_is_stacked(prompt: str, relations: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "colours"),
    [
        ("A dozen pencils, half of them red, half blue, in a pencil cup.", {"red": 6, "blue": 6}),
        ("Six pens, half of them red and half of them blue, lie on a desk.", {"red": 3, "blue": 3}),
        ("Six balls: half red and half blue.", {"red": 3, "blue": 3}),
        ("Half of the ten balls are red.", {"red": 5}),
    ],
)
def test_both_halves_are_of_the_whole(prompt: str, colours: dict[str, int]):
    made = [colour for obj in PLANNER.plan(prompt).objects for colour in obj.colours]
    assert {colour: made.count(colour) for colour in made} == colours


def test_a_grid_is_so_many_by_so_many():
    assert len(PLANNER.plan("A three by two grid of cups on a table.").objects) == 7
    assert len(PLANNER.plan("A 3 by 3 grid of blocks.").objects) == 9


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Three jars: in the first, a pen; in the second, a spoon; in the third, a brush",
         {"pen in jar 1", "spoon in jar 2", "brush in jar 3"}),
        ("Three trays. On the first is a bun; on the second is a lemon; on the third is an egg.",
         {"bun on tray 1", "lemon on tray 2", "egg on tray 3"}),
        ("Two crates: in the first, two balls; in the second, a shoe",
         {"ball 1 in crate 1", "ball 2 in crate 1", "shoe in crate 2"}),
    ],
)  # fmt: skip
def test_what_is_in_the_first_and_the_next_is_in_those_that_were_counted(prompt: str, relations: set[str]):
    assert {str(relation) for relation in GrammarPlanner().plan(prompt).relations} == relations


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Two jars: one with a pen, one with a nut, both on a bench",
         {"pen in jar 1", "nut in jar 2", "jar 1 on bench", "jar 2 on bench"}),
        ("Two crates, one with a ball, the other with a shoe, both on a bench",
         {"ball in crate 1", "shoe in crate 2", "crate 1 on bench", "crate 2 on bench"}),
        ("Two trays and three spoons, one of the spoons in a jar", {"spoon 1 in jar"}),
        ("A mug and two lemons, one of the lemons on a tray", {"lemon 1 on tray"}),
    ],
)  # fmt: skip
def test_what_is_told_last_is_of_those_it_names(prompt: str, relations: set[str]):
    assert {str(relation) for relation in GrammarPlanner().plan(prompt).relations} == relations
