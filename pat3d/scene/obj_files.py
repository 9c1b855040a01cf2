"""Mesh files: the textured visual mesh and the convex parts as Wavefront OBJ, and how to read them back.

Positions and texture coordinates are written so that they reload bit for bit.
"""

from __future__ import annotations

import warnings
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError
from pat3d.geometry.normals import corner_normals
from pat3d.scene.asset import Surface, VisualMesh

MAX_FILE_BYTES = 256 * 2**20
MAX_FACES = 2_000_000
MAX_TEXTURE_SIDE = 16384

MTL_MAPS = {"normal": "norm", "roughness": "map_Pr", "metallic": "map_Pm", "opacity": "map_d"}
"""How MTL, with its PBR extension, says each map of a mesh."""

_OBJ_TEXT: WeakKeyDictionary[VisualMesh, str] = WeakKeyDictionary()
"""OBJ text of the meshes in use: several formats and the scene folder write the same."""


def write_visual(
    mesh: VisualMesh, folder: Path, *, texture: str = "texture.png", surface: Surface | None = None
) -> Path:
    """Write `mesh` as visual.obj, visual.mtl, its texture and its maps into `folder`; returns the OBJ's path.

    Args:
        mesh: what to write.
        folder: made if missing.
        texture: path of the PNG relative to `folder`.
        surface: roughness, metallic and opacity for readers of the PBR extension of MTL; not said where None.
    """
    folder.mkdir(parents=True, exist_ok=True)
    write_texture(mesh.texture, folder / texture)
    more = "" if surface is None else f"Pr {surface.roughness:g}\nPm {surface.metallic:g}\nd {surface.opacity:g}\n"
    for name, image in mesh.maps.items():
        write_texture(image, folder / map_file(name))
    named = "".join(f"{word} {map_file(name)}\n" for name, word in MTL_MAPS.items() if name in mesh.maps)
    (folder / "visual.mtl").write_text(
        f"newmtl surface\nKa 1 1 1\nKd 1 1 1\nKs 0.1 0.1 0.1\nNs 20\n{more}map_Kd {texture}\n{named}",
        encoding="utf-8",
    )
    path = folder / "visual.obj"
    path.write_text(visual_obj(mesh, material_library="visual.mtl"), encoding="utf-8")
    return path


def visual_obj(mesh: VisualMesh, *, material_library: str | None = None) -> str:
    """`mesh` as OBJ text with texture coordinates and corner normals."""
    if mesh not in _OBJ_TEXT:
        _OBJ_TEXT[mesh] = _obj_text(mesh)
    head = "" if material_library is None else f"mtllib {material_library}\nusemtl surface\n"
    return head + _OBJ_TEXT[mesh]


def _obj_text(mesh: VisualMesh) -> str:
    uv, uv_index = np.unique(mesh.uv.reshape(-1, 2), axis=0, return_inverse=True)
    rounded = np.round(corner_normals(mesh.vertices, mesh.faces).reshape(-1, 3), 6) + 0.0
    normals, normal_index = np.unique(rounded, axis=0, return_inverse=True)
    lines = _rows("v", mesh.vertices) + _rows("vt", uv) + _rows("vn", normals)
    index = np.stack([mesh.faces.reshape(-1), uv_index.reshape(-1), normal_index.reshape(-1)], axis=1) + 1
    for a, b, c in index.reshape(-1, 3, 3).tolist():
        lines.append(f"f {a[0]}/{a[1]}/{a[2]} {b[0]}/{b[1]}/{b[2]} {c[0]}/{c[1]}/{c[2]}")
    return "\n".join(lines) + "\n"


def hull_obj(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> str:
    """A convex part as OBJ text: positions and triangles alone."""
    lines = _rows("v", vertices)
    lines += [f"f {a} {b} {c}" for a, b, c in (np.asarray(faces) + 1).tolist()]
    return "\n".join(lines) + "\n"


def part_file(number: int) -> str:
    """File name of a convex part."""
    return f"part_{number:03d}.obj"


def map_file(name: str) -> str:
    """File name of one of the maps of a mesh."""
    return f"{name}.png"


def write_texture(texture: NDArray[np.uint8], path: Path) -> None:
    """Write an RGB image, shape (height, width, 3), or a gray one, shape (height, width), as PNG."""
    from PIL import Image

    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.ascontiguousarray(texture, dtype=np.uint8)).save(path, format="PNG", optimize=False)


