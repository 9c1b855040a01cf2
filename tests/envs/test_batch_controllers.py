"""The kernels of a batch, run on the CPU, against the compiled controllers."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("gymnasium")

import mujoco

from pat3d.envs.batch.controllers import BatchedController
from pat3d.envs.batch.merged import alone
from pat3d.envs.env import TabletopEnv
from tests.envs.mirror import WORLDS, mirrored
from tests.envs.own_arm import jaw_arm, own_arm

SINGLE = 2e-5
"""Of the largest torque: rounding of single-precision states, 6e-8, times the conditioning of the inertia."""


@pytest.fixture(scope="module")
def stiff(tmp_path_factory):
    """An arm whose joints have springs, damping, dry friction and armature."""
    path = tmp_path_factory.mktemp("robots") / "stiff.xml"
    path.write_text(own_arm().replace('damping="1"', 'damping="1" frictionloss="0.5" stiffness="3" springref="0.4"'))
    return str(path)


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """An arm of five joints, with springs."""
    path = tmp_path_factory.mktemp("robots") / "short.xml"
    path.write_text(jaw_arm().replace('damping="0.5"', 'damping="0.5" stiffness="1"'))
    path.with_suffix(".yaml").write_text("hand: palm")
    return str(path)


@pytest.mark.parametrize(("arm", "kind"), [("stiff", "osc"), ("stiff", "joint_position"), ("short", "osc")])
def test_a_batch_s_torques_are_those_of_one_world(request, arm, kind):
    stiff = request.getfixturevalue(arm)
    env = TabletopEnv(robot=stiff, control=kind, sleep=False, task="pick:red mug")
    env.reset(seed=0)
    simulation = env.simulation
    model, data, one = simulation.model, simulation.data, simulation.controller
    batch = BatchedController(alone(simulation.world), mirrored(data), kind)
    batch.reset(np.arange(WORLDS), np.tile(simulation.arm, (WORLDS, 1)))
    random = np.random.default_rng(1)
    for action in random.uniform(-1, 1, (3, one.size)):
        one.set_action(action)
        batch._data = mirrored(data, batch._data.ctrl)
        batch.set_action(np.tile(action, (WORLDS, 1)))
        for _ in range(10):
            batch._data = mirrored(data, batch._data.ctrl)
            batch._mass = batch._data.M.reshape((WORLDS, -1))
            batch.control()
            one.control()
            assert np.abs(data.qfrc_passive[simulation.world.velocities.max() :]).max() > 0.1
            np.testing.assert_allclose(
                batch._data.ctrl.numpy(), np.tile(data.ctrl, (WORLDS, 1)), atol=SINGLE * np.abs(data.ctrl).max()
            )
            mujoco.mj_step2(model, data)
            mujoco.mj_step1(model, data)


@pytest.mark.parametrize("kind", ["osc", "joint_position", "joint_velocity"])
def test_an_arm_that_is_told_nothing_stays_where_it_is(stiff, kind):
    """Gravity, springs and dry friction leave no trace: a hand that sags by more than 0.1 mm would fall over hours."""
    env = TabletopEnv(robot=stiff, control=kind, task="pick:red mug")
    env.reset(seed=0)
    before = env.simulation.arm.copy()
    for _ in range(40):
        env.step(np.zeros(env.simulation.controller.size))
    np.testing.assert_allclose(env.simulation.arm, before, atol=1e-4)
