"""What is said where things find no room: which, on what, beside what, and how many of them would fit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from pat3d.errors import LayoutError
from pat3d.layout.containers import listed
from pat3d.layout.flat import Lateral
from pat3d.layout.formations import Wishes
from pat3d.layout.frames import FlatRegion
from pat3d.layout.group import Group

LEAST = 3
"""A row or circle of fewer is none that somebody asks for instead."""

Fits = Callable[[Wishes, Sequence[Group], Sequence[Lateral]], bool]


def largest_formation(
    wishes: Wishes, groups: Sequence[Group], laterals: Sequence[Lateral], fits: Fits
) -> tuple[int, int] | None:
    """How many of those in the longest row, or the largest circle, would fit, and how many they are.

    Args:
        wishes: of the arrangements among `groups`.
        groups: everything that is to stand on a surface.
        laterals: relations among them.
        fits: whether the surface has room for fewer.

    Returns:
        None where not even a few fit, or the members' places are given.
    """
    whole = max(wishes.formations, key=lambda one: len(one.members), default=None)
    if whole is None or whole.fixed or whole.steps:
        return None
    others = [one for one in wishes.formations if one is not whole]
    for count in range(len(whole.members) - 1, LEAST - 1, -1):
        gone = set(whole.members[count:])
        cells = {name: cell for name, cell in whole.cells.items() if name not in gone}
        less = replace(whole, members=whole.members[:count], cells=cells)
        kept = replace(wishes, formations=(less, *(one for one in others if gone.isdisjoint(one.names))))
        near = [lat for lat in laterals if gone.isdisjoint((lat.child, lat.parent))]
        if fits(kept, [group for group in groups if group.name not in gone], near):
            return count, len(whole.members)
    return None


def no_room(
    group: Group, carrier: str, region: FlatRegion, before: list[str], most: tuple[int, int] | None
) -> LayoutError:
    """The error for `group`, for which there is no room on a region of `carrier` beside those placed `before`."""
    width, depth = 2 * np.array(region.surface.half_size)
    beside = f" beside {listed(before)}" if before else ""
    tall = f", {region.height:.2f} m high" if region.enclosed else ""
    whole = carrier.removeprefix("the ").rpartition(" shelf of ")[2]
    fewer = "" if most is None else f" {most[0]} of the {most[1]} that stand so have room."
    return LayoutError(
        f'"{group.name}" ({group.size[0]:.2f} x {group.size[1]:.2f} x {group.size[2]:.2f} m) finds no room on '
        f'"{carrier}" ({width:.2f} x {depth:.2f} m{tall}){beside}. Fewer or smaller objects, fewer relations, or a '
        f'larger "{whole}", would fit.{fewer} Nothing was written.'
    )
