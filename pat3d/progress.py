"""What a long run tells whoever watches it."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from pat3d.errors import CpuLimitError


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
    places: Callable[[], Mapping[str, Any]] | None = field(default=None, compare=False, repr=False)
    """What finds where the objects are in this step, a pose by name; only for whoever calls it before the next step."""

    scene: Any = field(default=None, compare=False, repr=False)
    """The new scene that begins to settle, as it is laid out."""


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


class CpuBudget:
    """Processor time that a run may take [s], its finished child processes included; None for any.

    Processor time, because a machine that is busy with something else must not change what is refused.
    """

    def __init__(self, seconds: float | None = None) -> None:
        self.seconds, self._start = seconds, _processor_time()

    @property
    def left(self) -> float | None:
        """[s]; not negative."""
        return None if self.seconds is None else max(0.0, self.seconds - (_processor_time() - self._start))

    def check(self, stage: str) -> None:
        """Raise CpuLimitError where nothing is left for `stage`."""
        if self.left == 0.0:
            raise CpuLimitError(
                f"the limit of {self.seconds:g} s of processor time was reached while {stage}. Nothing was written; "
                "allow more, or ask for fewer or simpler things."
            )

    def watching(self, progress: Progress) -> Progress:
        """`progress`, ending the run when the time is spent."""
        if self.seconds is None:
            return progress

        def tell(event: Event) -> None:
            step = "" if event.step is None else f", step {event.step}"
            self.check(f"{event.stage}{f' {event.detail}' if event.detail else ''}{step}")
            progress(event)

        return tell


def _processor_time() -> float:
    """Of this process and of its children that have ended [s]."""
    return sum(os.times()[:4])
