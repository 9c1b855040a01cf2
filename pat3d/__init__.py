"""From a sentence to a manipulation scene that does not move when a simulator loads it.

    scene = pat3d.generate("a red mug on a wooden table", out="scenes/mug")

The names below load what they need when they are first used; importing `pat3d` alone is cheap. It registers the
environment "PAT3D-v0" where Gymnasium is imported already.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

from pat3d.scene import versions

if TYPE_CHECKING:
    from pat3d.generation.editing.editable import load
    from pat3d.generation.pipeline import build, generate
    from pat3d.scene.io import load_scene, save_scene

__version__ = versions.VERSION

__all__ = ["__version__", "build", "generate", "load", "load_scene", "save_scene"]

_HOMES = {
    "build": "pat3d.generation.pipeline",
    "generate": "pat3d.generation.pipeline",
    "load": "pat3d.generation.editing.editable",
    "load_scene": "pat3d.scene.io",
    "save_scene": "pat3d.scene.io",
}


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f'module "pat3d" has no attribute "{name}". It has: {", ".join(__all__)}.')


def __dir__() -> list[str]:
    return sorted(__all__)


if "gymnasium" in sys.modules:
    from pat3d.envs.registration import register_with_gymnasium

    register_with_gymnasium()
