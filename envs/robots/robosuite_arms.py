"""robosuite's arms with their grippers, where robosuite is installed: a compatibility layer that nothing else needs.

Importing this module is cheap; robosuite (a second or two) is imported when the first of its robots is made.
"""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.robots.robot import Gripper, Robot, finger_targets
from pat3d.errors import EnvironmentSetupError

Array = NDArray[np.float64]

GRIPPERS = {
    "Panda": "PandaGripper",
    "UR5e": "Robotiq140Gripper",
    "Sawyer": "RethinkGripper",
    "IIWA": "Robotiq140Gripper",
}
"""The gripper of every arm, robosuite's own names.

robosuite's Robotiq 85, its default for the UR5e, jams on itself in MuJoCo 3.9: in robosuite's own Lift the pads
stay 60 mm apart. The Robotiq 140 closes.
"""

ROBOTS = tuple(GRIPPERS)

PAYLOADS = {"Panda": 3.0, "UR5e": 5.0, "Sawyer": 4.0, "IIWA": 7.0}
"""What every arm carries by its maker's data sheet [kg]."""

INSTALL_HINT = (
    "robosuite's arms need robosuite, whose requirements cannot be met beside NumPy 2: "
    '"pip install numba opencv-python-headless termcolor && pip install --no-deps robosuite==1.5.2". '
    'Robots of MuJoCo Menagerie need none of it: robot="panda".'
)

_DRIVE_SECONDS = 0.8
"""Time after which every gripper is open or closed [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RobosuiteParts:
    """What only robosuite's arms have."""

    gripper_name: str
    pads: tuple[tuple[str, ...], tuple[str, ...]]
    """Geoms of the left and of the right finger that touch what is held."""
    naming_prefix: str
    controller: dict[str, Any]
    """robosuite's own settings of the operational-space controller for this arm."""


def robosuite_robot(name: str) -> Robot:
    """Robosuite's robot called `name`, one of ROBOTS.

    Raises:
        EnvironmentSetupError: robosuite is not installed; says how to install it.
    """
    with quiet_robosuite():
        arm = robosuite_module("models.robots").create_robot(name, idn=0)
        arm.add_base(robosuite_module("models.bases").robot_base_factory("NullMount", idn=0))
        gripper_name = GRIPPERS[name]
        gripper = robosuite_module("models.grippers").gripper_factory(gripper_name, idn="0_right")
        arm.add_gripper(gripper, arm.eef_name["right"])
        geoms = gripper.important_geoms
        settings = robosuite_module("controllers").load_composite_controller_config(robot=name)
    xml = arm.get_xml()

    def new_spec() -> Any:
        import mujoco

        return mujoco.MjSpec.from_string(xml)

    return Robot(
        name=name,
        new_spec=new_spec,
        arm_joints=tuple(arm.joints),
        arm_actuators=tuple(arm.actuators),
        gripper_joints=tuple(gripper.joints),
        gripper_actuators=tuple(gripper.actuators),
        home=np.array(arm.init_qpos, dtype=np.float64),
        gripper_home=np.array(gripper.init_qpos, dtype=np.float64),
        grip_site=gripper.important_sites["grip_site"],
        base_site=f"{arm.naming_prefix}right_center",
        wrist_camera=f"{arm.naming_prefix}eye_in_hand",
        fingers=(tuple(geoms["left_finger"]), tuple(geoms["right_finger"])),
        payload=PAYLOADS[name],
        new_drive=lambda: new_robosuite_gripper(gripper_name),
        owned=(arm.naming_prefix, "gripper0_"),
        robosuite=RobosuiteParts(
            gripper_name=gripper_name,
            pads=(tuple(geoms["left_fingerpad"]), tuple(geoms["right_fingerpad"])),
            naming_prefix=arm.naming_prefix,
            controller=dict(settings["body_parts"]["right"]),
        ),
    )


def new_robosuite_gripper(name: str) -> Any:
    """A fresh robosuite gripper."""
    return robosuite_module("models.grippers").gripper_factory(name, idn="0_right")


