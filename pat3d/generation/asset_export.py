"""One mesh file as a finished asset: repaired, weighed, decomposed, dropped, and written in every format."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.mesh.importing import import_mesh
from pat3d.assets.mesh.load import FORMATS as MESH_FORMATS
from pat3d.assets.mesh.simplify import coarser
from pat3d.check.drop import DropReport, ground_drop
from pat3d.errors import AssetError
from pat3d.exporters.compare import ParityReport, parity
from pat3d.exporters.formats import VIEWS, chosen, export
from pat3d.geometry.pose import Pose
from pat3d.progress import Event, Progress, silent
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.checksums import record_checksums
from pat3d.scene.folder import check_target, replacing, write_json
from pat3d.scene.io import save_scene
from pat3d.scene.model import Scene, SceneObject
from pat3d.scene.naming import slug, unique_slugs
from pat3d.scene.versions import versions

CLEARANCE = 1e-5
"""Gap between the object and the ground [m]."""

MAX_REACH = 0.02
"""Convex parts that reach further beyond the mesh than this, in longest sides of it, are a failure."""

MAX_MESHES = 1000
"""Mesh files that one folder may hold."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ExportedAsset:
    """A mesh that was written as an asset."""

    asset: Asset
    folder: Path
    parities: Mapping[str, ParityReport]
    drop: DropReport | None
    """None where MJCF was not written."""

    @property
    def failures(self) -> tuple[str, ...]:
        """What is wrong with it, a line each."""
        lines = [line for report in self.parities.values() for line in report.failures]
        lines += [f'"{self.asset.noun}": {line}' for line in (self.drop.failures if self.drop else ())]
        if self.reach > MAX_REACH * float(np.ptp(self.asset.visual.bounds, axis=0).max()):
            lines.append(f'"{self.asset.noun}": the convex parts reach {1e3 * self.reach:.3g} mm beyond the mesh.')
        return tuple(lines)

    @property
    def reach(self) -> float:
        """How far the convex parts reach beyond the bounding box of the mesh [m]."""
        inner, outer = self.asset.visual.bounds, self.asset.bounds
        return float(max((inner[0] - outer[0]).max(), (outer[1] - inner[1]).max()))

    @property
    def cavity_loss(self) -> float | None:
        """Median fraction of the cavity's radius that the convex parts take; None where there is no cavity."""
        loss = self.asset.provenance.get("parts", {}).get("cavity_loss")
        return None if loss is None else float(loss)

    def summary(self) -> dict[str, Any]:
        """Plain data for summary.json."""
        asset, properties = self.asset, self.asset.mass_properties
        record = asset.provenance
        return {
            "format": "pat3d-asset-summary",
            "version": 1,
            "name": asset.noun,
            "file": record.get("file"),
            "sha256": record.get("sha256"),
            "size_m": asset.size.tolist(),
            "mass_kg": properties.mass,
            "volume_m3": properties.volume,
            "density_kg_m3": asset.material.density,
            "material": asset.material.name,
            "friction": asset.material.friction,
            "centre_of_mass_m": list(properties.centre_of_mass),
            "inertia_kg_m2": [list(row) for row in properties.inertia],
            "principal_moments_kg_m2": np.linalg.eigvalsh(np.array(properties.inertia)).tolist(),
            "watertight": record.get("watertight"),
            "repairs": record.get("repairs", []),
            "parts": len(asset.parts),
            "boxes": sum(part.box is not None for part in asset.parts),
            "largest_part_vertices": max(len(part.vertices) for part in asset.parts),
            "sticks_out_m": record.get("parts", {}).get("sticks_out"),
            "inflation_m": record.get("parts", {}).get("inflation"),
            "reach_m": self.reach,
            "cavity_loss": self.cavity_loss,
            "drop": None if self.drop is None else self.drop.as_dict(),
            "parity": {name: report.as_dict() for name, report in self.parities.items()},
            "passed": not self.failures,
            "versions": versions(),
        }


