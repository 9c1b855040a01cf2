"""The same bits in every run on one GPU, for more time and memory; a CPU gives them anyway.

A GPU adds the contributions of many threads in whatever order they arrive, and fills lists in that order. With
determinism on, sums are recorded, sorted and added in the order of the threads (Warp's `DeterministicMode.RUN_TO_RUN`,
which needs room for as many records as a thread may add), and candidate pairs are sorted on the host.
"""

from __future__ import annotations

from importlib import import_module

import numpy as np
import warp as wp
from numpy.typing import NDArray

RECORDS = {
    "pat3d.sim.terms.inertia": 1,
    "pat3d.sim.terms.orthogonality": 1,
    "pat3d.sim.terms.attachment": 8 * 8 * 3,
    "pat3d.sim.terms.contact": 8 * 8 * 9,
    "pat3d.sim.terms.friction": 8 * 8 * 9,
    "pat3d.sim.terms.contact_reach": 1,
    "pat3d.sim.terms.friction_lag": 8,
    "pat3d.sim.solvers.line_search": 2,
    "pat3d.sim.measures": 1,
    "pat3d.sim.adjoint": 1,
}
"""Modules that sum in threads, and the most that one thread adds to one array.

A Hessian takes eight by eight blocks of nine numbers from a contact. The bounds are never exceeded, which matters
because a recorded graph would not notice.
"""

_on = False


def enable() -> None:
    """Make all later runs of this process on a GPU repeatable; to be called before any model is made."""
    global _on
    for name, records in RECORDS.items():
        options = {"deterministic": wp.DeterministicMode.RUN_TO_RUN, "deterministic_max_records": records}
        wp.set_module_options(options, module=import_module(name))
    _on = True


def enabled() -> bool:
    """Whether `enable` was called."""
    return _on


def canonical(kinds: NDArray[np.int32], primitives: NDArray[np.int32]) -> NDArray[np.int64]:
    """Order of pairs by kind and vertices, whatever order they were found in.

    Args:
        kinds: shape (pairs,).
        primitives: vertex indices, shape (pairs, 4).
    """
    return np.lexsort((*primitives.T[::-1], kinds))
