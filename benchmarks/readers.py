"""Which readers take our exports: format by reader by scene, every reader in an environment of its own.

    python benchmarks/readers.py exports/desk exports/mug [--environments build/readers] [--only pinocchio,drake]

An export folder holds mjcf, urdf, usd and sdf, as `pat3d export` writes them, or some of these. A reader passes where
it loads the file and finds as many moving bodies as the scene has, of the same mass to a millionth. Environments are
made on the first run; one that cannot be made is told. Exits with 1 if a reader fails on a scene.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from pat3d.check.engines.environments import PINS
from pat3d.scene.io import load_scene
from pat3d.scene.model import Scene

PROGRAM = Path(__file__).with_name("reader_programs.py")
TIMEOUT = 900.0
"""[s], of one reader on one scene; XLA compiles for minutes."""

MASS = 1e-6
"""Relative error of the mass that passes."""


@dataclass(frozen=True, kw_only=True)
class Reader:
    """A program that reads one of our files."""

    title: str
    format: str
    """The folder of the export that it reads."""
    file: str
    program: str
    """One of reader_programs."""
    packages: tuple[str, ...]
    """What pip installs into its environment, named after the first of them; none for our own environment."""

    @property
    def environment(self) -> str:
        """Name of its environment; empty for our own."""
        return self.packages[0].replace("==", "-").lower() if self.packages else ""


OURS = ()
"""Packages of a reader that is installed beside us."""

OVPHYSX = tuple((PINS / "physx.txt").read_text(encoding="utf-8").split())
"""What `pat3d check --engines physx` runs in."""

MOST_COLUMNS = 4
"""More scenes than this are one column that counts them, with every failure below the table."""

READERS = tuple(
    Reader(title=title, format=format, file=file, program=program, packages=packages)
    for title, format, file, program, packages in (
        ("MuJoCo 3.3", "mjcf", "scene_mujoco_3.3.xml", "mujoco", ("mujoco==3.3.7",)),
        ("MuJoCo 3.9", "mjcf", "scene.xml", "mujoco", OURS),
        ("MuJoCo 4.0", "mjcf", "scene.xml", "mujoco", ("mujoco==4.0.0",)),
        ("MJX", "mjcf", "scene_mjx.xml", "mjx", ("mujoco-mjx==3.17.0",)),
        ("MuJoCo Warp", "mjcf", "scene.xml", "mujoco_warp", ("mujoco-warp==3.17.0",)),
        ("dm_control", "mjcf", "scene.xml", "dm_control", ("dm_control", "mujoco<4")),
        ("robosuite", "mjcf", "scene.xml", "robosuite", OURS),
        ("yourdfpy", "urdf", "manifest.json", "yourdfpy", ("yourdfpy==0.0.60",)),
        ("Pinocchio", "urdf", "manifest.json", "pinocchio", ("pin==4.1.0",)),
        ("SAPIEN", "urdf", "manifest.json", "sapien", ("sapien==3.0.3", "setuptools<81")),
        ("check_urdf", "urdf", "manifest.json", "urdfdom", ("cmeel-urdfdom==6.0.0",)),
        ("urdf-usd-converter", "urdf", "manifest.json", "urdf_usd_converter", ("urdf-usd-converter==0.3.4",)),
        ("PyBullet", "urdf", "manifest.json", "pybullet", ("pybullet",)),
        ("Drake, directives", "urdf", "manifest.json", "drake", ("drake",)),
        ("Drake, SDF", "sdf", "scene.sdf", "drake", ("drake",)),
        ("mujoco-usd-converter", "mjcf", "scene.xml", "mujoco_usd_converter", ("mujoco-usd-converter==0.8.0",)),
        ("OpenUSD", "usd", "scene.usdc", "openusd", OURS),
        ("Newton", "usd", "scene.usdc", "newton", ("newton",)),
        ("PhysX (ovphysx)", "usd", "scene.usdc", "ovphysx", OVPHYSX),
        ("Blender", "usd", "scene.usdc", "blender", ("bpy",)),
    )
)


FINE = ("pass", "not written")


def interpreter(reader: Reader, folder: Path) -> Path:
    """The Python of a reader's environment, made if need be.

    Raises:
        subprocess.CalledProcessError: pip cannot install it here.
    """
    if not reader.packages:
        return Path(sys.executable)
    home = folder / reader.environment
    python = home / "bin" / "python"
    if not (home / ".made").exists():
        subprocess.run([sys.executable, "-m", "venv", str(home)], check=True)
        pip = [str(python), "-m", "pip", "install", "--quiet", *reader.packages]
        subprocess.run(pip, check=True, capture_output=True, text=True)
        (home / ".made").touch()
    return python


def verdict(reader: Reader, python: Path, export: Path, scene: Scene) -> str:
    """The word "pass", or why not."""
    path = export / reader.format / reader.file
    if not path.exists():
        return "not written"
    command = [str(python), "-P", str(PROGRAM), reader.program, str(path)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False, cwd=export)
    except subprocess.TimeoutExpired:
        return f"no answer within {TIMEOUT:g} s"
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode or not lines:
        said = [line for line in (done.stderr or done.stdout).splitlines() if line.strip()]
        return f"refused: {said[-1][:140] if said else f'exit code {done.returncode}'}"
    return "; ".join(_wrong(json.loads(lines[-1]), scene)) or "pass"


def _wrong(found: dict, scene: Scene) -> Iterator[str]:
    moving = [obj for obj in scene.objects if not obj.fixed]
    mass = sum(obj.asset.mass_properties.mass for obj in moving)
    assets = len({id(obj.asset) for obj in scene.objects})
    if found.get("bodies", len(moving)) != len(moving):
        yield f"{found['bodies']} bodies for {len(moving)}"
    if abs(found.get("mass", mass) - mass) > MASS * max(mass, 1e-9):
        yield f"{found['mass']:.6g} kg for {mass:.6g} kg"
    if found.get("objects", assets) != assets:
        yield f"{found['objects']} objects for {assets}"
    if found.get("pictures", assets) < assets:
        yield f"{found['pictures']} pictures for {assets} assets"


def main() -> int:
    """Print the matrix."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("exports", type=Path, nargs="+", help="folders that pat3d export wrote, with their scene.json")
    parser.add_argument("--environments", type=Path, default=Path("build/readers"), help="where the readers live")
    parser.add_argument("--only", help="titles or programs, with commas between")
    parser.add_argument("--jobs", type=int, default=1, help="readers at work at the same time")
    given = parser.parse_args()
    wanted = {word.strip().lower() for word in (given.only or "").split(",") if word.strip()}
    exports = [path.resolve() for path in given.exports]
    scenes = [load_scene(path) for path in exports]
    names = [path.name for path in exports] if len(exports) <= MOST_COLUMNS else [f"{len(exports)} scenes"]
    print("| reader | format |", " | ".join(names), "|")
    print("| --- | --- |", " | ".join("---" for _ in names), "|")
    environments = given.environments.resolve()

    def cells(reader: Reader) -> list[str]:
        try:
            python = interpreter(reader, environments)
        except subprocess.CalledProcessError as error:
            said = [line for line in (error.stderr or "").splitlines() if line.startswith("ERROR")]
            return [f"not installed: {said[-1] if said else error}"] * len(exports)
        return [verdict(reader, python, path, scene) for path, scene in zip(exports, scenes, strict=True)]

    chosen = [one for one in READERS if not wanted or wanted & {one.title.lower(), one.program}]
    failures: list[str] = []
    with ThreadPoolExecutor(max(1, given.jobs)) as pool:
        for reader, found in zip(chosen, pool.map(cells, chosen), strict=True):
            bad = [(path.name, cell) for path, cell in zip(exports, found, strict=True) if cell not in FINE]
            failures += [f"{reader.title}, {name}: {cell}" for name, cell in bad]
            if len(exports) > MOST_COLUMNS:
                found = [f"{found.count('pass')} pass, {len(bad)} fail"]
            print(f"| {reader.title} | {reader.format} |", " | ".join(found), "|", flush=True)
    if len(exports) > MOST_COLUMNS:
        print("\n".join(["", *failures]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
