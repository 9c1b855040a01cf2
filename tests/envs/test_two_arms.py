"""Two arms in one environment: one does the task, the other holds still, and each is told what to do by itself."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest

pytest.importorskip("gymnasium")

import mujoco
from gymnasium.utils.env_checker import check_env

from pat3d.envs.config import TabletopConfig
from pat3d.envs.env import TabletopEnv
from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.grasping.site import APART, Frame, Site, Standing
from pat3d.envs.grasping.standing import Needs
from pat3d.envs.observations import state_keys
from pat3d.envs.physics.clearance import Clearance
from pat3d.envs.physics.loading import load
from pat3d.envs.robots.arms import make_robot, measure_gripper
from pat3d.envs.robots.pairs import Pair, arms_of, pair_of, robot_name
from pat3d.envs.tasks.registry import parse_task
from pat3d.envs.tasks.rehearsal import rehearse
from pat3d.envs.vector import BatchedTabletopEnv
from pat3d.errors import EnvironmentSetupError, EvaluationError, TaskError
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from pat3d.scene.model import Scene
from tests.envs.own_arm import own_arm
from tests.envs.test_placement import block

CLOSE = 0.005
"""A hand gets this near to where it is sent [m]."""


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """The file of an arm with a gripper."""
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.fixture(scope="module")
def pair(own):
    """An environment with two of them."""
    made = TabletopEnv(robot=[own, own], task="pick:red mug")
    yield made
    made.close()


def start_of(env) -> EpisodeStart:
    return EpisodeStart(
        instruction=env.instruction, task=env.task.spec, seed=0, robot=env.config.arms, control=env.control,
        action_size=env.action_space.shape[0], control_freq=env.control_freq, env=env,
    )  # fmt: skip


def test_two_arms_have_one_name_and_are_told_apart_by_it():
    assert robot_name("panda") == robot_name(["panda"]) == "panda"
    assert robot_name(["panda", "xarm7"]) == "panda+xarm7"
    assert arms_of("panda+xarm7") == ("panda", "xarm7")
    assert arms_of("aloha") == ("aloha/left", "aloha/right")
    assert arms_of("a.xml+panda") == ("a.xml", "panda")
    # A file may have a plus in its name.
    for single in ("panda", "a+b.xml", "robosuite:Panda", "panda+Marvin"):
        assert pair_of(single) is None
        assert arms_of(single) == (single,)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([], "one arm or two"),
        (["panda"] * 3, "one arm or two"),
        (["panda", ""], "one arm or two"),
        (["aloha", "panda"], '"aloha" is two arms already'),
        (["panda", 3], "one arm or two"),
    ],
)
def test_what_is_neither_one_arm_nor_two_is_refused(given, message):
    with pytest.raises(EnvironmentSetupError, match=message):
        robot_name(given)


def test_robosuite_s_arms_stand_alone():
    with pytest.raises(EnvironmentSetupError, match=r'no robot "Panda\+Panda".*two arms aloha'):
        TabletopEnv(robot=["Panda", "Panda"])


def test_where_there_is_room_for_one_arm_two_are_refused(own):
    with pytest.raises(EnvironmentSetupError, match="is two arms, and here is room for one"):
        make_robot(f"{own}+{own}")
    with pytest.raises(EnvironmentSetupError, match="on a GPU a robot is one arm"):
        BatchedTabletopEnv(2, robot=[own, own])


def test_gymnasium_s_checker_accepts_two_arms(pair):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(pair, skip_render_check=True)


def test_each_arm_has_its_own_values_and_cameras(pair):
    assert pair.action_space.shape == (14,)
    single = {"joint_pos", "joint_vel", "gripper_pos", "eef_pos", "eef_quat"}
    each = {f"{side}_{name}" for side in ("left", "right") for name in single}
    assert set(pair.observation_space) == each | {"objects", "target"}
    assert state_keys(list(pair.observation_space)) == tuple(
        f"{side}_{name}" for side in ("left", "right") for name in ("joint_pos", "gripper_pos", "eef_pos", "eef_quat")
    )
    names = [pair.simulation.model.camera(k).name for k in range(pair.simulation.model.ncam)]
    assert {"agentview", "frontview", "closeview", "left_wrist", "right_wrist"} <= set(names)
    config = TabletopConfig(robot="aloha", obs="rgb")
    assert config.cameras == ("agentview", "left_wrist", "right_wrist")
    known = "Cameras: agentview, frontview, closeview, wrist"
    with pytest.raises(EnvironmentSetupError, match=rf'no camera "left_wrist"\. {known}'):
        TabletopConfig(robot="panda", cameras=("left_wrist",))


def test_observations_are_those_of_the_arm_that_they_name(pair):
    observation, _ = pair.reset(seed=1)
    data, world = pair.simulation.data, pair.simulation.world
    for arm in world.arms:
        joints = [float(data.joint(arm.prefix + name).qpos[0]) for name in arm.robot.arm_joints]
        np.testing.assert_allclose(observation[f"{arm.side}_joint_pos"], joints, rtol=1e-6)
        site = data.site(arm.prefix + arm.robot.grip_site)
        np.testing.assert_allclose(observation[f"{arm.side}_eef_pos"], site.xpos, rtol=1e-6)
    left, right = (observation[f"{side}_eef_pos"] for side in ("left", "right"))
    assert np.linalg.norm(left - right) > 0.3


@pytest.mark.parametrize(("side", "first"), [("left", 0), ("right", 7)])
def test_the_first_half_of_an_action_is_the_left_arm_s(pair, side, first):
    """Upwards moves one hand up, and the other by less than 0.1 mm; the last value of a half is its fingers."""
    before, _ = pair.reset(seed=0)
    action = np.zeros(14, dtype=np.float32)
    action[first + 2], action[first + 6] = 0.5, 1.0
    for _ in range(10):
        after, *_ = pair.step(action)
    other = {"left": "right", "right": "left"}[side]
    assert after[f"{side}_eef_pos"][2] - before[f"{side}_eef_pos"][2] > 0.05
    np.testing.assert_allclose(after[f"{other}_eef_pos"], before[f"{other}_eef_pos"], atol=1e-4)
    assert np.abs(after[f"{side}_gripper_pos"] - before[f"{side}_gripper_pos"]).max() > 0.01
    np.testing.assert_allclose(after[f"{other}_gripper_pos"], before[f"{other}_gripper_pos"], atol=1e-3)


@pytest.mark.parametrize("side", ["left", "right"])
def test_each_hand_gets_to_where_it_is_sent(pair, side):
    pair.reset(seed=0)
    servo = Servo(pair, side)
    start, rotation, _ = servo.hand
    goal = start + [0.03, -0.05, 0.04]
    for _ in range(60):
        pair.step(servo.towards(goal, rotation, -1.0)[0])
    assert np.linalg.norm(servo.hand[0] - goal) < CLOSE


def test_one_arm_picks_while_the_other_holds_still(pair):
    policy = ScriptedPolicy()
    observation, _ = pair.reset(seed=0)
    idle = pair.placement.other.side
    before, success, steps = observation, False, 0
    policy.reset(start_of(pair))
    while not success and steps < 400:
        observation, _, success, *_ = pair.step(policy.act(observation))
        steps += 1
    assert success
    np.testing.assert_allclose(observation[f"{idle}_eef_pos"], before[f"{idle}_eef_pos"], atol=1e-3)


def test_what_either_arm_holds_is_held(pair):
    """Both fingers of one arm hold; a finger of each does not."""
    pair.reset(seed=0)
    state, snapshot = pair.simulation.state, pair.simulation.states.snapshot
    row = 3 + pair.simulation.states.numbers["red mug"]
    for fingers, held in (((0, 1), True), ((2, 3), True), ((0, 2), False), ((1, 3), False), ((0, 3), False)):
        snapshot.pinched[:] = False
        snapshot.pinched[0, list(fingers), row] = True
        assert state.held("red mug") == held, fingers


def test_the_nearer_arm_is_asked_first_and_the_further_one_where_that_cannot(own, monkeypatch):
    """The mug and the bowl stand on opposite sides of the tray."""
    found = load()
    sides = {name: rehearse(found.scene, found.mjcf, parse_task(f"pick:{name}"), f"{own}+{own}").side
             for name in ("red mug", "blue bowl")}  # fmt: skip
    assert set(sides.values()) == {"left", "right"}
    from pat3d.envs.grasping import placement

    reached = placement._Reach.at
    nearer = sides["red mug"]

    def only_the_other(reach, frame):
        right = frame.position[0] < 0.0
        return None if (nearer == "right") == right else reached(reach, frame)

    monkeypatch.setattr(placement._Reach, "at", only_the_other)
    other = placement.place(found.scene, f"{own}+{own}", Needs(grasp=("red mug",)))
    assert {other.side, nearer} == {"left", "right"}


def test_a_gripper_that_takes_nothing_leaves_the_task_to_the_other(own, tmp_path):
    """One of the arms carries 50 g only."""
    (tmp_path / "weak.xml").write_text(own_arm())
    (tmp_path / "weak.yaml").write_text("payload: 0.05")
    weak, found = str(tmp_path / "weak.xml"), load()
    for robot, side in ((f"{weak}+{own}", "right"), (f"{own}+{weak}", "left")):
        assert rehearse(found.scene, found.mjcf, parse_task("pick:red mug"), robot).side == side
    with pytest.raises(TaskError, match="too heavy"):
        rehearse(found.scene, found.mjcf, parse_task("pick:red mug"), f"{weak}+{weak}")


STANDING = Standing(away=0.5, riser=0.1, scale=1.0)


def first_of(pair: Pair) -> tuple[tuple[Frame, Frame], float]:
    site = Site.of(Scene(objects=(block("cube", (-0.05, -0.05, 0.0), (0.05, 0.05, 0.1)),)), Needs(grasp=("cube",)))
    return next(iter(site.pairs(STANDING, STANDING, pair)))


def test_arms_side_by_side_stand_behind_the_work_and_face_the_cameras():
    """Facing -y, the left arm is at the greater x."""
    (left, right), view = first_of(Pair(arms=("a", "b")))
    np.testing.assert_allclose(left.position, (APART / 2, 0.5, 0.1), atol=1e-12)
    np.testing.assert_allclose(right.position, (-APART / 2, 0.5, 0.1), atol=1e-12)
    assert left.yaw == right.yaw == view == pytest.approx(-math.pi / 2)


def test_arms_that_face_each_other_have_the_work_between_them_and_the_cameras_beside():
    """As seen from the cameras, at -y, the left arm is on the left, at the smaller x, and looks along +x."""
    (left, right), view = first_of(Pair(arms=("a", "b"), facing=0.9))
    np.testing.assert_allclose(left.position, (-0.45, 0.0, 0.1), atol=1e-12)
    np.testing.assert_allclose(right.position, (0.45, 0.0, 0.1), atol=1e-12)
    assert math.cos(left.yaw) == pytest.approx(1.0)
    assert math.cos(right.yaw) == pytest.approx(-1.0)
    assert view == pytest.approx(-math.pi / 2)


def test_the_other_arm_is_in_the_way_like_anything_else(pair):
    """A posture that brings one hand to where the other is meets "the other arm"."""
    pair.reset(seed=0)
    clearance, opened = Clearance(pair), pair.simulation.fingers.copy()
    assert clearance.obstacle(np.array(pair.placement.start), opened) == ""
    idle = pair.simulation.world.arm(pair.placement.other.side)
    site = pair.simulation.data.site(idle.prefix + idle.robot.grip_site)
    from pat3d.envs.robots.arms import arm_kinematics
    from pat3d.envs.robots.kinematics import PlacedArm

    arm = PlacedArm(arm_kinematics(pair.robot), pair.placement.base_position, pair.placement.yaw)
    joints = arm.solve(site.xpos.copy(), site.xmat.reshape(3, 3).copy(), np.array(pair.placement.start))
    assert joints is not None
    assert clearance.obstacle(joints, opened) == "the other arm"


def test_one_arm_of_a_file_with_two_is_named_by_its_first_body(tmp_path):
    """The arm stands at the origin and faces +x wherever it is in the file; the other's parts are gone."""
    both = mujoco.MjSpec.from_string(own_arm())
    other = mujoco.MjSpec.from_string(own_arm())
    both.attach(other, prefix="second/", frame=both.worldbody.add_frame(pos=[0.5, 0.2, 0.0], quat=[0.0, 0.0, 0.0, 1.0]))
    (tmp_path / "both.xml").write_text(both.to_xml())
    for name, root, joints in (("one", "base", "j1"), ("two", "second/base", "second/j1")):
        (tmp_path / f"{name}.yaml").write_text(f"mjcf: both.xml\nroot: {root}")
        robot = make_robot(str(tmp_path / f"{name}.yaml"))
        assert robot.arm_joints[0] == joints
        assert len(robot.arm_joints) == 7
        model = robot.new_spec().compile()
        np.testing.assert_allclose(model.body(root).pos[:2], 0.0, atol=1e-9)
        np.testing.assert_allclose(model.body(root).quat, [1.0, 0.0, 0.0, 0.0], atol=1e-9)
        assert model.nu == 8
        assert measure_gripper(robot.name).opening == pytest.approx(0.08, abs=2e-3)
    (tmp_path / "none.yaml").write_text("mjcf: both.xml\nroot: third")
    with pytest.raises(EnvironmentSetupError, match=r'no body "third" stands there\. There are: base, second/base'):
        make_robot(str(tmp_path / "none.yaml"))