def mesh_files(source: Path) -> dict[Path, str]:
    """The mesh files that `source` means, each with a name for its folder.

    A file means itself, a folder the meshes in it, or where there are none, those in the folders below.

    Raises:
        AssetError: there is none, or more than MAX_MESHES.
    """
    if source.is_file():
        return {source: slug(source.stem)}
    if not source.is_dir():
        raise AssetError(f"there is no file or folder {source}.")
    suffixes = {f".{name}" for name in MESH_FORMATS}
    for pattern in ("*", "**/*"):
        found = sorted(path for path in source.glob(pattern) if path.suffix.lower() in suffixes and path.is_file())
        if len(found) > MAX_MESHES:
            raise AssetError(f"{source} holds {len(found)} meshes; at most {MAX_MESHES} at a time.")
        if found:
            names = {path: str(path.relative_to(source).with_suffix("")) for path in found}
            slugs = unique_slugs(str(path) for path in found)
            short = unique_slugs(dict.fromkeys(names.values()))
            alone = len(set(names.values())) == len(names)
            return {path: short[names[path]] if alone else slugs[str(path)] for path in found}
    raise AssetError(f"{source} holds no scene.json and no mesh. Mesh formats: {', '.join(MESH_FORMATS)}.")


def export_asset(
    path: Path,
    out: Path,
    formats: Iterable[str],
    *,
    progress: Progress = silent,
    usd: Mapping[str, Any] | None = None,
    max_triangles: int | None = None,
    **options: Any,
) -> ExportedAsset:
    """Import the mesh at `path` and write it into the folder `out` in every format of `formats`.

    The folder is a scene folder of one object that stands on the ground, with preview.png (the mesh beside its convex
    parts) and summary.json (mass properties, repairs, parts, drop, parity).

    Args:
        path: a mesh file.
        out: replaced as a whole.
        formats: names of exchange formats.
        progress: told what is going on.
        usd: settings of `write_usd`.
        max_triangles: of what is seen; more are made a coarser level of detail, which `provenance` notes.
        options: those of `import_mesh`.

    Raises:
        AssetError: the mesh or an option cannot be used.
        SpecError: an unknown format.
        ExportError: `out` cannot be written.
    """
    names = chosen(formats)
    folder = check_target(out)
    progress(Event(stage="importing", detail=path.name))
    asset = import_mesh(path, **options)
    if max_triangles is not None:
        asset, _ = coarser(asset, max_triangles, asset.noun)
    pose = Pose(position=(0.0, 0.0, CLEARANCE))
    scene = Scene(
        objects=(SceneObject(name=asset.noun, asset=asset, pose=pose, initial_pose=pose),),
        provenance={"source": "asset", "versions": versions()},
    )
    with replacing(folder) as fresh:
        save_scene(scene, fresh)
        paths = export(scene, names, fresh, progress=progress, **(usd or {}))
        record_checksums(fresh)
        progress(Event(stage="reading back", detail=asset.noun))
        parities = {name: parity(scene, file) for name, file in paths.items() if name not in VIEWS}
        progress(Event(stage="dropping", detail=asset.noun))
        drop = ground_drop(paths["mjcf"]) if "mjcf" in paths else None
        made = ExportedAsset(asset=asset, folder=folder, parities=parities, drop=drop)
        progress(Event(stage="drawing", detail=asset.noun))
        _draw(asset, fresh / "preview.png")
        write_json(fresh / "summary.json", made.summary())
    return made


def _draw(asset: Asset, path: Path) -> None:
    """The mesh beside its convex parts."""
    from pat3d.view.preview import save_png, side_by_side

    count = len(asset.parts)
    panels = [
        (asset.noun, [(asset.visual, Pose())]),
        (f"{count} convex part{'s' if count > 1 else ''}", [(parts_mesh(asset), Pose())]),
    ]
    save_png(side_by_side(panels, width=640, height=520), path)


def parts_mesh(asset: Asset) -> VisualMesh:
    """The convex parts of an asset as one mesh, each in a colour of its own."""
    vertices, faces, colours = [], [], []
    start = 0
    for number, part in enumerate(asset.parts):
        vertices.append(part.vertices)
        faces.append(part.faces + start)
        colours.append(np.tile(_colour(number), (len(part.faces), 1)))
        start += len(part.vertices)
    return VisualMesh.from_face_colours(np.concatenate(vertices), np.concatenate(faces), np.concatenate(colours))


def _colour(number: int) -> np.ndarray:
    """RGB of a part; steps of the golden angle keep neighbours in the list apart."""
    import colorsys

    red, green, blue = colorsys.hsv_to_rgb(number * 0.381966 % 1.0, 0.45, 0.9)
    return np.array([255 * red, 255 * green, 255 * blue], dtype=np.uint8)
