"""The catalogue's recipes as a source of assets."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from pat3d.assets.source import CATALOGUE, Candidate, Known, candidates
from pat3d.scene.asset import Asset


class Catalogue:
    """The recipes of `pat3d.assets.catalogue` as a source."""

    name = CATALOGUE

    def nouns(self) -> Sequence[Known]:
        """Every entry."""
        from pat3d.assets.catalogue import lookup

        return [Known(noun=one.noun, names=(one.noun, *one.synonyms), like=one.noun) for one in lookup.entries()]

    def find(self, phrase: str) -> Sequence[Candidate]:
        """Entries by their names."""
        return candidates(self, phrase)

    def digest(self, noun: str) -> str:
        """Nothing: recipes change with the version of the program."""
        return ""

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
        """What the recipe of `noun` makes."""
        from pat3d.assets.catalogue import lookup

        return lookup.make(noun, seed=seed, scale=scale, colours=colours, material=material, adjectives=adjectives)
