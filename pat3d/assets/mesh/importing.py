"""The user's own mesh as an asset: `import_mesh("mug.glb", size=0.1, material="ceramic")`."""

from __future__ import annotations

import hashlib
import math
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from pat3d.assets.materials import material as find_material
from pat3d.assets.mesh.cavity import cavity_loss
from pat3d.assets.mesh.cover import cover, surface_patches, surface_points
from pat3d.assets.mesh.decompose import DEFAULT_OPTIONS, decompose
from pat3d.assets.mesh.load import LoadedMesh, files_beside, load_mesh
from pat3d.assets.mesh.reduce import inflation
from pat3d.assets.mesh.regions import cavity, find_regions, mesh_height_map
from pat3d.assets.mesh.repair import Repaired, Solid, manifold_of, repair, solid_of
from pat3d.assets.mesh.split import allowed, fitted
from pat3d.assets.mesh.topology import signed_volume
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.planes import planes
from pat3d.progress import CpuBudget
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.cache import cache_root, content_key, load_points, load_record, store_points

Units = Literal["m", "cm", "mm", "in"]
UpAxis = Literal["x", "-x", "y", "-y", "z", "-z"]
PartsMethod = Literal["coacd", "hull", "box"]

METRES: dict[str, float] = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254}

PLAUSIBLE = (0.001, 20.0)
"""Longest side [m] of a mesh whose units nobody gave."""

TO_Z_UP: dict[str, tuple[tuple[int, int, int], ...]] = {
    "z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "-z": ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
    "y": ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "-y": ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
    "x": ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
    "-x": ((0, 0, 1), (0, 1, 0), (-1, 0, 0)),
}
"""Rotations that turn each axis up; from y up, +z (glTF's front) becomes -y (ours)."""

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

PATIENCE = 20.0
"""Where there is a limit of processor time it decides, on a busy machine too: the clock only ends what has hung, after
so many times the limit."""

LEAST_SECONDS = 1.0
"""[s]; what a decomposition gets at least, so that one that is known is still found."""

_VERSION = 4


MOST_IMPORTED = 16

_imported: dict[tuple[str, ...], Asset] = {}
"""The last assets that this process imported, by the files and the arguments they came from."""


