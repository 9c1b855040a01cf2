"""Torques of the compiled controller against robosuite's own code, in random states and in a singular one."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

pytest.importorskip("robosuite")
pytest.importorskip("gymnasium")

from pat3d.envs.env import TabletopEnv


def _torques(env, joints, velocities) -> tuple[np.ndarray, np.ndarray, bool]:
    """Ours and robosuite's for the arm in a posture, and whether ours were compiled ones."""
    simulation, controller = env.simulation, env.simulation.controller
    simulation.data.qpos[simulation._arm] = joints
    simulation.data.qvel[:] = velocities
    mujoco.mj_forward(simulation.model, simulation.data)
    compiled = controller._operational.apply(*controller._goal, *controller._gains)
    controller._arm.new_update = True
    controller.control()
    ours = simulation.data.ctrl[controller._arm_actuators].copy()
    controller._arm.new_update = True
    return ours, np.clip(controller._arm.run_controller(), *controller._limits), compiled


@pytest.mark.parametrize("robot", ["Panda", "UR5e", "Sawyer", "IIWA"])
def test_torques_equal_robosuite_s_in_random_states(robot):
    """1e-9 of the largest torque; inverses of a mobility near a singular posture cost a few digits."""
    env = TabletopEnv(robot=robot, task="pick:banana")
    env.reset(seed=0)
    random = np.random.default_rng(0)
    start = np.array(env.placement.start)
    for number in range(40):
        if number % 8 == 0:
            env.simulation.controller.set_action(random.uniform(-1, 1, 7))
        joints = start + random.normal(0.0, 0.5, len(start))
        ours, theirs, compiled = _torques(env, joints, random.normal(0.0, 0.5, env.simulation.model.nv))
        assert compiled
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * max(1.0, np.abs(theirs).max()))


def test_a_singular_posture_is_left_to_robosuite(env):
    """A Panda whose joints are all at zero stretches straight up: its hand cannot move in one direction."""
    env.reset(seed=0, options={"task": "pick:red mug"})
    env.simulation.controller.set_action(np.zeros(7))
    ours, theirs, compiled = _torques(env, np.zeros(7), np.zeros(env.simulation.model.nv))
    assert not compiled
    assert np.isfinite(ours).all()
    np.testing.assert_array_equal(ours, theirs)
