"""A coarser level of detail of what is seen: fewer triangles, every corner left where it was, with its texture.

Edges are collapsed by manifold3d while the surface moves by less than a tolerance; the smallest tolerance that meets
the budget is looked for. Corners are those of the original, so convex parts that contain it contain the coarser one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import AssetError
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.model import Scene

FINEST, COARSEST = 1e-6, 0.02
"""Tolerances that are tried, in longest sides."""

STEPS = 12
"""Halvings of the range of tolerances, in proportion: the one that is found is within 0.3 % of the smallest."""

LEAST = 12
"""Triangles that anything keeps: those of a box."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Simplified:
    """A coarser mesh."""

    visual: VisualMesh
    moved: float
    """How far the surface has moved, at most [m]; 0 where nothing was to be done."""


def simplify(visual: VisualMesh, triangles: int) -> Simplified:
    """`visual` with at most `triangles`, or as few as COARSEST allows.

    Raises:
        AssetError: fewer than LEAST are asked for, or the surface is not closed.
    """
    if triangles < LEAST:
        raise AssetError(f"a level of detail needs {LEAST} triangles or more, not {triangles}.")
    if len(visual.faces) <= triangles:
        return Simplified(visual=visual, moved=0.0)
    corners = _Corners.of(visual)
    solid = corners.solid()
    size = float(np.ptp(visual.bounds, axis=0).max())
    low, high = np.log(FINEST * size), np.log(COARSEST * size)
    best, moved = solid.simplify(float(np.exp(high))), float(np.exp(high))
    if best.num_tri() <= triangles:
        for _ in range(STEPS):
            middle = (low + high) / 2
            made = solid.simplify(float(np.exp(middle)))
            if made.num_tri() <= triangles:
                best, moved, high = made, float(np.exp(middle)), middle
            else:
                low = middle
    return Simplified(visual=corners.visual(best.to_mesh64(), visual), moved=moved)


def within_budget(scene: Scene, triangles: int) -> tuple[Scene, tuple[str, ...]]:
    """`scene` with no more than `triangles` in what is seen of any object, and a note on each that was coarser made.

    Raises:
        AssetError: as for `simplify`, but for surfaces that are not closed, which stay as they are, with a note.
    """
    made: dict[int, tuple[Asset, str]] = {}
    for obj in scene.objects:
        if id(obj.asset) not in made:
            made[id(obj.asset)] = coarser(obj.asset, triangles, obj.name)
    objects = tuple(replace(obj, asset=made[id(obj.asset)][0]) for obj in scene.objects)
    return replace(scene, objects=objects), tuple(note for _, note in made.values() if note)


def coarser(asset: Asset, triangles: int, name: str) -> tuple[Asset, str]:
    """`asset` seen with no more than `triangles`, and a note that says what became of it; empty where nothing did."""
    before = len(asset.visual.faces)
    if triangles >= LEAST >= before or before <= triangles:
        return asset, ""
    try:
        found = simplify(asset.visual, triangles)
    except AssetError as error:
        if triangles < LEAST:
            raise
        return asset, f'"{name}" keeps its {before:,} triangles: {error}'
    after = len(found.visual.faces)
    note = f'"{name}": {after:,} of {before:,} triangles, at most {1e3 * found.moved:.2g} mm off'
    note += f"; fewer would be more than {100 * COARSEST:g} % of its size off" if after > triangles else ""
    notes = [*asset.provenance.get("notes", []), note]
    return replace(asset, visual=found.visual, provenance=_told(asset.provenance, notes)), note


def _told(provenance: Mapping[str, Any], notes: list[str]) -> dict[str, Any]:
    return {**provenance, "notes": notes}


