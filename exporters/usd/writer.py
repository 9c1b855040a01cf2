"""USD: a scene for Isaac Sim, Newton and every other reader of UsdPhysics.

Metres, kilograms, Z up. Masses, centres and inertias are on the bodies and never on colliders; every convex part is a
collider of its own, boxes as cubes where the MJCF export has boxes; objects that do not move carry no rigid body;
nothing is an articulation. Poses and the places of colliders are in double precision; what the schema keeps in single
precision is rounded once.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from tempfile import TemporaryDirectory

from pat3d.errors import ExportError
from pat3d.exporters.common.folder import export_folder
from pat3d.scene.asset import Asset
from pat3d.scene.model import Scene
from pat3d.scene.naming import slug

SUFFIXES = (".usdc", ".usda", ".usdz")


def write_usd(
    scene: Scene, folder: str | Path, *, text: bool = False, package: bool = False, levels: Sequence[int] = ()
) -> Path:
    """Write `scene` as scene.usdc with one referenced layer an asset into `folder`, replacing it as a whole.

    Args:
        scene: what to write.
        folder: new, empty, or an earlier export.
        text: scene.usda and assets to match, for people to read.
        package: also scene.usdz, the same in one file.
        levels: most triangles of coarser levels of detail, each less than the one before; what is seen of every object
            has them as variants of its set "lod", the full one chosen.

    Returns:
        The path of scene.usdc, or of scene.usda.

    Raises:
        ExportError: `folder` is a file or holds something else than a USD export, or usd-core is not installed.
    """
    from pat3d.exporters.usd.scene_layer import write_scene

    with _replaced(Path(folder), "scene") as fresh:
        path = write_scene(scene, fresh, suffix="usda" if text else "usdc", levels=levels)
        if package:
            with TemporaryDirectory(prefix="pat3d-usdz-") as scratch:
                # Layers in a package are binary, whatever lies beside it.
                layers = path if not text else write_scene(scene, Path(scratch), suffix="usdc", levels=levels)
                _package(layers, path.with_suffix(".usdz"))
    return Path(folder) / path.name


def write_usd_asset(
    asset: Asset, folder: str | Path, name: str | None = None, *, text: bool = False, levels: Sequence[int] = ()
) -> Path:
    """Write one asset as `<name>.usdc` with its texture into `folder`, replacing it as a whole.

    Args:
        asset: what to write.
        folder: new, empty, or an earlier export of the same name.
        name: of the file and the body; the asset's noun where not given.
        text: .usda in place of .usdc.
        levels: as for `write_usd`.

    Returns:
        The path of the layer.

    Raises:
        ExportError: `folder` is a file or holds something else, or usd-core is not installed.
    """
    from pat3d.exporters.usd.asset_layer import write_asset
    from pat3d.exporters.usd.scene_layer import prim_name

    stem = prim_name(slug(name or asset.noun))
    file = f"{stem}.{'usda' if text else 'usdc'}"
    with _replaced(Path(folder), stem) as fresh:
        write_asset(asset, stem, fresh / file, levels=levels)
    return Path(folder) / file


def levels_of(folder: str | Path) -> tuple[int, ...]:
    """The `levels` that the USD export in `folder` was written with; none where it is damaged.

    Raises:
        ExportError: usd-core is not installed.
    """
    from pat3d.exporters.usd.openusd import Sdf, Tf

    found = [path for suffix in SUFFIXES[:2] if (path := Path(folder) / f"scene{suffix}").is_file()]
    try:
        layer = Sdf.Layer.FindOrOpen(str(found[0])) if found else None
    except Tf.ErrorException:
        return ()
    return () if layer is None else tuple(map(int, layer.customLayerData.get("pat3d", {}).get("levels", ())))


def _package(path: Path, package: Path) -> None:
    """Write everything that the layer at `path` needs as the .usdz file `package`."""
    from pat3d.exporters.usd.openusd import Sdf, UsdUtils

    if not UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(path)), str(package)):
        raise ExportError(f"{package.name}: usd-core could not package {path.name}.")


def _replaced(folder: Path, stem: str) -> AbstractContextManager[Path]:
    """A new folder that takes the place of `folder` when the block ends without an error."""
    first, *others = (f"{stem}{suffix}" for suffix in SUFFIXES)
    return export_folder(folder, marker=first, what="USD", or_markers=tuple(others))
