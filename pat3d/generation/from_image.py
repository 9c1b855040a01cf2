"""A picture's objects as a request: their assets at the sizes that were seen, at poses where nothing touches."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pat3d.generation.request import SceneRequest, UnplacedObject
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene, SceneObject
from pat3d.vision.placing import placed_apart
from pat3d.vision.recover import Recovered


def raw_layout(found: Recovered, *, prompt: str) -> Scene:
    """The objects of a picture exactly where they were fitted: they may intersect, float and sink into the ground."""
    poses = {name: Pose.from_matrix(one.placed.rotation, one.placed.position) for name, one in found.fits.items()}
    return Scene(
        objects=tuple(
            SceneObject(name=name, asset=found.sized(name), pose=pose, initial_pose=pose)
            for name, pose in poses.items()
        ),
        relations=found.relations,
        prompt=prompt,
    )


def request_of_recovered(
    found: Recovered, *, prompt: str, phrases: Mapping[str, str] | None = None, record: Mapping[str, Any] | None = None
) -> SceneRequest:
    """What `found` asks for; from here on a picture's scene is made like any other.

    Args:
        found: what the picture shows.
        prompt: what was said besides; may be empty.
        phrases: the words for each object, by name.
        record: what the report says of the picture; JSON-serialisable.

    Raises:
        LayoutError: an object finds no room near where it was seen.
    """
    poses, notes = placed_apart(found.bodies(), found.relations)
    names = tuple(found.fits)
    said = phrases or {}
    objects = tuple(
        UnplacedObject(name=name, asset=found.sized(name), phrase=said.get(name, ""), pose=poses[name])
        for name in names
    )
    placed = [
        [one.name, one.asset.noun, dict(one.asset.provenance), found.fits[one.name].placed.scale,
         list(poses[one.name].position), list(poses[one.name].quat_wxyz)]
        for one in objects
    ]  # fmt: skip
    fits = {
        name: {
            "scale": one.placed.scale,
            "cost": one.cost,
            "overlap": one.overlap,
            "upright": not one.tilted,
        }
        for name, one in found.fits.items()
    }
    return SceneRequest(
        prompt=prompt,
        names=names,
        relations=found.relations,
        fingerprint=["image", placed, [[rel.child, rel.kind, rel.parent] for rel in found.relations]],
        make_objects=lambda seed, progress: objects,
        adjustable=False,
        record={**(record or {}), "fits": fits, "notes": [*found.notes, *notes]},
        provenance={
            "source": "image",
            "camera": {
                "position": found.camera.position.tolist(),
                "rotation": found.camera.rotation.tolist(),
                "fx": found.camera.pinhole.fx,
                "fy": found.camera.pinhole.fy,
                "cx": found.camera.pinhole.cx,
                "cy": found.camera.pinhole.cy,
                "width": found.camera.pinhole.width,
                "height": found.camera.pinhole.height,
            },
        },
    )
