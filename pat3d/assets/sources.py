"""All sources of assets: libraries, nouns of the user's own, the catalogue; which noun a name means."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from pat3d.assets.catalogue import lookup
from pat3d.assets.generated.source import MeshServers
from pat3d.assets.library.source import LibrarySource
from pat3d.assets.nouns.source import OwnNouns
from pat3d.assets.source import CATALOGUE, AssetSource, Candidate, Known, candidates
from pat3d.assets.variant import USUAL, Variant
from pat3d.scene.asset import Asset
from pat3d.scene.naming import APART


class Catalogue:
    """The recipes of `pat3d.assets.catalogue` as a source."""

    name = CATALOGUE

    def nouns(self) -> Sequence[Known]:
        """Every entry."""
        return [Known(noun=one.noun, names=(one.noun, *one.synonyms), like=one.noun) for one in lookup.entries()]

    def find(self, phrase: str) -> Sequence[Candidate]:
        """Entries by their names."""
        return candidates(self, phrase)

    def digest(self, noun: str) -> str:
        """Nothing: recipes change with the version of the program."""
        return ""

    def make(self, noun: str, variant: Variant = USUAL) -> Asset:
        """What the recipe of `noun` makes."""
        return lookup.make_variant(noun, variant)


def source_of(noun: str) -> AssetSource:
    """The source that makes `noun`.

    Raises:
        AssetError: there is no library of that name.
    """
    if APART not in noun:
        return Catalogue()
    return source_named(noun.split(APART, 1)[0])


def source_named(name: str) -> AssetSource:
    """The source called `name`.

    Raises:
        AssetError: there is none.
    """
    if name == CATALOGUE:
        return Catalogue()
    if name == MeshServers.name:
        return MeshServers()
    return OwnNouns(name) if name in OwnNouns.NAMES else LibrarySource(name)


def make(noun: str, variant: Variant = USUAL) -> Asset:
    """The asset of `noun`, whatever source it is of.

    Raises:
        PromptError: there is no such noun.
        AssetError: it cannot be made so.
    """
    return source_of(noun).make(noun, variant)


def sources(libraries: Sequence[str] = ()) -> tuple[AssetSource, ...]:
    """`libraries` in their order, then the user's own nouns, then the catalogue.

    Raises:
        AssetError: there is no library of a name.
    """
    order = list(dict.fromkeys(libraries))
    others = [name for name in OwnNouns.NAMES if name not in order and OwnNouns(name).nouns()]
    return tuple(source_named(name) for name in [*order, *others, *([] if CATALOGUE in order else [CATALOGUE])])


def find(phrase: str, among: Sequence[AssetSource]) -> list[Candidate]:
    """What `phrase` may mean, likeliest first; of equals, what an earlier source has."""
    found = [one for source in among for one in source.find(phrase)]
    return sorted(found, key=lambda one: -one.score)


def names_of(among: Sequence[AssetSource]) -> tuple[dict[str, str], dict[str, str]]:
    """The noun of every name that the sources other than the catalogue have, and what each of these nouns is like.

    Every name is there with its source before it too ("ycb mug"), which tells it from the same name elsewhere.
    """
    names: dict[str, str] = {}
    likes: dict[str, str] = {}
    for source in among:
        if source.name == CATALOGUE:
            continue
        for rank in range(max((len(one.names) for one in source.nouns()), default=0)):
            # An object's own name comes before the same name as somebody's synonym.
            for one in source.nouns():
                for name in one.names[rank : rank + 1]:
                    names.setdefault(name, one.noun)
                    names.setdefault(f"{source.name} {name}", one.noun)
        likes |= {one.noun: one.like for one in source.nouns() if one.like}
    return names, likes


def fingerprint(nouns: Iterable[str]) -> Mapping[str, str]:
    """What decides the assets of those of `nouns` that are not the catalogue's: a checksum each."""
    return {noun: source_of(noun).digest(noun) for noun in sorted(set(nouns)) if APART in noun}
