"""The meshes of an FBX file as a trimesh scene, by ufbx; for the process that converts them alone.

ufbx 0.0.5 ends the process where Python lets go of an object of it while others of the same file are in use, so every
one is kept in a list until the process ends.
"""

from __future__ import annotations

import io
from pathlib import Path, PureWindowsPath
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.load import MAX_FACES
from pat3d.errors import AssetError

_AXES = ("x", "-x", "y", "-y", "z", "-z")
_PHYSICAL = ("GLTF_MATERIAL", "OPENPBR_MATERIAL", "OSL_STANDARD_SURFACE", "ARNOLD_STANDARD_SURFACE",
             "E3DS_MAX_PHYSICAL_MATERIAL", "E3DS_MAX_PBR_METAL_ROUGH")  # fmt: skip
"""Shaders that say roughness and metallic themselves; those of Lambert and Phong do not."""

_T = TypeVar("_T")
_held: list[Any] = []


def _hold(thing: _T) -> _T:
    """Keep an object of ufbx until the process ends."""
    _held.append(thing)
    return thing


def read_fbx(path: Path, resolver: Any) -> tuple[Any, float, str, list[str]]:
    """The scene at rest in the file's units, the metres of its unit, its axis that points up, and notes.

    Args:
        path: the file.
        resolver: opens pictures beside it.
    """
    import trimesh
    import ufbx  # pyright: ignore[reportMissingImports]
    from trimesh.visual import TextureVisuals

    file = _hold(ufbx.load_file(str(path)))
    settings = _hold(file.settings)
    axes = settings.axes
    notes: list[str] = []
    vectors = [_vector(int(axis)) for axis in (axes.right, axes.up, axes.front)]
    if np.linalg.det(np.array(vectors)) < 0.0:
        notes.append("its axes are left-handed; it may come out mirrored")
    scene, materials, total = trimesh.Scene(), {}, 0
    nodes = _hold(file.nodes)
    for number in range(len(nodes)):
        node = _hold(nodes[number])
        mesh = _hold(node.mesh)
        if mesh is None:
            continue
        total += int(mesh.num_triangles)
        if total > MAX_FACES:
            raise AssetError(f"it has more than {MAX_FACES:,} triangles; simplify it first")
        matrix = _hold(node.geometry_to_world)
        placed = np.eye(4)
        placed[:3] = np.array([tuple(column) for column in (matrix.c0, matrix.c1, matrix.c2, matrix.c3)]).T
        corners, uv, owner = _corners(mesh)
        listed = _hold(node.materials)
        for index in np.unique(owner):
            mine = owner == index
            used = _hold(listed[int(index)]) if 0 <= index < len(listed) else None
            key = None if used is None else int(used.element_id)
            if key not in materials:
                materials[key] = None if used is None else _material(used, resolver, notes)
            piece = trimesh.Trimesh(
                vertices=corners[mine].reshape(-1, 3), faces=np.arange(3 * mine.sum()).reshape(-1, 3), process=False
            )
            if materials[key] is not None:
                piece.visual = TextureVisuals(uv=uv[mine].reshape(-1, 2), material=materials[key])
            scene.add_geometry(piece, node_name=f"{node.name or 'mesh'} {number} {index}", transform=placed)
    return scene, float(settings.unit_meters), _AXES[int(axes.up)], notes


