"""Tiers: the boards of a shelf, the decks of a cart, the compartments of a bookcase or of an open cabinet.

They are what an asset has as enclosed regions. The open top is one of them where it is a board as the others are, as
of a rack; that of what has walls is none: the top shelf of a bookcase is inside.
"""

from __future__ import annotations

import numpy as np

from pat3d.layout.bodies import Placed
from pat3d.layout.frames import upright
from pat3d.scene.arrangements import TIERS
from pat3d.scene.asset import Asset, Region

WALLED = frozenset({"bookshelf"})
"""Nouns of what has compartments that things are on, between walls and under a lid."""
_ABOVE = 0.005
"""By how much things may be lower than the board that they are on [m]."""


def tiers(asset: Asset) -> tuple[Region, ...]:
    """The tiers of `asset` from the lowest to the highest; none where it has at most one floor for things."""
    enclosed = [region for region in asset.regions if region.enclosed]
    open_tops = [region for region in asset.regions if region.kind == "on" and not region.enclosed]
    walls = asset.noun in WALLED or any(region.kind == "in" for region in enclosed)
    found = enclosed if walls or not enclosed else [*enclosed, *open_tops]
    return tuple(sorted(found, key=lambda region: region.floor[2]))


def meant(kind: str, asset: Asset) -> tuple[Region, ...]:
    """The tiers of `asset` that an arrangement of `kind` ("on_top_tier") speaks of; none where it has no such."""
    return tiers(asset)[TIERS[kind]]


def tier_holds(kind: str, body: Placed, carrier: Placed) -> tuple[bool, str]:
    """Whether `body`, which `carrier` carries, is on the tier that `kind` speaks of, and what was measured."""
    asset = carrier.body.asset
    if not upright(carrier):
        return False, "its carrier does not stand upright"
    heights = np.array([region.floor[2] + carrier.position[2] for region in tiers(asset)])
    below = np.flatnonzero(heights <= body.low[2] + _ABOVE)
    if not len(below):
        return False, "below every tier" if len(heights) else "there are no tiers"
    own = tiers(asset)[int(below[-1])]
    middle = carrier.rotation.T @ (body.centre_of_mass - carrier.position)
    beside = bool(np.any(np.abs(middle[:2] - own.floor[:2]) > own.half_size))
    told = f"on tier {int(below[-1]) + 1} of {len(heights)} from below"
    return own in meant(kind, asset) and not beside, told + (", but beside it" if beside else "")
