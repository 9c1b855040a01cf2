"""Did a change of the code change what it makes? Scenes, exports, a suite and episodes, made twice and compared.

    python benchmarks/golden.py make FOLDER --prompts benchmarks/prompts.txt     with the code of one commit
    python benchmarks/golden.py compare BEFORE AFTER                            exit code 1 where they differ

Compared bit for bit: scene.json, assets, MJCF, USD, URDF and SDF of every prompt, the scenes of a suite of 12, and the
states and actions of 20 episodes of the scripted policy. Left out: times of day, seconds taken, versions, and reports.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from benchmarks.generate import read_prompts

SUITE = ("suite", "generate", "suite", "--tasks", "pick,place,stack,sort,unload", "--scenes", "12", "--seed", "0")
EPISODES = ("evaluate", "--policy", "scripted", "--episodes", "20", "--perturb", "pose=0.04", "--out", "episodes")

VOLATILE = re.compile(
    r',?\s*"(versions?|pat3d|code|seconds|created|host|checksums?|manifest_sha256)": *(\{[^}]*\}|"[^"]*"|[-\d.e]+)'
)
"""JSON values that differ between two runs of one commit, or name it."""

UNCOMPARED = ("report.json", "report.html", "index.html", "manifest.json.lock", "preview.png", "env.py")


def make(folder: Path, prompts: list[str]) -> None:
    """Run the commands in `folder`; a command that fails is told and leaves no files to compare."""
    folder.mkdir(parents=True, exist_ok=True)
    formats = ("--formats", "mjcf", "usd", "urdf", "sdf")
    commands = [
        ("generate", prompt, "--seed", "0", *formats, "--out", f"prompts/{number:02d}")
        for number, prompt in enumerate(prompts, start=1)
    ]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[1])}
    for command in (*commands, (*SUITE, "--workers", "1"), EPISODES):
        done = subprocess.run(
            [sys.executable, "-m", "pat3d", *command],
            cwd=folder,
            env=environment,
            stdout=subprocess.DEVNULL,
            check=False,
        )
        print(f"exit {done.returncode}: pat3d {' '.join(command)[:90]}", flush=True)


def differences(before: Path, after: Path) -> Iterator[str]:
    """Files that only one side has, or whose contents differ."""
    names = [
        {path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_file() and kept(path)}
        for root in (before, after)
    ]
    for name in sorted(names[0] ^ names[1]):
        yield f"{name}: only {'before' if name in names[0] else 'after'}"
    for name in sorted(names[0] & names[1]):
        first, second = ((root / name).read_bytes() for root in (before, after))
        if first != second and cleaned(name, first) != cleaned(name, second):
            yield f"{name}: differs"


def kept(path: Path) -> bool:
    """Whether the file says something about a scene or an episode."""
    return path.name not in UNCOMPARED and path.suffix in (
        ".json", ".obj", ".xml", ".usdc", ".urdf", ".sdf", ".yaml", ".npz", ".parquet", ".mtl"
    )  # fmt: skip


def cleaned(name: str, content: bytes) -> object:
    """`content` without what differs between two runs of one commit."""
    if name.endswith(".parquet"):
        from pyarrow import BufferReader
        from pyarrow.parquet import read_table

        table = read_table(BufferReader(content))
        return table.select([column for column in table.column_names if "seconds" not in column]).to_pylist()
    return VOLATILE.sub("", content.decode(errors="replace").replace('"proof"', '"verification"'))


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    making = verbs.add_parser("make")
    making.add_argument("folder", type=Path)
    making.add_argument("--prompts", type=Path, default=Path(__file__).parent / "prompts.txt")
    comparing = verbs.add_parser("compare")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    options = parser.parse_args()
    if options.verb == "make":
        make(options.folder, read_prompts(options.prompts))
        return 0
    found = list(differences(options.before, options.after))
    print(*found, f"{len(found)} differences", sep="\n")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
