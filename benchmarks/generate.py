"""How good and how fast is `pat3d generate`? Every prompt of a file with several seeds, each in a fresh process.

python benchmarks/generate.py --prompts benchmarks/prompts.txt --seeds 0 1 2 --out table.md
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
LIMIT = 600.0
"""Wall time after which a run is given up [s]."""


@dataclass(frozen=True, kw_only=True)
class Run:
    """One prompt with one seed."""

    number: int
    """Of the prompt, from 1."""
    prompt: str
    seed: int
    seconds: float
    """Wall time of the process, interpreter and imports included."""
    megabytes: float
    """Peak resident memory of the process."""
    code: int
    message: str
    """What it printed on stderr last."""
    report: dict[str, Any] | None
    """report.json, where it got that far."""


def read_prompts(path: Path) -> list[str]:
    """Lines of a prompt file that are neither empty nor comments."""
    lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


def measure(number: int, prompt: str, seed: int, folder: Path, more: list[str]) -> Run:
    """Run `pat3d generate`, with options `more`, in a process of its own."""
    command = [sys.executable, "-m", "pat3d", "generate", prompt, "--out", str(folder), "--seed", str(seed)]
    command += more
    with tempfile.TemporaryFile("w+") as errors:
        start = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors, env=_environment())
        code, used = _wait(process, LIMIT)
        seconds = time.perf_counter() - start
        errors.seek(0)
        lines = [line.strip() for line in errors if line.startswith("pat3d:")]
    path = folder / "report.json"
    report = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
    return Run(
        number=number,
        prompt=prompt,
        seed=seed,
        seconds=seconds,
        megabytes=used / 1e3,
        code=code,
        message="; ".join(lines),
        report=report,
    )


def _environment() -> dict[str, str]:
    paths = [str(HERE.parent), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in paths if path)}


def _wait(process: subprocess.Popen, limit: float) -> tuple[int, float]:
    """Exit code and peak resident memory [kB] of a child, ended after `limit` seconds."""
    end = time.monotonic() + limit
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, float(usage.ru_maxrss)
        if time.monotonic() > end:
            process.kill()
        time.sleep(0.02)


def row(run: Run) -> str:
    """A line of the table."""
    cells = [f"{run.number}", f"{run.seed}"]
    if run.report is None:
        cells += [f"no scene (exit {run.code})", *[""] * 9]
    else:
        found = run.report["verification"]
        certificate, overlaps, mujoco = found["certificate"], found["penetration"], found["mujoco"]
        least, relations = certificate["smallest_friction"], found["relations"]
        cells += [
            f"{len(run.report['objects'])}",
            f"{certificate['worst']:.0e}",
            "none" if least is None else f"{least:.3f}",
            f"{certificate['largest_tilt']:.2f}",
            _figure(mujoco["worst_mm"]),
            _figure(mujoco["worst_degrees"]),
            f"{len(overlaps['hulls'])} / {len(overlaps['visuals'])}",
            f"{relations['held']} / {relations['count']}",
            f"{len(run.report['attempts'])}",
            "yes" if run.report["passed"] else "NO",
        ]
    return "| " + " | ".join([*cells, f"{run.seconds:.1f}", f"{run.megabytes:.0f}"]) + " |"


def _figure(value: float | None) -> str:
    return "unbounded" if value is None else f"{value:.3f}"


def table(runs: list[Run], prompts: list[str]) -> str:
    """The whole page in Markdown."""
    titles = (
        "prompt",
        "seed",
        "objects",
        "unbalanced",
        "least friction",
        "tilt deg",
        "drift mm",
        "drift deg",
        "hull / surface overlaps",
        "relations",
        "attempts",
        "verified",
        "seconds",
        "MB",
    )
    lines = ["# pat3d generate", "", *summary(runs), ""]
    lines += ["| " + " | ".join(titles) + " |", "|" + " ---: |" * len(titles), *map(row, runs), "", "## Prompts", ""]
    lines += [f"{number}. {prompt}" for number, prompt in enumerate(prompts, start=1)]
    lines += ["", "## What fell short", ""]
    faults = [f"- prompt {run.number}, seed {run.seed}: {line}" for run in runs for line in shortfalls(run)]
    return "\n".join([*lines, *(faults or ["Nothing."]), ""])


def shortfalls(run: Run) -> list[str]:
    """What one run failed, a line each."""
    if run.report is None:
        return [run.message or f"exit code {run.code}"]
    lines = list(run.report["failures"])
    relations = run.report["verification"]["relations"]["list"]
    lines += [
        f"not met: {found['relation']} ({found['detail']})"
        for found in relations
        if not found["holds"] and found["kind"] not in ("on", "in", "hangs_from")
    ]
    return lines


def summary(runs: list[Run]) -> list[str]:
    """The figures beside what they should be."""
    made = [run.report for run in runs if run.report is not None]
    if not made:
        return ["No scene was made."]
    checks = [report["verification"] for report in made]
    objects = [obj for report in made for obj in report["objects"] if not obj["fixed"]]
    still = sum(obj["drift_mm"] is not None and obj["drift_mm"] < 1.0 and obj["drift_degrees"] < 1.0 for obj in objects)
    held = sum(found["relations"]["held"] for found in checks)
    asked = sum(found["relations"]["count"] for found in checks)
    seconds = [run.seconds for run in runs]
    rows = (
        ("scenes made", f"{len(made)} of {len(runs)}", "all"),
        ("scenes verified", f"{sum(report['passed'] for report in made)} of {len(runs)}", "all"),
        (
            "pairs that intersect, hulls and surfaces",
            f"{sum(len(found['penetration']['hulls']) + len(found['penetration']['visuals']) for found in checks)}",
            "0",
        ),
        (
            "largest certificate residual",
            f"{max(found['certificate']['worst'] for found in checks):.1e}",
            "1e-3",
        ),
        (
            "least tilt that a scene stands [degrees]",
            f"{min(found['certificate']['largest_tilt'] for found in checks):.2f}",
            "0.57",
        ),
        ("objects still within 1 mm and 1 degree", f"{still} of {len(objects)} ({still / len(objects):.1%})", "99 %"),
        (
            "scenes that MuJoCo warns about",
            f"{sum(bool(found['mujoco']['warnings']) for found in checks)}",
            "0",
        ),
        ("relations that hold at rest", f"{held} of {asked} ({held / max(asked, 1):.1%})", "90 %"),
        ("seconds, median and worst", f"{statistics.median(seconds):.1f} and {max(seconds):.1f}", "15 and 60"),
        ("largest memory [MB]", f"{max(run.megabytes for run in runs):.0f}", "2000"),
    )
    lines = ["| what | measured | target |", "| --- | ---: | ---: |"]
    return lines + [f"| {what} | {figure} | {target} |" for what, figure, target in rows]


def main() -> int:
    """Measure, print the progress, write the table."""
    parser = argparse.ArgumentParser(description="Measure pat3d generate on the prompts of a file.")
    parser.add_argument("--prompts", type=Path, default=HERE / "prompts.txt", help="one prompt a line")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0])
    parser.add_argument("--out", type=Path, help="Markdown file to write; printed otherwise")
    parser.add_argument("--scenes", type=Path, help="folder to keep the scenes in")
    parser.add_argument("--only", type=int, nargs="+", help="numbers of the prompts to run, from 1")
    parser.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    parser.add_argument("--least-tilt", type=float, metavar="DEGREES", help="that every scene has to stand")
    options = parser.parse_args()
    more = ["--device", options.device]
    more += [] if options.least_tilt is None else ["--least-tilt", str(options.least_tilt)]
    prompts = read_prompts(options.prompts)
    runs = []
    with tempfile.TemporaryDirectory(prefix="pat3d-bench-") as scratch:
        root = options.scenes or Path(scratch)
        for number, prompt in enumerate(prompts, start=1):
            for seed in options.seeds if not options.only or number in options.only else ():
                run = measure(number, prompt, seed, root / f"prompt_{number:02d}_seed_{seed}", more)
                runs.append(run)
                print(row(run), run.message, file=sys.stderr, flush=True)
                if options.out is not None:
                    options.out.write_text(table(runs, prompts), encoding="utf-8")
    if options.out is None:
        print(table(runs, prompts))
    return 0


if __name__ == "__main__":
    sys.exit(main())
