"""Mesh files as objects."""

from __future__ import annotations

from pathlib import Path

from pat3d.assets.library.body import Body
from pat3d.assets.mesh.load import GLTF, load_mesh


def read_mesh(path: Path, root: Path) -> Body:
    """The object of a mesh file of any format that is read; textures come from anywhere below `root`.

    Raises:
        AssetError: as `load_mesh`.
    """
    loaded = load_mesh(path, texture_root=root)
    gltf = path.suffix.lower().lstrip(".") in GLTF
    return Body(
        mesh=loaded,
        metres=loaded.metres,
        up=loaded.up,
        declared="the glTF standard" if gltf else "the file" if loaded.metres else "",
        files=loaded.files,
    )
