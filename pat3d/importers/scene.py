"""A scene, or one object, of somebody else's file as a Scene: found, read, weighed, put on the ground."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from pat3d.errors import AssetError, SpecError
from pat3d.geometry.pose import Pose
from pat3d.importers.assets import ImportedAsset, asset_of, content_of
from pat3d.importers.model import ImportedObject, ImportedScene
from pat3d.progress import CpuBudget, Event, Progress, silent
from pat3d.scene.asset import Asset
from pat3d.scene.model import Attachment, Scene, SceneObject
from pat3d.scene.naming import unique_slugs
from pat3d.scene.versions import versions

Joints = Literal["refuse", "fix", "leave-out"]
JOINTS: tuple[Joints, ...] = ("refuse", "fix", "leave-out")
"""What becomes of what has joints: the scene is refused, or it stands still where it is, or is left out."""

FORMATS = {
    ".xml": "mjcf", ".mjcf": "mjcf", ".urdf": "urdf", ".sdf": "sdf", ".world": "sdf",
    ".usd": "usd", ".usda": "usd", ".usdc": "usd", ".usdz": "usd",
}  # fmt: skip
"""Suffixes of the files that are read."""

MAIN = ("manifest.json", "scene.xml", "scene.sdf", "model.sdf", "scene.usdc", "scene.usda", "scene.usd", "scene.usdz")
"""Files that stand for the folder that they are in, the first one first."""

MAX_OBJECTS = 500

SUNK = 1e-6
"""What reaches further below the ground than this [m], without anything said of a ground, lifts everything."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Imported:
    """A scene that was read, at the poses of its file."""

    scene: Scene
    path: Path
    format: str
    left_out: tuple[str, ...]
    """Objects that have joints, where they were to be left out."""
    lifted: float
    """By how much everything was moved up so that the ground is z = 0 [m]."""
    kept: int
    """Convex parts that are the file's own collision shapes."""
    cut: int
    """Collision shapes that were cut into convex parts anew."""
    notes: tuple[str, ...]


def main_file(source: Path) -> Path:
    """The file that `source`, a file or a folder, means.

    Raises:
        AssetError: there is none, or several could be meant.
    """
    if source.is_file():
        if source.suffix.lower() not in FORMATS and source.name != MAIN[0]:
            raise AssetError(f'"{source}" is of no format that is read. Valid: {", ".join(FORMATS)}.')
        return source
    if not source.is_dir():
        raise AssetError(f"there is no file or folder {source}.")
    if (source / "scene.json").is_file():
        raise AssetError(f"{source} is a PAT3D scene folder already; `pat3d settle` and `pat3d check` take it.")
    for name in MAIN:
        if (source / name).is_file():
            return source / name
    found = sorted(path for path in source.iterdir() if path.suffix.lower() in FORMATS and path.is_file())
    if len(found) == 1:
        return found[0]
    if not found:
        raise AssetError(f"{source} holds no file of a format that is read. Valid: {', '.join(FORMATS)}.")
    several = ", ".join(path.name for path in found[:6])
    raise AssetError(
        f"{source} holds {len(found)} scenes or objects ({several}, ...); name one. Folders of objects: "
        "`pat3d library add`."
    )


def read_scene(path: Path, *, root: Path | None = None, keyframe: str | None = None) -> ImportedScene:
    """What the file at `path` holds.

    Args:
        path: of a format of FORMATS, or the manifest of a URDF export.
        root: folder that meshes and pictures may lie in; the one above the file's own where None.
        keyframe: of MJCF, name or number; the file's poses where None.

    Raises:
        AssetError: it is malformed, names what is not there, or holds shapes that are not read.
        CheckError: MuJoCo refuses it, or there is no such keyframe.
        ExportError: OpenUSD cannot open it, or is missing.
    """
    root = root or path.resolve().parent.parent
    kind = "manifest" if path.name == MAIN[0] else FORMATS[path.suffix.lower()]
    if kind == "mjcf":
        with path.open("rb") as file:
            kind = "urdf" if b"<robot" in file.read(4096) else kind
    if keyframe is not None and kind != "mjcf":
        raise SpecError(f"--keyframe {keyframe}: only MJCF has keyframes.")
    if kind == "mjcf":
        from pat3d.importers.mjcf import read_mjcf_scene

        return read_mjcf_scene(path, keyframe)
    if kind == "manifest":
        from pat3d.importers.urdf import read_manifest_scene

        return read_manifest_scene(path)
    if kind == "urdf":
        from pat3d.importers.urdf import read_urdf_scene

        return read_urdf_scene(path, root)
    if kind == "sdf":
        from pat3d.importers.sdf import read_sdf_scene

        return read_sdf_scene(path, root)
    from pat3d.importers.usd import read_usd_scene

    return read_usd_scene(path, root)


