"""Does anything ever intersect? Random drops on every core, each recorded frame checked by ipctk.

python -m benchmarks.drops --scenes 10000            # about 3 CPU hours; the slow test suite does the same on one core
python -m benchmarks.drops --seconds 300 --seed 1    # as many as fit
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time
from collections import Counter

import numpy as np

BATCH = 10
"""Worlds that fall at once."""


def drop(job: tuple[str, list[int]]) -> tuple[str, int, list[str], list[str]]:
    """Kind, number of scenes, those that intersect and those that do not come to rest."""
    import warp as wp

    from tests.sim.test_drops import check

    wp.config.log_level = max(wp.config.log_level, wp.LOG_WARNING)
    kind, seeds = job
    return kind, len(seeds), *check(kind, seeds)


def main() -> int:
    """Run, print the counts now and then; 1 where anything intersects."""
    from tests.sim.drops import KINDS

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=10000)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="stop after this time")
    parser.add_argument("--seed", type=int, default=20261121)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    batches = -(-options.scenes // (BATCH * len(KINDS)))
    jobs = [(kind, [int(x) for x in rng.integers(0, 2**32, BATCH)]) for _ in range(batches) for kind in KINDS]
    begin = said = time.monotonic()
    counts: Counter[str] = Counter()
    crossing: list[str] = []
    restless: list[str] = []

    def say() -> None:
        print(
            f"{sum(counts.values())} scenes {dict(counts)} in {time.monotonic() - begin:.0f} s: "
            f"{len(crossing)} intersections {crossing[:5]}, {len(restless)} not at rest {restless[:10]}",
            flush=True,
        )

    os.environ["OMP_NUM_THREADS"] = "1"
    with multiprocessing.get_context("spawn").Pool(options.workers) as pool:
        for kind, number, wrong, moving in pool.imap_unordered(drop, jobs):
            counts[kind] += number
            crossing += wrong
            restless += moving
            if time.monotonic() - said > 30:
                said = time.monotonic()
                say()
            if time.monotonic() - begin > options.seconds:
                break
        pool.terminate()
    say()
    return 1 if crossing else 0


if __name__ == "__main__":
    sys.exit(main())
