"""One object of a library: read, sized, turned, weighed, cut into convex parts, its places for things found."""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.catalogue import lookup
from pat3d.assets.library import names
from pat3d.assets.library.body import Body, Points
from pat3d.assets.library.discover import Found
from pat3d.assets.library.guess import (
    SURE,
    Guess,
    Typical,
    axis_of,
    guess_unit,
    longest_side,
    unit_of,
)
from pat3d.assets.library.metadata import Metadata
from pat3d.assets.library.readers.inertials import fault
from pat3d.assets.library.readers.xml import FOLLOWED
from pat3d.assets.library.resting import resting_poses, standing
from pat3d.assets.library.store import Entry, weighed
from pat3d.assets.library.upright import guess_up
from pat3d.assets.materials import material
from pat3d.assets.mesh.cover import outside
from pat3d.assets.mesh.importing import METRES, TO_Z_UP, Placing, asset_of
from pat3d.assets.mesh.parts import Decomposing
from pat3d.assets.rounded import circumscribed
from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import MassProperties
from pat3d.progress import CpuBudget
from pat3d.scene.asset import Asset

LEAST_MASS, MOST_MASS = 1e-4, 1e4
"""[kg]; what lies outside cannot be settled."""

DENSITIES = (15.0, 12_000.0)
"""Effective densities [kg/m^3] between which a mass is believed without a doubt: foam and lead."""

MISSED = 0.05
"""Share of the longest side by which a picture may reach beyond its collision shapes for them to be meant for it."""

LEAST_FILLED, OPEN = 0.01, 0.01
"""A mesh's centre of mass is known where it encloses this share of its bounding box at least, and its area vectors
add up to this share of its area at most."""

STICKS_OUT = 1e-4
"""By how much [m] a picture may stick out of the convex parts."""

SWOLLEN = 0.1
"""Share of the longest side by which convex parts may make an object longer."""


def index_object(
    found: Found,
    key: str,
    *,
    root: Path,
    library: str,
    settings: Mapping[str, Any],
    metadata: Metadata,
    licence: str,
    cache_dir: Path,
    cpu_limit: float,
) -> tuple[Entry, Asset | None]:
    """The entry of one object, and its asset unless it is refused.

    Args:
        found: its files.
        key: of the entry.
        root: folder of the library.
        library: its name.
        settings: what library.yaml says of the object.
        metadata: what the library's files say of it beyond its mesh.
        licence: of the library, where it is known.
        cache_dir: for its convex parts.
        cpu_limit: processor time that the object may take [s].
    """
    begun, spent = time.perf_counter(), sum(os.times()[:4])
    known = names.known_names()
    name, synonyms, like = names.synonyms_of(called(found, metadata), metadata.names, known)
    if "names" in settings:
        said = tuple(each.lower() for each in settings["names"])
        name, synonyms = said[0], tuple(dict.fromkeys((*said[1:], *synonyms)))
        like = next((each for each in (*said, like) if each in known), "")
    # What the reader of sentences knows of kinds it knows by nouns, not by synonyms: a salad bowl is a fruit bowl.
    like = kind.noun if like and (kind := lookup.find(like)) is not None else like
    base = Entry(
        key=key, name=name, synonyms=synonyms, like=like, path=str(found.path.relative_to(root)), kind=found.kind,
        state="refused", settings=dict(settings), metadata=metadata.digest, files=hashes([found.path], root),
    )  # fmt: skip
    if settings.get("skip"):
        return replace(base, state="skipped", reason="library.yaml leaves it out"), None
    try:
        body = _read(found, root)
        asset, facts, doubts = _made(body, found, name, like, settings, metadata, cache_dir, CpuBudget(cpu_limit))
    except AssetError as error:
        return replace(base, reason=str(error), **_took(begun, spent)), None
    except Exception as error:
        # Files that nobody vouches for make parsers raise anything; the rest of the library is to be indexed.
        text = " ".join(str(error).split())[:200]
        reason = f"it cannot be read: {type(error).__name__} {text}"
        return replace(base, reason=reason, **_took(begun, spent)), None
    licence = settings.get("licence") or metadata.licence or names.licence_of(found.path, root) or licence
    facts = {**facts, "licence": licence or "unknown", "others": [str(one.relative_to(root)) for one in found.others]}
    record = {
        "source": "library",
        "library": library,
        "object": key,
        "file": base.path,
        "licence": facts["licence"],
        "settings": dict(settings),
        **{name: facts[name] for name in ("unit", "up", "mass_from", "scale")},
        **asset.provenance,
    }
    record["parts"] = {key: value for key, value in record["parts"].items() if key not in ("seconds", "cached")}
    files = hashes(body.files or (found.path,), root)
    record["sha256"] = hashlib.sha256("".join(files[name] for name in sorted(files)).encode()).hexdigest()
    if like == "" and not metadata.names:
        doubts.append(f'"{name}" is like nothing in the catalogue; give names where people call it otherwise')
    entry = replace(base, state="ready", files=files, facts=facts, doubts=tuple(doubts), **_took(begun, spent))
    return entry, replace(asset, provenance=record)


