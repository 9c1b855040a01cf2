"""Is what is called verified true? Scene folders tampered with on purpose, and honest ones, through `pat3d check`.

    python benchmarks/attack.py --scenes scenes/desk --honest scenes/* --work work/attack

Every attack (benchmarks/attacks) is made on a copy of every scene. "checksums" have to convict it, and for exports
"contents" as well: what the export says, whatever the checksums, for an attacker may write those anew. Who makes
another scene of it, consistent in every file, has a scene, and it is the laws of physics that have to convict it
("whole"). Honest scenes are read and written anew with the code at hand, then checked: one that is refused is a failure
of the check. Exit code 1 where an attack passes or an honest scene is refused.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import time
from pathlib import Path

from benchmarks.attacks import Attack, attacks
from pat3d.check.folder import check_export, check_folder
from pat3d.errors import Pat3dError
from pat3d.exporters.formats import FORMATS, export
from pat3d.scene.checksums import compare_checksums, record_checksums
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Scene


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


def strike(attack: Attack, source: Path, scene: Scene, work: Path) -> bool | None:
    """Whether `attack` on a copy of the folder `source` is convicted; None where there is nothing for it.

    Of a forged folder only the export that was attacked is checked, as `pat3d check` does it: the rest is as it was.
    """
    folder = work / "attacked"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    try:
        if attack.deed(folder) is False:
            return None
    except (IndexError, AttributeError, StopIteration):
        return None
    start = time.perf_counter()
    found = {}
    if attack.kind != "whole":
        found["checksums"] = compare_checksums(folder).failures
    if attack.forged:
        found["contents"] = check_export(scene, folder / attack.kind, anew=source / attack.kind)[0]
    if not found:
        found["check"] = verdict(folder)
    done = all(found.values())
    words = ", ".join(f"{defence} {'yes' if lines else 'NO'}" for defence, lines in found.items())
    seconds = time.perf_counter() - start
    print(f"{'convicted' if done else 'PASSED':9}  {attack.kind:6}  {attack.name:36}  {words}, {seconds:.1f} s")
    for line in [*found.values()][-1][:1]:
        print(f"           {line.replace(str(folder), '.')[:150]}", flush=True)
    return done


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="*", type=Path, default=[], help="scene folders to attack")
    parser.add_argument("--honest", nargs="*", type=Path, default=[], help="scene folders that have to hold")
    parser.add_argument("--only", nargs="*", default=[], help="kinds of attacks: mjcf, usd, urdf, sdf, scene, ...")
    parser.add_argument("--work", type=Path, required=True)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    struck, absent = [], []
    for source in options.scenes:
        folder = rewritten(source, options.work / "scene")
        scene = load_scene(folder)
        for attack in attacks():
            if not options.only or attack.kind in options.only:
                done = strike(attack, folder, scene, options.work)
                (absent if done is None else struck).append((source, attack, done))
    refused = []
    for source in options.honest:
        failures = verdict(rewritten(source, options.work / "honest"))
        print(f"{'REFUSED' if failures else 'held':9}  {source}", *failures[:3], sep="\n           ", flush=True)
        refused += [source] if failures else []
    for source, attack, _ in absent:
        print(f"nothing to attack in {source}: {attack.kind}, {attack.name}")
    passed = [(source, attack) for source, attack, done in struck if not done]
    for source, attack in passed:
        print(f"PASSED: {attack.kind}, {attack.name} ({source})")
    print(f"{len(struck) - len(passed)} of {len(struck)} attacks convicted")
    print(f"{len(options.honest) - len(refused)} of {len(options.honest)} honest scenes held")
    return 1 if passed or refused else 0


if __name__ == "__main__":
    sys.exit(main())
