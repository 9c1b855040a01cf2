"""What a long run tells whoever watches it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Event:
    """A stage began, or took a step."""

    stage: str
    """What is going on, in words: "planning", "settling"."""
    detail: str = ""
    """What the stage found or waits for, in words."""
    step: int | None = None
    """Steps of the stage done so far; None where a stage only begins."""
    steps: int | None = None
    """Steps in all; None where nobody knows."""
    motion: float | None = None
    """Largest motion of any point in the step [m]."""
    loss: float | None = None
    """Semantic loss of an optimisation's step [m^2]."""


Progress = Callable[[Event], None]
"""Called often; must return quickly."""


def silent(event: Event) -> None:
    """Tell nobody."""


class Clock:
    """Wall time of every stage [s]; stages that run several times add up."""

    def __init__(self) -> None:
        self._start = time.perf_counter()
        self._stages: dict[str, float] = {}

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        """Time the block as part of `stage`."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.add(stage, time.perf_counter() - start)

    def add(self, stage: str, seconds: float) -> None:
        """Count time that was measured elsewhere [s] as part of `stage`."""
        self._stages[stage] = self._stages.get(stage, 0.0) + seconds

    @property
    def seconds(self) -> dict[str, float]:
        """Of every stage so far, in the order they began, and the total since the clock was made."""
        return {**self._stages, "total": time.perf_counter() - self._start}