def import_mesh(
    path: str | os.PathLike[str],
    *,
    name: str | None = None,
    units: Units | None = None,
    scale: float | None = None,
    size: float | Sequence[float | None] | None = None,
    up: UpAxis | None = None,
    density: float | None = None,
    mass: float | None = None,
    material: str = "plastic",
    friction: float | None = None,
    parts: PartsMethod = "coacd",
    thickness: float | None = None,
    texture_root: str | os.PathLike[str] | None = None,
    cache_dir: str | os.PathLike[str] | None = None,
    timeout: float = 120.0,
    cpu_limit: float | None = None,
) -> Asset:
    """Read, repair, weigh and decompose a mesh file.

    Args:
        path: an OBJ, STL, PLY, OFF, GLB or glTF file.
        name: noun of the asset; the file's stem where None.
        units: unit of the file's coordinates; metres where None.
        scale: further factor on the coordinates.
        size: target size [m] instead of units and scale: the longest side, or (x, y, z) with None for
            sides that follow. One side given scales uniformly, more stretch.
        up: axis of the file that points up; y for glTF (by its standard) and z otherwise where None.
        density: [kg/m^3] of the closed surface; the material's where neither this nor `mass` is given.
        mass: [kg] of the object.
        material: name of a material, for density and friction.
        friction: Coulomb coefficient [-]; the material's where None.
        parts: how to make convex parts: decomposition, one convex hull, or the bounding box.
        thickness: wall thickness [m] for open shells; see `repair`.
        texture_root: folder that material files may refer into; the mesh's own where None.
        cache_dir: where decompositions are kept; see `cache_root`.
        timeout: [s] for the convex decomposition of all pieces.
        cpu_limit: [s] of the processor for all of it; None for any.

    Raises:
        AssetError: the file, the mesh or an argument is unusable; the message says why and what would do.
    """
    path = Path(path)
    _check_arguments(units, scale, size, up, density, mass, friction, parts, thickness)
    found = find_material(material)
    key = (
        *files_beside(path, texture_root),
        *map(str, (name, units, scale, size, up, density, mass, material, friction, parts, thickness, cache_dir)),
    )
    if key in _imported:
        # A copy, since objects that share an asset share its files.
        return replace(_imported[key])
    budget = CpuBudget(cpu_limit)
    timeout = timeout if cpu_limit is None else max(timeout, PATIENCE * cpu_limit)
    loaded = load_mesh(path, texture_root=texture_root)
    axis = up or ("y" if path.suffix.lower() in (".glb", ".gltf") else "z")
    try:
        placed, factors = _placed(loaded, axis, units, scale, size)
        fixed = repair(placed, loaded.faces, thickness=thickness)
        weighed = (density or found.density) if mass is None else None
        properties = mass_properties(
            fixed.solid.vertices, fixed.solid.faces.astype(np.int32), density=weighed, mass=mass
        )
        made = _make_parts(fixed, parts, cache_dir, timeout, budget)
    except AssetError as error:
        raise AssetError(f'"{path}": {error}') from error
    # Parts may reach below the mesh by their inflation; what is simulated stands on z = 0.
    drop = min(part.bounds[0, 2] for part in made.parts)
    lift = np.array([0.0, 0.0, -drop if abs(drop) > 1e-12 else 0.0])
    convex = tuple(_moved(part, lift) for part in made.parts)
    centre = np.array(properties.centre_of_mass) + lift
    uv = loaded.uv.reshape(-1, 2)[fixed.corners]
    used_scale = [float(factor) for factor in factors]
    while len(_imported) >= MOST_IMPORTED:
        del _imported[next(iter(_imported))]
    _imported[key] = Asset(
        noun=name or path.stem,
        visual=VisualMesh(
            vertices=fixed.vertices + lift,
            faces=np.ascontiguousarray(fixed.faces, dtype=np.int32),
            uv=np.ascontiguousarray(uv),
            texture=loaded.texture,
        ),
        parts=convex,
        mass_properties=replace(properties, centre_of_mass=tuple(map(float, centre))),  # type: ignore[arg-type]
        material=replace(
            found,
            density=properties.mass / properties.volume,
            friction=found.friction if friction is None else float(friction),
        ),
        regions=find_regions(convex),
        provenance={
            "source": "mesh",
            "file": path.name,
            "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
            "units": units,
            "scale": used_scale,
            "up": axis,
            "notes": list(loaded.notes),
            "watertight": fixed.watertight,
            "repairs": list(fixed.repairs),
            "volume_source": fixed.volume_source,
            "parts": {"method": parts, **made.record},
            "lifted": float(lift[2]),
        },
    )
    return replace(_imported[key])


@dataclass(frozen=True, kw_only=True, eq=False)
class _Parts:
    parts: list[ConvexPart]
    record: dict[str, Any]
    """How they were made, for the provenance."""


def _make_parts(
    fixed: Repaired,
    method: PartsMethod,
    cache_dir: str | os.PathLike[str] | None,
    timeout: float,
    budget: CpuBudget,
) -> _Parts:
    start = time.monotonic()
    patches, triangles = surface_patches(fixed.vertices, fixed.faces)
    points = np.concatenate([patches, fixed.solid.vertices])
    low, high = points.min(axis=0), points.max(axis=0)
    if method == "box":
        box = convex_part(
            np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
        )
        return _Parts(parts=[box], record={})
    if method == "hull":
        parts, _, after = cover([points], points)
        return _Parts(parts=parts, record=_record(parts, [points], after, start))
    key = content_key(
        {"vertices": fixed.vertices, "faces": fixed.faces, "solid": fixed.solid.vertices},
        {**DEFAULT_OPTIONS, "thresholds": [THRESHOLD, *CAVITY_THRESHOLDS], "format": _VERSION},
    )
    path = cache_root(cache_dir) / "parts" / f"{key}.npz"
    stored = load_points(path)
    if stored is not None:
        return _Parts(parts=[convex_part(hull) for hull in stored], record={**load_record(path), "cached": True})
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
    return _Parts(parts=parts, record=record)


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


