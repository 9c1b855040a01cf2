"""GLB: the scene in one binary glTF file, for viewers, slides and modelling programs.

glTF has y up, so one node above all others turns the scene. Every object is a node under its name, with its facts as
extras; objects that share an asset share the mesh. There is no physics in it.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.materials import surface_of
from pat3d.errors import ExportError
from pat3d.exporters.common.corners import corner_mesh
from pat3d.exporters.common.folder import export_folder
from pat3d.exporters.common.objects import stored_assets
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.model import Scene, SceneObject

ROOT = "z up to y up"
"""Name of the node that turns the scene."""

TURN = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""From z up to y up."""

_RESERVED = ROOT, "world"


def write_glb(scene: Scene, folder: str | Path) -> Path:
    """Write `scene` as scene.glb into `folder`, replacing it as a whole.

    Returns:
        The path of scene.glb.

    Raises:
        ExportError: `folder` is a file, holds something else, or cannot be written.
    """
    folder = Path(folder)
    taken = next((obj.name for obj in scene.objects if obj.name in _RESERVED), None)
    if taken is not None:
        raise ExportError(f'"{taken}" cannot be the name of an object in a GLB file; rename it.')
    with export_folder(folder, marker="scene.glb", what="GLB") as fresh:
        (fresh / "scene.glb").write_bytes(_bytes(scene))
    return folder / "scene.glb"


def _bytes(scene: Scene) -> bytes:
    import trimesh

    made = trimesh.Scene(base_frame="world")
    made.graph.update(frame_from="world", frame_to=ROOT, matrix=TURN)
    names, there = stored_assets(scene), set()
    for obj in scene.objects:
        name = names[id(obj.asset)]
        if name in there:
            made.graph.update(frame_from=ROOT, frame_to=obj.name, matrix=_matrix(obj.pose), geometry=name)
        else:
            there.add(name)
            made.add_geometry(
                textured_mesh(obj.asset, name),
                geom_name=name,
                node_name=obj.name,
                parent_node_name=ROOT,
                transform=_matrix(obj.pose),
            )
        made.graph.transforms.edge_data[(ROOT, obj.name)]["metadata"] = dict(_extras(scene, obj))
    data = made.export(file_type="glb", include_normals=True)
    if not isinstance(data, bytes):
        raise ExportError("trimesh wrote no GLB.")
    return data


def textured_mesh(asset: Asset, name: str) -> Any:
    """The visual mesh of `asset` with its texture, for trimesh, in the asset frame [m]; `name` is its material's."""
    import trimesh
    from PIL import Image
    from trimesh.visual import TextureVisuals
    from trimesh.visual.material import PBRMaterial

    corners = corner_mesh(asset.visual)
    maps, look = asset.visual.maps, surface_of(asset)
    colour = Image.fromarray(asset.visual.texture)
    clear = "opacity" in maps or look.opacity < 1.0
    if "opacity" in maps:
        colour.putalpha(Image.fromarray(maps["opacity"]))
    both = None
    if "roughness" in maps or "metallic" in maps:
        blank = np.full(asset.visual.texture.shape[:2], 255, dtype=np.uint8)
        both = Image.fromarray(np.stack([blank, maps.get("roughness", blank), maps.get("metallic", blank)], axis=-1))
    material = PBRMaterial(
        name=name,
        baseColorTexture=colour,
        baseColorFactor=[1.0, 1.0, 1.0, 1.0 if "opacity" in maps else look.opacity],
        metallicFactor=1.0 if "metallic" in maps else look.metallic,
        roughnessFactor=1.0 if "roughness" in maps else look.roughness,
        metallicRoughnessTexture=both,
        normalTexture=Image.fromarray(maps["normal"]) if "normal" in maps else None,
        alphaMode="BLEND" if clear else None,
    )
    return trimesh.Trimesh(
        vertices=corners.positions,
        faces=corners.faces,
        vertex_normals=corners.normals,
        visual=TextureVisuals(uv=corners.uv, material=material),
        process=False,
    )


def _extras(scene: Scene, obj: SceneObject) -> Mapping[str, Any]:
    return {
        "noun": obj.asset.noun,
        "mass_kg": obj.asset.mass_properties.mass,
        "friction": obj.asset.material.friction,
        "material": obj.asset.material.name,
        "fixed": obj.fixed,
        "rests_on": list(scene.carriers(obj.name)),
    }


def _matrix(pose: Pose) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = pose.rotation, pose.position
    return matrix
