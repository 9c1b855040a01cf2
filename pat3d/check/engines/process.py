"""Engines that run as a script in a process of their own.

Nothing that a driver writes is trusted: the file is bounded in size, plain JSON, and checked before use.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.check.engines.environments import engines_root, how_to_get, interpreter, is_made
from pat3d.check.engines.protocol import EngineRun, Format
from pat3d.errors import CheckError

DRIVERS = Path(__file__).parent / "drivers"
FORMAT = "pat3d-engine-run"
MAX_BYTES = 256 * 2**20
MAX_BODIES = 5000
MAX_WARNINGS = 20
TAIL_BYTES = 4000

_KEPT = ("PATH", "HOME", "USERPROFILE", "SYSTEMROOT", "TMPDIR", "TEMP", "LANG", "LD_LIBRARY_PATH", "XDG_CACHE_HOME")
"""Environment variables that a driver sees."""


@dataclass(frozen=True, kw_only=True)
class ScriptEngine:
    """An engine behind one of the scripts in `drivers`."""

    name: str
    title: str
    format: Format
    driver: Path
    environment: str | None
    """Name of its virtual environment; None for the one that runs PAT3D."""
    variant: str = ""
    """Which solver, where the driver knows several."""

    def absence(self) -> str | None:
        """Why it cannot run here and how to get it; None where it can."""
        if self.environment is None or is_made(self.environment):
            return None
        state = "is not made" if not interpreter(self.environment).exists() else "is of another version of PAT3D"
        return f"{engines_root() / self.environment} {state}: {how_to_get(self.environment)}"

    def run(self, export: Path, seconds: float, *, timeout: float, lean: float = 0.0) -> EngineRun:
        """Run the driver; see `Engine`."""
        python = Path(sys.executable) if self.environment is None else interpreter(self.environment)
        with tempfile.TemporaryDirectory(prefix="pat3d-engine-") as scratch:
            out = Path(scratch) / "run.json"
            command = [str(python), "-s", str(self.driver), str(Path(export).resolve()), "--seconds", repr(seconds)]
            command += ["--out", str(out), "--variant", self.variant]
            command += ["--lean", repr(lean)] if lean else []
            code, tail = _execute(command, Path(scratch), timeout)
            if code is None:
                raise CheckError(f"{self.title}: no result within {timeout:g} s of wall time.")
            if code != 0:
                raise CheckError(f"{self.title}: the driver ended with {_meaning(code)}: {tail or 'no message'}")
            return read_run(out, self.title)


def _execute(command: list[str], folder: Path, timeout: float) -> tuple[int | None, str]:
    """Exit code, None where time ran out, and the last line of what the process printed as errors."""
    environment = {key: os.environ[key] for key in _KEPT if key in os.environ}
    with tempfile.TemporaryFile(dir=folder) as errors:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            start_new_session=True,
        )
        try:
            code: int | None = process.wait(timeout)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            if process.poll() is None:
                _end(process)
        size = errors.seek(0, os.SEEK_END)
        errors.seek(max(0, size - TAIL_BYTES))
        lines = errors.read().decode("utf-8", "replace").strip().splitlines()
    return code, lines[-1].strip() if lines else ""


def _end(process: subprocess.Popen) -> None:
    """End a driver and what it started."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    process.wait()


def _meaning(code: int) -> str:
    """An exit code in words: "signal SIGSEGV", "exit code 1"."""
    if code >= 0:
        return f"exit code {code}"
    try:
        return f"signal {signal.Signals(-code).name}"
    except ValueError:
        return f"signal {-code}"


def read_run(path: Path, title: str) -> EngineRun:
    """What a driver wrote at `path`.

    Raises:
        CheckError: missing, too large, not JSON, or not what a driver writes.
    """
    try:
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise CheckError(f"{title}: the driver wrote {size / 2**20:.0f} MiB; at most {MAX_BYTES >> 20} are read.")
        document = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise CheckError(f"{title}: the driver wrote no result.") from None
    except (OSError, ValueError, RecursionError) as error:
        raise CheckError(f"{title}: the driver's result is not JSON ({error}).") from error
    try:
        return _checked(document)
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise CheckError(f"{title}: the driver's result is malformed ({error}).") from error


def _checked(document: Any) -> EngineRun:
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise ValueError(f'no "format": "{FORMAT}"')
    names = document["names"]
    if not isinstance(names, list) or not all(isinstance(name, str) and len(name) <= 500 for name in names):
        raise ValueError("names is not a list of body names")
    if len(names) > MAX_BODIES or len(set(names)) != len(names):
        raise ValueError(f"names repeats, or holds more than {MAX_BODIES}")
    times = np.array(document["times"], dtype=np.float64)
    poses = np.array(document["poses"], dtype=np.float64).reshape(len(times), len(names), 7)
    leans = np.array(document.get("leans", np.zeros(len(times))), dtype=np.float64)
    if leans.shape != times.shape or not np.isfinite(leans).all():
        raise ValueError("leans is not a number for every record")
    if times.ndim != 1 or not len(times) or not np.isfinite(times).all():
        raise ValueError("times is not a list of numbers")
    settings, warnings = document["settings"], document["warnings"]
    if not isinstance(settings, dict) or len(settings) > 100 or not isinstance(warnings, list):
        raise ValueError("settings or warnings of another type")
    wall = float(document["wall_seconds"])
    if not math.isfinite(wall):
        raise ValueError("wall_seconds is not a number")
    return EngineRun(
        engine=str(document["engine"])[:100],
        version=str(document["version"])[:100],
        settings={str(key)[:100]: _plain(value) for key, value in settings.items()},
        warnings=tuple(str(text)[:500] for text in warnings[:MAX_WARNINGS]),
        wall_seconds=wall,
        times=times,
        names=tuple(names),
        poses=poses,
        leans=leans,
    )


def _plain(value: Any) -> Any:
    """A setting as a number, a truth value or a short text."""
    return value if isinstance(value, bool | int | float) else str(value)[:200]
