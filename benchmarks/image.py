"""Is a scene found again in its own picture? Known scenes, drawn from random cameras, go through the image path.

python -m benchmarks.image --views 50                      # true depth and masks: what comes back, by object
python -m benchmarks.image --views 50 --disturbed          # 5 % noise of the depth, eroded masks, 20 % occlusion
python -m benchmarks.image --views 50 --verified 10          # and ten recovered scenes settled and verified in MuJoCo

The scenes are made once from PROMPTS into --scenes. The assets are the true ones, each larger or smaller by a factor
that the image path is not told; neither is it told where the camera stands, what stands on what, or how high the
tables are. It is told the picture's intrinsics, depth and masks, and which asset each mask shows.

Recovered and true scene are laid over one another by the camera's place and heading alone: errors of gravity and of
the ground's height count. A yaw counts where the picture decides it: turns after which the camera would see the same
(at most SAME of the object's pixels differ) are as right as the true one, and where all are, there is none. Of
disturbed pictures, "told" counts the yaws that the noise leaves decided.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.library.store import scaled
from pat3d.geometry.rotations import yaw_matrix, yaw_of
from pat3d.progress import silent
from pat3d.scene.asset import Asset
from pat3d.scene.io import load_scene
from pat3d.scene.model import GROUND, Scene, SceneObject
from pat3d.view.camera import frame
from pat3d.view.preview import scene_items
from pat3d.vision.camera import Pinhole, PlacedCamera
from pat3d.vision.caster import Caster, Placement
from pat3d.vision.drawing import draw
from pat3d.vision.observation import LEAST_PIXELS, Observation
from pat3d.vision.recover import Recovered, recover
from pat3d.vision.window import CAP

PROMPTS = (
    "a red mug and a stapler on a wooden table",
    "a bowl with two apples next to a stack of three books on a table",
    "a laptop, a computer mouse and a glass on a desk",
    "a cube on a cube on a cube",
    "a toy car next to a shoe box and a teapot on the box",
    "a plate with a banana, a mug and a fork on a table",
    "a basket with three oranges on the floor",
    "a chair next to a table and a lamp on the table",
    "a cardboard box with a rubber duck on it and a toaster beside the box",
    "a cup with two pens, a book and an alarm clock on a desk",
)
WIDTH, HEIGHT = 640, 480
LEAST_SEEN = 130
"""Pixels of every object that a camera has to show."""
TOLD = 6.0
"""Log likelihood ratio from which on a disturbed picture tells two turns apart: one is 400 times as likely."""
SAME = 0.04
"""Of an object's pixels; fewer that differ, in silhouette or by 2 % of its size in depth, do not decide a turn."""
UPRIGHT = math.cos(math.radians(10.0))
"""Objects that lie otherwise have no yaw that is counted."""


@dataclass
class Disturbance:
    """What is done to true depth and masks."""

    noise: float = 0.0
    """Standard deviation of the depth's error over the depth, independent in every pixel."""
    eroded: int = 0
    """Pixels that every mask loses along its border."""
    occluded: float = 0.0
    """Share of every mask that something nearer hides, from one side."""


@dataclass
class Tally:
    """What was measured, a value for every object."""

    centre: list[float] = field(default_factory=list)
    """Errors of the middle of the bounding box over the scene's diagonal."""
    scale: list[float] = field(default_factory=list)
    """Relative errors."""
    yaw: list[float] = field(default_factory=list)
    """Errors [deg], where the undisturbed picture decides it."""
    told: list[float] = field(default_factory=list)
    """Errors [deg], where the picture as it was given, noise and all, decides it."""
    supports: list[bool] = field(default_factory=list)
    gravity: list[float] = field(default_factory=list)
    """Errors [deg], a value for every view."""
    worst: list[dict[str, Any]] = field(default_factory=list)
    verified: list[bool] = field(default_factory=list)


def random_camera(scene: Scene, rng: np.random.Generator) -> PlacedCamera:
    """A camera from any side, 20 to 60 degrees above the horizon, that shows all of the scene, rolled a little."""
    points = np.concatenate([obj.pose.apply(obj.asset.visual.vertices) for obj in scene.objects])
    angle = rng.uniform(35.0, 60.0)
    looking = frame(
        points,
        aspect=WIDTH / HEIGHT,
        azimuth=rng.uniform(0.0, 360.0),
        elevation=rng.uniform(20.0, 60.0),
        field_of_view=angle,
        margin=rng.uniform(0.03, 0.12),
    )
    focal = HEIGHT / (2.0 * math.tan(math.radians(angle) / 2.0))
    pinhole = Pinhole(width=WIDTH, height=HEIGHT, fx=focal, fy=focal, cx=WIDTH / 2, cy=HEIGHT / 2)
    rotation = looking.axes.T * np.array([1.0, -1.0, 1.0])
    roll = math.radians(rng.uniform(-5.0, 5.0))
    turned = rotation @ yaw_matrix(roll)
    return PlacedCamera(pinhole=pinhole, rotation=turned, position=np.array(looking.position))


