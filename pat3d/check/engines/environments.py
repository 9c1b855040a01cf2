"""Where the engines live: a virtual environment each, because their pins contradict one another.

    python -m pat3d.check.engines.environments [NAME ...]

makes those named, or all. They lie in $PAT3D_ENGINES, or else in the folder `engines` of the cache.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

from pat3d.errors import CheckError
from pat3d.scene.cache import cache_root

PINS = Path(__file__).parent / "pins"
NAMES = ("mujoco-oldest", "mujoco-newest", "newton", "pybullet", "drake", "physx")

INSTALL_SECONDS = 1800.0
"""Wall time after which pip is given up [s]."""


def engines_root() -> Path:
    """$PAT3D_ENGINES, or the folder `engines` of the cache."""
    given = os.environ.get("PAT3D_ENGINES")
    return Path(given).expanduser() if given else cache_root() / "engines"


def interpreter(name: str) -> Path:
    """The Python of environment `name`, whether it exists or not."""
    folder = engines_root() / name
    return folder / "Scripts" / "python.exe" if os.name == "nt" else folder / "bin" / "python"


def is_made(name: str) -> bool:
    """Whether environment `name` is complete and has the pins of this version."""
    marker = engines_root() / name / "pins.txt"
    try:
        return interpreter(name).exists() and marker.read_bytes() == (PINS / f"{name}.txt").read_bytes()
    except OSError:
        return False


def how_to_get(name: str) -> str:
    """What to type for environment `name`."""
    return f"make engine-{name} (or: python -m pat3d.check.engines.environments {name})"


def make(name: str) -> None:
    """Make environment `name` anew.

    Raises:
        CheckError: pip could not install the pins; the message is its last line.
    """
    folder = engines_root() / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    venv.create(folder, with_pip=True)
    command = [str(interpreter(name)), "-m", "pip", "install", "--quiet", "--requirement", str(PINS / f"{name}.txt")]
    with tempfile.TemporaryFile() as output:
        try:
            done = subprocess.run(
                command, stdin=subprocess.DEVNULL, stdout=output, stderr=output, timeout=INSTALL_SECONDS, check=False
            )
            code = done.returncode
        except subprocess.TimeoutExpired:
            code = -1
        if code != 0:
            output.seek(max(0, output.tell() - 4000))
            lines = [line for line in output.read().decode("utf-8", "replace").splitlines() if line.strip()]
            errors = [line for line in lines if line.startswith("ERROR")] or lines or ["no message"]
            raise CheckError(f"{name}: pip could not install its packages: {errors[-1]}")
    shutil.copyfile(PINS / f"{name}.txt", folder / "pins.txt")


def main(names: list[str] | None = None) -> int:
    """Make the environments named on the command line; those that are made already are left alone."""
    parser = argparse.ArgumentParser(description="Make the virtual environments that pat3d check --engines uses.")
    parser.add_argument("names", nargs="*", choices=[*NAMES, []], metavar="NAME", help=", ".join(NAMES))
    chosen = parser.parse_args(names).names or NAMES
    failed = False
    for name in chosen:
        if is_made(name):
            print(f"{name}: already in {engines_root() / name}")
            continue
        print(f"{name}: installing into {engines_root() / name} ...", flush=True)
        try:
            make(name)
        except (CheckError, OSError, subprocess.CalledProcessError) as error:
            failed = True
            print(f"pat3d: {error}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
