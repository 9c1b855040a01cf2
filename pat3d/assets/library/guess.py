"""Unit and up axis of a mesh whose file says neither: a guess with its reason, and how sure it is.

Evidence is counted in nats: what the object is like in the catalogue tells how long and how tall it usually is; a
stable base tells which way it stands; a cavity that is open to above is worth most; habits of tools the least.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, cast

import numpy as np

from pat3d.assets.library.body import Body, Points
from pat3d.assets.mesh.importing import METRES, TO_Z_UP, Units, UpAxis
from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part

SURE = 0.75
"""Confidence below which a guess is a doubt for the user to settle."""

HABIT: Mapping[str, float] = {"m": 0.0, "mm": -1.0, "cm": -1.3, "in": -3.0}
"""How usual each unit is, other things equal."""

USUAL = (0.015, 1.5)
"""Longest side [m] of things that lie about in scenes."""

_UPS: tuple[UpAxis, ...] = ("z", "y", "-y", "-z", "x", "-x")


@dataclass(frozen=True, kw_only=True)
class Guess:
    """What was decided, why, and how sure that is."""

    value: str
    reason: str
    confidence: float
    """In [0, 1]; 1 where the file or the user says it."""
    source: Literal["declared", "guessed", "given"] = "guessed"


@dataclass(frozen=True, kw_only=True)
class Typical:
    """How large a catalogue noun is."""

    noun: str
    size: tuple[float, float, float]
    """Width, depth, height [m]."""


def guess_unit(body: Body, typical: Typical | None) -> Guess:
    """The unit of the coordinates of `body`."""
    if body.metres is not None:
        known = next((unit for unit, metres in METRES.items() if math.isclose(metres, body.metres)), f"{body.metres}")
        longest = longest_side(body) * body.metres
        if _log_off(longest, USUAL) > math.log(10):
            reason = f"{body.declared} says so, yet it would be {longest:.3g} m long"
            return Guess(value=known, reason=reason, confidence=0.5, source="declared")
        return Guess(value=known, reason=f"{body.declared} says so", confidence=1.0, source="declared")
    longest = longest_side(body)
    scores = {}
    for unit, metres in METRES.items():
        length = longest * metres
        score = HABIT[unit] - 2.0 * _log_off(length, USUAL)
        if typical is not None:
            score -= 1.2 * max(0.0, abs(math.log(length / max(typical.size))) - math.log(1.5))
        scores[unit] = score
    unit, confidence = _best(scores)
    length = longest * METRES[unit]
    reason = f"{length:.3g} m long"
    if typical is not None:
        reason += f", a {typical.noun} of the catalogue is {max(typical.size):.2g} m"
    return Guess(value=unit, reason=reason, confidence=confidence)


def guess_up(body: Body, typical: Typical | None) -> Guess:
    """The axis of `body` that points up as it usually stands."""
    if body.up is not None:
        return Guess(value=body.up, reason=f"{body.declared} says so", confidence=1.0, source="declared")
    try:
        hull = convex_part(body.mesh.vertices[np.unique(body.mesh.faces)])
    except AssetError as error:
        raise AssetError(f"the mesh is flat: {error}") from error
    normals, areas, centres = _sides(hull.vertices[hull.faces])
    extents = np.ptp(hull.vertices, axis=0)
    scores: dict[str, float] = {}
    told: dict[str, list[str]] = {}
    for up in _UPS:
        turn = np.array(TO_Z_UP[up], dtype=np.float64)
        size = np.abs(turn) @ extents
        # Robots' meshes have z up, games' y; hardly any file has another axis.
        score, why = {"z": 1.2, "y": 0.7}.get(up, -2.2), []
        base = _base_share(normals, areas, centres, turn, size)
        score += 1.5 * base
        if base > 0.5:
            why.append(f"a level base of {100 * base:.0f} % of its outline")
        if (depth := _opening(body, turn)) > 0.3:
            score += 2.5 * depth
            why.append(f"a hollow open to above, {100 * depth:.0f} % of its height deep")
        if typical is not None:
            ratio = size[2] / max(size[0], size[1])
            usual = typical.size[2] / max(typical.size[0], typical.size[1])
            off = abs(math.log(ratio / usual))
            score -= 1.5 * min(off, 2.0)
            if off < 0.35:
                why.append(f"as tall for its width as a {typical.noun}")
        scores[up], told[up] = score, why
    up, confidence = _best(scores)
    reason = "; ".join(told[up]) or "most files of this kind have it so"
    return Guess(value=up, reason=reason, confidence=confidence)


def longest_side(body: Body) -> float:
    """Of the bounding box, in the file's unit.

    Raises:
        AssetError: it has no extent.
    """
    longest = float(np.ptp(body.mesh.vertices[np.unique(body.mesh.faces)], axis=0).max())
    if not (math.isfinite(longest) and longest > 0):
        raise AssetError("the mesh has no extent: all its vertices coincide.")
    return longest


def axis_of(guess: Guess) -> UpAxis:
    """A guess of `guess_up` as an axis."""
    return cast(UpAxis, guess.value)


def unit_of(guess: Guess) -> Units:
    """A guess of `guess_unit` as a unit."""
    return cast(Units, guess.value)


def _best(scores: Mapping[str, float]) -> tuple[str, float]:
    """The highest score and its share of all by softmax."""
    best = max(scores, key=lambda key: scores[key])
    total = sum(math.exp(score - scores[best]) for score in scores.values())
    return best, 1.0 / total


def _log_off(length: float, band: tuple[float, float]) -> float:
    """By how many nats `length` lies outside `band`."""
    low, high = band
    return max(0.0, math.log(low / length), math.log(length / high))


def _sides(triangles: Points) -> tuple[Points, Points, Points]:
    """Unit normals, areas and centres of a hull's triangles, shape (n, 3, 3)."""
    vectors = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(vectors, axis=1)
    return vectors / np.maximum(lengths, 1e-300)[:, None], lengths / 2, triangles.mean(axis=1)


def _base_share(normals: Points, areas: Points, centres: Points, turn: Points, size: Points) -> float:
    """Area of the hull's lowest level side over that of its outline's rectangle, at most 1."""
    down = -turn[2]
    facing = normals @ down > math.cos(math.radians(3.0))
    if not facing.any():
        return 0.0
    lowest = centres @ down >= (centres @ down).max() - 0.02 * size[2]
    return min(1.0, float(areas[facing & lowest].sum() / (size[0] * size[1])))


def _opening(body: Body, turn: Points) -> float:
    """Depth of the deepest hollow open to above, over the height; from a coarse height map."""
    from pat3d.assets.mesh.regions import cavity, mesh_height_map

    if len(body.mesh.faces) > 100_000:
        return 0.0
    vertices = body.mesh.vertices @ turn.T
    vertices = vertices - [0.0, 0.0, vertices[:, 2].min()]
    try:
        pit = cavity(mesh_height_map(vertices, body.mesh.faces, cells=40))
    except (ValueError, IndexError):
        return 0.0
    return 0.0 if pit is None else min(1.0, pit.height / float(np.ptp(vertices[:, 2])))
