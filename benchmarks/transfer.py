"""Does a scene stay still in every engine? Scenes of a prompt file, random catalogue scenes and scenes of real meshes.

python benchmarks/transfer.py --prompts benchmarks/prompts.txt --random 100 --work work/transfer --out table.md
python benchmarks/transfer.py --scenes scenes/* --seconds 60 --work work/minute        what creeps?

Everything that is made or measured lies under --work, and what is there already is not done again, so a run that was
interrupted goes on. `make engines` makes the engines; those that are absent are left out of the table. Scenes that
their own report does not call verified are listed, and not run.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import random
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import yaml

from pat3d.check.engines.check import TIMEOUT, check_engines
from pat3d.check.engines.protocol import Absent, Engine
from pat3d.check.engines.record import as_dict
from pat3d.check.engines.registry import chosen
from pat3d.check.settle import CREEP_SECONDS
from pat3d.errors import Pat3dError
from pat3d.exporters.formats import export
from pat3d.scene.folder import read_json, write_json
from pat3d.scene.io import load_scene
from pat3d.scene.model import Scene

HERE = Path(__file__).parent
LIMIT = 900.0
"""Wall time after which making one scene is given up [s]."""

SMALL = 0.3
"""Largest side of what random scenes put on a table [m]."""

MM, DEGREES = 1.0, 1.0
"""Objects that stray less are still."""


def read_prompts(path: Path) -> list[str]:
    """Lines of a prompt file that are neither empty nor comments."""
    lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


def random_spec(seed: int) -> dict[str, Any]:
    """A table with 2 to 6 small catalogue objects, some of them on one another."""
    from pat3d.assets import catalogue

    draw = random.Random(seed)
    nouns: list[str] = []
    while len(nouns) < draw.randint(2, 6):
        entry = draw.choice(catalogue.entries())
        try:
            asset = catalogue.make(entry.noun, seed=seed)
        except Pat3dError:
            continue
        if max(asset.size) < SMALL:
            nouns.append(entry.noun)
    objects: list[dict[str, Any]] = [{"name": "table", "noun": "table", "fixed": bool(seed % 2)}]
    relations = []
    for number, noun in enumerate(nouns, start=1):
        name = f"{noun} {number}"
        parent = "table" if number == 1 or draw.random() < 0.7 else objects[-1]["name"]
        objects.append({"name": name, "noun": noun})
        relations.append({"child": name, "kind": "on", "parent": parent})
    return {"seed": seed, "objects": objects, "relations": relations}


def make(arguments: list[str], folder: Path, log: Path) -> bool:
    """Make one scene with the command line in a process of its own, unless it is there."""
    if (folder / "report.json").is_file():
        return True
    paths = [str(HERE.parent), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in paths if path)}
    with log.open("w", encoding="utf-8") as errors:
        try:
            subprocess.run(
                [sys.executable, "-m", "pat3d", *arguments, "--out", str(folder)],
                cwd=log.parent,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                timeout=LIMIT,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return False
    return (folder / "report.json").is_file()


def orders(options: argparse.Namespace, work: Path) -> dict[str, list[str]]:
    """What the command line is told for every scene, by the scene's name."""
    found: dict[str, list[str]] = {}
    for number, prompt in enumerate(read_prompts(options.prompts) if options.prompts else [], start=1):
        if not options.only or number in options.only:
            found[f"prompt {number:02d}"] = ["generate", prompt]
    specs = {f"random {seed:03d}": seed for seed in range(options.random)}
    for name, seed in specs.items():
        path = work / f"{name.replace(' ', '_')}.yaml"
        if not path.is_file():
            path.write_text(yaml.safe_dump(random_spec(seed)), encoding="utf-8")
        found[name] = ["build", str(path)]
    for path in options.specs:
        found[path.stem] = ["build", str(path.resolve())]
    return found


