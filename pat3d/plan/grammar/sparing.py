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
from pat3d.plan.grammar.parsing.named_only import begins_with_thing, has_verb, is_thing, names_all, things_named
from pat3d.plan.grammar.parsing.pieces import COMPARING, in_pieces
from pat3d.plan.grammar.rewriting.distances import with_distances
from pat3d.plan.grammar.rewriting.instructions import Clause, asked
from pat3d.plan.grammar.rewriting.outcomes import TAKING
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

    def _parts(self, text: str, sentence: Sequence[Token]) -> list[Clause]:
        """The clauses of `sentence`; one that is `unread` where they cannot be told."""
        try:
            return self._clauses(text, sentence)
        except PromptError as error:
            return [Clause(tokens=tuple(sentence), unread=error)]

    def _read_less(
        self, text: str, clause: Clause, world: World, company: Collection[str], told: Sequence[Clause]
    ) -> tuple[World, World | None]:
        """`world` with what can be read of `clause`, one of those `told`, and what the rest of it names.

        Raises:
            PromptError: it names what cannot be made, or no other clause can be read.
        """
        failure = clause.unread
        if failure is None:
            try:
                return self._read(text, clause, copied(world), company)
            except UnreadError as error:
                failure = error
        number = failure.number if isinstance(failure, UnreadError) else 0
        lacking = failure if clause.unread is None else self._fault(clause, UnreadError(str(failure), number))
        if isinstance(lacking, UnknownNounError) or is_thing(clause.tokens, number):
            raise lacking
        asks = clause.manner is not None or bool(asked(clause.tokens, self._nouns))
        for start, end in unread_spans(
            clause.tokens, number, instructed=asks, opened=not isinstance(failure, UnreadError)
        ):
            rest, less = without(clause.tokens, [(start, end)]), copied(world)
            if not (Remarks(rest, self._nouns).things() or (world.groups and clause.unread is None)):
                continue
            try:
                for each in self._clauses(text, rest) if clause.unread else [replace(clause, tokens=rest)]:
                    less, _ = self._read(text, with_distances(text, each), less, company)
                less.note(f'not modelled: "{quoted(text, clause.tokens[start:end])}"')
                return self._with_named(text, (*clause.tokens[start:end], clause.tokens[-1]), less, company)
            except PromptError:
                continue
        alone = all(each.unread for each in told) or len(told) == 1
        if alone and not names_all(clause.tokens, self._nouns, number, asked=asks):
            raise failure
        again = {"it", "them"} & {token.text for token in clause.tokens}
        if again and clause.manner in ("make", "move", "stack") and world.steps and world.steps[-1].manner == "pick":
            # "Pick up the cup and put it wherever there is room": to pick it up is not all of it.
            world.steps.pop()
        said = clause.said or quoted(text, clause.tokens[:-1])
        _, missing = things_named(text, clause.tokens, self._nouns)
        but = " but " * bool(missing) + ", ".join(f'"{each}"' for each in missing)
        world.note(f'not understood: "{said}"; what it names is there{but}, and no more is made of it.')
        world, other = self._with_named(text, clause.tokens, world, company)
        if asks or TAKING & {token.text for token in clause.tokens}:
            # "Pick up the bowl right beside the box and move it": not the box.
            plain = begins_with_thing(text, clause.tokens, self._nouns)
            world.unread = world.subject if plain else []
        return world, other

    def _with_named(
        self, text: str, tokens: Sequence[Token], world: World, company: Collection[str]
    ) -> tuple[World, World | None]:
        """`world` with the things that `tokens`, which are not read, name."""
        there, _ = things_named(text, tokens, self._nouns)
        return self._told(text, Clause(tokens=tuple(there), first=False), world, company) if there else (world, None)

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
        chunks = completed(trimmed(sentence.chunks), self._nouns, known, sentence.doubts)
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


def copied(world: World) -> World:
    """A world of its own."""
    return copy.deepcopy(world, {id(world.likely): world.likely})
