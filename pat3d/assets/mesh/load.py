"""Reading mesh files that nobody vouches for: formats, limits, scene graphs, one texture."""

from __future__ import annotations

import io
import json
import mmap
import os
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh import convert
from pat3d.assets.mesh.texture import Patch, pack, surface_said
from pat3d.errors import AssetError

UpAxis = Literal["x", "-x", "y", "-y", "z", "-z"]

FORMATS = ("obj", "stl", "ply", "off", "glb", "gltf", *convert.FORMATS)
MAX_BYTES = 200_000_000
MAX_FACES = 2_000_000
GLTF = ("glb", "gltf")
"""Formats in metres with y up, by their standard."""
_SIDE_FILES = (".mtl", ".bin", ".png", ".jpg", ".jpeg", ".bmp", ".tga", ".tif", ".tiff", ".webp")


@dataclass(frozen=True, kw_only=True, eq=False)
class LoadedMesh:
    """The triangles of a file in its own units and axes, with one texture."""

    vertices: NDArray[np.float64]
    """Shape (vertices, 3), in file units."""
    faces: NDArray[np.int64]
    """Shape (faces, 3), as wound in the file."""
    uv: NDArray[np.float64]
    """Per face corner in [0, 1], v up, shape (faces, 3, 2)."""
    texture: NDArray[np.uint8]
    """RGB, row 0 at the top, shape (height, width, 3)."""
    maps: Mapping[str, NDArray[np.uint8]] = field(default_factory=dict)
    """As those of `VisualMesh`."""
    surface: Mapping[str, float] = field(default_factory=dict)
    """Roughness, metallic and opacity [-] of the largest piece, as far as the file says."""
    metres: float | None = None
    """[m] of the file's unit, where the file or its format says it."""
    up: UpAxis | None = None
    """Axis that points up, where the file or its format says it."""
    notes: tuple[str, ...] = field(default=())
    """What was left out or changed while reading."""
    files: tuple[Path, ...] = ()
    """The file, and those beside it that it was read with."""


def load_mesh(path: str | os.PathLike[str], *, texture_root: str | os.PathLike[str] | None = None) -> LoadedMesh:
    """Read a mesh file of a format of FORMATS and merge its scene graph.

    Args:
        path: the file.
        texture_root: folder that the file may refer into; its own folder where None. Nothing outside is read,
            and nothing is fetched from a network.

    Raises:
        AssetError: no such file, an unknown format, over the limits, or no usable triangles.
    """
    path = Path(path)
    scene, resolver, said = _read(path, texture_root)
    notes = list(resolver.refused)
    patches = [patch for _, patch in _patches(path, scene, notes, resolver)]
    pieces = [one for one in scene.geometry.values() if len(getattr(one, "faces", ()))]
    surface = surface_said(max(pieces, key=lambda one: len(one.faces)), notes) if pieces else {}
    return replace(_merged(path, patches, notes, resolver), surface=surface, **said)


def load_objects(path: str | os.PathLike[str]) -> list[tuple[str, LoadedMesh]]:
    """Read a file as `load_mesh` does, and return the name and mesh of every node with triangles.

    Returns:
        Sorted by name, all in the file's world frame.

    Raises:
        AssetError: as for `load_mesh`.
    """
    path = Path(path)
    scene, resolver, said = _read(path, None)
    notes = list(resolver.refused)
    objects: dict[str, list[tuple[NDArray[np.float64], NDArray[np.int64], Patch]]] = {}
    for node, patch in _patches(path, scene, notes, resolver):
        parent = str(scene.graph.transforms.parents.get(node, ""))
        # trimesh hangs the primitives of a mesh under its node, named after it with six letters more.
        primitive = parent and node[:-6] == f"{parent}_"
        objects.setdefault(parent if primitive else node, []).append(patch)
    if not objects:
        raise AssetError(f'"{path}" holds no triangles.')
    merged = [(name, _merged(path, patches, notes, resolver)) for name, patches in sorted(objects.items())]
    return [(name, replace(mesh, **said)) for name, mesh in merged]


