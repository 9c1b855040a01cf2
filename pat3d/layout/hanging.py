"""Hanging a group under another: a free place below a branch, a bar or a hook.

An object hangs by the anchors of its asset, else by the middle of its top or by two opposite points of its rim. It is
turned until its centre of mass is plumb below them, brought under the carrier where every anchor has the carrier's
underside right above it, and lifted until the layout's gap remains: out of the reach of the simulator's contact, so
that the attachment carries alone.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.ndimage import uniform_filter

from pat3d.errors import LayoutError
from pat3d.geometry.rotations import turn, yaw_matrix
from pat3d.layout.bodies import Array, Body, Placed
from pat3d.layout.drop import clear, fall
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map, resting_heights, top_map
from pat3d.scene.asset import Asset
from pat3d.scene.model import Attachment

CELLS = 48
"""Positions tried across the carrier."""
CLEARANCE = 0.02
"""Height that hanging things keep from the ground [m]."""
HOOK = 0.03
"""Longest way from an anchor up to the carrier's surface [m]."""
_FREE = 0.04
"""Room to the sides and below that large things keep from what else is there [m]."""
_STEEPEST = math.radians(10.0)
_YAWS = (0.0, math.pi / 2, math.pi / 4, -math.pi / 4)
_TOP = 5e-3
"""Vertices this near the highest are the top [m]."""


def anchors_of(asset: Asset) -> Array:
    """Points by which `asset` hangs [m], shape (anchors, 3), asset frame."""
    if asset.anchors:
        return np.array(asset.anchors)
    body = Body("", asset)
    top = float(body.vertices[:, 2].max())
    upper = body.vertices[body.vertices[:, 2] > top - _TOP]
    middle = (upper[:, :2].min(axis=0) + upper[:, :2].max(axis=0)) / 2
    height = float(top_map([body.at(np.eye(3), np.zeros(3))], middle, 1.0, (1, 1), 0.0)[0, 0])
    if height > top - _TOP:
        return np.array([[*middle, height]])
    # A rim has no middle: its two ends along x, so that what is inside stays inside.
    ends = [upper[np.abs(upper[:, 0] - x) < _TOP] for x in (upper[:, 0].min(), upper[:, 0].max())]
    return np.array([end[np.argmin(np.abs(end[:, 1] - middle[1]))] for end in ends])


def attachment(child: Placed, parent: Placed) -> Attachment | None:
    """How `child` hangs from `parent` where it is: None unless the parent's underside is right above every anchor."""
    own, points = anchors_of(child.body.asset), _anchors(child)
    above = np.array([_underside(parent, point[:2]) for point in points]) - points[:, 2]
    if not np.all((above > 0.0) & (above <= HOOK)):
        return None
    held = (points - parent.position) @ parent.rotation
    anchors = tuple((tuple(map(float, a)), tuple(map(float, b))) for a, b in zip(own, held, strict=True))
    return Attachment(child=child.body.name, parent=parent.body.name, anchors=anchors)  # type: ignore[arg-type]


def hang(group: Group, carrier: Group, *, gap: float) -> tuple[Group, Attachment]:
    """`group`, whose root's origin is at zero, hung from the underside of `carrier`'s root, and what holds it.

    Args:
        group: what hangs.
        carrier: what it hangs from, with everything that must not be in the way.
        gap: distance kept from everything [m].

    Raises:
        LayoutError: no place under the carrier is high enough.
    """
    for yaw in _YAWS:
        found = _hung(_plumb(group.turned(yaw_matrix(yaw))), carrier, gap)
        if found is not None:
            return found
    raise LayoutError(
        f'"{group.name}" ({group.size[2]:.2f} m high) cannot hang from "{carrier.name}": nothing of it is that high '
        "above the ground with free air below. Nothing was written."
    )


def _hung(group: Group, carrier: Group, gap: float) -> tuple[Group, Attachment] | None:
    """`group` at its orientation in the best place under the carrier."""
    root, anchors = carrier.root, _anchors(group.root)
    cell = float((root.high - root.low)[:2].max()) / CELLS
    counts = np.maximum(1, ((root.high - root.low)[:2] / cell).astype(int))
    corner = (root.low + root.high)[:2] / 2 - cell * (counts - 1) / 2
    before = np.ceil((-group.low[:2] + gap + cell) / cell).astype(int)
    shape = tuple(before + np.ceil((group.high[:2] + gap + cell) / cell).astype(int) + 1)
    upper = top_map(group.members, -cell * before, cell, shape, gap + cell / 2)
    under = bottom_map([root], corner - cell * before, cell, tuple(counts + np.array(shape) - 1), cell / 2)
    heights = -resting_heights(-under, -upper) - gap
    x, y = (corner[k] + cell * np.arange(counts[k]) for k in range(2))
    spots = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    middle = (root.low + root.high)[:2] / 2
    allowed = np.isfinite(heights) & (heights + group.low[2] > root.low[2] + CLEARANCE)
    # All anchors want something level right above them (a branch along them), halfway out, rather in front, and
    # rather low: a branch and not the foliage over it.
    rows, columns = heights.shape
    cells = np.round(anchors[:, :2] / cell).astype(int) + before
    over = np.stack([under[i : i + rows, j : j + columns] for i, j in cells]) - anchors[:, 2, None, None]
    allowed &= np.isfinite(over).all(axis=0)
    out = np.abs(np.linalg.norm(spots - middle, axis=-1) - 0.25 * float((root.high - root.low)[:2].max()))
    slack = np.where(allowed, np.where(allowed, over, 0.0).max(axis=0) - np.where(allowed, heights, 0.0), np.inf)
    cost = slack + 0.1 * (out + np.where(allowed, heights, 0.0)) + 0.03 * (spots[..., 1] - middle[1])
    for index in np.argsort(cost, axis=None)[:24]:
        i, j = np.unravel_index(index, cost.shape)
        if not np.isfinite(cost[i, j]):
            break
        found = _tied(group, carrier, _under_the_ridge(root, spots[i, j], anchors[:, :2], cell), gap)
        if found is not None:
            return found
    return None


