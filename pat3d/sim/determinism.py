"""The same bits in every run on one GPU, for more time and memory; a CPU gives them anyway.

A GPU adds the contributions of many threads in whatever order they arrive, and fills lists in that order. With
determinism on, sums are recorded, sorted and added in the order of the threads (Warp's `DeterministicMode.RUN_TO_RUN`,
whose buffers hold as many records as a thread may add: `KernelModule.most_records`), and candidate pairs are sorted on
the host.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.kernel_modules import KernelModule, add_options

_on = False


def enable() -> None:
    """Make all later runs of this process on a GPU repeatable; to be called before any model is made."""
    global _on
    if not _on:
        add_options(_options)
    _on = True


def _options(module: KernelModule) -> dict[str, Any]:
    if not module.most_records:
        return {}
    return {"deterministic": wp.DeterministicMode.RUN_TO_RUN, "deterministic_max_records": module.most_records}


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
