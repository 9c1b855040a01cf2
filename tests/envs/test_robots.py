"""Robots of a file of one's own, and of MuJoCo Menagerie where its models can be had."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

pytest.importorskip("gymnasium")

import mujoco
from gymnasium.utils.env_checker import check_env

from pat3d.envs.env import TabletopEnv
from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.robots.arms import arm_kinematics, make_robot, measure_gripper
from pat3d.envs.robots.inertia import inertia_matrix
from pat3d.envs.robots.kinematics import PlacedArm
from pat3d.envs.robots.menagerie import ARMS, arms_here
from pat3d.envs.robots.robot import SteadyDrive
from pat3d.errors import EnvironmentSetupError
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from tests.envs.own_arm import jaw_arm, own_arm

CLOSE = 0.005
"""The hand gets this near to where it is sent [m]."""


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """The file of an arm with a gripper."""
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.fixture(scope="module")
def jaw(tmp_path_factory):
    """The file of an arm of five joints whose gripper is one jaw that turns."""
    path = tmp_path_factory.mktemp("robots") / "jaw.xml"
    path.write_text(jaw_arm())
    path.with_suffix(".yaml").write_text("hand: palm")
    return str(path)


@pytest.fixture(scope="module")
def made(own):
    """An environment with that arm."""
    env = TabletopEnv(robot=own, task="pick:red mug")
    yield env
    env.close()


def test_the_parts_of_an_arm_are_found_by_its_structure(own):
    robot = make_robot(own)
    assert robot.arm_joints == tuple(f"j{n}" for n in range(1, 8))
    assert robot.gripper_joints == ("left", "right")
    assert robot.gripper_actuators == ("grip",)
    assert {frozenset(side) for side in robot.fingers} == {frozenset(["left_pad"]), frozenset(["right_pad"])}
    model = robot.new_spec().compile()
    limits = [model.actuator(name).ctrlrange for name in robot.arm_actuators]
    np.testing.assert_array_equal(limits, 7 * [[-80.0, 80.0]])


def test_the_gripper_is_measured_as_it_was_drawn(own):
    """Pads 12 mm thick, 20 mm wide, 60 mm high, each going 40 mm from where they touch; the palm is 60 mm behind."""
    gripper = measure_gripper(own)
    assert gripper.opening == pytest.approx(0.08, abs=2e-3)
    assert gripper.closed == pytest.approx(0.0, abs=2e-3)
    assert gripper.finger_thickness == pytest.approx(0.012, abs=1e-4)
    assert gripper.finger_width == pytest.approx(0.02, abs=1e-4)
    assert gripper.palm == pytest.approx(0.06, abs=1e-3)
    assert gripper.pad == pytest.approx(0.06, abs=4e-3)
    assert gripper.hand == pytest.approx((0.16, 0.08), abs=1e-3)


def test_the_grip_site_is_between_the_pads_and_its_axes_are_those_of_the_hand(own):
    robot = make_robot(own)
    model = robot.new_spec().compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    site = data.site(robot.grip_site)
    np.testing.assert_allclose(site.xpos[:2], 0.0, atol=1e-3)
    np.testing.assert_allclose(site.xmat.reshape(3, 3)[:, 2], [0.0, 0.0, 1.0], atol=1e-6)
    np.testing.assert_allclose(np.abs(site.xmat.reshape(3, 3)[:, 1]), [0.0, 1.0, 0.0], atol=1e-6)


def test_the_arm_starts_in_front_of_its_base_with_the_hand_down(own):
    robot = make_robot(own)
    model = robot.new_spec().compile()
    data = mujoco.MjData(model)
    data.qpos[[int(model.joint(name).qposadr[0]) for name in robot.arm_joints]] = robot.home
    mujoco.mj_forward(model, data)
    site = data.site(robot.grip_site)
    assert site.xpos[0] > 0.2
    assert abs(site.xpos[1]) < 5e-3
    np.testing.assert_allclose(site.xmat.reshape(3, 3)[:, 2], [0.0, 0.0, -1.0], atol=0.03)
    assert not (data.contact.dist < -1e-3).any()


def test_gymnasium_s_checker_accepts_an_environment_with_one_s_own_arm(made):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(made, skip_render_check=True)


def _reaches(env, goal, rotation) -> bool:
    place = env.placement
    arm = PlacedArm(arm_kinematics(env.robot), place.base_position, place.yaw)
    return arm.solve(goal, rotation, env.simulation.arm.copy()) is not None


def _farthest(env) -> float:
    """How far the hand stays from poses around its start that it is sent to, at most [m]."""
    worst = 0.0
    for number, shift in enumerate(
        np.array([[0.08, 0.0, 0.0], [0.0, 0.1, 0.05], [-0.05, -0.08, 0.1], [0.0, 0.0, -0.05]])
    ):
        env.reset(seed=number)
        state, servo = env.simulation.state, Servo(env)
        rotation = state.hand_rotation.copy()
        while not _reaches(env, goal := state.hand + shift, rotation):
            shift /= 2.0
        for _ in range(60):
            env.step(servo.towards(goal, rotation, -1.0)[0])
        worst = max(worst, float(np.linalg.norm(env.simulation.state.hand - goal)))
    return worst


def _picks(env, episodes: int) -> int:
    """How many episodes of the scripted policy succeed within the time limit."""
    policy, done = ScriptedPolicy(), 0
    for seed in range(episodes):
        observation, _ = env.reset(seed=seed)
        start = EpisodeStart(
            instruction=env.instruction, task=env.task.spec, seed=seed, robot=env.robot, control=env.control,
            action_size=env.action_space.shape[0], control_freq=env.control_freq, env=env,
        )  # fmt: skip
        policy.reset(start)
        success, steps = False, 0
        while not success and steps < 400:
            observation, _, success, *_ = env.step(policy.act(observation))
            steps += 1
        done += success
    return done


def test_the_hand_gets_to_where_it_is_sent(made):
    assert _farthest(made) < CLOSE


def test_one_s_own_arm_picks_up_the_mug(made):
    assert _picks(made, 3) == 3


def test_one_turning_jaw_is_a_gripper(jaw):
    robot, gripper = make_robot(jaw), measure_gripper(jaw)
    assert robot.arm_joints == ("turn", "lift", "bend", "flex", "roll")
    assert {frozenset(side) for side in robot.fingers} == {frozenset(["fixed"]), frozenset(["moving"])}
    # The jaw turns about a line 20 mm beside and 60 mm behind its tip, by 0.7 rad; thickness and pads are taken off.
    assert robot.gripper_home == pytest.approx([-0.7], abs=1e-3)
    assert 0.03 < gripper.opening < 0.05
    assert gripper.closed < 0.002
    assert gripper.deepest == gripper.throat < gripper.palm


def test_an_arm_of_five_joints_goes_where_it_is_sent_and_picks_up_the_mug(jaw):
    env = TabletopEnv(robot=jaw, task="pick:red mug")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)
    assert _farthest(env) < CLOSE
    assert _picks(env, 3) == 3


@pytest.mark.parametrize("control", ["joint_velocity", "joint_position"])
def test_joint_control_moves_the_joint_it_names_and_holds_the_others(own, control):
    env = TabletopEnv(robot=own, task="pick:red mug", control=control)
    before, _ = env.reset(seed=0)
    action = np.zeros(8, dtype=np.float32)
    action[0] = 0.5
    for _ in range(10):
        after, *_ = env.step(action)
    moved = after["joint_pos"] - before["joint_pos"]
    assert moved[0] > 0.03
    assert np.abs(moved[1:]).max() < 0.02


def _accelerations(env, joints) -> tuple[np.ndarray, np.ndarray]:
    """Of the hand at rest in a posture: what its controller wants, and what MuJoCo finds but for contacts."""
    simulation, controller = env.simulation, env.simulation.controller
    model, data = simulation.model, simulation.data
    data.qpos[simulation._arm], data.qvel[:] = joints, 0.0
    mujoco.mj_forward(model, data)
    controller.set_action(np.array([0.3, -0.4, 0.2, 0.2, 0.1, -0.3, -1.0]))
    limits = controller._limits.copy()
    controller._limits[:] = [[-1e6] * len(joints), [1e6] * len(joints)]
    controller.control()
    controller._limits[:] = limits
    wanted = controller._kp[0] * np.concatenate(
        [
            controller._goal - data.site_xpos[controller._site],
            0.5 * np.cross(data.site_xmat[controller._site].reshape(3, 3).T, controller._goal_rotation.T).sum(axis=0),
        ]
    )
    mujoco.mj_forward(model, data)
    jacobian = np.zeros((6, model.nv))
    mujoco.mj_jacSite(model, data, jacobian[:3], jacobian[3:], controller._site)
    return wanted, jacobian @ data.qacc_smooth


def test_the_hand_accelerates_as_the_controller_wants(made):
    """2 %: what the regular inverse takes away, and the fingers, which move by themselves."""
    made.reset(seed=0)
    random = np.random.default_rng(0)
    for _ in range(10):
        wanted, found = _accelerations(made, made.placement.start + random.normal(0.0, 0.2, 7))
        np.testing.assert_allclose(found[:3], wanted[:3], atol=0.02 * np.linalg.norm(wanted[:3]))
        np.testing.assert_allclose(found[3:], wanted[3:], atol=0.02 * np.linalg.norm(wanted[3:]))


def test_a_stretched_arm_still_moves_its_hand_where_it_can(made):
    """Straight up, all bending axes are x of the world: the hand goes along y, and neither along x nor up."""
    made.reset(seed=0)
    wanted, found = _accelerations(made, np.zeros(7))
    np.testing.assert_allclose(found[1], wanted[1], rtol=0.02)
    np.testing.assert_allclose(found[[0, 2]], 0.0, atol=1e-6)
    assert np.abs(found).max() < 100.0


def test_dry_friction_is_taken_from_the_torques_of_the_motors(tmp_path):
    (tmp_path / "arm.xml").write_text(own_arm().replace('damping="1"', 'damping="1" frictionloss="2"'))
    robot = make_robot(str(tmp_path / "arm.xml"))
    model = robot.new_spec().compile()
    dofs = [int(model.joint(name).dofadr[0]) for name in robot.arm_joints]
    assert not model.dof_frictionloss[dofs].any()
    assert not model.dof_damping[dofs].any()
    assert [float(model.actuator(name).ctrlrange[1]) for name in robot.arm_actuators] == 7 * [78.0]
    (tmp_path / "weak.xml").write_text(own_arm().replace('damping="1"', 'frictionloss="90"'))
    with pytest.raises(EnvironmentSetupError, match=r'joint "j1": its dry friction is more than'):
        make_robot(str(tmp_path / "weak.xml"))


def test_the_inertia_matrix_is_that_of_the_kinetic_energy(own):
    """V M v is twice the kinetic energy that MuJoCo's energy sensor reports."""
    model = make_robot(own).new_spec().compile()
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    data, matrix = mujoco.MjData(model), np.zeros((model.nv, model.nv))
    random = np.random.default_rng(0)
    for _ in range(5):
        data.qpos[:], data.qvel[:] = random.uniform(0.0, 0.04, model.nq), random.normal(size=model.nv)
        mujoco.mj_forward(model, data)
        inertia_matrix(model, data, matrix)
        np.testing.assert_array_equal(matrix, matrix.T)
        assert data.qvel @ matrix @ data.qvel == pytest.approx(2.0 * data.energy[1], rel=1e-9)


