"""What a long run tells whoever watches it."""

from __future__ import annotations

from collections.abc import Callable
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
