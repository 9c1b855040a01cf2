"""Rearranging to a goal picture: what is asked for, what it looks like, and that it counts when it is so."""

from __future__ import annotations

import math

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box
from pat3d.envs.env import TabletopEnv
from pat3d.envs.suites.composition import draft, pointed
from pat3d.envs.suites.request import Request
from pat3d.envs.tasks.goals import APART, AWAY, THERE, rearranged
from pat3d.envs.tasks.registry import parse_task
from pat3d.errors import TaskError
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, asset_of, placed, scene_of

SIDE = 0.04
SPEC = "rearrange:left@0.1,0.12:right@-0.1,0.12"


@pytest.fixture(scope="module")
def two():
    cube = asset_of(box(SIDE, SIDE, SIDE))
    return scene_of(placed("left", cube, (-0.1, 0.0, GAP)), placed("right", cube, (0.1, 0.0, GAP)))


@pytest.fixture(scope="module")
def env(two, tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    made = TabletopEnv(scene=two, robot=str(path), task=SPEC, goal_image=True, image_size=(96, 96))
    yield made
    made.close()


def test_a_specification_is_read_back_and_what_is_none_is_answered_with_the_form():
    assert parse_task(SPEC).spec == SPEC
    assert parse_task(SPEC).names == ("left", "right")
    for wrong in ("rearrange", "rearrange:left", "rearrange:left@0.1", "rearrange:left@0.1,1e9", "rearrange:left@a,b"):
        with pytest.raises(TaskError, match=r"rearrange:red mug@0\.1,-0\.05"):
            parse_task(wrong)
    for wrong in ("rearrange:left@0,0:left@0.1,0", ":".join(("rearrange", *(f"c{n}@0,{n}" for n in range(5))))):
        with pytest.raises(TaskError, match="1 to 4 objects are rearranged, each once"):
            parse_task(wrong)
    with pytest.raises(TaskError, match="points are within 2 m"):
        parse_task("rearrange:left@3,0")


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("rearrange:left@-0.1,0.01", "everything is where it should be"),
        ("rearrange:left@0.09,0", 'where "left" should go, at .*, is "right"'),
        ("rearrange:left@0,0.1:right@0.02,0.1", 'is "right"'),
        ("rearrange:middle@0,0.1", '"middle" is not in the scene'),
    ],
)
def test_what_cannot_be_or_is_done_is_refused(two, spec, message):
    with pytest.raises(TaskError, match=message):
        parse_task(spec).check(two)


def test_things_may_change_places(two):
    parse_task("rearrange:left@0.1,0:right@-0.1,0").check(two)


@pytest.mark.parametrize("seed", range(5))
def test_points_are_drawn_free_of_everything_and_away_from_the_start(two, seed):
    task = rearranged(two, ("left", "right"), np.random.default_rng(seed))
    task.check(two)
    points = [*task.targets(two).values()]
    starts = [(-0.1, 0.0), (0.1, 0.0)]
    assert all(math.dist(point, start) > AWAY for point, start in zip(points, starts, strict=True))
    taken = [*starts, *points]
    apart = min(math.dist(a, b) for n, a in enumerate(taken) for b in taken[:n])
    assert apart > SIDE + APART - 1e-3
    assert task == rearranged(two, ("left", "right"), np.random.default_rng(seed))


def test_a_suite_s_rearrangement_gets_its_points_from_the_scene(two):
    request = Request(tasks=("rearrange",), scenes=4)
    made = draft(request, 0, 0)
    kind, *names = made.task.split(":")
    assert kind == "rearrange"
    assert tuple(names) == made.moved
    cube = asset_of(box(SIDE, SIDE, SIDE))
    scene = scene_of(*(placed(name, cube, (0.2 * n, 0.0, GAP)) for n, name in enumerate(names)))
    found = parse_task(pointed(made, scene).task)
    found.check(scene)
    assert found.names == made.moved
    other = draft(Request(tasks=("pick",)), 0, 0)
    assert pointed(other, scene) == other


def test_the_goal_picture_shows_the_objects_where_they_should_get_to(env):
    """Drawn again once they are there, but for the robot, it is the same; the state is left as it was."""
    observation, _ = env.reset(seed=0)
    state = env.simulation.data.qpos.copy()
    goal = observation["goal_image"]
    assert env.observation_space.contains(observation)
    now = env.pictures.take("agentview", 96, 96).image
    assert (goal != now).any()
    for name, at in env.task.targets(env.scene).items():
        first = int(env.simulation.world.positions[env.objects.index(name)])
        env.simulation.data.qpos[first : first + 2] = at
    env.restart()
    np.testing.assert_array_equal(env.pictures.take("agentview", 96, 96).image, goal)
    assert not (env.reset(seed=0, options={"task": "pick:left"})[0]["goal_image"]).any()
    observation, _ = env.reset(seed=0, options={"task": SPEC})
    np.testing.assert_array_equal(env.simulation.data.qpos, state)


def test_things_at_their_points_count_and_each_is_a_share(env):
    env.reset(seed=0, options={"task": SPEC})
    still = np.zeros(7, dtype=np.float32)

    def put(name, at):
        first = int(env.simulation.world.positions[env.objects.index(name)])
        env.simulation.data.qpos[first : first + 2] = at
        return env.restart()[1]

    progress = [env.verdict.progress, put("left", (0.1, 0.12 + THERE / 2))["progress"]]
    info = put("right", (-0.1, 0.12 - 2 * THERE))
    assert info["predicates"]['"left" there']
    assert not info["predicates"]['"right" there']
    progress.append(info["progress"])
    progress.append(put("right", (-0.1, 0.12))["progress"])
    assert progress == sorted(set(progress))
    assert progress[-1] == 1.0
    steps = 0
    done = False
    while not done:
        _, _, done, _, info = env.step(still)
        steps += 1
        assert steps < 20
    assert steps >= 9, "they have to rest there for half a second"
    assert info["success"]


@pytest.mark.slow
def test_the_scripted_policy_rearranges(env):
    observation, info = env.reset(seed=1, options={"task": SPEC})
    policy = ScriptedPolicy()
    policy.reset(
        EpisodeStart(
            instruction=info["instruction"], task=SPEC, seed=1, robot=env.robot, control="osc", action_size=7,
            control_freq=20.0, env=env,
        )
    )  # fmt: skip
    success = False
    for _ in range(env.horizon):
        observation, _, success, broken, info = env.step(policy.act(observation))
        assert not broken
        if success:
            break
    assert success
    for name, at in env.task.targets(env.scene).items():
        assert math.dist(env.simulation.state.centre(name)[:2], at) <= THERE
