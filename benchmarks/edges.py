"""Does support end at the true edge of a mesh? Planks laid with their weight just inside and just outside of it.

python benchmarks/edges.py MESH [MESH ...] [--size 0.1]

Every mesh is imported, stood on its base and fixed. The highest level of its surface is its top; towards four sides a
plank is laid on it whose centre of mass is 1, 3 and 5 mm inside and outside of where the top ends. Inside should be
verified and outside refused; printed are how many are, with how far the convex parts reach beyond the top.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.importing import import_mesh
from pat3d.assets.shapes import box
from pat3d.check.certificate import certify
from pat3d.errors import AssetError
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from tests.scenes import GAP, asset_of, placed, scene_of

OFFSETS = (0.001, 0.003, 0.005)
"""[m]"""

LEVEL = 1e-4
"""Surfaces this close to the highest point [m] are the top."""


def top_of(asset: Asset) -> NDArray[np.float64]:
    """Points of the surface at the top [m], shape (n, 2)."""
    vertices = asset.visual.vertices
    return vertices[vertices[:, 2] > vertices[:, 2].max() - LEVEL, :2]


def judged(asset: Asset) -> tuple[int, int, int, float]:
    """Planks inside that are verified, planks outside that are refused, of how many each, and the parts' excess [m]."""
    top = top_of(asset)
    high = float(max(part.bounds[1, 2] for part in asset.parts))
    parts = np.concatenate([part.vertices for part in asset.parts])
    parts = parts[parts[:, 2] > high - LEVEL, :2]
    plank = asset_of(box(0.1, 0.02, 0.006))
    good, refused, count, excess = 0, 0, 0, 0.0
    for turn in range(4):
        angle = np.pi / 2 * turn
        towards = np.array([np.cos(angle), np.sin(angle)])
        edge = float((top @ towards).max())
        excess = max(excess, float((parts @ towards).max()) - edge)
        end = top[top @ towards > edge - LEVEL]
        across = end.mean(axis=0) - edge * towards
        width = float(np.ptp(top @ towards))
        for offset in OFFSETS:
            # Over a narrow ridge the inside of one edge is the outside of the other.
            if offset > width / 2:
                continue
            count += 1
            for sign in (-1.0, 1.0):
                centre = across + (edge + sign * offset) * towards
                pose = Pose.from_yaw(angle, (float(centre[0]), float(centre[1]), high + GAP))
                scene = scene_of(placed("mesh", asset, fixed=True), placed("plank", plank, pose=pose))
                passed = certify(scene, margin=True).passed
                good += passed and sign < 0
                refused += not passed and sign > 0
    return good, refused, count, excess


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--size", type=float, default=0.1, help="longest side of each mesh [m]")
    parser.add_argument("--cache", help="folder of decompositions")
    given = parser.parse_args()
    total = np.zeros(3, dtype=int)
    for path in given.meshes:
        try:
            asset = import_mesh(path, size=given.size, cache_dir=given.cache)
        except AssetError as error:
            print(f"{path.name:20} {error}", flush=True)
            continue
        good, refused, count, excess = judged(asset)
        total += good, refused, count
        print(
            f"{path.name:20} inside {good}/{count}  outside {refused}/{count}  parts reach {1e3 * excess:.1f} mm out",
            flush=True,
        )
    print(f"{'all':20} inside {total[0]}/{total[2]}  outside {total[1]}/{total[2]}")


if __name__ == "__main__":
    main()
