"""Is the tilt margin of a certificate what a scene stands? Gravity leans slowly in MuJoCo until something goes.

python -m benchmarks.tilt forms [NAME ...]      closed forms: boxes, pencil, overhang, domino, balls
python -m benchmarks.tilt scenes FOLDER [...]   scene folders, as `pat3d generate` writes them
python -m benchmarks.tilt random --count 100 --jobs 16 --work work/tilt
                                                catalogue objects on a table and on one another, made first
python -m benchmarks.tilt forms --engines mujoco,newton,drake

A row for each: the tilt that the certificate claims (whichever way), the least of what was stood towards eight sides,
their ratio, and where a form has one the closed form of the ideal shapes. A scene goes when an object's centre has
strayed 5 mm or it has turned 4 degrees. With --engines a row for each engine instead: gravity goes around every two
seconds and leans more and more, up to 1.5 claims. What a verified scene stands should be 0.9 to 1.2 of its claim. Exit
code 1 where one stands less than 0.9 of it. Random scenes and their rows that are in --work are not made again.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from benchmarks.transfer import failures, make, random_spec
from pat3d.assets.shapes import box, cylinder, ellipsoid
from pat3d.check.certificate import MAX_TILT, certify
from pat3d.check.engines.protocol import Engine, EngineRun
from pat3d.check.engines.registry import chosen
from pat3d.errors import CheckError
from pat3d.exporters.common.objects import body_names
from pat3d.exporters.formats import export
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Material
from pat3d.scene.io import load_scene
from pat3d.scene.model import Scene
from pat3d.scene.physics import GRAVITY
from pat3d.scene.replacement import write_text
from tests.scenes import GAP, asset_of, placed, scene_of, tower

SIDES = 8
SECONDS = 12.0
"""In which gravity leans by the claim [s]."""
FURTHEST = 1.6
"""Tilt at which a run ends, in claims."""
MM, DEGREES = 5.0, 4.0
FURTHER = 1.5
"""Tilt at which a run in another engine ends, in claims."""
SPIRAL = 20.0
"""In which gravity leans by that and goes around ten times [s]."""
SHARES = (0.9, 1.2)
"""Of a claim, that a scene should stand and should not."""
TOO_MUCH = "TOO MUCH"


def pencil() -> tuple[Scene, float | None]:
    """A rod of 7 mm on its end, 175 mm high."""
    return scene_of(placed("pencil", asset_of(cylinder(0.0035, 0.175)), (0, 0, GAP))), math.atan(0.0035 / 0.0875)


def one_box() -> tuple[Scene, float | None]:
    """A box of a ready meal on its narrow side, turned by 0.2 rad."""
    one = asset_of(box(0.04, 0.16, 0.4))
    return scene_of(placed("box", one, pose=Pose.from_yaw(0.2, (0, 0, GAP)))), math.atan(0.04 / 0.4)


def boxes() -> tuple[Scene, float | None]:
    """Five boxes on one another."""
    return tower(5, (0.04, 0.05, 0.1)), math.atan(0.04 / (5 * 0.1))


def overhang(factor: float = 0.95) -> tuple[Scene, float | None]:
    """Five bricks at 95 % of the harmonic overhang."""
    length, height, count = 0.2, 0.05, 5
    asset = asset_of(box(length, 0.1, height))
    x, objects = 0.0, []
    for level in range(count):
        objects.append(placed(f"brick {level}", asset, (x, 0, GAP + level * (height + GAP))))
        x += factor * length / (2 * (count - 1 - level)) if level < count - 1 else 0.0
    # Of all upper piles the one with least to spare over its height.
    return scene_of(*objects), min(math.atan((1 - factor) * length / 2 / (k * height / 2)) for k in range(1, count))


def domino(degrees: float = 55.0) -> tuple[Scene, float | None]:
    """A plank that leans on a fixed wall."""
    length, thickness = 0.2, 0.02
    angle = math.radians(degrees)
    turn = Rotation.from_euler("y", -degrees, degrees=True)
    plank = asset_of(box(length, 0.1, thickness).moved(x=length / 2))
    reach = length * math.cos(angle)
    return scene_of(
        placed("plank", plank, pose=Pose.from_matrix(turn.as_matrix(), np.array([0.0, 0.0, GAP]))),
        placed("wall", asset_of(box(0.1, 1, 1)), (reach + GAP + 0.05, 0, 0), fixed=True),
        settling_friction=0.4,
    ), None


def slab() -> tuple[Scene, float | None]:
    """A flat slab that slides before it tips, at friction 0.1."""
    slick = asset_of(box(0.2, 0.2, 0.01), material=Material(name="slick", density=900.0, friction=0.1))
    plate = asset_of(box(0.4, 0.4, 0.02), material=Material(name="slick", density=900.0, friction=0.1))
    return scene_of(
        placed("plate", plate, (0, 0, 0), fixed=True), placed("slab", slick, (0, 0, 0.02 + GAP))
    ), math.atan(0.1)


def balls() -> tuple[Scene, float | None]:
    """A ball on a facet of another; the smooth ones fall."""
    ball = asset_of(ellipsoid(0.03))
    hull = ConvexHull(ball.parts[0].vertices)
    normal = hull.equations[0, :3]
    turn = Rotation.align_vectors([[0, 0, 1]], [normal])[0]
    depth = -hull.equations[0, 3]
    other = Rotation.align_vectors([[0, 0, -1]], [normal])[0]
    return scene_of(
        placed("low", ball, pose=Pose.from_matrix(turn.as_matrix(), np.array([0, 0, depth])), fixed=True),
        placed("high", ball, pose=Pose.from_matrix(other.as_matrix(), np.array([0, 0, 3 * depth + GAP]))),
    ), 0.0


def tip(width: float = 0.002) -> tuple[Scene, float | None]:
    """A block of 6 cm on a fixed post as wide as this [m]."""
    return scene_of(
        placed("tip", asset_of(box(width, width, 0.05)), (0, 0, GAP), fixed=True),
        placed("block", asset_of(box(0.06, 0.06, 0.06)), (0, 0, 0.05 + 2 * GAP)),
    ), math.atan(width / 2 / 0.03)


FORMS: dict[str, Callable[[], tuple[Scene, float | None]]] = {
    "box": one_box,
    "boxes": boxes,
    "pencil": pencil,
    "slab": slab,
    "overhang 0.90": lambda: overhang(0.90),
    "overhang 0.95": lambda: overhang(0.95),
    "overhang 0.98": lambda: overhang(0.98),
    "overhang 0.99": lambda: overhang(0.99),
    "overhang 0.995": lambda: overhang(0.995),
    "domino 45": lambda: domino(45.0),
    "domino 52": lambda: domino(52.0),
    "domino 60": lambda: domino(60.0),
    "ball on ball": balls,
    "tip 0.7 mm": lambda: tip(0.0007),
    "tip 2 mm": lambda: tip(0.002),
}


def survived(mjcf: Path, claim: float, *, seconds: float = SECONDS) -> tuple[float, str]:
    """Least tilt [degrees] towards any side at which something goes, at most FURTHEST claims, and what went."""
    mujoco: Any = import_module("mujoco")
    model = mujoco.MjModel.from_xml_path(str(mjcf))
    free = model.jnt_bodyid[np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)]
    least, first = FURTHEST * claim, ""
    for side in range(SIDES):
        angle = 2 * math.pi * (side + 0.5) / SIDES
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        centre, quat = data.xipos[free].copy(), data.xquat[free].copy()
        model.opt.gravity[:] = (0, 0, -GRAVITY)
        mujoco.mj_step(model, data, nstep=100)
        rate = claim / seconds
        tilt = 0.0
        while tilt < least:
            tilt += rate * 10 * model.opt.timestep
            lean = math.radians(tilt)
            model.opt.gravity[:] = GRAVITY * np.array(
                [math.sin(lean) * math.cos(angle), math.sin(lean) * math.sin(angle), -math.cos(lean)]
            )
            mujoco.mj_step(model, data, nstep=10)
            moved = 1e3 * np.linalg.norm(data.xipos[free] - centre, axis=1)
            turned = 2 * np.degrees(np.arccos(np.clip(np.abs(np.einsum("ni,ni->n", data.xquat[free], quat)), 0.0, 1.0)))
            gone = np.maximum(moved / MM, turned / DEGREES)
            if gone.max() > 1.0:
                least, first = tilt, model.body(int(free[np.argmax(gone)])).name
                break
    return least, first


def row(name: str, scene: Scene, ideal: float | None, seconds: float) -> str:
    """One line of the table."""
    certificate = certify(scene, margin=True)
    claim = certificate.largest_tilt or 0.0
    if claim < 0.05:
        return f"{name:24} claims {claim:5.2f}  refused"
    with tempfile.TemporaryDirectory() as folder:
        found, first = survived(write_mjcf(scene, Path(folder) / "mjcf"), claim, seconds=seconds)
    capped = " (at least)" if claim >= MAX_TILT * 0.999 else ""
    form = "" if ideal is None else f"  form {math.degrees(ideal):5.2f}"
    verdict = "  refused" if not certificate.passed else "" if found >= SHARES[0] * claim else f"  {TOO_MUCH}"
    stands = f"stands {found:5.2f} ({first})  ratio {found / claim:4.2f}"
    return f"{name:24} claims {claim:5.2f}{capped}  {stands}{form}{verdict}"


def strays(scene: Scene, run: EngineRun) -> NDArray[np.float64]:
    """How far objects are from where they were at the start, 1 where they are gone, shape (records,)."""
    slugs = {slug: scene[name] for name, slug in body_names(scene).items()}
    worst = np.zeros(len(run.times))
    for column, name in enumerate(run.names):
        obj = slugs[name.removeprefix("_")] if name.removeprefix("_") in slugs else scene[name]
        turns = Rotation.from_quat(run.poses[:, column, 3:], scalar_first=True)
        centres = run.poses[:, column, :3] + turns.apply(obj.asset.mass_properties.centre_of_mass)
        moved = 1e3 * np.linalg.norm(centres - centres[0], axis=1)
        turned = np.degrees((turns[0].inv() * turns).magnitude())
        worst = np.maximum(worst, np.maximum(moved / MM, turned / DEGREES))
    return worst


def rows(name: str, scene: Scene, engines: tuple[Engine, ...], seconds: float) -> str:
    """A line for each engine."""
    certificate = certify(scene, margin=True)
    claim = certificate.largest_tilt or 0.0
    lines = [f"{name:24} claims {claim:5.2f}  {'passed' if certificate.passed else 'refused'}"]
    if claim < 0.05:
        return lines[0]
    with tempfile.TemporaryDirectory() as folder:
        export(scene, sorted({engine.format for engine in engines}), folder)
        for engine in engines:
            try:
                run = engine.run(Path(folder) / engine.format, seconds, timeout=900.0, lean=FURTHER * claim)
            except CheckError as error:
                lines.append(f"    {engine.title:22} {error}")
                continue
            gone = np.flatnonzero(strays(scene, run) > 1.0)
            stood = float(run.leans[gone[0]] if len(gone) else run.leans[-1])
            ratio = stood / claim
            less = f"  {TOO_MUCH}" if certificate.passed else "  less"
            words = "" if SHARES[0] <= ratio <= SHARES[1] else less if ratio < SHARES[0] else "  more"
            lines.append(f"    {engine.title:22} stands {stood:5.2f}  ratio {ratio:4.2f}{words}")
    return "\n".join(lines)


def made(seed: int, work: Path) -> Path | None:
    """The folder of a random scene, built where it is not there; None where it cannot be."""
    name = f"random {seed:03d}"
    spec, folder = work / f"{name.replace(' ', '_')}.yaml", work / "scenes" / name.replace(" ", "_")
    folder.parent.mkdir(parents=True, exist_ok=True)
    if not spec.is_file():
        spec.write_text(yaml.safe_dump(random_spec(seed)), encoding="utf-8")
    return folder if make(["build", str(spec)], folder, spec.with_suffix(".log")) else None


def measure(which: str, given: argparse.Namespace) -> str:
    """The lines of one form, folder or seed."""
    name, ideal = which, None
    record = given.work / "rows" / f"{which}-{'_'.join((given.engines or 'mujoco').split(','))}.txt"
    if given.what == "random":
        if record.is_file():
            return record.read_text(encoding="utf-8")
        name, folder = f"random {int(which):03d}", made(int(which), given.work)
        if folder is None or (reasons := failures(folder)):
            return f"{name:24} not made" if folder is None else f"{name:24} not verified: {reasons[0]}"
        scene = load_scene(folder)
    elif given.what == "scenes":
        name, scene = Path(which).name, load_scene(which)
    else:
        scene, ideal = FORMS[which]()
    if given.engines:
        text = rows(name, scene, chosen([given.engines]), given.spiral)
    else:
        text = row(name, scene, ideal, given.seconds)
    if given.what == "random":
        record.parent.mkdir(parents=True, exist_ok=True)
        write_text(record, text)
    return text


def main() -> int:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("forms", "scenes", "random"))
    parser.add_argument("which", nargs="*", help="forms or folders")
    parser.add_argument("--seconds", type=float, default=SECONDS, help="to lean by the claim [s]")
    parser.add_argument("--engines", help="run these instead, as in: pat3d check --engines")
    parser.add_argument("--spiral", type=float, default=SPIRAL, help="in which gravity goes around there [s]")
    parser.add_argument("--count", type=int, default=20, help="random scenes")
    parser.add_argument("--first", type=int, default=0, help="seed of the first of them")
    parser.add_argument("--jobs", type=int, default=1, help="scenes at a time")
    parser.add_argument("--work", type=Path, default=Path("work/tilt"), help="random scenes and what they stood")
    given = parser.parse_args()
    given.work = given.work.resolve()
    which = given.which or list(FORMS)
    if given.what == "random":
        which = [str(seed) for seed in range(given.first, given.first + given.count)]
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    found = []
    with ProcessPoolExecutor(given.jobs, mp_context=get_context("spawn")) as pool:
        for text in pool.map(partial(measure, given=given), which):
            found.append(text)
            print(text, flush=True)
    strong = sum(TOO_MUCH in text for text in found)
    print(f"{len(found)} scenes, {sum('stands' in text for text in found)} tilted, {strong} claim too much")
    return 1 if strong else 0


if __name__ == "__main__":
    sys.exit(main())
