"""Runs CoACD on one mesh in a process of its own, since bad input makes the library abort or hang.

    python -P coacd_worker.py INPUT.npz OUTPUT.npz [SECONDS]

INPUT holds `vertices`, `faces` and a JSON string `options`; OUTPUT gets the parts' `points`, one after
another, and the `counts` of points per part. No pickle on either side. The system ends it after SECONDS of processor
time.
"""

from __future__ import annotations

import json
import sys

import numpy as np


def main(source: str, target: str) -> None:
    """Decompose the mesh in file `source` into convex parts in file `target`."""
    import coacd

    with np.load(source, allow_pickle=False) as data:
        vertices, faces = data["vertices"], data["faces"]
        options = json.loads(str(data["options"]))
    coacd.set_log_level("error")
    parts = [np.asarray(points) for points, _ in coacd.run_coacd(coacd.Mesh(vertices, faces), **options)]
    with open(target, "wb") as file:
        np.savez(file, points=np.concatenate(parts), counts=np.array([len(points) for points in parts]))


def limit(seconds: int) -> None:
    """Let the system end this process after `seconds` of processor time."""
    import resource

    # The second number is for what ignores the signal that comes at the first.
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))


if __name__ == "__main__":
    if len(sys.argv) > 3:
        limit(int(sys.argv[3]))
    main(sys.argv[1], sys.argv[2])
