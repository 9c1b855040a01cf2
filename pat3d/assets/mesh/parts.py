"""Convex parts of a mesh: one box, one hull, or CoACD's decomposition, finer until a cavity stays open."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from pat3d.assets.mesh.cavity import cavity_loss
from pat3d.assets.mesh.cover import cover, surface_patches, surface_points
from pat3d.assets.mesh.decompose import DEFAULT_OPTIONS, decompose
from pat3d.assets.mesh.reduce import inflation
from pat3d.assets.mesh.regions import cavity, mesh_height_map
from pat3d.assets.mesh.repair import Repaired, Solid, manifold_of, solid_of
from pat3d.assets.mesh.split import allowed, fitted
from pat3d.assets.mesh.topology import signed_volume
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.planes import planes
from pat3d.progress import CpuBudget
from pat3d.scene.cache import cache_root, content_key, load_points, load_record, store_points

PartsMethod = Literal["coacd", "hull", "box"]

THRESHOLD = 0.05
"""CoACD's concavity threshold for objects without a cavity."""

CAVITY_THRESHOLDS = (0.03, 0.02, 0.012)
"""Thresholds for objects with a cavity, tried in turn until the parts leave it open."""

MAX_CAVITY_LOSS = 0.02
"""Median fraction of a cavity's radius that its parts may take."""

MAX_PIECES = 24
MAX_SOLID_FACES = 20_000
"""What is cut into pieces has no more; CoACD's time grows with them."""

MAX_CAVITY_FACES = 4_000
"""The same for objects with a cavity, which are cut more finely; a scanned bowl of 40,000 takes many minutes."""

NEARLY_CONVEX = 0.93
"""A piece that fills this fraction of its convex hull, and has no dent deeper than MAX_DENT, is one part."""

MAX_DENT = 0.11
"""Depth below the convex hull as a fraction of the object's longest side; 0.02 for objects with a cavity."""

LEAST_SECONDS = 1.0
"""[s]; what a decomposition gets at least, so that one that is known is still found."""

_VERSION = 4


@dataclass(frozen=True, kw_only=True, eq=False)
class Parts:
    """Convex parts and how they came about."""

    parts: list[ConvexPart]
    record: dict[str, Any]
    """How they were made, for the provenance."""


def make_parts(
    fixed: Repaired,
    method: PartsMethod,
    cache_dir: str | os.PathLike[str] | None,
    timeout: float,
    budget: CpuBudget,
) -> Parts:
    """The parts of a mesh, those that an earlier run made read from the cache.

    Args:
        fixed: the mesh, repaired, in metres.
        method: "coacd", "hull" or "box".
        cache_dir: see `cache_root`.
        timeout: [s] of the clock for all pieces at all thresholds.
        budget: of the processor.

    Raises:
        AssetError: time is up, or CoACD fails.
    """
    start = time.monotonic()
    patches, triangles = surface_patches(fixed.vertices, fixed.faces)
    points = np.concatenate([patches, fixed.solid.vertices])
    low, high = points.min(axis=0), points.max(axis=0)
    if method == "box":
        box = convex_part(
            np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
        )
        return Parts(parts=[box], record={})
    if method == "hull":
        parts, _, after = cover([points], points)
        return Parts(parts=parts, record=_record(parts, [points], after, start))
    key = content_key(
        {"vertices": fixed.vertices, "faces": fixed.faces, "solid": fixed.solid.vertices},
        {**DEFAULT_OPTIONS, "thresholds": [THRESHOLD, *CAVITY_THRESHOLDS], "format": _VERSION},
    )
    path = cache_root(cache_dir) / "parts" / f"{key}.npz"
    stored = load_points(path)
    if stored is not None:
        return Parts(parts=[convex_part(hull) for hull in stored], record={**load_record(path), "cached": True})
    # A budget for all pieces at all thresholds: a soup of triangles has dozens, and each could take all of it.
    ends = start + timeout
    limit = allowed(float(np.ptp(points, axis=0).max()))
    pit = cavity(mesh_height_map(fixed.solid.vertices, fixed.solid.faces))
    parts: list[ConvexPart] = []
    record: dict[str, Any] = {}
    for threshold in CAVITY_THRESHOLDS if pit else (THRESHOLD,):
        pieces, options = _decomposed(fixed, threshold, pit is not None, cache_dir, ends, budget)
        hulls = [half for piece in pieces for half in fitted(piece, limit)] if len(pieces) <= MAX_PIECES else pieces
        parts, before, after = cover(hulls, points, triangles)
        record = {"options": options, "stuck_out": before, **_record(parts, hulls, after, start)}
        if pit is None or len(parts) > 150:
            break
        loss = float(np.median(cavity_loss(fixed.solid.vertices, fixed.solid.faces, parts, pit)))
        record["cavity_loss"] = loss
        if loss <= MAX_CAVITY_LOSS or not options:
            break
    store_points(path, [part.vertices for part in parts], record)
    return Parts(parts=parts, record=record)


