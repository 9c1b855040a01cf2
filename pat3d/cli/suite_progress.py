"""How far a suite is, in a terminal and elsewhere."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from pat3d.cli.console import QUIET_SECONDS, console

if TYPE_CHECKING:
    from pat3d.envs.suites.generate import Status, Watcher


@contextmanager
def making() -> Iterator[Watcher]:
    """A bar with rate and time to go in a terminal, a line now and then elsewhere."""
    target = console(stderr=True)
    if not target.is_terminal:
        yield _Lines(target).tell
        return
    with _bar(target, "{task.fields[words]}") as live:
        task = live.add_task("scenes", total=None, words="")
        yield lambda status: live.update(task, completed=status.done, total=status.total, words=_words(status))


@contextmanager
def counting(what: str) -> Iterator[Callable[[int, int], None]]:
    """A bar of how many are done, of how many, in a terminal."""
    target = console(stderr=True)
    if not target.is_terminal:
        yield lambda done, of: None
        return
    with _bar(target, "{task.description}") as live:
        task = live.add_task(what, total=None)
        yield lambda done, of: live.update(task, completed=done, total=of)


def _bar(target: Any, words: str) -> Any:
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), TextColumn(words))
    return Progress(*columns, console=target, transient=True)


class _Lines:
    def __init__(self, target: Any) -> None:
        self._console, self._start, self._last = target, time.perf_counter(), -QUIET_SECONDS

    def tell(self, status: Status) -> None:
        now = time.perf_counter()
        if now - self._last < QUIET_SECONDS and status.done < status.total:
            return
        self._last = now
        line = f"{now - self._start:6.0f} s  {status.done} of {status.total} scenes  {_words(status)}"
        self._console.print(line, markup=False)


def _words(status: Status) -> str:
    if status.note:
        return status.note
    left = status.left
    going = "" if left is None else f", {_duration(left)} to go"
    return f"{status.per_hour:.0f} an hour{going}; {status.rejected} rejected; {status.workers} workers"


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"
