"""Pytest plugin of benchmarks/mutants.py: notes which tests run which lines, or runs chosen tests in a given order.

The file named by $PAT3D_MUTANT_ORDER says what to do: {"watch": modules, "out": file} or {"tests": names in order}.
"""

from __future__ import annotations

import inspect
import json
import os
import sys
import threading
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

_ORDER: dict[str, Any] = json.loads(Path(os.environ["PAT3D_MUTANT_ORDER"]).read_text(encoding="utf-8"))
_FILES = {str(Path(module).resolve()): module for module in _ORDER.get("watch", ())}
_NAMES: dict[str, str | None] = {}
_RUN: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
_SECONDS: dict[str, float] = {}
_current = ""


def _module(file: str) -> str | None:
    if file not in _NAMES:
        _NAMES[file] = _FILES.get(os.path.realpath(file))
    return _NAMES[file]


def _calls(frame: FrameType, event: str, _: object) -> Any:
    module = _module(frame.f_code.co_filename)
    if module is None:
        return None
    lines = _RUN[module]
    # Bodies of modules and classes run at import, whichever test is the first to need them.
    test = _current if frame.f_code.co_flags & inspect.CO_OPTIMIZED else ""

    def line(inner: FrameType, event: str, _: object) -> Any:
        lines[inner.f_lineno].add(test)
        return line

    lines[frame.f_lineno].add(test)
    return line


if _FILES:
    threading.settrace(_calls)
    sys.settrace(_calls)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Time every test and remember its name."""
    global _current
    _current = item.nodeid
    start = time.perf_counter()
    yield
    _SECONDS[item.nodeid] = time.perf_counter() - start
    _current = ""


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Keep the chosen tests, in their order."""
    if "tests" not in _ORDER:
        return
    rank = {name: k for k, name in enumerate(_ORDER["tests"])}
    left_out = [item for item in items if item.nodeid not in rank]
    items[:] = sorted((item for item in items if item.nodeid in rank), key=lambda item: rank[item.nodeid])
    config.hook.pytest_deselected(items=left_out)


def pytest_sessionfinish() -> None:
    """Write what was noted."""
    if not _FILES:
        return
    sys.settrace(None)
    lines = {module: {line: sorted(tests) for line, tests in by.items()} for module, by in _RUN.items()}
    Path(_ORDER["out"]).write_text(json.dumps({"seconds": _SECONDS, "lines": lines}), encoding="utf-8")
