"""Actions to motor torques: robosuite's controllers on a plain MuJoCo model.

robosuite's controllers read the simulation through its own wrapper. A few names of that wrapper are enough for them,
and the state they need each step is gathered here in one pass instead of one look-up after another.
"""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.robots.inertia import inertia_matrix
from pat3d.envs.robots.robosuite_arms import quiet_robosuite, robosuite_module
from pat3d.envs.robots.robot import Robot, finger_targets

Array = NDArray[np.float64]

_CLASSES = {
    "osc": ("controllers.parts.arm.osc", "OperationalSpaceController", "osc_pose"),
    "joint_velocity": ("controllers.parts.generic.joint_vel", "JointVelocityController", "joint_velocity"),
    "joint_position": ("controllers.parts.generic.joint_pos", "JointPositionController", "joint_position"),
}


class RobosuiteController:
    """Turns actions in [-1, 1] into controls of one robot: arm first, the gripper's opening last.

    osc: changes of the hand's position (5 cm) and orientation (0.5 rad, axis-angle) in the frame of the robot's base.
    joint_velocity: joint velocities (0.5 rad/s). joint_position: changes of the joint positions (0.05 rad).
    The last value closes the gripper (positive) or opens it (negative), by a fifth of its way a control step.
    """

    def __init__(self, model: Any, data: Any, robot: Robot, prefix: str, kind: str, control_freq: float) -> None:
        self.kind, self._model, self._data, self._robot, self._prefix = kind, model, data, robot, prefix
        self._freq = control_freq
        self._arm_actuators = np.array([model.actuator(prefix + name).id for name in robot.arm_actuators])
        self._finger_actuators = np.array([model.actuator(prefix + name).id for name in robot.gripper_actuators])
        self._limits = model.actuator_ctrlrange[self._arm_actuators].T.copy()
        self._base = model.site(prefix + robot.base_site).id
        self._gripper = robot.new_drive()
        self._untouched = np.array(self._gripper.current_action)
        self._finger_middle = finger_targets(model, robot, np.zeros(len(robot.gripper_actuators)), prefix)
        self._finger_reach = (
            finger_targets(model, robot, np.ones(len(robot.gripper_actuators)), prefix) - self._finger_middle
        )
        self._operational: Any = None
        if kind == "osc":
            joints = [model.joint(prefix + name).id for name in robot.arm_joints]
            site = model.site(prefix + robot.grip_site).id
            self._operational = _operational_space(model, data, joints, site, self._arm_actuators, self._limits)
        self._arm = self._new_arm()

    @property
    def size(self) -> int:
        """Number of values of an action."""
        return int(self._arm.control_dim) + 1

    def reset(self) -> None:
        """Forget every earlier action; the present joint positions become the posture to keep."""
        self._gripper.current_action = self._untouched.copy()
        # A controller keeps integrals and filters; a new one keeps none.
        self._arm = self._new_arm()

    def set_action(self, action: Array) -> None:
        """Take an action, shape (size,), at the start of a control step; positions must be up to date."""
        arm = self._arm
        arm.set_goal(action[:-1])
        if self._operational is not None:
            # The base is bolted down, so the goal stays where it is in the world until the next action.
            self._goal = (arm.origin_pos + arm.origin_ori @ arm.goal_pos, arm.origin_ori @ arm.goal_ori)
            self._gains = (arm.kp, arm.kd, np.ascontiguousarray(arm.initial_joint))
        fingers = np.asarray(self._gripper.format_action(action[-1:]), dtype=np.float64)
        self._data.ctrl[self._finger_actuators] = self._finger_middle + self._finger_reach * fingers

    def control(self) -> None:
        """Write the torques of this physics step; positions and velocities must be up to date."""
        if self._operational is not None and self._operational.apply(*self._goal, *self._gains):
            self._arm.new_update = True
            return
        torques = np.clip(self._arm.run_controller(), self._limits[0], self._limits[1])
        self._data.ctrl[self._arm_actuators] = torques

    def _new_arm(self) -> Any:
        robot, model, prefix = self._robot, self._model, self._prefix
        joints = [model.joint(prefix + name) for name in robot.arm_joints]
        indexes = {
            "joints": [joint.id for joint in joints],
            "qpos": [int(joint.qposadr[0]) for joint in joints],
            "qvel": [int(joint.dofadr[0]) for joint in joints],
        }
        settings = dict(part_settings(self.kind))
        if self.kind == "osc":
            settings.update(robot.robosuite.controller)
        for key in ("type", "interpolation", "ramp_ratio", "gripper"):
            settings.pop(key, None)
        with quiet_robosuite():
            arm = _controller_class(self.kind)(
                _Simulation(model, self._data, slice(indexes["qvel"][0], indexes["qvel"][-1] + 1)),
                ref_name=prefix + robot.grip_site,
                joint_indexes=indexes,
                actuator_range=(self._limits[0], self._limits[1]),
                policy_freq=self._freq,
                lite_physics=True,
                part_name="right",
                naming_prefix=prefix + robot.robosuite.naming_prefix,
                use_torque_compensation=self.kind != "joint_velocity",
                **settings,
            )
        site = self._base
        arm.update_origin(self._data.site_xpos[site].copy(), self._data.site_xmat[site].reshape(3, 3).copy())
        arm.update_initial_joints(self._data.qpos[indexes["qpos"]].copy())
        arm.reset_goal()
        return arm


