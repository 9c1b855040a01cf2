"""The user's own mesh as an asset: `import_mesh("mug.glb", size=0.1, material="ceramic")`."""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.materials import material as find_material
from pat3d.assets.mesh.load import LoadedMesh, UpAxis, files_beside, load_mesh
from pat3d.assets.mesh.parts import (
    DECOMPOSITION_SECONDS,
    MAX_HULLS,
    Decomposing,
    PartsMethod,
    covering_parts,
    make_parts,
)
from pat3d.assets.mesh.regions import find_regions
from pat3d.assets.mesh.repair import repair
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import mass_properties
from pat3d.progress import CpuBudget
from pat3d.scene.asset import Asset, Material, VisualMesh

Units = Literal["m", "cm", "mm", "in"]

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

MOST_IMPORTED = 16

_imported: dict[tuple[str, ...], Asset] = {}
"""The last assets that this process imported, by the files and the arguments they came from."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Placing:
    """From a file's coordinates to the asset frame: turned, moved and stretched, in this order."""

    turn: NDArray[np.float64]
    """Rotation, shape (3, 3)."""
    origin: NDArray[np.float64]
    """What becomes the origin, in the file's units after the turn, shape (3,)."""
    factors: NDArray[np.float64]
    """Along each axis [m per unit], shape (3,)."""

    def apply(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """`points` of the file, shape (n, 3), in the asset frame [m]."""
        return (points @ self.turn.T - self.origin) * self.factors


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
    threshold: float | None = None,
    max_hulls: int = MAX_HULLS,
    decomposition_limit: float = DECOMPOSITION_SECONDS,
    thickness: float | None = None,
    texture_root: str | os.PathLike[str] | None = None,
    cache_dir: str | os.PathLike[str] | None = None,
    cpu_limit: float | None = None,
) -> Asset:
    """Read, repair, weigh and decompose a mesh file.

    The same file with the same arguments is the same asset, whose files a scene and its exports hold once.

    Args:
        path: an OBJ, STL, PLY, OFF, GLB, glTF, COLLADA, FBX or 3MF file.
        name: noun of the asset; the file's stem where None.
        units: unit of the file's coordinates; where None what the file says (COLLADA, FBX, 3MF), else metres.
        scale: further factor on the coordinates.
        size: target size [m] instead of units and scale: the longest side, or (x, y, z) with None for
            sides that follow. One side given scales uniformly, more stretch.
        up: axis of the file that points up; where None what the file says, y for glTF (by its standard), else z.
        density: [kg/m^3] of the closed surface; the material's where neither this nor `mass` is given.
        mass: [kg] of the object.
        material: name of a material, for density and friction.
        friction: Coulomb coefficient [-]; the material's where None.
        parts: how to make convex parts: decomposition, one convex hull, or the bounding box.
        threshold: concavity that a decomposition may leave [-], from 0.01 (fine) to 1; where None 0.05, and for an
            object with a cavity 0.065 or finer until the cavity stays open.
        max_hulls: most convex parts of a decomposition; where a finer one would have more, the coarser one is kept.
        decomposition_limit: processor time for the decomposition [s], however busy the machine is.
        thickness: wall thickness [m] for open shells; see `repair`.
        texture_root: folder that material files may refer into; the mesh's own where None.
        cache_dir: where decompositions are kept; see `cache_root`.
        cpu_limit: [s] of the processor for all of it; None for any.

    Raises:
        AssetError: the file, the mesh or an argument is unusable; the message says why and what would do.
    """
    path = Path(path)
    _check_arguments(units, scale, size, up, density, mass, friction, thickness)
    how = Decomposing(method=parts, threshold=threshold, max_hulls=max_hulls, seconds=decomposition_limit)
    found = find_material(material)
    key = (
        *files_beside(path, texture_root),
        *map(str, (name, units, scale, size, up, density, mass, material, friction, how, thickness, cache_dir)),
    )
    if key in _imported:
        return _imported[key]
    budget = CpuBudget(cpu_limit)
    loaded = load_mesh(path, texture_root=texture_root)
    axis = up or loaded.up or "z"
    try:
        placing = _placing(loaded, axis, units, scale, size)
        made = asset_of(
            loaded,
            placing,
            name=name or path.stem,
            material=found if density is None else replace(found, density=density),
            mass=mass,
            friction=friction,
            parts=how,
            thickness=thickness,
            cache_dir=cache_dir,
            budget=budget,
        )
    except AssetError as error:
        raise AssetError(f'"{path}": {error}') from error
    while len(_imported) >= MOST_IMPORTED:
        del _imported[next(iter(_imported))]
    source = {
        "source": "mesh",
        "file": path.name,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "units": units,
        "scale": [float(factor) for factor in placing.factors],
        "up": axis,
    }
    _imported[key] = replace(made, provenance={**source, **made.provenance})
    return _imported[key]


