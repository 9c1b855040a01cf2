"""What tests of suites share."""

from __future__ import annotations

from pat3d.envs.suites.folder import LOG
from pat3d.envs.suites.request import Request

SMALL = Request(tasks=("pick", "stack"), scenes=4, objects=(4, 6), picture=64, seed=3)
"""Made in some seconds."""


def files_of(folder, without):
    """Contents of all files but the log and those named."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.name not in {LOG, ".lock", *without})
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
