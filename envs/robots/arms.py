"""Robots by name: MuJoCo Menagerie's, those of a file of one's own, and robosuite's where it is installed."""

from __future__ import annotations

import functools
import os
from importlib.util import find_spec
from typing import Any

from pat3d.envs.robots.kinematics import ArmKinematics
from pat3d.envs.robots.menagerie import ARMS, HALVES, described_file, menagerie_robot
from pat3d.envs.robots.pairs import PAIRS, arms_of, pair_of
from pat3d.envs.robots.robosuite_arms import ROBOTS as ROBOSUITE
from pat3d.envs.robots.robosuite_arms import measure_robosuite_gripper, robosuite_robot
from pat3d.envs.robots.robot import Gripper, Robot
from pat3d.errors import EnvironmentSetupError

ROBOT_VARIABLE = "PAT3D_ROBOT"
"""Environment variable that names the robot of environments that name none."""

KEPT = 16
"""Robots that a process remembers."""


def default_robot() -> str:
    """What PAT3D_ROBOT says, else robosuite's Panda where it is installed, else Menagerie's, downloaded once."""
    return os.environ.get(ROBOT_VARIABLE) or ("Panda" if find_spec("robosuite") else "panda")


@functools.lru_cache(maxsize=KEPT)
def make_robot(name: str) -> Robot:
    """The robot called `name`: one of ARMS, PATH.xml, or "robosuite:Panda" (or "Panda") for one of robosuite's.

    Raises:
        EnvironmentSetupError: no such robot, it cannot be had, or its parts are not found; says what is valid.
    """
    given = name.removeprefix("robosuite:")
    if given in ROBOSUITE:
        return robosuite_robot(given)
    if name in ARMS or name in HALVES:
        return menagerie_robot(name)
    if pair_of(name) is not None:
        raise EnvironmentSetupError(f'"{name}" is two arms, and here is room for one: {", ".join(arms_of(name))}.')
    if name.endswith((".xml", ".yaml", ".yml")):
        return described_file(name)
    raise EnvironmentSetupError(
        f'no robot "{name}". Robots: {", ".join(ARMS)}; with two arms {", ".join(PAIRS)}, or two names as '
        f'"panda+panda"; PATH.xml for your own; with robosuite installed {", ".join(ROBOSUITE)}.'
    )


def require_robot(name: str) -> None:
    """Raise EnvironmentSetupError where `name` is neither one arm nor two that can be had; says what is wrong."""
    for arm in arms_of(name):
        make_robot(arm)


@functools.lru_cache(maxsize=KEPT)
def robot_model(name: str) -> Any:
    """The compiled MuJoCo model of robot `name` alone, at the origin, in a world without gravity."""
    import mujoco

    model = make_robot(name).new_spec().compile()
    model.opt.gravity[:] = 0.0
    # The scene's own solver options, under which the fingers will move.
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model.opt.cone, model.opt.impratio = mujoco.mjtCone.mjCONE_ELLIPTIC, 10.0
    return model


def arm_kinematics(name: str) -> ArmKinematics:
    """Inverse kinematics of robot `name`."""
    return ArmKinematics(make_robot(name), robot_model(name))


@functools.lru_cache(maxsize=KEPT)
def measure_gripper(name: str) -> Gripper:
    """Measure the open gripper of robot `name` on its geoms."""
    from pat3d.envs.robots.fingers import measure

    robot, model = make_robot(name), robot_model(name)
    return measure(robot, model) if robot.robosuite is None else measure_robosuite_gripper(robot, model)
