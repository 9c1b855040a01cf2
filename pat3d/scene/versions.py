"""Versions of what a scene was made with."""

from __future__ import annotations

import functools

VERSION = "0.1.0"
"""Of this PAT3D."""

MADE_WITH = ("numpy", "scipy", "warp-lang", "mujoco", "trimesh", "manifold3d", "coacd", "clarabel", "python-fcl")
"""Packages that decide how a scene turns out, or that it was verified with."""


@functools.cache
def version_of(package: str) -> str | None:
    """Version of an installed package, or None."""
    from importlib import metadata

    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def versions() -> dict[str, str | None]:
    """Versions of PAT3D and of the packages that matter to a scene."""
    return {"pat3d": VERSION, **{package: version_of(package) for package in MADE_WITH}}
