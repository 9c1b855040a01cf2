"""How to make a scene, whatever it is a scene of."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pat3d.errors import SpecError
from pat3d.exporters.formats import chosen
from pat3d.scene.model import check_least_tilt
from pat3d.scene.physics import LEAST_TILT, SETTLING_FRICTION

MAX_SEED = 2**32 - 1

DEVICES = ("cpu", "cuda")
"""Where scenes settle."""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """How to make a scene, whatever it is a scene of."""

    seed: int = 0
    """The same seed gives the same scene."""
    friction: float = SETTLING_FRICTION
    """Coulomb coefficient [-] of every contact while settling; exports carry the materials' own."""
    least_tilt: float = LEAST_TILT
    """Tilt of the ground [degrees] that the scene has to stand."""
    cpu_limit: float | None = None
    """Processor time that it may take [s]; None for any."""
    device: str = "cpu"
    """One of DEVICES."""
    formats: tuple[str, ...] = ("mjcf",)
    """Exchange formats to write; MJCF, in which the scene is verified, always is."""
    resume: bool = False
    """Keep finished stages beside the folder, and use those whose inputs have not changed."""

    def __post_init__(self) -> None:
        if not 0 <= self.seed <= MAX_SEED:
            raise SpecError(f"the seed must be a whole number from 0 to {MAX_SEED}, got {self.seed}.")
        if not (math.isfinite(self.friction) and 0.0 < self.friction <= 2.0):
            raise SpecError(f"friction must be more than 0 and at most 2, got {self.friction}.")
        check_least_tilt(self.least_tilt)
        if self.cpu_limit is not None and not self.cpu_limit > 0.0:
            raise SpecError(f"the limit of processor time must be more than 0 s, got {self.cpu_limit:g}.")
        object.__setattr__(self, "formats", chosen(self.formats))
        if self.device not in DEVICES:
            raise SpecError(f'unknown device "{self.device}". Valid: {", ".join(DEVICES)}.')
