"""Where nouns that are data are kept: a folder of YAML files each for what the user wrote and what a model composed."""

from __future__ import annotations

from pathlib import Path

from pat3d.scene.cache import data_root

OWN, COMPOSED = "own", "composed"
"""Names of the two sources."""


def noun_folder(source: str) -> Path:
    """The folder of a source's files."""
    return data_root() / "nouns" / source


def has_own() -> bool:
    """Whether there is any such noun."""
    return any(True for source in (OWN, COMPOSED) for _ in noun_folder(source).glob("*.yaml"))
