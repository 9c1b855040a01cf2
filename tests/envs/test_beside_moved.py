"""Chains that put something beside what an earlier step moves: what is allowed, what counts, and that it is done."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box
from pat3d.envs.tasks.beside import Beside
from pat3d.envs.tasks.beside_moved import BesideMoved
from pat3d.envs.tasks.chain import Chain
from pat3d.envs.tasks.registry import parse_task
from pat3d.errors import TaskError
from pat3d.scene.arrangements import Arrangement
from pat3d.scene.model import Relation, Scene
from pat3d.scene.task_spec import chain_of
from tests.envs.beside_scenes import BOARD, CUBE, made, put, rest, scripted
from tests.scenes import GAP, asset_of, placed, scene_of

PLATE = asset_of(box(0.06, 0.06, 0.02))
STEPS = ("place:plate:board", "beside:fork:left_of:plate", "beside:knife:right_of:plate")
SET = f"chain:{STEPS[0]}:then:{STEPS[1]}:then:{STEPS[2]}"
SHORT = f"chain:{STEPS[0]}:then:{STEPS[1]}"
ON = 0.02 + 2 * GAP
"""Height of what stands on the board [m]."""


def bowl():
    """A solid that says that its inside begins on top, with a rim that is not there."""
    asset = asset_of(box(0.14, 0.14, 0.02))
    return replace(asset, regions=(replace(asset.regions[0], kind="in", height=0.05),))


@pytest.fixture(scope="module")
def laid() -> Scene:
    """A board, around which stand a plate, a fork, a knife, a jar with a cap on it, a bowl and a tray."""
    return scene_of(
        placed("board", BOARD, (0.0, 0.0, GAP)),
        placed("plate", PLATE, (0.0, -0.25, GAP)),
        placed("fork", CUBE, (-0.26, -0.1, GAP)),
        placed("knife", CUBE, (0.26, -0.1, GAP)),
        placed("jar", CUBE, (0.26, 0.1, GAP)),
        placed("cap", asset_of(box(0.03, 0.03, 0.02)), (0.26, 0.1, 0.05 + 2 * GAP)),
        placed("bowl", bowl(), (0.0, 0.3, GAP)),
        placed("tray", asset_of(box(0.15, 0.15, 0.01)), (-0.26, 0.28, GAP)),
        relations=(Relation(child="cap", kind="on", parent="jar"),),
    )


@pytest.fixture(scope="module")
def env(laid, tmp_path_factory):
    env = made(laid, SET, tmp_path_factory)
    yield env
    env.close()


def test_a_specification_is_read_back_and_said(laid):
    task = parse_task(SET)
    assert isinstance(task, Chain)
    assert task.spec == SET == chain_of(STEPS)
    assert task == parse_task(task.spec)
    assert task.steps[1] == Beside(target="fork", relation="left_of", landmark="plate")
    assert [step.spec for step in task.turns] == list(STEPS)
    assert [isinstance(step, BesideMoved) for step in task.turns] == [False, True, True]
    assert task.instruction(laid) == (
        "first put the plate on the board, then put the fork to the left of the plate, "
        "then put the knife to the right of the plate"
    )


@pytest.mark.parametrize(
    "spec",
    [
        SET,
        "chain:stack:plate:board:then:beside:fork:next_to:plate",
        # Where it stands at the start neither counts as done nor has to have room.
        "chain:place:plate:board:then:beside:fork:left_of:plate:then:beside:knife:left_of:plate",
        "chain:place:cap:board:then:beside:fork:left_of:cap",
        # Beside something is on the surface of that, and again for the next one.
        "chain:beside:plate:behind:jar:then:beside:fork:left_of:plate",
        "chain:place:plate:board:then:beside:fork:left_of:plate:then:beside:knife:in_front_of:fork",
        # What was moved onto its place before and carries nothing by then.
        "chain:place:cap:bowl:then:place:plate:board:then:beside:jar:left_of:plate",
        "chain:lift:plate:then:beside:knife:left_of:plate",
    ],
)
def test_what_was_moved_to_a_surface_has_something_beside_it(laid, spec):
    parse_task(spec).check(laid)


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("chain:beside:knife:left_of:plate:then:place:plate:board", 'this chain: another step moves "plate"'),
        (f"{SHORT}:then:pick:board", 'another step moves "board"'),
        ("chain:place:plate:tray:then:place:tray:board:then:beside:fork:left_of:plate", 'another step moves "tray"'),
        ("chain:beside:plate:behind:jar:then:beside:fork:left_of:plate:then:pick:jar", 'step moves "jar"'),
        ("chain:place:plate:bowl:then:beside:fork:left_of:plate", '"place:plate:bowl" puts "plate" into a container'),
        ("chain:place:plate:board:then:beside:spoon:left_of:plate", '"spoon" is not in the scene'),
        ("chain:place:plate:board:then:beside:board:left_of:plate", '"plate" stands on "board"'),
        ("chain:place:plate:board:then:beside:jar:left_of:plate", '"jar" carries "cap" and cannot'),
        ("chain:place:plate:board:then:stack:cap:fork:then:beside:fork:left_of:plate", '"fork" carries "cap"'),
        ("chain:stack:fork:knife:then:beside:plate:left_of:fork", '"knife" has no top wide enough for "fork" with "pl'),
    ],
)
def test_what_cannot_be_is_refused(laid, spec, message):
    with pytest.raises(TaskError, match=message):
        parse_task(spec).check(laid)


def test_what_is_moved_by_hand_only_has_to_move(laid):
    fixed = replace(laid, objects=tuple(replace(obj, fixed=obj.name == "fork") for obj in laid.objects))
    with pytest.raises(TaskError, match='"fork" is fixed'):
        parse_task(SHORT).check(fixed)


def test_things_that_are_to_carry_one_another_are_refused():
    blocks = (placed(name, PLATE, (0.2 * number, 0.0, GAP)) for number, name in enumerate("abc"))
    with pytest.raises(TaskError, match='"a" stands on "b" when it is to carry that'):
        parse_task("chain:stack:a:b:then:stack:b:a:then:beside:c:left_of:a").check(scene_of(*blocks))


def test_what_is_in_the_middle_of_something_at_the_start_may_leave_it(laid):
    middle = Arrangement(kind="in_middle", objects=("cap",), of=("jar",))
    parse_task("chain:place:cap:board:then:beside:fork:left_of:cap").check(replace(laid, arrangements=(middle,)))


@pytest.mark.parametrize("way", ["place:cap:board", "beside:cap:right_of:knife"])
def test_what_comes_out_of_a_container_may_have_something_beside_it(laid, way):
    inside = replace(laid, relations=(Relation(child="cap", kind="in", parent="bowl"),))
    task = parse_task(f"chain:{way}:then:beside:fork:left_of:cap")
    task.check(inside)
    assert task.needs(inside).grasp == ("cap", "fork")
    assert task.turns[1].outlook(inside).landmark.centre == pytest.approx([0.26, 0.1])


def test_what_is_lifted_and_put_back_stands_where_it_stood(laid):
    task = parse_task("chain:lift:plate:then:beside:knife:left_of:plate")
    assert task.turns == task.steps


def test_the_hand_has_to_get_above_the_new_carrier(laid):
    plate, fork = parse_task(SET).turns[:2]
    assert fork.needs(laid).grasp == ("fork",)
    assert fork.needs(laid).visit == plate.needs(laid).visit


def test_a_workbench_has_room_beside_where_the_landmark_comes(laid):
    chain = parse_task("chain:beside:plate:right_of:jar:then:beside:fork:right_of:plate")
    plate, fork = (step.needs(laid) for step in chain.turns)
    assert fork.visit[0][0] > plate.visit[0][0] + 0.06
    assert fork.room[1][0] > fork.visit[0][0] + 0.02
    assert plate.room[1][0] < fork.room[1][0]


def test_a_fork_goes_onto_the_board_beside_the_plate(env):
    env.reset(seed=0, options={"task": SET})
    fork = env.task.turns[1]
    put(env, "plate", (-0.02, 0.0, ON))
    state = env.simulation.state
    goals = fork.goals(state, ("fork",))
    assert [goal.height for goal in goals] == pytest.approx([0.02] * len(goals), abs=1e-3)
    assert all(-0.131 < goal.at[0] < -0.05 and abs(goal.at[1]) < 0.111 for goal in goals), "all of it is over the board"
    put(env, "fork", (-0.1, 0.0, GAP))
    assert fork.goals(state, ("fork",)), "under the board is no place"
    put(env, "fork", (-0.1, 0.0, ON))
    assert not fork.goals(state, ("fork",))
    assert [goal.name for goal in env.task.goals(state, ("fork", "knife"))] == ["knife"] * 6


def test_a_chain_is_done_when_all_is_where_it_was_told_in_turn(env):
    env.reset(seed=0, options={"task": SET})
    put(env, "plate", (0.0, 0.0, ON))
    assert rest(env)["predicates"][f"step 1: {STEPS[0]}"]
    put(env, "fork", (-0.1, 0.0, ON))
    assert rest(env)["predicates"][f"step 2: {STEPS[1]}"], "the plate was moved in its own step"
    put(env, "knife", (0.1, 0.0, ON))
    info = rest(env)
    assert info["success"]
    assert info["progress"] == 1.0


def test_a_fork_beside_where_the_plate_was_or_on_the_table_is_not_there(env):
    env.reset(seed=0, options={"task": SHORT})
    put(env, "fork", (-0.1, -0.25, GAP))
    assert not rest(env)["success"], "the plate was not moved"
    put(env, "plate", (0.0, 0.0, ON))
    info = rest(env)
    assert info["predicates"][f"step 1: {STEPS[0]}"]
    assert not info["success"]
    put(env, "fork", (-0.25, 0.0, GAP))
    assert not rest(env)["success"], "left of the plate, but not on the board"
    put(env, "fork", (-0.1, 0.0, ON))
    assert rest(env)["success"]


def test_nothing_is_done_ahead_of_the_plate(env):
    env.reset(seed=0, options={"task": SHORT})
    put(env, "fork", (-0.1, 0.0, ON))
    assert not rest(env)["success"]
    put(env, "plate", (0.0, 0.0, ON))
    assert not rest(env, 9)["success"]
    assert rest(env)["success"]


@pytest.mark.parametrize(("by", "kept"), [((0.0, 0.04), True), ((0.0, 0.07), False), ((-0.13, -0.1), False)])
def test_the_plate_stays_where_it_was_when_the_fork_came(env, by, kept):
    """Within 5 cm, though the fork is left of it wherever it was moved along y."""
    env.reset(seed=0, options={"task": SET})
    put(env, "plate", (0.0, 0.0, ON))
    rest(env)
    put(env, "fork", (-0.1, 0.0, ON))
    rest(env)
    put(env, "plate", (*by, ON))
    assert put(env, "knife", (by[0] + 0.1, by[1], ON))["predicates"]["kept"] is kept
    assert rest(env)["success"] is kept


def test_the_goal_is_beside_the_plate_wherever_it_is(env):
    env.reset(seed=0, options={"task": SHORT})
    put(env, "plate", (0.0, 0.05, ON))
    rest(env)
    assert env.verdict.target == "fork"
    assert np.array(env.verdict.goal) == pytest.approx([-0.1, 0.05, 0.045], abs=0.02)


def test_the_scripted_policy_lays_a_board(env):
    info = scripted(env, SET)
    state = env.simulation.state
    assert [state.on_top(name, "board") for name in ("plate", "fork", "knife")] == [True] * 3
    assert state.centre("fork")[0] < state.centre("plate")[0] - 0.05 < state.centre("knife")[0] - 0.1
    assert info["success"], info


def test_the_scripted_policy_puts_one_beside_the_other_on_the_table(env):
    info = scripted(env, "chain:beside:plate:behind:jar:then:beside:fork:next_to:plate")
    assert env.simulation.state.centre("fork")[0] > 0.0
    assert info["success"], info
