"""Furniture with a door that turns, as it is laid out."""

from __future__ import annotations

from pat3d.assets.catalogue import make
from pat3d.layout.layout import arrange
from pat3d.scene.model import Relation, Scene, SceneObject


def door_scene(of: str, state: str = "", *, scale: float = 1.0, inside: str = "") -> Scene:
    """`of` (microwave, cabinet, fridge) with its door, `state` "open " or none, with `inside` in it."""
    assets = {of: make(f"hinged {of}", scale=scale), "door": make(f"{state}hinged {of} door", scale=scale)}
    relations = [Relation(child="door", kind="in", parent=of)]
    if inside:
        assets[inside] = make(inside)
        relations.append(Relation(child=inside, kind="in", parent=of))
    layout = arrange(assets, tuple(relations), seed=0)
    objects = (SceneObject(name=name, asset=one, pose=layout.poses[name], initial_pose=layout.poses[name])
               for name, one in assets.items())  # fmt: skip
    return Scene(objects=tuple(objects), relations=tuple(relations))
