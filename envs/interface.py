"""What goes into a policy and what comes out of it, as data: frames, units, conventions, rates and cameras.

`describe(env)` is JSON: it says of every action and observation what it means, so that a policy that was trained
elsewhere can be connected without reading code, and so that a checker can say what is connected wrongly.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.env import TabletopEnv
from pat3d.envs.observations import ObservationSpec
from pat3d.envs.physics.views import ANGLES
from pat3d.envs.physics.world import Mounted
from pat3d.envs.robots.controllers import LARGEST
from pat3d.geometry.pose import Pose

Array = NDArray[np.float64]

FORMAT, VERSION = "pat3d-interface", 1

FRAMES = {
    "world": "the scene's: z up, metres; the origin is where the scene has it",
    "base": "of the robot's base: x ahead, y to the left, z up",
    "hand": "between the fingertips: z out of the hand, y along which the fingers close",
    "camera": "x to the right of the picture, y down, z ahead (OpenCV); pixel centres at whole numbers plus 0.5",
}

ACTIONS = {
    "osc": (
        {
            "name": "position",
            "means": "change of the hand's position, from where it is",
            "unit": "m",
            "frame": "base",
            "size": 3,
        },
        {
            "name": "rotation",
            "means": "change of the hand's orientation, from how it is turned, about the axes of the frame",
            "convention": "rotation vector (axis-angle)",
            "unit": "rad",
            "frame": "base",
            "size": 3,
        },
    ),
    "joint_velocity": ({"name": "joints", "means": "velocity of every joint", "unit": "rad/s"},),
    "joint_position": ({"name": "joints", "means": "change of every joint's position", "unit": "rad"},),
}
"""Parts of an action of one arm, before the gripper's."""

GRIPPER = {
    "name": "gripper",
    "means": "direction in which the fingers move",
    "size": 1,
    "open": -1.0,
    "closed": 1.0,
    "convention": "positive closes, negative opens, by a tenth of the range a control step; it is no target",
}

OBSERVATIONS = {
    "joint_pos": {"means": "positions of the arm's joints", "unit": "rad"},
    "joint_vel": {"means": "velocities of the arm's joints", "unit": "rad/s"},
    "gripper_pos": {"means": "positions of the gripper's joints", "unit": "m or rad"},
    "eef_pos": {"means": "position of the hand", "unit": "m", "frame": "world"},
    "eef_quat": {
        "means": "orientation of the hand",
        "convention": "quaternion w x y z; the largest value is positive",
        "frame": "world",
    },
    "objects": {
        "means": "position and orientation of every object that can move, a row each; zero beyond the last",
        "unit": "m",
        "convention": "x y z, quaternion w x y z",
        "frame": "world",
    },
    "target": {
        "means": "position and orientation of the object to take, and where it is to go",
        "unit": "m",
        "convention": "x y z, quaternion w x y z, x y z",
        "frame": "world",
    },
    "image": {"means": "picture", "convention": "RGB, row 0 at the top"},
    "depth": {"means": "distance from the camera's plane", "unit": "m"},
    "segmentation": {"means": "0 nothing, 1 robot, 2 + index of the object"},
}
"""By the end of their names."""


def describe(env: TabletopEnv) -> dict[str, Any]:
    """What a policy of `env` gets and gives; cameras as they are in its present scene.

    Args:
        env: made, and reset or not.
    """
    config, world = env.config, env.simulation.world
    return {
        "format": FORMAT,
        "version": VERSION,
        "robot": config.arms,
        "frames": FRAMES,
        "action": {
            "control": config.control,
            "rate": {"value": config.control_freq, "unit": "1/s"},
            "size": env.simulation.controller.size,
            "range": [-1.0, 1.0],
            "parts": [part for arm in world.arms for part in _action(env, arm)],
        },
        "observation": {kind: _observation(env, kind) for kind in ("state", "rgbd")},
        "cameras": cameras(env),
        "instruction": "text: info['instruction'] after a reset",
    }


def cameras(env: TabletopEnv) -> dict[str, dict[str, Any]]:
    """Intrinsics and poses of all cameras in the present scene, by name."""
    return {name: _camera(env, name) for name in _names(env)}


def _action(env: TabletopEnv, arm: Mounted) -> list[dict[str, Any]]:
    """The parts of one arm's actions and where they stand in the whole."""
    control, place = env.config.control, env.simulation.part(arm.side)
    at, parts = int(place.start or 0), []
    largest = LARGEST[control]
    for part in ACTIONS[control]:
        size = part.get("size", len(arm.robot.arm_joints))
        scale = largest[at - int(place.start or 0)] if len(largest) > 1 else largest[0]
        parts.append({**part, "size": size, "arm": arm.side, "slice": [at, at + size], "scale": scale})
        at += size
    return [*parts, {**GRIPPER, "arm": arm.side, "slice": [at, at + 1]}]


def _observation(env: TabletopEnv, kind: str) -> dict[str, Any]:
    """Every entry of an observation of one kind."""
    config = env.config
    height, width = config.image_size
    spec = ObservationSpec(
        kind=kind,
        cameras=tuple(config.cameras),
        height=height,
        width=width,
        segmentation=config.segmentation,
        max_objects=config.max_objects or len(env.objects),
    )
    return {
        name: {**_meaning(name), "shape": list(space.shape or ()), "dtype": str(space.dtype)}
        for name, space in spec.space(env.simulation.world).spaces.items()
    }


def _meaning(name: str) -> dict[str, Any]:
    return next(said for end, said in OBSERVATIONS.items() if name == end or name.endswith(f"_{end}"))


def _names(env: TabletopEnv) -> list[str]:
    model = env.simulation.model
    return [name for number in range(model.ncam) if (name := model.camera(number).name) and _is_ours(name)]


def _is_ours(name: str) -> bool:
    """The scene's own camera is for viewers."""
    return name in ANGLES or name.endswith("wrist")


def _camera(env: TabletopEnv, name: str) -> dict[str, Any]:
    """Intrinsics for the observations' size, and the pose: of a fixed camera in the base, else in the hand."""
    import mujoco

    world, (height, width) = env.simulation.world, env.config.image_size
    model = world.model
    data = mujoco.MjData(model)
    data.qpos[:] = env.simulation.data.qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_camlight(model, data)
    number = model.camera(name).id
    focal = height / (2.0 * math.tan(math.radians(float(model.cam_fovy[number])) / 2.0))
    fixed = int(model.cam_bodyid[number]) == 0
    arm = world.arm(world.placement.side) if fixed else next(a for a in world.arms if name.startswith(a.key))
    site = model.site(arm.prefix + (arm.robot.base_site if fixed else arm.robot.grip_site)).id
    frame = data.site_xmat[site].reshape(3, 3)
    # MuJoCo's cameras look along -z with y upwards.
    turned = frame.T @ data.cam_xmat[number].reshape(3, 3) @ np.diag([1.0, -1.0, -1.0])
    position = frame.T @ (data.cam_xpos[number] - data.site_xpos[site])
    pose = Pose.from_matrix(turned, position)
    return {
        "size": [height, width],
        "intrinsics": [[focal, 0.0, width / 2.0], [0.0, focal, height / 2.0], [0.0, 0.0, 1.0]],
        "vertical_field_of_view": {"value": float(model.cam_fovy[number]), "unit": "degrees"},
        "frame": "base" if fixed else "hand",
        "arm": arm.side,
        "position": [float(value) for value in pose.position],
        "quat_wxyz": [float(value) for value in pose.quat_wxyz],
        "moves_between_scenes": fixed,
    }
