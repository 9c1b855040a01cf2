"""Registry of the modules that define Warp kernels: which to compile, and what determinism must know of each.

Every such module declares itself in its head, so that no list of them is kept anywhere else.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import warp as wp


@dataclass(frozen=True, kw_only=True)
class KernelModule:
    """One module with kernels."""

    name: str
    most_records: int
    """The most numbers that one thread adds to one array; 0 where no sum depends on the order of threads."""
    gradients: bool
    """Whether only the backward pass launches its kernels."""


_declared: dict[str, KernelModule] = {}
_options: list[Callable[[KernelModule], dict[str, Any]]] = [
    # Without them one kernel did not compile in 200 s; with them it takes 2 s.
    lambda _: {"enable_backward": False, "max_unroll": 0}
]


def declare_kernels(name: str, *, most_records: int = 0, gradients: bool = False) -> None:
    """Register the calling module, of the given `__name__`, and set Warp's options for it; see `KernelModule`.

    The bound on records must never be exceeded, which matters because a recorded graph would not notice.
    """
    module = KernelModule(name=name, most_records=most_records, gradients=gradients)
    _declared[name] = module
    for options in _options:
        wp.set_module_options(options(module), module=sys.modules[name])


def declared_modules() -> tuple[KernelModule, ...]:
    """Those imported so far, in the order of their imports."""
    return tuple(_declared.values())


def add_options(options: Callable[[KernelModule], dict[str, Any]]) -> None:
    """Give every module, imported yet or later, further options of Warp."""
    _options.append(options)
    for module in _declared.values():
        wp.set_module_options(options(module), module=sys.modules[module.name])
