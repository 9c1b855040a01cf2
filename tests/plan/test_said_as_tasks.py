"""Ordinary wordings of an instruction that have a task, and nothing done before it."""

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain

PLANNER = GrammarPlanner()


def relations(plan):
    return {(each.child, each.kind, each.parent) for each in plan.relations}


def names(plan):
    return sorted(obj.name for obj in plan.objects)


def place(*pairs):
    return [f"place:{one}:{goal}" for one, goal in pairs]


@pytest.mark.parametrize(
    ("prompt", "tasks", "noted"),
    [
        ("Make a burger by placing bread, a steak and a tomato on the plate",
         place(("bread", "plate"), ("steak", "plate"), ("tomato", "plate")), "Make a burger"),
        ("Build a snack by putting the pear and the carrot on the tray",
         place(("pear", "tray"), ("carrot", "tray")), "Build a snack"),
        ("Prepare dinner by placing a fork, a knife and a glass on the mat",
         place(("fork", "mat"), ("knife", "mat"), ("glass", "mat")), "Prepare dinner"),
        ("Please create a gift by putting a book and a pen in the box.",
         place(("book", "box"), ("pen", "box")), "Please create a gift"),
        ("Form a bridge by moving the ruler onto the cups",
         place(("ruler", "cup 1")), "Form a bridge"),
    ],
)  # fmt: skip
def test_what_is_made_by_placing_things_is_no_object(prompt, tasks, noted):
    plan = PLANNER.plan(prompt)
    assert plan.task == (chain(*tasks) if len(tasks) > 1 else tasks[0])
    assert not relations(plan)
    assert f'not modelled: "{noted}"' in plan.notes


def test_a_scene_that_is_made_by_placing_things_is_made():
    plan = PLANNER.plan("Create a scene by placing a jug on a bench.")
    assert plan.task is None
    assert relations(plan) == {("jug", "on", "bench")}


@pytest.mark.parametrize(
    ("prompt", "task", "arm"),
    [
        ("Take the jug off the bench with your left hand.", "pick:jug", "left hand"),
        ("Lift the can with arm B and set it on the tray.", "place:can:tray", "arm b"),
        ("Put the spoon in the jar using both hands.", "place:spoon:jar", "both hands"),
        ("With the left arm put the jug on the tray and with the right arm put the cup on the mat.",
         chain("place:jug:tray", "place:cup:mat"), "right arm"),
        ("Using gripper 2, pick up the pear.", "pick:pear", "gripper 2"),
        ("Move the bowl to the desk with arm A; with arm B put the pen in the cup.",
         chain("place:bowl:desk", "place:pen:cup"), "arm a"),
    ],
)  # fmt: skip
def test_with_which_arm_is_set_aside_with_a_note(prompt, task, arm):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert f'not modelled: "{arm}": a task does not say which arm acts.' in plan.notes


@pytest.mark.parametrize("prompt", ["Pick up the doll with the broken arm.", "Put the glove on the arm of the sofa."])
def test_an_arm_of_a_thing_is_none_that_acts(prompt):
    assert any('arm" of ' in note for note in PLANNER.plan(prompt).notes)


@pytest.mark.parametrize(
    ("prompt", "moves"),
    [
        ("Sort the two pens by colour, the red one in the left cup, the blue one in the right one.",
         place(("red pen", "cup 1"), ("blue pen", "cup 2"))),
        ("Sort the pears by size, the small one into the bowl, the big one into the box.",
         place(("small pear", "bowl"), ("big pear", "box"))),
        ("Sort the two toys by size: the big one goes in the box, the small one in the basket.",
         place(("big ball", "box"), ("small block", "basket"))),
        ("Separate the cans by colour, the green one on the shelf, the red one on the desk.",
         place(("green can", "shelf"), ("red can", "desk"))),
        ("Sort the jars by kind, the white one on the mat and the black one on the tray.",
         place(("white jar", "mat"), ("black jar", "tray"))),
    ],
)  # fmt: skip
def test_what_is_to_be_sorted_is_not_sorted_before(prompt, moves):
    plan = PLANNER.plan(prompt)
    assert plan.task == chain(*moves)
    assert not any(rel.supports for rel in plan.relations)