def _took(begun: float, spent: float) -> dict[str, float]:
    """Time since the clock said `begun`, and the processor `spent` with its children that have ended [s]."""
    return {
        "seconds": round(time.perf_counter() - begun, 3),
        "processor": round(sum(os.times()[:4]) - spent, 3),
    }


def called(found: Found, metadata: Metadata) -> list[str]:
    """Words of an object's name: its own file's or folder's, else its metadata's, else those of a folder of many."""
    titles = [words for title in metadata.names if (words := names.title_words(title))]
    return titles[0] if titles and not found.told else list(found.words)


def hashes(paths: Iterable[Path], root: Path) -> dict[str, str]:
    """SHA-256 of files below `root` that can be read, by relative path."""
    found = {}
    for path in paths:
        try:
            where = str(path.resolve().relative_to(root.resolve()))
            with path.open("rb") as file:
                found[where] = hashlib.file_digest(file, "sha256").hexdigest()
        except (OSError, ValueError):
            continue
    return found


def _read(found: Found, root: Path) -> Body:
    if not found.path.resolve().is_relative_to(root.resolve()):
        raise AssetError(f"it is a link to a file outside the library; {FOLLOWED}")
    if found.kind == "mesh":
        from pat3d.assets.library.readers.meshes import read_mesh as read
    elif found.kind == "mjcf":
        from pat3d.assets.library.readers.mjcf import read_mjcf as read
    elif found.kind == "urdf":
        from pat3d.assets.library.readers.urdf import read_urdf as read
    elif found.kind == "sdf":
        from pat3d.assets.library.readers.sdf import read_sdf as read
    else:
        from pat3d.assets.library.readers.usd import read_usd as read
    return read(found.path, root)


