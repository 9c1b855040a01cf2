"""Mesh files as objects."""

from __future__ import annotations

from pathlib import Path

from pat3d.assets.library.body import Body
from pat3d.assets.mesh.load import load_mesh


def read_mesh(path: Path, root: Path) -> Body:
    """The object of an OBJ, STL, PLY, OFF, GLB or glTF file; textures come from anywhere below `root`.

    Raises:
        AssetError: as `load_mesh`.
    """
    loaded = load_mesh(path, texture_root=root)
    gltf = path.suffix.lower() in (".glb", ".gltf")
    return Body(
        mesh=loaded,
        metres=1.0 if gltf else None,
        up="y" if gltf else None,
        declared="the glTF standard" if gltf else "",
        files=loaded.files,
    )
