"""Nouns that are data as a source of assets."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from pat3d.assets.nouns.where import COMPOSED, OWN
from pat3d.assets.source import Candidate, Known, candidates
from pat3d.errors import PromptError
from pat3d.scene.asset import Asset


class OwnNouns:
    """The nouns that the user wrote ("own"), or that a model composed ("composed")."""

    NAMES = (OWN, COMPOSED)

    def __init__(self, name: str) -> None:
        """Of the source called `name`, one of NAMES."""
        self.name = name

    def nouns(self) -> Sequence[Known]:
        """Every noun that is kept."""
        return ()

    def find(self, phrase: str) -> Sequence[Candidate]:
        """Nouns by their names."""
        return candidates(self, phrase)

    def digest(self, noun: str) -> str:
        """What the asset of `noun` is made of."""
        raise PromptError(f'there is no noun "{noun}".')

    def make(
        self,
        noun: str,
        *,
        seed: int = 0,
        scale: float = 1.0,
        colours: Iterable[str] = (),
        material: str | None = None,
        adjectives: Iterable[str] = (),
    ) -> Asset:
        """The asset of its shape program."""
        raise PromptError(f'there is no noun "{noun}".')
