"""A library as a source of assets."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

from pat3d.assets.colours import COLOURS, find_colour
from pat3d.assets.library.index import Library, open_library
from pat3d.assets.library.store import VERSION, Entry, is_plain, painted, scaled, weighed
from pat3d.assets.materials import material as find_material
from pat3d.assets.source import Candidate, Known, candidates
from pat3d.assets.variant import USUAL, Variant
from pat3d.errors import PromptError
from pat3d.scene.asset import Asset
from pat3d.scene.cache import content_key


class LibrarySource:
    """What is ready of the library called `name`."""

    def __init__(self, name: str) -> None:
        """Raises: AssetError: there is no such library."""
        self.name = name
        self.library: Library = open_library(name)

    @cached_property
    def _entries(self) -> dict[str, Entry]:
        return {entry.key: entry for entry in self.library.ready}

    def nouns(self) -> Sequence[Known]:
        """Every object that is ready."""
        return self._known

    @cached_property
    def _known(self) -> tuple[Known, ...]:
        return tuple(
            Known(noun=f"{self.name}/{one.key}", names=(one.name, *one.synonyms), like=one.like)
            for one in self._entries.values()
        )

    def find(self, phrase: str) -> Sequence[Candidate]:
        """Objects by their names."""
        return candidates(self, phrase)

    def digest(self, noun: str) -> str:
        """What the asset of `noun` is made of."""
        entry = self._entry(noun)
        return content_key({}, {"files": dict(entry.files), "settings": dict(entry.settings), "version": VERSION})

    def make(self, noun: str, variant: Variant = USUAL) -> Asset:
        """The object as it is indexed, whatever seed and adjectives; a colour where it has no texture of its own.

        Raises:
            PromptError: there is no such object, or it is not ready.
            AssetError: the index is damaged.
        """
        entry = self._entry(noun)
        asset = scaled(self.library.asset(entry.key), variant.scale)
        record = dict(asset.provenance)
        if variant.scale != 1.0:
            record["scale_asked"] = variant.scale
        asked = [found for name in variant.colours if (found := find_colour(name))]
        if asked and is_plain(asset):
            asset = painted(asset, COLOURS[asked[0]])
            record["colours"] = asked
        elif asked:
            record["not_coloured"] = f"{', '.join(asked)}: it has a texture of its own"
        if variant.material is not None and variant.material != asset.material.name:
            made_of = find_material(variant.material)
            factor = made_of.density * asset.mass_properties.volume / asset.mass_properties.mass
            asset = weighed(asset, factor)
            asset = replace(asset, material=made_of)
            record["material"] = variant.material
        return replace(asset, provenance=record)

    def _entry(self, noun: str) -> Entry:
        key = noun.split("/", 1)[-1]
        if key in self._entries:
            return self._entries[key]
        known = next((one for one in self.library.entries if one.key == key), None)
        if known is not None:
            raise PromptError(f'"{noun}" is {known.state}: {known.reason}')
        near = difflib.get_close_matches(key, list(self._entries), n=3, cutoff=0.4)
        hint = f" Nearest: {', '.join(near)}." if near else f" `pat3d library show {self.name}` lists what is there."
        raise PromptError(f'library "{self.name}" has no "{key}".{hint}')
