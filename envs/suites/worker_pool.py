"""A pool of workers that make the units of a run: the bookkeeping that pools of processes and of Ray actors share."""

from __future__ import annotations

import os
import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from pat3d.errors import SuiteError

Unit = tuple[int, int]
"""Place and candidate, both from 0."""

MAX_WORKERS = 256


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a worker said, or that it ended."""

    worker: int
    units: tuple[Unit, ...]
    """What it had been given and not answered when it spoke; none while it got ready."""
    said: dict[str, Any] = field(default_factory=dict)
    """Empty where it ended without a word."""
    ended: str = ""
    """How it ended, in words; empty while it lives."""
    late: bool = False
    """Whether it was ended because its unit took too long."""
    last_words: str = ""
    """The end of the log of one that ended."""


def worker_count(asked: str, cores: int | None = None) -> int:
    """How many workers "auto" or a number in words means.

    Args:
        asked: by the user.
        cores: what "auto" means; by default, the cores that this process may use.

    Raises:
        SuiteError: it means nothing.
    """
    if asked == "auto":
        return min(_cores() if cores is None else cores, MAX_WORKERS)
    if asked.isdecimal() and 1 <= int(asked) <= MAX_WORKERS:
        return int(asked)
    raise SuiteError(f'--workers is "auto" or a number from 1 to {MAX_WORKERS}, not "{asked}".')


def _cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class WorkerPool(ABC):
    """Workers of one run; each has at most one block of units at a time."""

    clock: Callable[[], float] = staticmethod(time.monotonic)
    """By which the time limit of a unit is measured [s]."""

    def __init__(self) -> None:
        self._units: dict[int, list[Unit]] = {}
        """What every living worker has to do, its present block first."""
        self._since: dict[int, float] = {}
        """When it began, or was last heard [s]."""
        self._ready: set[int] = set()
        self._stopped: dict[int, float] = {}
        """After how long those were stopped whose unit took too long [s]."""
        self._spawned = 0

    @property
    def size(self) -> int:
        """Workers that live."""
        return len(self._units)

    def spawn(self) -> None:
        """Start a worker; it says when it is ready."""
        number, self._spawned = self._spawned, self._spawned + 1
        self._units[number] = []
        self._start(number)

    def idle(self) -> list[int]:
        """Workers that are ready and have nothing to do."""
        return [number for number in self._ready if not self._units[number]]

    def assign(self, worker: int, units: Sequence[Unit]) -> None:
        """Let an idle worker make a block of units, together as far as it can."""
        self._units[worker], self._since[worker] = list(units), self.clock()
        self._assign(worker, units)

    def busy(self) -> bool:
        """Whether anybody makes a unit."""
        return any(self._units.values())

    def stop_those_over(self, limit: float) -> None:
        """Kill workers that have been at one thing for more than `limit` [s]; their end is answered like any.

        One thing is a unit, or a step of a block: a unit's layout, or the settling of all.
        """
        now = self.clock()
        for number, units in self._units.items():
            if units and number not in self._stopped and now - self._since[number] > limit:
                self._stopped[number] = limit
                self._kill(number)

    def answer(self, seconds: float) -> Answer | None:
        """The next answer, or None if there is none within `seconds`."""
        found = self._next(seconds)
        if found is None:
            return None
        number, said, ended = found
        units = tuple(self._units[number])
        if ended:
            del self._units[number]
            self._ready.discard(number)
            limit = self._stopped.pop(number, None)
            if limit is not None:
                ended = f"was not done after {limit:g} s and was ended"
            return Answer(
                worker=number, units=units, ended=ended, late=limit is not None, last_words=self._last_words(number)
            )
        self._since[number] = self.clock()
        if "ready" in said:
            self._ready.add(number)
        elif "place" in said:
            self._units[number].remove((said["place"], said["candidate"]))
        return Answer(worker=number, units=units, said=said)

    @contextmanager
    def closed_at_end(self) -> Iterator[WorkerPool]:
        """Ends every worker when the block ends, however it ends."""
        try:
            yield self
        finally:
            self._close()

    @abstractmethod
    def _start(self, number: int) -> None:
        """Start worker `number`."""

    @abstractmethod
    def _assign(self, number: int, units: Sequence[Unit]) -> None:
        """Tell a worker its block of units."""

    @abstractmethod
    def _next(self, seconds: float) -> tuple[int, dict[str, Any], str] | None:
        """Who said something, what, and how it ended (empty if it has not), if anyone does within `seconds`."""

    @abstractmethod
    def _kill(self, number: int) -> None:
        """End a worker at once."""

    @abstractmethod
    def _close(self) -> None:
        """End every worker and release what the pool holds."""

    def _last_words(self, number: int) -> str:
        """The end of an ended worker's log."""
        return ""