@pytest.mark.slow
def test_an_evaluation_with_two_arms_is_replayed_bit_for_bit_and_demonstrated(own, tmp_path):
    from pat3d.policies_eval.datasets.demonstrations import demonstrate
    from pat3d.policies_eval.datasets.lerobot import _values_of
    from pat3d.policies_eval.policies.inputs import Inputs
    from pat3d.policies_eval.run.episodes import Episode
    from pat3d.policies_eval.run.rollout import Runner
    from pat3d.policies_eval.run.settings import RolloutSettings
    from pat3d.policies_eval.train import seen_in

    settings = RolloutSettings(robot=f"{own}+{own}")
    episode = Episode(index=0, scene="", task="pick:red mug", seed=5)
    runner = Runner(settings)
    result = runner.run(episode, ScriptedPolicy())
    assert result.success
    assert result.actions.shape[1] == 14
    assert runner.replay(episode, result.actions) == result.state_hash
    idle = runner.env.simulation.part(runner.env.placement.other.side)
    runner.close()
    (shown,) = demonstrate([episode], noise=0.1, settings=settings)
    # What pushes the hand of the arm that does the task leaves the other alone.
    assert not shown.done[:, idle].any()
    assert np.abs(shown.done - shown.actions).max() > 0.0
    values, _ = _values_of(shown)
    assert values["observation.state"].shape == (len(shown.actions), 2 * (7 + 2 + 3 + 4))
    with pytest.raises(EvaluationError, match="moves one arm; here are two"):
        seen_in(shown, Inputs())


def _of_the_menagerie(name: str) -> TabletopEnv:
    try:
        for arm in arms_of(name):
            make_robot(arm)
    except EnvironmentSetupError as error:
        if "cannot be had" in str(error) or "No module named" in str(error):
            pytest.skip(str(error))
        raise
    return TabletopEnv(robot=name, task="pick:red mug")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["aloha", "panda+panda", "panda+xarm7"])
def test_two_arms_of_the_menagerie_go_where_they_are_sent_and_pick_up_the_mug(name):
    env = _of_the_menagerie(name)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)
    for side in ("left", "right"):
        test_each_hand_gets_to_where_it_is_sent(env, side)
    test_one_arm_picks_while_the_other_holds_still(env)
