"""Whom a request is said to, what it is called and the picture that shows a scene are no objects of it."""

from __future__ import annotations

import pytest

from pat3d.errors import PromptError
from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("said", "aside"),
    [
        ("Robot, put the cup on the plate.", "Robot"),
        ("Robot: put the cup on the plate.", "Robot"),
        ("Hey robot put the cup on the plate.", "Hey robot"),
        ("Dear robot, please put the cup on the plate.", "Dear robot"),
        ("Put the cup on the plate, robot.", "robot"),
        ("Could you put the cup on the plate, robot?", "robot"),
        ("Hello! Put the cup on the plate.", "Hello"),
        ("Okay, now put the cup on the plate.", "Okay, now"),
        ("Your task: put the cup on the plate.", "Your task"),
        ("Step 1: put the cup on the plate.", "Step 1"),
    ],
)
def test_whom_it_is_said_to_is_no_object(said, aside):
    plan = PLANNER.plan(said)
    assert [obj.noun for obj in plan.objects] == ["cup", "plate"]
    assert plan.task == "place:cup:plate"
    assert set(plan.set_aside) <= {aside}
    assert plan.notes == ()


@pytest.mark.parametrize("name", ["Honey", "Ginger", "Olive", "Muffin", "Darling", "Alexa", "Robot", "Daisy"])
@pytest.mark.parametrize(
    ("said", "relation", "task"),
    [
        ("your cup is on the plate", "cup on plate", None),
        ("there is a cup on a plate", "cup on plate", None),
        ("the cup stands next to the plate", "cup next_to plate", None),
        ("put the cup on the plate", "", "place:cup:plate"),
        ("could you put the cup on the plate?", "", "place:cup:plate"),
    ],
)
def test_a_bare_name_before_a_clause_is_spoken_to(name, said, relation, task):
    plan = PLANNER.plan(f"{name}, {said}")
    assert [obj.noun for obj in plan.objects] == ["cup", "plate"]
    assert ", ".join(map(str, plan.relations)) == relation
    assert plan.task == task
    assert plan.set_aside == (name,)


@pytest.mark.parametrize(
    ("said", "objects"),
    [
        ("Honey, milk and bread are on the table.", {"honey", "milk carton", "bread", "table"}),
        ("Honey, a loaf of bread and a spoon are on the table.", {"honey", "bread", "spoon", "table"}),
        ("Desk, the lamp is on the left.", {"desk", "lamp"}),
        ("Basket, a ball is next to it.", {"basket", "ball"}),
        ("Peaches, the spoon is in the bowl.", {"peach", "spoon", "fruit bowl"}),
    ],
)
def test_a_name_that_opens_a_list_or_a_place_is_no_one_spoken_to(said, objects):
    plan = PLANNER.plan(said)
    assert {obj.noun for obj in plan.objects} == objects
    assert plan.set_aside == ()


@pytest.mark.parametrize(
    "said",
    [
        "In the photo, a cup stands next to a plate.",
        "In this picture a cup stands next to a plate.",
        "In a photo there is a cup next to a plate.",
        "In the photograph is a cup next to a plate.",
        "In this image we see a cup next to a plate.",
        "In the image: a cup next to a plate.",
        "A cup is next to a plate in the picture.",
    ],
)
def test_the_picture_that_shows_it_is_no_object(said):
    plan = PLANNER.plan(said)
    assert [obj.noun for obj in plan.objects] == ["cup", "plate"]
    assert ", ".join(map(str, plan.relations)) == "cup next_to plate"
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("said", "objects"),
    [
        ("Robot, cup and plate on a table.", {"robot", "cup", "plate", "table"}),
        ("A robot, a cup and a plate are on a table.", {"robot", "cup", "plate", "table"}),
        ("A photo hangs on a wall. In the photo, a dog sits on a sofa.", {"picture frame", "dog", "sofa"}),
        ("In the picture frame there is a photo.", {"picture frame"}),
    ],
)
def test_what_is_there_stays(said, objects):
    assert {obj.noun for obj in PLANNER.plan(said).objects} == objects


@pytest.mark.parametrize("said", ["In the photo,", "In the picture we see", "Hey", "Okay,", "Step 1:"])
def test_what_says_nothing_is_refused_or_read(said):
    try:
        plan = PLANNER.plan(said)
    except PromptError:
        return
    assert plan.objects
