"""What a policy is, and what an evaluation does with its answers.

    class Still:
        def reset(self, episode):
            self.size = episode.action_size

        def act(self, observation):
            return numpy.zeros(self.size)

is a whole policy.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

OUT_OF_RANGE = 0.05
"""Even where actions must be in range they may pass 1 by this much, as regressions do; they are clipped."""

MAX_CHUNK = 1000
"""Actions that a policy may give at once."""


@dataclass(frozen=True, kw_only=True)
class EpisodeStart:
    """What a policy is told before an episode."""

    instruction: str
    """The task in words."""
    task: str
    """Specification of the task: "pick:red mug"."""
    seed: int
    """Of the episode; a policy that draws random numbers draws them from this."""
    robot: str
    control: str
    action_size: int
    control_freq: float
    """Actions a second [1/s]."""
    env: Any = None
    """The TabletopEnv itself, for a policy with `privileged = True` only."""


@runtime_checkable
class Policy(Protocol):
    """Two methods; an optional attribute `privileged = True` asks for the environment itself."""

    def reset(self, episode: EpisodeStart) -> None:
        """An episode begins."""
        ...

    def act(self, observation: Mapping[str, Any]) -> Any:
        """The next action in [-1, 1], shape (action_size,), or several in a row, shape (n, action_size)."""
        ...


class PolicyError(Exception):
    """A policy did what no policy may; the episode is recorded as a policy error with this reason."""

    def __init__(self, kind: str, reason: str) -> None:
        super().__init__(f"{kind}: {reason}")
        self.kind, self.reason = kind, reason


class PolicyHang(BaseException):
    """Interrupts a policy that thinks for too long; no `except Exception` of the policy swallows it."""


class Actions(NamedTuple):
    """What a policy answered."""

    values: NDArray[np.float32]
    """In [-1, 1], shape (n, size)."""
    clipped: NDArray[np.int64]
    """How many values of each action were out of range, shape (n,)."""


def checked(answer: Any, size: int, *, strict: bool = False) -> Actions:
    """The actions in a policy's answer; what is out of range is clipped and counted.

    Args:
        answer: what the policy returned.
        size: values in one action.
        strict: refuse what is further out of range than OUT_OF_RANGE.

    Raises:
        PolicyError: not numbers, the wrong shape, not finite, or out of range where that is refused.
    """
    if hasattr(answer, "detach"):
        answer = answer.detach().cpu().numpy()
    try:
        values = np.asarray(answer)
        if values.dtype.kind not in "fiub":
            raise TypeError(f"values of type {values.dtype}")
        values = values.astype(np.float64, copy=False)
    except (TypeError, ValueError) as error:
        raise PolicyError("no numbers", f"an action is {size} numbers, not {_short(error)}") from None
    if values.ndim == 1:
        values = values[None]
    if values.ndim != 2 or values.shape[1] != size or not 1 <= len(values) <= MAX_CHUNK:
        raise PolicyError("wrong shape", f"got shape {np.shape(answer)}, valid are ({size},) and (n, {size})")
    largest = float(np.abs(values).max())
    if not math.isfinite(largest):
        what = "NaN" if math.isnan(largest) else "infinite values"
        raise PolicyError("not finite", f"an action holds {what}")
    if largest > 1.0 + OUT_OF_RANGE and strict:
        raise PolicyError("out of range", f"a value of {largest:.4g}; actions are in [-1, 1]")
    clipped = (np.abs(values) > 1.0).sum(axis=1)
    return Actions((values if largest <= 1.0 else np.clip(values, -1.0, 1.0)).astype(np.float32), clipped)


def _short(error: object, limit: int = 200) -> str:
    text = str(error)
    return text if len(text) <= limit else text[:limit] + "..."
