"""What stands on what, and in what, from assets at poses: the scene tree of a picture (paper, Algorithm 1).

The paper asks a vision-language model about every pair of objects of which one is over the other and near it. Here the
fitted surfaces answer, also where there is a model (`dependencies`): from points of the child's underside one looks
down, and what carries it is the highest thing below within tolerance. What lies in a container is in it, whatever it
rests on there.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from pat3d.layout.bodies import Placed
from pat3d.layout.frames import column_at
from pat3d.scene.model import Relation
from pat3d.view.rays import RayScene
from pat3d.vision.camera import Array

GRID = 15
"""Points across the child's footprint."""
TOUCHING = 0.02
"""Gap that a fit may leave between what touches [m], and that share of the child's distance or size besides."""
SHARE = 0.1
SHALLOW = 0.15
"""Cavities whose depth is less than this share of their width are surfaces: one lies on a plate, in a bowl."""


class _Columns:
    """The surfaces of a body along vertical lines."""

    def __init__(self, body: Placed) -> None:
        # The simulator stands things on the convex parts, so these are what carries.
        corners = np.concatenate([part.vertices[part.faces] for part in body.body.asset.parts])
        self.middle = (body.low + body.high) / 2
        self._scene = RayScene((corners @ body.rotation.T + body.position - self.middle).astype(np.float32))
        self.reach = float(body.high[2] - body.low[2]) + 1.0

    def under(self, points: Array) -> Array:
        """Height of the underside at horizontal `points` [m], shape (n, 2); infinite beside the body."""
        starts = np.column_stack([points - self.middle[:2], np.full(len(points), -self.reach)])
        return self._hit(starts, 1.0, np.inf) + self.middle[2]

    def below(self, points: Array) -> Array:
        """Height of the first surface under `points` [m], shape (n, 3); minus infinity where there is none."""
        return self._hit(points - self.middle, -1.0, -np.inf) + self.middle[2]

    def _hit(self, starts: Array, way: float, nothing: float) -> Array:
        ways = np.tile(np.array([0.0, 0.0, way], dtype=np.float32), (len(starts), 1))
        face, far = self._scene.first_faces(starts.astype(np.float32), ways)
        return np.where(face >= 0, starts[:, 2] + way * far, nothing)


def supports(bodies: Mapping[str, Placed], *, slack: float = 0.0) -> tuple[Relation, ...]:
    """What carries each of `bodies`.

    Args:
        bodies: assets at their fitted poses, z up, the ground at 0.
        slack: further error of heights to reckon with [m].

    Returns:
        A relation for each that does not stand on the ground.
    """
    columns = {name: _Columns(body) for name, body in bodies.items()}
    found: list[Relation] = []
    for name, body in bodies.items():
        tall = float(body.high[2] - body.low[2])
        tolerance = TOUCHING + slack + SHARE * min(tall, 0.3)
        ground = float(body.low[2])
        beneath = [other for other in bodies if other != name and _may_carry(bodies[other], body, tolerance)]
        inside = [other for other in beneath if _is_in(body, bodies[other], tolerance)]
        if inside:
            # Of a cup in a box, both hold the pen; the smaller one is meant.
            parent = min(inside, key=lambda one: float(np.prod(bodies[one].high - bodies[one].low)))
            found.append(Relation(child=name, kind="in", parent=parent))
            continue
        gaps = {other: abs(_gap(columns[name], columns[other], body, tolerance)) for other in beneath}
        nearest = min(gaps, key=lambda other: gaps[other], default=None)
        if nearest is not None and gaps[nearest] < tolerance and (gaps[nearest] <= abs(ground) or ground > tolerance):
            found.append(Relation(child=name, kind="on", parent=nearest))
    return tuple(found)


def carried_at(body: Placed, under: Placed, slack: float = 0.0) -> float:
    """Height of the lowest point of `body` once it stands on `under` where it is [m]."""
    tall = float(body.high[2] - body.low[2])
    gap = _gap(_Columns(body), _Columns(under), body, TOUCHING + slack + SHARE * min(tall, 0.3))
    return float(body.low[2]) - gap if np.isfinite(gap) else float(under.high[2])


def _may_carry(under: Placed, body: Placed, tolerance: float) -> bool:
    """Whether `under` begins lower, and lies below some of `body`'s footprint."""
    if under.low[2] >= body.low[2] - 1e-6 and under.centre_of_mass[2] >= body.centre_of_mass[2]:
        return False
    if under.high[2] < body.low[2] - tolerance:
        return False
    return bool(np.all(under.low[:2] < body.high[:2]) and np.all(body.low[:2] < under.high[:2]))


def _is_in(body: Placed, holder: Placed, tolerance: float) -> bool:
    """Whether `body` is in the cavity of `holder`: its foot not over the rim, its middle or its foot over the floor."""
    column = column_at(holder, float(body.low[2]) + 2.0 * tolerance)
    if column is None or column.height < SHALLOW * 2.0 * float(column.half_size.min()):
        return False
    if body.low[2] > column.rim + 0.5 * float(body.high[2] - body.low[2]) - 1e-9:
        return False
    if body.low[2] < float(column.centre[2]) - 2.0 * tolerance:
        return False
    foot = body.vertices[int(np.argmin(body.vertices[:, 2])), :2]
    middle = (body.low + body.high)[:2] / 2
    low = body.low[2] < column.rim
    return bool(column.holds(middle) or (low and (column.holds(foot) or _over(holder, middle))))


def _over(holder: Placed, point: Array) -> bool:
    from pat3d.geometry.polygons import contains, outline

    return contains(outline(holder.vertices[:, :2]), point)


def _gap(child: _Columns, parent: _Columns, body: Placed, tolerance: float) -> float:
    """Least height of the child above the parent [m], where one is above the other; infinite where it never is."""
    x, y = (np.linspace(body.low[k], body.high[k], GRID + 2)[1:-1] for k in (0, 1))
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    height = child.under(grid)
    there = np.isfinite(height)
    if not there.any():
        return np.inf
    # Beginning a little higher finds surfaces into which the fit has sunk the child.
    lifted = np.column_stack([grid[there], height[there] + 1.5 * tolerance])
    gap = height[there] - parent.below(lifted)
    return float(np.quantile(gap, 0.05, method="lower")) if np.isfinite(gap).any() else np.inf
