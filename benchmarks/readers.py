"""Which readers take our exports: format by reader by scene, every reader in an environment of its own.

    python -m benchmarks.readers exports/desk exports/mug [--environments build/readers] [--only pinocchio,drake]

An export folder holds mjcf, urdf, usd and sdf, as `pat3d export --usdz` writes them, or some of these, and a
scene.json. A reader passes where it loads the file and finds as many moving bodies as the scene has, of the same mass
to a millionth. Environments are made on the first run; one that cannot be made is told. A reader is given all scenes
in one process, and goes on with the next one in another where it crashed. Exits with 1 if a reader fails on a scene.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from pat3d.check.engines.environments import PINS
from pat3d.exporters.urdf.mesh_paths import set_mesh_paths
from pat3d.scene.io import load_scene
from pat3d.scene.model import Scene

PROGRAM = Path(__file__).with_name("reader_programs")
TIMEOUT = 900.0
"""[s], of one reader on all scenes that one process reads; XLA compiles for minutes."""

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
    dependencies: bool = True
    """Whether pip installs what the packages ask for; else our own environment's packages are there too."""
    absolute: bool = False
    """Whether it reads URDF files only that name their meshes from the root folder."""
    alone: bool = False
    """Whether it reads one file a process."""

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

READERS = (
    *(
        Reader(title=title, format=format, file=file, program=program, packages=packages)
        for title, format, file, program, packages in (
            ("MuJoCo 3.3", "mjcf", "scene_mujoco_3.3.xml", "mujoco", ("mujoco==3.3.7",)),
            ("MuJoCo 3.9", "mjcf", "scene.xml", "mujoco", OURS),
            ("MuJoCo 4.0", "mjcf", "scene.xml", "mujoco", ("mujoco==4.0.0",)),
            ("MJX", "mjcf", "scene_mjx.xml", "mjx", ("mujoco-mjx==3.17.0",)),
            ("MuJoCo Warp", "mjcf", "scene.xml", "mujoco_warp", ("mujoco-warp==3.17.0",)),
            ("dm_control", "mjcf", "scene.xml", "dm_control", ("dm_control", "mujoco<4")),
            ("robosuite", "mjcf", "scene.xml", "robosuite", OURS),
        )
    ),
    Reader(
        title="RoboCasa",
        format="mjcf",
        file="scene.xml",
        program="robocasa",
        packages=("rpent-robocasa365==1.0.1", "imageio", "lxml", "tqdm", "pygame"),
        # It asks for 40 packages; its objects need robosuite.
        dependencies=False,
    ),
    *(
        Reader(title=title, format=format, file=file, program=program, packages=packages)
        for title, format, file, program, packages in (
            ("yourdfpy", "urdf", "manifest.json", "yourdfpy", ("yourdfpy==0.0.60",)),
            ("SAPIEN", "urdf", "manifest.json", "sapien", ("sapien==3.0.3", "setuptools<81")),
            ("check_urdf", "urdf", "manifest.json", "urdfdom", ("cmeel-urdfdom==6.0.0",)),
            ("urdf-usd-converter", "urdf", "manifest.json", "urdf_usd_converter", ("urdf-usd-converter==0.3.4",)),
            ("PyBullet", "urdf", "manifest.json", "pybullet", ("pybullet",)),
            ("Drake, directives", "urdf", "manifest.json", "drake", ("drake",)),
        )
    ),
    Reader(
        title="Pinocchio",
        format="urdf",
        file="manifest.json",
        program="pinocchio",
        packages=("pin==4.1.0",),
        absolute=True,
    ),
    *(
        Reader(title=title, format=format, file=file, program=program, packages=packages)
        for title, format, file, program, packages in (
            ("Drake, SDF", "sdf", "scene.sdf", "drake", ("drake",)),
            ("libsdformat", "sdf", "scene.sdf", "libsdformat", OURS),
            ("mujoco-usd-converter", "mjcf", "scene.xml", "mujoco_usd_converter", ("mujoco-usd-converter==0.8.0",)),
            ("OpenUSD", "usd", "scene.usdc", "openusd", OURS),
            ("Newton", "usd", "scene.usdc", "newton", ("newton",)),
            ("Blender", "usd", "scene.usdc", "blender", ("bpy==5.0.1",)),
            ("Blender, USDZ", "usd", "scene.usdz", "blender", ("bpy==5.0.1",)),
        )
    ),
    Reader(title="PhysX (ovphysx)", format="usd", file="scene.usdc", program="ovphysx", packages=OVPHYSX, alone=True),
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
        pip += [] if reader.dependencies else ["--no-deps"]
        subprocess.run(pip, check=True, capture_output=True, text=True)
        if not reader.dependencies:
            (site,) = (home / "lib").glob("python3.*/site-packages")
            ours = Path(json.__file__).parents[1] if sys.prefix == sys.base_prefix else Path(sys.prefix, "lib")
            packages = next(iter(ours.glob("python3.*/site-packages")), ours / "site-packages")
            (site / "ours.pth").write_text(f"{packages}\n", encoding="utf-8")
        (home / ".made").touch()
    return python


def verdicts(reader: Reader, python: Path, exports: Sequence[Path], scenes: Sequence[Scene]) -> list[str]:
    """For every export the word "pass", or why not."""
    with tempfile.TemporaryDirectory() as folder:
        files = [_file(reader, export, Path(folder) / str(number)) for number, export in enumerate(exports)]
        told = {file: "not written" for file in files if not file.exists()}
        waiting = [file for file in files if file not in told]
        while waiting:
            batch = waiting[:1] if reader.alone else waiting
            found, lost = _run(reader, python, batch)
            told |= {
                file: one["error"][:160] if "error" in one else "; ".join(_wrong(one, scene)) or "pass"
                for file, scene in zip(files, scenes, strict=True)
                if (one := found.get(str(file))) is not None
            }
            left = [file for file in batch if file not in told]
            told |= dict.fromkeys(left[:1], lost)
            waiting = [file for file in waiting if file not in told]
    return [told[file] for file in files]


def _file(reader: Reader, export: Path, copy: Path) -> Path:
    """What the reader is given of an export."""
    folder = export / reader.format
    if reader.absolute and folder.is_dir():
        shutil.copytree(folder, copy)
        set_mesh_paths(copy, "absolute")
        folder = copy
    return folder / reader.file


def _run(reader: Reader, python: Path, files: Sequence[Path]) -> tuple[dict[str, dict], str]:
    """What a process of the reader tells of every file, and why the first one that is missing is."""
    command = [str(python), str(PROGRAM), reader.program, *map(str, files)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False)
        out, error, why = done.stdout, done.stderr, f"ended with exit code {done.returncode}"
    except subprocess.TimeoutExpired as late:
        out, error = (said.decode() if isinstance(said, bytes) else said or "" for said in (late.stdout, late.stderr))
        why = f"no answer within {TIMEOUT:g} s"
    lines = [json.loads(line) for line in out.splitlines() if line.startswith('{"file"')]
    said = [line for line in error.splitlines() if line.strip()]
    return {one["file"]: one for one in lines}, f"{why}: {said[-1][:120]}" if said else why


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
    textures = len({obj.asset.visual.texture.tobytes() for obj in scene.objects})
    if found.get("pictures", textures) < textures:
        yield f"{found['pictures']} pictures for {textures}"


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
        return verdicts(reader, python, exports, scenes)

    chosen = [one for one in READERS if not wanted or wanted & {one.title.lower(), one.program}]
    failures: list[str] = []
    with ThreadPoolExecutor(max(1, given.jobs)) as pool:
        for reader, found in zip(chosen, pool.map(cells, chosen), strict=True):
            bad = [(path.name, cell) for path, cell in zip(exports, found, strict=True) if cell not in FINE]
            failures += [f"{reader.title}, {name}: {cell}" for name, cell in bad]
            print(*failures[len(failures) - len(bad) :], sep="\n", end="\n" if bad else "", file=sys.stderr, flush=True)
            if len(exports) > MOST_COLUMNS:
                found = [f"{found.count('pass')} pass, {len(bad)} fail"]
            print(f"| {reader.title} | {reader.format} |", " | ".join(found), "|", flush=True)
    if len(exports) > MOST_COLUMNS:
        print("\n".join(["", *failures]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
