"""The geometric columns of the paper's Table 1 for one scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from pat3d.check.metrics.displacement import Displacement, displacement
from pat3d.check.metrics.interpenetration import Interpenetration, interpenetration
from pat3d.check.metrics.remeshing import can_remesh, remeshed
from pat3d.check.metrics.subject import Subject
from pat3d.errors import CheckError
from pat3d.progress import Event, Progress, silent

FORMAT, VERSION = "pat3d-metrics", 1


@dataclass(frozen=True, kw_only=True)
class Geometry:
    """D and R of one scene."""

    name: str
    objects: int
    diagonal: float
    """Of the bounding box [m]."""
    displacement: Displacement
    delivered: Interpenetration
    """R of the delivered meshes."""
    remeshed: Interpenetration | None
    """R as the paper has it; None where it is absent."""
    absent: str = ""
    """Why it is."""
    notes: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Plain data for a report; an infinite D is null, as JSON has no infinity."""
        data = asdict(self)
        if self.displacement.value == float("inf"):
            data["displacement"]["value"] = None
        return data


def measure(subject: Subject, *, device: str = "cpu", progress: Progress = silent) -> Geometry:
    """D, and R on the delivered meshes and, where fTetWild is installed, on remeshed ones."""
    name = subject.name
    progress(Event(stage="counting", detail=f"{name}: triangles that pass through each other"))
    delivered = interpenetration(subject)
    surfaces, absent = None, "" if can_remesh() else "needs pytetwild: pip install 'pat3d[metrics]'"
    if not absent:
        progress(Event(stage="remeshing", detail=name))
        try:
            surfaces = remeshed(subject)
        except CheckError as error:
            absent = str(error)
    again = None if surfaces is None else interpenetration(subject, surfaces)
    moved = displacement(
        subject,
        device=device,
        tell=lambda frame: progress(Event(stage="simulating", detail=name, step=frame)),
    )
    return Geometry(
        name=name,
        objects=len(subject.bodies),
        diagonal=subject.diagonal,
        displacement=moved,
        delivered=delivered,
        remeshed=again,
        absent=absent,
        notes=subject.notes,
    )


def report_of(found: Sequence[Geometry]) -> dict[str, Any]:
    """Plain data of several scenes."""
    return {"format": FORMAT, "version": VERSION, "scenes": [one.as_dict() for one in found]}
