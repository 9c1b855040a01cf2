"""Collision shapes of a description as convex hulls, where they are meant as such."""

from __future__ import annotations

import re

import numpy as np

from pat3d.assets.library.body import Piece, Points
from pat3d.assets.mesh.topology import signed_volume
from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part

CONVEX = 0.9
"""A collision mesh that fills this share of its hull is a convex part, as simulators take it; what fills less is left
to decomposition."""

MAX_HULLS = 256

FROM_PICTURE = "so the convex parts were made from the picture's mesh"
"""End of the notes about shapes that are not taken."""

_MADE_CONVEX = re.compile(r"vhacd|v-hacd|coacd|convex|decomp|hull", re.IGNORECASE)
"""Names of files whose every piece is meant as its hull, whatever rounding has done to it."""


def meant_as_hull(piece: Piece) -> bool:
    """Whether the name of its file says that a shape stands for its convex hull."""
    return any(_MADE_CONVEX.search(path.stem) for path in piece.files)


def hulls_of(pieces: list[Piece]) -> tuple[tuple[Points, ...], str]:
    """Points of the convex shapes that collision `pieces` consist of, and a note; no shapes where one is not convex."""
    import trimesh

    found: list[Points] = []
    for piece in pieces:
        meant = meant_as_hull(piece)
        whole = trimesh.Trimesh(piece.vertices, piece.faces, process=True)
        for part in whole.split(only_watertight=False):
            points = np.asarray(part.vertices, dtype=np.float64)
            try:
                hull = convex_part(points)
            except AssetError:
                continue
            filled = abs(signed_volume(points, np.asarray(part.faces))) / signed_volume(hull.vertices, hull.faces)
            if not meant and (filled < CONVEX or not part.is_watertight):
                return (), f"a collision mesh is not convex, {FROM_PICTURE}"
            found.append(hull.vertices)
        if len(found) > MAX_HULLS:
            return (), f"more than {MAX_HULLS} collision shapes, {FROM_PICTURE}"
    return tuple(found), ""
