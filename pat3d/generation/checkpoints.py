"""Finished stages, kept so that a run can go on where an earlier one stopped.

Stages are looked up in `<folder>.partial/attempt_<n>`, and in the finished folder itself. Both are scene folders whose
report.json carries a fingerprint of each stage's inputs; a stage is used again only where that is the same.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pat3d.errors import ExportError, SpecError
from pat3d.generation.optimize_stage import PICTURES, readable
from pat3d.generation.settle_stage import SettledScene
from pat3d.scene.folder import (
    read_json,
    read_pictures,
    read_trajectory,
    write_json,
)
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Scene

_MARKER = "pat3d-partial.json"


class Workspace:
    """The stages of earlier runs into one folder; inert unless asked to `keep`."""

    def __init__(self, folder: Path, *, keep: bool) -> None:
        self.folder, self.keep = folder, keep
        self.partial = folder.with_name(f"{folder.name}.partial")
        self.reused: list[str] = []
        """Stages taken from an earlier run, in words."""
        if keep and self.partial.exists() and any(self.partial.iterdir()) and not (self.partial / _MARKER).is_file():
            raise ExportError(f"{self.partial} is needed for unfinished work but holds something else; move it away.")

    def chosen(self, key: str) -> int | None:
        """The attempt that an earlier run of the same request chose for the finished folder, from 0."""
        if not self.keep:
            return None
        report = read_json(self.folder / "report.json")
        attempt = report.get("delivered_attempt")
        if _inputs(report).get("request") != key or not isinstance(attempt, int) or not 1 <= attempt <= 100:
            return None
        return attempt - 1

    def layout(self, attempt: int, key: str) -> tuple[Scene, tuple[str, ...]] | None:
        """The scene laid out by an earlier run, and the layout's notes."""
        for folder, report in self._candidates(attempt):
            if _inputs(report).get("layout") != key:
                continue
            try:
                scene = load_scene(folder)
            except SpecError:
                continue
            notes = report.get("layout", {}).get("notes", [])
            self.reused.append(f"layout {attempt + 1}")
            return scene, tuple(str(note) for note in notes)
        return None

    def settled(self, attempt: int, key: str, scene: Scene) -> SettledScene | None:
        """How an earlier run of `scene` settled."""
        for folder, report in self._candidates(attempt):
            trajectory = read_trajectory(folder / "trajectory.npz")
            record = report.get("settling")
            if _inputs(report).get("rest") != key or trajectory is None or not isinstance(record, dict):
                continue
            try:
                found = load_scene(folder)
            except SpecError:
                continue
            if [obj.name for obj in found.objects] != [obj.name for obj in scene.objects]:
                continue
            optimisation = report.get("optimisation")
            optimisation = optimisation if isinstance(optimisation, dict) and readable(optimisation) else None
            self.reused.append(f"settling {attempt + 1}")
            return SettledScene(
                poses=tuple(obj.pose for obj in found.objects),
                states=trajectory["states"],
                centres=trajectory["centres"],
                record=record,
                optimisation=optimisation,
                pictures=read_pictures(PICTURES, folder) if optimisation else {},
            )
        return None

    def save_layout(self, attempt: int, inputs: Mapping[str, str], scene: Scene, notes: Sequence[str]) -> None:
        """Keep a finished layout."""
        if self.keep:
            self._save(attempt, scene, {"inputs": dict(inputs), "layout": {"notes": list(notes)}})

    def save_settled(
        self, attempt: int, inputs: Mapping[str, str], scene: Scene, notes: Sequence[str], settled: SettledScene
    ) -> None:
        """Keep a settled scene."""
        if self.keep:
            folder = self._save(attempt, scene, {})
            names = tuple(obj.name for obj in scene.objects)
            settled.write(names, folder)
            write_json(
                folder / "report.json",
                {
                    "inputs": dict(inputs),
                    "layout": {"notes": list(notes)},
                    "settling": dict(settled.record),
                    "optimisation": settled.optimisation,
                },
            )

    def clear(self) -> None:
        """Forget the unfinished work, now that the folder is complete."""
        if (self.partial / _MARKER).is_file():
            shutil.rmtree(self.partial, ignore_errors=True)

    def _save(self, attempt: int, scene: Scene, report: Mapping[str, Any]) -> Path:
        self.partial.mkdir(parents=True, exist_ok=True)
        write_json(self.partial / _MARKER, {"for": self.folder.name})
        folder = self.partial / f"attempt_{attempt + 1}"
        # Without its fingerprints a folder is not used, so a half-written one is harmless.
        (folder / "report.json").unlink(missing_ok=True)
        save_scene(scene, folder)
        write_json(folder / "report.json", report)
        return folder

    def _candidates(self, attempt: int) -> list[tuple[Path, dict[str, Any]]]:
        if not self.keep:
            return []
        folders = [self.partial / f"attempt_{attempt + 1}", self.folder]
        return [(folder, read_json(folder / "report.json")) for folder in folders if folder.is_dir()]


def _inputs(report: Mapping[str, Any]) -> Mapping[str, Any]:
    found = report.get("inputs")
    return found if isinstance(found, dict) else {}