def measure(
    scene: Scene, engine: Engine, exports: Path, path: Path, seconds: float, timeout: float
) -> dict[str, Any] | None:
    """One engine on one scene, from `path` where it was measured before; None where the engine is absent."""
    if path.is_file():
        return json.loads(path.read_text(encoding="utf-8"))
    (verdict,) = check_engines(scene, (engine,), exports, seconds=seconds, timeout=timeout)
    if isinstance(verdict, Absent):
        return None
    document = as_dict(verdict)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_json(path, document)
    return document


def strays(document: dict[str, Any]) -> list[tuple[str, float, float]]:
    """(name, mm, degrees) of every object; infinite where the engine lost it."""

    def number(value: float | None) -> float:
        return math.inf if value is None else float(value)

    return [
        (obj["name"], max(number(obj["centre_mm"]), number(obj["origin_mm"])), number(obj["degrees"]))
        for obj in document["objects"]
    ]


def fastest(documents: list[dict[str, Any]], unit: str) -> str:
    """The most that any object still moves at the end of a run [`unit` a minute]; a dash where nobody measured."""
    creeps = [document.get(f"worst_creep_{unit}_per_minute") for document in documents if "failed" not in document]
    return f"{max(known):.2g}" if (known := [creep for creep in creeps if creep is not None]) else "-"


def largest(document: dict[str, Any], seconds: float) -> str:
    """Largest drift of any object [mm / degrees], and in long runs its creep [mm / degrees a minute]."""
    found = strays(document)
    mm, degrees = max((mm for _, mm, _ in found), default=0.0), max((d for *_, d in found), default=0.0)
    if seconds < CREEP_SECONDS:
        return f"{mm:.3f} / {degrees:.3f}"
    return f"{mm:.3f} / {degrees:.3f}; {fastest([document], 'mm')} / {fastest([document], 'degrees')}"


def failures(folder: Path) -> list[str]:
    """Why the scene in `folder` is not verified; nothing where it is."""
    report = read_json(folder / "report.json")
    if not report:
        return ["no report.json says so."]
    return [] if report["passed"] else [str(line) for line in report["failures"]] or ["not passed"]


