"""Is what is called verified true? Scene folders tampered with on purpose, and honest ones, through `pat3d check`.

    python -m benchmarks.attack --scenes scenes/desk --honest scenes/* --work work/attack [--jobs 16]

Every attack (benchmarks/attacks) is made on a copy of every scene. "checksums" have to convict it, and for exports
"contents" as well: what the export says, whatever the checksums, for an attacker may write those anew. Who makes
another scene of it, consistent in every file, has a scene, and it is the laws of physics that have to convict it
("whole"). Honest scenes are read and written anew with the code at hand, then checked: one that is refused is a failure
of the check. Exit code 1 where an attack passes or an honest scene is refused.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from benchmarks.attacks import Attack, attacks
from pat3d.check.folder import check_export, check_folder
from pat3d.errors import Pat3dError
from pat3d.exporters.formats import FORMATS, export
from pat3d.scene.checksums import compare_checksums, record_checksums
from pat3d.scene.io import load_scene, save_scene

ATTACKS = tuple(attacks())


def rewritten(source: Path, folder: Path) -> Path:
    """The scene of `source` with the exports it has, as they are written now."""
    scene = load_scene(source)
    shutil.rmtree(folder, ignore_errors=True)
    save_scene(scene, folder)
    export(scene, [name for name in FORMATS if name == "mjcf" or (source / name).is_dir()], folder)
    record_checksums(folder)
    return folder


def verdict(folder: Path) -> tuple[str, ...]:
    """What `pat3d check` has against a folder."""
    try:
        return check_folder(folder).failures
    except Pat3dError as error:
        return (str(error),)


@dataclass(frozen=True, kw_only=True)
class Struck:
    """What came of one attack, or of one honest scene."""

    done: bool | None
    """Whether it was convicted, or held; None where there is nothing to attack."""
    lines: tuple[str, ...]
    """To print."""


def strike(number: int, source: Path, work: Path) -> Struck:
    """Attack `number` on a copy of the folder `source`.

    Of a forged folder only the export that was attacked is checked, as `pat3d check` does it: the rest is as it was.
    """
    attack = ATTACKS[number]
    folder = work / f"attacked-{number:03d}"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    try:
        if attack.deed(folder) is False:
            return Struck(done=None, lines=())
    except (IndexError, AttributeError, StopIteration):
        return Struck(done=None, lines=())
    else:
        return convicted(attack, source, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def convicted(attack: Attack, source: Path, folder: Path) -> Struck:
    """Whether every defence that should notice the attack on `folder` does."""
    start = time.perf_counter()
    found = {}
    if attack.kind != "whole":
        found["checksums"] = compare_checksums(folder).failures
    if attack.forged:
        found["contents"] = check_export(load_scene(source), folder / attack.kind, anew=source / attack.kind)[0]
    if not found:
        found["check"] = verdict(folder)
    done = all(found.values())
    words = ", ".join(f"{defence} {'yes' if lines else 'NO'}" for defence, lines in found.items())
    seconds = time.perf_counter() - start
    first = f"{'convicted' if done else 'PASSED':9}  {attack.kind:6}  {attack.name:36}  {words}, {seconds:.1f} s"
    why = [f"           {line.replace(str(folder), '.')[:150]}" for line in [*found.values()][-1][:1]]
    return Struck(done=done, lines=(first, *why))


def hold(number: int, source: Path, work: Path) -> Struck:
    """Whether an honest scene passes."""
    failures = verdict(rewritten(source, work / f"honest-{number:03d}"))
    shutil.rmtree(work / f"honest-{number:03d}", ignore_errors=True)
    word = "REFUSED" if failures else "held"
    return Struck(done=not failures, lines=(f"{word:9}  {source}", *(f"           {line}" for line in failures[:3])))


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="*", type=Path, default=[], help="scene folders to attack")
    parser.add_argument("--honest", nargs="*", type=Path, default=[], help="scene folders that have to hold")
    parser.add_argument("--only", nargs="*", default=[], help="kinds of attacks: mjcf, usd, urdf, sdf, scene, ...")
    parser.add_argument("--jobs", type=int, default=1, help="attacks, or honest scenes, at a time")
    parser.add_argument("--work", type=Path, required=True)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    every = [k for k, attack in enumerate(ATTACKS) if not options.only or attack.kind in options.only]
    struck: list[tuple[Path, Attack, bool | None]] = []
    refused = []
    with ProcessPoolExecutor(options.jobs, mp_context=get_context("spawn")) as pool:
        for source in options.scenes:
            folder = rewritten(source, options.work / "scene")
            for number, one in zip(
                every, pool.map(partial(strike, source=folder, work=options.work), every), strict=True
            ):
                struck.append((source, ATTACKS[number], one.done))
                print(*one.lines, sep="\n", end="\n" if one.lines else "", flush=True)
        waiting = [pool.submit(hold, number, source, options.work) for number, source in enumerate(options.honest)]
        for source, one in zip(options.honest, (job.result() for job in waiting), strict=True):
            print(*one.lines, sep="\n", flush=True)
            refused += [] if one.done else [source]
    for source, attack, done in struck:
        if done is None:
            print(f"nothing to attack in {source}: {attack.kind}, {attack.name}")
    passed = [(source, attack) for source, attack, done in struck if done is False]
    for source, attack in passed:
        print(f"PASSED: {attack.kind}, {attack.name} ({source})")
    count = sum(done is not None for *_, done in struck)
    print(f"{count - len(passed)} of {count} attacks convicted")
    print(f"{len(options.honest) - len(refused)} of {len(options.honest)} honest scenes held")
    return 1 if passed or refused else 0


if __name__ == "__main__":
    sys.exit(main())