def test_fingers_go_a_tenth_of_their_range_a_step_and_stay_where_they_are_told_nothing():
    drive = SteadyDrive((1.0, -1.0))
    np.testing.assert_array_equal(drive.current_action, [-1.0, 1.0])
    np.testing.assert_allclose(drive.format_action(np.ones(1)), [-0.8, 0.8])
    np.testing.assert_allclose(drive.format_action(np.zeros(1)), [-0.8, 0.8])
    for _ in range(20):
        closed = drive.format_action(np.ones(1))
    np.testing.assert_array_equal(closed, [1.0, -1.0])


@pytest.mark.parametrize(
    ("file", "told", "message"),
    [
        (own_arm(fingers=False), "", "no arm|no fingers: bodies that move on the hand found"),
        (
            own_arm(gripper=""),
            "",
            r"no actuator .* drives the fingers found\. .* gripper_actuators in arm.yaml",
        ),
        (
            own_arm(torque=""),
            "",
            r"no largest torque .* found\. .* torques in arm.yaml\. There are: j1, j2",
        ),
        (own_arm(), "arm_joints: [j1, elbow]", r'no joint "elbow"\. There are: j1, j2'),
        (own_arm(), "colour: red", r"colour is not understood\. Keys: mjcf, gripper, attach"),
        (own_arm(), "gripper: claw", r'no gripper "claw"\. Grippers: panda_hand, 2f85'),
        ("<mujoco><worldbody><cube/></worldbody></mujoco>", "", "refuses it"),
    ],
)
def test_what_a_file_lacks_is_said_with_what_it_has(tmp_path, file, told, message):
    (tmp_path / "arm.xml").write_text(file)
    if told:
        (tmp_path / "arm.yaml").write_text(told)
    with pytest.raises(EnvironmentSetupError, match=message):
        make_robot(str(tmp_path / "arm.xml"))