def measure_robosuite_gripper(robot: Robot, model: Any) -> Gripper:
    """Measure the open gripper of one of robosuite's robots on its geoms; `model` is that of the robot alone."""
    import mujoco

    data = mujoco.MjData(model)
    for joint, value in zip(robot.arm_joints, robot.home, strict=True):
        data.joint(joint).qpos[:] = value
    for joint, value in zip(robot.gripper_joints, robot.gripper_home, strict=True):
        data.joint(joint).qpos[:] = value
    ids = [model.actuator(actuator).id for actuator in robot.gripper_actuators]
    held = [model.joint(joint).dofadr[0] for joint in robot.arm_joints]

    def drive(action: float) -> tuple[float, ...]:
        """Bring the fingers to rest, and where their joints are then; the arm stands still without gravity."""
        target = finger_targets(model, robot, _settled_action(robot.new_drive(), action))
        for _ in range(round(_DRIVE_SECONDS / model.opt.timestep)):
            data.ctrl[ids] = target
            data.qvel[held] = 0.0
            mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        return tuple(float(data.joint(joint).qpos[0]) for joint in robot.gripper_joints)

    def points(names: tuple[str, ...] | tuple[int, ...]) -> Array:
        """Corners of geoms in the frame of the grip site [m]."""
        site = data.site(robot.grip_site)
        found = [_geom_points(mujoco, model, data, model.geom(geom).id) for geom in names]
        return (np.concatenate(found) - site.xpos) @ site.xmat.reshape(3, 3)

    wide = drive(-1.0)
    pads = [points(names) for names in robot.robosuite.pads]
    between = pads[1].mean(axis=0) - pads[0].mean(axis=0)
    # Across the approach, and along an axis of the site.
    between[2] = 0.0
    axis = np.zeros(3)
    axis[np.argmax(np.abs(between))] = np.sign(between[np.argmax(np.abs(between))])
    across = np.cross((0.0, 0.0, 1.0), axis)
    fingers = [points(names) for names in robot.fingers]
    hand = points(_hand_geoms(model, robot))
    tip = max(float(finger[:, 2].max()) for finger in fingers)
    ends = [finger[finger[:, 2] > tip - 0.03] for finger in fingers]
    narrow = drive(1.0)
    shut = [points(names) for names in robot.robosuite.pads]
    inner = [float((pads[0] @ axis).max()), float((pads[1] @ axis).min())]
    return Gripper(
        opening=inner[1] - inner[0],
        closed=max(0.0, float((shut[1] @ axis).min() - (shut[0] @ axis).max())),
        finger_thickness=max(inner[0] - float((ends[0] @ axis).min()), float((ends[1] @ axis).max()) - inner[1]),
        finger_width=max(float(np.ptp(end @ across)) for end in ends),
        tip=tip,
        palm=tip - float(hand[:, 2].max()),
        hand=(2 * float(np.abs(hand @ axis).max()), 2 * float(np.abs(hand @ across).max())),
        pad=tip - min(float(pad[:, 2].min()) for pad in pads),
        closing_axis=(float(axis[0]), float(axis[1]), float(axis[2])),
        open_joints=wide,
        closed_joints=narrow,
    )


def _settled_action(gripper: Any, action: float) -> Array:
    """The gripper's own target in [-1, 1] after it was told to move one way for long, shape (gripper actuators,)."""
    current = np.zeros(1)
    for _ in range(64):
        current = np.array(gripper.format_action(np.array([action])), dtype=np.float64)
    return current


def _hand_geoms(model: Any, robot: Robot) -> tuple[int, ...]:
    """What collides of the hand, fingers aside."""
    hand = int(model.site(robot.grip_site).bodyid[0])
    while model.body_parentid[hand] and not (model.geom_bodyid == hand).any():
        hand = int(model.body_parentid[hand])
    return tuple(geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == hand and model.geom_contype[geom])


def _geom_points(mujoco: Any, model: Any, data: Any, geom: int) -> Array:
    """Corners of a geom's surface in the world [m], shape (n, 3)."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        start = model.mesh_vertadr[mesh]
        local = model.mesh_vert[start : start + model.mesh_vertnum[mesh]].astype(np.float64)
    else:
        centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        local = centre + half * np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    return local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]


def robosuite_module(module: str) -> Any:
    """A module of robosuite."""
    with quiet_robosuite():
        try:
            return import_module(f"robosuite.{module}")
        except ImportError as error:
            raise EnvironmentSetupError(f"{error}; {INSTALL_HINT}") from error


@contextlib.contextmanager
def quiet_robosuite() -> Iterator[None]:
    """Without the messages that robosuite logs while loading, and without its change of MUJOCO_GL."""
    level, backend = logging.root.manager.disable, os.environ.get("MUJOCO_GL")
    logging.disable(max(level, logging.WARNING))
    try:
        yield
    finally:
        logging.disable(level)
        if backend is None:
            os.environ.pop("MUJOCO_GL", None)
        else:
            os.environ["MUJOCO_GL"] = backend