@pytest.mark.parametrize(
    ("prompt", "task", "there"),
    [
        ("Place the ruler between the mug and the lamp, on the tray.", "place:ruler:tray", {"mug", "lamp"}),
        ("Put the fig between the lemon and the pear, inside the basket.", "place:fig:basket", {"lemon", "pear"}),
        ("Put the spoon between the two jars, on the mat.", "place:spoon:mat", {"jar 1", "jar 2"}),
        ("Set the pen next to the cup, on the table.", "place:pen:table", {"cup"}),
        ("Place the fork to the left of the candle, on the desk.", "place:fork:desk", {"candle"}),
    ],
)
def test_what_a_thing_is_put_between_is_where_it_is_put(prompt, task, there):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert {child for child, kind, _ in relations(plan) if kind in ("in", "on")} == there
    assert any(note.startswith(('not modelled: "between', 'not modelled: "next', 'not modelled: "to the left')) for note
               in plan.notes)  # fmt: skip


@pytest.mark.parametrize(
    ("prompt", "task", "condition"),
    [
        (
            "If the drawer is shut open it and take the ruler",
            chain("open:drawer", "pick:ruler"),
            "If the drawer is shut",
        ),
        ("If the jar is empty put it in the sink", "place:jar:sink", "If the jar is empty"),
        ("When the basket is full move it to the bench.", "place:basket:bench", "When the basket is full"),
        ("If there is a pear on the desk put it in the bowl.", "place:pear:bowl", "If there is a pear on the desk"),
        ("Once the crate is open put the hat in it.", "place:hat:crate", "Once the crate is open"),
    ],
)
def test_a_condition_may_have_no_comma(prompt, task, condition):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert f'not modelled: "{condition}"' in plan.notes


