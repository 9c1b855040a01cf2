"""The fingers of any parallel gripper, found and measured by driving it open and closed.

What moves apart are the fingers; the way in which they do is the closing direction, and the axis of the last joint of
the arm is that of the approach. Widths are measured on the convex hulls that collide, cut into slices.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.envs.robots.description import Description
from pat3d.envs.robots.robot import Gripper, Robot, finger_targets
from pat3d.envs.robots.structure import Parts
from pat3d.errors import EnvironmentSetupError

Array = NDArray[np.float64]

DRIVE_SECONDS = 1.0
"""After which every gripper is open or closed [s]."""

MOVES = 0.004
"""What moves less while the gripper closes [m] is no finger."""

BEHIND_TIP = 0.012
"""Of the grip site [m]."""

SLICE = 0.003
"""Height of the slices in which fingers are measured [m]."""

FLAT = 0.004
"""Pads are as high as the gap between the fingers stays this near to that at the tips [m]."""

NARROWER = 0.001
"""What enters a gap that is narrower than the opening by more than this [m] gets stuck in it."""

JAW_LENGTH = 0.045
"""What of a hand reaches this near to its tip [m] is the jaw on which a single finger closes."""

TIP_LENGTH = 0.03
"""Fingers are as thick as they are over this length from the tips [m]."""


@dataclass(frozen=True, kw_only=True)
class GripFrame:
    """Where the grip site belongs on the hand, and what the gripper is made of."""

    position: Array
    """In the frame of the hand's body [m], shape (3,)."""
    rotation: Array
    """Columns: across, closing direction, approach; shape (3, 3)."""
    fingers: tuple[tuple[int, ...], tuple[int, ...]]
    """Geoms of either side."""
    closing: tuple[float, ...]
    """See SteadyDrive."""
    open_joints: Array
    """Of the gripper, shape (gripper joints,)."""


def find_grip(model: Any, parts: Parts, told: Description) -> GripFrame:
    """Drive the gripper to both ends of its range and see what moves.

    Raises:
        EnvironmentSetupError: nothing moves apart.
    """
    import mujoco

    data = mujoco.MjData(model)
    ranges = model.actuator_ctrlrange[list(parts.gripper_actuators)]
    addresses = [int(model.jnt_qposadr[joint]) for joint in parts.gripper_joints]
    clouds: list[dict[int, Array]] = []
    joints: list[Array] = []
    geoms = [
        geom
        for geom in range(model.ngeom)
        if _collides(model, geom) and _carried(model, int(model.geom_bodyid[geom]), parts.hand)
    ]
    for end in (0, 1):
        _drive(mujoco, model, data, parts, ranges[:, end])
        clouds.append({geom: geom_points(model, data, geom) for geom in geoms})
        joints.append(data.qpos[addresses].copy())
    last = parts.arm_joints[-1]
    axis, anchor = data.xaxis[last].copy(), data.xanchor[last].copy()
    moved = {geom: clouds[1][geom].mean(axis=0) - clouds[0][geom].mean(axis=0) for geom in geoms}
    moved = {geom: shift - axis * (shift @ axis) for geom, shift in moved.items()}
    moved = {geom: shift for geom, shift in moved.items() if np.linalg.norm(shift) > MOVES}
    if not moved:
        raise EnvironmentSetupError(
            f"{told.name}: the fingers do not move when {len(ranges)} actuators go through their ctrlrange, or do not "
            f"collide. Name others under gripper_actuators in {told.mjcf.with_suffix('.yaml').name}."
        )
    approach = axis * np.sign(np.concatenate([clouds[0][geom] for geom in moved]).mean(axis=0) @ axis - anchor @ axis)
    across = np.linalg.svd(np.array(list(moved.values())))[2][0]
    sides = [[geom for geom, shift in moved.items() if sign * (shift @ across) > 0.0] for sign in (-1.0, 1.0)]
    if not all(sides):
        # One jaw moves towards one that is part of the hand.
        ahead = {geom: float((clouds[0][geom] @ approach).max()) for geom in geoms}
        fixed = [g for g in geoms if g not in moved and ahead[g] > max(ahead.values()) - JAW_LENGTH]
        if not fixed:
            raise EnvironmentSetupError(f"{told.name}: one finger moves, and nothing for it to close on collides.")
        sides[0 if not sides[0] else 1] = fixed
    middle = [[np.concatenate([cloud[g] for g in side]).mean(axis=0) @ across for side in sides] for cloud in clouds]
    gaps = [abs(high - low) for low, high in middle]
    opened = int(gaps[1] > gaps[0])
    if middle[opened][0] > middle[opened][1]:
        sides.reverse()
    tip = max(float((clouds[opened][g] @ approach).max()) for side in sides for g in side)
    ends = [
        np.concatenate([_slice(clouds[opened][g], approach, tip - TIP_LENGTH, tip) for g in side]) for side in sides
    ]
    along = (float((ends[0] @ across).max()) + float((ends[1] @ across).min())) / 2
    beside = np.cross(across, approach)
    aside = float(np.mean([(end @ beside).min() + (end @ beside).max() for end in ends])) / 2
    place = approach * (tip - BEHIND_TIP) + across * along + beside * aside
    turned, origin = data.xmat[parts.hand].reshape(3, 3), data.xpos[parts.hand]
    sign = 1.0 if opened == 0 else -1.0
    return GripFrame(
        position=turned.T @ (place - origin),
        rotation=turned.T @ np.stack([beside, across, approach], axis=1),
        fingers=(tuple(sides[0]), tuple(sides[1])),
        closing=(sign,) * len(ranges),
        open_joints=joints[opened],
    )


