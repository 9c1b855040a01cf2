"""Makes "PAT3D-v0" known to Gymnasium, in whichever order the two are imported, without importing Gymnasium.

Gymnasium has no plug-in loader: a package registers its environments when it is imported. Importing Gymnasium takes
tens of times as long as importing pat3d, so pat3d waits for somebody else to do it.
"""

from __future__ import annotations

import sys
from typing import Any

ENV_ID = "PAT3D-v0"

MAX_EPISODE_STEPS = 400
"""20 s at 20 actions a second."""


def register_with_gymnasium() -> None:
    """Register now where Gymnasium is imported already, else right after its import."""
    if "gymnasium" in sys.modules:
        _register(sys.modules["gymnasium"])
    elif not any(isinstance(finder, _AfterImport) for finder in sys.meta_path):
        sys.meta_path.insert(0, _AfterImport())


def _register(gymnasium: Any) -> None:
    # A half-imported Gymnasium has no registry yet.
    if hasattr(gymnasium, "register") and ENV_ID not in gymnasium.registry:
        gymnasium.register(
            id=ENV_ID, entry_point="pat3d.envs.env:TabletopEnv", vector_entry_point="pat3d.envs.vector:make_vector",
            max_episode_steps=MAX_EPISODE_STEPS,
        )  # fmt: skip


class _AfterImport:
    """An import finder that finds nothing itself, and registers once the import of Gymnasium is through."""

    def find_spec(self, name: str, path: Any, target: Any = None) -> Any:
        if name != "gymnasium":
            return None
        if self in sys.meta_path:
            sys.meta_path.remove(self)
        for finder in sys.meta_path:
            spec = finder.find_spec(name, path, target)
            if spec is not None:
                if hasattr(spec.loader, "exec_module"):
                    spec.loader = _Registering(spec.loader)  # type: ignore[assignment]
                return spec
        return None


class _Registering:
    """Gymnasium's own loader, with the registration after it."""

    def __init__(self, loader: Any) -> None:
        self._loader = loader

    def __getattr__(self, name: str) -> Any:
        return getattr(self._loader, name)

    def create_module(self, spec: Any) -> Any:
        return self._loader.create_module(spec)

    def exec_module(self, module: Any) -> None:
        module.__spec__.loader = module.__loader__ = self._loader
        self._loader.exec_module(module)
        _register(module)