@pytest.mark.parametrize(
    "prompt",
    ["Build a pyramid from these six cans.", "Make a pyramid out of the three boxes.",
     "Build a wall from these four bricks.", "Please build a house with the five blocks.",
     "There are ten cups. Build a pyramid of them."],
)  # fmt: skip
def test_what_is_to_be_built_is_not_there_before(prompt):
    plan = PLANNER.plan(prompt)
    assert plan.task is None
    assert not plan.arrangements
    assert any(note.endswith("no task does that.") for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "moves"),
    [
        ("Put the watch in the watch box and the box in the crate.", place(("watch", "box"), ("box", "crate"))),
        ("Put the key in the purse and the purse in the basket.", place(("key", "purse"), ("purse", "basket"))),
        ("Put the pen in the cup and the cup in the box.", place(("pen", "cup"), ("cup", "box"))),
        ("Place the fig in the bowl and the bowl on the tray.", place(("fig", "bowl"), ("bowl", "tray"))),
        ("Put the doll in the crate and the crate on the desk.", place(("doll", "crate"), ("crate", "desk"))),
    ],
)
def test_what_was_filled_is_moved_with_it(prompt, moves):
    assert PLANNER.plan(prompt).task == chain(*moves)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Place the jug and the bowl next to each other.", "beside:bowl:next_to:jug"),
        ("Help me move the jug and the can from the desk to the bench. Place them next to each other.",
         chain("place:jug:bench", "beside:can:next_to:jug")),
        ("Set the two candles beside each other on the tray.",
         chain("place:candle 1:tray", "beside:candle 2:next_to:candle 1")),
        ("Take the pear, the fig and the lemon to the desk and put them next to each other on it.",
         chain("place:pear:desk", "beside:fig:next_to:pear", "beside:lemon:next_to:fig")),
        ("Could you make sure the pear ends up in the bowl", "place:pear:bowl"),
        ("Can you ensure both jars are on the shelf", chain("place:jar 1:shelf", "place:jar 2:shelf")),
        ("Make sure the box contains the ruler and the pen", chain("place:ruler:box", "place:pen:box")),
        ("I want to have the jug on the mat", "place:jug:mat"),
        ("Would you be able to put the fig in the bowl?", "place:fig:bowl"),
        ("Please assist me by putting the jug on the tray.", "place:jug:tray"),
        ("Grab the ruler from its current position.", "pick:ruler"),
        ("1- take the pen 2- put the pen in the cup 3- done", "place:pen:cup"),
        ("Put the fig in the bowl 2- put the pear on the plate 3- done", chain("place:fig:bowl", "place:pear:plate")),
        ("Pick up all of the groceries and put them in the crate",
         chain("place:milk carton:crate", "place:bread:crate", "place:apple:crate")),
        ("Take the fig, pear and lemon to the bench and set them down on it.",
         chain("place:fig:bench", "place:pear:bench", "place:lemon:bench")),
        ("Take the egg from the pot put it on the plate", "place:egg:plate"),
        ("get a pear put it in the bowl get a fig put it in the cup", chain("place:pear:bowl", "place:fig:cup")),
        ("Put the pear in the crate We need it for the trip", "place:pear:crate"),
        ("Place the AlarmClock on the SideTable", "place:alarm clock:side table"),
        ("Put the wide dish often used for serving soup on the tray", "place:dish:tray"),
        ("Lift the jug and put it into the basket meant for carrying tools", "place:jug:basket"),
        ("Pick up the pen or the ruler.", "pick:pen"),
        ("Put the fig in either the cup or the bowl.", "place:fig:cup"),
        ("Put the pear in the bowl, after that the fig.", chain("place:pear:bowl", "place:fig:bowl")),
        ("stack blue on white, then black on blue",
         chain("stack:blue block:white block", "stack:black block:blue block")),
        ("Put the jar on the upside-down jar", "place:jar 1:jar 2"),
        ("Move the dry towel onto the wet towel", "place:towel 1:towel 2"),
        ("Put the jug on the stand.", "place:jug:cake stand"),
    ],
)  # fmt: skip
def test_ordinary_wordings_have_a_task(prompt, task):
    plan = PLANNER.plan(prompt)
    assert plan.task == task


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("Put the wide dish often used for serving soup on the tray", 'not modelled: "often used for serving soup"'),
        ("Pick up the pen or the ruler.", '"Pick up the pen or the ruler": the first that is named is taken.'),
        ("Put blue on white", "a colour alone is read as a block of it."),
        ("Put the jug on the stand.", '"the stand": 1 assumed: cake stand; which is not said.'),
        ("Move everything from the tray to the desk except for the pen.", 'not understood: "Move everything"'),
        ("this room is a mess, could you put away the wet towel?",
         'not modelled: "could you put away the wet towel": no task does that.'),
    ],
)  # fmt: skip
def test_what_is_not_as_said_is_noted(prompt, note):
    assert note in PLANNER.plan(prompt).notes


def test_what_goes_next_to_each_other_in_a_description_is_there():
    plan = PLANNER.plan("A jug and a bowl are next to each other.")
    assert plan.task is None
    assert relations(plan) == {("bowl", "next_to", "jug")}


@pytest.mark.parametrize("prompt", ["Put the cup on the cup.", "Put the jar next to the jar."])
def test_one_thing_is_not_put_on_itself(prompt):
    with pytest.raises(PromptError, match="are one thing here"):
        PLANNER.plan(prompt)


@pytest.mark.parametrize(
    ("prompt", "word"),
    [("Put the jug in the woven holder.", "holder"), ("Stack in the order of red, blue and white", "order")],
)
def test_what_is_not_known_is_refused_by_its_word(prompt, word):
    with pytest.raises(PromptError, match=word):
        PLANNER.plan(prompt)


def test_an_appliance_is_told_by_what_it_is_used_for():
    assert PLANNER.plan("Put the fig into the appliance used for baking bread.").task is None


def test_a_fruit_that_is_called_like_a_colour_is_no_block():
    assert PLANNER.plan("Move the lime next to the orange").task == "beside:lime:next_to:orange"
