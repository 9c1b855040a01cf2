"""MuJoCo's inertia matrix as a dense one, whichever way the installed MuJoCo keeps it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.compiled import compiled


def inertia_matrix(model: Any, data: Any, out: NDArray[np.float64]) -> None:
    """Fill `out`, shape (nv, nv), from `data.M`, the lower triangle in compressed rows; MuJoCo 4 has no other."""
    _fill(data.M, model.M_rowadr, model.M_rownnz, model.M_colind, out)


@compiled
def _fill(values, first, count, column, out):
    out[:] = 0.0
    for row in range(len(first)):
        for entry in range(first[row], first[row] + count[row]):
            out[row, column[entry]] = out[column[entry], row] = values[entry]
