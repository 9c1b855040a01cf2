"""What every driver writes: poses over time, as one JSON file. Needs Python alone.

A driver is a script that runs in an engine's own environment:

    python drive_<engine>.py EXPORT --seconds 5 --out run.json [--variant NAME]

It loads the export as any user of the engine would, steps it untouched, and records where every body is.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

FORMAT = "pat3d-engine-run"

INTERVAL = 0.01
"""Simulated time between two records [s]."""

Poses = Mapping[str, Sequence[float]]
"""Body name to (x, y, z, qw, qx, qy, qz) of the body frame in the world, [m] and scalar first."""


class Recording:
    """Poses of every moving body at every record."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.names: list[str] = []
        self.poses: list[list[list[float]]] = []

    def add(self, now: float, poses: Poses) -> bool:
        """Record `poses` at time `now` [s]; returns whether they are finite."""
        if not self.names:
            self.names = sorted(poses)
        row = [[float(value) for value in poses[name]] for name in self.names]
        self.times.append(float(now))
        self.poses.append(row)
        return all(math.isfinite(value) for pose in row for value in pose)


def run(step: Callable[[int], None], poses: Callable[[], Poses], time_step: float, seconds: float) -> Recording:
    """Step an engine for `seconds` and record; ends early when a pose is no longer finite.

    Args:
        step: advances by the given number of time steps.
        poses: of every moving body, now.
        time_step: [s].
        seconds: simulated time [s].
    """
    recording = Recording()
    steps, stride, done = max(1, round(seconds / time_step)), max(1, round(INTERVAL / time_step)), 0
    finite = recording.add(0.0, poses())
    while finite and done < steps:
        count = min(stride, steps - done)
        step(count)
        done += count
        finite = recording.add(done * time_step, poses())
    return recording


def main(drive: Callable[[Path, float, str], dict[str, Any]]) -> None:
    """Read the command line, call `drive(export, seconds, variant)` and write what it returns.

    `drive` returns engine, version, settings, warnings and the recording.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("export", type=Path)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--variant", default="", help="which solver, of engines that have several")
    options = parser.parse_args()
    start = time.perf_counter()
    found = drive(options.export, options.seconds, options.variant)
    recording: Recording = found.pop("recording")
    document = {
        "format": FORMAT,
        **found,
        "wall_seconds": time.perf_counter() - start,
        "times": recording.times,
        "names": recording.names,
        "poses": recording.poses,
    }
    temporary = options.out.with_name(options.out.name + ".part")
    temporary.write_text(json.dumps(document), encoding="utf-8")
    os.replace(temporary, options.out)
