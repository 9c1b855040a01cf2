"""`pat3d check`: is everything in a scene folder what was verified, and does the scene stand up to it again?

In this order, so that nothing is simulated, or handed to other packages, before it is known to be what we write:
checksums of all files; everything that every export says against what would be written of scene.json; what other
readers make of each export; then balance, intersections, stillness in MuJoCo and relations of the scene itself.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from pat3d.check.parts import part_failures
from pat3d.check.settle import CREEP_DEGREES, CREEP_MM
from pat3d.check.verification import Verification, verify
from pat3d.errors import ExportError
from pat3d.exporters.compare import differences
from pat3d.exporters.contents.compare import contents
from pat3d.exporters.formats import FORMATS
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.progress import Event, Progress, silent
from pat3d.scene.checksums import MANIFEST, SCENE, compare_checksums
from pat3d.scene.io import load_scene
from pat3d.scene.model import Scene
from pat3d.scene.physics import STILL_SECONDS


@dataclass(frozen=True, kw_only=True, eq=False)
class FolderReport:
    """What was found in a scene folder."""

    scene: Scene | None
    """None for a folder of exports without their scene, of which only the checksums can be checked."""
    verification: Verification | None
    failures: tuple[str, ...]
    """A line for everything that is wrong."""
    notes: tuple[str, ...]
    """What a person should know although it is no failure."""

    @property
    def passed(self) -> bool:
        """Everything is what was verified."""
        return not self.failures


def check_folder(folder: str | Path, *, seconds: float = STILL_SECONDS, progress: Progress = silent) -> FolderReport:
    """Check everything in `folder`.

    Args:
        folder: a scene folder, or one of exports with their checksums.
        seconds: simulated time in MuJoCo [s].
        progress: told what is going on.

    Raises:
        SpecError: there is no scene, or it is damaged.
    """
    folder = Path(folder)
    if not (folder / SCENE).is_file() and (folder / MANIFEST).is_file():
        return FolderReport(
            scene=None,
            verification=None,
            failures=compare_checksums(folder).failures,
            notes=(f"{folder} has no {SCENE}: its files were compared with their checksums, and nothing else.",),
        )
    scene = load_scene(folder)
    progress(Event(stage="verifying", detail="files"))
    checksums = compare_checksums(folder)
    failures, notes = [*checksums.failures, *part_failures(scene)], [*checksums.notes]
    sound = set()
    for name in FORMATS:
        if (folder / name).is_dir():
            progress(Event(stage="verifying", detail=f"what {name} says"))
            wrong, unknown = check_export(scene, folder / name)
            failures += wrong
            notes += unknown
            if not wrong and not unknown:
                sound.add(name)
    delivered = folder / "mjcf" / "scene.xml"
    if not delivered.is_file():
        notes.append(f"there is no {delivered}; what would be written there was checked.")
    with tempfile.TemporaryDirectory(prefix="pat3d-check-") as scratch:
        # A file that says something else may ask for anything, and would tell nothing about the scene.
        path = delivered if "mjcf" in sound else write_mjcf(scene, Path(scratch) / "mjcf")
        verification = verify(scene, path, progress, seconds=seconds)
    failures = [*verification.failures, *failures]
    notes += creep_notes(verification)
    return FolderReport(scene=scene, verification=verification, failures=tuple(failures), notes=tuple(notes))


def creep_notes(verification: Verification) -> list[str]:
    """A line for every object that stands but never quite stops."""
    return [
        f'"{obj.name}" still moves after {verification.mujoco.seconds:g} s of MuJoCo: {obj.creep_mm or 0.0:.2g} mm and '
        f"{obj.creep_degrees or 0.0:.2g} degrees a minute (still is under {CREEP_MM:g} and {CREEP_DEGREES:g})."
        for obj in verification.mujoco.creeping()
    ]


def check_export(scene: Scene, folder: Path, anew: Path | None = None) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """What is wrong with the export in `folder`, and what could not be said of it; `anew` is that of `contents`."""
    try:
        report = contents(scene, folder, anew=anew)
    except ExportError as error:
        # The one thing that is no fault of the files: a format whose packages are not installed.
        absent = "not installed" in str(error)
        return ((), (str(error),)) if absent else ((str(error),), ())
    # Other packages are not let loose on what we do not know.
    readers = () if report.foreign else differences(scene, folder)
    return (*readers, *report.failures), ()
