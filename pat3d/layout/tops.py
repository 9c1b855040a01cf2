"""Spreading groups over the tops (seats, shelves, boards, heads) of the object that carries them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.polygons import outline
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.balance import support_margin
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.containers import Column, lower, pack
from pat3d.layout.doors import swept
from pat3d.layout.drawers import ways_out
from pat3d.layout.flat import Item, Lateral, Spot, Surface
from pat3d.layout.formations import Wishes
from pat3d.layout.frames import FlatRegion
from pat3d.layout.group import Group
from pat3d.layout.loosening import loosen
from pat3d.layout.places import pins
from pat3d.layout.refusals import largest_formation, no_room
from pat3d.layout.shares import Top, homes_of, shares
from pat3d.layout.surfaces import arrange_flat

_ROOMY = 2.0
"""Surfaces this many times as long and wide as a thing alone on them have it anywhere."""
_LEVEL = 1e-3
"""By how much a thing may stand higher or lower where it was moved [m]."""
JITTER = 0.015
"""Offset of stacked things, as a share of their size."""

_EDGE = 0.03
"""Left free of what moves at the edges of a surface that it would cover [m]."""
_WALLED = frozenset(
    {"bed", "sofa", "couch", "bookshelf", "bookcase", "shelf", "wardrobe", "dresser", "cabinet", "desk", "piano"}
    | {"bedside table", "nightstand", "armchair", "filing cabinet", "floor lamp", "mirror"}
)
"""Nouns that stand with their backs in one line."""


def spread(
    top: Top, groups: Sequence[Group], laterals: Sequence[Lateral], rng: np.random.Generator
) -> tuple[list[Group], list[str]]:
    """Place `groups` on the regions of `top`; returns them placed, and notes.

    Raises:
        LayoutError: there is no free space.
    """
    cornered = next((name for name, kind in top.wishes.places.items() if kind == "in_corner"), None)
    if cornered is not None and all(region.surface.disc for region in top.regions):
        raise LayoutError(
            f'"{cornered}" cannot be in a corner of "{top.name}", which is round; "at_edge" would do. '
            "Nothing was written."
        )
    placed: list[Group] = []
    notes: list[str] = []
    homes = homes_of(top, groups)
    waiting = shares(top, groups, laterals, homes)
    overflow: list[Group] = []
    for region, share in zip(top.regions, waiting, strict=True):
        found, overflow = _as_many(top, region, [*overflow, *share], laterals, placed, rng, notes)
        placed.extend(found)
        astray = next((group for group in overflow if group.name in homes), None)
        if astray is not None:
            which = top.wishes.tiers[astray.name].split("_")[1]
            before = [group.name for group in (*top.given, *found)]
            raise no_room(astray, f"the {which} shelf of {top.name}", region, before, None)
    held = {lat.child for lat in laterals} | {lat.parent for lat in laterals} | top.wishes.names
    if overflow or not all(_carried(top, group, placed) for group in placed):
        piled = None if any(group.name in held for group in groups) else _pile(top, groups, rng)
        if piled is not None:
            placed = piled
            if overflow:
                notes.append(f'"{top.name}" is too small for all that is on it side by side: it is piled up.')
        elif overflow:
            before = [group.name for group in (*top.given, *placed)]
            most = largest_formation(top.wishes, groups, laterals, lambda *less: _fits(top, *less))
            raise no_room(overflow[0], top.name, top.regions[0], before, most)
        else:
            notes.extend(
                f'"{group.name}" may tip or fall off "{top.name}".'
                for group in placed
                if not _carried(top, group, placed) and not any(f'"{group.name}"' in note for note in notes)
            )
    order = {group.name: k for k, group in enumerate(groups)}
    return sorted(placed, key=lambda group: order[group.name]), notes


def item_of(group: Group, *, turnable: bool, on: Surface | None = None) -> Item:
    """The outline of `group` from above, relative to its origin.

    What drawers and doors take up when they move is of it, as far as the surface `on` has room: beyond it is air.
    """
    origin = group.root.position[:2]
    body = np.concatenate([member.vertices[:, :2] for member in group.members])
    ways = [*ways_out(group.members), *swept(group.members)]
    if on is not None and on.limited:
        least, most = body.min(axis=0), body.max(axis=0)
        spare = np.maximum(2 * np.array(on.half_size) - (most - least) - 2 * _EDGE, 0.0)
        ways = [np.clip(way, least - spare, most + spare) for way in ways]
    points = np.concatenate([body, *ways])
    low, high = points.min(axis=0), points.max(axis=0)
    noun = group.root.body.asset.noun
    return Item(
        name=group.name,
        low=low - origin,
        high=high - origin,
        outline=outline(points) - origin,
        centre_of_mass=group.centre_of_mass[:2] - origin,
        tall=float(group.size[2]),
        alike=noun,
        turnable=turnable,
        walled=not _WALLED.isdisjoint({noun, *noun.split()}),
        middle=((group.root.low + group.root.high) / 2)[:2] - origin,
    )


def _carried(top: Top, group: Group, placed: Sequence[Group]) -> bool:
    """Whether a placed group rests on something and its centre of mass is not beside that."""
    others = [member for other in placed if other is not group for member in other.members]
    if group.low[2] <= top.root.low[2] + 2 * top.gap:
        return False
    if group.name in top.leaning:
        return True
    return support_margin(group, [*top.supports, *others], gap=top.gap) > -0.05 * float(group.size[:2].max())


def _pile(top: Top, groups: Sequence[Group], rng: np.random.Generator) -> list[Group] | None:
    """All groups heaped on the best region, each where it does not tip, or None."""
    region = top.regions[0]
    column = Column(
        centre=region.centre,
        half_size=np.minimum(np.array(region.surface.half_size), 1e3),
        yaw=0.0,
        disc=region.surface.disc,
        height=region.height if region.enclosed else 1.3 * max(float(group.size[2]) for group in groups),
        capped=region.enclosed,
    )
    obstacles = [*top.supports[1:], *(member for group in top.given for member in group.members)]
    try:
        return pack(top.root, column, groups, obstacles=obstacles, rng=rng, gap=top.gap, steady=True)
    except LayoutError:
        return None


def _as_many(
    top: Top,
    region: FlatRegion,
    share: Sequence[Group],
    laterals: Sequence[Lateral],
    before: Sequence[Group],
    rng: np.random.Generator,
    notes: list[str],
) -> tuple[list[Group], list[Group]]:
    """As many of `share`, from its beginning, as fit on one region, placed; and the rest."""
    best: list[Group] = []
    said: list[str] = []
    cuts = _cuts(top, share, laterals)
    fit, beyond = 0, len(cuts)
    tried = len(cuts) - 1
    while fit < tried:
        remarks: list[str] = []
        found = _on_region(top, region, share[: cuts[tried]], laterals, before, rng, remarks)
        if found is None:
            beyond = tried
        else:
            best, said, fit = found, remarks, tried
        # By halving: of twenty that do not fit together, five shares are tried, not twenty.
        tried = (fit + beyond) // 2
    notes.extend(said)
    return best, list(share[cuts[fit] :])


def _fits(top: Top, wishes: Wishes, groups: Sequence[Group], laterals: Sequence[Lateral]) -> bool:
    """Whether `groups` fit one of the regions together."""
    less, rng = replace(top, wishes=wishes), np.random.default_rng(0)
    return any(_on_region(less, region, groups, laterals, (), rng, []) is not None for region in top.regions)


def _cuts(top: Top, share: Sequence[Group], laterals: Sequence[Lateral]) -> list[int]:
    """Where `share` may be parted among tiers: no row is, nor what stands beside another thing."""
    if len(top.regions) == 1:
        return list(range(len(share) + 1))
    ties = [{lat.child, lat.parent} for lat in laterals] + [set(one.names) for one in top.wishes.formations]
    names = [group.name for group in share]
    return [
        at for at in range(len(share) + 1)
        if all(tie.isdisjoint(names[:at]) or tie.isdisjoint(names[at:]) for tie in ties)
    ]  # fmt: skip


def _on_region(
    top: Top,
    region: FlatRegion,
    share: Sequence[Group],
    laterals: Sequence[Lateral],
    before: Sequence[Group],
    rng: np.random.Generator,
    notes: list[str],
) -> list[Group] | None:
    """All of `share` on one region, or None where they do not fit."""
    if region.enclosed and any(group.size[2] + 3 * top.gap >= region.height for group in share):
        return None
    names = {group.name for group in (*top.given, *share)}
    if any(not names.isdisjoint(one.names) and not names.issuperset(one.names) for one in top.wishes.formations):
        # A row is not parted.
        return None
    laterals = [lat for lat in laterals if {lat.child, lat.parent} <= names]
    obstacles = [*top.supports, *(member for group in before for member in group.members)]
    if len(share) == 1 and not top.given and share[0].name not in top.wishes.places:
        alone = _alone(top, region, share[0], obstacles, rng, notes)
        return None if alone is None else [_somewhere(top, region, share[0], alone, obstacles, rng)]
    items = [item_of(group, turnable=group.name in top.turnable, on=region.surface) for group in share]
    pinned = {group.name: group.root.position[:2] - region.centre[:2] for group in top.given}
    every = [*(item_of(group, turnable=False) for group in top.given), *items]
    pinned |= {name: at for one in top.settings for name, at in one.origins.items() if name in names}
    homes = {one.formation.members[0]: one.home for one in top.settings}
    own = top.wishes.among(names)
    laid = replace(own, formations=(*own.formations, *(one.formation for one in top.settings)))
    wishes, spots = laid, _packed(top, region, every, items, laid, laterals, pinned, rng)
    if spots is None and top.settings:
        wishes, spots, homes = own, _packed(top, region, every, items, own, laterals, pinned, rng), {}
    if spots is None:
        return None
    loose = loosen(every, spots, laterals, region.surface, wishes, turns=top.turns, rng=rng, held=pinned, homes=homes)
    packed = _put(top, region, share, {name: (spot, 0.0) for name, spot in spots.items()}, obstacles)
    ways = {name: (Spot(position=one.position), one.turn) for name, one in loose.items()}
    freely = _put(top, region, share, ways, obstacles)
    return freely if _as_good(top, freely, packed) else packed


def _packed(
    top: Top,
    region: FlatRegion,
    every: Sequence[Item],
    items: Sequence[Item],
    wishes: Wishes,
    laterals: Sequence[Lateral],
    pinned: Mapping[str, Array],
    rng: np.random.Generator,
) -> dict[str, Spot] | None:
    ways = pins(wishes, items, laterals, region.surface, rng) if wishes.places else [{}]
    found = (arrange_flat(every, laterals, region.surface, pinned={**pinned, **way}, wishes=wishes) for way in ways)
    return next((one for one in found if one is not None), None)


def _put(
    top: Top,
    region: FlatRegion,
    share: Sequence[Group],
    spots: Mapping[str, tuple[Spot, float]],
    obstacles: Sequence[Placed],
) -> list[Group] | None:
    """All of `share` set down at its spots and turned [rad], or None where something is in the way."""
    placed: list[Group] = []
    standing = list(obstacles)
    for group in share:
        spot, turn = spots[group.name]
        angle = math.pi / 2 if spot.quarter else turn
        turned = group.turned(yaw_matrix(angle)) if angle else group
        found = _set_down(top, region, turned, region.centre[:2] + spot.position, standing)
        if found is None:
            return None
        placed.append(found)
        standing.extend(found.members)
    return placed


def _as_good(top: Top, freely: list[Group] | None, packed: list[Group] | None) -> bool:
    """Whether things stand as high and as safely where they were moved as where they were packed."""
    if freely is None or packed is None:
        return packed is None
    level = all(abs(float(a.low[2] - b.low[2])) < _LEVEL for a, b in zip(freely, packed, strict=True))
    return level and all(
        _carried(top, one, freely) or not _carried(top, other, packed)
        for one, other in zip(freely, packed, strict=True)
    )


def _alone(
    top: Top, region: FlatRegion, group: Group, obstacles: list[Placed], rng: np.random.Generator, notes: list[str]
) -> Group | None:
    """One group in the middle of a region, or at the nearest place where it does not tip."""
    base = _base_centre(group)
    middle = _middle(top.root, region) - base
    size = float(group.size[:2].max())
    straight = _set_down(top, region, group, middle, obstacles)
    shaken = _set_down(top, region, group, middle + JITTER * size * rng.uniform(-1, 1, 2), obstacles)
    options = [found for found in (shaken, straight) if found is not None]
    if straight is not None and shaken is not None and shaken.low[2] > straight.low[2] + 1e-3:
        # Nested things sit deepest in the middle.
        options.reverse()
    for found in options:
        if support_margin(found, obstacles, gap=top.gap) > 0.0:
            return found
    best: tuple[float, Group] | None = None
    reach = 0.6 * np.minimum(np.array(region.surface.half_size), 2 * size)
    steps = [np.array([i, j]) / 3.0 for i in range(-3, 4) for j in range(-3, 4) if i * i + j * j <= 10]
    for step in sorted(steps, key=lambda step: float(step @ step)):
        found = _set_down(top, region, group, middle + step * reach, obstacles)
        if found is None:
            continue
        margin = support_margin(found, obstacles, gap=top.gap)
        if margin > 0.02 * size:
            return found
        if best is None or margin > best[0]:
            best = margin, found
    if best is not None:
        chosen = options[0] if options and best[0] < 0.0 else best[1]
        notes.append(f'"{group.name}" may tip or roll on "{top.name}".')
        return chosen
    return options[0] if options else None


def _somewhere(
    top: Top, region: FlatRegion, group: Group, alone: Group, obstacles: list[Placed], rng: np.random.Generator
) -> Group:
    """One group on a large surface away from the middle and turned, or `alone` as it is."""
    room = 2 * np.array(region.surface.half_size)
    if region.enclosed or np.any(room < _ROOMY * float(group.size[:2].max())):
        return alone
    item = item_of(group, turnable=False)
    spots = {group.name: Spot(position=alone.root.position[:2] - region.centre[:2])}
    loose = loosen([item], spots, (), region.surface, top.wishes, turns=top.turns, rng=rng)[group.name]
    found = _put(top, region, [group], {group.name: (Spot(position=loose.position), loose.turn)}, obstacles)
    return found[0] if found is not None and _as_good(top, found, [alone]) else alone


def _set_down(top: Top, region: FlatRegion, group: Group, xy: Array, obstacles: Sequence[Placed]) -> Group | None:
    spot = np.array([*xy, region.centre[2] - float(group.low[2]) + top.gap])
    found = lower(group, spot, obstacles, floor=float(top.root.low[2]), gap=top.gap)
    if found is None or (region.enclosed and found.high[2] > region.centre[2] + region.height):
        return None
    return found


def _middle(root: Placed, region: FlatRegion) -> Array:
    """Middle of the region [m], shape (2,); of the rim where it is the top of a box around handle and all."""
    if region.centre[2] < root.high[2] - 1e-6:
        return region.centre[:2]
    rim = root.vertices[root.vertices[:, 2] > root.high[2] - 0.002, :2]
    return (rim.min(axis=0) + rim.max(axis=0)) / 2


def _base_centre(group: Group) -> Array:
    """Middle of what the root stands on [m], shape (2,)."""
    vertices = group.root.vertices
    foot = vertices[vertices[:, 2] < group.root.low[2] + 0.002, :2]
    return (foot.min(axis=0) + foot.max(axis=0)) / 2