def covering_parts(fixed: Repaired, hulls: Sequence[NDArray[np.float64]]) -> Parts:
    """Parts that others made, points [m] of each of shape (n, 3), grown until they contain the mesh."""
    start = time.monotonic()
    points, triangles = surface_patches(fixed.vertices, fixed.faces)
    parts, before, after = cover(list(hulls), points, triangles)
    return Parts(parts=parts, record={"stuck_out": before, **_record(parts, list(hulls), after, start)})


def _decomposed(
    fixed: Repaired,
    threshold: float,
    hollow: bool,
    cache_dir: str | os.PathLike[str] | None,
    ends: float,
    budget: CpuBudget,
) -> tuple[list[NDArray[np.float64]], dict[str, Any]]:
    """Convex hulls of all pieces by time `ends` [s] of the clock, and CoACD's options where it was needed."""
    pieces = fixed.pieces if len(fixed.pieces) <= MAX_PIECES else (fixed.solid,)
    whole = float(np.ptp(fixed.solid.vertices, axis=0).max())
    hulls: list[NDArray[np.float64]] = []
    options: dict[str, Any] = {}
    dent, limit = (0.02, MAX_CAVITY_FACES) if hollow else (MAX_DENT, MAX_SOLID_FACES)
    for piece in pieces:
        hull = convex_part(piece.vertices)
        if _nearly_convex(piece, hull, dent * whole):
            hulls.append(hull.vertices)
            continue
        piece = _simplified(piece, limit)
        # CoACD measures concavity relative to each piece; the same tolerance in metres holds for all.
        relative = min(0.5, threshold * whole / float(np.ptp(piece.vertices, axis=0).max()))
        done = decompose(
            piece.vertices,
            piece.faces.astype(np.int32),
            timeout=max(ends - time.monotonic(), LEAST_SECONDS),
            cpu_limit=budget.left,
            cache_dir=cache_dir,
            threshold=round(relative, 6),
        )
        options = {**done.options, "threshold": threshold}
        hulls += [_snapped(part, piece, fixed.solid) for part in done.parts]
    return hulls, options


def _nearly_convex(piece: Solid, hull: ConvexPart, dent: float) -> bool:
    """Whether the piece fills its hull but for dents shallower than `dent` [m], such as the lid of a can."""
    filled = signed_volume(piece.vertices, piece.faces) / signed_volume(hull.vertices, hull.faces)
    if filled < NEARLY_CONVEX:
        return False
    points = surface_points(piece.vertices, piece.faces)
    sides = planes(hull)
    depth = max(
        float(-(points[k : k + 20_000] @ sides[:, :3].T + sides[:, 3]).max(axis=1).min())
        for k in range(0, len(points), 20_000)
    )
    return depth < dent


def _snapped(part: NDArray[np.float64], piece: Solid, solid: Solid) -> NDArray[np.float64]:
    """Points of a part moved onto the vertices and the base that they stand for: CoACD rounds them."""
    tolerance = 2e-5 * float(np.ptp(solid.vertices, axis=0).max())
    distance, index = KDTree(piece.vertices).query(part, distance_upper_bound=tolerance)
    part = part.copy()
    near = np.isfinite(distance)
    part[near] = piece.vertices[np.asarray(index)[near]]
    for level in (float(solid.vertices[:, 2].min()), float(solid.vertices[:, 2].max())):
        part[np.abs(part[:, 2] - level) < tolerance, 2] = level
    return part


def _simplified(piece: Solid, limit: int) -> Solid:
    """The piece with at most about `limit` faces."""
    if len(piece.faces) <= limit:
        return piece
    solid = manifold_of(piece.vertices, piece.faces)
    if solid is None:
        return piece
    tolerance = 1e-5 * float(np.ptp(piece.vertices, axis=0).max())
    while solid.num_tri() > limit and tolerance < 0.02 * float(np.ptp(piece.vertices, axis=0).max()):
        simpler = solid.simplify(tolerance)
        if simpler.is_empty():
            break
        solid, tolerance = simpler, 1.4 * tolerance
    return solid_of(solid)


def _record(parts: list[ConvexPart], hulls: list[NDArray[np.float64]], after: float, start: float) -> dict[str, Any]:
    """What the provenance says about parts; lengths in metres."""
    record: dict[str, Any] = {
        "count": len(parts),
        "vertices": int(max(len(part.vertices) for part in parts)),
        "faces": int(max(len(part.faces) for part in parts)),
        "sticks_out": after,
        "seconds": round(time.monotonic() - start, 3),
    }
    grown = [inflation(part, hull) for part, hull in zip(parts, hulls, strict=True)]
    record["inflation"] = max(item.distance for item in grown)
    record["inflation_volume"] = float(np.mean([item.volume for item in grown]))
    return record
