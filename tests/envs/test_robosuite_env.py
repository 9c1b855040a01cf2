"""The second door: the same world, entered through robosuite."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("gymnasium")
robosuite = pytest.importorskip("robosuite")

import mujoco  # noqa: E402

import pat3d.envs.robosuite_env  # noqa: E402, F401
from pat3d.envs.physics.loading import load  # noqa: E402


@pytest.fixture(scope="module")
def native():
    made = robosuite.make(
        "PAT3DScene",
        robots="Panda",
        task="place:green apple:blue bowl",
        has_renderer=False,
        has_offscreen_renderer=False,
        use_camera_obs=False,
        hard_reset=False,
        control_freq=20,
    )
    yield made
    made.close()


def test_robosuite_steps_the_scene_s_own_physics(native):
    alone = mujoco.MjModel.from_xml_path(str(load(None).mjcf))
    model = native.sim.model._model
    for option in ("timestep", "integrator", "cone", "impratio", "ccd_tolerance", "disableflags"):
        assert getattr(model.opt, option) == getattr(alone.opt, option), option
    for body in range(1, alone.nbody):
        other = model.body(alone.body(body).name).id
        np.testing.assert_array_equal(model.body_inertia[other], alone.body_inertia[body])
        np.testing.assert_array_equal(model.body_pos[other], alone.body_pos[body])


def test_objects_are_observed_and_do_not_move(native):
    before = native.reset()
    for _ in range(20):
        after, reward, done, _ = native.step(np.zeros(native.action_dim))
    assert np.linalg.norm(after["red_mug_pos"] - before["red_mug_pos"]) < 1e-4
    assert (reward, done) == (0.0, False)


def test_success_is_the_task_s(native):
    native.reset()
    world, data = native.state.world, native.sim.data._data
    number = world.objects.index("green apple")
    place = native.state.position("blue bowl") + [0.0, 0.0, 0.03]
    data.qpos[world.positions[number] : world.positions[number] + 3] = place
    native.sim.forward()
    rewards = [native.step(np.zeros(native.action_dim))[1] for _ in range(60)]
    assert rewards[0] == 0.0
    assert rewards[-1] == 1.0


@pytest.mark.parametrize("objects", [True, False])
def test_robosuite_s_gym_wrapper_runs_it(objects):
    from robosuite.wrappers import GymWrapper

    made = robosuite.make(
        "PAT3DScene",
        robots="Panda",
        task="place:green apple:blue bowl",
        has_renderer=False,
        has_offscreen_renderer=False,
        use_camera_obs=False,
        use_object_obs=objects,
        hard_reset=False,
        reward_shaping=True,
        reward_scale=2.0,
        horizon=3,
    )
    wrapped = GymWrapper(made)
    assert wrapped.reward_range == (0, 2.0)
    first, _ = wrapped.reset(seed=0)
    assert ("object-state" in made.reset()) == objects
    assert wrapped.observation_space.shape == first.shape
    before = made._verdict.progress
    observation, reward, ended, _, info = wrapped.step(np.zeros(made.action_dim))
    assert observation.shape == first.shape
    assert not info["success"]
    assert reward == pytest.approx(2.0 * (0.99 * info["progress"] - before), abs=1e-9)
    # Asked once more, the reward is the same and no time has passed.
    assert wrapped.compute_reward(None, None, {}) == reward
    wrapped.step(np.zeros(made.action_dim))
    assert wrapped.step(np.zeros(made.action_dim))[2]
    assert not ended
    # What every task of robosuite has.
    for name in ("reward_scale", "reward_shaping", "use_object_obs", "use_camera_obs", "placement_initializer"):
        assert hasattr(wrapped, name)
    made.close()