def test_what_is_missing_can_be_named(tmp_path):
    (tmp_path / "arm.xml").write_text(own_arm(torque=""))
    (tmp_path / "arm.yaml").write_text("torques: [80, 80, 80, 80, 80, 80, 80]\npayload: 1.5")
    robot = make_robot(str(tmp_path / "arm.xml"))
    assert robot.payload == 1.5
    model = robot.new_spec().compile()
    assert [float(model.actuator(name).ctrlrange[1]) for name in robot.arm_actuators] == 7 * [80.0]


def test_fingers_that_tremble_get_an_armature_and_critical_damping(tmp_path):
    """A spring of 0.25 * 2000 N/m and a mass of 0.2 kg: critical is 2 sqrt(k m) = 20 N s/m."""
    (tmp_path / "arm.xml").write_text(own_arm())
    (tmp_path / "arm.yaml").write_text("grip_stiffness: 0.25\ngrip_armature: 0.2")
    name = str(tmp_path / "arm.xml")
    model = make_robot(name).new_spec().compile()
    assert [float(model.dof_armature[int(model.joint(one).dofadr[0])]) for one in ("left", "right")] == [0.2, 0.2]
    np.testing.assert_allclose(model.actuator("grip").gainprm[0], 500.0)
    np.testing.assert_allclose(model.actuator("grip").biasprm[:3], [0.0, -500.0, -20.0])
    assert measure_gripper(name).opening == pytest.approx(0.08, abs=2e-3)


