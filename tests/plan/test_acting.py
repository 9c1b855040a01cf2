"""The robot that is told what to do is no object of the scene; where it stands is named in a note."""

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "said", "task"),
    [
        ("Put the plum to the right of the robot into the pot.", "to the right of the robot", "place:plum:pot"),
        ("Put the plum in the pot in front of the robot.", "in front of the robot", "place:plum:pot"),
        ("Pick up the plum nearest to the robot.", "nearest to the robot", "pick:plum"),
        ("Pick up the plum behind the robot arm.", "behind the robot arm", "pick:plum"),
        ("Put the plum on the robot's right side into the pot.", "on the robot's right side", "place:plum:pot"),
        ("Move the plum between the pot and the robot.", "between the pot and the robot", None),
        ("Push the plum toward the robot.", "toward the robot", None),
    ],
)
def test_the_robot_that_acts_is_a_landmark_that_a_note_names(prompt: str, said: str, task: str | None):
    plan = PLANNER.plan(prompt)
    assert {obj.noun for obj in plan.objects} <= {"plum", "pot"}
    assert f'not modelled: "{said}"' in plan.notes
    assert plan.task == task


@pytest.mark.parametrize("means", ["with the robot", "using the gripper", "by the robot"])
def test_what_something_is_done_with_is_set_aside(means: str):
    plan = PLANNER.plan(f"Pick up the plum {means}.")
    assert ([obj.noun for obj in plan.objects], plan.task, plan.set_aside) == (["plum"], "pick:plum", (means,))
    assert plan.notes == ()


def test_what_is_in_reach_is_in_nothing():
    plan = PLANNER.plan("A plum and a pot are on a table within the robot's reach.")
    assert [obj.noun for obj in plan.objects] == ["plum", "pot", "table"]
    assert plan.notes == ('not modelled: "within the robot\'s reach"',)


@pytest.mark.parametrize(
    "prompt",
    [
        "Put the plum next to the toy robot.",
        "There is a robot on the table. Put the plum in front of the robot.",
        "A plum lies in front of the robot.",
    ],
)
def test_a_robot_that_is_spoken_of_as_a_thing_is_one(prompt: str):
    assert "robot" in " ".join(obj.noun for obj in PLANNER.plan(prompt).objects)


def test_two_of_a_kind_are_told_apart_by_the_side_of_the_robot_that_they_are_on():
    plan = PLANNER.plan(
        "Pick up the mug to the left of the robot and put it next to the mug to the right of the robot."
    )
    assert {str(relation) for relation in plan.relations} == {"mug 2 right_of mug 1"}
    assert 'not modelled: "to the left of the robot"' in plan.notes
