"""Photographs of a real depth camera: do things of known size come back with it?

python -m benchmarks.rgbd FOLDER        # with 000000-color.png, 000000-depth.png and so on

The pictures are the demonstration of PoseCNN-PyTorch (data/demo in NVlabs/PoseCNN-PyTorch; not part of this project):
objects of the YCB set on a table, seen by an Intel RealSense, whose intrinsics its meta.yml says. The sizes of the set
are published; so the measure is the longest side, as found, over the published one. Masks are cut by the depth alone:
what rises from the table by more than RISE and hangs together with a point that is named here. The image path is told
intrinsics, depth, masks and nouns, neither sizes nor what is level. Poses of these pictures are not published.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from pat3d.assets import sources
from pat3d.assets.library.store import scaled
from pat3d.vision.camera import Pinhole
from pat3d.vision.files import read_depth, read_picture
from pat3d.vision.gravity import ground_plane
from pat3d.vision.observation import Observation
from pat3d.vision.recover import recover

CAMERA = Pinhole(width=640, height=480, fx=618.0173, fy=618.0034, cx=312.37695, cy=232.3753)
RISE = 0.008
"""[m]"""
TOUCHING = 0.01
"""What ends within this [m] of the table stands on it."""
GOAL = 0.12
"""Relative error of the size, as for rendered pictures that were disturbed."""
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


def main() -> int:
    """Measure and print; 1 where a size misses the goal or something does not stand on the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args().folder
    errors, standing = [], []
    for frame, objects in FRAMES.items():
        depth = read_depth(folder / f"{frame}-depth.png")
        instances = cut(depth, {name: at for name, (at, _) in objects.items()})
        picture, _ = read_picture(folder / f"{frame}-color.png")
        seen = Observation(camera=CAMERA, depth=depth, instances=instances, names=tuple(objects), picture=picture)
        # Other sizes than the catalogue's, so that these say nothing.
        found = recover(seen, {name: scaled(sources.make(name), 1.4) for name in objects})
        for name, (_, true) in objects.items():
            own = float(found.sized(name).size.max())
            foot = float(found.bodies()[name].low[2])
            errors.append(abs(own / true - 1.0))
            standing.append(all(rel.child != name for rel in found.relations) and abs(foot) < TOUCHING)
            print(
                f"{frame} {name:16} {own:.3f} m, published {true:.3f} ({own / true - 1.0:+.1%}), overlap "
                f"{found.fits[name].overlap:.0%}, foot {1000 * foot:+.1f} mm"
            )
    print(
        f"size: median {np.median(errors):.1%}, greatest {max(errors):.1%}, under {GOAL:.0%}: "
        f"{sum(one < GOAL for one in errors)} of {len(errors)}; on the table: {sum(standing)} of {len(standing)}"
    )
    return 0 if max(errors) < GOAL and all(standing) else 1


if __name__ == "__main__":
    sys.exit(main())