def _vector(axis: int) -> NDArray[np.float64]:
    vector = np.zeros(3)
    vector[axis // 2] = -1.0 if axis % 2 else 1.0
    return vector


def _corners(mesh: Any) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Points (triangles, 3, 3), texture coordinates (triangles, 3, 2) and the material's number of every triangle."""
    position, coordinates = _hold(mesh.vertex_position), _hold(mesh.vertex_uv)
    points = _rows(_hold(position.values), 3)[_numbers(_hold(position.indices))]
    uv = np.zeros((len(points), 2))
    if coordinates.exists:
        uv = _rows(_hold(coordinates.values), 2)[_numbers(_hold(coordinates.indices))]
    faces = [_hold(one) for one in _hold(mesh.faces)]
    starts = np.array([(one.index_begin, one.num_indices) for one in faces], dtype=np.int64).reshape(-1, 2)
    face, corner = _triangles(points, starts)
    materials = _hold(mesh.face_material)
    owner = _numbers(materials) if len(materials) else np.zeros(len(starts), dtype=np.int64)
    return points[corner], uv[corner], owner[face]


def _rows(values: Any, width: int) -> NDArray[np.float64]:
    return np.frombuffer(values, dtype=np.float64).reshape(-1, width).copy()


def _numbers(values: Any) -> NDArray[np.int64]:
    return np.fromiter(values, dtype=np.int64, count=len(values))


def _triangles(points: NDArray[np.float64], starts: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Of polygons with a first corner and a number of corners each: the face and the corners of every triangle."""
    faces, corners = [np.zeros(0, dtype=np.int64)], [np.zeros((0, 3), dtype=np.int64)]
    for count in np.unique(starts[:, 1]):
        which = np.flatnonzero(starts[:, 1] == count)
        ring = starts[which, 0, None] + np.arange(count)
        if count < 3:
            continue
        if count > 4:
            for face, one in zip(which, ring, strict=True):
                made = one[_ears(points[one])]
                faces.append(np.full(len(made), face))
                corners.append(made)
            continue
        fans = ring[:, [[0, k, k + 1] for k in range(1, count - 1)]]
        if count == 4:
            # A quad that is not convex is cut from its other corner.
            edges = points[fans[:, :, 1:]] - points[fans[:, :, :1]]
            normal = np.cross(edges[:, :, 0], edges[:, :, 1])
            bent = np.einsum("fk,fk->f", normal[:, 0], normal[:, 1]) < 0.0
            fans[bent] = ring[bent][:, [[1, 2, 3], [1, 3, 0]]]
        faces.append(np.repeat(which, count - 2))
        corners.append(fans.reshape(-1, 3))
    return np.concatenate(faces), np.concatenate(corners)


def _ears(polygon: NDArray[np.float64]) -> NDArray[np.int64]:
    """Triangles of a polygon, shape (corners, 3), in its plane, by corner, shape (triangles, 3)."""
    import manifold3d

    after = np.roll(polygon, -1, axis=0)
    # Newell's normal, for polygons that are not quite plane.
    normal = np.cross(polygon, after).sum(axis=0)
    keep = [k for k in range(3) if k != int(np.abs(normal).argmax())]
    flat = polygon[:, keep]
    area = float((flat[:, 0] * np.roll(flat[:, 1], -1) - flat[:, 1] * np.roll(flat[:, 0], -1)).sum())
    made = np.asarray(manifold3d.triangulate([np.ascontiguousarray(flat if area > 0.0 else flat[::-1])]))
    made = made.astype(np.int64).reshape(-1, 3)
    return made if area > 0.0 else (len(polygon) - 1 - made)[:, ::-1]


def _material(used: Any, resolver: Any, notes: list[str]) -> Any:
    """Base colour with its texture, the normal map, and roughness, metallic and opacity where the shader says them."""
    from PIL import Image
    from trimesh.visual.material import PBRMaterial

    maps = _hold(used.pbr)
    colour, normal = _hold(maps.base_color), _hold(maps.normal_map)
    value = colour.value_vec4
    base = [float(np.clip(one, 0.0, 1.0)) for one in (value.x, value.y, value.z)]
    image = _picture(_hold(colour.texture), resolver, notes)
    given: dict[str, Any] = {
        "baseColorTexture": image,
        "normalTexture": _picture(_hold(normal.texture), resolver, notes),
    }
    physical = used.shader_type.name in _PHYSICAL
    opacity, alpha = _hold(maps.opacity), 1.0
    if physical and opacity.has_value:
        alpha = float(np.clip(opacity.value_vec4.x, 0.0, 1.0))
    # Most programs that write FBX leave a colour beside a texture, which is not to be tinted by it.
    given["baseColorFactor"] = [*(base if image is None else (1.0, 1.0, 1.0)), alpha]
    given["alphaMode"] = "BLEND" if alpha < 1.0 else None
    if physical:
        layers = {}
        for name, one in (("roughness", _hold(maps.roughness)), ("metallic", _hold(maps.metalness))):
            layers[name] = _picture(_hold(one.texture), resolver, notes)
            factor = float(np.clip(one.value_vec4.x, 0.0, 1.0)) if one.has_value else None
            given[f"{name}Factor"] = 1.0 if layers[name] is not None else factor
        size = next((one.size for one in layers.values() if one is not None), None)
        if size is not None:
            full = Image.new("L", size, 255)
            green, blue = (full if one is None else one.convert("L").resize(size) for one in layers.values())
            given["metallicRoughnessTexture"] = Image.merge("RGB", (full, green, blue))
    return PBRMaterial(**{name: one for name, one in given.items() if one is not None})


def _picture(texture: Any, resolver: Any, notes: list[str]) -> Any:
    """The picture inside the file, or beside it by its name; None where there is none."""
    from PIL import Image

    if texture is None:
        return None
    content = texture.content
    if not content:
        said = PureWindowsPath(texture.relative_filename or texture.filename)
        content, before = b"", len(resolver.refused)
        for name in (said.as_posix(), said.name):
            try:
                content = resolver.get(name)
                break
            except ValueError:
                continue
        del resolver.refused[before:]
        if not content:
            notes.append(f'its picture "{said.name}" is not beside it')
            return None
    try:
        made = Image.open(io.BytesIO(content))
        made.load()
        return made if made.mode in ("RGB", "RGBA", "L") else made.convert("RGBA")
    except (OSError, ValueError, Image.DecompressionBombError) as error:
        notes.append(f"a picture of the file cannot be read ({type(error).__name__})")
        return None