def measure(robot: Robot, model: Any) -> Gripper:
    """Measure a gripper on its geoms, open and closed; `model` is that of the robot alone."""
    import mujoco

    data = mujoco.MjData(model)
    data.qpos[[int(model.joint(name).qposadr[0]) for name in robot.arm_joints]] = robot.home
    addresses = [int(model.joint(name).qposadr[0]) for name in robot.gripper_joints]
    data.qpos[addresses] = robot.gripper_home
    ids = [model.actuator(name).id for name in robot.gripper_actuators]
    dofs = [int(model.joint(name).dofadr[0]) for name in robot.arm_joints]
    found = []
    for action in (-1.0, 1.0):
        drive = robot.new_drive()
        for _ in range(64):
            target = np.asarray(drive.format_action(np.array([action])))
        for _ in range(round(DRIVE_SECONDS / model.opt.timestep)):
            data.ctrl[ids] = finger_targets(model, robot, target)
            data.qvel[dofs] = 0.0
            mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)
        site = data.site(robot.grip_site)
        turned, origin = site.xmat.reshape(3, 3), site.xpos
        sides = [
            [(geom_points(model, data, model.geom(name).id) - origin) @ turned for name in side]
            for side in robot.fingers
        ]
        found.append((sides, tuple(float(value) for value in data.qpos[addresses])))
    (opened, wide), (shut, narrow) = found
    hand = _hand_points(model, data, robot)
    tip = max(float(cloud[:, 2].max()) for side in opened for cloud in side)
    gaps = _gaps(opened, tip)
    near = next((k for k, gap in enumerate(gaps) if np.isfinite(gap)), 0)
    narrowest = near + int(gaps[near : near + 4].argmin())
    # The tips of a jaw that turns are further apart than what is behind them.
    flat = [number <= narrowest or bool(abs(gap - gaps[narrowest]) < FLAT) for number, gap in enumerate(gaps)][near:]
    pad = SLICE * (near + (flat.index(False) if False in flat else len(flat)))
    inner = _inner(opened, tip - pad, tip)
    narrow_at = [number for number, gap in enumerate(gaps) if number > near and gap < inner[1] - inner[0] - NARROWER]
    ends = [np.concatenate([_slice(cloud, _UP, tip - TIP_LENGTH, tip) for cloud in side]) for side in opened]
    closed = _inner(shut, tip - pad, tip)
    return Gripper(
        opening=inner[1] - inner[0],
        closed=max(0.0, closed[1] - closed[0]),
        finger_thickness=max(inner[0] - float(ends[0][:, 1].min()), float(ends[1][:, 1].max()) - inner[1]),
        finger_width=2 * max(float(np.abs(end[:, 0]).max()) for end in ends),
        tip=tip,
        palm=tip - float(hand[:, 2].max()),
        hand=(2 * float(np.abs(hand[:, 1]).max()), 2 * float(np.abs(hand[:, 0]).max())),
        pad=pad,
        closing_axis=(0.0, 1.0, 0.0),
        open_joints=wide,
        closed_joints=narrow,
        throat=SLICE * narrow_at[0] if narrow_at else np.inf,
    )


