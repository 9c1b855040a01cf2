"""Any arm and gripper as the environments take them: driven by torques, with a grip site, a base frame and a camera.

The drives of an arm make up for the friction in its joints, viscous and dry, as those of real arms do. Here that is
exact: arm joints have none, and the dry part is taken from the largest torque of their motors. Torques that a
controller added against friction would let a light wrist stick or creep: less than its friction is enough to move it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.robots.description import Description
from pat3d.envs.robots.fingers import GripFrame, find_grip
from pat3d.envs.robots.robot import Robot, SteadyDrive
from pat3d.envs.robots.structure import Parts, find_parts, torque_limits
from pat3d.errors import EnvironmentSetupError
from pat3d.geometry.pose import Pose

Array = NDArray[np.float64]

GRIP, BASE, CAMERA = "pat3d/grip", "pat3d/base", "pat3d/wrist"
TORQUE = "pat3d/torque/"
"""Before the name of a joint: its motor."""

TURNS = 2.0 * np.pi
"""Joints without a limit get this one, as cables would [rad]."""

CAMERA_BACK, CAMERA_ASIDE = 0.14, 0.07
"""The wrist camera is so far behind the grip site, and beside it [m]."""

DRAWN, HIDDEN = 2, 3
"""MuJoCo's groups of geoms that are drawn at most, and of those that are not."""

JAW_TURN = 0.7
"""By how much single jaws open [rad]."""

GRIP_FRICTION = 1.0
"""Least friction of the fingers, as of rubber pads."""


def assemble(told: Description) -> Robot:
    """The robot of a description.

    Raises:
        EnvironmentSetupError: MuJoCo refuses a file, or a part is not found; says which.
    """
    import mujoco

    from pat3d.envs.robots.posture import start_posture

    try:
        spec = _joined(told)
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        keys = {key.name: np.array(key.qpos) for key in spec.keys}
        for key in list(spec.keys):
            spec.delete(key)
        model = spec.compile()
    except ValueError as error:
        raise EnvironmentSetupError(f"{told.mjcf}: MuJoCo {mujoco.__version__} refuses it: {error}") from error
    model.opt.gravity[:] = 0.0
    parts = find_parts(model, told)
    if told.grip_armature:
        _calm(spec, model, parts, told)
    _narrow_jaw(spec, model, parts)
    grip = find_grip(model, parts, told)
    arm_joints = tuple(model.joint(joint).name for joint in parts.arm_joints)
    fingers = tuple(tuple(model.geom(geom).name for geom in side) for side in grip.fingers)
    _equip(spec, model, parts, grip, torque_limits(model, parts, told))
    if not told.grip_armature:
        _stiffen(spec, [model.actuator(number).name for number in parts.gripper_actuators], told.grip_stiffness)
    finished = spec.copy()
    robot = Robot(
        name=told.name,
        new_spec=finished.copy,
        arm_joints=arm_joints,
        arm_actuators=tuple(TORQUE + name for name in arm_joints),
        gripper_joints=tuple(model.joint(joint).name for joint in parts.gripper_joints),
        gripper_actuators=tuple(model.actuator(number).name for number in parts.gripper_actuators),
        home=np.zeros(len(arm_joints)),
        gripper_home=grip.open_joints,
        grip_site=GRIP,
        base_site=BASE,
        wrist_camera=CAMERA,
        fingers=(fingers[0], fingers[1]),
        payload=told.payload,
        new_drive=lambda: SteadyDrive(grip.closing),
    )
    known = [qpos[: len(arm_joints)] for qpos in keys.values() if len(qpos) >= len(arm_joints)]
    return start_posture(robot, known)


def _narrow_jaw(spec: Any, model: Any, parts: Parts) -> None:
    """Let a single jaw that turns open by JAW_TURN at most: beyond, it takes nothing that it could not take before."""
    import mujoco

    if len(parts.gripper_joints) != 1 or model.jnt_type[parts.gripper_joints[0]] != mujoco.mjtJoint.mjJNT_HINGE:
        return
    for number in parts.gripper_actuators:
        low, high = model.actuator_ctrlrange[number]
        zero = min(max(low, 0.0), high)
        narrow = [max(low, zero - JAW_TURN), min(high, zero + JAW_TURN)]
        spec.actuator(model.actuator(number).name).ctrlrange = narrow
        model.actuator_ctrlrange[number] = narrow


def _joined(told: Description) -> Any:
    """The arm with its gripper on it, all geoms and actuators named, without sensors and lights."""
    import mujoco

    spec = mujoco.MjSpec.from_file(str(told.mjcf))
    for thing in (*spec.sensors, *spec.lights):
        spec.delete(thing)
    if told.root:
        _keep(spec, told)
    if told.gripper is not None:
        carrier = spec.site(told.attach)
        if carrier is None:
            sites = ", ".join(site.name for site in spec.sites) or "none"
            raise EnvironmentSetupError(f'{told.mjcf}: no site "{told.attach}" to attach a gripper to. Sites: {sites}.')
        gripper = mujoco.MjSpec.from_file(str(told.gripper))
        take_options(gripper, spec)
        for thing in (*gripper.sensors, *gripper.lights):
            gripper.delete(thing)
        spec.attach(gripper, prefix="gripper/", site=carrier)
    for number, geom in enumerate(spec.geoms):
        geom.name = geom.name or f"pat3d/geom{number}"
    for number, actuator in enumerate(spec.actuators):
        actuator.name = actuator.name or f"pat3d/actuator{number}"
    for body in spec.bodies:
        body.gravcomp = 0.0
        _show(body)
    return spec


