"""Collision shapes of a description as convex parts: as they are where they are convex, cut where they are not."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.library.body import Piece
from pat3d.assets.library.readers.collision import CONVEX, meant_as_hull
from pat3d.assets.mesh.parts import Decomposing, make_parts
from pat3d.assets.mesh.repair import repair
from pat3d.assets.mesh.split import allowed, fitted
from pat3d.assets.mesh.topology import signed_volume
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.planes import face_count
from pat3d.progress import CpuBudget

MOST_VERTICES, MOST_FACES = 64, 64
"""Of a convex part that is taken as it is: what PhysX collides on a GPU. Coplanar triangles are one face."""

MOST_PARTS = 400
"""Of one object."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Colliders:
    """Convex parts of one object, and how they came about."""

    parts: tuple[ConvexPart, ...]
    kept: int
    """Parts that are shapes of the file, unchanged."""
    cut: int
    """Shapes that were cut into convex parts, or simplified."""
    notes: tuple[str, ...] = ()


def convex_parts(
    pieces: Sequence[Piece], *, cache_dir: str | os.PathLike[str] | None = None, budget: CpuBudget | None = None
) -> Colliders:
    """Convex parts of collision shapes in metres.

    Args:
        pieces: the shapes.
        cache_dir: where decompositions are kept.
        budget: of the processor; None for any.

    Raises:
        AssetError: no shape spans a volume, or there are too many parts.
    """
    import trimesh

    parts, notes = list[ConvexPart](), list[str]()
    kept = cut = flat = 0
    for piece in pieces:
        whole = trimesh.Trimesh(piece.vertices, piece.faces, process=True)
        lumps = [whole] if whole.is_convex else list(whole.split(only_watertight=False, repair=False))
        # Closed lumps are shapes of their own; open shells bound one only together.
        for lump in lumps if all(lump.is_watertight for lump in lumps) else [whole]:
            points = np.asarray(lump.vertices, dtype=np.float64)
            try:
                hull = convex_part(points)
            except AssetError:
                flat += 1
                continue
            if not (meant_as_hull(piece) or (lump.is_watertight and _fills(points, np.asarray(lump.faces), hull))):
                made, cut = _decomposed(points, np.asarray(lump.faces), cache_dir, budget), cut + 1
            elif len(hull.vertices) <= MOST_VERTICES and face_count(hull) <= MOST_FACES:
                made, kept = [hull], kept + 1
            else:
                limit = allowed(float(np.ptp(points, axis=0).max()))
                made, cut = [one.part for one in fitted([hull.vertices], limit, 16)], cut + 1
            parts += made
        if len(parts) > MOST_PARTS:
            raise AssetError(f"its collision shapes make more than {MOST_PARTS} convex parts; simplify them first.")
    if flat:
        notes.append(f"{flat} collision shapes span no volume and were left out")
    if cut:
        notes.append(f"{cut} of its collision shapes are not convex, or have more than 64 corners or faces: cut anew")
    if not parts:
        raise AssetError("none of its collision shapes spans a volume.")
    return Colliders(parts=tuple(parts), kept=kept, cut=cut, notes=tuple(notes))


def _fills(points: NDArray[np.float64], faces: NDArray[np.int64], hull: ConvexPart) -> bool:
    """Whether a closed mesh fills nearly all of its convex hull."""
    volume = signed_volume(points, faces)
    return abs(volume) >= CONVEX * signed_volume(hull.vertices, hull.faces)


def _decomposed(
    points: NDArray[np.float64],
    faces: NDArray[np.int64],
    cache_dir: str | os.PathLike[str] | None,
    budget: CpuBudget | None,
) -> list[ConvexPart]:
    fixed = repair(points, faces)
    return make_parts(fixed, Decomposing(), cache_dir, budget or CpuBudget()).parts
