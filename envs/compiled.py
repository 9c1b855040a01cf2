"""Functions compiled by numba, of the extra `robots`; without it they run as they are written."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def compiled(function: Callable[..., Any]) -> Any:
    """Compile when it is first called; kept for later processes where there is a folder for that.

    numba keeps what it compiled until the function's own file changes: what calls another compiled function has to be
    in the same file.
    """
    try:
        import numba
    except ImportError:
        return function
    try:
        return numba.njit(cache=True)(function)
    except RuntimeError:
        return numba.njit(function)


def as_written(function: Any) -> Callable[..., Any]:
    """What was compiled, in Python."""
    return getattr(function, "py_func", function)