def read_texture(path: Path, *, gray: bool = False) -> NDArray[np.uint8]:
    """The image in a PNG file, RGB of shape (height, width, 3), or gray of shape (height, width).

    Raises:
        ExportError: not a readable image, or larger than the limit.
    """
    from PIL import Image, UnidentifiedImageError

    _check_size(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(path, formats=("PNG",)) as image:
                if max(image.size) > MAX_TEXTURE_SIDE:
                    raise ExportError(f"{path}: texture of {image.size} pixels; at most {MAX_TEXTURE_SIDE} a side.")
                return np.array(image.convert("L" if gray else "RGB"))
    except (UnidentifiedImageError, Image.DecompressionBombWarning, Image.DecompressionBombError, OSError) as error:
        raise ExportError(f"{path}: not a readable PNG texture ({error}).") from error


def read_obj(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64] | None]:
    """Vertices, triangles and, where every corner has one, texture coordinates of an OBJ file.

    Reads what this module writes: v, vt and f lines of triangles with positive indices; others are
    skipped.

    Returns:
        vertices [m], shape (n, 3); faces, shape (f, 3); uv, shape (f, 3, 2), or None.

    Raises:
        ExportError: missing, too large, malformed, not finite, or an index out of range.
    """
    _check_size(path)
    vertices: list[list[float]] = []
    uvs: list[list[float]] = []
    faces: list[list[list[str]]] = []
    number = 0
    try:
        with path.open(encoding="utf-8") as file:
            for number, line in enumerate(file, start=1):
                words = line.split()
                if not words:
                    continue
                if words[0] == "v":
                    vertices.append([float(words[1]), float(words[2]), float(words[3])])
                elif words[0] == "vt":
                    uvs.append([float(words[1]), float(words[2])])
                elif words[0] == "f":
                    if len(words) != 4:
                        raise ExportError(f"{path}, line {number}: a face of {len(words) - 1} corners; need 3.")
                    faces.append([word.split("/") for word in words[1:]])
                    if len(faces) > MAX_FACES:
                        raise ExportError(f"{path}: more than {MAX_FACES} triangles.")
        index = np.array([[int(corner[0]) for corner in face] for face in faces], dtype=np.int64).reshape(-1, 3) - 1
        textured = bool(uvs) and all(len(corner) > 1 and corner[1] for face in faces for corner in face)
        uv_index = None
        if textured:
            uv_index = np.array([[int(corner[1]) for corner in face] for face in faces], dtype=np.int64) - 1
    except (ValueError, IndexError, OverflowError) as error:
        raise ExportError(f"{path}, near line {number}: not a valid OBJ ({error}).") from error
    points = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    coordinates = np.array(uvs, dtype=np.float64).reshape(-1, 2)
    if len(points) == 0 or len(index) == 0:
        raise ExportError(f"{path}: {len(points)} vertices and {len(index)} triangles; a mesh needs both.")
    if not (np.isfinite(points).all() and np.isfinite(coordinates).all()):
        raise ExportError(f"{path}: a coordinate is not a finite number.")
    if index.min() < 0 or index.max() >= len(points):
        raise ExportError(f"{path}: a face names vertex {index.max() + 1} of {len(points)}; indices start at 1.")
    if uv_index is None:
        return points, index.astype(np.int32), None
    if uv_index.min() < 0 or uv_index.max() >= len(coordinates):
        raise ExportError(f"{path}: a face names texture coordinate {uv_index.max() + 1} of {len(coordinates)}.")
    return points, index.astype(np.int32), coordinates[uv_index]


def _check_size(path: Path) -> None:
    try:
        size = path.stat().st_size
    except OSError as error:
        raise ExportError(f"{path}: cannot be read ({error.strerror}).") from error
    if size > MAX_FILE_BYTES:
        raise ExportError(f"{path}: {size} bytes; at most {MAX_FILE_BYTES}.")


def _rows(key: str, values: NDArray[np.float64]) -> list[str]:
    """OBJ lines of floats in the shortest form that reads back exactly."""
    return [f"{key} {' '.join(map(repr, row))}" for row in np.asarray(values, dtype=np.float64).tolist()]
