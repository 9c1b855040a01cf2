"""Convex parts of a mesh: one box, one hull, or CoACD's decomposition, finer until a cavity stays open."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from pat3d.assets.mesh.cavity import cavity_loss, probe
from pat3d.assets.mesh.cover import Cover, cover, surface_patches, surface_points
from pat3d.assets.mesh.decompose import DEFAULT_OPTIONS, decompose
from pat3d.assets.mesh.hollow import opened
from pat3d.assets.mesh.inflation import inflation
from pat3d.assets.mesh.regions import cavity, mesh_height_map
from pat3d.assets.mesh.repair import Repaired, Solid, manifold_of, solid_of
from pat3d.assets.mesh.split import Fitted, allowed, fitted
from pat3d.assets.mesh.topology import signed_volume
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.planes import planes
from pat3d.progress import CpuBudget
from pat3d.scene.cache import cache_root, content_key, load_points, load_record, store_points

PartsMethod = Literal["coacd", "hull", "box"]

THRESHOLD = 0.05
"""CoACD's concavity threshold for objects without a cavity."""

CAVITY_THRESHOLDS = (0.065, 0.04, 0.025, 0.015)
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

MAX_HULLS = 80
"""Convex parts of one object, unless its pieces are more."""

ROOM = 7 / 8
"""Share of them that the decomposition may use; the rest is for cutting those that few faces do not fit."""

PASSES = 8
"""Most times that parts which had to grow are cut once more."""

MAX_HULL_CUTS = 16
"""Convex parts that a mesh may have that is to be one hull: 64 faces do not fit a large round one."""

DECOMPOSITION_SECONDS = 120.0
"""Processor time for the decomposition of one mesh [s]."""

PATIENCE = 20.0
"""The clock only ends what has hung, after so many times the processor time: a busy machine refuses nothing more."""

_VERSION = 6


@dataclass(frozen=True, kw_only=True)
class Decomposing:
    """How a mesh is cut into convex parts."""

    method: PartsMethod = "coacd"
    threshold: float | None = None
    """CoACD's concavity [-]; None for 0.05, and for an object with a cavity 0.065 or finer until it stays open."""
    max_hulls: int = MAX_HULLS
    seconds: float = DECOMPOSITION_SECONDS
    """Processor time [s]."""

    def __post_init__(self) -> None:
        if self.method not in ("coacd", "hull", "box"):
            raise AssetError(f'unknown method "{self.method}" for convex parts. Valid: coacd, hull, box.')
        if self.threshold is not None and not 0.01 <= self.threshold <= 1.0:
            raise AssetError(f"the threshold of a decomposition must be from 0.01 to 1, got {self.threshold:g}.")
        if not 1 <= self.max_hulls <= 1000:
            raise AssetError(f"the most convex parts must be from 1 to 1000, got {self.max_hulls}.")
        if not self.seconds > 0:
            raise AssetError(f"the limit of a decomposition must be more than 0 s, got {self.seconds:g}.")
        if self.method != "coacd" and (self.threshold is not None or self.max_hulls != MAX_HULLS):
            raise AssetError(f'a threshold and a limit of hulls are for parts "coacd", not "{self.method}".')


@dataclass(frozen=True, kw_only=True, eq=False)
class Parts:
    """Convex parts and how they came about."""

    parts: list[ConvexPart]
    record: dict[str, Any]
    """How they were made, for the provenance."""


def make_parts(fixed: Repaired, how: Decomposing, cache_dir: str | os.PathLike[str] | None, budget: CpuBudget) -> Parts:
    """The parts of a mesh, those that an earlier run made read from the cache.

    Args:
        fixed: the mesh, repaired, in metres.
        how: method and limits.
        cache_dir: see `cache_root`.
        budget: of the processor, for everything.

    Raises:
        AssetError: time is up, or CoACD fails.
    """
    start = time.monotonic()
    patches, triangles = surface_patches(fixed.vertices, fixed.faces)
    points = np.concatenate([patches, fixed.solid.vertices])
    low, high = points.min(axis=0), points.max(axis=0)
    if how.method == "box":
        box = convex_part(
            np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
        )
        return Parts(parts=[box], record={})
    limit = allowed(float(np.ptp(points, axis=0).max()))
    if how.method == "hull":
        whole = convex_part(points).vertices
        made = _contained([whole], points, None, limit, MAX_HULL_CUTS)
        return Parts(parts=made.parts, record=_record(made, limit, start))
    thresholds: tuple[float, ...] = (THRESHOLD,) if how.threshold is None else (how.threshold,)
    pit = cavity(mesh_height_map(fixed.solid.vertices, fixed.solid.faces))
    if pit is not None and how.threshold is None:
        thresholds = CAVITY_THRESHOLDS
    key = content_key(
        {"vertices": fixed.vertices, "faces": fixed.faces, "solid": fixed.solid.vertices},
        {**DEFAULT_OPTIONS, "thresholds": list(thresholds), "hulls": how.max_hulls, "format": _VERSION},
    )
    path = cache_root(cache_dir) / "parts" / f"{key}.npz"
    stored = load_points(path)
    if stored is not None:
        return Parts(parts=[convex_part(hull) for hull in stored], record={**load_record(path), "cached": True})
    # A budget for all pieces at all thresholds: a soup of triangles has dozens, and each could take all of it.
    own = CpuBudget(how.seconds)
    best: Parts | None = None
    seen = None if pit is None else probe(fixed.solid.vertices, fixed.solid.faces, pit)
    for threshold in thresholds:
        pieces, options = _decomposed(fixed, threshold, pit is not None, cache_dir, (own, budget), how)
        if best is not None and len(pieces) > how.max_hulls:
            break
        if seen is not None:
            pieces = opened(pieces, fixed.solid, seen, int(ROOM * how.max_hulls))
        made = _contained(pieces, points, triangles, limit, how.max_hulls)
        record = {"options": options, "stuck_out": made.before, **_record(made, limit, start)}
        if pit is None:
            best = Parts(parts=made.parts, record=record)
            break
        loss = float(np.median(cavity_loss(fixed.solid.vertices, fixed.solid.faces, made.parts, pit)))
        if best is None or (len(made.parts) <= how.max_hulls and loss < best.record["cavity_loss"]):
            best = Parts(parts=made.parts, record={**record, "cavity_loss": loss})
        if loss <= MAX_CAVITY_LOSS or not options:
            break
    if best is None:
        raise AssetError("no convex parts were found.")
    store_points(path, [part.vertices for part in best.parts], best.record)
    return best