def test_no_such_robot_or_file_is_answered_with_what_there_is(tmp_path):
    with pytest.raises(EnvironmentSetupError, match=r"Robots: panda, fr3, .*PATH\.xml for your own"):
        make_robot("Marvin")
    with pytest.raises(EnvironmentSetupError, match=r"nothing.xml is no file"):
        make_robot(str(tmp_path / "nothing.xml"))


def _of_the_menagerie(name: str) -> TabletopEnv:
    """The environment of an arm; without its model, which is downloaded, there is nothing to test."""
    try:
        make_robot(name)
    except EnvironmentSetupError as error:
        if "cannot be had" in str(error) or "No module named" in str(error):
            pytest.skip(str(error))
        raise
    return TabletopEnv(robot=name, task="pick:red mug")


def test_arms_that_are_here_have_their_model_and_their_gripper_s(tmp_path, monkeypatch):
    pytest.importorskip("mujoco_menagerie")
    monkeypatch.setenv("MENAGERIE_ROOT", str(tmp_path))
    assert arms_here() == ()
    (tmp_path / "universal_robots_ur5e").mkdir()
    assert arms_here() == ()
    (tmp_path / "robotiq_2f85").mkdir()
    assert arms_here() == ("ur5e",)
    (tmp_path / "franka_emika_panda").mkdir()
    assert arms_here() == ("panda", "ur5e")


@pytest.mark.slow
@pytest.mark.parametrize("name", ARMS)
def test_gymnasium_s_checker_accepts_every_arm_of_the_menagerie(name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(_of_the_menagerie(name), skip_render_check=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", ARMS)
def test_an_arm_of_the_menagerie_goes_where_it_is_sent(name):
    assert _farthest(_of_the_menagerie(name)) < CLOSE


@pytest.mark.slow
@pytest.mark.parametrize("name", ARMS)
def test_an_arm_of_the_menagerie_picks_up_the_mug(name):
    assert _picks(_of_the_menagerie(name), 3) == 3
