"""On scene.json, assets, and whole folders that are consistent and false."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from benchmarks.attacks.deeds import Deed, dent, document, more, swap, text
from pat3d.exporters.formats import FORMATS, export
from pat3d.geometry.pose import Pose
from pat3d.scene.checksums import record_checksums
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Relation, Scene, SceneObject


def scene_of(change: Callable[[Scene], Scene | None]) -> Deed:
    """Another scene, written as whole as an honest one, with exports and checksums."""

    def deed(folder: Path) -> Any:
        changed = change(load_scene(folder))
        if changed is None:
            return False
        formats = [name for name in FORMATS if (folder / name).is_dir()]
        save_scene(changed, folder)
        export(changed, formats, folder)
        record_checksums(folder)
        return True

    return deed


def moved(*, by: tuple[float, float, float] = (0, 0, 0), which: int = -1) -> Callable[[Scene], Scene]:
    """The topmost object (or that number `which` from below) moved by `by` [m]."""

    def change(scene: Scene) -> Scene:
        free = sorted((obj for obj in scene.objects if not obj.fixed), key=lambda obj: obj.pose.position[2])
        return _with(scene, free[which], lambda pose: replace(pose, position=tuple(map(sum, zip(pose.position, by)))))  # noqa: B905

    return change


def turned(scene: Scene) -> Scene:
    """The topmost object tilted by three degrees."""
    free = max((obj for obj in scene.objects if not obj.fixed), key=lambda obj: obj.pose.position[2])
    half = 0.5 * 0.05236
    tilt = Pose(quat_wxyz=(1 - half**2 / 2, half, 0.0, 0.0)).rotation
    return _with(scene, free, lambda pose: Pose.from_matrix(tilt @ pose.rotation, pose.position))  # type: ignore[arg-type]


def _with(scene: Scene, which: SceneObject, change: Callable[[Pose], Pose]) -> Scene:
    objects = (replace(obj, pose=change(obj.pose)) if obj is which else obj for obj in scene.objects)
    return replace(scene, objects=tuple(objects))


def falsely_left(scene: Scene) -> Scene:
    """Two objects whose relation is the reverse of what is asked."""
    left, right = sorted(scene.objects, key=lambda obj: obj.pose.position[0])[:: len(scene.objects) - 1]
    return replace(scene, relations=(*scene.relations, Relation(child=right.name, kind="left_of", parent=left.name)))


def dented(scene: Scene) -> Scene:
    """A part that is not convex, in the scene itself."""
    obj = next(one for one in scene.objects if any(part.box is None for part in one.asset.parts))
    number = next(number for number, part in enumerate(obj.asset.parts) if part.box is None)
    part = obj.asset.parts[number]
    vertices = part.vertices.copy()
    vertices[0] = 0.9 * vertices.mean(axis=0) + 0.1 * vertices[0]
    parts = [*obj.asset.parts]
    parts[number] = replace(part, vertices=vertices)
    asset = replace(obj.asset, parts=tuple(parts))
    return replace(scene, objects=tuple(replace(o, asset=asset) if o.asset is obj.asset else o for o in scene.objects))


J = "scene.json"

EDITED: dict[str, Deed] = {
    "pose moved 1 mm": document(
        J, lambda d: d["objects"][0]["pose"]["position"].__setitem__(0, 0.001 + d["objects"][0]["pose"]["position"][0])
    ),
    "friction of a material": document(J, lambda d: next(iter(d["assets"].values()))["material"].update(friction=3.0)),
    "settling friction": document(J, lambda d: d.update(settling_friction=0.9)),
    "mass": document(J, lambda d: next(iter(d["assets"].values()))["mass_properties"].update(mass=0.01)),
    "fixed": document(J, lambda d: d["objects"][0].update(fixed=not d["objects"][0]["fixed"])),
    "relation dropped": document(J, lambda d: d["relations"].pop() if d["relations"] else False),
    "provenance": document(J, lambda d: d["provenance"].update(source="elsewhere")),
    "a checksum": document(J, lambda d: d["checksums"].pop(next(iter(d["checksums"])))),
}

ASSETS: dict[str, Deed] = {
    "visual swapped": swap("assets/*/visual.obj"),
    "texture swapped": swap("assets/*/texture.png"),
    "part not convex": dent("assets/*/parts/part_*.obj"),
    "part swapped": swap("assets/*/parts/part_*.obj"),
    "material library": text("assets/*/visual.mtl", "Kd 1 1 1", "Kd 0 0 0"),
    "a file more": more("assets/more.obj", "v 0 0 0\n"),
}

WHOLE: dict[str, Deed] = {
    "floats 0.5 mm": scene_of(moved(by=(0.0, 0.0, 0.0005))),
    "sunk 0.1 mm": scene_of(moved(by=(0.0, 0.0, -0.0001))),
    "sunk 2 mm": scene_of(moved(by=(0.0, 0.0, -0.002))),
    "0.3 m aside in the air": scene_of(moved(by=(0.3, 0.3, 0.1))),
    "tilted 3 degrees": scene_of(turned),
    "a relation that is false": scene_of(falsely_left),
    "a part that is not convex": scene_of(dented),
}