def _read(path: Path, texture_root: str | os.PathLike[str] | None) -> tuple[Any, Any, dict[str, Any]]:
    """The scene graph of a file, the reader of the files beside it, and the `metres` and `up` that it says."""
    kind = path.suffix.lower().lstrip(".")
    if kind not in FORMATS:
        raise AssetError(f'"{path}" is not of a known mesh format. Valid: {", ".join(FORMATS)}.')
    if not path.is_file():
        raise AssetError(f'there is no mesh file "{path}".')
    _check_size(path, kind)
    import trimesh

    resolver = make_resolver(path, texture_root)
    said: dict[str, Any] = {"metres": 1.0, "up": "y"} if kind in GLTF else {}
    if kind in convert.FORMATS:
        made = convert.as_glb(path, resolver.root)
        resolver.refused += made.notes
        resolver.opened += made.opened
        said = {"metres": made.metres, "up": cast(UpAxis, made.up)}
        data, kind = made.glb, "glb"
    else:
        data = path.read_bytes()
    if kind == "obj":
        data = _in_utf8(data)
    elif kind == "stl":
        _check_stl(path, data)
    try:
        scene = trimesh.load_scene(
            io.BytesIO(data), file_type=kind, resolver=resolver, process=False, allow_remote=False
        )
    except Exception as error:
        # Parsers raise whatever a malformed file makes them hit; the user needs one line.
        text = " ".join(str(error).split())[:200]
        raise AssetError(f'"{path}" cannot be read as {kind.upper()}: {type(error).__name__} {text}.') from error
    return scene, resolver, said


def _merged(
    path: Path, patches: list[tuple[NDArray[np.float64], NDArray[np.int64], Patch]], notes: list[str], resolver: Any
) -> LoadedMesh:
    """One mesh of several, with one texture."""
    if not patches:
        raise AssetError(f'"{path}" holds no triangles.')
    counts = np.cumsum([0] + [len(vertices) for vertices, _, _ in patches])
    vertices = np.concatenate([vertices for vertices, _, _ in patches])
    faces = np.concatenate([faces + start for (_, faces, _), start in zip(patches, counts, strict=False)])
    used = np.unique(faces)
    finite = np.isfinite(vertices[used]).all(axis=1)
    if not finite.all():
        bad = int(used[np.argmin(finite)])
        raise AssetError(
            f'"{path}": {int((~finite).sum())} of {len(used)} vertices are not finite (vertex {bad}: {vertices[bad]}).'
        )
    look = pack([look for _, _, look in patches], notes)
    return LoadedMesh(
        vertices=vertices,
        faces=faces,
        uv=look.uv,
        texture=look.texture,
        maps=look.maps,
        notes=tuple(dict.fromkeys(notes)),
        files=(path, *resolver.opened),
    )


def _patches(
    path: Path, scene: Any, notes: list[str], resolver: Any
) -> Iterator[tuple[str, tuple[NDArray[np.float64], NDArray[np.int64], Patch]]]:
    """Name of every mesh node, with its world vertices, faces and look."""
    import trimesh
    from PIL import Image

    def open_image(name: str) -> Any:
        return Image.open(io.BytesIO(resolver.get(name)))

    total = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        geometry = scene.geometry[name]
        if not isinstance(geometry, trimesh.Trimesh) or not len(geometry.faces):
            continue
        total += len(geometry.faces)
        if total > MAX_FACES:
            raise AssetError(f'"{path}" has more than {MAX_FACES:,} triangles; simplify it first.')
        vertices = np.asarray(geometry.vertices, dtype=np.float64)
        faces = np.asarray(geometry.faces, dtype=np.int64)
        if faces.min() < 0 or faces.max() >= len(vertices):
            raise AssetError(f'"{path}": a face refers to vertex {int(faces.max())} of {len(vertices)}.')
        transform = np.asarray(transform, dtype=np.float64)
        if np.linalg.det(transform[:3, :3]) < 0:
            # A mirrored node turns its faces inside out.
            patch = Patch.of(geometry, notes, open_image).mirrored()
            faces = faces[:, ::-1]
        else:
            patch = Patch.of(geometry, notes, open_image)
        yield str(node), (vertices @ transform[:3, :3].T + transform[:3, 3], faces, patch)


def _check_size(path: Path, kind: str) -> None:
    """Refuse a file over the limits, from its header where the format has one."""
    size = path.stat().st_size
    if size == 0:
        raise AssetError(f'"{path}" is empty.')
    try:
        faces = _count_faces(path, kind, size)
    except (OSError, ValueError, LookupError, TypeError, AttributeError, struct.error, RecursionError):
        faces = None  # The parser says what is wrong with the file.
    if faces is not None and faces > MAX_FACES:
        raise AssetError(f'"{path}" has {faces:,} triangles; at most {MAX_FACES:,} are read. Simplify it first.')
    if size > MAX_BYTES:
        raise AssetError(
            f'"{path}" has {size / 1e6:.0f} MB; at most {MAX_BYTES / 1e6:.0f} MB are read. Simplify it first.'
        )


def _check_stl(path: Path, data: bytes) -> None:
    """Refuse an STL that is neither text nor as long as its header says."""
    if b"facet" in data[:65536].lower():
        return
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else 0
    if len(data) != 84 + 50 * count:
        raise AssetError(
            f'"{path}" is damaged: by its header it has {count:,} triangles, which take {84 + 50 * count:,} bytes, '
            f"and it has {len(data):,}."
        )