def import_scene(
    source: str | os.PathLike[str],
    *,
    root: str | os.PathLike[str] | None = None,
    keyframe: str | None = None,
    joints: Joints = "refuse",
    cache_dir: str | os.PathLike[str] | None = None,
    cpu_limit: float | None = None,
    progress: Progress = silent,
) -> Imported:
    """The scene, or the object, in an MJCF, URDF, SDF or USD file.

    Args:
        source: the file, or a folder that holds one.
        root: as for `read_scene`.
        keyframe: as for `read_scene`.
        joints: what becomes of what has joints.
        cache_dir: where decompositions are kept.
        cpu_limit: processor time for decompositions [s]; None for any.
        progress: told of every object.

    Raises:
        AssetError: nothing usable is there; something has joints and is to be refused; the message says why.
        CheckError: MuJoCo refuses it.
    """
    if joints not in JOINTS:
        raise SpecError(f'"{joints}": what has joints can be {", ".join(JOINTS)}.')
    path = main_file(Path(source).expanduser())
    progress(Event(stage="reading", detail=path.name))
    read = read_scene(path, root=None if root is None else Path(root).expanduser(), keyframe=keyframe)
    objects, left_out = _without_joints(read, joints)
    if not objects:
        raise AssetError(f"{path} holds no rigid object that something could touch.")
    if len(objects) > MAX_OBJECTS:
        raise AssetError(f"{path} holds {len(objects)} objects; at most {MAX_OBJECTS} are read.")
    budget, notes = CpuBudget(cpu_limit), list(read.notes)
    made: dict[str, ImportedAsset] = {}
    placed = list[SceneObject]()
    names = _names(objects)
    for number, (one, name) in enumerate(zip(objects, names, strict=True)):
        progress(Event(stage="making assets", detail=name, step=number, steps=len(objects)))
        key = content_of(one.body)
        if key not in made:
            try:
                made[key] = asset_of(
                    one.body, name, format=read.format, file=path.name, cache_dir=cache_dir, budget=budget
                )
            except AssetError as error:
                raise AssetError(f'{path}: "{name}": {error}') from error
            notes += [f'"{name}": {note}' for note in made[key].notes]
        position = one.pose.apply(made[key].origin[None])[0]
        pose = Pose(position=tuple(map(float, position)), quat_wxyz=one.pose.quat_wxyz)  # type: ignore[arg-type]
        placed.append(
            SceneObject(name=name, phrase=name, asset=made[key].asset, pose=pose, initial_pose=pose, fixed=one.fixed)
        )
    lifted = _lift(read, placed, notes)
    if lifted:
        placed = [_raised(obj, lifted) for obj in placed]
    origins = {one.name: made[content_of(one.body)].origin for one in objects}
    renamed = dict(zip((one.name for one in objects), names, strict=True))
    scene = Scene(
        objects=tuple(placed),
        attachments=tuple(_attached(one, origins, renamed) for one in read.attachments if one.child in origins),
        provenance={
            "source": "import",
            "file": path.name,
            "format": read.format,
            "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
            "lifted": lifted,
            "versions": versions(),
        },
    )
    used = list(made.values())
    return Imported(
        scene=scene,
        path=path,
        format=read.format,
        left_out=left_out,
        lifted=lifted,
        kept=sum(one.asset.provenance["parts"]["kept"] for one in used),
        cut=sum(one.asset.provenance["parts"]["cut"] for one in used),
        notes=tuple(dict.fromkeys(notes)),
    )


