"""What tests of suites share."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from pat3d.envs.suites.folder import LOG
from pat3d.envs.suites.request import Request

SMALL = Request(tasks=("pick", "stack"), scenes=4, objects=(4, 6), picture=64, seed=3)
"""Made in some seconds."""


def files_of(folder, without):
    """Contents of all files but the log and those named."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.name not in {LOG, ".lock", *without})
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def workers_of(pid):
    """Process ids of the workers that process `pid` started."""
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    children = [int(child) for task in tasks for child in task.read_text().split()]
    return [child for child in children if b"suites.worker" in Path(f"/proc/{child}/cmdline").read_bytes()]


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


def wait(until: Callable[[], bool], going: Callable[[], bool] = lambda: True) -> None:
    """Until something holds, however long it takes, as long as whoever brings it about is `going`."""
    while not until():
        assert going() or until(), "waited in vain"
        time.sleep(0.02)