def _in_utf8(text: bytes) -> bytes:
    """Text of any encoding that has ASCII in it; older modellers write names of materials in Latin 1."""
    try:
        text.decode("utf-8")
    except UnicodeDecodeError:
        return text.decode("latin-1").encode("utf-8")
    return text


def _count_faces(path: Path, kind: str, size: int) -> int | None:
    """Number of faces by the header (for OBJ and ASCII STL by counting lines), or None."""
    with open(path, "rb") as file:
        head = file.read(65536)
        if kind == "stl":
            count = struct.unpack_from("<I", head, 80)[0] if len(head) >= 84 else 0
            if size == 84 + 50 * count:
                return count
            return _count(file, b"endfacet", size)
        if kind == "obj":
            return _count(file, b"\nf ", size)
        if kind == "ply":
            declared = [line.split() for line in head.split(b"end_header")[0].splitlines()]
            return sum(
                int(words[2]) for words in declared if words[:2] in ([b"element", b"face"], [b"element", b"tristrips"])
            )
        if kind == "off":
            words = b" ".join(line.split(b"#")[0] for line in head.splitlines()).split()
            return int(words[2 if words[0].lower().endswith(b"off") else 1])
        if kind == "glb":
            length = struct.unpack_from("<I", head, 12)[0]
            file.seek(20)
            return _count_gltf(file.read(min(length, MAX_BYTES)))
        return _count_gltf(head + file.read(MAX_BYTES)) if kind == "gltf" and size <= MAX_BYTES else None


def _count(file: io.BufferedReader, pattern: bytes, size: int) -> int | None:
    if size > MAX_BYTES:
        return None
    with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as view:
        return sum(
            view[start : start + (1 << 24) + len(pattern) - 1].count(pattern) for start in range(0, size, 1 << 24)
        )


def _count_gltf(text: bytes) -> int:
    """Triangles that the JSON of a glTF file declares; its accessors may claim more than the file holds."""
    tree = json.loads(text)
    accessors = [int(accessor["count"]) for accessor in tree.get("accessors", [])]
    used = [primitive for mesh in tree.get("meshes", []) for primitive in mesh["primitives"]]
    faces = sum(accessors[item.get("indices", item["attributes"]["POSITION"])] // 3 for item in used)
    return max(faces, max(accessors, default=0) // 6)


def make_resolver(path: Path, texture_root: str | os.PathLike[str] | None) -> Any:
    """Reader of the files that a mesh file refers to, kept inside one folder."""
    from trimesh.resolvers import Resolver

    folder = path.parent.resolve()
    root = Path(texture_root).resolve() if texture_root is not None else folder

    class FolderResolver(Resolver):
        """Opens material, buffer and image files below `root` and remembers what it refused."""

        def __init__(self) -> None:
            self.refused: list[str] = []
            self.opened: list[Path] = []
            self.file_name = path.name
            self.root = root

        def get(self, name: str) -> bytes:
            """Contents of the file called `name`, relative to the mesh file's folder."""
            target = (folder / str(name).strip()).resolve()
            reason = None
            if "://" in name or not (target.is_relative_to(root) or target.is_relative_to(folder)):
                reason = "lies outside the mesh's folder"
            elif target.suffix.lower() not in _SIDE_FILES:
                reason = "is not a material, buffer or image"
            elif not target.is_file():
                reason = "does not exist"
            elif target.stat().st_size > MAX_BYTES:
                reason = "is too large"
            if reason:
                self.refused.append(f'"{name}" {reason} and was not read')
                raise ValueError(self.refused[-1])
            self.opened.append(target)
            data = target.read_bytes()
            return _in_utf8(data) if target.suffix.lower() == ".mtl" else data

        def keys(self) -> list[str]:
            """Nothing is listed: files are opened by name."""
            return []

        def namespaced(self, namespace: str) -> FolderResolver:
            """The same resolver: names are relative to the mesh file."""
            return self

        def write(self, name: str, data: Any) -> None:
            """Reading never writes."""
            raise ValueError(f'"{name}" is not written')

    return FolderResolver()


def files_beside(path: Path, texture_root: str | os.PathLike[str] | None) -> tuple[str, ...]:
    """Path, size and time of the mesh file and of all that it may draw from; equal for files that have not changed."""
    found = []
    for folder in {path.resolve().parent, Path(texture_root or path.parent).resolve()}:
        with os.scandir(folder) as entries:
            for entry in entries:
                if entry.is_file():
                    status = entry.stat()
                    found.append(f"{entry.path} {status.st_size} {status.st_mtime_ns}")
    return str(path.resolve()), *sorted(found)