def _made(
    body: Body,
    found: Found,
    name: str,
    like: str,
    settings: Mapping[str, Any],
    metadata: Metadata,
    cache_dir: Path,
    budget: CpuBudget,
) -> tuple[Asset, dict[str, Any], list[str]]:
    typical, doubts = typical_of(like), list[str]()
    unit, metres = _unit(body, typical, settings, metadata)
    up = _up(body, typical, settings, metadata)
    doubts += [
        f"{what} {guess.value}: {guess.reason}; {100 * guess.confidence:.0f} % sure"
        for what, guess in (("unit", unit), ("up", up))
        if guess.confidence < SURE
    ]
    turn = np.array(TO_Z_UP[axis_of(up)], dtype=np.float64)
    used = body.mesh.vertices[np.unique(body.mesh.faces)] @ turn.T * metres
    centre = _centre(body, metres)
    rests = resting_poses(used, centre=None if centre is None else turn @ centre)
    turn, told = (turn, "") if up.source == "given" else standing(turn, rests)
    doubts += [told] if told else []
    used = body.mesh.vertices[np.unique(body.mesh.faces)] @ turn.T
    low, high = used.min(axis=0), used.max(axis=0)
    placing = Placing(
        turn=turn,
        origin=np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]]),
        factors=np.full(3, metres),
    )
    # Descriptions are in metres already; their mass is about the placed frame.
    made_of, guessed = _material(settings, like)
    mass, source = _mass(settings, body, metadata)
    if mass is None and metadata.density is None and guessed:
        doubts.append(f"mass: by the density of {made_of}, which is a guess; give a material or a mass")
    given = [placing.apply(hull) for hull in body.hulls] if body.hulls and "parts" not in settings else None
    make = partial(
        asset_of,
        body.mesh,
        placing,
        name=name,
        material=material(made_of),
        mass=mass,
        friction=settings.get("friction", body.friction),
        cache_dir=cache_dir,
        budget=budget,
    )
    extents = placing.factors * (high - low)
    if given is not None and (gap := _missed(given, placing.apply(body.mesh.vertices[np.unique(body.mesh.faces)]))) > (
        MISSED * extents.max()
    ):
        doubts.append(
            f"collision: the picture reaches {1e3 * gap:.0f} mm beyond the collision shapes, so the convex parts were "
            "made from the picture"
        )
        given = None
    asset = make(parts=given if given is not None else Decomposing(method=settings.get("parts", "coacd")))
    others: tuple[tuple[Decomposing | list[Points], str], ...] = (
        (Decomposing(method="hull"), "one convex hull"),
        ([_wrapped(placing.apply(body.mesh.vertices))], "a plain wrap"),
    )
    for instead, told in others:
        fits = (asset.size <= extents + SWOLLEN * extents.max()).all()
        if fits and (asset.provenance["parts"].get("sticks_out") or 0.0) <= STICKS_OUT:
            break
        asset = make(parts=instead)
        doubts = [one for one in doubts if not one.startswith("collision:")]
        why = "left some of it out" if fits else "came out larger than it is"
        doubts.append(f"collision: its convex parts {why}, so it is {told}")
    if mass is None and metadata.density is not None and "material" not in settings:
        asset, source = weighed(asset, metadata.density / asset.material.density), "density of its metadata"
    asset, wrong = _weighed(asset, body, placing, settings)
    doubts += [f"inertia: {wrong}; that of a uniform body was taken"] if wrong else []
    properties = asset.mass_properties
    if not LEAST_MASS <= properties.mass <= MOST_MASS:
        raise AssetError(
            f"its mass would be {properties.mass:.3g} kg; {LEAST_MASS:g} to {MOST_MASS:g} kg can be simulated. "
            "Give units, a size or a mass in library.yaml."
        )
    if not DENSITIES[0] <= asset.material.density <= DENSITIES[1]:
        doubts.append(f"mass: {properties.mass:.3g} kg in its volume is a density of {asset.material.density:.3g}")
    record = asset.provenance
    if record["parts"]["method"] == "given" and record["parts"].get("stuck_out", 0.0) > 2e-3:
        doubts.append(
            f"collision: the picture reached {1e3 * record['parts']['stuck_out']:.1f} mm beyond the collision shapes, "
            "which were grown to hold it"
        )
    if record["volume_source"] == "voxel wrap":
        doubts.append("mesh: it bounds no solid, so its volume is that of a wrap around it")
    facts = {
        "unit": vars(unit),
        "up": vars(up),
        "scale": metres,
        "turned": turn.tolist(),
        "size": asset.size.tolist(),
        "mass": properties.mass,
        "mass_from": source or f"density of {made_of}",
        "material": made_of,
        "friction": asset.material.friction,
        "resting": [vars(rest) for rest in rests[:6]],
        "places": [
            {"kind": one.kind, "shape": one.shape, "half_size": one.half_size, "floor": one.floor,
             "height": None if not np.isfinite(one.height) else one.height}
            for one in asset.regions
        ],
        "parts": len(asset.parts),
        "faces": len(asset.visual.faces),
        "texture": list(asset.visual.texture.shape[:2]),
        "cavity_loss": record["parts"].get("cavity_loss"),
        "sticks_out": record["parts"].get("sticks_out"),
        "notes": [*record["notes"], *body.notes, *record["repairs"]],
    }  # fmt: skip
    return asset, facts, doubts


def _centre(body: Body, metres: float) -> Points | None:
    """Centre of mass [m] in the file's axes: the declared one, else that of what the mesh encloses; None for nothing.

    Args:
        body: the object.
        metres: of a unit of its mesh.
    """
    used = body.mesh.vertices[np.unique(body.mesh.faces)] * metres
    low, high = used.min(axis=0), used.max(axis=0)
    given = body.inertial
    if given is not None and given.centre is not None and not fault(given, low, high):
        return given.centre
    corners = body.mesh.vertices[body.mesh.faces] * metres - low
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    volumes = np.linalg.det(corners) / 6.0
    # The areas of a closed surface add up to nothing; of an open one the sums below depend on the origin.
    open_share = np.linalg.norm(areas.sum(axis=0)) / np.linalg.norm(areas, axis=1).sum()
    if open_share > OPEN or abs(volumes.sum()) < LEAST_FILLED * np.prod(high - low):
        return None
    centre = volumes @ corners.sum(axis=1) / (4.0 * volumes.sum())
    return low + centre if ((centre > 0.0) & (centre < high - low)).all() else None


