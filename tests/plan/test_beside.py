"""Instructions by which something comes to stand beside something else, alone or as a step of several."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell
from tests.plan.vocabulary import chain, steps

PLANNER = GrammarPlanner()


def undone(prompt: str) -> tuple[str | None, bool]:
    """The task of `prompt`, and whether a note says that no task does it."""
    plan = PLANNER.plan(prompt)
    return plan.task, any("no task does that" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Put the ladle to the left of the jug.", "beside:ladle:left_of:jug"),
        ("Place the pear right of the red vase.", "beside:pear:right_of:red vase"),
        ("Move the candle in front of the clock.", "beside:candle:in_front_of:clock"),
        ("Set the globe behind the radio.", "beside:globe:behind:radio"),
        ("Lay the spoon next to the plate.", "beside:spoon:next_to:plate"),
        ("Could you put the lime beside the kettle, please?", "beside:lime:next_to:kettle"),
        ("Stand the jar near the lamp.", "beside:jar:next_to:lamp"),
        ("Place the fork to the left side of the plate.", "beside:fork:left_of:plate"),
        ("Put the pear on the right side of the bottle.", "beside:pear:right_of:bottle"),
        ("Bring the candle to the clock.", "beside:candle:next_to:clock"),
        ("Push the jar to the globe.", "beside:jar:next_to:globe"),
        ("Pick up the pear and place it behind the jug.", "beside:pear:behind:jug"),
    ],
)
def test_where_it_is_put_is_its_task(prompt: str, task: str):
    plan = PLANNER.plan(prompt)
    assert (plan.task, plan.relations) == (task, ())
    assert not [note for note in plan.notes if "worded like nothing" not in note]


@pytest.mark.parametrize(
    ("prompt", "there", "task"),
    [
        ("A jug and a pear are on the bench. Put the pear behind the jug.", {"jug on bench", "pear on bench"},
         "beside:pear:behind:jug"),
        ("A red mug and a green mug are on a tray. Put the red one left of the green one.",
         {"red mug on tray", "green mug on tray"}, "beside:red mug:left_of:green mug"),
        ("Put the pear from the bowl next to the jug.", {"pear in bowl"}, "beside:pear:next_to:jug"),
        ("Put the cup next to the jar that is on the tray.", {"jar on tray"}, "beside:cup:next_to:jar"),
        ("Move the jar from the left of the clock to the right of it.", {"jar left_of clock"},
         "beside:jar:right_of:clock"),
    ],
)  # fmt: skip
def test_what_is_there_before_is_told_apart(prompt: str, there: set[str], task: str):
    plan = PLANNER.plan(prompt)
    assert ({str(relation) for relation in plan.relations}, plan.task) == (there, task)


@pytest.mark.parametrize(
    ("prompt", "made"),
    [
        ("Put the pear and the lime behind the jug.", ["beside:pear:behind:jug", "beside:lime:behind:jug"]),
        ("Put both forks left of the plate.", ["beside:fork 1:left_of:plate", "beside:fork 2:left_of:plate"]),
        ("Put the fork left of the plate and the knife right of it.",
         ["beside:fork:left_of:plate", "beside:knife:right_of:plate"]),
        ("Put the cup behind the plate and the spoon in front of it.",
         ["beside:cup:behind:plate", "beside:spoon:in_front_of:plate"]),
        ("Put the pear in the bowl, then put the ladle next to the bowl.",
         ["place:pear:bowl", "beside:ladle:next_to:bowl"]),
        ("Put the candle next to the clock and then pick up the pear.", ["beside:candle:next_to:clock", "pick:pear"]),
        ("Put the lemon in the basket and set the basket behind the jug.",
         ["place:lemon:basket", "beside:basket:behind:jug"]),
        ("Place the plate on the tray, the fork left of the plate, the knife right of the plate and the spoon behind "
         "the plate.",
         ["place:plate:tray", "beside:fork:left_of:plate", "beside:knife:right_of:plate", "beside:spoon:behind:plate"]),
    ],
)  # fmt: skip
def test_several_are_a_chain(prompt: str, made: list[str]):
    plan = PLANNER.plan(prompt)
    assert (plan.task, plan.relations, steps(plan)) == (chain(*made), (), made)


@pytest.mark.parametrize(
    ("prompt", "made"),
    [
        # What a vessel, a plate or a block carries leaves no room beside it there.
        ("Put the egg in the cup and the spoon beside it.", ["place:egg:cup", "beside:spoon:next_to:cup"]),
        ("Put the cup on the saucer. Put the spoon to the right of it.",
         ["place:cup:saucer", "beside:spoon:right_of:saucer"]),
        ("Stack the red block on the blue block and put the green block next to it.",
         ["stack:red block:blue block", "beside:green block:next_to:blue block"]),
        # On a tray and on a placemat things stand beside each other.
        ("Put the plate on the tray and the fork left of it.", ["place:plate:tray", "beside:fork:left_of:plate"]),
        ("Put the plate on the table and the fork beside it.", ["place:plate:table", "beside:fork:next_to:plate"]),
        ("Put the mug next to the jar. Then put the spoon left of it.",
         ["beside:mug:next_to:jar", "beside:spoon:left_of:mug"]),
        ("Put the steak on the plate and the carrot next to it.", ["place:steak:plate", "beside:carrot:next_to:steak"]),
        # Where the thing itself is named it is meant.
        ("Put the egg in the cup and the spoon beside the jug.", ["place:egg:cup", "beside:spoon:next_to:jug"]),
    ],
)  # fmt: skip
def test_beside_it_is_where_there_is_room(prompt: str, made: list[str]):
    assert PLANNER.plan(prompt).task == chain(*made)


def test_what_is_moved_twice_is_no_chain():
    plan = PLANNER.plan("Put the pear next to the jug, then put the pear in the bowl.")
    assert (plan.task, steps(plan)) == (None, ["beside:pear:next_to:jug", "place:pear:bowl"])


@pytest.mark.parametrize(
    "prompt",
    [
        # No robot reaches around furniture.
        "Put the pear next to the table.",
        "Put the cup to the right of the bench.",
        "Place the basket behind the sofa.",
        # Of more than one, or of another kind.
        "Put the pear between the jug and the clock.",
        "Move the pear between the jug and the robot.",
        "Put the pear under the lamp.",
        "Put the pear far from the jug.",
        "Move the pear away from the jug.",
        "Slide the pear around the jug.",
        "Put the pear next to the jug and the clock.",
        "Slide the pear towards the jug.",
        # What hangs, and what is filled, is where that is done.
        "Hang the mug next to the hook.",
        "Fill the cup next to the bowl.",
        # The front of what holds something is in it.
        "Put the pear in the front of the basket.",
        # A place at which it is before, and then is not.
        "Make sure that the mug behind the clock ends up on the tray.",
        "The cup left of the jug should end up in the box.",
        # What nobody moves
        "Put the sofa next to the lamp.",
    ],
)
def test_other_places_have_no_task(prompt: str):
    assert undone(prompt) == (None, True)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Bring the pear to the bowl.", "place:pear:bowl"),
        ("Bring the pear to the tray.", "place:pear:tray"),
        ("Carry the cup to the table.", "place:cup:table"),
        ("Put the cup on the left side of the table.", "place:cup:table"),
        ("Put the cup on the tray to the left of the jug.", "place:cup:tray"),
        ("Put the pear that is next to the jug in the bowl.", "place:pear:bowl"),
        ("Pick up the pear behind the jug.", "pick:pear"),
    ],
)
def test_what_comes_to_rest_on_something_is_not_beside_it(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


@pytest.mark.parametrize(
    ("prompt", "task", "lost"),
    [
        ("Put the cup left of the vase and behind the plate.", "beside:cup:behind:plate", "left of the vase"),
        ("Move the pear in front of the jug and next to the clock.", "beside:pear:next_to:clock",
         "in front of the jug"),
    ],
)  # fmt: skip
def test_of_two_places_of_one_thing_the_one_that_is_left_out_is_noted(prompt: str, task: str, lost: str):
    plan = PLANNER.plan(prompt)
    assert plan.task == task
    assert f'not modelled: "{lost}"' in plan.notes


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("Put the ladle to the left of the jug.",
         "The task is to put the ladle to the left of the jug (beside:ladle:left_of:jug)."),
        ("Put the ladle right of the jug.",
         "The task is to put the ladle to the right of the jug (beside:ladle:right_of:jug)."),
        ("Put the ladle in front of the jug.",
         "The task is to put the ladle in front of the jug (beside:ladle:in_front_of:jug)."),
        ("Put the ladle behind the jug.", "The task is to put the ladle behind the jug (beside:ladle:behind:jug)."),
        ("Put the ladle beside the jug.", "The task is to put the ladle next to the jug (beside:ladle:next_to:jug)."),
        ("Put the pear in the bowl, then the lime on the tray.",
         "The task is to put the pear in the bowl, then to put the lime on the tray "
         "(chain:place:pear:bowl:then:place:lime:tray)."),
        ("Put the two pears next to the jug and pick up the lime.",
         "The task is to put the first of the two pears next to the jug, then to put the second of the two pears next "
         "to the jug, then to pick up the lime "
         "(chain:beside:pear 1:next_to:jug:then:beside:pear 2:next_to:jug:then:pick:lime)."),
        ("Stack the red cube on the blue cube, then put the pear behind the blue cube.",
         "The task is to stack the red cube on the blue cube, then to put the pear behind the blue cube "
         "(chain:stack:red cube:blue cube:then:beside:pear:behind:blue cube)."),
    ],
)  # fmt: skip
def test_the_task_is_told_step_by_step(prompt: str, told: str):
    assert tell(PLANNER.plan(prompt)).endswith(told)
