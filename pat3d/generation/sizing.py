"""Things of the size that their company asks for.

Trays as large as what they carry: nobody who says "a tray with a teapot and two cups" means a heap. And a spoon that is
long enough for the bowl across which it lies, or a bowl small enough for it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import place
from pat3d.layout.flat import Item
from pat3d.layout.frames import flat_regions
from pat3d.layout.spans import crossing
from pat3d.layout.surfaces import arrange_flat
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.asset import Asset

ENLARGED = frozenset({"tray", "cutting board"})
"""Nouns of things that are made in many sizes, to carry other things."""

FACTORS = (1.15, 1.3, 1.5)
"""Sizes that are tried, the smallest first, against the usual one."""

LONGER, SMALLER = (1.0, 1.1, 1.2, 1.3), (1.0, 0.9, 0.8, 0.7, 0.6)
"""Sizes of what lies across something, and of that, that are tried against the usual ones, the nearest first."""


def enlarged_trays(
    plan: ScenePlan, assets: Mapping[str, Asset], remake: Callable[[str, float], Asset]
) -> dict[str, tuple[Asset, float]]:
    """Larger assets, with their factors, for the trays of `plan` that are too small for what is on them side by side.

    A tray whose size the prompt names stays as it is, and so does one that the largest factor does not help.

    Args:
        plan: what is on what.
        assets: of every object.
        remake: makes the asset of an object again, larger by a factor.
    """
    found: dict[str, tuple[Asset, float]] = {}
    for obj in plan.objects:
        carried = [rel.child for rel in plan.relations if rel.kind == "on" and rel.parent == obj.name]
        sized = obj.scale != 1.0 or obj.extent is not None
        if obj.noun not in ENLARGED or sized or len(carried) < 2:
            continue
        loads = [assets[name] for name in carried]
        if _side_by_side(assets[obj.name], loads):
            continue
        for factor in FACTORS:
            larger = remake(obj.name, factor)
            if _side_by_side(larger, loads):
                found[obj.name] = larger, factor
                break
    return found


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


def _side_by_side(carrier: Asset, loads: Sequence[Asset]) -> bool:
    """Whether the loads' outlines fit the carrier's best surface, none over its edge."""
    region = flat_regions(place("carrier", carrier, Pose()))[0]
    items = [_outline(f"{number}", load) for number, load in enumerate(loads)]
    return arrange_flat(items, (), region.surface, overhang=False) is not None


def _outline(name: str, load: Asset) -> Item:
    half = np.array(load.size[:2]) / 2
    corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    return Item(
        name=name,
        low=-half,
        high=half,
        outline=corners,
        centre_of_mass=np.zeros(2),
        tall=float(load.size[2]),
        alike=load.noun,
    )
