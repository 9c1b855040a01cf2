"""Sentences about what has a door that turns: opened and shut, and what it is made as."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("sentence", "nouns", "task"),
    [
        ("Open the microwave.", "hinged microwave, hinged microwave door", "open:microwave door"),
        ("Open the door of the microwave.", "hinged microwave, hinged microwave door", "open:microwave door"),
        ("Close the fridge.", "hinged fridge, open hinged fridge door", "close:fridge door"),
        ("Shut the cabinet door.", "hinged cabinet, open hinged cabinet door", "close:cabinet door"),
        ("Pull the cupboard door open.", "hinged cabinet, hinged cabinet door", "open:cupboard door"),
        ("Push the microwave door shut.", "hinged microwave, open hinged microwave door", "close:microwave door"),
        ("Open the refrigerator door and then close it.", "hinged fridge, hinged fridge door",
         "chain:open:refrigerator door:then:close:refrigerator door"),
        ("Open the microwave, put the mug in it and close it.",
         "hinged microwave, hinged microwave door, mug",
         "chain:open:microwave door:then:place:mug:microwave:then:close:microwave door"),
        ("Open the fridge and take the apple out.", "hinged fridge, hinged fridge door, apple",
         "chain:open:fridge door:then:pick:apple"),
        ("Open the two cabinets.", "hinged cabinet, hinged cabinet door, hinged cabinet, hinged cabinet door",
         "chain:open:cabinet door 1:then:open:cabinet door 2"),
        # What is only put in is made open, and lids, folding doors and drawers are none of these.
        ("Put the mug in the microwave.", "mug, open microwave", "place:mug:microwave"),
        ("Open the oven.", "stove", None),
        ("Open the top drawer of the cabinet.", "drawer cabinet, drawer", "open:top drawer"),
    ],
)  # fmt: skip
def test_what_is_opened_or_shut_has_a_door_as_it_is_before(sentence, nouns, task):
    plan = PLANNER.plan(sentence)
    assert sorted(obj.noun for obj in plan.objects) == sorted(nouns.split(", "))
    assert plan.task == task
    for obj in plan.objects:
        if obj.noun.endswith(" door"):
            assert plan.parent(obj.name) == obj.name.replace(" door", "")


def test_case_and_door_share_what_is_said_of_them():
    plan = PLANNER.plan("Open the small red microwave on the table.")
    case, door = (obj for obj in plan.objects if obj.noun.startswith("hinged"))
    assert (case.colours, case.scale) == (door.colours, door.scale) == (("red",), case.scale)
    assert case.scale < 1.0
    assert not plan.notes


@pytest.mark.parametrize(
    ("sentence", "task"),
    [("Get the key from the cabinet, then close it.", "pick:key"),
     ("Take the apple out of the drawer and close it.", "pick:apple")],
)  # fmt: skip
def test_what_is_closed_after_something_is_picked_up_is_noted(sentence, task):
    plan = PLANNER.plan(sentence)
    assert plan.task == task
    assert any("nothing is closed after something is picked up" in note for note in plan.notes)


def test_what_is_in_it_and_on_it_stays_there():
    plan = PLANNER.plan("A mug is in the microwave and a bowl is on the microwave. Close the microwave.")
    assert {str(rel) for rel in plan.relations} == {
        "mug in microwave", "bowl on microwave", "microwave door in microwave"
    }  # fmt: skip


def test_a_size_that_is_measured_is_noted():
    plan = PLANNER.plan("Open the 60 cm tall cabinet.")
    assert any(note.startswith("not modelled: the size of") for note in plan.notes)


@pytest.mark.parametrize(
    ("sentence", "told"),
    [
        ("Open the microwave.", "A microwave stands on the ground. The microwave door is shut."),
        ("Close the fridge.", "A fridge stands on the ground. The fridge door is open."),
        ("Open the two cabinets.", "Two cabinets stand on the ground. The two cabinet doors are shut."),
    ],
)
def test_doors_are_told_as_they_are(sentence, told):
    assert tell(PLANNER.plan(sentence)).startswith(told)
