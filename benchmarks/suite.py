"""Scenes an hour of `pat3d suite generate`, where the time goes, and the share of scenes that stay still in MuJoCo.

    python benchmarks/suite.py [--scenes 100] [--workers 2] [--objects 6] [--out FOLDER]
    python benchmarks/suite.py --report FOLDER          a suite that is there, finished or not

Proven means: balanced, disjoint, still for 5 s in MuJoCo, its relations hold, and the robot can do its task.
"""

from __future__ import annotations

import argparse
import json
import statistics
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

from pat3d.envs.suites.folder import LOG, RECORD, REJECTED, SCENES, read_document
from pat3d.envs.suites.generate import generate
from pat3d.envs.suites.manifest import numbers
from pat3d.envs.suites.request import Request

TARGET = 400
"""Proven scenes an hour on two cores at six objects."""


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--objects", type=int, default=6)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", help="keep the suite here")
    parser.add_argument("--report", metavar="FOLDER", help="make nothing; tell of the suite in FOLDER")
    options = parser.parse_args()
    if options.report:
        report(Path(options.report))
        return
    request = Request(scenes=options.scenes, seed=options.seed, objects=(options.objects, options.objects))
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(options.out or Path(scratch) / "suite")
        status = generate(str(folder), request, workers=options.workers)
        took = f"{status.made} scenes with {options.workers} workers in {status.seconds:.0f} s"
        times = f"target {TARGET} on 2 cores, {status.per_hour / TARGET:.1f} times"
        print(f"{took}: {status.per_hour:.0f} an hour ({times})")
        report(folder)


def report(folder: Path) -> None:
    """Print what the suite in `folder` tells of all candidates so far."""
    scenes = [read_document(path) for path in sorted((folder / SCENES).glob(f"*/{RECORD}"))]
    rejected = [read_document(path) for path in sorted((folder / REJECTED).glob("*.json"))]
    found = numbers(scenes, rejected)
    settled = found["settled_in_mujoco"]
    count = found["candidates"]
    print(f"{count} candidates, {len(scenes)} scenes; {found['intersections']} intersections")
    print(f"still in MuJoCo, of all that settled: {settled['passed']} of {settled['of']} "
          f"({100 * settled['passed'] / max(settled['of'], 1):.2f} %)")  # fmt: skip
    print(f"physically proven without replacement: {len(scenes) + found['rejected'].get('task', 0)} of {count}")
    for reason, number in found["rejected"].items():
        print(f"  rejected, {reason}: {number} ({100 * number / count:.1f} %)")
        examples = Counter(str(one["message"])[:150] for one in rejected if one["reason"] == reason)
        for message, _ in examples.most_common(3):
            print(f"      {message}")
    drift = [scene["proof"]["mujoco"]["mm"] for scene in scenes]
    if drift:
        print(
            f"drift of the worst object in 5 s: median {statistics.median(drift):.3f} mm, largest {max(drift):.2f} mm"
        )
    stages: dict[str, list[float]] = {}
    for line in (folder / LOG).read_text(encoding="utf-8").splitlines():
        for stage, seconds in _stages(line).items():
            stages.setdefault(stage, []).append(seconds)
    told = ", ".join(f"{stage} {statistics.median(values):.2f}" for stage, values in stages.items())
    print(f"median seconds of a candidate: {told}")


def _stages(line: str) -> dict[str, Any]:
    try:
        said = json.loads(line)
    except ValueError:
        # The line that a killed run was at.
        return {}
    return {**said["stages"], "all": said["seconds"]}


if __name__ == "__main__":
    main()