_UP = np.array([0.0, 0.0, 1.0])


def _gaps(sides: Sequence[Sequence[Array]], tip: float) -> Array:
    """Free width between two fingers in slices from the tips backwards [m], shape (slices,)."""
    found = []
    for number in range(round(0.06 / SLICE)):
        low, high = _inner(sides, tip - (number + 1) * SLICE, tip - number * SLICE)
        found.append(high - low)
    return np.array(found)


def _inner(sides: Sequence[Sequence[Array]], low: float, high: float) -> tuple[float, float]:
    """Innermost points of both fingers along y between two heights [m]; infinitely far where there is none."""
    cut = [[_slice(cloud, _UP, low, high) for cloud in side] for side in sides]
    first = max((float(points[:, 1].max()) for points in cut[0] if len(points)), default=-np.inf)
    second = min((float(points[:, 1].min()) for points in cut[1] if len(points)), default=np.inf)
    return first, second


def _slice(points: Array, direction: Array, low: float, high: float) -> Array:
    """Corners of the convex hull of `points` between two planes across `direction`, shape (n, 3)."""
    heights = points @ direction
    inside = (heights >= low) & (heights <= high)
    kept = [points[inside]]
    if not inside.all() and heights.max() >= low and heights.min() <= high:
        try:
            faces = ConvexHull(points).simplices
        except QhullError:
            return kept[0]
        edges = np.unique(
            np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0
        )
        for plane in (low, high):
            a, b = heights[edges[:, 0]] - plane, heights[edges[:, 1]] - plane
            crossing = edges[a * b < 0.0]
            share = (a / (a - b + 1e-300))[a * b < 0.0][:, None]
            kept.append(points[crossing[:, 0]] + share * (points[crossing[:, 1]] - points[crossing[:, 0]]))
    return np.concatenate(kept)


def _hand_points(model: Any, data: Any, robot: Robot) -> Array:
    """Of what collides of the body that carries the fingers, in the frame of the grip site [m]."""
    site = data.site(robot.grip_site)
    body = int(model.site(robot.grip_site).bodyid[0])
    own = {name for side in robot.fingers for name in side}
    while body:
        geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] == body and _collides(model, g)]
        geoms = [g for g in geoms if model.geom(g).name not in own]
        if geoms:
            points = np.concatenate([geom_points(model, data, g) for g in geoms])
            return (points - site.xpos) @ site.xmat.reshape(3, 3)
        body = int(model.body_parentid[body])
    return np.array([[0.0, 0.0, -0.1]])


def geom_points(model: Any, data: Any, geom: int) -> Array:
    """Corners of what a geom collides with, in the world [m], shape (n, 3); round ones as the boxes around them."""
    import mujoco

    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        start = model.mesh_vertadr[mesh]
        local = model.mesh_vert[start : start + model.mesh_vertnum[mesh]].astype(np.float64)
        if len(local) > 64:
            local = local[ConvexHull(local).vertices]
    else:
        centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        local = centre + half * np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    return local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]


def _drive(mujoco: Any, model: Any, data: Any, parts: Parts, targets: Array) -> None:
    """Bring the fingers to rest while the arm is held where it is."""
    arm = [int(model.jnt_qposadr[joint]) for joint in parts.arm_joints]
    dofs = [int(model.jnt_dofadr[joint]) for joint in parts.arm_joints]
    held = data.qpos[arm].copy()
    for _ in range(round(DRIVE_SECONDS / model.opt.timestep)):
        data.ctrl[list(parts.gripper_actuators)] = targets
        data.qpos[arm], data.qvel[dofs] = held, 0.0
        mujoco.mj_step(model, data)
    data.qpos[arm] = held
    mujoco.mj_forward(model, data)


def _collides(model: Any, geom: int) -> bool:
    return bool(model.geom_contype[geom] or model.geom_conaffinity[geom])


def _carried(model: Any, body: int, hand: int) -> bool:
    while body > hand:
        body = int(model.body_parentid[body])
    return body == hand
