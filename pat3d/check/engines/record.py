"""What engines did with a scene, kept in its report.json: drifts, settings, and what still moves after a minute."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pat3d.check.engines.check import Verdict
from pat3d.check.engines.protocol import Absent, Engine, Failed
from pat3d.errors import SpecError
from pat3d.scene.folder import read_json, write_json

KEY = "engines"
"""Of report.json; it holds the last run of every engine, by its name."""


def record(folder: Path, engines: Sequence[Engine], verdicts: Sequence[Verdict]) -> Path:
    """Add `verdicts`, one for each of `engines`, to the report of a scene folder; what is absent leaves nothing.

    Returns:
        The path of report.json.

    Raises:
        SpecError: the folder has no report, or a damaged one.
    """
    path = folder / "report.json"
    report = read_json(path)
    if not report:
        raise SpecError(f"{path}: there is no report to add to; generate, build and settle write one.")
    earlier = report.get(KEY)
    found = dict(earlier) if isinstance(earlier, Mapping) else {}
    for engine, verdict in zip(engines, verdicts, strict=True):
        if not isinstance(verdict, Absent):
            found[engine.name] = as_dict(verdict)
    write_json(path, {**report, KEY: found})
    return path


def as_dict(verdict: Verdict) -> dict[str, Any]:
    """Plain data of what an engine did, or why it did not."""
    if isinstance(verdict, Absent):
        return {"absent": verdict.reason}
    if isinstance(verdict, Failed):
        return {"failed": verdict.reason, "objects": [], "settings": dict(verdict.settings)}
    return verdict.as_dict()
