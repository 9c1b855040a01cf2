"""Runs fTetWild on one mesh in a process of its own, since bad input makes the library abort or hang.

    python -P remesh_worker.py INPUT.npz OUTPUT.npz

INPUT holds `vertices`, `faces`, the ideal `edge` [m] and the `envelope` relative to the mesh's diagonal; OUTPUT gets
`vertices` and `faces` of the boundary of the tetrahedra. No pickle on either side.
"""

from __future__ import annotations

import sys

import numpy as np

SIDES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))
"""Of a tetrahedron of positive volume, outwards."""


def main(source: str, target: str) -> None:
    """Remesh the surface in file `source`."""
    import pytetwild  # pyright: ignore[reportMissingImports]

    with np.load(source, allow_pickle=False) as data:
        points, cells = pytetwild.tetrahedralize(
            data["vertices"],
            data["faces"],
            edge_length_abs=float(data["edge"]),
            epsilon=float(data["envelope"]),
            num_threads=1,
            quiet=True,
        )
    a, b, c, d = (points[cells[:, corner]] for corner in range(4))
    turned = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
    cells[turned] = cells[turned][:, [1, 0, 2, 3]]
    sides = cells[:, SIDES].reshape(-1, 3)
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    faces = sides[first[count == 1]]
    used, index = np.unique(faces, return_inverse=True)
    with open(target, "wb") as file:
        np.savez(file, vertices=points[used], faces=index.reshape(-1, 3).astype(np.int32))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
