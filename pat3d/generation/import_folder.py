"""`pat3d import`: a scene of somebody else's file as a scene folder, as it is or settled."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.exporters.compare import ParityReport, parity
from pat3d.exporters.formats import VIEWS, chosen, export
from pat3d.generation.edited import laid_out_as_posed
from pat3d.generation.report import FORMAT, VERSION
from pat3d.generation.rewrite import Rewritten, rewrite
from pat3d.generation.settings import Settings
from pat3d.generation.settle_stage import settle_scene
from pat3d.importers.scene import Imported, Joints, import_scene
from pat3d.layout.supports import with_supports
from pat3d.progress import Clock, Event, Progress, silent
from pat3d.scene.checksums import record_checksums
from pat3d.scene.folder import check_target, replacing, write_json
from pat3d.scene.io import save_scene
from pat3d.scene.model import Scene


@dataclass(frozen=True, kw_only=True, eq=False)
class ImportOutcome:
    """A scene folder that was made of a file."""

    imported: Imported
    scene: Scene
    """As it was written."""
    exports: Mapping[str, ParityReport]
    settled: Rewritten | None
    """How it settled and what its verification found; None where it was written as the file has it."""
    moved: Mapping[str, float]
    """How far settling moved the origin of every object [m]."""
    folder: Path

    @property
    def failures(self) -> tuple[str, ...]:
        """What is wrong, a line each."""
        if self.settled is not None:
            return self.settled.failures
        return tuple(line for one in self.exports.values() for line in one.failures)


def import_folder(
    source: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str],
    root: str | os.PathLike[str] | None = None,
    keyframe: str | None = None,
    joints: Joints = "refuse",
    settle: bool = False,
    friction: float = Settings.friction,
    least_tilt: float = Settings.least_tilt,
    cpu_limit: float | None = None,
    device: str = Settings.device,
    formats: Sequence[str] = ("mjcf",),
    progress: Progress = silent,
) -> ImportOutcome:
    """Read the scene, or the object, in `source` and write it as a scene folder.

    Args:
        source: an MJCF, URDF, SDF or USD file, or a folder that holds one.
        out: folder to write.
        root: folder that meshes and pictures may lie in; the one above the file's own where None.
        keyframe: of MJCF, to start from.
        joints: what becomes of what has joints: "refuse", "fix" or "leave-out".
        settle: bring it to rest, and verify it; what overlaps is lifted first.
        friction: Coulomb coefficient [-] of every contact while settling.
        least_tilt: tilt of the ground [degrees] that the scene has to stand to be verified.
        cpu_limit: processor time for decompositions [s]; None for any.
        device: "cpu" or "cuda", to settle on.
        formats: exchange formats to write, MJCF always.
        progress: told what is going on.

    Raises:
        AssetError: nothing usable is there; the message says why.
        CheckError: MuJoCo refuses the file.
        LayoutError: no lift makes the poses free of intersections.
        SimulationError: the scene cannot be simulated.
        ExportError: the folder cannot be written.
    """
    target, clock = check_target(out), Clock()
    Settings(friction=friction, least_tilt=least_tilt, device=device)
    names = chosen(("mjcf", *formats))
    with clock("import"):
        imported = import_scene(
            source, root=root, keyframe=keyframe, joints=joints, cpu_limit=cpu_limit, progress=progress
        )
        scene = with_supports(replace(imported.scene, settling_friction=friction, least_tilt=least_tilt))
    exports = _write(scene, imported, names, target, clock, progress)
    if not settle:
        return ImportOutcome(
            imported=imported, scene=scene, exports=exports, settled=None, moved={}, folder=target
        )  # fmt: skip
    from pat3d.sim.compilation import prepare

    with clock("kernels"):
        name = prepare(device, progress)
    with clock("settling"):
        layout = laid_out_as_posed(scene)
        settled = settle_scene(layout, device=name, progress=progress)
    rest = with_supports(replace(settled.of(layout), relations=()))
    written = rewrite(rest, settled, source=target, target=target, clock=clock, progress=progress)
    moved = {
        new.name: float(np.linalg.norm(np.subtract(new.pose.position, old.pose.position)))
        for new, old in zip(rest.objects, scene.objects, strict=True)
    }
    return ImportOutcome(
        imported=imported, scene=rest, exports=written.exports, settled=written, moved=moved, folder=target
    )  # fmt: skip


def _write(
    scene: Scene, imported: Imported, formats: Sequence[str], target: Path, clock: Clock, progress: Progress
) -> dict[str, ParityReport]:
    """The folder of a scene at the poses of its file."""
    from pat3d.view.preview import save_preview

    with replacing(target) as fresh:
        save_scene(scene, fresh)
        with clock("export"):
            paths = export(scene, formats, fresh, progress=progress)
            exports = {
                name: parity(scene, path).moved(fresh, target) for name, path in paths.items() if name not in VIEWS
            }
        record_checksums(fresh)
        with clock("preview"):
            progress(Event(stage="drawing the preview"))
            save_preview(scene, fresh / "preview.png")
        write_json(
            fresh / "report.json",
            {
                "format": FORMAT,
                "version": VERSION,
                "prompt": scene.prompt,
                "seed": scene.seed,
                "import": import_record(imported),
                "exports": {name: one.as_dict() for name, one in exports.items()},
                "seconds": dict(clock.seconds),
            },
        )
    return exports


def import_record(imported: Imported) -> dict[str, Any]:
    """What the report says of the file that a scene came from; JSON-serialisable."""
    return {
        "file": imported.path.name,
        "format": imported.format,
        "left_out": list(imported.left_out),
        "lifted_m": imported.lifted,
        "parts_kept": imported.kept,
        "shapes_cut": imported.cut,
        "notes": list(imported.notes),
    }
