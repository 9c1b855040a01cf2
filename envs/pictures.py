"""Pictures of a running simulation, through MuJoCo's GL renderer where there is GL, else traced on the CPU."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.simulation import Simulation


@dataclass(frozen=True, eq=False)
class Picture:
    """What one camera sees."""

    image: NDArray[np.uint8]
    """RGB, row 0 at the top, shape (height, width, 3)."""
    depth: NDArray[np.float32] | None = None
    """Distance from the camera's plane [m], shape (height, width)."""
    segmentation: NDArray[np.uint16] | None = None
    """0 nothing, 1 robot, 2 + index of the object in the scene; shape (height, width)."""


class Pictures:
    def __init__(self, simulation: Simulation) -> None:
        raise NotImplementedError
