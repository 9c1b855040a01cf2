"""Objects from MJCF, as MuJoCo itself compiles them: shapes, textures, mass and friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.library.body import Body, Inertial, Piece, Points, flat, merged, primitive
from pat3d.assets.library.readers.collision import hulls_of
from pat3d.assets.library.readers.inertials import together
from pat3d.assets.library.readers.xml import read_root
from pat3d.assets.mesh.texture import Patch
from pat3d.errors import AssetError
from pat3d.scene.asset import MAPS

_HIDDEN = 3
"""Geoms of this group and above are not drawn unless asked for; models keep their collision shapes there."""


def read_mjcf(path: Path, root: Path) -> Body:
    """The object of an MJCF file: metres, z up; one body, with those welded to it.

    Raises:
        AssetError: MuJoCo refuses it, it has joints that move, or several free bodies.
    """
    import mujoco

    tree = read_root(path)
    if tree.tag != "mujoco":
        raise AssetError(f"<{tree.tag}> is no whole model, only a piece to be included.")
    try:
        model = mujoco.MjSpec.from_file(str(path)).compile()
    except (ValueError, OSError, RuntimeError) as error:
        raise AssetError(f"MuJoCo refuses it: {' '.join(str(error).split())[:200]}.") from error
    text = path.read_text(encoding="utf-8", errors="replace")
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    top = _root(model, mujoco)
    bodies = [body for body in range(model.nbody) if _top(model, body) == top]
    return body_of(
        model,
        data,
        bodies,
        (np.array(data.xmat[top]).reshape(3, 3), np.array(data.xpos[top])),
        name=tree.get("model", ""),
        weighed=any(word in text for word in ("mass=", "density=", "<inertial")),
        rubs="friction=" in text,
        files=(path, *_files(tree, path, root)),
    )


def body_of(
    model: Any,
    data: Any,
    bodies: Sequence[int],
    frame: tuple[Points, Points],
    *,
    name: str,
    weighed: bool,
    rubs: bool,
    files: tuple[Path, ...],
) -> Body:
    """The shapes, the mass and the friction of some bodies of a compiled model, which move as one.

    Args:
        model: mujoco.MjModel.
        data: mujoco.MjData, whose poses are those of the bodies.
        bodies: their numbers.
        frame: rotation and position [m] of the object in the world.
        name: of the object.
        weighed: whether its mass is said; MuJoCo takes everything for water otherwise.
        rubs: whether its friction is said.
        files: that it was read from.

    Raises:
        AssetError: a shape of a kind that is not read, or nothing to see.
    """
    import mujoco

    geoms = [
        geom
        for geom in range(model.ngeom)
        if model.geom_bodyid[geom] in bodies and model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_PLANE
    ]
    solid = [geom for geom in geoms if model.geom_contype[geom] or model.geom_conaffinity[geom]]
    ghost = [geom for geom in geoms if geom not in solid]
    shown = ghost or [geom for geom in geoms if model.geom_group[geom] < _HIDDEN] or geoms
    notes: list[str] = []
    seen = [_piece(model, data, mujoco, geom, frame, notes) for geom in shown]
    touched = [_piece(model, data, mujoco, geom, frame, notes) for geom in solid]
    hulls: tuple[Points, ...] = ()
    pictured = {int(model.geom_dataid[geom]) for geom in shown if model.geom_dataid[geom] >= 0}
    if touched and not any(int(model.geom_dataid[geom]) in pictured for geom in solid):
        hulls, note = hulls_of(touched)
        notes += [note] if note else []
    mesh = merged(seen, notes)
    return Body(
        name=name,
        mesh=mesh,
        hulls=hulls,
        touched=tuple(touched),
        metres=1.0,
        up="z",
        declared="MJCF",
        inertial=_inertial(model, data, bodies, frame) if weighed else None,
        friction=float(model.geom_friction[(solid or geoms)[0], 0]) if rubs else None,
        files=files,
        notes=tuple(notes),
    )


def _root(model: Any, mujoco: Any) -> int:
    """The body that is the object: the only one of the world, or the world where nothing else is there."""
    moving = [
        model.joint(joint).name or f"number {joint}"
        for joint in range(model.njnt)
        if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE
    ]
    if moving:
        raise AssetError(
            f"it has joints that move ({', '.join(moving[:4])}); libraries hold rigid objects, so fix or remove them."
        )
    tops = [body for body in range(1, model.nbody) if model.body_parentid[body] == 0]
    if len(tops) > 1:
        raise AssetError(f"it holds {len(tops)} bodies; one object a file.")
    return tops[0] if tops else 0


def _top(model: Any, body: int) -> int:
    while model.body_parentid[body] != 0 and body != 0:
        body = int(model.body_parentid[body])
    return body


def _piece(model: Any, data: Any, mujoco: Any, geom: int, frame: tuple[Points, Points], notes: list[str]) -> Piece:
    material = int(model.geom_matid[geom])
    rgba = model.mat_rgba[material] if material >= 0 else model.geom_rgba[geom]
    kind, size = int(model.geom_type[geom]), [float(value) for value in model.geom_size[geom]]
    types = mujoco.mjtGeom
    if kind == types.mjGEOM_MESH:
        piece = _mesh(model, int(model.geom_dataid[geom]), material, rgba, notes)
    elif kind == types.mjGEOM_BOX:
        piece = primitive("box", [2 * side for side in size], rgba)
    elif kind == types.mjGEOM_SPHERE:
        piece = primitive("sphere", size[:1], rgba)
    elif kind == types.mjGEOM_ELLIPSOID:
        piece = primitive("ellipsoid", size, rgba)
    elif kind in (types.mjGEOM_CYLINDER, types.mjGEOM_CAPSULE):
        name = "cylinder" if kind == types.mjGEOM_CYLINDER else "capsule"
        piece = primitive(name, [size[0], 2 * size[1]], rgba)
    else:
        raise AssetError("it has a height field or a signed distance field, which are not read.")
    if material >= 0 and piece.patch.image is None:
        colour = _average(model, material, rgba)
        piece = Piece(vertices=piece.vertices, faces=piece.faces, patch=flat(len(piece.faces), colour))
    piece = replace(piece, surface=_surface(model, material, rgba))
    rotation = np.array(data.geom_xmat[geom]).reshape(3, 3)
    position = np.array(data.geom_xpos[geom])
    return piece.placed(frame[0].T @ rotation, frame[0].T @ (position - frame[1]))


def _mesh(model: Any, mesh: int, material: int, rgba: Points, notes: list[str]) -> Piece:
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    face, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
    vertices = np.array(model.mesh_vert[first : first + count], dtype=np.float64)
    triangles = np.array(model.mesh_face[face : face + faces], dtype=np.int64)
    image = _image(model, material)
    corner = int(model.mesh_texcoordadr[mesh])
    if image is None or corner < 0:
        return Piece(vertices=vertices, faces=triangles, patch=flat(len(triangles), rgba))
    at = np.array(model.mesh_facetexcoord[face : face + faces], dtype=np.int64) + corner
    uv = np.array(model.mesh_texcoord, dtype=np.float64)[at]
    # MuJoCo counts v from the picture's first row.
    uv = np.stack([uv[..., 0], 1.0 - uv[..., 1]], axis=-1)
    tint = np.clip(np.asarray(rgba[:3]), 0.0, 1.0)
    patch = Patch(uv=uv, image=np.round(image * tint).astype(np.uint8), maps=_maps(model, material, image.shape))
    return Piece(vertices=vertices, faces=triangles, patch=patch)


def _maps(model: Any, material: int, shape: tuple[int, ...]) -> dict[str, Any]:
    """The layers of a material beside its colour, as far as they are as large as that."""
    import mujoco

    roles = np.atleast_1d(model.mat_texid[material])
    found = {}
    for name in MAPS:
        texture = int(roles[getattr(mujoco.mjtTextureRole, f"mjTEXROLE_{name.upper()}")]) if len(roles) > 1 else -1
        if texture < 0 or (int(model.tex_height[texture]), int(model.tex_width[texture])) != shape[:2]:
            continue
        texels = _texels(model, texture)
        found[name] = texels if name == "normal" else texels[..., 0]
    return found


def _surface(model: Any, material: int, rgba: Points) -> dict[str, float]:
    """What the file says of a surface beside its colour; MuJoCo's -1 means that it says nothing."""
    said = {"opacity": float(rgba[3])} if rgba[3] < 1.0 else {}
    if material >= 0:
        for name in ("roughness", "metallic"):
            value = float(getattr(model, f"mat_{name}")[material])
            if value >= 0.0:
                said[name] = min(value, 1.0)
    return said


