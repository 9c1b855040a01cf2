"""`pat3d optimize`: a finished scene folder, whose relations broke or which does not stay still, is made anew.

The optimisation starts from the layout that the folder's scene settled from; where poses were edited since, the scene
settles from those first. A scene that is verified and satisfied is left as it is, and so is one for which nothing
better was found.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from pat3d.check.verification import Verification, broken
from pat3d.exporters.compare import ParityReport
from pat3d.exporters.formats import exported
from pat3d.generation.edited import edited, laid_out_as_posed
from pat3d.generation.optimize_stage import OptimizedScene, optimize_scene
from pat3d.generation.rewrite import Rewritten, copy_folder, read_folder, rewrite
from pat3d.generation.settings import Settings
from pat3d.generation.settle_stage import SettledScene, settle_scene
from pat3d.optimize.optimize import OptimizeOptions
from pat3d.progress import Clock, Progress, silent
from pat3d.scene.folder import check_target, read_json
from pat3d.scene.model import Scene
from pat3d.sim.compilation import prepare


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What came of optimising a folder."""

    scene: Scene
    """The scene that is in the folder now."""
    optimized: OptimizedScene
    edited: tuple[str, ...]
    """Objects whose poses were not those that the scene had settled into; it settled from where they were put."""
    written: Rewritten | None
    """None where nothing was changed."""
    folder: Path
    """Where the scene is."""
    seconds: float

    @property
    def skipped(self) -> bool:
        """Whether nothing had to be optimised."""
        return self.optimized.found.skipped

    @property
    def verification(self) -> Verification | None:
        """Of the scene that was written; None where nothing was changed."""
        return self.written.verification if self.written is not None else None

    @property
    def exports(self) -> Mapping[str, ParityReport]:
        """What was read back of every format that was written."""
        return self.written.exports if self.written is not None else {}

    @property
    def failures(self) -> tuple[str, ...]:
        """What is wrong with the scene now, a line each."""
        if self.written is not None:
            return self.written.failures
        if self.skipped:
            return ()
        return broken(self.optimized.found.first.results) or ("the scene stands, but no steadier layout was found.",)


def optimize_folder(
    folder: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str] | None = None,
    epochs: int = OptimizeOptions.epochs,
    starts: int = OptimizeOptions.starts,
    seed: int | None = None,
    device: str = Settings.device,
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
    scene = read_folder(source, progress)
    target = check_target(out if out is not None else source)
    # Packages that a format needs are missed before the work, not after it.
    exported(source)
    options = OptimizeOptions(
        epochs=epochs,
        starts=starts,
        seed=scene.seed if seed is None else seed,
        # A scene that holds but failed its verification drifts in another engine: it should stand more firmly.
        steady=read_json(source / "report.json").get("passed") is False,
    )
    changed = edited(scene, source)
    with clock("kernels"):
        options = replace(options, device=prepare(device, progress))
    settled: SettledScene | None = None
    if changed:
        with clock("settling"):
            layout = laid_out_as_posed(scene, changed)
            settled = settle_scene(layout, device=options.device, progress=progress)
            scene = settled.of(layout)
    with clock("optimising"):
        at_rest = settled.at_rest if settled is not None else None
        done = optimize_scene(scene, options=options, at_rest=at_rest, progress=progress)
    written = None
    settled = done.settled or settled
    if settled is not None:
        written = rewrite(done.scene, settled, source=source, target=target, clock=clock, progress=progress)
    elif target != source.resolve():
        copy_folder(source, target)
    return Outcome(
        scene=done.scene,
        optimized=done,
        edited=tuple(obj.name for obj in scene.objects if obj.name in changed),
        written=written,
        folder=target,
        seconds=clock.seconds["total"],
    )
