"""A body of a description as an asset: its own convex parts, mass, inertia, friction and look."""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.catalogue import lookup
from pat3d.assets.library.body import Body, Inertial
from pat3d.assets.library.names import known_names, synonyms_of, words_of
from pat3d.assets.library.readers.collision import FROM_PICTURE
from pat3d.assets.library.readers.inertials import fault
from pat3d.assets.materials import material as find_material
from pat3d.assets.mesh.cover import outside, surface_points
from pat3d.assets.mesh.regions import find_regions
from pat3d.assets.mesh.repair import repair
from pat3d.assets.mesh.topology import signed_volume
from pat3d.check.foreign.shapes import DENSITY
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import MassProperties, mass_properties
from pat3d.importers.colliders import Colliders, convex_parts
from pat3d.progress import CpuBudget
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.physics import HEAVIEST, LIGHTEST

AT_BASE = 1e-6
"""An origin this far from the height of the base [m] is on it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ImportedAsset:
    """An asset, and where its frame is in that of the body that it came from."""

    asset: Asset
    origin: NDArray[np.float64]
    """[m], shape (3,); the axes are the same."""
    notes: tuple[str, ...] = ()
    """What was changed, left out or assumed."""


def asset_of(
    body: Body,
    name: str,
    *,
    format: str,
    file: str,
    cache_dir: str | os.PathLike[str] | None = None,
    budget: CpuBudget | None = None,
) -> ImportedAsset:
    """The asset of a body in metres with z up.

    The frame is the body's where its origin is at the height of its base and above it, else at the middle of the base.

    Args:
        body: shapes, mass, friction.
        name: of the object.
        format: that it came from.
        file: its name, for the provenance.
        cache_dir: where decompositions are kept.
        budget: of the processor; None for any.

    Raises:
        AssetError: nothing collides, or no matter can have its mass properties.
    """
    # Shapes that are not convex are cut themselves here, whatever the picture is.
    notes = [note for note in body.notes if not note.endswith(FROM_PICTURE)]
    found: Colliders = convex_parts(body.touched, cache_dir=cache_dir, budget=budget)
    notes += found.notes
    low = np.min([part.bounds[0] for part in found.parts], axis=0)
    high = np.max([part.bounds[1] for part in found.parts], axis=0)
    based = abs(low[2]) < AT_BASE and (low[:2] <= 0.0).all() and (high[:2] >= 0.0).all()
    origin = np.zeros(3) if based else np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    parts = tuple(_moved(part, -origin) for part in found.parts)
    visual, volume, told = _picture(body, origin, parts)
    notes += told
    noun, like = _noun(name)
    made_of = find_material(like.material if like else "plastic")
    properties, source, wrong = _weighed(body, origin, visual, volume, parts)
    notes += [f"its inertia was replaced by that of a uniform body: {wrong}"] if wrong else []
    notes += [] if source != "assumed" else [f"no mass is said: {DENSITY:g} kg/m^3 was taken"]
    if not LIGHTEST <= properties.mass <= HEAVIEST:
        raise AssetError(
            f"its mass is {properties.mass:.3g} kg; {LIGHTEST:g} to {HEAVIEST:g} kg can be simulated and verified."
        )
    surface = {key: round(value, 6) for key, value in body.mesh.surface.items()}
    asset = Asset(
        noun=noun,
        visual=visual,
        parts=parts,
        mass_properties=properties,
        material=replace(
            made_of,
            density=properties.mass / properties.volume,
            friction=made_of.friction if body.friction is None else body.friction,
        ),
        regions=find_regions(parts),
        provenance={
            "source": "import",
            "format": format,
            "file": file,
            "body": body.name,
            "mass_from": source,
            "friction_from": format if body.friction is not None else f"{made_of.name}, a guess",
            "parts": {"method": "given", "count": len(parts), "kept": found.kept, "cut": found.cut},
            "notes": notes,
            **({"surface": surface} if surface else {}),
        },
    )
    return ImportedAsset(asset=asset, origin=origin, notes=tuple(notes))


def content_of(body: Body) -> str:
    """A fingerprint of everything about a body but its name and its place."""
    made = hashlib.sha256()
    given = body.inertial
    arrays = [body.mesh.vertices, body.mesh.faces, body.mesh.uv, body.mesh.texture]
    arrays += [body.mesh.maps[name] for name in sorted(body.mesh.maps)]
    arrays += [array for piece in body.touched for array in (piece.vertices, piece.faces)]
    arrays += (
        [] if given is None else [np.array(given.mass), *(x for x in (given.centre, given.inertia) if x is not None)]
    )
    for array in arrays:
        made.update(repr(array.shape).encode())
        if array.dtype.kind == "f":
            # Two things of one mesh differ by the rounding of their places in the world.
            size = float(np.abs(array).max(initial=0.0)) or 1.0
            made.update(f"{size:.8e}".encode())
            array = np.round(array / size, 9) + 0.0
        made.update(np.ascontiguousarray(array).tobytes())
    made.update(repr((body.friction, sorted(body.mesh.surface.items()))).encode())
    return made.hexdigest()


def _moved(part: ConvexPart, offset: NDArray[np.float64]) -> ConvexPart:
    if not offset.any():
        return part
    box = part.box and (tuple(map(float, np.array(part.box[0]) + offset)), *part.box[1:])
    return replace(part, vertices=part.vertices + offset, box=box)


def _noun(name: str) -> tuple[str, Any]:
    """Noun of an asset, and the catalogue's entry that it is a kind of."""
    known = known_names()
    words = words_of(name)
    like = synonyms_of(words, (), known)[2] if words else ""
    return (" ".join(words) or "object"), (lookup.find(like) if like else None)


