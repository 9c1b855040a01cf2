"""Worker processes and what they are asked to do."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

import pat3d
from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.threads import ONE_THREAD
from pat3d.errors import SuiteError

Unit = tuple[int, int]
"""Place and candidate, both from 0."""

MAX_WORKERS = 256
_LOG_TAIL = 2000


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a worker said, or that it ended."""

    worker: int
    unit: Unit | None
    """What it was doing; None while it got ready."""
    said: dict[str, Any] = field(default_factory=dict)
    """Empty where it ended without a word."""
    ended: int | None = None
    """Its exit status; negative for a signal."""


def worker_count(asked: str) -> int:
    """How many workers "auto" or a number in words means.

    Raises:
        SuiteError: it means nothing.
    """
    if asked == "auto":
        return min(_cores(), MAX_WORKERS)
    if asked.isdecimal() and 1 <= int(asked) <= MAX_WORKERS:
        return int(asked)
    raise SuiteError(f'--workers is "auto" or a number from 1 to {MAX_WORKERS}, not "{asked}".')


def _cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Crew:
    """Workers of one run; each has at most one unit at a time."""

    def __init__(self, folder: SuiteFolder, request: Request) -> None:
        self._folder, self._request = folder, request
        self._answers: SimpleQueue[Answer] = SimpleQueue()
        self._processes: dict[int, subprocess.Popen[str]] = {}
        self._units: dict[int, Unit | None] = {}
        self._ready: set[int] = set()
        self._next = 0

    @property
    def size(self) -> int:
        """Workers that live."""
        return len(self._processes)

    @property
    def pids(self) -> tuple[int, ...]:
        """Process ids of the workers."""
        return tuple(process.pid for process in self._processes.values())

    def hire(self) -> None:
        """Start a worker; it says when it is ready."""
        number, self._next = self._next, self._next + 1
        self._folder.work.mkdir(parents=True, exist_ok=True)
        # The same pat3d as here, and nothing from the folder one happens to be in.
        root = str(Path(pat3d.__file__).resolve().parents[1])
        path = os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH"))))
        with self._log(number).open("wb") as log:
            process = subprocess.Popen(
                [sys.executable, "-P", "-m", "pat3d.envs.suites.worker"],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, text=True, encoding="utf-8",
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": path}, start_new_session=True,
            )  # fmt: skip
        self._processes[number], self._units[number] = process, None
        self._send(number, {"folder": str(self._folder.path), "request": self._request.as_dict()})
        threading.Thread(target=self._listen, args=(number, process), daemon=True).start()

    def idle(self) -> list[int]:
        """Workers that are ready and have nothing to do."""
        return [number for number in self._ready if self._units[number] is None]

    def give(self, worker: int, unit: Unit) -> None:
        """Let an idle worker make a unit."""
        self._units[worker] = unit
        self._send(worker, {"place": unit[0], "candidate": unit[1]})

    def busy(self) -> bool:
        """Whether anybody makes a unit or gets ready."""
        return any(unit is not None or number not in self._ready for number, unit in self._units.items())

    def answer(self, seconds: float) -> Answer | None:
        """The next answer, or None if there is none within `seconds`."""
        try:
            found = self._answers.get(timeout=seconds)
        except Empty:
            return None
        if found.ended is not None:
            self._processes.pop(found.worker, None)
            self._ready.discard(found.worker)
            return Answer(worker=found.worker, unit=self._units.pop(found.worker, None), ended=found.ended)
        unit = self._units.get(found.worker)
        if "ready" in found.said:
            self._ready.add(found.worker)
        else:
            self._units[found.worker] = None
        return Answer(worker=found.worker, unit=unit, said=found.said)

    def last_words(self, worker: int) -> str:
        """The end of a worker's log."""
        try:
            return self._log(worker).read_text(encoding="utf-8", errors="replace")[-_LOG_TAIL:].strip()
        except OSError:
            return ""

    @contextmanager
    def dismissed_at_end(self) -> Iterator[Crew]:
        """Ends every worker when the block ends, however it ends."""
        try:
            yield self
        finally:
            for process in self._processes.values():
                process.kill()
            for process in self._processes.values():
                process.wait()

    def _log(self, number: int) -> Path:
        return self._folder.work / f"worker-{number}.log"

    def _send(self, number: int, message: dict[str, Any]) -> None:
        stream = self._processes[number].stdin
        try:
            if stream is not None:
                stream.write(json.dumps(message) + "\n")
                stream.flush()
        except OSError:
            # It has ended; its listener says so.
            return

    def _listen(self, number: int, process: subprocess.Popen[str]) -> None:
        if process.stdout is not None:
            for line in process.stdout:
                try:
                    said = json.loads(line)
                except ValueError:
                    # Cut off in the middle: it is ending.
                    break
                self._answers.put(Answer(worker=number, unit=None, said=said))
        self._answers.put(Answer(worker=number, unit=None, ended=process.wait()))


def how_it_ended(status: int) -> str:
    """An exit status in words."""
    if status < 0:
        try:
            return f"was killed by {signal.Signals(-status).name}"
        except ValueError:
            return f"was killed by signal {-status}"
    return f"ended with status {status}"
