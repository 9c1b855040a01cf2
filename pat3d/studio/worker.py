"""A process of its own for a studio's long work: the page stays quick, and cancelling ends it at once."""

from __future__ import annotations

import os
import signal
import tempfile
import threading
import time
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any, Protocol

from pat3d import errors
from pat3d.errors import Pat3dError, SimulationError
from pat3d.progress import Event, Progress, silent

Job = Callable[..., Any]
"""A function of a module, which takes `progress` beside its arguments; what it takes and returns can be sent."""

GRACE = 3.0
"""[s] that cancelled work has to tidy up."""
BEAT = 0.1
"""[s] between two looks whether it is cancelled, and between two events of one stage."""


class Run(Protocol):
    """How a job is done: here, or in a process."""

    def __call__(self, job: Job, *arguments: Any, progress: Progress = silent) -> Any:
        """What `job` returns for `arguments`."""


def here(job: Job, *arguments: Any, progress: Progress = silent) -> Any:
    """Do a job in this process."""
    return job(*arguments, progress=progress)


class Worker:
    """Does one job after another in a process, which is started when it is needed and again after it was ended."""

    def __init__(self, scratch: Path) -> None:
        """Temporary files of the jobs go into the folder `scratch`, where they are removed with it."""
        self._scratch, self._lock = scratch, threading.Lock()
        self._process: Any = None
        self._pipe: Any = None
        self._closed = False

    def run(self, job: Job, *arguments: Any, progress: Progress = silent) -> Any:
        """What `job` returns for `arguments`; where `progress` raises, the process is ended.

        Raises:
            Pat3dError: the job raised it.
            SimulationError: the process ended by itself, or the studio has ended.
        """
        check = getattr(progress, "check", lambda: None)
        with self._lock:
            self._start()
            try:
                self._pipe.send((job, arguments))
                while True:
                    check()
                    if self._pipe.poll(BEAT):
                        kind, *said = self._pipe.recv()
                        if kind != "event":
                            break
                        progress(_with_places(*said))
            except (EOFError, BrokenPipeError, ConnectionResetError) as error:
                self._stop()
                raise SimulationError(f"the process that did it ended by itself ({job.__name__}).") from error
            except BaseException:
                self._stop()
                raise
        if kind == "refused":
            raise getattr(errors, said[0], Pat3dError)(said[1])
        if kind == "fault":
            raise RuntimeError(said[0])
        return said[0]

    def warm(self, job: Job) -> None:
        """Do `job` in the background, so that the next one does not wait for the process to start."""

        def work() -> None:
            # Whoever needs what it loads is told of the fault.
            with suppress(Pat3dError, RuntimeError):
                self.run(job)

        threading.Thread(target=work, daemon=True, name="pat3d studio warming").start()

    def close(self) -> None:
        """End the process for good, as soon as it has nothing to do."""
        with self._lock:
            self._closed = True
            self._stop(idle=True)

    def _start(self) -> None:
        if self._closed:
            raise SimulationError("the studio has ended.")
        if self._process is not None and self._process.is_alive():
            return
        # A server has threads, so the process does not begin as a copy of this one.
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, str(self._scratch)), name="pat3d studio work")
        self._process.start()
        theirs.close()

    def _stop(self, *, idle: bool = False) -> None:
        if self._process is None:
            return
        self._pipe.close()
        if not idle:
            self._process.terminate()
        self._process.join(GRACE)
        # What it started itself, as the decomposition of a mesh, goes with it.
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.join()
        self._process = None


def _serve(pipe: Any, scratch: str) -> None:
    """Do jobs until the pipe is closed."""
    os.setsid()
    signal.signal(signal.SIGTERM, _interrupt)
    tempfile.tempdir = scratch
    with suppress(KeyboardInterrupt, EOFError, OSError):
        while True:
            job, arguments = pipe.recv()
            pipe.send(_done(job, arguments, _Told(pipe)))


def _done(job: Job, arguments: tuple[Any, ...], progress: Progress) -> tuple[str, ...]:
    try:
        return "done", job(*arguments, progress=progress)
    except Pat3dError as error:
        return "refused", type(error).__name__, str(error)
    except Exception as error:
        # A studio outlives a fault of one step; the terminal has the traceback.
        traceback.print_exc()
        return "fault", f"{type(error).__name__}: {error}"


def _with_places(event: Event, places: Mapping[str, Any] | None) -> Event:
    return event if places is None else replace(event, places=lambda: places)


class _Told:
    """Sends events, of one stage not more than one a beat."""

    def __init__(self, pipe: Any) -> None:
        self._pipe, self._stage, self._last = pipe, "", 0.0

    def __call__(self, event: Event) -> None:
        now = time.monotonic()
        if event.stage != self._stage or now - self._last >= BEAT:
            self._stage, self._last = event.stage, now
            places = None if event.places is None else event.places()
            self._pipe.send(("event", replace(event, places=None), places))


def _interrupt(*_: Any) -> None:
    raise KeyboardInterrupt
