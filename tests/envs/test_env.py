"""The environment as Gymnasium's users see it."""

from __future__ import annotations

import copy
import pickle
import warnings

import numpy as np
import pytest

pytest.importorskip("robosuite")
gymnasium = pytest.importorskip("gymnasium")

import mujoco  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402

import pat3d  # noqa: E402, F401
from pat3d.envs.env import TabletopEnv  # noqa: E402
from pat3d.envs.grasping.scripted import ScriptedPick  # noqa: E402
from pat3d.envs.physics.loading import default_scene, load  # noqa: E402
from pat3d.envs.reward import BONUS  # noqa: E402
from pat3d.errors import EnvironmentSetupError, TaskError  # noqa: E402


def test_gymnasium_s_checker_finds_nothing_to_complain_about(env):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)


def test_picture_observations_and_rendering_pass_the_checker():
    made = TabletopEnv(
        obs="rgbd", segmentation=True, render_mode="rgb_array", image_size=(64, 96), render_size=(60, 80)
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # Rendering is checked by hand: the checker makes environments anew for every mode.
        check_env(made, skip_render_check=True)
    observation, _ = made.reset(seed=0)
    assert observation["agentview_image"].shape == (64, 96, 3)
    assert observation["wrist_depth"].dtype == np.float32
    assert set(np.unique(observation["agentview_segmentation"])) >= {0, 1, 2, 3, 4, 5, 6}
    assert made.render().shape == (60, 80, 3)
    made.close()


def test_the_physics_is_the_exported_scene_s_own(env):
    """Options, inertias, contact parameters and poses of the scene equal those of its MJCF alone, bit for bit."""
    alone = mujoco.MjModel.from_xml_path(str(load(None).mjcf))
    model = env.simulation.model
    for option in (
        "timestep",
        "integrator",
        "cone",
        "impratio",
        "ccd_tolerance",
        "solver",
        "iterations",
        "disableflags",
    ):
        assert getattr(model.opt, option) == getattr(alone.opt, option), option
    for body in range(1, alone.nbody):
        other = model.body(alone.body(body).name).id
        for field in ("body_mass", "body_inertia", "body_ipos", "body_iquat", "body_pos", "body_quat"):
            np.testing.assert_array_equal(getattr(model, field)[other], getattr(alone, field)[body])
    for geom in range(alone.ngeom):
        name = alone.geom(geom).name
        if not alone.geom_bodyid[geom]:
            continue
        other = model.geom(name).id
        for field in ("geom_friction", "geom_solref", "geom_solimp", "geom_margin", "geom_condim", "geom_size"):
            np.testing.assert_array_equal(getattr(model, field)[other], getattr(alone, field)[geom])


def test_objects_asleep_wake_when_they_are_touched_and_rest_exactly_until_then(env):
    """Until the robot arrives the banana does not move by a bit, and still touches the tray; the mug is then lifted."""
    env.reset(seed=0, options={"task": "pick:red mug"})
    state, zero = env.simulation.state, np.zeros(7, dtype=np.float32)
    assert state.touch("banana", "wooden tray")
    env.step(zero)
    before = state.position("banana").copy()
    assert env.simulation.data.ncon < 10, "nothing sleeps"
    for _ in range(5):
        env.step(zero)
    np.testing.assert_array_equal(state.position("banana"), before)
    assert state.touch("banana", "wooden tray")
    hand = ScriptedPick(env)
    for _ in range(60):
        env.step(hand.action())
    assert state.held("red mug")
    assert not state.touch("red mug", "wooden tray")


def test_sleeping_or_not_the_pick_ends_the_same_way():
    """Both runs lift the mug; the hand's path differs by less than a centimetre."""
    paths = []
    for sleep in (True, False):
        made = TabletopEnv(sleep=sleep)
        observation, _ = made.reset(seed=0)
        hand, path = ScriptedPick(made), []
        success = False
        while not success and len(path) < 120:
            observation, _, success, *_ = made.step(hand.action())
            path.append(observation["eef_pos"])
        assert success
        paths.append(np.array(path))
    count = min(map(len, paths))
    assert np.abs(paths[0][:count] - paths[1][:count]).max() < 0.01


def test_nothing_moves_while_the_robot_stands_still(env):
    """With the robot in the world the scene is as still as it was verified to be: a tenth of a millimetre in 5 s."""
    env = TabletopEnv(sleep=False)
    env.reset(seed=0)
    state = env.simulation.state
    before = {name: state.position(name).copy() for name in env.objects}
    for _ in range(100):
        env.step(np.zeros(7, dtype=np.float32))
    for name in env.objects:
        assert np.linalg.norm(state.position(name) - before[name]) < 1e-4
        assert state.tilt(name) < 0.1


def test_the_same_seed_gives_the_same_episode_bit_for_bit(env):
    actions = np.random.default_rng(5).uniform(-1, 1, (25, 7)).astype(np.float32)

    def episode(seed: int) -> list[bytes]:
        observation, _ = env.reset(seed=seed)
        seen = [observation]
        seen += [env.step(action)[0] for action in actions]
        return [value.tobytes() for one in seen for _, value in sorted(one.items())]

    first = episode(3)
    # Something else in between leaves no trace.
    env.reset(seed=9)
    env.step(np.ones(7, dtype=np.float32))
    assert episode(3) == first
    assert episode(4) != first


def test_another_instance_gives_the_same_episode(env):
    twin = TabletopEnv()
    action = np.full(7, 0.4, dtype=np.float32)
    for one in (env, twin):
        one.reset(seed=11, options={"task": "pick:red mug"})
    for _ in range(10):
        ours, theirs = env.step(action)[0], twin.step(action)[0]
    assert all(ours[name].tobytes() == theirs[name].tobytes() for name in ours)


@pytest.mark.parametrize(("seed", "attempt"), [(0, 0), (1, 1), (2, 0)])
def test_a_scripted_hand_picks_the_mug_for_real(env, seed, attempt):
    """The fingers close on the rim, friction alone lifts the mug by 10 cm, and a second later the episode succeeds."""
    env.reset(seed=seed, options={"task": "pick:red mug"})
    hand = ScriptedPick(env, attempt=attempt)
    for step in range(120):  # noqa: B007
        _, reward, success, truncated, info = env.step(hand.action())
        if success or truncated:
            break
    assert success
    assert reward == 1.0
    assert info["predicates"] == {"grasped": True, "lifted": True, "held": True}
    assert info["touched"] == ["red mug"]
    assert info["toppled"] == []
    assert step > 20, "success before a second of holding"


@pytest.mark.parametrize("control", ["joint_velocity", "joint_position"])
def test_joint_control_moves_the_joint_it_names(control):
    made = TabletopEnv(control=control)
    before, _ = made.reset(seed=0)
    action = np.zeros(8, dtype=np.float32)
    action[0] = 0.5
    for _ in range(10):
        after, *_ = made.step(action)
    moved = after["joint_pos"] - before["joint_pos"]
    assert moved[0] > 0.03
    assert np.abs(moved[1:]).max() < 0.02


@pytest.mark.parametrize("robot", ["UR5e", "Sawyer"])
def test_other_robots_stand_in_front_of_the_same_scene(robot):
    made = TabletopEnv(robot=robot, task="pick:banana")
    made.reset(seed=0)
    for _ in range(10):
        observation, *_ = made.step(np.zeros(7, dtype=np.float32))
    assert made.observation_space.contains(observation)
    assert "banana" in made.placement.describe()


def test_operational_space_actions_move_the_hand_in_the_frame_of_the_base(env):
    """The robot faces -y here, so its forward (+x of its base) is -y of the world."""
    start, _ = env.reset(seed=0, options={"task": "pick:red mug"})
    for _ in range(10):
        after, *_ = env.step(np.array([0.5, 0, 0, 0, 0, 0, -1], dtype=np.float32))
    moved = after["eef_pos"] - start["eef_pos"]
    assert moved[1] < -0.03
    assert np.abs(moved[[0, 2]]).max() < 0.01


def test_a_reset_compiles_and_plans_nothing_again(env, monkeypatch):
    """The world of a scene and a task is kept; a reset costs a few forward passes, whatever the machine."""
    env.reset(seed=0)
    simulation, forward, passes = env.simulation, mujoco.mj_forward, []

    def refuse(*arguments: object) -> None:
        raise AssertionError

    for module, name in (("env", "compose"), ("env", "placed"), ("env", "load")):
        monkeypatch.setattr(f"pat3d.envs.{module}.{name}", refuse)
    monkeypatch.setattr(mujoco, "mj_forward", lambda *given: passes.append(1) or forward(*given))
    env.reset()
    assert env.simulation is simulation
    assert len(passes) <= 3


def test_the_progress_grows_along_a_pick_and_the_dense_reward_is_its_differences():
    made = TabletopEnv(reward="dense", discount=0.97)
    _, info = made.reset(seed=0)
    hand = ScriptedPick(made)
    progress, rewards = [info["progress"]], []
    for _ in range(100):
        _, reward, success, _, info = made.step(hand.action())
        progress.append(info["progress"])
        rewards.append(reward)
        if success:
            break
    assert progress[-1] == 1.0
    assert 0.0 <= progress[0] < 0.2
    assert all(0.0 <= one <= 1.0 for one in progress)
    # From closing the fingers on it never falls back by more than the hand's wobble.
    assert np.diff(progress[37:]).min() > -0.05
    differences = 0.97 * np.array(progress[1:]) - progress[:-1]
    np.testing.assert_allclose(rewards[:-1], differences[:-1], atol=1e-12)
    assert rewards[-1] == pytest.approx(differences[-1] + BONUS)


@pytest.mark.parametrize("again", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_an_environment_can_be_copied_and_pickled(again):
    """The copy is about the same and draws the same numbers; it begins with a reset."""
    made = TabletopEnv(task="place:green apple:blue bowl", reward="dense", start_noise=0.1)
    made.reset(seed=3)
    made.reset(options={"task": "pick:banana"})
    other = again(made)
    with pytest.raises(gymnasium.error.ResetNeeded):
        other.step(np.zeros(7))
    first, info = made.reset()
    second, same = other.reset()
    assert same["task"] == info["task"] == "pick:banana"
    assert other.config.reward == "dense"
    for name in first:
        np.testing.assert_array_equal(first[name], second[name])
    one, two = made.step(np.full(7, 0.3)), other.step(np.full(7, 0.3))
    assert one[1] == two[1]
    np.testing.assert_array_equal(one[0]["joint_pos"], two[0]["joint_pos"])
    made.close()
    assert other.simulation.data is not made.simulation.data
    whole = again(gymnasium.make("PAT3D-v0", start_noise=0.0))
    assert whole.reset(seed=0)[1]["task"] == "pick:red mug"


def test_a_scene_that_mujoco_cannot_compile_is_an_error_of_ours(monkeypatch):
    class Spec:
        @staticmethod
        def from_file(path):
            raise mujoco.FatalError("out of memory")

    monkeypatch.setattr(mujoco, "MjSpec", Spec)
    with pytest.raises(EnvironmentSetupError, match="refuses the scene: out of memory"):
        TabletopEnv()


def test_tasks_that_move_more_take_longer(breakfast):
    assert TabletopEnv(task="pick:red mug").horizon == 400
    assert TabletopEnv(task="pick:red mug", control_freq=10.0).horizon == 200
    env = TabletopEnv(task="unload:wooden tray")
    assert env.horizon == 400 + 300 * (len(env.task.needs(breakfast).grasp) - 1)


def test_the_time_limit_truncates():
    made = gymnasium.make("PAT3D-v0", max_episode_steps=3)
    made.reset(seed=0)
    ends = [made.step(np.zeros(7, dtype=np.float32))[2:4] for _ in range(3)]
    assert ends == [(False, False), (False, False), (False, True)]
    made.close()


def test_vector_environments_run_in_processes_of_their_own():
    vector = gymnasium.make_vec("PAT3D-v0", num_envs=2, vectorization_mode="async")
    observation, info = vector.reset(seed=[1, 2])
    assert observation["objects"].shape == (2, 5, 7)
    assert not np.array_equal(observation["joint_pos"][0], observation["joint_pos"][1])
    observation, *_, info = vector.step(np.zeros((2, 7), dtype=np.float32))
    assert list(info["instruction"]) == ["pick up the red mug from the wooden tray"] * 2
    vector.close()


@pytest.mark.parametrize("mode", ["NEXT_STEP", "SAME_STEP"])
@pytest.mark.parametrize("vectorization", ["sync", "async"])
def test_vector_environments_begin_anew_when_their_mode_says(vectorization, mode):
    """Episodes of two steps: what follows the second is a reset, at once or at the next step, as the metadata tell."""
    wanted = gymnasium.vector.AutoresetMode[mode]
    vector = gymnasium.make_vec(
        "PAT3D-v0",
        num_envs=2,
        vectorization_mode=vectorization,
        max_episode_steps=2,
        vector_kwargs={"autoreset_mode": wanted},
    )
    assert vector.metadata["autoreset_mode"] == wanted
    start, _ = vector.reset(seed=[1, 2])
    away = np.full((2, 7), 0.8, dtype=np.float32)
    _, _, _, first, _ = vector.step(away)
    second, _, _, ended, info = vector.step(away)
    assert (first.tolist(), ended.tolist()) == ([False, False], [True, True])
    moved = np.linalg.norm(second["eef_pos"] - start["eef_pos"], axis=1)
    third, reward, _, again, _ = vector.step(away)
    if mode == "SAME_STEP":
        assert "final_obs" in info
        assert not again.any()
    else:
        assert (moved > 0.01).all()
        assert not reward.any()
        assert not again.any()
        assert not np.array_equal(third["joint_pos"], start["joint_pos"]), "another posture at the start"
    vector.close()


def test_another_scene_can_be_entered_at_reset(env, tmp_path, breakfast):
    """The shipped scene without its bowl: one object fewer, the rows beyond it are zero."""
    from dataclasses import replace

    from pat3d.scene.io import save_scene

    fewer = replace(
        breakfast,
        objects=tuple(obj for obj in breakfast.objects if obj.name != "blue bowl"),
        relations=tuple(rel for rel in breakfast.relations if rel.child != "blue bowl"),
    )
    save_scene(fewer, tmp_path / "fewer")
    observation, info = env.reset(seed=0, options={"scene": tmp_path / "fewer", "task": "pick:banana"})
    assert info["instruction"] == "pick up the banana from the wooden tray"
    assert len(env.objects) == 4
    assert env.observation_space.contains(observation)
    assert not observation["objects"][4].any()
    observation, info = env.reset(seed=0, options={"scene": default_scene(), "task": "pick:red mug"})
    assert observation["objects"][4].any()


def test_a_scene_with_more_objects_than_the_space_is_refused_and_nothing_changes(env):
    made = TabletopEnv(max_objects=5)
    made.reset(seed=0)
    with pytest.raises(EnvironmentSetupError, match="max_objects=5"):
        TabletopEnv(max_objects=3)
    with pytest.raises(TaskError, match="no task"):
        made.reset(options={"task": "juggle:red mug"})
    assert made.task.spec == "pick:red mug"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"robot": "Optimus"}, r"Robots: panda, fr3, .*Panda, UR5e, Sawyer"),
        ({"task": "pick:teapot"}, "Objects that can move: red mug, green apple"),
        ({"task": "juggle"}, "Tasks: pick:OBJECT"),
        ({"task": "place:banana"}, "does not fit"),
        ({"obs": "smell"}, "Valid: state, rgb, rgbd"),
        ({"control": "telepathy"}, "Controls: osc"),
        ({"reward": "praise"}, "Valid: sparse, dense"),
        ({"obs": "rgb", "cameras": ("ceiling",)}, "Cameras: agentview, frontview, closeview, wrist"),
        ({"control_freq": 33.0}, "whole number of time steps"),
        ({"start_noise": float("nan")}, "0 to 0.5"),
        ({"start_noise": "little"}, "0 to 0.5 rad, not 'little'"),
        ({"control_freq": "fast"}, "0.1 to 1000 actions a second"),
        ({"task": 7}, "a task is text"),
        ({"obs": "rgb", "cameras": ()}, "at least one camera"),
        ({"obs": "rgb", "image_size": 64}, "height and width, 8 to 2048 pixels each, not 64"),
        ({"render_size": (0, 640)}, "render_size is height and width"),
        ({"max_objects": 0}, "whole number from 1"),
    ],
)
def test_a_wrong_argument_is_answered_with_what_is_valid(arguments, message):
    with pytest.raises((EnvironmentSetupError, TaskError), match=message):
        TabletopEnv(**arguments)


def test_an_action_that_is_no_number_is_refused(env):
    env.reset(seed=0)
    with pytest.raises(EnvironmentSetupError, match="7 finite numbers"):
        env.step(np.full(7, np.nan, dtype=np.float32))
