"""Scenes from MJCF, as MuJoCo itself compiles and poses them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.library.readers.mjcf import body_of
from pat3d.check.foreign.load import load_foreign
from pat3d.check.foreign.state import body_name, start
from pat3d.errors import AssetError
from pat3d.geometry.pose import Pose
from pat3d.importers.model import GROUND_NAMES, ImportedObject, ImportedScene
from pat3d.scene.model import Attachment

OURS = "pat3d scene"
"""Model name of our own exports, whose custom texts keep the names of the objects as people write them."""

_LEVEL = 1e-6


def read_mjcf_scene(path: Path, keyframe: str | None = None) -> ImportedScene:
    """Every thing under the world of an MJCF file, where `keyframe`, or the file itself, has it.

    Raises:
        CheckError: MuJoCo refuses it, or there is no such keyframe.
        AssetError: it holds shapes that are not read.
    """
    import mujoco

    foreign = load_foreign(path)
    model = foreign.compile()
    data = start(model, keyframe)
    names = {one.name: one.data for one in foreign.spec.texts} if foreign.spec.modelname == OURS else {}
    text = path.read_text(encoding="utf-8", errors="replace")
    notes = list(foreign.notes)
    if not any(word in text for word in ("mass=", "density=", "<inertial", "<include")):
        notes.append("the file says no mass: everything weighs what MuJoCo makes of it, 1000 kg/m^3.")
    ground, furniture = _ground(model, mujoco, notes)
    objects, markers, owner = list[ImportedObject](), list[str](), np.full(model.nbody, -1, dtype=np.int64)
    tops = [body for body in range(1, model.nbody) if int(model.body_parentid[body]) == 0]
    for top in ([0] if furniture else []) + tops:
        below = [top] if top == 0 else [body for body in range(1, model.nbody) if int(model.body_rootid[body]) == top]
        solid = _solid(model, below) if top else furniture
        raw = body_name(model, top) if top else "world"
        if not solid:
            if _drawn(model, below):
                markers.append(raw)
            continue
        rotation = np.array(data.xmat[top], dtype=np.float64).reshape(3, 3)
        position = np.array(data.xpos[top], dtype=np.float64)
        try:
            body = body_of(
                model, data, below, (rotation, position), name=raw, weighed=True, rubs=True, files=(path,)
            )  # fmt: skip
        except AssetError as error:
            raise AssetError(f'{path}: "{raw}": {error}') from error
        joints = [joint for joint in range(model.njnt) if int(model.jnt_bodyid[joint]) in below]
        free = [joint for joint in joints if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE]
        moving = [model.joint(joint).name or f"joint {joint}" for joint in joints if joint not in free]
        frictions = {round(float(model.geom_friction[geom, 0]), 9) for geom in solid}
        if len(frictions) > 1 and not moving:
            notes.append(f'"{raw}" has several frictions ({min(frictions):g} to {max(frictions):g}); the first counts.')
        owner[below] = len(objects)
        objects.append(
            ImportedObject(
                name=names.get(raw, raw),
                pose=Pose.from_matrix(rotation, position),
                body=body,
                fixed=not joints,
                joint=", ".join(moving[:4]),
            )
        )
    if markers:
        notes.append(f"left out, since nothing collides with them: {', '.join(markers)}.")
    attachments, welded = _attachments(model, mujoco, owner, objects, data)
    for number, what in welded.items():
        one = objects[number]
        objects[number] = ImportedObject(
            name=one.name, pose=one.pose, body=one.body, fixed=one.fixed, joint=one.joint or what
        )
    return ImportedScene(
        path=path,
        format=foreign.format,
        objects=tuple(objects),
        ground=ground,
        attachments=attachments,
        notes=tuple(dict.fromkeys(notes)),
    )


def _solid(model: Any, bodies: list[int]) -> list[int]:
    """Geoms of the bodies that can touch something."""
    return [
        geom
        for geom in range(model.ngeom)
        if int(model.geom_bodyid[geom]) in bodies and (model.geom_contype[geom] or model.geom_conaffinity[geom])
    ]


def _drawn(model: Any, bodies: list[int]) -> bool:
    return any(int(model.geom_bodyid[geom]) in bodies for geom in range(model.ngeom))


def _ground(model: Any, mujoco: Any, notes: list[str]) -> tuple[float | None, list[int]]:
    """Height of the ground, and the other geoms of the world that things can touch."""
    heights, furniture = [], []
    for geom in _solid(model, [0]):
        kind, name = int(model.geom_type[geom]), model.geom(geom).name
        rotation = Pose(quat_wxyz=tuple(model.geom_quat[geom])).rotation
        level = abs(rotation[2, 2] - 1.0) < _LEVEL
        if kind == mujoco.mjtGeom.mjGEOM_PLANE:
            if level:
                heights.append(float(model.geom_pos[geom, 2]))
            else:
                notes.append(f'the plane "{name or geom}", which is not level, was left out.')
        elif kind == mujoco.mjtGeom.mjGEOM_BOX and level and GROUND_NAMES.search(name):
            heights.append(float(model.geom_pos[geom, 2] + model.geom_size[geom, 2]))
        else:
            furniture.append(geom)
    return (max(heights) if heights else None), furniture


def _attachments(
    model: Any, mujoco: Any, owner: NDArray[np.int64], objects: list[ImportedObject], data: Any
) -> tuple[tuple[Attachment, ...], dict[int, str]]:
    """Points that connect constraints hold together, and what other constraints hold, by number of the object."""
    pairs: dict[tuple[int, int], list[tuple]] = {}
    held: dict[int, str] = {}
    for row in range(model.neq):
        kind = model.eq_type[row]
        if kind not in (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD) or not data.eq_active[row]:
            continue
        bodies = [int(model.eq_obj1id[row]), int(model.eq_obj2id[row])]
        sites = model.eq_objtype[row] == mujoco.mjtObj.mjOBJ_SITE
        ends = [-1 if sites or body <= 0 else int(owner[body]) for body in bodies]
        if kind == mujoco.mjtEq.mjEQ_CONNECT and min(ends) >= 0 and ends[0] != ends[1]:
            points = []
            for body, end, anchor in zip(bodies, ends, model.eq_data[row, :6].reshape(2, 3), strict=True):
                world = data.xmat[body].reshape(3, 3) @ anchor + data.xpos[body]
                pose = objects[end].pose
                points.append(tuple(map(float, pose.rotation.T @ (world - np.array(pose.position)))))
            pairs.setdefault((ends[0], ends[1]), []).append(tuple(points))
            continue
        for body in [int(model.site_bodyid[one]) for one in bodies] if sites else bodies:
            if body > 0 and owner[body] >= 0:
                held[int(owner[body])] = f'the constraint "{model.equality(row).name or row}"'
    made = [
        Attachment(child=objects[child].name, parent=objects[parent].name, anchors=tuple(anchors))
        for (child, parent), anchors in pairs.items()
        if not (objects[child].fixed and objects[parent].fixed)
    ]
    return tuple(made), held
