"""Requests for a thing, and other instructions that say in everyday words what is to be fetched, put or held."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import chain, steps

PLANNER = GrammarPlanner()


def told(prompt: str) -> tuple[set[str], str | None, list[str]]:
    plan = PLANNER.plan(prompt)
    known = ("assumed.", "worded like nothing", "is made as a", "is read as picking it up")
    notes = [note for note in plan.notes if not any(word in note for word in known)]
    return {str(relation) for relation in plan.relations}, plan.task, notes


@pytest.mark.parametrize(
    ("prompt", "there", "task"),
    [
        ("Give me a ladle.", set[str](), "pick:ladle"),
        ("Give me the ladle, please.", set[str](), "pick:ladle"),
        ("Please give me the ladle on the shelf.", {"ladle on shelf"}, "pick:ladle"),
        ("I need the saw from the crate, please.", {"saw in crate"}, "pick:saw"),
        ("I'd like the globe that is on the shelf.", {"globe on shelf"}, "pick:globe"),
        ("Could I have the saw?", set[str](), "pick:saw"),
        ("We need a ladle.", set[str](), "pick:ladle"),
        ("Bring the green jug here.", set[str](), "pick:green jug"),
        ("Carry the jug over here, please.", set[str](), "pick:jug"),
        ("Take the jug from the shelf to me.", {"jug on shelf"}, "pick:jug"),
        ("A jug and a globe are on the shelf. I want the globe.", {"jug on shelf", "globe on shelf"}, "pick:globe"),
        ("Scoop up the marble.", set[str](), "pick:marble"),
    ],
)
def test_a_thing_that_is_asked_for_is_to_be_fetched(prompt: str, there: set[str], task: str):
    assert told(prompt) == (there, task, [])


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("Give me a green jug on a bench.", {"jug on bench"}),
        ("I'd like the desk beside the bed.", {"desk next_to bed"}),
        ("I need three ladles.", set[str]()),
        ("I want a bench.", set[str]()),
        ("I need a jug. It is on a tray.", {"jug on tray"}),
    ],
)
def test_a_scene_that_is_asked_for_is_to_be_made(prompt: str, there: set[str]):
    plan = PLANNER.plan(prompt)
    assert {str(relation).replace("green ", "") for relation in plan.relations} == there
    assert plan.task is None


@pytest.mark.parametrize(
    ("prompt", "there", "task", "notes"),
    [
        # What a box is brought to goes into it.
        ("Carry the marble to the red box.", set[str](), "place:marble:red box", []),
        # A basket that is dragged to a bed stands beside it.
        ("Drag the basket over to the sofa.", set[str](), None,
         ['not modelled: "Drag the basket over to the sofa": no task does that.']),
        # What is taken out of what was opened was in it.
        ("Open the crate and remove the doll.", {"doll in crate"}, "pick:doll",
         ['not modelled: "Open the crate": no task does that.', 'assumed: "the doll" in "the crate"']),
        ("A doll is on the shelf. Open the crate and take the doll.", {"doll on shelf"}, "pick:doll",
         ['not modelled: "Open the crate": no task does that.']),
        # Beside a plate is no place on it.
        ("Lay the spoon on the right of the plate.", set[str](), "beside:spoon:right_of:plate", []),
        # What is shaken or held over something is not on it.
        ("Shake the jug over the pan.", set[str](), None,
         ['not modelled: "Shake the jug over the pan": no task does that.']),
        ("Hold the lamp above the book.", set[str](), "pick:lamp", ['not modelled: "above the book"']),
        ("Pick up the jug from above the tray and placed it on the bench top.", {"jug on tray"}, "place:jug:bench", []),
        ("Pick up the jug located in the vicinity of the sink area.", {"jug next_to sink"}, "pick:jug", []),
    ],
)  # fmt: skip
def test_where_something_is_and_is_to_go(prompt: str, there: set[str], task: str | None, notes: list[str]):
    assert told(prompt) == (there, task, notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "Take the jug off the scale and put the cup on it.",
        "Start by taking the jug off the scale; finish by putting the cup on it.",
    ],
)
def test_what_a_thing_was_taken_off_is_free_for_the_next(prompt: str):
    plan = PLANNER.plan(prompt)
    assert [str(relation) for relation in plan.relations] == ["jug on scale"]
    assert (plan.task, steps(plan)) == (None, ["pick:jug", "place:cup:scale"])


def test_a_plate_that_was_taken_is_what_is_laid_on():
    plan = PLANNER.plan("Take the plate off the shelf and put the fig on it.")
    assert (plan.task, steps(plan)) == (None, ["pick:plate", "place:fig:plate"])


@pytest.mark.parametrize(
    "prompt",
    [
        "Put the jar with the nails on the bench and the jar with the nuts on the shelf.",
        "Put the jar with the nails next to the jar with the nuts.",
        "The jar with the nails is on the bench. The jar with the nuts is on the shelf.",
    ],
)
def test_vessels_that_hold_different_things_are_two(prompt: str):
    plan = PLANNER.plan(prompt)
    there = {str(relation) for relation in plan.relations}
    assert sum(obj.noun == "jar" for obj in plan.objects) == 2
    assert {"nail 1 in jar 1", "nut 1 in jar 2"} <= there


def test_one_of_each_into_each_of_several():
    plan = PLANNER.plan("Place one fig and one lime from the bench into each of the two bowls.")
    assert sorted(obj.noun for obj in plan.objects) == ["bench", "bowl", "bowl", "fig", "fig", "lime", "lime"]
    assert plan.task == chain("place:fig 1:bowl 1", "place:fig 2:bowl 2", "place:lime 1:bowl 1", "place:lime 2:bowl 2")


def test_salt_and_pepper_shakers_are_one_of_each():
    plan = PLANNER.plan("Swap the salt and the pepper shakers.")
    assert sorted(obj.name for obj in plan.objects) == ["pepper shaker", "salt shaker"]


def test_the_board_of_chess_is_a_chessboard():
    assert {obj.noun for obj in PLANNER.plan("Set the cup on the board.").objects} == {"cup", "plank"}
    assert "chessboard" in {obj.noun for obj in PLANNER.plan("Set the chess bishop on the board.").objects}


@pytest.mark.parametrize(
    ("prompt", "there", "task"),
    [
        ("Seize the ladle.", set[str](), "pick:ladle"),
        ("Extract the pen from the jar.", {"pen in jar"}, "pick:pen"),
        ("Unhook the mug from the mug tree.", {"mug hangs_from mug tree"}, "pick:mug"),
        ("Get a grip on the jug.", set[str](), "pick:jug"),
        ("Take a firm grip on the jug on the shelf.", {"jug on shelf"}, "pick:jug"),
        ("Pick up the saw with your gripper.", set[str](), "pick:saw"),
        ("Grasp the globe using your left hand.", set[str](), "pick:globe"),
        ("Strip the sofa of its blanket.", {"blanket on sofa"}, "pick:blanket"),
        ("Step one: take the jug from the crate. Step two: put it on the bench.", {"jug in crate"}, "place:jug:bench"),
        (
            "Put the red block on the blue block and leave the green one alone.",
            set[str](),
            "place:red block:blue block",
        ),
        ("Take the ruler you find in the crate.", {"ruler in crate"}, "pick:ruler"),
        ("Put teh pen in side the jar pls.", set[str](), "place:pen:jar"),
        ("Put the book ontop of the stool plz.", set[str](), "place:book:stool"),
        ("Pick up the spong.", set[str](), "pick:sponge"),
    ],
)
def test_everyday_words_and_slips(prompt: str, there: set[str], task: str):
    found, done, notes = told(prompt)
    kept = [note for note in notes if not note.startswith(("assumed:", '"spong" is read as "sponge"'))]
    kept = [note for note in kept if not note.endswith("a task does not say which arm acts.")]
    assert (found, done, kept) == (there, task, [])


@pytest.mark.parametrize(
    ("prompt", "tasks"),
    [
        ("Put the mug in the sink. Do the same with the bowl.", ["place:mug:sink", "place:bowl:sink"]),
        ("Move the pen to the tray. Do the same for the ruler.", ["place:pen:tray", "place:ruler:tray"]),
        ("Place the red block on the mat. Do the same with the blue one.",
         ["place:red block:mat", "place:blue block:mat"]),
    ],
)  # fmt: skip
def test_what_is_to_be_done_with_several(prompt: str, tasks: list[str]):
    assert told(prompt) == (set[str](), chain(*tasks), [])


def test_what_is_to_be_done_with_more_than_a_chain_holds_is_told():
    plan = PLANNER.plan("All the pens go in the red box, all the cubes in the blue one.")
    moved = [f"place:pen {n}:red box" for n in (1, 2, 3)] + [f"place:cube {n}:blue box" for n in (1, 2, 3)]
    assert (plan.task, plan.relations, steps(plan)) == (None, (), moved)
