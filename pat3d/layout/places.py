"""Places on a surface: at its edge, in a corner, in the middle. Where things are put, and whether they are there.

A thing is at an edge where its footprint comes as near to it as NEAR says, or over it. Distances are measured in the
frame of the surface, so that a turned table has the same edges.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from pat3d.layout.bodies import Array, Placed
from pat3d.layout.flat import Item, Lateral, Surface, natural_gap
from pat3d.layout.formations import Wishes
from pat3d.layout.frames import upright
from pat3d.scene.asset import Region

NEAR = (0.05, 0.15)
"""What is at an edge is at most this far from it: [m], or as a share of half the surface, whichever is more."""
MIDDLE = (0.02, 0.15)
"""What is in the middle is at most this far from it: [m], or as a share of half the surface, whichever is more."""
_OFF_MIDDLE = 0.7
"""Share of that which the layout uses; settling takes some."""
INSIDE = (0.01, 0.04)
"""How far from an edge the layout puts things: [m], or as a share of half the surface, whichever is less."""
_TRIED = 64
_DISC_ANGLES = (1.5, 0.5, 0.0, 1.0, 1.75, 1.25, 0.25, 0.75)
"""Where on the rim of a round surface, in half turns from +x."""


def pins(
    wishes: Wishes, items: Sequence[Item], laterals: Sequence[Lateral], surface: Surface, rng: np.random.Generator
) -> Iterator[dict[str, Array]]:
    """Ways to put everything where it is wanted: origins relative to the surface's centre [m], shape (2,).

    Of things in one formation (a row at the edge) the first alone is put there, with room for the others.
    """
    places = wishes.places
    formed = [one for one in wishes.formations if sum(name in places for name in one.names) > 1]
    led = {name for one in formed for name in [name for name in one.names if name in places][1:]}
    by_name = {item.name: item for item in items}
    whole = {
        lead: _joined(lead, one.offsets(by_name, laterals, lambda a, b: natural_gap(a.size, b.size)), by_name)
        for one in formed
        if (lead := next(name for name in one.names if name in places)) not in led
    }
    wanted = [whole.get(item.name, item) for item in items if item.name in places and item.name not in led]
    options = [_spots(places[item.name], item, surface) for item in wanted]
    for item, one in zip(wanted, options, strict=True):
        if places[item.name] != "in_middle":
            # The near ones by chance, so that not everything is in the same corner.
            rng.shuffle(one)
    for chosen in itertools.islice(itertools.product(*options), _TRIED):
        found = {item.name: spot for item, spot in zip(wanted, chosen, strict=True)}
        boxes = [(spot + item.low, spot + item.high) for item, spot in zip(wanted, chosen, strict=True)]
        clear = all(np.maximum(a[0] - b[1], b[0] - a[1]).max() > 0.004 for a, b in itertools.combinations(boxes, 2))
        if clear:
            yield found


def _joined(lead: str, offsets: Mapping[str, Array], items: Mapping[str, Item]) -> Item:
    """The outline of a formation as that of its `lead`, whose origin it keeps."""
    moved = {name: at - offsets[lead] + items[lead].middle - items[name].middle for name, at in offsets.items()}
    low = np.min([at + items[name].low for name, at in moved.items()], axis=0)
    high = np.max([at + items[name].high for name, at in moved.items()], axis=0)
    outlines = np.concatenate([at + items[name].outline for name, at in moved.items()])
    return replace(items[lead], low=low, high=high, outline=outlines, middle=(low + high) / 2)


def _spots(kind: str, item: Item, surface: Surface) -> list[Array]:
    half = np.array(surface.half_size)
    centre = (item.low + item.high) / 2
    if kind == "in_middle":
        # Where it leaves no room for what stands beside it, a little off: still in the middle.
        off = _OFF_MIDDLE * np.maximum(MIDDLE[0], MIDDLE[1] * half)
        ways = ((0, 0), (0, 1), (0, -1), (1, 0), (-1, 0))
        return [np.array(way) * off - item.middle for way in ways]
    if surface.disc:
        inset = min(INSIDE[0], INSIDE[1] * float(half[0]))
        reach = float(np.linalg.norm(item.outline - centre, axis=1).max())
        radius = float(half[0]) - inset - reach
        turns = _DISC_ANGLES if kind == "at_edge" else (0.0, 1.0) if kind == "at_end" else ()
        angles = [math.pi * turn for turn in turns] if radius > 0 else []
        return [radius * np.array([math.cos(angle), math.sin(angle)]) - centre for angle in angles]
    room = half - np.minimum(INSIDE[0], INSIDE[1] * half) - item.size / 2
    if (room < 0.0).any():
        return []
    if kind == "at_end":
        return [room * way - centre for way in (-_along(half), _along(half))]
    signs = [(i, j) for i in (-1, 1) for j in (-1, 1)]
    if kind == "in_corner":
        return [room * np.array(sign) - centre for sign in signs]
    at = [np.array([0.5 * i, float(j)]) for i in (0, -1, 1) for j in (-1, 1)]
    # A row along x is at an edge in front or behind only.
    at += [np.array([float(i), 0.0]) for i in (-1, 1) if item.size[0] <= 2.0 * item.size[1]]
    return [room * one - centre for one in at]


def _along(half: Array) -> Array:
    """The axis of a surface with half sides `half` [m], shape (2,), along which it is longer; x where it is square."""
    return np.array([0.0, 1.0]) if half[1] > half[0] else np.array([1.0, 0.0])


def ends_hold(bodies: Sequence[Placed], carrier: Placed) -> tuple[bool, str]:
    """Whether two `bodies` are at opposite ends of `carrier`, and what was measured."""
    half = np.array(_region(bodies[0], carrier).half_size)
    way = _along(half)
    near = float(np.maximum(NEAR[0], NEAR[1] * half) @ way)
    floor = np.array(_region(bodies[0], carrier).floor)
    reach = [((body.vertices - carrier.position) @ carrier.rotation - floor)[:, :2] @ way for body in bodies]
    low, high = sorted(reach, key=lambda one: float(one.mean()))
    free = max(float(half @ way + low.min()), float(half @ way - high.max()))
    return free <= near and low.max() < 0.0 < high.min(), f"at most {1e3 * free:.0f} mm from the two ends"


def place_holds(kind: str, bodies: Sequence[Placed], carrier: Placed) -> tuple[bool, str]:
    """Whether `bodies`, together, are at the edge, in a corner or in the middle of `carrier`, and what was measured."""
    region = _region(bodies[0], carrier)
    half = np.array(region.half_size)
    points = np.concatenate([body.vertices for body in bodies])
    local = ((points - carrier.position) @ carrier.rotation - np.array(region.floor))[:, :2]
    if kind == "in_middle":
        middle = (local.min(axis=0) + local.max(axis=0)) / 2
        off = np.abs(middle)
        holds = bool(np.all(off <= np.maximum(MIDDLE[0], MIDDLE[1] * half)))
        return holds, f"{1e3 * float(np.linalg.norm(off)):.0f} mm from the middle"
    centres = np.stack([offset_on(body, carrier) for body in bodies]) / half
    if (np.linalg.norm(centres, axis=1).max() if region.shape == "disc" else np.abs(centres).max()) > 1.0:
        return False, "centre of mass beyond the edge"
    near = np.maximum(NEAR[0], NEAR[1] * half)
    if region.shape == "disc":
        free = float(half[0] - np.linalg.norm(local, axis=1).max())
        return kind == "at_edge" and free <= near[0], f"{1e3 * free:.0f} mm from the rim"
    free = np.minimum(half + local.min(axis=0), half - local.max(axis=0))
    close = free <= near
    detail = f"{1e3 * free[0]:.0f} and {1e3 * free[1]:.0f} mm from the edges"
    if kind == "in_corner" and len(np.unique(np.sign(centres), axis=0)) > 1:
        return False, f"{detail}, in the corners of two quarters"
    return bool(close.all() if kind == "in_corner" else close.any()), detail


def offset_on(body: Placed, carrier: Placed) -> Array:
    """Where the centre of mass of `body` is from the middle of what it lies on, in that one's frame [m], shape (2,)."""
    floor = np.array(_region(body, carrier).floor)
    return ((body.centre_of_mass - carrier.position) @ carrier.rotation - floor)[:2]


def _region(body: Placed, carrier: Placed) -> Region:
    """The floor of `carrier`, in its frame, on which `body` stands; the top of its box where it has none."""
    regions = [one for one in carrier.body.asset.regions if one.kind == "on"] if upright(carrier) else []
    if not regions:
        low, high = carrier.body.asset.bounds
        half = (high - low) / 2
        floor = (*((low + half)[:2]), high[2])
        return Region(kind="on", shape="rectangle", floor=floor, half_size=(float(half[0]), float(half[1])))
    heights = [float((carrier.rotation @ np.array(one.floor) + carrier.position)[2]) for one in regions]
    return regions[int(np.argmin(np.abs(np.array(heights) - float(body.low[2]))))]
