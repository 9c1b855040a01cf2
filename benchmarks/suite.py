"""Scenes an hour of `pat3d suite generate`, where the time goes, and the share of scenes that stay still in MuJoCo.

    python benchmarks/suite.py [--scenes 100] [--workers 2] [--objects 6] [--device cuda] [--out FOLDER]
    python benchmarks/suite.py --report FOLDER          a suite that is there, finished or not

Verified means: balanced, disjoint, still for 5 s in MuJoCo, its relations hold, the robot can do its task. The first
candidates of all places are scenes that nothing replaced: what became of them is told apart from what became of those
that stand in for them. With --out, the suite and report.txt are kept there; pictures are left out where there is no
embreex.
"""

from __future__ import annotations

import argparse
import json
import re
import statistics
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from pat3d.envs.suites.folder import LOG, RECORD, REJECTED, SCENES, read_document
from pat3d.envs.suites.generate import Status, generate
from pat3d.envs.suites.manifest import numbers
from pat3d.envs.suites.request import Request

TARGET = 400
"""Verified scenes an hour on two cores at six objects."""

STILL_TARGET = 99.5
"""Of scenes that nothing replaced, those that stay still in MuJoCo [%]."""

_SECONDS = 10.0
"""Between two lines on how far a run is [s]."""


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--workers", default="2", help="a number, or auto for one a core")
    parser.add_argument("--objects", type=int, default=6)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--picture", type=int, default=320, help="width of the scenes' pictures; 0 for none")
    parser.add_argument("--device", choices=("cpu", "cuda"), default="cpu", help="where scenes settle")
    parser.add_argument("--block", type=int, help="scenes that settle together (64 on a GPU, one on a CPU)")
    parser.add_argument("--out", help="keep the suite, and what is printed in report.txt, here")
    parser.add_argument("--report", metavar="FOLDER", help="make nothing; tell of the suite in FOLDER")
    options = parser.parse_args()
    if options.report:
        _print(report(Path(options.report)))
        return
    picture = options.picture
    if picture and find_spec("embreex") is None:
        print("no pictures: embreex is not installed", flush=True)
        picture = 0
    request = Request(
        scenes=options.scenes,
        seed=options.seed,
        objects=(options.objects, options.objects),
        picture=picture,
        device=options.device,
    )
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(options.out or Path(scratch) / "suite")
        tell = _Progress().tell
        status = generate(str(folder), request, workers=options.workers, block=options.block, tell=tell)
        took = f"{status.made} scenes with {status.workers} workers in {status.seconds:.0f} s"
        times = f"target {TARGET} on 2 cores, {status.per_hour / TARGET:.1f} times"
        lines = [f"{took}: {status.per_hour:.0f} an hour ({times})", *report(folder)]
        _print(lines)
        if options.out:
            (folder / "report.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def report(folder: Path) -> list[str]:
    """What the suite in `folder` tells of all candidates so far, in lines."""
    scenes = [read_document(path) for path in sorted((folder / SCENES).glob(f"*/{RECORD}"))]
    rejected = [read_document(path) for path in sorted((folder / REJECTED).glob("*.json"))]
    found = numbers(scenes, rejected)
    lines = [f"{found['candidates']} candidates, {len(scenes)} scenes; {found['intersections']} intersections"]
    first = [one for one in (*scenes, *rejected) if one["candidate"] == 0]
    lines += _of("first candidates, none of them replaced", first)
    lines += _of("all candidates", (*scenes, *rejected))
    for reason, number in found["rejected"].items():
        lines.append(f"rejected, {reason}: {number} ({100 * number / found['candidates']:.1f} %)")
        examples = Counter(_kind_of(one) for one in rejected if one["reason"] == reason)
        lines += [f"  {count:5d}  {message}" for message, count in examples.most_common(8)]
    drift = [scene["verification"]["mujoco"]["mm"] for scene in scenes]
    if drift:
        middle, worst = statistics.median(drift), max(drift)
        lines.append(f"drift of the worst object in 5 s: median {middle:.3f} mm, largest {worst:.2f} mm")
    stages: dict[str, list[float]] = {}
    if (folder / LOG).exists():
        for line in (folder / LOG).read_text(encoding="utf-8").splitlines():
            for stage, seconds in _stages(line).items():
                stages.setdefault(stage, []).append(seconds)
    told = ", ".join(f"{stage} {statistics.median(values):.2f}" for stage, values in stages.items())
    lines.append(f"median seconds of a candidate: {told}")
    return lines


def _of(what: str, candidates: Any) -> Iterator[str]:
    """How many candidates stayed still in MuJoCo and passed every physical check, and what was wrong with the rest."""
    verifications = [one["verification"] for one in candidates if one.get("verification")]
    still = sum(verification["mujoco"]["passed"] for verification in verifications)
    # A task that the robot cannot do says nothing against the scene.
    unverified = [one for one in candidates if one.get("reason", "") not in ("", "task")]
    count = len(candidates)
    share = 100 * still / max(count, 1)
    met = "met" if share >= STILL_TARGET else "missed"
    yield f"{what}: {count}"
    yield f"  settled {len(verifications)}, still in MuJoCo {still}: {share:.2f} % (target {STILL_TARGET} %: {met})"
    yield f"  passed every physical check: {count - len(unverified)} of {count}"
    yield f"  and the robot can do the task: {sum(not one.get('reason') for one in candidates)} of {count}"
    for one in unverified:
        yield f"  place {one['place']}, candidate {one['candidate']}: {one['reason']}: {one['message'][:300]}"


def _kind_of(rejection: dict[str, Any]) -> str:
    """A rejection's message without names and figures, so that equal causes are counted together."""
    text = re.sub(r'"[^"]*"', '"..."', str(rejection["message"]))
    return re.sub(r"\d+(\.\d+)?", "#", text)[:150]


class _Progress:
    """A line every few seconds."""

    def __init__(self) -> None:
        self._last = 0.0

    def tell(self, status: Status) -> None:
        now = time.monotonic()
        if now - self._last < _SECONDS:
            return
        self._last = now
        rate = f"{status.per_hour:.0f} an hour, {status.rejected} rejected, {status.workers} workers"
        print(f"{status.seconds:6.0f} s  {status.done} of {status.total}  {status.note or rate}", flush=True)


def _print(lines: list[str]) -> None:
    print("\n".join(lines), flush=True)


def _stages(line: str) -> dict[str, Any]:
    try:
        said = json.loads(line)
    except ValueError:
        # The line that a killed run was at.
        return {}
    return {**said["stages"], "all": said["seconds"]}


if __name__ == "__main__":
    main()
