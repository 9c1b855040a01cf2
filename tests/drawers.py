"""A cabinet with drawers, as it is laid out and as it comes to rest."""

from __future__ import annotations

from dataclasses import replace

from pat3d.assets.catalogue import make
from pat3d.layout.layout import arrange
from pat3d.scene.model import Relation, Scene, SceneObject
from pat3d.sim.model import ModelBuilder, poses_from_states
from pat3d.sim.settling import settle


def cabinet_scene(*drawers: str, scale: float = 1.0, inside: str = "", inside_scale: float = 1.0) -> Scene:
    """A cabinet with a drawer of each of the nouns `drawers`, the first of which holds `inside`."""
    rows = ("top", "middle", "bottom")[: len(drawers)]
    assets = {"cabinet": make("drawer cabinet", scale=scale, adjectives=rows)}
    assets |= {f"drawer {at}": make(noun, scale=scale) for at, noun in enumerate(drawers)}
    relations = [Relation(child=name, kind="in", parent="cabinet") for name in assets if name != "cabinet"]
    if inside:
        assets[inside] = make(inside, scale=inside_scale)
        relations.append(Relation(child=inside, kind="in", parent="drawer 0"))
    layout = arrange(assets, tuple(relations), seed=0)
    objects = (SceneObject(name=name, asset=one, pose=layout.poses[name], initial_pose=layout.poses[name])
               for name, one in assets.items())  # fmt: skip
    return Scene(objects=tuple(objects), relations=tuple(relations))


def at_rest(scene: Scene) -> Scene:
    """`scene` once it has settled."""
    builder = ModelBuilder()
    builder.add_scene(scene)
    model = builder.finalize("cpu")
    settled = settle(model)
    assert settled.at_rest.all()
    poses = poses_from_states(model, settled.q)
    objects = (replace(obj, pose=pose) for obj, pose in zip(scene.objects, poses, strict=True))
    return replace(scene, objects=tuple(objects))
