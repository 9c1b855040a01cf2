"""Are the convex parts of a scene convex, and the boxes boxes?

Simulators take the convex hull of what collides, or the box where it is said to be one. A part that is neither is
simulated as something else than what the file shows.
"""

from __future__ import annotations

import numpy as np

from pat3d.exporters.common.xml_files import convex_volume
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene

TOLERANCE = 1e-5
"""Share of the hull's volume that a part may lack, or of its size that a corner may be off."""

_SIGNS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)


def part_failures(scene: Scene) -> tuple[str, ...]:
    """A line for every part that is not what it is taken for."""
    lines = []
    seen: set[int] = set()
    for obj in scene.objects:
        if id(obj.asset) in seen:
            continue
        seen.add(id(obj.asset))
        for number, part in enumerate(obj.asset.parts):
            if fault := _fault(part):
                lines.append(f'part {number} of "{obj.name}" {fault}.')
    return tuple(lines)


def _fault(part: ConvexPart) -> str:
    if part.faces.size == 0 or part.faces.min() < 0 or part.faces.max() >= len(part.vertices):
        return "has faces of vertices that it does not have"
    corners = (part.vertices - part.vertices.mean(axis=0))[part.faces]
    volume = float(np.einsum("fi,fi->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum()) / 6.0
    hull = convex_volume(part.vertices)
    if not abs(volume - hull) <= TOLERANCE * hull:
        return f"is not convex: {1e6 * volume:.6g} cm^3 where its hull has {1e6 * hull:.6g}"
    if part.box is None:
        return ""
    centre, half, quat = part.box
    box = (_SIGNS * half) @ Pose(quat_wxyz=quat).rotation.T + centre
    apart = np.linalg.norm(part.vertices[:, None] - box[None], axis=2)
    worst = max(float(apart.min(axis=0).max()), float(apart.min(axis=1).max()))
    size = float(np.ptp(part.vertices, axis=0).max())
    return f"is not the box that it is said to be, by {1e3 * worst:.3g} mm" if worst > TOLERANCE * size else ""
