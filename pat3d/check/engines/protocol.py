"""What an engine is to us: something that runs an export in a process of its own and says where everything went."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

Format = Literal["mjcf", "urdf", "usd"]


@dataclass(frozen=True, kw_only=True, eq=False)
class EngineRun:
    """Where an engine had every moving body, over time."""

    engine: str
    version: str
    settings: Mapping[str, Any]
    """What the run used, as the driver states it."""
    warnings: tuple[str, ...]
    """What the engine complained about."""
    wall_seconds: float
    times: NDArray[np.float64]
    """Simulated time of every record [s], shape (records,)."""
    names: tuple[str, ...]
    """Of the moving bodies: slugs, or the objects' own names."""
    poses: NDArray[np.float64]
    """Position [m] and quaternion wxyz of every body frame, NaN after a blow-up, shape (records, bodies, 7)."""
    leans: NDArray[np.float64]
    """Of gravity at every record [degrees], shape (records,)."""


class Engine(Protocol):
    """One engine with one solver."""

    @property
    def name(self) -> str:
        """As users type it."""
        ...

    @property
    def title(self) -> str:
        """As tables show it."""
        ...

    @property
    def format(self) -> Format:
        """The export that it loads."""
        ...

    def absence(self) -> str | None:
        """Why the engine cannot run here and how to get it; None where it can."""
        ...

    def run(self, export: Path, seconds: float, *, timeout: float, lean: float = 0.0) -> EngineRun:
        """Load the export in the folder `export` and simulate it untouched.

        Args:
            export: the folder of the engine's format.
            seconds: simulated time [s].
            timeout: wall time after which the run is given up [s].
            lean: of gravity in the end [degrees], as on ground that is tilted further and further, towards one side
                after the other; such a run ends when something has fallen.

        Raises:
            CheckError: the engine refuses the export, crashes, takes too long, or answers nonsense.
        """
        ...


@dataclass(frozen=True, kw_only=True)
class Absent:
    """An engine that is not here."""

    engine: str
    reason: str
    """Why, and how to get it."""


@dataclass(frozen=True, kw_only=True)
class Failed:
    """An engine that did not finish."""

    engine: str
    reason: str
    settings: Mapping[str, Any] = field(default_factory=dict)
