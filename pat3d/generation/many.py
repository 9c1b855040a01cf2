"""A scene folder for every prompt of a file, and a table of what came of each.

What an earlier run finished is kept, and a scene that was interrupted goes on after its last finished stage. A prompt
that is refused does not keep the others from being made.
"""

from __future__ import annotations

import csv
import hashlib
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any, Literal

from pat3d.errors import ExportError, Pat3dError, SpecError
from pat3d.generation.attempts import request_key
from pat3d.generation.pipeline import run_prompt
from pat3d.generation.request import request_of
from pat3d.generation.settings import Settings
from pat3d.plan.scene_plan import Planner
from pat3d.progress import Progress, silent
from pat3d.scene.folder import read_json
from pat3d.scene.naming import slug

TABLE = "scenes.csv"
"""In the folder of the scenes: a line for every prompt."""

MAX_NAME = 48
"""Characters of a folder's name that come from its prompt; longer prompts are told apart by a checksum."""

MAX_PROMPTS_BYTES = 4 * 2**20


@dataclass(frozen=True, kw_only=True)
class Row:
    """What came of one prompt."""

    prompt: str
    folder: str
    """Name of the scene's folder."""
    state: Literal["verified", "faulty", "refused"]
    kept: bool = False
    """Whether an earlier run had made it."""
    objects: int = 0
    drift_mm: float = 0.0
    """Largest drift of an object in MuJoCo [mm]."""
    seconds: float = 0.0
    message: str = ""
    """Why it was refused, or its first fault."""
    exit_code: int = 0


def read_prompts(path: str | os.PathLike[str]) -> tuple[str, ...]:
    """Lines of a prompt file that are neither empty nor comments (#), each once.

    Raises:
        SpecError: it cannot be read, or holds no prompt.
    """
    file = Path(path).expanduser()
    try:
        if file.stat().st_size > MAX_PROMPTS_BYTES:
            raise SpecError(f"{file}: larger than {MAX_PROMPTS_BYTES} bytes; give a text file with a prompt a line.")
        lines = [line.strip() for line in file.read_text(encoding="utf-8").splitlines()]
    except (OSError, UnicodeDecodeError) as error:
        raise SpecError(f"{file}: cannot be read: {error}") from error
    prompts = tuple(dict.fromkeys(line for line in lines if line and not line.startswith("#")))
    if not prompts:
        raise SpecError(f"{file} holds no prompt; give one a line, # begins a comment.")
    return prompts


def folder_names(prompts: Sequence[str]) -> dict[str, str]:
    """A folder's name for every prompt; it depends on the prompt alone where no other has the same words."""
    names: dict[str, str] = {}
    for prompt in prompts:
        name = slug(prompt)
        if len(name) > MAX_NAME or name in names.values():
            name = f"{name[:MAX_NAME].rstrip('_')}_{hashlib.sha256(prompt.encode()).hexdigest()[:6]}"
        names[prompt] = name
    return names


def generate_many(
    prompts: Sequence[str],
    out: str | os.PathLike[str],
    *,
    settings: Settings,
    allow_proxies: bool = False,
    planner: Planner | None = None,
    progress: Progress = silent,
) -> Iterator[Row]:
    """Make the scene of every prompt in a folder of its own in `out`; rows come as scenes are finished.

    TABLE is written after every scene.

    Raises:
        ExportError: `out` is not a folder that can be written.
    """
    root = Path(out).expanduser()
    if root.exists() and not root.is_dir():
        raise ExportError(f"{root} is a file; give a folder for the scenes.")
    settings, rows = replace(settings, resume=True), []
    for prompt, name in folder_names(prompts).items():
        row = _kept(prompt, root / name, settings, allow_proxies, planner)
        row = row or _made(prompt, root / name, settings, allow_proxies, planner, progress)
        rows.append(row)
        write_table(rows, root)
        yield row


def _kept(prompt: str, folder: Path, settings: Settings, allow_proxies: bool, planner: Planner | None) -> Row | None:
    """The row of a scene that an earlier run finished with the same inputs."""
    from pat3d.plan.grammar.planner import GrammarPlanner

    report = read_json(folder / "report.json")
    if not (folder / "scene.json").is_file() or report.get("prompt") != prompt:
        return None
    try:
        request = request_of((planner or GrammarPlanner(allow_proxies)).plan(prompt), allow_proxies)
    except Pat3dError:
        return None
    inputs, exports = report.get("inputs"), report.get("exports")
    key = request_key(
        request,
        seed=settings.seed,
        friction=settings.friction,
        device=settings.device,
        least_tilt=settings.least_tilt,
    )
    if not isinstance(inputs, dict) or inputs.get("request") != key or not isinstance(exports, dict):
        return None
    return row_of(prompt, folder, report, kept=True) if set(settings.formats) <= exports.keys() else None


def _made(
    prompt: str,
    folder: Path,
    settings: Settings,
    allow_proxies: bool,
    planner: Planner | None,
    progress: Progress,
) -> Row:
    begun = time.perf_counter()
    try:
        outcome = run_prompt(
            prompt, out=folder, settings=settings, allow_proxies=allow_proxies, planner=planner, progress=progress
        )
    except Pat3dError as error:
        return Row(
            prompt=prompt,
            folder=folder.name,
            state="refused",
            seconds=time.perf_counter() - begun,
            message=f"{type(error).__name__}: {error}",
            exit_code=error.exit_code,
        )
    return row_of(prompt, folder, outcome.report.as_dict())


def row_of(prompt: str, folder: Path, report: dict[str, Any], *, kept: bool = False) -> Row:
    """The row of a finished scene, from its report."""
    failures = report.get("failures") or []
    drifts = [obj.get("drift_mm") or 0.0 for obj in report.get("objects", ())]
    return Row(
        prompt=prompt,
        folder=folder.name,
        kept=kept,
        state="verified" if report.get("passed") else "faulty",
        objects=len(drifts),
        drift_mm=max(drifts, default=0.0),
        seconds=float(report.get("seconds", {}).get("total", 0.0)),
        message=str(failures[0]) if failures else "",
        exit_code=0 if report.get("passed") else 1,
    )


def write_table(rows: Sequence[Row], root: Path) -> None:
    """Write TABLE into `root`."""
    root.mkdir(parents=True, exist_ok=True)
    temporary = root / f".{TABLE}.{os.getpid()}.part"
    with temporary.open("w", newline="", encoding="utf-8") as file:
        names = [one.name for one in fields(Row) if one.name not in ("kept", "exit_code")]
        writer = csv.DictWriter(file, names, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)
    os.replace(temporary, root / TABLE)
