"""What is to be in the end is what is to be done: the scene begins without it."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain


def _plan(text):
    return GrammarPlanner().plan(text)


def _relations(plan):
    return {(each.child, each.kind, each.parent) for each in plan.relations}


@pytest.mark.parametrize(
    ("text", "task"),
    [
        ("Make sure the book is on the shelf.", "place:book:shelf"),
        ("Please ensure that the red cup is on the tray.", "place:red cup:tray"),
        ("Make sure there is a cup on the table.", "place:cup:table"),
        (
            "Ensure that the mug is next to the kettle, then put the spoon in the mug.",
            "chain:beside:mug:next_to:kettle:then:place:spoon:mug",
        ),
        ("Later, put the fork next to the plate.", "beside:fork:next_to:plate"),
        ("Take the lemon. Make sure it ends up in the bowl.", "place:lemon:bowl"),
        ("At the end, the spoon has to be on the plate.", "place:spoon:plate"),
        ("When finished, the book should lie on the desk.", "place:book:desk"),
        ("The book should be on the desk at the end.", "place:book:desk"),
        ("By the time you are done, the cup must be on the tray.", "place:cup:tray"),
        ("The mug should end up in the sink.", "place:mug:sink"),
        ("The cup ends up on the tray.", "place:cup:tray"),
        ("Now we put the cup on the tray.", "place:cup:tray"),
        ("Afterwards the mug should be on the tray.", "place:mug:tray"),
        ("By the end, the ball must be on the shelf.", "place:ball:shelf"),
        ("The task is to get the ball into the box.", "place:ball:box"),
        ("Our goal is to have the red cup on the tray.", "place:red cup:tray"),
    ],
)
def test_a_wanted_state_is_a_task_and_not_there_yet(text, task):
    plan = _plan(text)
    assert plan.task == task
    assert not _relations(plan)


@pytest.mark.parametrize(
    ("text", "tasks"),
    [
        (
            "When you're done, the two red cubes must be in the box and the green one on its lid.",
            ["place:red cube 1:box", "place:red cube 2:box", "place:green cube:lid"],
        ),
        ("Once you are done the fork should be on the tray and the cup on the saucer.",
         ["place:fork:tray", "place:cup:saucer"]),
        ("Make sure that both cups are on the tray and the spoon is in the bowl.",
         ["place:cup 1:tray", "place:cup 2:tray", "place:spoon:bowl"]),
        ("Make sure the lemon is in the bowl, then hand me the knife.", ["place:lemon:bowl", "pick:knife"]),
    ],
)  # fmt: skip
def test_several_wanted_states_are_several_tasks(text, tasks):
    plan = _plan(text)
    assert plan.task == chain(*tasks)
    assert not _relations(plan)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Ensure the camera is pointed at the plate, then pick up the fork.", "the camera is pointed at the plate"),
        ("Ensure the cup is upside down and then place it on the tray.", "the cup is upside down"),
        ("Make sure the box is closed, then pick up the cup.", "the box is closed"),
        (
            "Put the books on the shelf. After all this, let's arrange the candles next to the books.",
            "the candles next",
        ),
        ("After all this, arrange the folders next to the books.", "the folders next to the books"),
        ("Then we arrange the pens behind the books.", "the pens behind the books"),
        ("When all is done, arrange the cups next to the plates.", "the cups next to the plates"),
        ("Point the camera at the vase.", "the camera at the vase"),
    ],
)
def test_what_no_task_brings_about_is_told_and_not_there(text, said):
    plan = _plan(text)
    assert any(said in note and "no task does that" in note for note in plan.notes)
    assert not _relations(plan)
    assert not plan.postures


@pytest.mark.parametrize(
    ("text", "relation"),
    [
        ("Create a scene with a cup and a plate. Make sure the cup is on the plate.", ("cup", "on", "plate")),
        ("Place a mug on a shelf. Make sure the mug is next to a bowl.", ("mug", "on", "shelf")),
        ("The cup should be on the tray. The tray is on a bench.", ("cup", "on", "tray")),
        ("A globe is at the end of the shelf.", ("globe", "on", "shelf")),
    ],
)
def test_what_a_scene_should_have_is_there(text, relation):
    plan = _plan(text)
    assert relation in _relations(plan)
    assert plan.task is None


@pytest.mark.parametrize(
    ("text", "task"),
    [
        ("The ball is in the box. It should be on the shelf.", "place:ball:shelf"),
        ("A ball and a crate are on a bench. The goal is that the ball is in the crate.", "place:ball:crate"),
        ("A pen and a mug are on a shelf. I'd like the pen in the mug.", "place:pen:mug"),
    ],
)
def test_what_should_be_elsewhere_than_told_is_to_be_put_there(text, task):
    plan = _plan(text)
    assert plan.task == task
    assert (task.split(":")[1], task.split(":")[2]) not in {(each.child, each.parent) for each in plan.relations}


@pytest.mark.parametrize(
    ("text", "relation"),
    [
        ("Create a scene with a cup and a plate on a table. The cup should be on the plate.", ("cup", "on", "plate")),
        ("A red cup and a book are on a table. The cup should be on the left of the book.",
         ("red cup", "left_of", "book")),
    ],
)  # fmt: skip
def test_where_a_scene_or_a_side_is_asked_for_it_is_there(text, relation):
    plan = _plan(text)
    assert relation in _relations(plan)
    assert plan.task is None
    assert not plan.notes


@pytest.mark.parametrize(
    "asked",
    [
        "Only the egg should be put in the box.", "Only the egg belongs in the box.", "Only the egg goes in the box.",
        "First, the egg goes in the box.", "Just the egg should go in the box.",
    ],
)  # fmt: skip
def test_what_alone_or_first_is_to_be_somewhere_is_moved(asked):
    plan = _plan(f"An egg, a box and a fork are on a desk. {asked}")
    assert plan.task == "place:egg:box"
    assert "egg on desk" in {str(relation) for relation in plan.relations}