def asset_of(
    loaded: LoadedMesh,
    placing: Placing,
    *,
    name: str,
    material: Material,
    mass: float | None = None,
    friction: float | None = None,
    parts: Decomposing | Sequence[NDArray[np.float64]] | None = None,
    thickness: float | None = None,
    cache_dir: str | os.PathLike[str] | None = None,
    budget: CpuBudget | None = None,
) -> Asset:
    """Repair, weigh and decompose triangles that have been read, and stand them on z = 0.

    Args:
        loaded: the triangles.
        placing: turns, sizes and centres them.
        name: noun of the asset.
        material: with the density where `mass` is None.
        mass: [kg].
        friction: Coulomb coefficient [-]; the material's where None.
        parts: how to make convex parts; as `Decomposing` says where None; or the points of each [m], of shape (n, 3),
            in the frame that `placing` leads to, which then grow by what the mesh sticks out of them.
        thickness: as for `import_mesh`.
        cache_dir: as for `import_mesh`.
        budget: of the processor; None for any.

    Raises:
        AssetError: the triangles bound no solid, or the decomposition fails.
    """
    fixed = repair(placing.apply(loaded.vertices), loaded.faces, thickness=thickness)
    weighed = material.density if mass is None else None
    properties = mass_properties(fixed.solid.vertices, fixed.solid.faces.astype(np.int32), density=weighed, mass=mass)
    if parts is None or isinstance(parts, Decomposing):
        how = parts or Decomposing()
        method, made = how.method, make_parts(fixed, how, cache_dir, budget or CpuBudget())
    else:
        method, made = "given", covering_parts(fixed, parts)
    # Parts may reach below the mesh by their inflation; what is simulated stands on z = 0.
    drop = min(part.bounds[0, 2] for part in made.parts)
    lift = np.array([0.0, 0.0, -drop if abs(drop) > 1e-12 else 0.0])
    convex = tuple(_moved(part, lift) for part in made.parts)
    centre = np.array(properties.centre_of_mass) + lift
    return Asset(
        noun=name,
        visual=VisualMesh(
            vertices=fixed.vertices + lift,
            faces=np.ascontiguousarray(fixed.faces, dtype=np.int32),
            uv=np.ascontiguousarray(loaded.uv.reshape(-1, 2)[fixed.corners]),
            texture=loaded.texture,
            maps=loaded.maps,
        ),
        parts=convex,
        mass_properties=replace(properties, centre_of_mass=tuple(map(float, centre))),  # type: ignore[arg-type]
        material=replace(
            material,
            density=properties.mass / properties.volume,
            friction=material.friction if friction is None else float(friction),
        ),
        regions=find_regions(convex),
        provenance={
            "notes": list(loaded.notes),
            **({"surface": dict(loaded.surface)} if loaded.surface else {}),
            "watertight": fixed.watertight,
            "repairs": list(fixed.repairs),
            "volume_source": fixed.volume_source,
            "parts": {"method": method, **made.record},
            "lifted": float(lift[2]),
        },
    )


def _moved(part: ConvexPart, offset: NDArray[np.float64]) -> ConvexPart:
    """The part moved by `offset` [m], with what is on the base to rounding exactly there."""
    vertices = part.vertices + offset
    vertices[np.abs(vertices[:, 2]) < 1e-9, 2] = 0.0
    box = part.box and (tuple(float(v) for v in np.array(part.box[0]) + offset), *part.box[1:])
    return replace(part, vertices=vertices, box=box)


def _placing(
    loaded: LoadedMesh,
    axis: str,
    units: str | None,
    scale: float | None,
    size: float | Sequence[float | None] | None,
) -> Placing:
    """How the file's coordinates become those of the asset frame."""
    turn = np.array(TO_Z_UP[axis], dtype=np.float64)
    vertices = loaded.vertices @ turn.T
    used = vertices[np.unique(loaded.faces)]
    low, high = used.min(axis=0), used.max(axis=0)
    extents = high - low
    longest = float(extents.max())
    if not (math.isfinite(longest) and longest > 0.0):
        raise AssetError(f"the mesh has no extent ({longest:g}): all its vertices coincide or overflow.")
    if size is not None:
        factors = _factors(size, extents)
    else:
        unit = METRES[units] if units else loaded.metres or 1.0
        factors = np.full(3, unit * (1.0 if scale is None else scale))
        if units is None and scale is None and not PLAUSIBLE[0] <= unit * longest <= PLAUSIBLE[1]:
            likely = [unit for unit in ("cm", "mm", "in") if PLAUSIBLE[0] <= longest * METRES[unit] <= 2.0]
            hint = f'units="{likely[0]}" would make it {longest * METRES[likely[0]]:.3g} m; ' if likely else ""
            raise AssetError(
                f"the mesh is {longest:.4g} long, which is implausible in metres. {hint}give units "
                f"({', '.join(METRES)}), a scale, or a target size in metres."
            )
    origin = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    return Placing(turn=turn, origin=origin, factors=factors)


def _factors(size: float | Sequence[float | None], extents: NDArray[np.float64]) -> NDArray[np.float64]:
    if isinstance(size, int | float):
        return np.full(3, float(size) / extents.max())
    given = [k for k in range(3) if size[k] is not None]
    if any(extents[k] <= 1e-9 * extents.max() for k in given):
        raise AssetError(f"the mesh is flat along an axis whose size is given ({list(size)} m).")
    ratios = {k: float(size[k]) / float(extents[k]) for k in given}  # type: ignore[arg-type]
    rest = math.prod(ratios.values()) ** (1.0 / len(ratios))
    return np.array([ratios.get(k, rest) for k in range(3)])


def _check_arguments(units, scale, size, up, density, mass, friction, thickness) -> None:
    """Refuse argument values before any file is read."""
    if units is not None and units not in METRES:
        raise AssetError(f'unknown units "{units}". Valid: {", ".join(METRES)}.')
    if up is not None and up not in TO_Z_UP:
        raise AssetError(f'unknown up axis "{up}". Valid: {", ".join(TO_Z_UP)}.')
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
