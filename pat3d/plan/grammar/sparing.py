"""What is made of a clause that no reading covers: its pieces, or the things alone that it names."""

from __future__ import annotations

import copy
from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
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
from pat3d.plan.grammar.parsing.named_only import has_verb, is_thing, named_only, things_named
from pat3d.plan.grammar.parsing.pieces import COMPARING, in_pieces
from pat3d.plan.grammar.rewriting.instructions import Clause, asked
from pat3d.plan.grammar.rewriting.remarks import Remarks
from pat3d.plan.grammar.rewriting.unread import unread_spans
from pat3d.plan.grammar.words.left_out import quoted, without
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Nouns


class Sparing(ABC):
    """Reads a clause with less than all of its words."""

    _nouns: Nouns
    _likely: Plausible
    _maker: Maker

    @abstractmethod
    def _told(self, text: str, clause: Clause, world: World, company: Collection[str]) -> tuple[World, World | None]:
        """`world` with all that `clause` says, and the next likely reading where it is nearly as likely."""

    @abstractmethod
    def _clauses(self, text: str, sentence: Sequence[Token]) -> list[Clause]:
        """The clauses of `sentence`."""

    @abstractmethod
    def _read(self, text: str, clause: Clause, world: World, company: Collection[str]) -> tuple[World, World | None]:
        """`world` with what can be read of `clause`, and the next likely reading where it is nearly as likely."""

    @abstractmethod
    def _fault(self, clause: Clause, failure: UnreadError) -> PromptError:
        """`failure`, or that a thing of `clause` is not in the catalogue."""

    def _parts(self, text: str, sentence: Sequence[Token], spoken: Sequence[Sequence[Token]]) -> list[Clause]:
        """The clauses of `sentence`, the part that cannot be read last: "before it burns", "if you can".

        Raises:
            PromptError: nothing can be read, and no other sentence of those `spoken` is there.
        """
        try:
            return self._clauses(text, sentence)
        except PromptError as error:
            failure = error
        number = failure.number if isinstance(failure, UnreadError) else 0
        whole = Clause(tokens=tuple(sentence), unread=True)
        if isinstance(lacking := self._fault(whole, UnreadError(str(failure), number)), UnknownNounError):
            raise lacking
        opened = not isinstance(failure, UnreadError)
        told = bool(asked(sentence, self._nouns))
        for start, end in unread_spans(sentence, number, instructed=told, open_question=opened):
            rest = without(sentence, [(start, end)])
            if Remarks(rest, self._nouns).things():
                try:
                    unread = replace(whole, tokens=(*sentence[start:end], sentence[-1]), first=False)
                    return [*self._clauses(text, rest), unread]
                except PromptError:
                    continue
        if len(spoken) == 1:
            raise failure
        return [whole]

    def _read_less(
        self, text: str, clause: Clause, world: World, company: Collection[str], told: Sequence[Clause]
    ) -> tuple[World, World | None]:
        """`world` with what can be read of `clause`, one of those `told`, and what the rest names.

        Raises:
            PromptError: it names what cannot be made, or no other clause can be read.
        """
        if not clause.unread:
            try:
                return self._read(text, clause, copied(world), company)
            except UnreadError as error:
                failure = error
            if isinstance(failure, UnknownNounError) or is_thing(clause.tokens, failure.number):
                raise failure
            for start, end in unread_spans(clause.tokens, failure.number, instructed=clause.manner is not None):
                rest = without(clause.tokens, [(start, end)])
                if world.groups or Remarks(rest, self._nouns).things():
                    try:
                        less, _ = self._read(text, replace(clause, tokens=rest), copied(world), company)
                        unread = Clause(tokens=(*clause.tokens[start:end], clause.tokens[-1]), first=False, unread=True)
                        return self._read_less(text, unread, less, company, told)
                    except PromptError:
                        continue
            if len(told) == 1:
                raise failure
        elif all(each.unread for each in told):
            raise UnreadError(f'cannot read "{quoted(text, clause.tokens)}". Say one thing a sentence.')
        world.note(f'not read: "{clause.said or quoted(text, clause.tokens[:-1])}"')
        if clause.manner in ("make", "move", "stack") and world.steps and world.steps[-1].manner == "pick":
            # "Pick up the cup and put it wherever there is room": to pick it up is not all of it.
            world.steps.pop()
        there = things_named(text, clause.tokens, self._nouns)
        plain = replace(clause, tokens=tuple(there), verb="", manner=None, unread=False)
        return self._told(text, plain, world, company) if there else (world, None)

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
        there = named_only(text, clause.tokens, self._nouns, fault.number, asked=asked)
        if there is None:
            return None
        lighter = copied(world)
        said = clause.said or quoted(text, clause.tokens[:-1])
        lighter.note(f'not understood: "{said}"; what it names is there, and no more is made of it.')
        try:
            return self._told(text, replace(clause, tokens=tuple(there), verb="", manner=None), lighter, company)
        except PromptError:
            return None


def copied(world: World) -> World:
    """A world of its own."""
    return copy.deepcopy(world, {id(world.likely): world.likely})
