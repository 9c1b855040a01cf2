"""SimReady: every asset of a scene as NVIDIA's Robotics-Prop profile wants it, for asset libraries and Omniverse.

    assets.json                                     the assets and their files
    <name>/usd/<name>.usdc                          rigid body, colliders, look, labels, and its facts as layer data
    <name>/usd/.thumbs/256x256/<name>.usdc.png      what it looks like

The layers are those of the USD export, each in a folder of its own. What the profile asks for and nobody knows is said
so: the licence is that of the asset's source, or "unknown"; the Wikidata code is that of any physical object.
"""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.exporters.common.folder import export_folder
from pat3d.exporters.common.objects import stored_assets
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.folder import write_json
from pat3d.scene.model import Scene
from pat3d.scene.versions import VERSION

INDEX = "assets.json"

THUMBNAIL = 256
"""Width and height of the picture [pixel]."""

PHYSICAL_OBJECT = "Q223557"
"""Wikidata's code of what every asset is; which noun it is, the semantic labels say."""


def write_simready(scene: Scene, folder: str | Path) -> Path:
    """Write every asset of `scene` into `folder`, replacing it as a whole.

    Returns:
        The path of assets.json.

    Raises:
        ExportError: `folder` is a file, holds something else, or cannot be written.
    """
    from pat3d.exporters.usd.scene_layer import prim_name

    folder = Path(folder)
    with export_folder(folder, marker=INDEX, what="SimReady assets") as fresh:
        stored, files = stored_assets(scene), {}
        for obj in scene.objects:
            name = prim_name(stored[id(obj.asset)])
            if name not in files:
                files[name] = _write(obj.asset, name, fresh).relative_to(fresh).as_posix()
        write_json(fresh / INDEX, {"format": "pat3d-simready", "version": 1, "assets": files})
    return folder / INDEX


def _write(asset: Asset, name: str, folder: Path) -> Path:
    from pat3d.exporters.usd.asset_layer import write_asset
    from pat3d.exporters.usd.openusd import Sdf

    path = folder / name / "usd" / f"{name}.usdc"
    path.parent.mkdir(parents=True)
    write_asset(asset, name, path)
    layer = Sdf.Layer.FindOrOpen(str(path))
    facts = _facts(asset, name)
    # Versions of the profile differ in where they look for these.
    outside = {key: facts[key] for key in ("asset_name", "asset_type", "source_file", "usd_date_generated")}
    layer.customLayerData = {**outside, "SimReady_Metadata": facts}
    layer.Save()
    _draw(asset, path.parent / ".thumbs" / f"{THUMBNAIL}x{THUMBNAIL}" / f"{path.name}.png")
    return path


def _facts(asset: Asset, name: str) -> dict[str, Any]:
    from pat3d.exporters.usd.openusd import Gf

    made = asset.provenance
    ours = made.get("source") == "catalogue"
    return {
        "asset_name": name,
        "asset_type": "prop",
        "source_file": str(made.get("file") or f"{asset.noun}, a recipe of PAT3D {VERSION}"),
        "usd_date_generated": datetime.now(UTC).date().isoformat(),
        "author": f"made with PAT3D {VERSION}",
        "asset_license": str(made.get("licence") or ("Apache-2.0" if ours else "unknown")),
        "category": asset.noun,
        "qcode": PHYSICAL_OBJECT,
        "rigid_body_count": 1,
        "asset_extents": Gf.Vec3f(*np.ptp(asset.visual.bounds, axis=0).tolist()),
        "mass": float(asset.mass_properties.mass),
    }


def _draw(asset: Asset, path: Path) -> None:
    from pat3d.view.preview import save_png
    from pat3d.view.render import render
    from pat3d.view.viewpoint import overlooking

    path.parent.mkdir(parents=True)
    items = [(asset.visual, Pose())]
    camera = overlooking([items], aspect=1.0)
    save_png(render(items, camera=camera, width=THUMBNAIL, height=THUMBNAIL), path)
