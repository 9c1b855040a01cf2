"""What URDF and SDF share: careful XML, numbers, poses, geometry, mesh files found by their address."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Piece, Points, of_mesh
from pat3d.assets.mesh.load import FORMATS, GLTF, load_mesh
from pat3d.errors import AssetError
from pat3d.geometry.rotations import about

MAX_BYTES = 5_000_000
GRAY = (0.7, 0.7, 0.7)
FOLLOWED = "copy the folder with its links followed (cp -rL)."
"""What to do about links as the cache of Hugging Face has them."""
_DECLARATION = re.compile(r"^\s*<\?xml[^>]*\?>")


def read_root(path: Path) -> ET.Element:
    """The root element of an XML file.

    Raises:
        AssetError: it is large, no XML, or declares entities.
    """
    if path.stat().st_size > MAX_BYTES:
        raise AssetError(f"{path.name} has more than {MAX_BYTES:,} bytes.")
    text = path.read_text(encoding="utf-8", errors="replace").lstrip("\ufeff")
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise AssetError(f"{path.name} declares a document type or entities, which are not read.")
    try:
        # Some tools write XML version 0.0, which no parser takes; nothing in the declaration matters here.
        return ET.fromstring(_DECLARATION.sub("", text))
    except ET.ParseError as error:
        raise AssetError(f"{path.name} is no XML: {error}.") from error


def numbers(text: str | None, count: int, default: float | None = None) -> Points:
    """`count` finite numbers of a text; the default for each where there is no text.

    Raises:
        AssetError: they are something else.
    """
    if text is None or not text.strip():
        if default is None:
            raise AssetError(f"{count} numbers are missing.")
        return np.full(count, default)
    try:
        values = np.array([float(word) for word in text.replace(",", " ").split()])
    except ValueError:
        values = np.zeros(0)
    if len(values) != count or not np.isfinite(values).all():
        raise AssetError(f'"{text.strip()[:60]}": {count} finite numbers were expected.')
    return values


def turned(roll: float, pitch: float, yaw: float) -> Points:
    """Rotation about the fixed x, then y, then z axis [rad], shape (3, 3)."""
    return about("z", float(yaw)) @ about("y", float(pitch)) @ about("x", float(roll))


def address(said: str, path: Path, root: Path) -> Path:
    """The file that `said` in the description at `path` means, inside `root`.

    "package://" and "model://" name a folder that may be the root itself or lie anywhere above the description.

    Raises:
        AssetError: there is none inside the library.
    """
    bare = re.sub(r"^(package|model|file)://", "", said.strip())
    words = Path(bare).parts
    tried = [path.parent / bare]
    for above in [path.parent, *path.parent.parents]:
        if not above.is_relative_to(root):
            break
        tried += [above.joinpath(*words), above.joinpath(*words[1:])]
    for one in tried:
        target = one.resolve()
        if target.is_file() and target.is_relative_to(root.resolve()):
            return target
    if any(one.is_symlink() for one in tried):
        raise AssetError(f'"{said}" is a link to a file outside the library; {FOLLOWED}')
    raise AssetError(f'"{said}" is not there, or lies outside the library.')


def mesh_piece(said: str, path: Path, root: Path, notes: list[str]) -> Piece:
    """The triangles of the mesh file that a description names, in metres by the unit that the file says.

    Its axes are taken as they stand, as RViz takes COLLADA's.

    Raises:
        AssetError: it is not there, or of a format that is not read.
    """
    target = address(said, path, root)
    if target.suffix.lower().lstrip(".") not in FORMATS:
        raise AssetError(f'"{said}" is of a format that is not read; valid are {", ".join(FORMATS)}.')
    loaded = load_mesh(target, texture_root=root)
    notes += loaded.notes
    if loaded.up not in (None, "z") and target.suffix.lower().lstrip(".") not in GLTF:
        notes.append(f'"{said}" says that {loaded.up} points up; in a description its axes are taken as they stand')
    return of_mesh(replace(loaded, vertices=loaded.vertices * (loaded.metres or 1.0)))


def inertia_of(element: ET.Element | None, get) -> Points | None:
    """The tensor of an <inertia> whose six numbers `get` finds."""
    if element is None:
        return None
    xx, xy, xz, yy, yz, zz = (
        float(numbers(get(element, key), 1, 0.0)[0]) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    )
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return tensor if math.isfinite(tensor.sum()) and tensor.any() else None
