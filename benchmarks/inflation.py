"""How far do the convex parts of the catalogue reach beyond what is seen? Every noun, or those named.

python -m benchmarks.inflation [NOUN ...]

For each noun the corner of a part that is furthest outside of the picture, and how many of its parts reach further than
those of an imported mesh may (a millimetre, and a hundredth of the size), those that reach furthest first.
"""

from __future__ import annotations

import argparse

import numpy as np
import trimesh
from numpy.typing import NDArray

from pat3d.assets.catalogue.lookup import entries, make
from pat3d.assets.mesh.split import allowed
from pat3d.scene.asset import Asset

NEAR = 5e-4
"""Corners this close to the surface [m] are not asked whether they are outside."""

CHUNK = 64


def outside(vertices: NDArray[np.float64], faces: NDArray[np.int32], points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which points a closed mesh does not wind around (Van Oosterom and Strackee 1983, Eq. 8)."""
    triangles, found = vertices[faces], np.zeros(len(points))
    for start in range(0, len(points), CHUNK):
        a, b, c = (triangles[None, :, k] - points[start : start + CHUNK, None] for k in range(3))
        la, lb, lc = (np.linalg.norm(side, axis=2) for side in (a, b, c))
        ab, bc, ca = (np.einsum("nfi,nfi->nf", u, v) for u, v in ((a, b), (b, c), (c, a)))
        volume = np.einsum("nfi,nfi->nf", a, np.cross(b, c))
        angle = 2 * np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb)
        found[start : start + CHUNK] = angle.sum(axis=1) / (4 * np.pi)
    return found < 0.5


def reaches(asset: Asset) -> NDArray[np.float64]:
    """How far each part's corners are outside of the picture at most [m], shape (parts,); 0 below NEAR."""
    vertices, faces = asset.visual.vertices, asset.visual.faces
    points = np.concatenate([part.vertices for part in asset.parts])
    owner = np.repeat(np.arange(len(asset.parts)), [len(part.vertices) for part in asset.parts])
    _, distance, _ = trimesh.proximity.closest_point(trimesh.Trimesh(vertices, faces, process=False), points)
    far = np.flatnonzero(distance > NEAR)
    reach = np.zeros(len(points))
    if len(far):
        reach[far] = np.where(outside(vertices, faces, points[far]), distance[far], 0.0)
    worst = np.zeros(len(asset.parts))
    np.maximum.at(worst, owner, reach)
    return worst


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nouns", nargs="*", help="all of them where none is named")
    given = parser.parse_args()
    rows = []
    for noun in given.nouns or [entry.noun for entry in entries()]:
        asset = make(noun, seed=0)
        worst, limit = reaches(asset), allowed(float(asset.size.max()))
        rows.append((noun, float(worst.max()), limit, int((worst > limit).sum()), len(worst)))
    print("| noun | parts reach out [mm] | limit of imported meshes [mm] | parts beyond it |")
    print("| --- | ---: | ---: | ---: |")
    for noun, reach, limit, beyond, count in sorted(rows, key=lambda row: -row[1]):
        print(f"| {noun} | {1e3 * reach:.2f} | {1e3 * limit:.2f} | {beyond} of {count} |")
    over = sum(beyond > 0 for *_, beyond, _ in rows)
    print(
        f"\n{over} of {len(rows)} nouns have parts beyond it; median {1e3 * np.median([row[1] for row in rows]):.2f} mm"
    )


if __name__ == "__main__":
    main()
