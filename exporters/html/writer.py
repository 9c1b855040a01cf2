"""HTML: the scene as one file that opens from disk in a browser, can be turned, and lists its objects with their facts.

Everything is in the file: meshes (quantised and deflated), textures, and the viewer of viewer.js, which needs WebGL 2
and nothing from the network.
"""

from __future__ import annotations

import base64
import html
import io
import json
import zlib
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.exporters.common.corners import corner_mesh
from pat3d.exporters.common.folder import export_folder
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.model import Scene, SceneObject
from pat3d.scene.versions import VERSION

TEXTURE_SIDE = 1024
"""Longest side of a texture [pixel]; larger ones are reduced."""

_STEPS = 65535
"""Positions are whole numbers of this many steps over the mesh's bounding box."""


def write_html(scene: Scene, folder: str | Path) -> Path:
    """Write `scene` as scene.html into `folder`, replacing it as a whole.

    Returns:
        The path of scene.html.

    Raises:
        ExportError: `folder` is a file, holds something else, or cannot be written.
    """
    folder = Path(folder)
    with export_folder(folder, marker="scene.html", what="HTML") as fresh:
        (fresh / "scene.html").write_text(page(scene), encoding="utf-8")
    return folder / "scene.html"


def page(scene: Scene) -> str:
    """The whole file."""
    title = scene.prompt or "PAT3D scene"
    parts = {
        "@TITLE@": html.escape(title),
        "@STYLE@": _source("viewer.css"),
        "@DATA@": _json(_document(scene, title)),
        "@SCRIPT@": _source("viewer.js"),
    }
    # In one pass, so that no prompt can stand for another part.
    text = _source("viewer.html")
    for mark in parts:
        before, _, after = text.partition(mark)
        text = f"{before}\0{mark}\0{after}"
    return "".join(parts.get(piece, piece) for piece in text.split("\0"))


def _source(name: str) -> str:
    return resources.files("pat3d.exporters.html").joinpath(name).read_text(encoding="utf-8")


def _json(document: Mapping[str, Any]) -> str:
    """JSON that cannot end the script element that it stands in."""
    text = json.dumps(document, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029").replace("\0", "")


def _document(scene: Scene, title: str) -> dict[str, Any]:
    assets: dict[int, int] = {}
    meshes = []
    for obj in scene.objects:
        if id(obj.asset) not in assets:
            assets[id(obj.asset)] = len(meshes)
            meshes.append(_mesh(obj.asset.visual))
    return {
        "title": title,
        "version": VERSION,
        "seed": scene.seed,
        "history": [str(edit) for edit in scene.history],
        "relations": [str(one) for one in (*scene.relations, *scene.arrangements)],
        "meshes": meshes,
        "objects": [
            {
                "name": obj.name,
                "mesh": assets[id(obj.asset)],
                "pose": _pose(obj.pose),
                "initial": _pose(obj.initial_pose),
                "facts": _facts(scene, obj),
            }
            for obj in scene.objects
        ],
    }


def _facts(scene: Scene, obj: SceneObject) -> list[tuple[str, str]]:
    """Names and values that a person reads."""
    asset = obj.asset
    # No "-0.000".
    x, y, z = (round(value, 3) + 0.0 for value in obj.pose.position)
    return [
        ("kind", asset.noun),
        ("asked for as", obj.phrase or "-"),
        ("rests on", "fixed" if obj.fixed else ", ".join(scene.carriers(obj.name))),
        ("mass", f"{asset.mass_properties.mass:.3g} kg"),
        ("material", f"{asset.material.name}, friction {asset.material.friction:g}"),
        ("size", " x ".join(f"{100 * side:.1f}" for side in asset.size) + " cm"),
        ("position", f"{x:.3f}, {y:.3f}, {z:.3f} m"),
        ("convex parts", str(len(asset.parts))),
        ("from", _origin(asset)),
    ]


def _origin(asset: Asset) -> str:
    source = asset.provenance.get("source", "unknown")
    named = asset.provenance.get("file") or asset.provenance.get("noun")
    return f"{source}: {named}" if named else str(source)


def _pose(pose: Pose) -> list[float]:
    return [round(value, 7) for value in (*pose.position, *pose.quat_wxyz)]


def _mesh(mesh: VisualMesh) -> dict[str, Any]:
    corners = corner_mesh(mesh)
    low = corners.positions.min(axis=0)
    span = np.maximum(corners.positions.max(axis=0) - low, 1e-9)
    positions = np.round((corners.positions - low) / span * _STEPS).astype("<u2")
    normals = np.round(corners.normals * 127).astype("i1")
    # Four components each, as graphics cards read whole words.
    padded = np.zeros((len(positions), 4), "<u2")
    padded[:, :3] = positions
    directed = np.zeros((len(normals), 4), "i1")
    directed[:, :3] = normals
    uv = np.round(np.clip(corners.uv, 0.0, 1.0) * _STEPS).astype("<u2")
    return {
        "low": [round(float(value), 7) for value in low],
        "span": [round(float(value), 7) for value in span],
        "count": len(positions),
        "corners": int(corners.faces.size),
        "data": _packed(padded, directed, uv, corners.faces.astype("<u4")),
        "texture": _picture(mesh.texture),
    }


def _packed(*arrays: NDArray[Any]) -> str:
    raw = b"".join(np.ascontiguousarray(one).tobytes() for one in arrays)
    return base64.b64encode(zlib.compress(raw, 9)).decode("ascii")


def _picture(texture: NDArray[np.uint8]) -> str:
    """A data URL: PNG, or JPEG where that is smaller, as it is for photographs."""
    from PIL import Image

    picture = Image.fromarray(texture)
    if max(picture.size) > TEXTURE_SIDE:
        picture.thumbnail((TEXTURE_SIDE, TEXTURE_SIDE), Image.Resampling.LANCZOS)
    found = {}
    for kind, options in (("png", {"optimize": True}), ("jpeg", {"quality": 85})):
        with io.BytesIO() as data:
            picture.save(data, kind, **options)
            found[kind] = data.getvalue()
    small = max(picture.size) <= 64 or len(found["png"]) <= len(found["jpeg"])
    kind = "png" if small else "jpeg"
    return f"data:image/{kind};base64,{base64.b64encode(found[kind]).decode('ascii')}"
