"""A picture, measured, becomes assets at poses: gravity, a fit of every object, and what stands on what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pat3d.assets.library.store import scaled
from pat3d.errors import LayoutError
from pat3d.layout.bodies import Body, Placed
from pat3d.progress import Event, Progress, silent
from pat3d.scene.asset import Asset
from pat3d.scene.model import Relation
from pat3d.vision.borders import border_lost, bordered
from pat3d.vision.camera import PlacedCamera
from pat3d.vision.caster import Caster, Placement
from pat3d.vision.dependencies import Judge, Pair, close_pairs, joined
from pat3d.vision.fitting import STOOD_LOSS, Fit, fit, stood
from pat3d.vision.gravity import Plane, ground_plane, level_camera, surface_plane
from pat3d.vision.observation import Observation
from pat3d.vision.occlusion import least_occluded
from pat3d.vision.placing import from_the_ground
from pat3d.vision.stance import Stance
from pat3d.vision.supports import carried_at, supports

POOR = 1.0
"""Cost of a fit from which on a note says so."""
LEAST_SURFACE = 0.5
"""Of a carrier's pixels, those that have to lie in one plane for it to tell what is level."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Recovered:
    """What a picture shows."""

    camera: PlacedCamera
    """In the scene's frame: z up, the ground at 0, the viewer at -y."""
    assets: Mapping[str, Asset]
    """As they were given, before scaling."""
    fits: Mapping[str, Fit]
    relations: tuple[Relation, ...]
    """The scene tree."""
    notes: tuple[str, ...] = ()
    """What the picture left open."""

    def sized(self, name: str) -> Asset:
        """The asset of object `name` at its fitted size."""
        return scaled(self.assets[name], self.fits[name].placed.scale)

    def bodies(self) -> dict[str, Placed]:
        """Every object where it was fitted."""
        return {name: _body(name, self.assets[name], one.placed) for name, one in self.fits.items()}

    def resized(self, sizes: Mapping[str, float], seen: Observation, *, said: str | None = None) -> Recovered:
        """The same scene larger or smaller, so that the least occluded object of `sizes` has its size.

        Depth that is right up to a factor leaves all lengths open by that factor, and nothing else.

        Args:
            sizes: longest sides [m] of some objects.
            seen: the picture it was recovered from.
            said: name of the object that somebody says is occluded least.
        """
        name, by = least_occluded(self, seen, sizes, said)
        factor = sizes[name] / float(self.sized(name).size.max())
        fits = {
            each: replace(
                one,
                placed=replace(
                    one.placed, scale=factor * one.placed.scale, position=factor * np.asarray(one.placed.position)
                ),
            )
            for each, one in self.fits.items()
        }
        note = f'all lengths follow from the size of "{name}", {sizes[name]:g} m, the least occluded object ({by}).'
        camera = replace(self.camera, position=factor * self.camera.position)
        return replace(self, camera=camera, fits=fits, notes=(*self.notes, note))


def recover(
    seen: Observation,
    assets: Mapping[str, Asset],
    *,
    stances: Mapping[str, Stance] | None = None,
    judge: Judge | None = None,
    progress: Progress = silent,
) -> Recovered:
    """Where the objects of a picture are.

    Args:
        seen: the picture with depth and masks.
        assets: what the masks show, by name; of any size.
        stances: how objects stand, where somebody says so.
        judge: says what carries what, before the fitted surfaces do.
        progress: told of every object.

    Raises:
        LayoutError: nothing in the picture tells what is level.
        ModelError: `judge` gives no valid answer.
    """
    said = stances or {}
    lost = border_lost(seen)
    seen = bordered(seen, lost)
    camera, notes = _camera(seen, assets)
    if lost:
        notes.append(f"the masks end early, by {lost} px, as the depth beside them shows; they are grown.")
    casters = {name: Caster(assets[name].visual) for name in seen.names}
    fits: dict[str, Fit] = {}
    for number, name in enumerate(seen.names):
        progress(Event(stage="fitting", detail=name, step=number, steps=len(seen.names)))
        fits[name] = fit(seen, camera, name, casters[name], stance=said.get(name, Stance()))
    slack = seen.noise * float(camera.position[2])
    bodies = {name: _body(name, assets[name], one.placed) for name, one in fits.items()}
    relations = supports(bodies, slack=slack)
    judged: Mapping[Pair, Relation | None] = {}
    if judge is not None:
        progress(Event(stage="asking what stands on what"))
        judged = judge.judge(seen, close_pairs(bodies))
        relations, _ = joined(relations, judged)
    for name in from_the_ground(seen.names, relations):
        relation = next((one for one in relations if one.child == name), None)
        if relation is not None and relation.kind == "in":
            continue
        base = 0.0 if relation is None else carried_at(bodies[name], bodies[relation.parent], slack)
        progress(Event(stage="standing on what carries it", detail=name))
        lower = stood(seen, camera, name, casters[name], fits[name], base)
        # Otherwise it stands on something else, which is hidden, or the asset is not what is seen.
        if lower.cost < fits[name].cost + STOOD_LOSS:
            fits[name] = lower
            bodies[name] = _body(name, assets[name], lower.placed)
    relations, differences = joined(supports(bodies, slack=slack), judged)
    notes += differences
    notes += [
        f'"{name}" is explained poorly by "{assets[name].noun}" (cost {one.cost:.2f}, overlap {one.overlap:.0%}).'
        for name, one in fits.items()
        if one.cost > POOR
    ]
    return Recovered(camera=camera, assets=assets, fits=fits, relations=relations, notes=tuple(notes))


def _camera(seen: Observation, assets: Mapping[str, Asset]) -> tuple[PlacedCamera, list[str]]:
    """The camera over the ground; where none is seen, over the widest surface, at that asset's own height."""
    plane = ground_plane(seen)
    if plane is not None:
        return level_camera(seen, plane), []
    found: list[tuple[float, str, Plane]] = []
    for name in seen.names:
        plane = surface_plane(seen, name)
        if plane is not None and plane.share >= LEAST_SURFACE:
            found.append((plane.share * float(seen.mask(name).sum()), name, plane))
    if not found:
        raise LayoutError(
            "nothing in the picture tells what is level: neither the ground nor the top of a table is seen as a plane "
            "under the objects. Is the depth metric, and do the masks leave the ground free?"
        )
    _, name, plane = max(found, key=lambda one: one[0])
    height = float(assets[name].size[2])
    note = f'the ground is not seen; the top of "{name}" is taken to be {height:.2f} m above it, as its asset is.'
    return level_camera(seen, plane, beneath=height), [note]


def _body(name: str, asset: Asset, placed: Placement) -> Placed:
    return Body(name, scaled(asset, placed.scale)).at(placed.rotation, placed.position)
