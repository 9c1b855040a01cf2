"""A scripted hand that picks things up: it knows the true poses and is a reference for learned policies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.hand import hand_pose
from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.robots.arms import measure_gripper
from pat3d.errors import EnvironmentSetupError
from pat3d.geometry.rotations import rotation_vector

Array = NDArray[np.float64]

POSITION_STEP = 0.05
"""Of an action of 1 [m]."""

ANGLE_STEP = 0.5
"""Of an action of 1 [rad]."""

POSITION_GAIN = 2.0
ANGLE_GAIN = 1.0

CLOSE_STEPS = 12
"""Control steps that the fingers need to close."""

LIFT = 0.16
"""[m]"""


class ScriptedPick:
    """Takes an object from above with the environment's operational-space control, and lifts it.

    Args:
        env: a TabletopEnv (unwrapped) with osc control, after its reset.
        target: the object; the task's by default.
        attempt: which of the reachable grasps to use, best first.
    """

    def __init__(self, env: Any, target: str | None = None, attempt: int = 0) -> None:
        if env.control != "osc":
            raise EnvironmentSetupError(f'the scripted hand needs control="osc", not "{env.control}".')
        grasps = env.placement.grasps
        name = target or next(iter(grasps), None)
        if name is None or not grasps.get(name):
            raise EnvironmentSetupError(f'no grasp of "{name}" is known; the task\'s objects: {", ".join(grasps)}.')
        self._grasp: Grasp = grasps[name][attempt % len(grasps[name])]
        self._gripper = measure_gripper(env.robot)
        self._phase, self._closing = 0, 0
        self._servo = Servo(env)
        self._rotation = self._servo.nearer(self._grasp)

    def action(self) -> NDArray[np.float32]:
        """The next action, shape (7,); of two arms the other holds still, and the shape is (14,)."""
        axis = self._gripper.closing_axis
        at, _ = hand_pose(self._grasp, self._gripper.tip, axis)
        before, _ = hand_pose(self._grasp, self._gripper.tip, axis, back=HOVER)
        if self._phase == 0:
            command, error = self._servo.towards(before, self._rotation, -1.0)
            self._phase += error < 0.012
        elif self._phase == 1:
            command, error = self._servo.towards(at, self._rotation, -1.0)
            self._phase += error < 0.004
        elif self._phase == 2:
            command, _ = self._servo.towards(at, self._rotation, 1.0)
            self._closing += 1
            self._phase += self._closing >= CLOSE_STEPS
        else:
            command, _ = self._servo.towards(at + [0.0, 0.0, LIFT], self._rotation, 1.0)
        return command


class Servo:
    """Brings the hand of an environment with osc control to a pose, one action after the other.

    Args:
        env: a TabletopEnv.
        side: "left" or "right" of two arms; None for the one that does the task. The other holds still.
    """

    def __init__(self, env: Any, side: str | None = None) -> None:
        self._env, self._side = env, side
        self._axis = measure_gripper(env.robot).closing_axis

    def towards(self, position: Array, rotation: Array, fingers: float) -> tuple[NDArray[np.float32], float]:
        """The next action, and how far the hand still is [m, a radian counting 5 cm].

        Args:
            position: of the grip site [m], shape (3,).
            rotation: of the grip site, shape (3, 3).
            fingers: -1 opens them, 1 closes them.
        """
        hand, hand_rotation, yaw = self.hand
        c, s = math.cos(yaw), math.sin(yaw)
        to_base = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        move = to_base @ (position - hand)
        turn = to_base @ rotation_vector(rotation @ hand_rotation.T)
        command = np.concatenate(
            [_limited(POSITION_GAIN * move / POSITION_STEP), _limited(ANGLE_GAIN * turn / ANGLE_STEP), [fingers]]
        )
        error = float(np.linalg.norm(move)) + 0.05 * float(np.linalg.norm(turn))
        return self._env.simulation.whole(command.astype(np.float32), self._side), error

    @property
    def hand(self) -> tuple[Array, Array, float]:
        """Position [m] and rotation of the hand, and the direction in which its arm faces [rad]."""
        simulation = self._env.simulation
        if self._side is None:
            return simulation.state.hand, simulation.state.hand_rotation, self._env.placement.yaw
        arm = simulation.world.arm(self._side)
        site = simulation.data.site(arm.prefix + arm.robot.grip_site)
        return site.xpos.copy(), site.xmat.reshape(3, 3).copy(), arm.yaw

    def nearer(self, grasp: Grasp) -> Array:
        """Of the two rotations of the hand that close along one line, that with the shorter turn.

        A grasp that leans knows its own: for the other one the wrist may not turn far enough.
        """
        if grasp.lean:
            return hand_pose(grasp, 0.0, self._axis)[1]
        now = self._env.simulation.state.hand_rotation
        both = [hand_pose(grasp, 0.0, self._axis, half=half)[1] for half in (0.0, math.pi)]
        return max(both, key=lambda rotation: float(np.trace(rotation @ now.T)))


def _limited(values: Array) -> Array:
    """`values` scaled down together so that none is beyond 1."""
    return values / max(1.0, float(np.abs(values).max()))
