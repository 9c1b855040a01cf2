"""What this process and those that do episodes for it have in common."""

from __future__ import annotations

import contextlib
import os
import signal
import time
import traceback
from collections.abc import Callable, Iterator
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from pat3d.errors import Pat3dError

GRACE_SECONDS = 5.0
"""A policy that hangs where no signal reaches it is ended this much after its time."""

POLL_SECONDS = 0.5

THREADS = tuple(f"{name}_NUM_THREADS" for name in ("OMP", "OPENBLAS", "MKL", "NUMEXPR", "NUMBA"))
"""Variables that say how many threads a process's numerical libraries start."""

now = time.monotonic
"""The clock that hangs are measured by; workers write their deadlines by it."""


@contextlib.contextmanager
def thread_limit(count: int) -> Iterator[None]:
    """Numerical libraries of the processes that are started here use `count` threads, where nobody said otherwise."""
    own = {name: str(count) for name in THREADS if name not in os.environ}
    os.environ.update(own)
    try:
        yield
    finally:
        for name in own:
            del os.environ[name]


def cores() -> int:
    """That this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def told(error: Exception) -> str:
    """An error and where it was raised."""
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}: {error}{where}"


def serve(pipe: Connection, answer: Callable[[Any], Any]) -> None:
    """What a process does: answers what comes through the pipe until that is closed, or until it fails.

    Args:
        pipe: gives requests; takes a word and a value: "answer", or "error", "missing" (a module) or "broken" with why.
        answer: does one request.
    """
    # Ctrl-C is the parent's to handle.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    while True:
        try:
            request = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            pipe.send(("answer", answer(request)))
        except Pat3dError as error:
            pipe.send(("error", f"{type(error).__name__}: {error}"))
            return
        except ModuleNotFoundError as error:
            pipe.send(("missing", error.name or str(error)))
            return
        except BrokenPipeError:
            return
        except Exception as error:
            pipe.send(("broken", told(error)))
            return