def _operational_space(*arguments: Any) -> Any:
    """An `OperationalSpace`; numba, which compiles it, comes with robosuite."""
    from pat3d.envs.robots.operational_space import OperationalSpace

    return OperationalSpace(*arguments)


@functools.lru_cache(maxsize=len(_CLASSES))
def part_settings(kind: str) -> dict[str, Any]:
    """The settings that robosuite has for a kind of controller."""
    name = _CLASSES[kind][2]
    return robosuite_module("controllers").load_part_controller_config(default_controller=name.upper())


_made: dict[str, type] = {}


def _controller_class(kind: str) -> type:
    """The controller of `kind` from robosuite, which reads its state in one pass."""
    if kind in _made:
        return _made[kind]
    module, name, _ = _CLASSES[kind]
    base: Any = getattr(robosuite_module(module), name)
    import mujoco

    def update(self: Any, force: bool = False) -> None:
        if not (self.new_update or force):
            return
        model, data = self.sim.native
        if force:
            mujoco.mj_forward(model, data)
        site, dofs = self.sim.site(self.ref_name), self.sim.dofs
        self.joint_pos, self.joint_vel = data.qpos[self.qpos_index], data.qvel[dofs].copy()
        self.ref_pos = data.site_xpos[site].copy()
        self.ref_ori_mat = data.site_xmat[site].reshape(3, 3).copy()
        jacobian, mass = self.sim.jacobian, self.sim.mass
        mujoco.mj_jacSite(model, data, jacobian[:3], jacobian[3:], site)
        self.J_full = jacobian[:, dofs].copy()
        self.J_pos, self.J_ori = self.J_full[:3], self.J_full[3:]
        velocity = self.J_full @ self.joint_vel
        self.ref_pos_vel, self.ref_ori_vel = velocity[:3], velocity[3:]
        self.sim.full_mass(mass)
        self.mass_matrix = mass[dofs, dofs].copy()
        self.new_update = False

    members: dict[str, Any] = {"update": update}
    if kind == "joint_velocity":
        # robosuite 1.5.2 assigns to its own read-only property here and would add 1 N m in place of gravity.
        def run_controller(self: Any) -> Array:
            return base.run_controller(self) + self.sim.data.qfrc_bias[self.qvel_index]

        members |= {"torque_compensation": False, "run_controller": run_controller}
    _made[kind] = type(f"Fast{name}", (base,), members)
    return _made[kind]


class _Simulation:
    """The part of robosuite's simulation wrapper that its controllers use."""

    def __init__(self, model: Any, data: Any, dofs: slice) -> None:
        self.native = (model, data)
        self.dofs = dofs
        """Of the arm, one after the other, as they are in a serial chain."""
        self.model = _Model(model)
        self.data = _Data(data)
        self.jacobian = np.zeros((6, model.nv))
        self.mass = np.zeros((model.nv, model.nv))
        self._sites: dict[str, int] = {}
        import mujoco

        self._mujoco = mujoco

    def forward(self) -> None:
        self._mujoco.mj_forward(*self.native)

    def site(self, name: str) -> int:
        if name not in self._sites:
            self._sites[name] = int(self.native[0].site(name).id)
        return self._sites[name]

    def full_mass(self, mass: Array) -> None:
        """The dense inertia matrix, shape (nv, nv)."""
        inertia_matrix(*self.native, mass)


class _Model:
    def __init__(self, model: Any) -> None:
        self._model, self.nv = model, model.nv

    def joint_id2name(self, joint: int) -> str:
        return self._model.joint(joint).name


class _Data:
    """Arrays of the simulation; the base of the robot is bolted down, so its velocity is zero."""

    def __init__(self, data: Any) -> None:
        self._data = data

    def __getattr__(self, name: str) -> Any:
        return getattr(self._data, name)

    def get_site_xvelp(self, name: str) -> Array:
        return np.zeros(3)

    def get_site_xvelr(self, name: str) -> Array:
        return np.zeros(3)
