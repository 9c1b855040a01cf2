"""What carries, as the layout sees it, and which of its tops or tiers each of the things on it belongs to."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from pat3d.errors import LayoutError
from pat3d.layout.bodies import Placed
from pat3d.layout.flat import Lateral
from pat3d.layout.formations import Wishes
from pat3d.layout.frames import FlatRegion
from pat3d.layout.group import Group
from pat3d.layout.place_settings import Setting
from pat3d.layout.surfaces import NOTHING
from pat3d.layout.tiers import meant, tiers

_SAME = 1e-3
"""Heights this near are one [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Top:
    """What carries, as the children see it."""

    root: Placed
    supports: Sequence[Placed]
    """The root, its contents and children that are fixed."""
    regions: Sequence[FlatRegion]
    """Best first."""
    given: Sequence[Group]
    """Children at fixed poses."""
    turnable: set[str]
    """Children that may be turned by a quarter to fit."""
    gap: float
    """[m]"""
    wishes: Wishes = NOTHING
    """Of the arrangements among the children."""
    leaning: frozenset[str] = frozenset()
    """Children that others keep from falling."""
    turns: Mapping[str, float] = field(default_factory=dict)
    """By how much children would like to be turned [rad]; missing for not at all."""
    settings: Sequence[Setting] = ()
    """Places laid at this table."""

    @property
    def name(self) -> str:
        """Name of the object that carries."""
        return self.root.body.name


def homes_of(top: Top, groups: Sequence[Group]) -> dict[str, int]:
    """The region of every group that is wanted on one tier, by number.

    Raises:
        LayoutError: there is no such tier.
    """
    floors = [float(region.centre[2] - top.root.position[2]) for region in top.regions]
    homes: dict[str, int] = {}
    for group in groups:
        kind = top.wishes.tiers.get(group.name)
        if kind is None:
            continue
        wanted = [region.floor[2] for region in meant(kind, top.root.body.asset)]
        found = [at for at, floor in enumerate(floors) if any(abs(floor - one) < _SAME for one in wanted)]
        if not found:
            count = len(tiers(top.root.body.asset))
            raise LayoutError(
                f'"{group.name}" cannot be on the {kind.split("_")[1]} shelf of "{top.name}", which has '
                f"{count or 'no'} {'shelf' if count == 1 else 'shelves'}. Nothing was written."
            )
        homes[group.name] = next((at for at in found if low_enough(top, at, group)), found[0])
    return homes


def shares(
    top: Top, groups: Sequence[Group], laterals: Sequence[Lateral], homes: Mapping[str, int]
) -> list[list[Group]]:
    """Groups for every region: shelves share them out, elsewhere the best region takes all it can; `homes` are kept."""
    shares: list[list[Group]] = [[] for _ in top.regions]
    if not top.regions[0].enclosed and not homes:
        shares[0] = list(groups)
        return shares
    # Alike or related things stay together.
    cluster = {group.name: group.root.body.asset.noun for group in groups}
    for lat in laterals:
        if lat.child in cluster and lat.parent in cluster:
            old, new = cluster[lat.child], cluster[lat.parent]
            cluster = {name: new if label == old else label for name, label in cluster.items()}
    for one in top.wishes.formations:
        labels = {cluster[name] for name in one.names if name in cluster}
        cluster = {name: min(labels) if label in labels else label for name, label in cluster.items()}
    turn = itertools.cycle(range(len(top.regions) if top.regions[0].enclosed else 1))
    home = {cluster[name]: at for name, at in homes.items()}
    # Alike things may be wanted on different tiers.
    apart = {cluster[name] for name, at in homes.items() if home[cluster[name]] != at}
    for group in groups:
        if group.name in homes and cluster[group.name] in apart:
            shares[homes[group.name]].append(group)
            continue
        label = cluster[group.name]
        if label not in home:
            home[label] = next((k for k in itertools.islice(turn, len(top.regions)) if low_enough(top, k, group)), 0)
        shares[home[label]].append(group)
    return shares


def low_enough(top: Top, region: int, group: Group) -> bool:
    """Whether `group` is no higher than what is free above a region of `top`."""
    found = top.regions[region]
    return not found.enclosed or float(group.size[2]) + 3 * top.gap < found.height
