"""What a run notes of its steps for a backward pass."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import warp as wp
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True, eq=False)
class StepRecord:
    """What one time step depended on besides the state it started from; enough to differentiate it."""

    active: NDArray[np.bool_]
    """Worlds that were stepped, shape (worlds,)."""
    sigma: NDArray[np.float64]
    """Inertia weight over the squared time step [1/s^2], shape (worlds,)."""
    d_hat: float
    """[m]"""
    lag_d_hat: float
    """Barrier activation distance at which friction was recorded [m]."""
    epsilon: float
    """[m]"""
    reference: NDArray[np.int64]
    """Index of the state from which friction displacements count, shape (worlds,)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Tape:
    """All states of a run and the steps between them, for the backward pass."""

    states: list[wp.array] = field(default_factory=list)
    """Shape (bodies, 4), vec3d each, on the device; one more than steps."""
    steps: list[StepRecord] = field(default_factory=list)
