"""A scene folder written anew after its scene changed: the formats that it had, verification, report and pictures."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pat3d.check.verification import Verification, verify
from pat3d.errors import SpecError
from pat3d.exporters.compare import ParityReport, parity
from pat3d.exporters.formats import VIEWS, export, exported
from pat3d.generation.report import FORMAT, VERSION, of_scene
from pat3d.generation.settle_stage import SettledScene
from pat3d.progress import Clock, Event, Progress
from pat3d.scene.checksums import record_checksums
from pat3d.scene.folder import OWN, read_json, replacing, write_json
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Scene

_STALE = ("inputs", "reused", "delivered_attempt", "edits", "engines")
"""Of a report: what would let --resume of another command take the changed scene for its own, earlier edits, and what
other engines did with the scene as it was."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Rewritten:
    """A scene folder as it was written anew."""

    settled: SettledScene
    verification: Verification
    exports: Mapping[str, ParityReport] = field(default_factory=dict)
    """What was read back of every format that was written."""

    @property
    def failures(self) -> tuple[str, ...]:
        """What is wrong with the scene, a line each."""
        restless = () if self.settled.at_rest else ("settling did not come to rest.",)
        unequal = (line for one in self.exports.values() for line in one.failures)
        return (*restless, *self.verification.failures, *unequal)


def read_folder(folder: Path, progress: Progress) -> Scene:
    """The scene in `folder`.

    Raises:
        SpecError: there is none.
    """
    if not folder.is_dir():
        raise SpecError(f"{folder} is not a folder; give a scene folder, as generate and build write it.")
    progress(Event(stage="reading the scene"))
    return load_scene(folder)


def rewrite(
    scene: Scene,
    settled: SettledScene,
    *,
    source: Path,
    target: Path,
    clock: Clock,
    progress: Progress,
    verification: Verification | None = None,
    more: Mapping[str, Any] | None = None,
) -> Rewritten:
    """Write the settled `scene`, which came from the folder `source`, into the folder `target`.

    Args:
        scene: at rest.
        settled: how it came there.
        source: whose formats are written, and whose report is continued.
        target: folder to write.
        clock: adds up the stages.
        progress: told what is going on.
        verification: of the scene, where it was verified already.
        more: what else the report says.

    Raises:
        ExportError: it cannot be written.
    """
    from pat3d.view.preview import save_preview

    earlier = read_json(source / "report.json")
    formats, usd = exported(source)
    with replacing(target) as fresh:
        with clock("export"):
            paths = export(scene, formats, fresh, progress=progress, **usd)
            exports = {
                name: parity(scene, path).moved(fresh, target) for name, path in paths.items() if name not in VIEWS
            }
        if verification is None:
            with clock("verification"):
                verification = verify(scene, fresh / "mjcf" / "scene.xml", progress)
        with clock("files"):
            progress(Event(stage="writing the folder"))
            save_scene(scene, fresh)
            settled.write(tuple(obj.name for obj in scene.objects), fresh)
            record_checksums(fresh)
        with clock("preview"):
            progress(Event(stage="drawing the preview"))
            save_preview(scene, fresh / "preview.png")
        written = Rewritten(settled=settled, verification=verification, exports=exports)
        write_json(fresh / "report.json", {**_report(scene, written, earlier, clock), **(more or {})})
    return written


def _report(scene: Scene, written: Rewritten, earlier: Mapping[str, Any], clock: Clock) -> dict[str, Any]:
    return {
        "prompt": scene.prompt,
        "seed": scene.seed,
        **{key: value for key, value in earlier.items() if key not in _STALE},
        "format": FORMAT,
        "version": VERSION,
        **of_scene(scene, written.settled, written.verification),
        "exports": {name: one.as_dict() for name, one in written.exports.items()},
        "passed": not written.failures,
        "failures": list(written.failures),
        "seconds": dict(clock.seconds),
    }


def copy_folder(source: Path, target: Path) -> None:
    """The scene folder as it is, at another place."""
    with replacing(target) as fresh:
        for name in OWN:
            if (source / name).is_dir():
                shutil.copytree(source / name, fresh / name, dirs_exist_ok=True)
            elif (source / name).is_file():
                shutil.copy2(source / name, fresh / name)
