"""Doors in the sockets of their case: shut, or turned open."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.group import Group
from pat3d.scene.asset import Asset

if TYPE_CHECKING:
    from pat3d.assets.catalogue.doors import Doorway

CASES = {f"hinged {of}": of for of in ("microwave", "cabinet", "fridge")}
"""Nouns of what has a door that turns, and what they are."""
DOORS = {f"{state}{case} door": of for case, of in CASES.items() for state in ("", "open ")}
"""Nouns of doors, shut and open, and what they are of."""
OPEN = 90.0
"""Angle of an open door [degrees]."""
HAND = 0.08
"""Before a door and its handle, for a hand [m]."""
_NEAR, _UPRIGHT = 0.005, math.cos(math.radians(3.0))
"""Of the axis of a door from that of its sockets [m], and the cosine between its vertical and that of its case."""


class Hinge(NamedTuple):
    """Where a door turns in its case."""

    axis: Array
    """Of the case: a point of it at the height of the door's lower end [m], in the frame of the case, shape (3,)."""
    pivot: Array
    """Of the door: the same point in its own frame, shape (3,)."""


def turns(child: Asset, parent: Asset) -> bool:
    """Whether `child` is the door of the case `parent`."""
    return parent.noun in CASES and DOORS.get(child.noun) == CASES[parent.noun]


def doorway_of(door: Asset) -> tuple[Doorway, float]:
    """What the door covers as it is made, and the door's scale."""
    from pat3d.assets.catalogue.doors import BAR, DOORWAYS, LEAF, REACH

    way = DOORWAYS[DOORS[door.noun]]
    return way, float(door.size[1]) / (LEAF + REACH + BAR)


def hinge_of(door: Asset, case: Asset) -> Hinge:
    """Where `door` turns in `case`."""
    from pat3d.assets.catalogue.doors import LEAF, PIN_LENGTH

    way, scale = doorway_of(door)
    low, high = door.bounds
    pivot = np.array([high[0] - scale * way.width, high[1] - scale * LEAF / 2, low[2]])
    middle = (case.bounds[0] + case.bounds[1]) / 2
    base = np.array([middle[0], middle[1], case.bounds[0][2]])
    return Hinge(base + scale * np.array([*way.axis, way.up[0] - PIN_LENGTH]), pivot)


def hang_in(case: Placed, groups: Sequence[Group], gap: float) -> list[Group]:
    """`groups`, whose roots are doors at the origin, each in the sockets of `case`.

    Raises:
        LayoutError: there is a door already.
    """
    made: list[Group] = []
    for group in groups:
        if made:
            raise LayoutError(f'"{case.body.name}" has one door; "{group.name}" is another. Nothing was written.')
        door = group.root.body.asset
        hinge = hinge_of(door, case.body.asset)
        angle = math.radians(-OPEN) if door.noun.startswith("open ") else 0.0
        turned = group.turned(case.rotation @ yaw_matrix(angle))
        at = case.rotation @ (hinge.axis + [0.0, 0.0, gap]) + case.position
        made.append(turned.shifted(at - turned.root.rotation @ hinge.pivot))
    return made


def open_by(door: Placed, case: Placed) -> float:
    """The angle by which a door is open [rad]."""
    turned = case.rotation.T @ door.rotation
    return -math.atan2(turned[1, 0], turned[0, 0])


def in_sockets(door: Placed, case: Placed) -> tuple[bool, str]:
    """Whether `door` turns about the axis of `case`, and how far it is open."""
    hinge = hinge_of(door.body.asset, case.body.asset)
    apart = case.rotation @ hinge.axis + case.position - door.rotation @ hinge.pivot - door.position
    upright = float(case.rotation[:, 2] @ door.rotation[:, 2]) >= _UPRIGHT
    off = float(np.linalg.norm(apart))
    return off <= _NEAR and upright, (
        f"{off * 1e3:.1f} mm from its sockets, open by {math.degrees(open_by(door, case)):.0f} degrees"
    )


def swept(members: Sequence[Placed]) -> list[Array]:
    """What the doors among `members` take up when they turn, seen from above, shape (n, 2) each [m], with a hand."""
    found = []
    hung = ((door, case) for door in members for case in members if turns(door.body.asset, case.body.asset))
    for door, case in hung:
        hinge = hinge_of(door.body.asset, case.body.asset)
        way, scale = doorway_of(door.body.asset)
        angles = np.radians(np.linspace(0.0, OPEN, 7))
        arc = (scale * way.width + HAND) * np.stack([np.cos(angles), -np.sin(angles)], axis=1)
        points = np.concatenate([arc + hinge.axis[:2], hinge.axis[None, :2]])
        found.append((np.c_[points, np.zeros(len(points))] @ case.rotation.T + case.position)[:, :2])
    return found