def _missed(hulls: list[Points], points: Points) -> float:
    """How far `points` stick out of the union of the convex `hulls` [m]."""
    return float(outside(points, [convex_part(hull) for hull in hulls])[0].max())


def _wrapped(points: Points) -> Points:
    """Corners of the half-spaces along 18 directions that touch `points` [m], shape (n, 3)."""
    steps = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    return circumscribed(points, np.array([step for step in steps if 1 <= sum(map(abs, step)) <= 2], dtype=np.float64))


def _unit(body: Body, typical: Typical | None, settings: Mapping[str, Any], metadata: Metadata) -> tuple[Guess, float]:
    """The unit, and metres for each of it."""
    if "size" in settings:
        guess = Guess(value="size", reason=f"library.yaml gives {settings['size']:g} m", confidence=1.0, source="given")
        return guess, float(settings["size"]) / longest_side(body)
    if "units" in settings:
        guess = Guess(value=settings["units"], reason="library.yaml says so", confidence=1.0, source="given")
        return guess, METRES[settings["units"]]
    if body.metres is None and metadata.metres is not None:
        body = replace(body, metres=metadata.metres, declared="its metadata")
    guess = guess_unit(body, typical)
    return guess, body.metres if body.metres is not None else METRES[unit_of(guess)]


def _up(body: Body, typical: Typical | None, settings: Mapping[str, Any], metadata: Metadata) -> Guess:
    """The axis that points up: library.yaml's, the file's, its metadata's, or a guess."""
    if "up" in settings:
        return Guess(value=settings["up"], reason="library.yaml says so", confidence=1.0, source="given")
    if body.up is None and metadata.up is not None:
        return Guess(value=metadata.up, reason="its metadata say so", confidence=1.0, source="declared")
    return guess_up(body, typical)


def _material(settings: Mapping[str, Any], like: str) -> tuple[str, bool]:
    """Name of the material, and whether it is a guess."""
    if "material" in settings:
        return settings["material"], False
    found = lookup.find(like) if like else None
    return (found.material, False) if found is not None else ("plastic", True)


def _mass(settings: Mapping[str, Any], body: Body, metadata: Metadata) -> tuple[float | None, str]:
    if "mass" in settings:
        return float(settings["mass"]), "library.yaml"
    if body.inertial is not None and "material" not in settings:
        return body.inertial.mass, body.declared
    if metadata.mass is not None:
        return metadata.mass, "metadata"
    return None, ""


def _weighed(asset: Asset, body: Body, placing: Placing, settings: Mapping[str, Any]) -> tuple[Asset, str]:
    """`asset` with the centre of mass and the inertia that its description gives, or why it cannot have them."""
    given = body.inertial
    if given is None or {"mass", "material", "size", "units"} & settings.keys():
        return asset, ""
    if given.centre is None or given.inertia is None:
        return asset, ""
    lifted = np.array([0.0, 0.0, asset.provenance["lifted"]])
    # A declared centre and tensor are in metres whatever the unit of the meshes.
    metres = placing.factors[0]
    centre = (given.centre @ placing.turn.T) - placing.origin * metres + lifted
    tensor = placing.turn @ given.inertia @ placing.turn.T
    low, high = asset.bounds
    if wrong := fault(replace(given, centre=centre, inertia=tensor), low, high):
        return asset, wrong
    properties = MassProperties(
        mass=given.mass,
        volume=asset.mass_properties.volume,
        centre_of_mass=tuple(map(float, centre)),  # type: ignore[arg-type]
        inertia=tuple(tuple(map(float, row)) for row in (tensor + tensor.T) / 2),  # type: ignore[arg-type]
    )
    return replace(asset, mass_properties=properties), ""


@cache
def typical_of(noun: str) -> Typical | None:
    """How large a catalogue noun is; None for none."""
    if not noun:
        return None
    made = lookup.make(noun)
    x, y, z = (float(side) for side in made.size)
    return Typical(noun=noun, size=(x, y, z))
