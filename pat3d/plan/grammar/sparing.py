"""What is made of a clause that no reading covers: its pieces, or the things alone that it names."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Collection
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.chunks import trimmed
from pat3d.plan.grammar.chunking.cutter import Cutter
from pat3d.plan.grammar.chunking.failures import UnknownNounError, UnreadError
from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.meaning.contradictions import refuse_both_sides
from pat3d.plan.grammar.meaning.ellipsis import completed
from pat3d.plan.grammar.meaning.interpret import Interpreter
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.parsing.named_only import has_verb, named_only
from pat3d.plan.grammar.parsing.pieces import COMPARING, in_pieces
from pat3d.plan.grammar.rewriting.instructions import Clause
from pat3d.plan.grammar.words.left_out import quoted
from pat3d.plan.grammar.words.vocabulary import Nouns


class Sparing(ABC):
    """Reads a clause with less than all of its words."""

    _nouns: Nouns
    _likely: Plausible
    _maker: Maker

    @abstractmethod
    def _told(self, text: str, clause: Clause, world: World, company: Collection[str]) -> tuple[World, World | None]:
        """`world` with all that `clause` says, and the next likely reading where it is nearly as likely."""

    def _in_pieces(
        self, text: str, clause: Clause, world: World, company: Collection[str], fault: PromptError
    ) -> tuple[World, World | None] | None:
        """`world` with what `clause` says but for words between; None where these may change what the rest says."""
        if clause.manner is not None or not isinstance(fault, UnreadError) or isinstance(fault, UnknownNounError):
            return None
        if {token.text for token in clause.tokens} & COMPARING or not has_verb(clause.tokens, self._nouns):
            return None
        sentence = Cutter(text, clause.tokens, self._nouns, company).cut()
        lighter = copied(world)
        known = [group.phrase for group in world.groups if not group.replaced]
        chunks = completed(trimmed(sentence.chunks), self._nouns, known)
        pieces = in_pieces(chunks, self._likely, lambda phrase: self._maker.no_thing(phrase.head))
        if pieces is None or "or" in sentence.unread:
            return None
        lighter.hear(sentence)
        for said in (*pieces.left_out, *sentence.unread):
            lighter.note(f'not understood: "{said}"')
        try:
            Interpreter(lighter, pieces.chunks, self._maker, clause).add(pieces.reading)
            refuse_both_sides(lighter)
        except PromptError:
            return None
        return lighter, None

    def _named_only(
        self, text: str, clause: Clause, world: World, company: Collection[str], fault: PromptError
    ) -> tuple[World, World | None] | None:
        """`world` with the things alone that `clause` names; None where what it names is not known."""
        if not isinstance(fault, UnreadError) or isinstance(fault, UnknownNounError):
            return None
        asked = clause.manner is not None
        named = named_only(text, clause.tokens, self._nouns, fault.number, asked=asked)
        if named is None:
            return None
        there, missing = named
        but = " but " * bool(missing) + ", ".join(f'"{each}"' for each in missing)
        lighter = copied(world)
        said = clause.said or quoted(text, clause.tokens[:-1])
        lighter.note(f'not understood: "{said}"; what it names is there{but}, and no more is made of it.')
        try:
            return self._told(text, replace(clause, tokens=tuple(there), verb="", manner=None), lighter, company)
        except PromptError:
            return None


def copied(world: World) -> World:
    """A world of its own."""
    return copy.deepcopy(world, {id(world.likely): world.likely})
