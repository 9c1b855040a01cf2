"""`pat3d optimize`: a finished scene folder, whose relations broke or which does not stay still, is made anew.

The optimisation starts from the layout that the folder's scene settled from. A scene that is verified and satisfied is
left as it is, and so is one for which nothing better was found.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pat3d.check.verification import Verification, broken, verify
from pat3d.errors import SpecError
from pat3d.exporters.compare import ParityReport, parity
from pat3d.exporters.formats import export, exported
from pat3d.generation.optimize_stage import OptimizedScene, optimize_scene
from pat3d.generation.report import FORMAT, VERSION, of_scene
from pat3d.generation.settle_stage import SettledScene
from pat3d.optimize.optimize import OptimizeOptions
from pat3d.progress import Clock, Event, Progress, silent
from pat3d.scene.checksums import record_checksums
from pat3d.scene.folder import (
    OWN,
    check_target,
    read_json,
    replacing,
    write_json,
    write_pictures,
    write_trajectory,
)
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Scene
from pat3d.sim.compilation import prepare

_STALE = ("inputs", "reused", "delivered_attempt")
"""Of a report: what would let --resume of another command take an optimised scene for its own."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What came of optimising a folder."""

    scene: Scene
    """The optimised scene; the folder's own where nothing was changed."""
    improved: OptimizedScene
    verification: Verification | None
    """Of the optimised scene; None where nothing was changed."""
    folder: Path
    """Where the scene is."""
    seconds: float
    exports: Mapping[str, ParityReport] = field(default_factory=dict)
    """What was read back of every format that was written."""

    @property
    def skipped(self) -> bool:
        """Whether the scene was good already."""
        return self.improved.found.skipped

    @property
    def failures(self) -> tuple[str, ...]:
        """What is wrong with the scene now, a line each."""
        if self.skipped:
            return ()
        if self.verification is None:
            return broken(self.improved.found.first.results) or ("the scene stands, but no steadier layout was found.",)
        return _failures(self.improved.rest, self.verification, self.exports)


def optimize_folder(
    folder: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str] | None = None,
    epochs: int = 50,
    starts: int = 6,
    seed: int | None = None,
    device: str = "cpu",
    progress: Progress = silent,
) -> Outcome:
    """Optimise the layout of the scene in `folder`, settle, verify and write it.

    Args:
        folder: what `generate` or `build` wrote.
        out: folder to write instead; `folder` then stays as it is.
        epochs: gradient steps at most; 0 for none.
        starts: layouts tried before gradients, the scene's own among them.
        seed: of the layouts tried; the scene's where None.
        device: "cpu" or "cuda".
        progress: told what is going on.

    Raises:
        SpecError: there is no scene, torch is missing, or there is no such device.
        SimulationError: the scene's layout cannot be simulated.
        ExportError: the folder cannot be written.
    """
    source, clock = Path(folder).expanduser(), Clock()
    if not source.is_dir():
        raise SpecError(f"{folder} is not a folder; give a scene folder, as generate and build write it.")
    progress(Event(stage="reading the scene"))
    scene = load_scene(source)
    target = check_target(out if out is not None else source)
    report = read_json(source / "report.json")
    options = OptimizeOptions(
        epochs=epochs,
        starts=starts,
        seed=scene.seed if seed is None else seed,
        # A scene that holds but failed its verification drifts in another engine: it should stand more firmly.
        steady=report.get("passed") is False,
    )
    formats, usd = exported(source)
    with clock("kernels"):
        options = replace(options, device=prepare(device, progress))
    with clock("optimising"):
        done = optimize_scene(scene, options=options, progress=progress)
    rest, verification, exports = done.rest, None, {}
    if rest is None:
        if target != source.resolve():
            _copy(source, target)
    else:
        with replacing(target) as fresh:
            with clock("export"):
                paths = export(done.scene, formats, fresh, progress=progress, **usd)
                exports = {name: parity(done.scene, path).moved(fresh, target) for name, path in paths.items()}
            verification = _write(done.scene, rest, report, exports, fresh, clock, progress)
    return Outcome(
        scene=done.scene,
        improved=done,
        verification=verification,
        folder=target,
        seconds=clock.seconds["total"],
        exports=exports,
    )


def _write(
    scene: Scene,
    rest: SettledScene,
    earlier: dict[str, Any],
    exports: Mapping[str, ParityReport],
    fresh: Path,
    clock: Clock,
    progress: Progress,
) -> Verification:
    """Everything else of a scene folder into the folder `fresh`, which holds the exports."""
    from pat3d.view.preview import save_preview

    with clock("verification"):
        verification = verify(scene, fresh / "mjcf" / "scene.xml", progress)
    with clock("files"):
        progress(Event(stage="writing the folder"))
        save_scene(scene, fresh)
        record_checksums(fresh)
        names = tuple(obj.name for obj in scene.objects)
        write_trajectory(fresh / "trajectory.npz", names, rest.states, rest.centres, rest.record["time_step"])
        write_pictures(rest.pictures, fresh)
    with clock("preview"):
        progress(Event(stage="drawing the preview"))
        save_preview(scene, fresh / "preview.png")
    failures = _failures(rest, verification, exports)
    report = {
        "format": FORMAT,
        "version": VERSION,
        "prompt": scene.prompt,
        "seed": scene.seed,
        **{key: value for key, value in earlier.items() if key not in _STALE},
        **of_scene(scene, rest, verification),
        "exports": {name: one.as_dict() for name, one in exports.items()},
        "passed": not failures,
        "failures": list(failures),
        "seconds": dict(clock.seconds),
    }
    write_json(fresh / "report.json", report)
    return verification


def _failures(
    rest: SettledScene | None, verification: Verification, exports: Mapping[str, ParityReport]
) -> tuple[str, ...]:
    restless = () if rest is None or rest.at_rest else ("settling did not come to rest.",)
    return (*restless, *verification.failures, *(line for one in exports.values() for line in one.failures))


def _copy(source: Path, target: Path) -> None:
    """The scene folder as it is."""
    with replacing(target) as fresh:
        for name in OWN:
            if (source / name).is_dir():
                shutil.copytree(source / name, fresh / name, dirs_exist_ok=True)
            elif (source / name).is_file():
                shutil.copy2(source / name, fresh / name)
