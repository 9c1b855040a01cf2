"""`pat3d settle`: a scene whose poses were edited comes back to rest, is verified and written.

The scene settles from the poses in scene.json. What intersects there is lifted first, with what it carries, and falls
into place.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pat3d.exporters.formats import exported
from pat3d.generation.edited import edited, laid_out_as_posed
from pat3d.generation.rewrite import Rewritten, read_folder, rewrite
from pat3d.generation.settings import Settings
from pat3d.generation.settle_stage import settle_scene
from pat3d.progress import Clock, Progress, silent
from pat3d.scene.folder import check_target
from pat3d.scene.model import Scene
from pat3d.sim.compilation import prepare


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """A scene that was settled again."""

    scene: Scene
    """At rest."""
    edited: tuple[str, ...]
    """Objects that were elsewhere than they had settled, as far as the folder tells."""
    moved: dict[str, float]
    """How far every object's origin moved from where scene.json had it [m]."""
    written: Rewritten
    folder: Path
    seconds: float


def settle_folder(
    folder: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str] | None = None,
    device: str = Settings.device,
    progress: Progress = silent,
) -> Outcome:
    """Settle the scene in `folder` from its poses, verify and write it.

    Args:
        folder: a scene folder.
        out: folder to write instead; `folder` then stays as it is.
        device: "cpu" or "cuda".
        progress: told what is going on.

    Raises:
        SpecError: there is no scene, or no such device.
        LayoutError: no lift makes the poses free of intersections.
        SimulationError: the scene cannot be simulated.
        ExportError: the folder cannot be written.
    """
    source, clock = Path(folder).expanduser(), Clock()
    before = read_folder(source, progress)
    target = check_target(out if out is not None else source)
    exported(source)
    changed = edited(before, source)
    with clock("kernels"):
        name = prepare(device, progress)
    with clock("settling"):
        layout = laid_out_as_posed(before, changed)
        settled = settle_scene(layout, device=name, progress=progress)
    scene = settled.of(layout)
    written = rewrite(scene, settled, source=source, target=target, clock=clock, progress=progress)
    moved = {
        new.name: float(np.linalg.norm(np.subtract(new.pose.position, old.pose.position)))
        for new, old in zip(scene.objects, before.objects, strict=True)
    }
    return Outcome(
        scene=scene,
        edited=tuple(obj.name for obj in scene.objects if obj.name in changed),
        moved=moved,
        written=written,
        folder=target,
        seconds=clock.seconds["total"],
    )
