"""Drawers in the rows of their cabinet: shut, or pulled out as far as they stay level."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.rotations import yaw_matrix, yaw_of
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.drop import clear
from pat3d.layout.group import Group
from pat3d.scene.asset import Asset

CABINET, SHUT, OPEN = "drawer cabinet", "drawer", "open drawer"
PULLED = 0.38
"""Share of its depth by which an open drawer is out: its centre of mass stays over the floor that it slides on."""
HAND = 0.06
"""Before a handle, for a hand [m]."""
WIDE = 0.12
"""Beside a drawer, for a hand that takes what stands there [m]."""
_SIDES = 1e-3
"""Least distance that a drawer keeps from the walls it slides between [m]."""


def slides(child: Asset, parent: Asset) -> bool:
    """Whether `child` is a drawer and `parent` the cabinet of such."""
    return child.noun in (SHUT, OPEN) and parent.noun == CABINET


def slide_in(cabinet: Placed, groups: Sequence[Group], gap: float) -> list[Group]:
    """`groups`, whose roots are drawers at the origin, each in the highest row of `cabinet` that is free.

    Raises:
        LayoutError: no row is free, or what is in a drawer is too high for it.
    """
    from pat3d.assets.catalogue.drawers import FLOORS

    asset = cabinet.body.asset
    scale = _scale(asset)
    made: list[Group] = []
    for group in groups:
        turned = group.turned(yaw_matrix(yaw_of(cabinet.rotation)))
        in_way = [cabinet, *(member for other in made for member in other.members)]
        own = group.root.body.asset
        along = shut_at(own, asset) - (pulled(own) if own.noun == OPEN else 0.0)
        for low in FLOORS:
            offset = np.array([0.0, along, scale * low + gap])
            found = turned.shifted(cabinet.rotation @ offset + cabinet.position)
            if all(clear(member, in_way, min(gap, _SIDES * scale)) for member in found.members):
                made.append(found)
                break
        else:
            raise LayoutError(
                f'"{group.name}" does not fit into "{cabinet.body.name}": no row of that is free, or what is in the '
                "drawer is too high. Nothing was written."
            )
    return made


def ways_out(members: Sequence[Placed]) -> list[Array]:
    """What the drawers among `members` take up when they are pulled out, seen from above, shape (n, 2) each [m].

    With a hand before them, and beside them, so that what stands there can be taken to be put in.
    """
    drawers = [one for one in members if one.body.asset.noun in (SHUT, OPEN)]
    ways = ((one, np.array([side * WIDE, -out - HAND, 0.0]))
            for one in drawers for side in (-1.0, 1.0)
            for out in (pulled(one.body.asset) if one.body.asset.noun == SHUT else 0.0,))  # fmt: skip
    return [one.vertices[:, :2] + (one.rotation @ way)[:2] for one, way in ways]


def shut_at(drawer: Asset, cabinet: Asset) -> float:
    """Where the origin of `drawer` is along the depth of `cabinet` when it is shut [m], in the cabinet's frame."""
    from pat3d.assets.catalogue.drawers import BEHIND, WALL

    return float(cabinet.bounds[1, 1]) - _scale(cabinet) * (WALL + BEHIND) - float(drawer.bounds[1, 1])


def pulled(drawer: Asset) -> float:
    """By how much an open `drawer` is out [m]."""
    return PULLED * float(drawer.size[1])


def _scale(cabinet: Asset) -> float:
    from pat3d.assets.catalogue.drawers import HEIGHT

    return float(cabinet.size[2]) / HEIGHT