def _image(model: Any, material: int) -> Any:
    """The picture of a material's 2D texture, shape (height, width, 3); None where it has none."""
    if material < 0:
        return None
    textures = [int(one) for one in np.atleast_1d(model.mat_texid[material]) if one >= 0]
    if not textures or int(model.tex_type[textures[0]]) != 0:
        return None
    return _texels(model, textures[0])


def _texels(model: Any, texture: int) -> Any:
    width, height = int(model.tex_width[texture]), int(model.tex_height[texture])
    channels, start = int(model.tex_nchannel[texture]), int(model.tex_adr[texture])
    texels = np.array(model.tex_data[start : start + width * height * channels], dtype=np.uint8)
    return texels.reshape(height, width, channels)[..., :3] if channels >= 3 else np.repeat(
        texels.reshape(height, width, channels)[..., :1], 3, axis=2
    )  # fmt: skip


def _average(model: Any, material: int, rgba: Points) -> Points:
    """Colour of a material on what has no texture coordinates: its texture's mean, tinted."""
    textures = [int(one) for one in np.atleast_1d(model.mat_texid[material]) if one >= 0]
    if not textures:
        return rgba
    return np.asarray(rgba[:3]) * _texels(model, textures[0]).reshape(-1, 3).mean(axis=0) / 255.0


def _inertial(model: Any, data: Any, bodies: Sequence[int], frame: tuple[Points, Points]) -> Inertial | None:
    parts = []
    for body in bodies:
        mass = float(model.body_mass[body])
        if mass <= 0:
            continue
        rotation = frame[0].T @ np.array(data.ximat[body]).reshape(3, 3)
        centre = frame[0].T @ (np.array(data.xipos[body]) - frame[1])
        tensor = rotation @ np.diag(np.array(model.body_inertia[body], dtype=np.float64)) @ rotation.T
        parts.append(Inertial(mass=mass, centre=centre, inertia=tensor))
    return together(parts)


def _files(tree: Any, path: Path, root: Path) -> list[Path]:
    """Files that the model names and that are inside the library."""
    settings = tree.find("compiler")
    folders = [""]
    for key in ("meshdir", "texturedir", "assetdir"):
        if settings is not None and settings.get(key):
            folders.append(settings.get(key))
    found = []
    for element in tree.iter():
        said = element.get("file")
        for folder in folders if said else ():
            target = (path.parent / folder / said).resolve()
            if target.is_file() and target.is_relative_to(root.resolve()):
                found.append(target)
                break
    return found