def table(
    results: dict[str, dict[str, dict[str, Any]]],
    unverified: dict[str, list[str]],
    engines: list[Engine],
    seconds: float,
) -> str:
    """The page: a summary of the engines, every scene, everything that moved, and the scenes that were not run."""
    here = [engine for engine in engines if any(engine.name in row for row in results.values())]
    lines = [
        "# Scenes in other engines",
        "",
        f"{seconds:g} s of simulated time; drift at any time, from the pose in "
        f"scene.json; still means under {MM:g} mm and {DEGREES:g} degree. Last columns: the most that any object "
        "still moves in the last quarter of a run.",
        "",
        "| engine | version | settings | scenes | objects | still | median mm | worst mm | worst deg "
        "| mm/min | deg/min |",
        "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for engine in here:
        documents = [row[engine.name] for row in results.values() if engine.name in row]
        every = [stray for document in documents for stray in strays(document)]
        failed = sum("failed" in document for document in documents)
        if not every:
            lines.append(f"| {engine.title} | no run finished: {documents[0].get('failed', '')} |" + " |" * 9)
            continue
        still = sum(mm < MM and degrees < DEGREES for _, mm, degrees in every)
        last = next(document for document in documents if "failed" not in document)
        settings = ", ".join(f"{key} {value}" for key, value in last["settings"].items())
        lines.append(
            f"| {engine.title} | {last['version']} | {settings} | {len(documents) - failed} of {len(documents)} "
            f"| {len(every)} | {still / len(every):.1%} | {statistics.median(mm for _, mm, _ in every):.3f} "
            f"| {max(mm for _, mm, _ in every):.2f} | {max(degrees for *_, degrees in every):.2f} "
            f"| {fastest(documents, 'mm')} | {fastest(documents, 'degrees')} |"
        )
    lines += [
        "",
        "Largest drift, mm / degrees"
        + ("; what still moves at the end, mm / degrees a minute." if seconds >= CREEP_SECONDS else "."),
        "",
        "| scene | " + " | ".join(engine.title for engine in here) + " |",
        "| --- |" + " ---: |" * len(here),
    ]
    moved = []
    for name, row in results.items():
        cells = []
        for engine in here:
            document = row.get(engine.name)
            if document is None or "failed" in document:
                cells.append("" if document is None else "failed")
                moved += [] if document is None else [f"- {name}, {document['failed']}"]
                continue
            cells.append(largest(document, seconds))
            moved += [
                f"- {name}, {engine.title}: {obj} {m:.2f} mm, {d:.2f} degrees"
                for obj, m, d in strays(document)
                if not (m < MM and d < DEGREES)
            ]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    lines += ["", "## What moved", "", *(moved or ["Nothing."])]
    if unverified:
        lines += ["", "## Not verified, so not run", ""]
        lines += [f"- {name}: {' '.join(reasons)}" for name, reasons in unverified.items()]
    return "\n".join([*lines, ""])


def main() -> int:
    """Make what is missing, measure what was not measured, write the table after every scene."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prompts", type=Path, help="one prompt a line")
    parser.add_argument("--only", type=int, nargs="+", help="numbers of the prompts to run, from 1")
    parser.add_argument("--random", type=int, default=0, metavar="N", help="random catalogue scenes")
    parser.add_argument(
        "--specs", type=Path, nargs="+", default=[], help="specifications to build, of real meshes, say"
    )
    parser.add_argument("--scenes", type=Path, nargs="+", default=[], help="folders of scenes that are made already")
    parser.add_argument("--engines", nargs="+", default=["all"])
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument(
        "--timeout", type=float, default=TIMEOUT, help="wall time of an engine; Drake takes 34 times a scene's time [s]"
    )
    parser.add_argument("--work", type=Path, default=Path("work/transfer"), help="scenes, exports and results")
    parser.add_argument("--out", type=Path, help="Markdown file to write; printed otherwise")
    options = parser.parse_args()
    work = options.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    engines = list(chosen(options.engines))
    results: dict[str, dict[str, dict[str, Any]]] = {}
    unverified: dict[str, list[str]] = {}
    wanted = orders(options, work)
    made = {path.resolve().name: path.resolve() for path in options.scenes}
    start = time.perf_counter()
    for number, name in enumerate([*wanted, *made], start=1):
        slug = name.replace(" ", "_")
        folder = made.get(name, work / "scenes" / slug)
        (work / "scenes").mkdir(exist_ok=True)
        if name in wanted and not make(wanted[name], folder, work / f"{slug}.log"):
            print(f"{name}: no scene, see {work / f'{slug}.log'}", file=sys.stderr, flush=True)
            continue
        if reasons := failures(folder):
            unverified[name] = reasons
            continue
        scene, exports = load_scene(folder), work / "exports" / slug
        formats = dict.fromkeys(engine.format for engine in engines if engine.absence() is None)
        missing = [one for one in formats if not (exports / one).is_dir()]
        if missing:
            export(scene, missing, exports)
        results[name] = {}
        for engine in engines:
            path = work / "results" / slug / f"{engine.name}.json"
            document = measure(scene, engine, exports, path, options.seconds, options.timeout)
            if document is not None:
                results[name][engine.name] = document
        print(
            f"{name}: {number} of {len(wanted) + len(made)}, {time.perf_counter() - start:.0f} s",
            file=sys.stderr,
            flush=True,
        )
        if options.out is not None:
            options.out.write_text(table(results, unverified, engines, options.seconds), encoding="utf-8")
    if options.out is None:
        print(table(results, unverified, engines, options.seconds))
    return 0


if __name__ == "__main__":
    sys.exit(main())
