"""What does it cost to look at true surfaces? Processor time of that part of the check, over that of all the rest.

python -m benchmarks.surface_cost [--prompts benchmarks/prompts.txt] [--only 1 2 3] [--seed 0]

Every prompt is generated in this process. Counted is what `certify` does with the visual meshes: finding where they are
near the contacts, balancing forces there, and the tilt that they stand. Processor time, so that a busy machine changes
nothing; the start of Python is left out, which makes the share larger than a user sees.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from benchmarks.generate import HERE, read_prompts
from pat3d.check import certificate
from pat3d.errors import Pat3dError
from pat3d.generation.pipeline import generate

MOST = 0.2
"""Of a scene's time without them that true surfaces may take."""


@contextmanager
def timed() -> Iterator[list[float]]:
    """Seconds from each start of `true_support` to the end of the tilt that is found with its contacts."""
    found: list[float] = []
    started: list[float] = []
    support, tilt = certificate.true_support, certificate._largest_tilt

    def begun(*given: Any) -> Any:
        started.append(time.process_time())
        return support(*given)

    def ended(*given: Any) -> Any:
        result = tilt(*given)
        if started:
            found.append(time.process_time() - started.pop())
        return result

    certificate.true_support, certificate._largest_tilt = begun, ended
    try:
        yield found
    finally:
        certificate.true_support, certificate._largest_tilt = support, tilt


def main() -> int:
    """Print a row for each prompt, and the shares; 1 where one is over MOST."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prompts", type=Path, default=HERE / "prompts.txt", help="one prompt a line")
    parser.add_argument("--only", type=int, nargs="+", help="numbers of the prompts to run, from 1")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    shares = []
    print("| prompt | whole [s] | preview [s] | true surfaces [s] | more time | without the preview |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: |")
    for number, prompt in enumerate(read_prompts(options.prompts), start=1):
        if options.only and number not in options.only:
            continue
        with tempfile.TemporaryDirectory() as folder, timed() as surfaces, drawing() as pictures:
            start = time.process_time()
            try:
                generate(prompt, out=Path(folder) / "scene", seed=options.seed)
            except Pat3dError as error:
                print(f"prompt {number}: {error}", file=sys.stderr)
                continue
            whole = time.process_time() - start
        spent, drawn = sum(surfaces), sum(pictures)
        shares.append((spent / (whole - spent), spent / (whole - drawn - spent)))
        cells = (f"{number}", f"{whole:.2f}", f"{drawn:.2f}", f"{spent:.2f}", *(f"{one:.1%}" for one in shares[-1]))
        print("| " + " | ".join(cells) + " |", flush=True)
    if not shares:
        return 1
    every, bare = zip(*shares, strict=True)
    print(f"\nmedian {statistics.median(every):.1%}, most {max(every):.1%}; without the preview", end=" ")
    print(f"{statistics.median(bare):.1%} and {max(bare):.1%}")
    return 0 if max(every) <= MOST else 1


@contextmanager
def drawing() -> Iterator[list[float]]:
    """Seconds of each preview, which has nothing to do with the check and takes longest."""
    from pat3d.view import preview

    found: list[float] = []
    draw = preview.save_preview

    def drawn(*given: Any) -> Any:
        start = time.process_time()
        result = draw(*given)
        found.append(time.process_time() - start)
        return result

    preview.save_preview = drawn
    try:
        yield found
    finally:
        preview.save_preview = draw


if __name__ == "__main__":
    sys.exit(main())
