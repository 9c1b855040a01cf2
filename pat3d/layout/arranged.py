"""Does an arrangement hold at given poses? Yes or no, with what was measured.

Middles are those of bounding boxes, footprints hulls of the parts seen from above. What each kind asks for stands in
pat3d.scene.arrangements (`ARRANGEMENTS`, `holds`); the numbers stand here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import product

import numpy as np

from pat3d.geometry.polygons import contains, outline, polygon_gap, polygon_margin
from pat3d.layout.bodies import Array, Placed, distance
from pat3d.layout.formations import FAR, pairs, reach_of_beside
from pat3d.layout.leaning import covered
from pat3d.layout.places import ends_hold, offset_on, place_holds
from pat3d.layout.spans import overhang
from pat3d.layout.tiers import tier_holds
from pat3d.scene.arrangements import TIERS, Arrangement

LENS = 135.0
"""Least angle [degrees] at which what is between two things sees them apart."""
SIGHT = 20.0
"""Largest angle [degrees] between a front and the direction to what it faces."""
ALIKE = 15.0
"""Largest angle [degrees] between things turned alike."""
UNEVEN = (0.01, 0.15)
"""Largest deviation of rows and circles: [m], or as a share of the distance between neighbours, whichever is more."""
ROUND = 0.9
"""Share of its largest reach from its middle that what is round has in every direction; 0.87 in a hexagon."""
UNEVEN_ANGLE = 0.2
"""Largest deviation of the angles on a circle, as a share of the equal one."""
_FOOT = 2e-3
"""What is this near to the lowest point [m] stands on what carries it."""
_HIGH = 0.1
"""What leans touches above this share of its height."""


def arrangement_holds(one: Arrangement, bodies: Mapping[str, Placed], touch: float) -> tuple[bool, str]:
    """Whether `one` holds, and what was measured; things at most `touch` [m] apart touch each other."""
    objects, of = ([bodies[name] for name in names] for names in (one.objects, one.of))
    if one.kind == "between":
        return _every(_between(body, of) for body in objects)
    if one.kind == "far_from":
        couples = list(product(objects, of)) if of else [(bodies[a], bodies[b]) for a, b in pairs(one.objects)]
        return _every(_far(a, b) for a, b in couples)
    if one.kind == "row":
        return _row(objects)
    if one.kind == "side_by_side":
        return _side_by_side(objects)
    if one.kind == "circle":
        return _circle(objects, of)
    if one.kind == "facing":
        targets = of * len(objects) if of else objects[::-1]
        return _every(_faces(body, target) for body, target in zip(objects, targets, strict=True))
    if one.kind == "leaning_against":
        return _leans(objects[0], of, touch)
    if one.kind == "under":
        return _every(_under(body, of[0]) for body in objects)
    if one.kind == "across":
        beyond = overhang(objects[0], of[0])
        return beyond >= 0.0, f"its ends are at least {1e3 * beyond:.0f} mm beyond the rim"
    if one.kind == "in_corner":
        return place_holds(one.kind, objects, of[0])
    if one.kind == "in_corners":
        return _in_own_corners(objects, of[0])
    if one.kind == "at_ends":
        return ends_hold(objects, of[0])
    if one.kind in TIERS:
        return _every(tier_holds(one.kind, body, of[0]) for body in objects)
    return _every(place_holds(one.kind, [body], of[0]) for body in objects)


def _every(results: Iterable[tuple[bool, str]]) -> tuple[bool, str]:
    """Whether all of `results` hold; of the first that does not, or else of the first, what was measured."""
    found = list(results)
    worst = next((one for one in found if not one[0]), found[0])
    return bool(worst[0]), worst[1]


def _middle(body: Placed) -> Array:
    return ((body.low + body.high) / 2)[:2]


def _footprint(body: Placed) -> Array:
    return outline(body.vertices[:, :2])


def _between(body: Placed, of: Sequence[Placed]) -> tuple[bool, str]:
    middles = np.stack([_middle(one) for one in of])
    if len(of) > 2:
        inside = contains(outline(middles), _middle(body))
        return inside, f"middle {'inside' if inside else 'outside'} the polygon of the others' middles"
    ways = middles - _middle(body)
    lengths = np.linalg.norm(ways, axis=1)
    cosine = float(ways[0] @ ways[1]) / max(float(lengths.prod()), 1e-12)
    angle = math.degrees(math.acos(min(1.0, max(-1.0, cosine))))
    return angle >= LENS, f"the two are {angle:.0f} degrees apart as seen from it (at least {LENS:.0f})"


def _far(first: Placed, second: Placed) -> tuple[bool, str]:
    least = FAR * reach_of_beside((first.high - first.low)[:2], (second.high - second.low)[:2])
    gap = polygon_gap(_footprint(first), _footprint(second))
    return gap > least, f"{1e3 * gap:.0f} mm apart (more than {1e3 * least:.0f})"


def _row(bodies: Sequence[Placed]) -> tuple[bool, str]:
    """In order along the line from the first to the last, off it by little, with equal gaps or equal distances."""
    middles = np.stack([_middle(body) for body in bodies])
    length = float(np.linalg.norm(middles[-1] - middles[0]))
    if length < 1e-6:
        return False, "the first and the last are in one place"
    way = (middles[-1] - middles[0]) / length
    along = (middles - middles[0]) @ way
    astray = float(np.abs((middles - middles[0]) @ np.array([-way[1], way[0]])).max())
    steps = np.diff(along)
    reach = [np.ptp(body.vertices[:, :2] @ way) for body in bodies]
    gaps = steps - (np.array(reach[1:]) + np.array(reach[:-1])) / 2
    allowed = max(UNEVEN[0], UNEVEN[1] * length / len(steps))
    uneven = min(float(np.abs(steps - steps.mean()).max()), float(np.abs(gaps - gaps.mean()).max()))
    holds = bool(steps.min() > 0.0) and astray <= allowed and uneven <= allowed
    turns = [(_turned(a, b), _straight(b, allowed)) for a, b in zip(bodies, bodies[1:], strict=False)]
    turned, most = max(turns, key=lambda one: one[0] - one[1])
    holds = holds and turned <= most
    detail = (
        f"{1e3 * astray:.0f} mm off the line, spacing uneven by {1e3 * uneven:.0f} mm (at most {1e3 * allowed:.0f}), "
        f"turned by {turned:.0f} degrees (at most {most:.0f})"
    )
    return holds, detail if steps.min() > 0.0 else f"{detail}, not in order"


def in_grid(cells: Mapping[str, tuple[int, int]], bodies: Mapping[str, Placed]) -> tuple[bool, str]:
    """Whether all of `cells`, by column and row, are at the crossings of equally spaced lines at right angles."""
    at = np.column_stack([np.ones(len(cells)), np.array(list(cells.values()), dtype=np.float64)])
    middles = np.stack([_middle(bodies[name]) for name in cells])
    fitted = np.linalg.lstsq(at, middles, rcond=None)[0]
    off = float(np.linalg.norm(middles - at @ fitted, axis=1).max())
    allowed = max(UNEVEN[0], UNEVEN[1] * float(np.linalg.norm(fitted[1:], axis=1).min()))
    askew = abs(90.0 - _angle(fitted[1], fitted[2]))
    detail = f"{1e3 * off:.0f} mm off the grid (at most {1e3 * allowed:.0f}), {askew:.0f} degrees from right angles"
    return off <= allowed and askew <= ALIKE, detail


def _turned(first: Placed, second: Placed) -> float:
    """How far two things are turned about the vertical from one another [degrees], however they lie."""
    # The twist about z of the rotation from one to the other, of which a round thing has none that anybody sees.
    away = second.rotation @ first.rotation.T
    angle = math.degrees(math.atan2(away[1, 0] - away[0, 1], away[0, 0] + away[1, 1]))
    return 0.0 if _is_round(first) or _is_round(second) else abs(angle)


def _straight(body: Placed, allowed: float) -> float:
    """How far a thing in a row may be turned [degrees]: its ends are off the line by no more than middles may be."""
    reach = float(np.linalg.norm(_footprint(body) - _middle(body), axis=1).max())
    return min(ALIKE, math.degrees(math.asin(min(1.0, allowed / reach))))


def _is_round(body: Placed) -> bool:
    around = _footprint(body) - _middle(body)
    reach = float(np.linalg.norm(around, axis=1).max())
    return polygon_margin(around, np.zeros(2), tolerance=0.0) >= ROUND * reach


def _side_by_side(bodies: Sequence[Placed]) -> tuple[bool, str]:
    holds, detail = _row(bodies)
    gaps = [polygon_gap(_footprint(a), _footprint(b)) for a, b in zip(bodies, bodies[1:], strict=False)]
    limits = [
        reach_of_beside((a.high - a.low)[:2], (b.high - b.low)[:2]) for a, b in zip(bodies, bodies[1:], strict=False)
    ]
    near = all(gap <= limit for gap, limit in zip(gaps, limits, strict=True))
    return holds and near, f"{detail}, at most {1e3 * max(gaps):.0f} mm apart"


def _circle(bodies: Sequence[Placed], of: Sequence[Placed]) -> tuple[bool, str]:
    middles = np.stack([_middle(body) for body in bodies])
    ways = middles - (_joint_middle(of) if of else middles.mean(axis=0))
    radii = np.linalg.norm(ways, axis=1)
    angles = np.arctan2(ways[:, 1], ways[:, 0])
    steps = np.mod(np.diff([*angles, angles[0]]), 2 * math.pi)
    if steps.sum() > 2 * math.pi * 1.5:
        steps = 2 * math.pi - steps
    equal = 2 * math.pi / len(bodies)
    out = float(np.abs(radii - radii.mean()).max())
    allowed = max(UNEVEN[0], UNEVEN[1] * float(radii.mean()))
    turned = float(np.abs(steps - equal).max())
    outside = sum(not contains(outline(middles), _middle(one)) for one in of)
    detail = f"{1e3 * out:.0f} mm off the circle, angles uneven by {math.degrees(turned):.0f} degrees"
    detail += f", {outside} of {len(of)} that it goes around outside" if outside else ""
    return out <= allowed and turned <= UNEVEN_ANGLE * equal and not outside, detail


def _joint_middle(bodies: Sequence[Placed]) -> Array:
    low, high = (np.min([one.low for one in bodies], axis=0), np.max([one.high for one in bodies], axis=0))
    return ((low + high) / 2)[:2]


def _faces(body: Placed, target: Placed) -> tuple[bool, str]:
    # The front of an asset is at -y.
    off = _angle(-body.rotation[:2, 1], _middle(target) - _middle(body))
    return off <= SIGHT, f"{off:.0f} degrees off (at most {SIGHT:.0f})"


def _leans(body: Placed, on: Sequence[Placed], touch: float) -> tuple[bool, str]:
    touched = [found for one in on if (found := distance(body, one, touch + 1e-9)) is not None]
    if not touched:
        return False, f"gap over {touch * 1e3:.1f} mm"
    # Of a stack, what is touched highest up.
    closest = max(touched, key=lambda one: float(one.first[2]))
    foot = body.vertices[body.vertices[:, 2] < body.low[2] + _FOOT, :2]
    falls = not contains(outline(foot), body.centre_of_mass[:2]) if len(foot) > 2 else True
    high = (float(closest.first[2]) - float(body.low[2])) / float(body.high[2] - body.low[2])
    detail = f"touches at {high:.0%} of its height, centre of mass {'beside' if falls else 'over'} its foot"
    return falls and high > _HIGH, detail


def _under(body: Placed, cover: Placed) -> tuple[bool, str]:
    below = covered(body, cover, 0.0)
    return below, f"{'below' if below else 'not below'} its underside"


def _in_own_corners(bodies: Sequence[Placed], carrier: Placed) -> tuple[bool, str]:
    """Each in a corner, and all in different ones."""
    holds, detail = _every(place_holds("in_corner", [body], carrier) for body in bodies)
    corners = {tuple(np.sign(offset_on(body, carrier))) for body in bodies}
    shared = len(corners) < len(bodies)
    return holds and not shared, f"{detail}, two in one corner" if shared else detail


def _angle(first: Array, second: Array) -> float:
    """Angle [degrees] between two directions in the plane."""
    norm = float(np.linalg.norm(first) * np.linalg.norm(second))
    return math.degrees(math.acos(min(1.0, max(-1.0, float(first @ second) / max(norm, 1e-12)))))
