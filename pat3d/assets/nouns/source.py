"""Nouns that are data as a source of assets: the user's own, and those that a model composed."""

from __future__ import annotations

import difflib
import hashlib
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path

from pat3d.assets.catalogue.lookup import make_entry
from pat3d.assets.nouns.program import Program, read_noun
from pat3d.assets.nouns.where import COMPOSED, OWN, noun_folder
from pat3d.assets.source import Candidate, Known, candidates
from pat3d.assets.variant import USUAL, Variant
from pat3d.errors import PromptError, SpecError
from pat3d.scene.asset import Asset
from pat3d.scene.naming import APART, slug
from pat3d.scene.replacement import write_text


class OwnNouns:
    """The nouns that the user wrote ("own"), or that a model composed ("composed")."""

    NAMES = (OWN, COMPOSED)

    def __init__(self, name: str) -> None:
        """Of the source called `name`, one of NAMES."""
        self.name = name

    @cached_property
    def _programs(self) -> dict[str, Program]:
        found = {}
        for path in sorted(noun_folder(self.name).glob("*.yaml")):
            try:
                found[path.stem] = read_noun(path)
            except SpecError:
                # What was valid when it was added may not be for another version; making it says so.
                continue
        return found

    def nouns(self) -> Sequence[Known]:
        """Every noun that is kept and valid."""
        return [
            Known(noun=f"{self.name}{APART}{key}", names=(one.entry.noun, *one.entry.synonyms))
            for key, one in self._programs.items()
        ]

    def find(self, phrase: str) -> Sequence[Candidate]:
        """Nouns by their names."""
        return candidates(self, phrase)

    def digest(self, noun: str) -> str:
        """SHA-256 of the noun's file.

        Raises:
            PromptError: there is none.
        """
        return hashlib.sha256(self._path(noun).read_bytes()).hexdigest()

    def make(self, noun: str, variant: Variant = USUAL) -> Asset:
        """The asset that the noun's program makes.

        Raises:
            PromptError: there is no such noun.
            SpecError: its program is not valid.
        """
        path = self._path(noun)
        program = self._programs.get(path.stem) or read_noun(path)
        asset = make_entry(program.entry, program.entry.noun, variant)
        record = {**asset.provenance, "source": self.name, "file": path.name, "sha256": self.digest(noun)}
        return replace(asset, provenance=record)

    def _path(self, noun: str) -> Path:
        key = noun.split(APART, 1)[-1]
        path = noun_folder(self.name) / f"{slug(key)}.yaml"
        if not path.is_file():
            near = difflib.get_close_matches(key, list(self._programs), n=3, cutoff=0.4)
            hint = f" Nearest: {', '.join(near)}." if near else ""
            raise PromptError(f'"{noun}": there is no such noun of {noun_folder(self.name)}.{hint}')
        return path


def keep(program: Program, source: str = OWN) -> str:
    """Keep a noun under its name, in place of an earlier one of that name; returns what plans call it."""
    key = slug(program.entry.noun)
    write_text(noun_folder(source) / f"{key}.yaml", program.text)
    return f"{source}{APART}{key}"