def _picture(
    body: Body, origin: NDArray[np.float64], parts: tuple[ConvexPart, ...]
) -> tuple[VisualMesh, float, list[str]]:
    """What is seen, its volume [m^3], and notes."""
    notes: list[str] = []
    vertices = body.mesh.vertices - origin
    try:
        fixed = repair(vertices, body.mesh.faces)
        notes += fixed.repairs
        volume = signed_volume(fixed.solid.vertices, fixed.solid.faces)
        visual = VisualMesh(
            vertices=fixed.vertices,
            faces=np.ascontiguousarray(fixed.faces, dtype=np.int32),
            uv=np.ascontiguousarray(body.mesh.uv.reshape(-1, 2)[fixed.corners]),
            texture=body.mesh.texture,
            maps=body.mesh.maps,
        )
    except AssetError as error:
        notes.append(f"its picture bounds no solid ({error})")
        volume = sum(signed_volume(part.vertices, part.faces) for part in parts)
        visual = VisualMesh(
            vertices=np.ascontiguousarray(vertices),
            faces=np.ascontiguousarray(body.mesh.faces, dtype=np.int32),
            uv=np.ascontiguousarray(body.mesh.uv),
            texture=body.mesh.texture,
            maps=body.mesh.maps,
        )
    beyond = float(outside(surface_points(visual.vertices, visual.faces), list(parts))[0].max(initial=0.0))
    if beyond > 1e-3:
        notes.append(f"its picture reaches {1e3 * beyond:.3g} mm beyond its collision shapes")
    return visual, float(volume), notes


def _weighed(
    body: Body,
    origin: NDArray[np.float64],
    visual: VisualMesh,
    volume: float,
    parts: tuple[ConvexPart, ...],
) -> tuple[MassProperties, str, str]:
    """Mass properties in the frame of the asset, what says them, and what was wrong with the inertia."""
    given = body.inertial
    low = np.min([*(part.bounds[0] for part in parts), visual.bounds[0]], axis=0)
    high = np.max([*(part.bounds[1] for part in parts), visual.bounds[1]], axis=0)
    if given is not None and given.centre is not None and given.inertia is not None:
        centre = given.centre - origin
        wrong = fault(Inertial(mass=given.mass, centre=centre, inertia=given.inertia), low, high)
        if not wrong:
            tensor = (given.inertia + given.inertia.T) / 2
            properties = MassProperties(
                mass=given.mass,
                volume=volume,
                centre_of_mass=tuple(map(float, centre)),  # type: ignore[arg-type]
                inertia=tuple(tuple(map(float, row)) for row in tensor),  # type: ignore[arg-type]
            )
            return properties, body.declared, ""
        return _uniform(parts, volume, given.mass), body.declared, wrong
    if given is not None:
        return _uniform(parts, volume, given.mass), body.declared, "the file gives a mass alone"
    return _uniform(parts, volume, DENSITY * volume), "assumed", ""


def _uniform(parts: tuple[ConvexPart, ...], volume: float, mass: float) -> MassProperties:
    """Of a mass that is spread evenly over convex parts, which may overlap."""
    single = [mass_properties(part.vertices, part.faces, density=1.0) for part in parts]
    total = sum(one.mass for one in single)
    centre = sum((one.mass * np.array(one.centre_of_mass) for one in single), np.zeros(3)) / total
    tensor = np.zeros((3, 3))
    for one in single:
        offset = np.array(one.centre_of_mass) - centre
        tensor += np.array(one.inertia) + one.mass * (float(offset @ offset) * np.eye(3) - np.outer(offset, offset))
    return MassProperties(
        mass=mass,
        volume=volume,
        centre_of_mass=tuple(map(float, centre)),  # type: ignore[arg-type]
        inertia=tuple(tuple(map(float, row)) for row in tensor * mass / total),  # type: ignore[arg-type]
    )
