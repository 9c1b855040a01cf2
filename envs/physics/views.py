"""Where the fixed cameras of a world stand: as near as they can with what they show in the picture.

All look from where the robot faces. The agent's camera shows what the task is about, the middle of everything else on
the table, and the fingertips as they start: so near that a small object is more than a few pixels beside arm and table.
The one in front is farther, lower, and shows the whole robot and the workbench. The close camera shows what the task
moves and where it goes.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.standing import Placement
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene
from pat3d.view.camera import Camera, frame

Array = NDArray[np.float64]

ANGLES = {"agentview": (40.0, 45.0), "frontview": (20.0, 45.0), "closeview": (50.0, 45.0)}
"""Height above the horizon and opening angle of each fixed camera [degrees]."""

HAND = 0.02
"""Around the fingertips the agent's camera shows at least so much [m]."""

NEAREST = 0.15
"""Around the middle of what the task is about the close camera shows at least so much [m]."""

MARGINS = {"agentview": 0.03, "frontview": 0.02, "closeview": 0.02}
"""Free on every side of a square picture, as a share of it; wider ones have more at the sides. The agent's camera has
more, for what a reset moves."""

DRAWN_GROUPS = 3
"""Geoms of MuJoCo's first three groups are drawn."""

_CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


def aim(
    model: Any,
    scene: Scene,
    placement: Placement,
    robot: NDArray[np.bool_],
    posture: Mapping[str, float],
    hands: Sequence[str],
) -> None:
    """Place and turn the fixed cameras of a compiled world.

    Args:
        model: MuJoCo's, with cameras of those names; changed.
        scene: in it.
        placement: of the robot.
        robot: which geoms are the robot's, shape (geoms,).
        posture: position of every joint of the robot at the start.
        hands: names of the sites between the fingertips.
    """
    import mujoco

    data = mujoco.MjData(model)
    for joint, value in posture.items():
        data.joint(joint).qpos[:] = value
    mujoco.mj_kinematics(model, data)
    arm = _corners(model, data, np.flatnonzero(robot & (model.geom_group < DRAWN_GROUPS)))
    # Of pedestals nothing is needed that is below what the robot works on.
    arm[:, 2] = np.maximum(arm[:, 2], placement.surface)
    tips = [data.site(name).xpos + HAND * _CORNERS for name in hands]
    work = {
        obj.name: np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])
        for obj in scene.objects
        if obj.name in placement.shown
    }
    visited = np.array(placement.visit, dtype=np.float64).reshape(-1, 3)
    about = [points for name, points in work.items() if name in placement.grasps or _over(points, visited)]
    middles = [(points.min(axis=0, keepdims=True) + points.max(axis=0, keepdims=True)) / 2 for points in work.values()]
    moved = [obj for obj in scene.objects if obj.name in placement.grasps]
    task = [*(obj.pose.apply(part.vertices) for obj in moved for part in obj.asset.parts), visited]
    middle = np.concatenate([points.mean(axis=0, keepdims=True) for points in task if len(points)]).mean(axis=0)
    task.append(middle + NEAREST * _CORNERS)
    bench = []
    if placement.bench is not None:
        (low_x, low_y), (high_x, high_y) = placement.bench
        bench.append(np.array([[x, y, 0.0] for x in (low_x, high_x) for y in (low_y, high_y)]))
    shown = {
        "agentview": [*tips, *about, *middles, visited],
        "frontview": [arm, *work.values(), *bench],
        "closeview": task,
    }
    for name, points in shown.items():
        elevation, angle = ANGLES[name]
        camera = frame(
            np.concatenate(points),
            aspect=1.0,
            azimuth=90.0 + math.degrees(placement.yaw if placement.view is None else placement.view),
            elevation=elevation,
            field_of_view=angle,
            margin=MARGINS[name],
        )
        number = model.camera(name).id
        model.cam_pos[number], model.cam_quat[number], model.cam_fovy[number] = camera.position, _quat(camera), angle


def _over(points: Array, visited: Array) -> bool:
    """Whether one of the places visited is above or inside the box around an object's points."""
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    return bool(((visited[:, :2] >= low) & (visited[:, :2] <= high)).all(axis=1).any())


def _corners(model: Any, data: Any, geoms: NDArray[np.int64]) -> Array:
    """Corners of the boxes around geoms in the world [m], shape (8 geoms, 3)."""
    boxes = model.geom_aabb[geoms]
    local = boxes[:, None, :3] + boxes[:, None, 3:] * _CORNERS
    turned = np.einsum("gij,gkj->gki", data.geom_xmat[geoms].reshape(-1, 3, 3), local)
    return (data.geom_xpos[geoms][:, None] + turned).reshape(-1, 3)


def _quat(camera: Camera) -> tuple[float, float, float, float]:
    """Orientation (wxyz) of MuJoCo's camera, which looks along its -z with y upwards in the picture."""
    right, up, forward = camera.axes
    return Pose.from_matrix(np.stack([right, up, -forward], axis=1), np.zeros(3)).quat_wxyz
