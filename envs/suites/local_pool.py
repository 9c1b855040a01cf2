"""Workers that are processes of this machine."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

import pat3d
from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.threads import ONE_THREAD
from pat3d.envs.suites.worker_pool import Unit, WorkerPool

_LOG_TAIL = 2000


class LocalPool(WorkerPool):
    """A process for every worker, told and heard through pipes."""

    def __init__(self, folder: SuiteFolder, request: Request) -> None:
        super().__init__()
        self._folder, self._request = folder, request
        self._answers: SimpleQueue[tuple[int, dict[str, Any], str]] = SimpleQueue()
        self._processes: dict[int, subprocess.Popen[str]] = {}

    def _start(self, number: int) -> None:
        self._folder.work.mkdir(parents=True, exist_ok=True)
        with self._log(number).open("wb") as log:
            process = subprocess.Popen(
                [sys.executable, "-P", "-m", "pat3d.envs.suites.worker"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
                encoding="utf-8",
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": python_path()},
                start_new_session=True,
            )
        self._processes[number] = process
        self._send(number, {"folder": str(self._folder.path), "request": self._request.as_dict()})
        threading.Thread(target=self._listen, args=(number, process), daemon=True).start()

    def _assign(self, number: int, units: Sequence[Unit]) -> None:
        self._send(number, {"units": units})

    def _next(self, seconds: float) -> tuple[int, dict[str, Any], str] | None:
        try:
            found = self._answers.get(timeout=seconds)
        except Empty:
            return None
        if found[2]:
            self._processes.pop(found[0], None)
        return found

    def _kill(self, number: int) -> None:
        self._processes[number].kill()

    def _close(self) -> None:
        for process in self._processes.values():
            process.kill()
        for process in self._processes.values():
            process.wait()

    def _last_words(self, number: int) -> str:
        try:
            return self._log(number).read_text(encoding="utf-8", errors="replace")[-_LOG_TAIL:].strip()
        except OSError:
            return ""

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
                self._answers.put((number, said, ""))
        self._answers.put((number, {}, _how_it_ended(process.wait())))


def python_path() -> str:
    """Where workers find the same pat3d as here, and nothing from the folder one happens to be in."""
    root = str(Path(pat3d.__file__).resolve().parents[1])
    return os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH"))))


def _how_it_ended(status: int) -> str:
    """An exit status in words."""
    if status < 0:
        try:
            return f"was killed by {signal.Signals(-status).name}"
        except ValueError:
            return f"was killed by signal {-status}"
    return f"ended with status {status}"
