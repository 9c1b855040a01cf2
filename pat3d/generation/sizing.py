"""Trays as large as what they carry asks for: nobody who says "a tray with a teapot and two cups" means a heap."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import place
from pat3d.layout.flat import Item
from pat3d.layout.frames import flat_regions
from pat3d.layout.surfaces import arrange_flat
from pat3d.plan.scene_plan import ScenePlan
from pat3d.scene.asset import Asset

ENLARGED = frozenset({"tray", "cutting board"})
"""Nouns of things that are made in many sizes, to carry other things."""

FACTORS = (1.15, 1.3, 1.5)
"""Sizes that are tried, the smallest first, against the usual one."""


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
