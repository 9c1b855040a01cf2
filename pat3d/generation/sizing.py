"""Things of the size that their company asks for.

Trays as large as what they carry: nobody who says "a tray with a teapot and two cups" means a heap. And a spoon that is
long enough for the bowl across which it lies, or a bowl small enough for it. And hooks as high as what hangs on them is
long. And lids as wide as the rims that they are on.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import place
from pat3d.layout.flat import Lateral
from pat3d.layout.frames import flat_regions
from pat3d.layout.group import Group
from pat3d.layout.hanging import reach_below
from pat3d.layout.hooked import CLEARANCE
from pat3d.layout.intents import Intents
from pat3d.layout.places import pins
from pat3d.layout.spans import crossing
from pat3d.layout.surfaces import arrange_flat
from pat3d.layout.tops import item_of
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.asset import Asset
from pat3d.scene.relations import GROUND

ENLARGED = frozenset({"tray", "cutting board"})
"""Nouns of things that are made in many sizes, to carry other things."""

FACTORS = (1.15, 1.3, 1.5, 1.7)
"""Sizes that are tried, the smallest first, against the usual one."""
GAP = 0.002
"""What things keep from what carries them [m]."""

TALLER = (1.25, 1.5, 1.75, 2.0, 2.5)
"""Sizes of what has hooks that are tried against the usual one, the smallest first."""

_LAP = 0.004
"""How far the edge of a lid reaches over the opening [m]; half of it is enough."""
_DWARFED = 1.35
"""Radius of a lid over that of the opening from which on it is made smaller."""
_RIM = 5e-4
"""Height within which the points of a rim are [m]."""

LONGER, SMALLER = (1.0, 1.1, 1.2, 1.3), (1.0, 0.9, 0.8, 0.7, 0.6)
"""Sizes of what lies across something, and of that, that are tried against the usual ones, the nearest first."""


def enlarged_trays(
    plan: ScenePlan, assets: Mapping[str, Asset], remake: Callable[[str, float], Asset]
) -> dict[str, tuple[Asset, float]]:
    """Larger assets, with their factors, for the trays of `plan` that are too small for what is on them side by side.

    A tray whose size the prompt names stays as it is, and so does one that the largest factor does not help, unless
    what is on it is arranged.

    Args:
        plan: what is on what.
        assets: of every object.
        remake: makes the asset of an object again, larger by a factor.
    """
    found: dict[str, tuple[Asset, float]] = {}
    for obj in plan.objects:
        sized = obj.scale != 1.0 or obj.extent is not None
        if obj.noun not in ENLARGED or sized or len(_on(plan, obj.name)) < 2 or _side_by_side(plan, obj.name, assets):
            continue
        for factor in FACTORS:
            larger = remake(obj.name, factor)
            if _side_by_side(plan, obj.name, {**assets, obj.name: larger}):
                found[obj.name] = larger, factor
                break
        else:
            if any(set(one.names) & set(_on(plan, obj.name)) for one in plan.held()):
                # The refusal, if there is one, then tells how many would fit the largest.
                found[obj.name] = remake(obj.name, FACTORS[-1]), FACTORS[-1]
    return found


def high_hooks(
    plan: ScenePlan, assets: Mapping[str, Asset], remake: Callable[[str, float], Asset]
) -> dict[str, tuple[Asset, float]]:
    """Larger assets, with their factors, for what has hooks of `plan` that are too low for what hangs on them.

    What the prompt gives a size stays as it is. Arguments as for `enlarged_trays`.
    """
    found: dict[str, tuple[Asset, float]] = {}
    for obj in plan.objects:
        hung = [rel.child for rel in plan.relations if rel.kind == "hangs_from" and rel.parent == obj.name]
        if not hung or not assets[obj.name].hooks or obj.scale != 1.0 or obj.extent is not None:
            continue
        long = CLEARANCE + GAP + max(reach_below(assets[name]) for name in hung)
        if long < _seat(assets[obj.name]):
            continue
        for factor in TALLER:
            larger = remake(obj.name, factor)
            if long < _seat(larger):
                found[obj.name] = larger, factor
                break
    return found


def fitting_lids(
    plan: ScenePlan, assets: Mapping[str, Asset], remake: Callable[[str, float], Asset]
) -> dict[str, tuple[Asset, float]]:
    """Lids of `plan`, with their factors, for those that would fall into the round vessels they are on, or dwarf them.

    What the prompt gives a size stays as it is. Arguments as for `enlarged_trays`.
    """
    found: dict[str, tuple[Asset, float]] = {}
    for obj in plan.objects:
        vessel = next((rel.parent for rel in plan.relations if rel.kind == "on" and rel.child == obj.name), GROUND)
        if obj.noun != "lid" or vessel == GROUND or obj.scale != 1.0 or obj.extent is not None:
            continue
        mouth = _mouth(assets[vessel])
        radius = float(np.hypot(*assets[obj.name].visual.vertices[:, :2].T).max())
        if mouth and not mouth + _LAP / 2 <= radius <= _DWARFED * mouth:
            factor = round((mouth + _LAP) / radius, 2)
            found[obj.name] = remake(obj.name, factor), factor
    return found


def _mouth(asset: Asset) -> float:
    """Radius of the round opening of `asset` at its rim [m]; 0 where it has none."""
    inside = next((region for region in asset.regions if (region.kind, region.shape) == ("in", "disc")), None)
    if inside is None or not math.isfinite(inside.height):
        return 0.0
    away = asset.visual.vertices - np.array(inside.floor)
    rim = away[np.abs(away[:, 2] - inside.height) < _RIM]
    return float(np.hypot(rim[:, 0], rim[:, 1]).min()) if len(rim) else 0.0


def _seat(asset: Asset) -> float:
    """Height of the highest hooks of `asset` [m]."""
    return max(hook.seat[2] for hook in asset.hooks)


def crossings(
    plan: ScenePlan, assets: Mapping[str, Asset], remake: Callable[[str, float], Asset]
) -> dict[str, tuple[Asset, float]]:
    """Assets of other sizes, with their factors, for what lies across one thing of `plan` and is too short to rest so.

    What the prompt gives a size, and a carrier that carries something else too, stay as they are. Arguments as for
    `enlarged_trays`.
    """
    planned = {obj.name: obj for obj in plan.objects}
    found: dict[str, tuple[Asset, float]] = {}

    def factors(name: str, tried: Sequence[float]) -> Sequence[float]:
        obj = planned[name]
        return tried if obj.scale == 1.0 and obj.extent is None and name not in found else (1.0,)

    for one in plan.held():
        if one.kind != "across" or len(one.of) != 1:
            continue
        name, carrier = one.objects[0], one.of[0]
        alone = [rel.child for rel in plan.relations if rel.supports and rel.parent == carrier] == [name]
        pairs = itertools.product(factors(name, LONGER), factors(carrier, SMALLER) if alone else (1.0,))
        for longer, smaller in sorted(pairs, key=lambda pair: math.log(pair[0]) - math.log(pair[1])):
            made = {
                each: (assets[each] if factor == 1.0 else remake(each, factor), factor)
                for each, factor in ((name, longer), (carrier, smaller))
            }
            if crossing(*(place(each, asset, Pose()) for each, (asset, _) in made.items())) is not None:
                found |= {each: sized for each, sized in made.items() if sized[1] != 1.0}
                break
    return found


def _side_by_side(plan: ScenePlan, carrier: str, assets: Mapping[str, Asset]) -> bool:
    """Whether all that is on `carrier` fits its best surface as the plan has it, none over its edge."""
    region = flat_regions(place(carrier, assets[carrier], Pose()))[0]
    names = _on(plan, carrier)
    groups = {name: Group((place(name, assets[name], Pose()),)) for name in names}
    laterals = [
        Lateral(child=rel.child, kind=rel.kind, parent=rel.parent)
        for rel in plan.relations
        if not rel.supports and {rel.child, rel.parent} <= set(names)
    ]
    intents = Intents(
        [one for one in plan.held() if {*one.objects, *one.of} - {carrier} <= set(names)],
        lambda name: [carrier, GROUND] if name == carrier else [name, carrier, GROUND],
        dict.fromkeys(names, "on"),
        {carrier: laterals},
        {},
    )
    try:
        wishes = intents.wishes(carrier, groups, lambda name: groups[name], GAP)
    except LayoutError:
        return False
    items = [item_of(group, turnable=True) for group in groups.values()]
    pinned = pins(wishes, items, laterals, region.surface, np.random.default_rng(0)) if wishes.places else [{}]
    return any(
        arrange_flat(items, laterals, region.surface, pinned=way, wishes=wishes, overhang=False) is not None
        for way in pinned
    )


def _on(plan: ScenePlan, carrier: str) -> list[str]:
    return [rel.child for rel in plan.relations if rel.kind == "on" and rel.parent == carrier]
