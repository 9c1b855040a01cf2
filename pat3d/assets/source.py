"""What makes assets of nouns, whatever they come from: one protocol.

A noun of a plan says its source: "mug" is the catalogue's, "ycb/power_drill" the library's of that name. So a plan is
all that is needed to make its objects, and what a sentence means by "drill" is decided once, when it is read.
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from pat3d.assets.variant import USUAL, Variant
from pat3d.scene.asset import Asset

CATALOGUE = "catalogue"


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """Something that a source can make of a phrase."""

    source: str
    noun: str
    """As plans name it: "mug", "ycb/power_drill"."""
    name: str
    """As people call it: "power drill"."""
    score: float
    """In [0, 1]; 1 where the phrase is one of its names."""


@dataclass(frozen=True, kw_only=True)
class Known:
    """What a source calls one of its nouns."""

    noun: str
    names: tuple[str, ...]
    """Best first, lower case, in the singular."""
    like: str = ""
    """The catalogue noun that it is a kind of, by which sentences are judged; empty for none."""


class AssetSource(Protocol):
    """Makes assets of nouns."""

    @property
    def name(self) -> str:
        """Unique among the sources."""
        ...

    def nouns(self) -> Sequence[Known]:
        """Everything that it can make; what stands first wins where two have a name."""
        ...

    def find(self, phrase: str) -> Sequence[Candidate]:
        """What `phrase` may mean, likeliest first."""
        ...

    def digest(self, noun: str) -> str:
        """A checksum of what the asset of `noun` is made from, beside its variant."""
        ...

    def make(self, noun: str, variant: Variant = USUAL) -> Asset:
        """The asset of one of its nouns, as `Candidate.noun` names it.

        Raises:
            PromptError: there is no such noun.
            AssetError: it cannot be made so.
        """
        ...


def candidates(source: AssetSource, phrase: str, least: float = 0.5) -> list[Candidate]:
    """The nouns of `source` whose names are like `phrase`, likeliest first."""
    found = [
        Candidate(source=source.name, noun=one.noun, name=one.names[0], score=best)
        for one in source.nouns()
        if (best := max(score(phrase, name) for name in one.names)) >= least
    ]
    return sorted(found, key=lambda one: -one.score)


def score(phrase: str, name: str) -> float:
    """1 for the same words, less for a part of them, least for a likely misspelling; in [0, 1]."""
    said, known = phrase.lower().split(), name.lower().split()
    if said == known:
        return 1.0
    if not said or not known:
        return 0.0
    # "drill" of "power drill": the last word tells what it is.
    if said[-1] == known[-1]:
        shared = len(set(said) & set(known)) / len(set(said) | set(known))
        return 0.6 + 0.35 * shared
    return 0.6 * difflib.SequenceMatcher(None, " ".join(said), " ".join(known)).ratio()
