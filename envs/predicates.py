"""Where one object is relative to another, judged on the running simulation."""

from __future__ import annotations

import numpy as np

from pat3d.assets.asset import Region
from pat3d.envs.state import SimState

UPRIGHT_DEGREES = 30.0
"""A container or a base that leans more than this holds nothing."""

REGION_MARGIN = 0.01
"""An object counts as over a floor up to this far beyond its edge [m]."""

CONTACT_DEPTH = 0.01
"""The lowest point of what stands on a floor is at most this far below it [m]."""


def inside(state: SimState, child: str, parent: str) -> bool:
    """Whether `child` lies in the cavity of `parent`: over its floor, lowest below the rim, parent upright."""
    region = state.scene[parent].asset.region("in")
    if region is None or state.tilt(parent) > UPRIGHT_DEGREES:
        return False
    points = state.local(state.points(child), parent)
    centre = state.local(state.centre(child)[None], parent)[0]
    lowest = points[int(np.argmin(points[:, 2]))]
    # An object that leans on the rim is inside when its foot is.
    over = _over(region, centre) or _over(region, lowest)
    return over and lowest[2] < region.floor[2] + region.height and centre[2] > region.floor[2] - CONTACT_DEPTH


def on_top(state: SimState, child: str, parent: str) -> bool:
    """Whether `child` stands on `parent`: in contact, its centre over the parent's upper floor, parent upright."""
    region = state.scene[parent].asset.region("on")
    if region is None or state.tilt(parent) > UPRIGHT_DEGREES or not state.touch(child, parent):
        return False
    centre = state.local(state.centre(child)[None], parent)[0]
    lowest = float(state.local(state.points(child), parent)[:, 2].min())
    return _over(region, centre) and lowest > region.floor[2] - CONTACT_DEPTH


def at_rest(state: SimState, name: str) -> bool:
    """Whether the robot has let go of the object and it does not move."""
    return not state.touched(name) and state.still(name)


def _over(region: Region, point: np.ndarray) -> bool:
    """Whether a point of the parent's frame is over the region's floor."""
    x, y = abs(point[0] - region.floor[0]), abs(point[1] - region.floor[1])
    half_x, half_y = region.half_size[0] + REGION_MARGIN, region.half_size[1] + REGION_MARGIN
    if region.shape == "disc":
        return bool(np.hypot(x, y) <= half_x)
    return bool(x <= half_x and y <= half_y)
