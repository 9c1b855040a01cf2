"""Words that are no things where they stand: a can that is a verb, a number that is a name, a tool, a mark."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain, told

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "objects", "task"),
    [
        ("Put the mug on the shelf so that I can find it.", "mug, shelf", "place:mug:shelf"),
        ("Fetch the towel so we can mop the floor.", "towel", "pick:towel"),
        ("I need the lamp but my hands are full, can you help?", "lamp", None),
        ("Can someone bring me the towel?", "towel", None),
        ("Open the drawer so that you can see what is inside.", "cabinet, drawer", "open:drawer"),
        ("Give me something that can charge my phone.", "phone", None),
        ("A bowl that can hold two apples is on the table.", "bowl, table, apple 1, apple 2", None),
        ("Move the laptop to the chair. It can go on top.", "laptop, chair", "place:laptop:chair"),
        ("Can you throw away the pear and bring me the cup?", "pear, cup", "pick:cup"),
        ("Throw sock into basket", "sock, basket", "place:sock:basket"),
        ("Grab the handle to swing the fridge open.", "fridge", None),
        ("Move the cube so that its corner matches the mug.", "cube, mug", None),
    ],
)
def test_a_verb_is_no_thing(prompt: str, objects: str, task: str | None):
    plan = PLANNER.plan(prompt)
    assert ({obj.name for obj in plan.objects}, plan.task) == (set(objects.split(", ")), task)


@pytest.mark.parametrize(
    ("prompt", "objects", "relations", "task"),
    [
        ("A can on a tray", "can, tray", "can on tray", None),
        ("The can you see on the table is red.", "red can, table", "red can on table", None),
        ("Put that can on the shelf.", "can, shelf", "", "place:can:shelf"),
        ("Pick up can and place it in bin", "can, bin", "", "place:can:bin"),
        ("Find that can somewhere and put it on the desk.", "can, desk", "", "place:can:desk"),
        ("On the shelf you can see two mugs.", "shelf, mug 1, mug 2", "mug 1 on shelf, mug 2 on shelf", None),
        ("Throw and pillow on a bed", "throw, pillow, bed", "throw on bed, pillow on bed", None),
        ("Matches next to a candle", "matches, candle", "matches next_to candle", None),
    ],
)
def test_a_name_stays_one(prompt: str, objects: str, relations: str, task: str | None):
    assert told(PLANNER.plan(prompt)) == (objects, relations, task, [])


@pytest.mark.parametrize(
    ("prompt", "objects", "task", "numbers"),
    [
        ("Put the 4 block on top of the 5 block.", "block 1, block 2", "place:block 1:block 2", "45"),
        ("Put the 7 cube on the 3 cube.", "cube 1, cube 2", "place:cube 1:cube 2", "73"),
        ("Move the #8 box to the left of the number 9 box.", "box 1, box 2", "beside:box 1:left_of:box 2", "89"),
        ("Move 9 block to the left of 6 block.", "block 1, block 2", "beside:block 1:left_of:block 2", "96"),
        ("Move the 3 tile next to tile 2.", "tile 1, tile 2", "beside:tile 1:next_to:tile 2", "3"),
        ("Pick up the 6 cube and put it in the bin.", "cube, bin", "place:cube:bin", "6"),
    ],
)
def test_a_number_before_one_thing_is_its_name(prompt: str, objects: str, task: str, numbers: str):
    made, _, asked, notes = told(PLANNER.plan(prompt))
    assert (made, asked) == (objects, task)
    assert [note[:24] for note in notes] == [f'not modelled: "number-{number}"' for number in numbers]


def test_a_number_before_several_counts():
    made, _, _, notes = told(PLANNER.plan("Put the 2 boxes on the table."))
    assert (made, notes) == ("box 1, box 2, table", [])
    assert told(PLANNER.plan("Put the 2 sheep on the table."))[0] == "sheep 1, sheep 2, table"


@pytest.mark.parametrize(
    ("prompt", "objects", "task", "said"),
    [
        ("Pick up pancake with spatula", "pancake, spatula", "pick:pancake", "with spatula"),
        ("Pick up bread with knife", "bread, knife", "pick:bread", "with knife"),
        ("Lift the salmon with the fork", "fork, salmon", "pick:salmon", "with the fork"),
        ("Move meat into bowl with spatula", "meat, bowl, spatula", "place:meat:bowl", "with spatula"),
        ("Pick up egg using spoon", "egg, spoon", "pick:egg", "using spoon"),
        ("Flip egg with spatula", "egg, spatula", None, "flip egg with spatula"),
        ("Dry bowl with tea towel", "bowl, tea towel", None, "dry bowl with tea towel"),
        ("Cut salmon with knife", "salmon, knife", None, "cut salmon with knife"),
        ("Cover pan with napkin", "pan, napkin", None, "cover pan with napkin"),
        ("Wash frying pan with sponge", "frying pan, sponge", None, "wash frying pan with sponge"),
    ],
)
def test_a_tool_lies_by_itself(prompt: str, objects: str, task: str | None, said: str):
    made, relations, asked, notes = told(PLANNER.plan(prompt))
    assert (made, relations, asked) == (objects, "", task)
    assert any(note.lower().startswith(f'not modelled: "{said}"') for note in notes)


@pytest.mark.parametrize("prompt", ["Pick up plate with fork", "Pick up the plate with the fork"])
def test_what_carries_cutlery_has_it(prompt: str):
    assert told(PLANNER.plan(prompt)) == ("plate, fork", "fork on plate", "pick:plate", [])


@pytest.mark.parametrize("prompt", ["Push the block into the green square.", "Drag the cup to the red square."])
def test_a_mark_is_no_block(prompt: str):
    with pytest.raises(PromptError, match='"square" is not in the catalogue'):
        PLANNER.plan(prompt)


def test_the_square_of_two_is_meant():
    plan = PLANNER.plan("A square block and a round block are on a tray. The square is red.")
    assert {obj.name for obj in plan.objects if "red" in obj.name} == {"red block"}


@pytest.mark.parametrize(
    ("prompt", "relations", "task"),
    [
        ("Put the mug in the sink. Leave the phone on the table.", "phone on table", "place:mug:sink"),
        ("Put the mug in the sink. Please keep the lamp on the desk.", "lamp on desk", "place:mug:sink"),
        ("Leave the cake on the plate. Move the fork to the tray.", "cake on plate", "place:fork:tray"),
        ("Pick up the mug. Leave the mug on the tray.", "", "place:mug:tray"),
        ("Leave the phone on the table.", "", "place:phone:table"),
        ("Put the mug in the sink. Leave the phone to the right of the lamp.", "phone right_of lamp", "place:mug:sink"),
    ],
)
def test_what_is_left_there_stays(prompt: str, relations: str, task: str):
    assert told(PLANNER.plan(prompt))[1:] == (relations, task, [])


@pytest.mark.parametrize(
    "prompt",
    ["I want the dishwasher open", "I'd like the laptop closed", "I need the oven to be shut", "We want the lamp on"],
)
def test_a_wished_state_is_no_request_for_the_thing(prompt: str):
    _, relations, task, notes = told(PLANNER.plan(prompt))
    assert (relations, task, notes) == ("", None, [f'not modelled: "{prompt}": no task does that.'])


def test_several_steps_stay_in_order():
    plan = PLANNER.plan("Put the 1 cube on the 2 cube and the 3 cube on the tray.")
    assert plan.task == chain("place:cube 1:cube 2", "place:cube 3:tray")