def _contained(
    pieces: list[NDArray[np.float64]],
    points: NDArray[np.float64],
    triangles: NDArray[np.int64] | None,
    limit: float,
    most: int,
) -> Cover:
    """Parts of the pieces that contain `points`, each at most `limit` [m] beyond what it stands for while they are few.

    Where parts had to grow, few faces may not fit them any more; these are cut once again.
    """
    kept: list[Fitted] = []
    wide = pieces
    before: float | None = None
    for _ in range(PASSES):
        done = kept + fitted(wide, limit, most - len(kept))
        made = cover([one.points for one in done], points, triangles, parts=[one.part for one in done])
        before = made.before if before is None else before
        grown = [Fitted(points=hull, part=part) for hull, part in zip(made.hulls, made.parts, strict=True)]
        kept = [one for one in grown if one.excess <= limit]
        wide = [one.points for one in grown if one.excess > limit]
        if not wide or len(grown) >= most:
            break
    return replace(made, before=before)


def covering_parts(fixed: Repaired, hulls: Sequence[NDArray[np.float64]]) -> Parts:
    """Parts that others made, points [m] of each of shape (n, 3), grown until they contain the mesh."""
    start = time.monotonic()
    points, triangles = surface_patches(fixed.vertices, fixed.faces)
    made = cover(list(hulls), points, triangles)
    limit = allowed(float(np.ptp(points, axis=0).max()))
    return Parts(parts=made.parts, record={"stuck_out": made.before, **_record(made, limit, start)})


def _decomposed(
    fixed: Repaired,
    threshold: float,
    hollow: bool,
    cache_dir: str | os.PathLike[str] | None,
    budgets: tuple[CpuBudget, CpuBudget],
    how: Decomposing,
) -> tuple[list[NDArray[np.float64]], dict[str, Any]]:
    """Convex hulls of all pieces within the processor time of both budgets, and CoACD's options where it was needed."""
    pieces = fixed.pieces if len(fixed.pieces) <= MAX_PIECES else (fixed.solid,)
    whole = float(np.ptp(fixed.solid.vertices, axis=0).max())
    hulls: list[NDArray[np.float64]] = []
    options: dict[str, Any] = {}
    dent, limit = (0.02, MAX_CAVITY_FACES) if hollow else (MAX_DENT, MAX_SOLID_FACES)
    dented = []
    for piece in pieces:
        hull = convex_part(piece.vertices)
        if _nearly_convex(piece, hull, dent * whole):
            hulls.append(hull.vertices)
        else:
            dented.append(piece)
    most = max(1, int(ROOM * how.max_hulls - len(hulls)) // max(len(dented), 1))
    for piece in dented:
        piece = _simplified(piece, limit)
        # CoACD measures concavity relative to each piece; the same tolerance in metres holds for all.
        relative = min(0.5, threshold * whole / float(np.ptp(piece.vertices, axis=0).max()))
        left = min(left for left in (one.left for one in budgets) if left is not None)
        done = decompose(
            piece.vertices,
            piece.faces.astype(np.int32),
            timeout=max(PATIENCE * left, LEAST_SECONDS),
            cpu_limit=max(left, LEAST_SECONDS),
            cache_dir=cache_dir,
            threshold=round(relative, 6),
            max_convex_hull=most,
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


def _record(made: Cover, limit: float, start: float) -> dict[str, Any]:
    """What the provenance says about parts; lengths in metres."""
    grown = [inflation(part, hull) for part, hull in zip(made.parts, made.hulls, strict=True)]
    return {
        "count": len(made.parts),
        "vertices": int(max(len(part.vertices) for part in made.parts)),
        "faces": int(max(len(part.faces) for part in made.parts)),
        "sticks_out": made.after,
        "seconds": round(time.monotonic() - start, 3),
        "inflation": max(item.distance for item in grown),
        "inflation_allowed": limit,
        "inflation_volume": float(np.mean([item.volume for item in grown])),
    }