def _show(body: Any) -> None:
    """Sort geoms of the common group 0 into drawn and hidden ones: what collides is drawn where nothing else is."""
    collides = {geom.name: bool(geom.contype or geom.conaffinity) for geom in body.geoms}
    dressed = any(geom.group <= DRAWN and not collides[geom.name] for geom in body.geoms)
    for geom in body.geoms:
        if geom.group == 0:
            geom.group = HIDDEN if dressed and collides[geom.name] else DRAWN


def _keep(spec: Any, told: Description) -> None:
    """Of several arms in one file, leave the one that begins with `told.root`, at the origin and facing +x."""
    bodies = list(spec.worldbody.bodies)
    names = [body.name for body in bodies]
    if told.root not in names:
        raise EnvironmentSetupError(f'{told.mjcf}: no body "{told.root}" stands there. There are: {", ".join(names)}.')
    # A posture of all arms is one of this one only where it comes first.
    if names[0] != told.root:
        for key in list(spec.keys):
            spec.delete(key)
    for body in bodies:
        if body.name == told.root:
            body.pos, body.quat = [0.0, 0.0, body.pos[2]], [1.0, 0.0, 0.0, 0.0]
        else:
            spec.delete(body)


def take_options(child: Any, parent: Any) -> None:
    """Give `child` the solver's options of `parent`, which hold for both once it is attached; MuJoCo 4 warns if not."""
    for name in dir(parent.option):
        if not name.startswith("_"):
            setattr(child.option, name, getattr(parent.option, name))


def _stiffen(spec: Any, actuators: list[str], factor: float) -> None:
    """Multiply the stiffness of position actuators, and their damping so that they overshoot no more."""
    for name in actuators:
        actuator = spec.actuator(name)
        actuator.gainprm[0] *= factor
        actuator.biasprm[1] *= factor
        actuator.biasprm[2] *= np.sqrt(factor)


def _calm(spec: Any, model: Any, parts: Parts, told: Description) -> None:
    """Give the finger joints the armature that is told, and their actuators critical damping; the model as well."""
    for joint in parts.gripper_joints:
        spec.joint(model.joint(joint).name).armature = told.grip_armature
        model.dof_armature[model.jnt_dofadr[joint]] = told.grip_armature
    for number in parts.gripper_actuators:
        actuator = spec.actuator(model.actuator(number).name)
        _stiffen(spec, [actuator.name], told.grip_stiffness)
        actuator.biasprm[2] = -2.0 * np.sqrt(actuator.gainprm[0] * told.grip_armature)
        model.actuator_gainprm[number], model.actuator_biasprm[number] = actuator.gainprm, actuator.biasprm


def _equip(spec: Any, model: Any, parts: Parts, grip: GripFrame, torques: list[float]) -> None:
    """Put motors in the place of the arm's actuators, and add the sites and the camera."""
    import mujoco

    for number in sorted(parts.arm_actuators, reverse=True):
        spec.delete(spec.actuator(model.actuator(number).name))
    for joint, most in zip(parts.arm_joints, torques, strict=True):
        name = model.joint(joint).name
        joined = spec.joint(name)
        if not model.jnt_limited[joint]:
            joined.limited, joined.range = 1, [-TURNS, TURNS]
        most -= float(joined.frictionloss)
        if most <= 0.0:
            raise EnvironmentSetupError(f'joint "{name}": its dry friction is more than its motor\'s largest torque.')
        joined.frictionloss, joined.damping = 0.0, np.zeros_like(joined.damping)
        motor = spec.add_actuator(
            name=TORQUE + name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT, ctrllimited=1, ctrlrange=[-most, most]
        )
        motor.set_to_motor()
    for side in grip.fingers:
        for geom in side:
            pad = spec.geom(model.geom(geom).name)
            pad.friction[0] = max(pad.friction[0], GRIP_FRICTION)
    hand = spec.body(model.body(parts.hand).name)
    quat = Pose.from_matrix(grip.rotation, np.zeros(3)).quat_wxyz
    hand.add_site(name=GRIP, pos=grip.position, quat=quat, group=4)
    spec.worldbody.add_site(name=BASE, group=4)
    across, _, approach = grip.rotation.T
    eye = grip.position - CAMERA_BACK * approach + CAMERA_ASIDE * across
    back = eye - grip.position
    back /= np.linalg.norm(back)
    up = across - back * (across @ back)
    up /= np.linalg.norm(up)
    frame = np.stack([np.cross(up, back), up, back], axis=1)
    hand.add_camera(name=CAMERA, pos=eye, quat=Pose.from_matrix(frame, np.zeros(3)).quat_wxyz, fovy=75.0)
