"""Photographs of a real depth camera: do things of known size come back with it?

python -m benchmarks.rgbd FOLDER        # with 000000-color.png, 000000-depth.png and so on

The pictures are the demonstration of PoseCNN-PyTorch (data/demo in NVlabs/PoseCNN-PyTorch; not part of this project):
objects of the YCB set on a table, seen by an Intel RealSense, whose intrinsics its meta.yml says. The sizes of the set
are published; so the measure is the longest side, as found, over the published one. Masks are cut by the depth alone:
what rises from the table by more than RISE and hangs together with a point that is named here. The image path is told
intrinsics, depth, masks and nouns, neither sizes nor what is level.

With the demonstration's own results beside the pictures (000000-color.png.mat and so on), what is found is compared
with the poses that its authors publish: PoseCNN's, refined by them with depth. These are an estimate too, no truth:
what stands on the table leans in them by up to 14 degrees. Their origin is the middle of the object; of boxes the
heading is compared, of which the axes, but not their signs and order, have a meaning.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from pat3d.assets import sources
from pat3d.assets.library.store import scaled
from pat3d.geometry.rotations import yaw_of
from pat3d.vision.camera import Pinhole
from pat3d.vision.files import read_depth, read_picture
from pat3d.vision.gravity import ground_plane
from pat3d.vision.observation import Observation
from pat3d.vision.recover import Recovered, recover

CAMERA = Pinhole(width=640, height=480, fx=618.0173, fy=618.0034, cx=312.37695, cy=232.3753)
RISE = 0.008
"""[m]"""
TOUCHING = 0.01
"""What ends within this [m] of the table stands on it."""
GOAL = 0.12
"""Relative error of the size, as for rendered pictures that were disturbed."""
CLASSES = {
    "coffee can": 1, "cracker box": 2, "sugar box": 3, "tomato soup can": 4, "tuna can": 6, "gelatin box": 8,
    "potted meat can": 9, "bowl": 13, "mug": 14, "wood block": 16, "foam brick": 20,
}  # fmt: skip
"""Of PoseCNN."""
BOXES = ("cracker box", "sugar box", "gelatin box", "potted meat can", "wood block", "foam brick")
FRAMES: dict[str, dict[str, tuple[tuple[int, int], float]]] = {
    "000000": {
        "cracker box": ((447, 187), 0.213),
        "sugar box": ((547, 333), 0.175),
        "foam brick": ((373, 360), 0.077),
        "bowl": ((150, 373), 0.161),
    },
    "000001": {
        "tomato soup can": ((271, 233), 0.102),
        "mug": ((367, 255), 0.117),
        "potted meat can": ((220, 347), 0.102),
        "gelatin box": ((367, 400), 0.085),
    },
    "000002": {"coffee can": ((567, 360), 0.140)},
    "000003": {"wood block": ((227, 307), 0.206), "tuna can": ((460, 367), 0.086)},
}
"""Of every frame the objects: a pixel of each, and its longest side [m] (of the published meshes)."""


def cut(depth: np.ndarray, points: dict[str, tuple[int, int]]) -> np.ndarray:
    """1 + index of the object that a pixel shows, 0 for none."""
    from scipy.ndimage import binary_fill_holes, binary_opening, label

    # The table is the plane of nearly everything; a spot of it has to pass for an object.
    spot = np.zeros(depth.shape, dtype=np.int32)
    spot[-10:, 310:320] = 1
    plane = ground_plane(Observation(camera=CAMERA, depth=depth, instances=spot, names=("spot",)))
    if plane is None:
        raise SystemExit("no table is seen.")
    rows, columns = np.mgrid[: depth.shape[0], : depth.shape[1]]
    slopes = CAMERA.slopes(columns + 0.5, rows + 0.5)
    height = (slopes * depth[..., None]) @ plane.up + plane.height
    pieces, _ = label(binary_opening(np.nan_to_num(height) > RISE, iterations=2))  # type: ignore[misc]
    instances = np.zeros(depth.shape, dtype=np.int32)
    for number, (x, y) in enumerate(points.values(), start=1):
        piece = binary_fill_holes(pieces == pieces[y, x])
        if pieces[y, x] == 0 or (instances[piece] > 0).any():
            raise SystemExit(f"no piece of its own at {x}, {y}.")
        instances[piece] = number
    return instances


def published(path: Path) -> dict[int, tuple[np.ndarray, np.ndarray]]:
    """Rotation, shape (3, 3), and position [m] in camera axes of every object that a file of results has, by class."""
    from scipy.io import loadmat
    from scipy.spatial.transform import Rotation

    if not path.is_file():
        return {}
    data = loadmat(path)
    return {
        int(found[1]): (Rotation.from_quat(pose[:4], scalar_first=True).as_matrix(), pose[4:])
        for found, pose in zip(data["rois"], data["poses_refined"], strict=True)
    }


def apart(found: Recovered, name: str, pose: tuple[np.ndarray, np.ndarray]) -> tuple[float, float]:
    """Distance [m] of the middle of object `name` from its published place, and the angle [deg] between headings."""
    camera, placed = found.camera, found.fits[name].placed
    middle = placed.apply(found.assets[name].visual.bounds.mean(axis=0)[None])[0]
    distance = float(np.linalg.norm((middle - camera.position) @ camera.rotation - pose[1]))
    # Of the published axes that which is most nearly level, seen from above.
    axes = (camera.rotation @ pose[0]).T
    level = axes[np.argmin(np.abs(axes[:, 2]))]
    turn = np.degrees(np.arctan2(level[1], level[0]) - yaw_of(placed.rotation))
    return distance, float(abs((turn + 45.0) % 90.0 - 45.0))


def main() -> int:
    """Measure and print; 1 where a size misses the goal or something does not stand on the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    errors, standing, distances, headings = [], [], [], []
    for frame, objects in FRAMES.items():
        depth = read_depth(folder / f"{frame}-depth.png")
        instances = cut(depth, {name: at for name, (at, _) in objects.items()})
        picture, _ = read_picture(folder / f"{frame}-color.png")
        seen = Observation(camera=CAMERA, depth=depth, instances=instances, names=tuple(objects), picture=picture)
        # Other sizes than the catalogue's, so that these say nothing.
        found = recover(seen, {name: scaled(sources.make(name), 1.4) for name in objects})
        poses = published(folder / f"{frame}-color.png.mat")
        for name, (_, true) in objects.items():
            own = float(found.sized(name).size.max())
            foot = float(found.bodies()[name].low[2])
            errors.append(abs(own / true - 1.0))
            standing.append(all(rel.child != name for rel in found.relations) and abs(foot) < TOUCHING)
            print(
                f"{frame} {name:16} {own:.3f} m, published {true:.3f} ({own / true - 1.0:+.1%}), overlap "
                f"{found.fits[name].overlap:.0%}, foot {1000 * foot:+.1f} mm"
            )
            if CLASSES[name] in poses:
                distance, heading = apart(found, name, poses[CLASSES[name]])
                distances.append(distance)
                headings += [heading] if name in BOXES else []
                told = f", heading {heading:.1f} degrees" if name in BOXES else ""
                print(f"       from the published pose: {1000 * distance:.0f} mm{told}")
    print(
        f"size: median {np.median(errors):.1%}, greatest {max(errors):.1%}, under {GOAL:.0%}: "
        f"{sum(one < GOAL for one in errors)} of {len(errors)}; on the table: {sum(standing)} of {len(standing)}"
    )
    if distances:
        print(
            f"from the published poses: {len(distances)} middles, median {1000 * np.median(distances):.0f} mm, "
            f"greatest {1000 * max(distances):.0f} mm; {len(headings)} headings of boxes, median "
            f"{np.median(headings):.1f} degrees, greatest {max(headings, default=np.nan):.1f}"
        )
    return 0 if max(errors) < GOAL and all(standing) else 1


if __name__ == "__main__":
    sys.exit(main())