def import_object(
    source: str | os.PathLike[str],
    *,
    name: str | None = None,
    root: str | os.PathLike[str] | None = None,
    cache_dir: str | os.PathLike[str] | None = None,
    cpu_limit: float | None = None,
) -> Asset:
    """The one rigid object of an MJCF, URDF, SDF or USD file.

    Raises:
        AssetError: it holds several, or one with joints.
    """
    path = main_file(Path(source).expanduser())
    read = read_scene(path, root=None if root is None else Path(root).expanduser())
    objects, _ = _without_joints(read, "refuse")
    if len(objects) != 1:
        names = ", ".join(one.name for one in objects[:6])
        raise AssetError(f"{path} holds {len(objects)} objects ({names}); one is needed. `pat3d import` takes scenes.")
    called = name or objects[0].name
    try:
        made = asset_of(
            objects[0].body,
            called,
            format=read.format,
            file=path.name,
            cache_dir=cache_dir,
            budget=CpuBudget(cpu_limit),
        )
    except AssetError as error:
        raise AssetError(f"{path}: {error}") from error
    return made.asset


def _without_joints(read: ImportedScene, joints: Joints) -> tuple[list[ImportedObject], tuple[str, ...]]:
    """Objects without other joints than their freedom, and the names of those that are left out."""
    jointed = [one for one in read.objects if one.joint]
    if jointed and joints == "refuse":
        first = "; ".join(f'"{one.name}" by {one.joint}' for one in jointed[:4])
        more = f" and {len(jointed) - 4} more" if len(jointed) > 4 else ""
        raise AssetError(
            f"{read.path}: what has joints is no rigid object: {first}{more}. --joints fix lets it stand still where "
            "it is, --joints leave-out leaves it out."
        )
    if joints == "leave-out":
        return [one for one in read.objects if not one.joint], tuple(one.name for one in jointed)
    return [replace(one, fixed=True, joint="") if one.joint else one for one in read.objects], ()


def _names(objects: Sequence[ImportedObject]) -> list[str]:
    """Their names, made different where they are not, or mean the same file name."""
    found, taken = list[str](), dict[str, int]()
    for one in objects:
        name = one.name.strip() or "object"
        name = name if name != "ground" else "the ground"
        number = taken[name] = taken.get(name, 0) + 1
        found.append(name if number == 1 else f"{name} {number}")
    return found if len(set(found)) == len(found) else list(unique_slugs(found).values())


def _lift(read: ImportedScene, objects: Sequence[SceneObject], notes: list[str]) -> float:
    """How far everything moves up for the ground to be z = 0 [m]."""
    if read.ground is not None:
        if read.ground:
            notes.append(f"its ground is at z = {read.ground:g} m; everything moved by as much, to z = 0.")
        return 0.0 - read.ground
    lowest = min(float(obj.pose.apply(part.vertices)[:, 2].min()) for obj in objects for part in obj.parts)
    if lowest < -SUNK:
        notes.append(f"it has no ground and reaches down to z = {lowest:.4g} m; everything moved up by as much.")
        return -lowest
    notes.append("it has no ground; that of PAT3D is z = 0.")
    return 0.0


def _raised(obj: SceneObject, by: float) -> SceneObject:
    x, y, z = obj.pose.position
    pose = replace(obj.pose, position=(x, y, z + by))
    return replace(obj, pose=pose, initial_pose=pose)


def _attached(one: Attachment, origins: dict[str, np.ndarray], renamed: dict[str, str]) -> Attachment:
    """An attachment whose anchors are in the frames of the assets."""
    anchors = tuple(
        tuple(
            tuple(map(float, np.array(point) - origins[end]))
            for end, point in zip((one.child, one.parent), pair, strict=True)
        )
        for pair in one.anchors
    )
    return Attachment(child=renamed[one.child], parent=renamed[one.parent], anchors=anchors)  # type: ignore[arg-type]