def _moved(part: ConvexPart, offset: NDArray[np.float64]) -> ConvexPart:
    """The part moved by `offset` [m], with what is on the base to rounding exactly there."""
    vertices = part.vertices + offset
    vertices[np.abs(vertices[:, 2]) < 1e-9, 2] = 0.0
    box = part.box and (tuple(float(v) for v in np.array(part.box[0]) + offset), *part.box[1:])
    return replace(part, vertices=vertices, box=box)


def _placed(
    loaded: LoadedMesh,
    axis: str,
    units: str | None,
    scale: float | None,
    size: float | Sequence[float | None] | None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Vertices in the asset frame [m], and the factor applied along each of its axes."""
    vertices = loaded.vertices @ np.array(TO_Z_UP[axis], dtype=np.float64).T
    used = vertices[np.unique(loaded.faces)]
    low, high = used.min(axis=0), used.max(axis=0)
    extents = high - low
    longest = float(extents.max())
    if not (math.isfinite(longest) and longest > 0.0):
        raise AssetError(f"the mesh has no extent ({longest:g}): all its vertices coincide or overflow.")
    if size is not None:
        factors = _factors(size, extents)
    else:
        factors = np.full(3, METRES[units or "m"] * (1.0 if scale is None else scale))
        if units is None and scale is None and not PLAUSIBLE[0] <= longest <= PLAUSIBLE[1]:
            likely = [unit for unit in ("cm", "mm", "in") if PLAUSIBLE[0] <= longest * METRES[unit] <= 2.0]
            hint = f'units="{likely[0]}" would make it {longest * METRES[likely[0]]:.3g} m; ' if likely else ""
            raise AssetError(
                f"the mesh is {longest:.4g} long, which is implausible in metres. {hint}give units "
                f"({', '.join(METRES)}), a scale, or a target size in metres."
            )
    origin = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    return (vertices - origin) * factors, factors


def _factors(size: float | Sequence[float | None], extents: NDArray[np.float64]) -> NDArray[np.float64]:
    if isinstance(size, int | float):
        return np.full(3, float(size) / extents.max())
    given = [k for k in range(3) if size[k] is not None]
    if any(extents[k] <= 1e-9 * extents.max() for k in given):
        raise AssetError(f"the mesh is flat along an axis whose size is given ({list(size)} m).")
    ratios = {k: float(size[k]) / float(extents[k]) for k in given}  # type: ignore[arg-type]
    rest = math.prod(ratios.values()) ** (1.0 / len(ratios))
    return np.array([ratios.get(k, rest) for k in range(3)])


def _check_arguments(units, scale, size, up, density, mass, friction, parts, thickness) -> None:
    """Refuse argument values before any file is read."""
    if units is not None and units not in METRES:
        raise AssetError(f'unknown units "{units}". Valid: {", ".join(METRES)}.')
    if up is not None and up not in TO_Z_UP:
        raise AssetError(f'unknown up axis "{up}". Valid: {", ".join(TO_Z_UP)}.')
    if parts not in ("coacd", "hull", "box"):
        raise AssetError(f'unknown method "{parts}" for convex parts. Valid: coacd, hull, box.')
    if size is not None and (units is not None or scale is not None):
        raise AssetError("give a target size, or units and scale, not both.")
    if density is not None and mass is not None:
        raise AssetError("give the density or the mass, not both.")
    positive = {"scale": scale, "density": density, "mass": mass, "thickness": thickness}
    if size is not None and not isinstance(size, int | float):
        if len(size) != 3 or all(side is None for side in size):
            raise AssetError(f"size must be one length or three of which one is given, got {list(size)}.")
        positive |= {f"size[{k}]": side for k, side in enumerate(size)}
    else:
        positive["size"] = size
    for label, value in positive.items():
        if value is not None and not (isinstance(value, int | float) and math.isfinite(value) and value > 0):
            raise AssetError(f"{label} must be a positive number, got {value!r}.")
    if friction is not None and not (isinstance(friction, int | float) and math.isfinite(friction) and friction >= 0):
        raise AssetError(f"friction must not be negative, got {friction!r}.")
