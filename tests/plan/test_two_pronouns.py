"""Two pronouns in one step: the first is what is moved, the second what it is put beside, on or in."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Bring the mug to the plate and set it on it.", "place:mug:plate"),
        ("Push the ball to the bowl and put it into it.", "place:ball:bowl"),
        ("Slide the can to the lamp: put it behind it.", "beside:can:behind:lamp"),
        ("Carry the vase to the book and place it next to it.", "beside:vase:next_to:book"),
        ("Take the lid off the pan and lay it beside it.", "beside:lid:next_to:pan"),
        ("Grab the pen from the jar and put it left of it.", "beside:pen:left_of:jar"),
        ("Pick up the spoon beside the saucer and put it on it.", "place:spoon:saucer"),
        ("There is a green block and a white block. Put it on it.", "place:green block:white block"),
        ("A lid is on the pot. Put it next to it.", "beside:lid:next_to:pot"),
    ],
)
def test_the_first_is_moved_and_the_second_stays(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


def test_what_is_put_beside_nothing_else_has_no_task():
    plan = PLANNER.plan("Take the carrot and put it next to it.")
    assert plan.task is None
    assert any('"put it next to it"' in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "task"),
    [
        ("Push the jar to the crate, then put the jar on the crate.", "place:jar:crate"),
        ("Move the cup to the plate and the fork to the bowl.", "chain:place:cup:plate:then:place:fork:bowl"),
    ],
)
def test_what_is_brought_somewhere_begins_what_is_done_there(prompt: str, task: str):
    assert PLANNER.plan(prompt).task == task


@pytest.mark.parametrize(
    ("prompt", "steps"),
    [
        (
            "Put two of the four jars on the red tray and the rest on the blue one.",
            ("jar 1:red tray", "jar 2:red tray", "jar 3:blue tray", "jar 4:blue tray"),
        ),
        ("Put the egg in the large bowl and the fig in the small one.", ("egg:large bowl", "fig:small bowl")),
        ("Put the egg in the small bowl and the fig in the large bowl.", ("egg:small bowl", "fig:large bowl")),
        (
            "Put the red ring on the green peg and the blue one on the yellow one.",
            ("red ring:green peg", "blue ring:yellow peg"),
        ),
    ],
)
def test_one_is_of_the_kind_of_the_goal_before(prompt: str, steps: tuple[str, ...]):
    assert PLANNER.plan(prompt).task == "chain:" + ":then:".join(f"place:{step}" for step in steps)


def test_a_lid_is_on_what_it_is_put_beside_later():
    plan = PLANNER.plan("Lift the jar's lid and put it beside the jar.")
    assert plan.task == "beside:lid:next_to:jar"
    assert ("lid", "on", "jar") in {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


def test_that_is_what_was_named_last_and_no_pronoun():
    plan = PLANNER.plan("A rug lies on the floor, a stool stands on it, and a jug is on that.")
    assert ("jug", "on", "stool") in {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


@pytest.mark.parametrize(
    "prompt", ["A plate of steak with a fork and a glass of wine.", "A plate of cookies with a cup."]
)
def test_tableware_is_not_on_the_food(prompt: str):
    plan = PLANNER.plan(prompt)
    assert not {rel.parent for rel in plan.relations} - {"plate", "table"}
