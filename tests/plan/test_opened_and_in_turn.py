"""Steps that take for granted what stands where before them, and places that a thing is put in one after another."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from tests.plan.vocabulary import steps, told

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "made"),
    [
        ("Put the plum in the bowl and then the bin.", ["place:plum:bowl", "place:plum:bin"]),
        ("Place the spoon on the tray, then the shelf.", ["place:spoon:tray", "place:spoon:shelf"]),
        ("A marble is on a rug. Drop it in the cup and then the bucket.", ["place:marble:cup", "place:marble:bucket"]),
        ("Put the sponge in the mug, then the sink.", ["place:sponge:mug", "place:sponge:sink"]),
        ("Put the comb in the box, then the handbag.", ["place:comb:box", "place:comb:handbag"]),
        # What is no place for the first goes where that is.
        ("Put the plum in the bowl and then the fig.", ["place:plum:bowl", "place:fig:bowl"]),
        ("Put the jar in the crate, then the mug.", ["place:jar:crate", "place:mug:crate"]),
        ("Put the saucer in the sink and then the pot.", ["place:saucer:sink", "place:pot:sink"]),
    ],
)
def test_a_thing_put_in_two_places_in_turn(prompt: str, made: list[str]) -> None:
    assert steps(PLANNER.plan(prompt)) == made


@pytest.mark.parametrize(
    ("prompt", "relations", "task"),
    [
        ("Open the crate, move the pear to the tray.", "pear in crate", "place:pear:tray"),
        ("Open the box; bring the bell to the shelf.", "bell in box", "place:bell:shelf"),
        ("Open the toolbox and pick up the wrench.", "wrench in toolbox", "pick:wrench"),
        ("Open the oven. Transfer the butter to the plate.", "butter in oven", "place:butter:plate"),
        # The lid is no part of what is inside, and what is put into it is not there before.
        ("Open the jar and remove the lid.", "", "pick:lid"),
        ("Open the box and move the bell into it.", "", "place:bell:box"),
        ("The pear is on a mat. Open the crate and move the pear to the tray.", "pear on mat", "place:pear:tray"),
        ("Open the box, put the bell on the shelf.", "", "place:bell:shelf"),
    ],
)
def test_what_is_taken_is_in_what_is_opened_before(prompt: str, relations: str, task: str) -> None:
    plan = told(PLANNER.plan(prompt))
    assert (plan[1], plan[2]) == (relations, task)
    assert any("open the" in note.lower() for note in plan[3])


@pytest.mark.parametrize(
    "prompt",
    ["How would you put the fig on the saucer?", "How do I put the fig on the saucer?",
     "How to place the fig on the saucer", "How about putting the fig on the saucer?",
     "What is the best way to put the fig on the saucer?"],
)  # fmt: skip
def test_a_question_of_how_asks_for_it(prompt: str) -> None:
    objects, relations, task, _ = told(PLANNER.plan(prompt))
    assert (objects, relations, task) == ("fig, saucer", "", "place:fig:saucer")


@pytest.mark.parametrize(
    "prompt",
    ["Empty the box; pears in the bowl, bell on the shelf.", "Unpack the box: pears in the bowl, bell on the shelf.",
     "Empty the box, pears in the bowl, bell on the shelf.", "Empty the box. Pears in the bowl, bell on the shelf."],
)  # fmt: skip
def test_a_list_of_goals_behind_what_is_emptied_is_of_what_is_in_it(prompt: str) -> None:
    objects, relations, task, _ = told(PLANNER.plan(prompt))
    assert objects == "box, pear 1, pear 2, pear 3, bowl, bell, shelf"
    assert relations == "pear 1 in box, pear 2 in box, pear 3 in box, bell in box"
    assert task == "place:pear 1:bowl, place:pear 2:bowl, place:pear 3:bowl, place:bell:shelf"


@pytest.mark.parametrize("prompt", ["Empty the crate. A bell is on the shelf.", "Empty the crate; a pear is in it."])
def test_what_is_there_is_no_list_of_goals(prompt: str) -> None:
    assert steps(PLANNER.plan(prompt)) == ["unload:crate"]
