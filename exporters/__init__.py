"""Scenes in the formats of other programs, and the verification that they say the same.

    from pat3d.exporters import export, parity

    paths = export(scene, ("mjcf", "usd", "urdf"), "exports/desk")
    assert all(parity(scene, path).passed for path in paths.values())

The names load what they need when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pat3d.exporters.compare import parity
    from pat3d.exporters.formats import FORMATS, export

__all__ = ["FORMATS", "export", "parity"]

_HOMES = {
    "FORMATS": "pat3d.exporters.formats",
    "export": "pat3d.exporters.formats",
    "parity": "pat3d.exporters.compare",
}


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f'module "pat3d.exporters" has no attribute "{name}". It has: {", ".join(__all__)}.')


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
