"""What every driver writes: poses over time, as one JSON file. Needs Python alone.

A driver is a script that runs in an engine's own environment:

    python drive_<engine>.py EXPORT --seconds 5 --out run.json [--variant NAME] [--lean DEGREES]

It loads the export as any user of the engine would, steps it untouched, and records where every body is. With --lean
gravity leans more and more, as if the ground were tilted, and goes around while it does.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FORMAT = "pat3d-engine-run"

INTERVAL = 0.01
"""Simulated time between two records [s]."""

TURN = 2.0
"""In which gravity that leans goes around once [s]."""

FELL = 0.03, math.cos(math.radians(10.0) / 2)
"""A run that leans ends where a body has moved so far [m], or the quaternions of its turn have so small a product."""

Poses = Mapping[str, Sequence[float]]
"""Body name to (x, y, z, qw, qx, qy, qz) of the body frame in the world, [m] and scalar first."""


class Recording:
    """Poses of every moving body at every record."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.names: list[str] = []
        self.poses: list[list[list[float]]] = []
        self.leans: list[float] = []

    def add(self, now: float, poses: Poses, lean: float = 0.0) -> bool:
        """Record `poses` at time `now` [s] under gravity that leans [degrees]; returns whether they are finite."""
        if not self.names:
            self.names = sorted(poses)
        row = [[float(value) for value in poses[name]] for name in self.names]
        self.times.append(float(now))
        self.poses.append(row)
        self.leans.append(lean)
        return all(math.isfinite(value) for pose in row for value in pose)

    def fell(self) -> bool:
        """Whether a body is far from where it was."""
        furthest, product = FELL
        return any(
            math.dist(now[:3], start[:3]) > furthest
            or abs(sum(a * b for a, b in zip(now[3:], start[3:], strict=True))) < product
            for now, start in zip(self.poses[-1], self.poses[0], strict=True)
        )


@dataclass(frozen=True)
class Lean:
    """Gravity as on ground that is tilted further and further, towards one side after the other."""

    degrees: float
    """In the end; half of it after a tenth of the time."""
    seconds: float
    """Of the whole run."""

    def tilt(self, now: float) -> float:
        """Of the ground [degrees] at time `now` [s]."""
        share = now / self.seconds
        return self.degrees * (5 * share if share < 0.1 else 0.5 + 0.5 * (share - 0.1) / 0.9)

    def down(self, now: float) -> tuple[float, float, float]:
        """Direction of gravity at time `now` [s]."""
        tilt, side = math.radians(self.tilt(now)), 2 * math.pi * now / TURN
        return math.sin(tilt) * math.cos(side), math.sin(tilt) * math.sin(side), -math.cos(tilt)


def run(
    step: Callable[[int], None],
    poses: Callable[[], Poses],
    time_step: float,
    seconds: float,
    pull: Callable[[tuple[float, float, float]], None] | None = None,
    lean: float = 0.0,
) -> Recording:
    """Step an engine for `seconds` and record; ends early when a pose is no longer finite.

    Args:
        step: advances by the given number of time steps.
        poses: of every moving body, now.
        time_step: [s].
        seconds: simulated time [s].
        pull: turns gravity to a direction of unit length.
        lean: of gravity in the end [degrees]; such a run ends early when something has fallen.
    """
    if lean and pull is None:
        raise SystemExit("this driver cannot turn gravity.")
    leaning = Lean(lean, seconds)
    recording = Recording()
    steps, stride, done = max(1, round(seconds / time_step)), max(1, round(INTERVAL / time_step)), 0
    finite = recording.add(0.0, poses())
    while finite and done < steps and not (lean and recording.fell()):
        count = min(stride, steps - done)
        if lean and pull is not None:
            pull(leaning.down(done * time_step))
        step(count)
        done += count
        finite = recording.add(done * time_step, poses(), leaning.tilt(done * time_step))
    return recording


def main(drive: Callable[[Path, float, str, float], dict[str, Any]]) -> None:
    """Read the command line, call `drive(export, seconds, variant, lean)` and write what it returns.

    `drive` returns engine, version, settings, warnings and the recording.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("export", type=Path)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--variant", default="", help="which solver, of engines that have several")
    parser.add_argument("--lean", type=float, default=0.0, metavar="DEGREES", help="of gravity, in the end")
    options = parser.parse_args()
    start = time.perf_counter()
    found = drive(options.export, options.seconds, options.variant, options.lean)
    recording: Recording = found.pop("recording")
    document = {
        "format": FORMAT,
        **found,
        "wall_seconds": time.perf_counter() - start,
        "times": recording.times,
        "names": recording.names,
        "poses": recording.poses,
        "leans": recording.leans,
    }
    temporary = options.out.with_name(options.out.name + ".part")
    temporary.write_text(json.dumps(document), encoding="utf-8")
    os.replace(temporary, options.out)