@dataclass(frozen=True, kw_only=True, eq=False)
class _Corners:
    """The different corners of a mesh's faces: places with texture coordinates, by islands of the texture."""

    points: NDArray[np.float64]
    """x, y, z, u, v, shape (corners, 5)."""
    triangles: NDArray[np.int64]
    """By island, shape (faces, 3)."""
    place: NDArray[np.int64]
    """Number of the place of every corner."""
    island: NDArray[np.int64]
    """Number of the island of every corner; faces share an island where they share corners."""

    @staticmethod
    def of(visual: VisualMesh) -> _Corners:
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        every = np.concatenate([visual.vertices[visual.faces], visual.uv], axis=2).reshape(-1, 5)
        points, numbers = np.unique(every, axis=0, return_inverse=True)
        triangles = numbers.reshape(-1, 3)
        ends = triangles[:, [0, 1, 1, 2]].reshape(-1, 2)
        links = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(points), len(points)))
        island = connected_components(links, directed=False)[1].astype(np.int64)
        _, place = np.unique(points[:, :3], axis=0, return_inverse=True)
        order = np.argsort(island[triangles[:, 0]], kind="stable")
        return _Corners(points=points, triangles=triangles[order], place=place.reshape(-1), island=island)

    def solid(self) -> Any:
        """For manifold3d, to which every island is an original of its own, so that it keeps the edges between two."""
        import manifold3d

        count = int(self.island.max()) + 1
        starts = 3 * np.searchsorted(self.island[self.triangles[:, 0]], np.arange(count + 1))
        _, first = np.unique(self.place, return_index=True)
        same = first[self.place]
        merged = np.flatnonzero(same != np.arange(len(same)))
        made = manifold3d.Manifold(
            manifold3d.Mesh64(
                vert_properties=np.ascontiguousarray(self.points),
                tri_verts=np.ascontiguousarray(self.triangles, dtype=np.uint64),
                merge_from_vert=merged.astype(np.uint64),
                merge_to_vert=same[merged].astype(np.uint64),
                run_index=starts.astype(np.uint64),
                run_original_id=np.arange(1, count + 1, dtype=np.uint32),
            )
        )
        if made.status() != manifold3d.Error.NoError:
            raise AssetError(f"its surface is not closed ({made.status().name})")
        return made

    def visual(self, mesh: Any, like: VisualMesh) -> VisualMesh:
        """What manifold3d made of it, with the texture coordinates that each place has in the island of its face.

        At seams manifold3d may give a face the coordinates of the other side.
        """
        points, faces = np.asarray(mesh.vert_properties), np.asarray(mesh.tri_verts, dtype=np.int64)
        lengths = np.diff(np.asarray(mesh.run_index, dtype=np.int64)) // 3
        owner = np.repeat(np.asarray(mesh.run_original_id, dtype=np.int64) - 1, lengths)
        known, index = np.unique(np.concatenate([self.points[:, :3], points[:, :3]]), axis=0, return_inverse=True)
        index = index.reshape(-1)[len(self.points) :]
        count = int(self.island.max()) + 1
        keys = self.place * count + self.island
        order = np.argsort(keys, kind="stable")
        wanted = index[faces] * count + owner[:, None]
        low, high = (np.searchsorted(keys[order], wanted, side=side) for side in ("left", "right"))
        uv = points[faces][:, :, 3:]
        nearest, least = uv.copy(), np.full(wanted.shape, np.inf)
        for step in range(int((high - low).max(initial=0))):
            there = low + step < high
            candidate = self.points[order[np.minimum(low + step, len(order) - 1)], 3:]
            distance = np.where(there, np.linalg.norm(candidate - uv, axis=2), np.inf)
            nearest = np.where((distance < least)[:, :, None], candidate, nearest)
            least = np.minimum(least, distance)
        used, faces = np.unique(index[faces], return_inverse=True)
        return replace(
            like,
            vertices=np.ascontiguousarray(known[used]),
            faces=np.ascontiguousarray(faces.reshape(-1, 3), dtype=np.int32),
            uv=np.ascontiguousarray(nearest),
        )