def _tied(group: Group, carrier: Group, spot: Array, gap: float) -> tuple[Group, Attachment] | None:
    """`group` with its origin at `spot` [m], shape (2,), tilted with the carrier's underside and lifted to it."""
    root, anchors = carrier.root, _anchors(group.root)
    above = np.array([_underside(root, point) for point in anchors[:, :2] + spot])
    if not np.isfinite(above).all():
        return None
    if len(anchors) == 2:
        span = (anchors[1] - anchors[0])[:2]
        slope = math.atan2(above[1] - above[0], float(np.linalg.norm(span)))
        if abs(slope) > _STEEPEST:
            return None
        group = group.turned(turn(np.array([span[1], -span[0], 0.0]), slope))
        anchors = _anchors(group.root)
    highest = max(float(group.high[2] - anchors[:, 2].max()), 0.0)
    height = float((above - anchors[:, 2]).min()) - highest - gap - 0.02
    start = group.shifted(np.array([*spot, height]))
    if not all(clear(member, carrier.members, gap - 2e-4) for member in start.members):
        return None
    rise = min(fall(member, [root], floor=float(root.high[2]), gap=gap, upwards=True) for member in start.members)
    hung = start.shifted(np.array([0.0, 0.0, rise]))
    air = min(_FREE, 0.25 * float(hung.size.min()))
    lower = hung.shifted(np.array([0.0, 0.0, -air]))
    free = all(clear(member, carrier.members, 0.8 * air) for member in lower.members)
    held = attachment(hung.root, root)
    grounded = float(hung.low[2]) < float(root.low[2]) + CLEARANCE
    return None if held is None or grounded or not free else (hung, held)


def _plumb(group: Group) -> Group:
    """`group` turned until its centre of mass is straight below its one anchor, or below the line of its two."""
    anchors = _anchors(group.root)
    if len(anchors) > 2:
        return group
    if len(anchors) == 2:
        line = anchors[1] - anchors[0]
        flat = math.atan2(line[2], float(np.linalg.norm(line[:2])))
        group = group.turned(turn(np.array([line[1], -line[0], 0.0]), -flat))
        anchors = _anchors(group.root)
    down = group.centre_of_mass - anchors.mean(axis=0)
    if len(anchors) == 2:
        along = (anchors[1] - anchors[0]) / np.linalg.norm(anchors[1] - anchors[0])
        down = down - (down @ along) * along
    length = float(np.linalg.norm(down))
    if length < 1e-6:
        return group
    target = np.array([0.0, 0.0, -1.0])
    axis = np.cross(down / length, target)
    return group.turned(turn(axis, math.atan2(float(np.linalg.norm(axis)), float(down @ target) / length)))


def _under_the_ridge(root: Placed, spot: Array, anchors: Array, cell: float) -> Array:
    """The place near `spot` where the carrier is lowest and level around the points above `anchors`, shape (n, 2)."""
    fine, reach = cell / 10, 20
    score = np.zeros((2 * reach + 1, 2 * reach + 1))
    heights = []
    for anchor in anchors:
        field = bottom_map([root], spot + anchor - fine * reach, fine, score.shape, 1e-4)
        heights.append(field)
        if np.isfinite(field).any():
            score += uniform_filter(np.minimum(field, field.min() + cell), 21, mode="nearest")
    middle = slice(reach - 10, reach + 11)
    known = np.stack(heights)[:, middle, middle]
    reached = np.isfinite(known).all(axis=0)
    if not reached.any():
        return spot
    known = np.where(reached, known, 0.0)
    steps = fine * np.arange(-10, 11)
    away = np.hypot(steps[:, None], steps[None])
    cost = score[middle, middle] + 2.0 * (known.max(axis=0) - known.min(axis=0)) + 1e-3 * away
    i, j = np.unravel_index(np.argmin(np.where(reached, cost, np.inf)), cost.shape)
    return spot + np.array([steps[i], steps[j]])


def _underside(body: Placed, point: Array) -> float:
    """Lowest height of `body` over `point` [m], shape (2,); infinite where there is none."""
    return float(bottom_map([body], point, 1.0, (1, 1), 0.0)[0, 0])


def _anchors(body: Placed) -> Array:
    return anchors_of(body.body.asset) @ body.rotation.T + body.position