def disturbed(
    depth: np.ndarray, instances: np.ndarray, how: Disturbance, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Depth and masks as a worse sensor would have them, and the depth before its noise."""
    from scipy.ndimage import binary_erosion

    depth, instances = depth.copy(), instances.copy()
    for number in range(1, int(instances.max()) + 1) if how.occluded else ():
        rows, columns = np.nonzero(instances == number)
        way = rng.normal(size=2)
        along = rows * way[0] + columns * way[1]
        hidden = along > np.quantile(along, 1.0 - how.occluded)
        instances[rows[hidden], columns[hidden]] = 0
        depth[rows[hidden], columns[hidden]] = 0.7 * float(np.nanmin(depth))
    if how.eroded:
        kept = np.zeros_like(instances, dtype=bool)
        for number in range(1, int(instances.max()) + 1):
            kept |= binary_erosion(instances == number, iterations=how.eroded)
        instances[~kept] = 0
    clean = depth.copy()
    if how.noise:
        depth *= (1.0 + how.noise * rng.normal(size=depth.shape)).astype(np.float32)
    return depth, instances, clean


def see(
    scene: Scene, rng: np.random.Generator, how: Disturbance
) -> tuple[Observation, np.ndarray, PlacedCamera, dict[str, Asset], dict[str, float]]:
    """A view of `scene` in which every object can be seen.

    Returns:
        The observation, its depth before the noise, the camera, the assets at other sizes, and the factors of these.
    """
    for _ in range(2000):
        camera = random_camera(scene, rng)
        # A small picture tells soon whether a large one is worth drawing.
        small = replace(camera, pinhole=camera.pinhole.resized(WIDTH // 4, HEIGHT // 4))
        counts = np.bincount(draw(scene_items(scene), small)[1].ravel(), minlength=len(scene.objects) + 1)[1:]
        if counts.min() < LEAST_SEEN / 16:
            continue
        depth, instances = draw(scene_items(scene), camera)
        counts = np.bincount(instances.ravel(), minlength=len(scene.objects) + 1)[1:]
        if counts.min() < LEAST_SEEN:
            continue
        depth, instances, clean = disturbed(depth, instances, how, rng)
        if np.bincount(instances.ravel(), minlength=len(scene.objects) + 1)[1:].min() >= LEAST_PIXELS:
            break
    else:
        raise SystemExit(f"no camera shows all of: {scene.prompt}")
    factors = {obj.name: float(math.exp(rng.uniform(-0.4, 0.4))) for obj in scene.objects}
    assets = {obj.name: scaled(obj.asset, factors[obj.name]) for obj in scene.objects}
    seen = Observation(
        camera=camera.pinhole, depth=depth, instances=instances, names=tuple(obj.name for obj in scene.objects)
    )
    return seen, clean, camera, assets, factors


def equivalent_turns(
    obj: SceneObject, camera: PlacedCamera, seen: Observation, clean: np.ndarray, found: Placement, how: Disturbance
) -> list[float] | None:
    """Turns about the vertical [rad] after which the camera sees the same of `obj`; None where any will do.

    With noise in `how`, turns are the same too that the depth of all pixels tells apart by less than TOLD, differences
    of the outline counting only where they are wider than what erosion takes.

    `clean` is the depth without noise, of what hides parts of the object too. The turn of `found` is among them where
    that placement itself looks the same: a mug whose handle is hidden turns about its own axis, not its box's.
    """
    from scipy.ndimage import binary_erosion

    caster = Caster(obj.asset.visual)
    rows, columns = np.nonzero(seen.mask(obj.name))
    low, high = np.array([rows.min(), columns.min()]), np.array([rows.max(), columns.max()]) + 1
    margin = (0.3 * (high - low)).astype(int) + 4
    low, high = np.maximum(low - margin, 0), np.minimum(high + margin, (HEIGHT, WIDTH))
    stride = max(1, round(math.sqrt(float(np.prod(high - low)) / 3000)))
    grid = np.mgrid[low[0] : high[0] : stride, low[1] : high[1] : stride]
    row, column = grid.reshape(2, -1)
    rays, reach = camera.rays(column + 0.5, row + 0.5)
    others = ~seen.mask(obj.name)[row, column]
    nearest = np.nan_to_num(clean[row, column] * reach, nan=np.inf)
    middle = obj.pose.apply(caster.centre[None])[0]

    def turned(turn: float) -> Placement:
        rotation = yaw_matrix(turn) @ obj.pose.rotation
        return Placement(scale=1.0, rotation=rotation, position=middle - rotation @ caster.centre)

    def drawn(placed: Placement) -> np.ndarray:
        ranges = caster.ranges(camera.position, rays, placed)
        # Something nearer hides what is there, whether it is turned or not.
        return np.where(others & (ranges > 1.003 * nearest), np.inf, ranges)

    def far(one: np.ndarray, other: np.ndarray) -> float:
        hit = np.isfinite(one) & np.isfinite(other)
        alone = np.isfinite(one) ^ np.isfinite(other)
        apart = np.abs(np.where(hit, one, 0.0) - np.where(hit, other, 0.0)) > 0.04 * caster.radius
        return float(np.count_nonzero(alone | apart)) / max(np.count_nonzero(np.isfinite(one)), 1)

    def likelihood(one: np.ndarray, other: np.ndarray) -> float:
        """Log likelihood ratio to be expected [-] of two drawings, where one of them is the truth."""
        if not how.noise:
            return math.inf
        hit = np.isfinite(one) & np.isfinite(other) & ~others
        apart = np.where(hit, one, 0.0) - np.where(hit, other, 0.0)
        depth = np.minimum(0.5 * (apart / (how.noise * np.where(hit, one, 1.0))) ** 2, CAP)
        alone = (np.isfinite(one) ^ np.isfinite(other)).reshape(grid.shape[1:])
        wide = binary_erosion(alone, iterations=how.eroded) if how.eroded and stride == 1 else alone
        return float(depth.sum() + CAP * np.count_nonzero(wide)) * stride**2

    true = drawn(turned(0.0))
    turns = np.radians(np.arange(0.0, 360.0, 5.0))
    views = {float(turn): drawn(turned(turn)) for turn in turns}
    same = [turn for turn, view in views.items() if far(true, view) <= SAME or likelihood(true, view) < TOLD]
    if len(same) >= 0.8 * len(turns):
        return None
    if far(true, drawn(found)) <= SAME / 4 or likelihood(true, drawn(found)) < TOLD:
        same.append(yaw_of(found.rotation) - yaw_of(obj.pose.rotation))
    return same


def compare(
    scene: Scene,
    seen: Observation,
    clean: np.ndarray,
    camera: PlacedCamera,
    found: Recovered,
    factors: dict[str, float],
    how: Disturbance,
    tally: Tally,
) -> None:
    """Add the errors of `found` to `tally`."""
    own, true = found.camera, camera
    heading = [math.atan2(one.rotation[1, 2], one.rotation[0, 2]) for one in (own, true)]
    turn = heading[1] - heading[0]
    back = yaw_matrix(turn)
    shift = true.position - back @ own.position
    shift[2] = 0.0
    up = own.rotation.T @ [0.0, 0.0, 1.0], true.rotation.T @ [0.0, 0.0, 1.0]
    tally.gravity.append(math.degrees(math.acos(min(1.0, float(up[0] @ up[1])))))
    points = [obj.pose.apply(obj.asset.visual.vertices) for obj in scene.objects]
    every = np.concatenate(points)
    diagonal = float(np.linalg.norm(every.max(axis=0) - every.min(axis=0)))
    for obj, truth in zip(scene.objects, points, strict=True):
        placed, asset = found.fits[obj.name].placed, found.assets[obj.name]
        here = placed.apply(asset.visual.vertices) @ back.T + shift
        middles = [(one.min(axis=0) + one.max(axis=0)) / 2 for one in (here, truth)]
        centre = float(np.linalg.norm(middles[0] - middles[1])) / diagonal
        scale = abs(placed.scale * factors[obj.name] - 1.0)
        yaw = math.nan
        if obj.pose.rotation[2, 2] > UPRIGHT and not found.fits[obj.name].tilted:
            there = Placement(
                scale=placed.scale * factors[obj.name],
                rotation=back @ placed.rotation,
                position=back @ placed.position + shift,
            )
            off = yaw_of(placed.rotation) + turn - yaw_of(obj.pose.rotation)
            for disturbance, errors in ((how, tally.told), (Disturbance(), tally.yaw)):
                same = equivalent_turns(obj, camera, seen, clean, there, disturbance)
                if same is not None:
                    yaw = math.degrees(min(abs(math.remainder(off - each, 2 * math.pi)) for each in same))
                    errors.append(yaw)
        kinds = [{(rel.kind, rel.parent) for rel in relations if rel.child == obj.name and rel.supports
                  and rel.parent != GROUND} for relations in (scene.relations, found.relations)]  # fmt: skip
        right = kinds[0] == kinds[1]
        tally.supports.append(right)
        tally.centre.append(centre)
        tally.scale.append(scale)
        tally.worst.append(
            {"view": len(tally.gravity) - 1, "scene": scene.prompt, "object": obj.name, "centre": centre,
             "scale": scale, "yaw": yaw, "supports": right, "found": sorted(kinds[1]), "true": sorted(kinds[0]),
             "cost": found.fits[obj.name].cost, "overlap": found.fits[obj.name].overlap,
             "pixels": int(seen.mask(obj.name).sum()), "tilted": found.fits[obj.name].tilted}
        )  # fmt: skip


def prove(found: Recovered, folder: Path) -> tuple[bool, tuple[str, ...]]:
    """Whether the recovered scene settles into one that is verified, MuJoCo among the checks."""
    from pat3d.generation.from_image import request_of_recovered
    from pat3d.generation.pipeline import make
    from pat3d.generation.settings import Settings
    from pat3d.progress import Clock

    request = request_of_recovered(found, prompt="")
    settings = Settings(formats=("mjcf",))
    outcome = make(request, folder=folder, settings=settings, clock=Clock(), progress=silent)
    return outcome.report.passed, outcome.report.failures


def told(name: str, values: list[float], goal: float, unit: str) -> str:
    """A line: mean, median, 95th percentile, greatest, and how many meet the goal."""
    if not values:
        return f"{name:8} none"
    array = np.array(values)
    within = int(np.count_nonzero(array < goal))
    return (
        f"{name:8} mean {array.mean():6.2f}{unit}  median {np.median(array):6.2f}{unit}  "
        f"95 % {np.quantile(array, 0.95):6.2f}{unit}  greatest {array.max():6.2f}{unit}  "
        f"under {goal:g}{unit}: {within} of {len(array)}"
    )


def scenes_of(folder: Path) -> list[Scene]:
    """The scenes in `folder`, made there where they are missing."""
    from pat3d.generation.many import generate_many
    from pat3d.generation.settings import Settings

    for row in generate_many(list(PROMPTS), folder, settings=Settings(formats=("mjcf",))):
        print(f"{row.folder}: {row.state}", file=sys.stderr, flush=True)
    return [load_scene(one.parent) for one in sorted(folder.glob("*/scene.json")) if ".partial" not in str(one)]


def main() -> int:
    """Measure and print; 1 where a goal is missed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--views", type=int, default=50)
    parser.add_argument("--scenes", type=Path, default=Path("image-scenes"), help="folder of the true scenes")
    parser.add_argument("--seed", type=int, default=20261122)
    parser.add_argument("--disturbed", action="store_true")
    parser.add_argument("--verified", type=int, default=0, metavar="N", help="settle and verify the first N views too")
    parser.add_argument("--seconds", type=float, default=math.inf, help="stop after this time, with fewer views")
    parser.add_argument("--report", type=Path, help="write every object's errors here, as JSON")
    options = parser.parse_args()
    how = Disturbance(noise=0.05, eroded=1, occluded=0.2) if options.disturbed else Disturbance()
    goals = (5.0, 12.0, 20.0) if options.disturbed else (2.0, 5.0, 10.0)
    scenes, tally, begin, started = scenes_of(options.scenes), Tally(), time.process_time(), time.monotonic()
    for number in range(options.views):
        rng = np.random.default_rng([options.seed, number])
        scene = scenes[number % len(scenes)]
        seen, clean, camera, assets, factors = see(scene, rng, how)
        found = recover(seen, assets)
        compare(scene, seen, clean, camera, found, factors, how, tally)
        if number < options.verified:
            with tempfile.TemporaryDirectory() as place:
                passed, failures = prove(found, Path(place) / "scene")
            tally.verified.append(passed)
            for line in failures:
                print(f"view {number}, {scene.prompt}: {line}", file=sys.stderr, flush=True)
        print(f"view {number}: {scene.prompt}", file=sys.stderr, flush=True)
        if options.report:
            options.report.write_text(json.dumps(tally.worst, indent=1))
        if time.monotonic() - started > options.seconds:
            break
    seconds = time.process_time() - begin
    print(
        f"{len(tally.gravity)} views of {len(scenes)} scenes, {len(tally.centre)} objects, {how}, {seconds:.0f} s CPU"
    )
    print(told("centre", [100 * one for one in tally.centre], goals[0], " %"))
    print(told("scale", [100 * one for one in tally.scale], goals[1], " %"))
    print(told("yaw", tally.yaw, goals[2], " deg"))
    if how.noise:
        print(told("told", tally.told, goals[2], " deg"))
    print(told("gravity", tally.gravity, 2.0, " deg"))
    print(f"support  {sum(tally.supports)} of {len(tally.supports)}")
    if tally.verified:
        print(f"verified {sum(tally.verified)} of {len(tally.verified)}")
    met = max(tally.centre) < goals[0] / 100 and max(tally.scale) < goals[1] / 100
    met = met and max(tally.yaw, default=0.0) < goals[2]
    share = 0.95 if options.disturbed else 1.0
    return 0 if met and np.mean(tally.supports) >= share and all(tally.verified) else 1


if __name__ == "__main__":
    sys.exit(main())
