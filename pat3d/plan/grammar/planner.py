"""The offline planner: a grammar over English, ranked by what is likely, that accounts for every word."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from pat3d.assets.colours import COLOURS
from pat3d.assets.materials import find_material
from pat3d.errors import PromptError, SpecError
from pat3d.plan.audit.auditor import audited
from pat3d.plan.doors import with_doors
from pat3d.plan.drawers import CABINETS, in_cabinets
from pat3d.plan.grammar.chunking.chunks import trimmed
from pat3d.plan.grammar.chunking.cutter import Cutter
from pat3d.plan.grammar.chunking.failures import UnknownNounError, UnreadError
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.covering import covering
from pat3d.plan.grammar.meaning.attached import attached_higher
from pat3d.plan.grammar.meaning.contradictions import refuse_both_sides
from pat3d.plan.grammar.meaning.ellipsis import completed
from pat3d.plan.grammar.meaning.finish import finish
from pat3d.plan.grammar.meaning.interpret import Interpreter
from pat3d.plan.grammar.meaning.likes import vessels_meant
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.tasks import put_otherwise, task_of
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.rewriting.acting import without_actor
from pat3d.plan.grammar.rewriting.addressed import unaddressed
from pat3d.plan.grammar.rewriting.apposed import apposed
from pat3d.plan.grammar.rewriting.compass import compass
from pat3d.plan.grammar.rewriting.denials import without_denials
from pat3d.plan.grammar.rewriting.distances import with_distances
from pat3d.plan.grammar.rewriting.distractors import without_distractors
from pat3d.plan.grammar.rewriting.drawers import drawer_of, drawers_moved
from pat3d.plan.grammar.rewriting.fractions import in_numbers
from pat3d.plan.grammar.rewriting.insets import without_insets
from pat3d.plan.grammar.rewriting.instructions import Clause, clauses
from pat3d.plan.grammar.rewriting.laid_tables import laid_tables
from pat3d.plan.grammar.rewriting.lettering import lettering
from pat3d.plan.grammar.rewriting.list_frames import listed_plainly
from pat3d.plan.grammar.rewriting.manners import without_manners
from pat3d.plan.grammar.rewriting.paraphrase import plainer
from pat3d.plan.grammar.rewriting.plain_words import in_plain_words
from pat3d.plan.grammar.rewriting.remarks import Remarks
from pat3d.plan.grammar.rewriting.rows import told_rows
from pat3d.plan.grammar.rewriting.sensed import sensed
from pat3d.plan.grammar.rewriting.sentences import check_language, sentences
from pat3d.plan.grammar.rewriting.similes import similes
from pat3d.plan.grammar.rewriting.tails import Tails
from pat3d.plan.grammar.rewriting.talk import without_talk
from pat3d.plan.grammar.rewriting.variants import varied
from pat3d.plan.grammar.sparing import Sparing, copied
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.left_out import doing_nothing, quoted, without
from pat3d.plan.grammar.words.lexing import Span, Token, normalise, singulars, tokenise
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.names import catalogue_names
from pat3d.plan.grammar.words.vocabulary import Nouns, Vocabulary
from pat3d.plan.scene_plan import ScenePlan
from pat3d.plan.telling import tell
from pat3d.scene.relations import OPPOSITE, Relation

if TYPE_CHECKING:
    from pat3d.assets.generated.orders import Orders

MAX_CHARACTERS = 2000
"""Length of the longest prompt."""
TRIED = 6
"""Readings of a sentence of which references and supports are worked out."""
REMARKS = 4
"""Remarks of a sentence without which it is read."""
TAILS = 3
"""Readings without a tail of which another tail is left out."""
CLOSE = 0.3
"""Readings that differ by less in cost are both told, which one sentence in thirty has."""
_COLOURS_ARE = (["the", "colors", "are"], ["the", "colours", "are"])
_BLOCK = "a colour alone is read as a block of it."
_CHOICE = '"or" is read as "and": everything named is placed.'


class GrammarPlanner(Sparing):
    """Plans a prompt with word tables and a grammar: no model, no network, the same plan every time.

    With `allow_proxies` an unknown noun becomes a plain box, said so in the plan's notes, instead of an error.
    """

    def __init__(
        self, allow_proxies: bool = False, *, vocabulary: Vocabulary | None = None, orders: Orders | None = None
    ) -> None:
        """Plan with the nouns of `vocabulary`, by default the catalogue's; see the class for `allow_proxies`.

        With `orders`, a mesh server is to make what has no noun, and nothing stands in for that.
        """
        if vocabulary is None:
            vocabulary = catalogue_names()
        # What a server makes needs nothing that stands in.
        self._nouns = Nouns(vocabulary, standing_in=orders is None)
        self._likely = Plausible(self._nouns)
        self._maker = Maker(self._nouns, allow_proxies=allow_proxies, orders=orders)
        self._orders = orders

    def plan(self, prompt: str) -> ScenePlan:
        """Plan `prompt`.

        Raises:
            PromptError: the prompt is empty or too long, names something that cannot be made, asks for too many
                objects, or has an object rest on itself.
        """
        first, *others = self.readings(prompt)
        return replace(first, otherwise=tell(others[0])) if others else first

    def readings(self, prompt: str) -> tuple[ScenePlan, ...]:
        """The likeliest plan, and the next where it has other objects or relations and is nearly as likely.

        Raises:
            PromptError: see `plan`.
        """
        if not prompt.strip():
            raise PromptError('the prompt is empty. Describe a scene: "a red mug on a wooden table".')
        if len(prompt) > MAX_CHARACTERS:
            raise PromptError(f"the prompt has {len(prompt)} characters; at most {MAX_CHARACTERS} are read.")
        check_language(text := normalise(prompt))
        tokens, inset = without_insets(text, tokenise(text))
        tokens, distracting = without_distractors(text, tokens)
        tokens, charted = compass(text, tokens)
        tokens, shares = in_numbers(text, tokens, self._nouns)
        tokens = in_plain_words(text, tokens, self._nouns)
        company = {word for token in tokens for word in (token.text, *singulars(token.text))}
        said, aside = unaddressed(text, sentences(tokens, self._nouns), self._nouns)
        said, which = apposed(text, said)
        said, unlaid = laid_tables(text, said, self._nouns)
        spoken, talk = without_talk(said, self._nouns)
        told = [with_distances(text, clause) for sentence in spoken for clause in self._parts(text, sentence)]
        told, beside_robot, means = without_actor(text, told)
        world, others = World(self._likely), list[tuple[int, World]]()
        away = (*(quoted(text, span) for span in talk), *beside_robot, *unlaid)
        away = [f'not modelled: "{each}"' for each in away]
        hues = (text[token.start : token.end].lower() for token in tokens if token.text == "block")
        hued = [_BLOCK] if any(map(is_colour_word, hues)) else []
        world.notes += [*away, *which, *charted, *shares, *inset, *distracting, *hued]
        world.aside += [*aside, *means]
        for at, clause in enumerate(told):
            world, other = self._read_less(text, clause, world, company, told)
            if other is not None:
                others.append((at + 1, other))
        plans = [self._finished(prompt, world)]
        for at, other in others[:1]:
            try:
                for clause in told[at:]:
                    other, _ = self._read_less(text, clause, other, company, told)
                second = self._finished(prompt, other)
            except PromptError:
                continue
            if _relations(second) != _relations(plans[0]):
                plans.append(second)
        return tuple(plans)

    def _clauses(self, text: str, sentence: Sequence[Token]) -> list[Clause]:
        """The clauses of `sentence`, without what denies something of nothing: "that is not in use".

        Raises:
            PromptError: the sentence leaves open what is to be there.
        """
        sentence = listed_plainly(drawers_moved(drawer_of(sentence, self._nouns)), self._nouns)
        sentence, denials = without_denials(varied(told_rows(sentence, self._nouns), self._nouns), self._nouns)
        sentence, manners = without_manners(sentence, self._nouns)
        denied = tuple(quoted(text, span) for span in (*denials, *manners))
        told = clauses(text, plainer(text, sentence, self._nouns), self._nouns)
        return [replace(told[0], aside=(*denied, *told[0].aside)), *told[1:]]

    def _finished(self, prompt: str, world: World) -> ScenePlan:
        try:
            plan, names = finish(prompt, world, self._nouns)
        except SpecError as error:
            raise PromptError(str(error)) from error
        if self._orders is not None:
            self._orders.keep(obj.noun for obj in plan.objects)
        task, notes = task_of(world, names)
        plan = replace(plan, task=task, notes=tuple(dict.fromkeys((*plan.notes, *notes))))
        plan = in_cabinets(plan, *self._cabinet_said(prompt))
        plan = with_doors(audited(plan, self._nouns.resolve, lexicon.FLOOR, self._likely.carried))
        return replace(plan, notes=tuple(dict.fromkeys((*plan.notes, *put_otherwise(world, names)))))

    def _cabinet_said(self, prompt: str) -> tuple[str, tuple[str, ...]]:
        """What `prompt` calls the furniture that drawers are in, and its colours; nothing where it names none."""
        words = [token.text for token in tokenise(normalise(prompt))]
        for length in (2, 1):
            for at in range(len(words) - length + 1):
                found = self._nouns.match(words[at : at + length])
                if found is not None and found.noun in CABINETS and words[at] not in ("drawer", "drawers"):
                    before = words[at - 1] if at else ""
                    return " ".join(words[at : at + length]), (before,) if before in COLOURS else ()
        return "", ()

    def _read(self, text: str, clause: Clause, world: World, company: Collection[str]) -> tuple[World, World | None]:
        """`world` with what `clause` says, without its remarks where they cannot be read.

        Second is the next likely reading where it is nearly as likely.
        """
        if clause.first:
            world.settled, world.emptied = len(world.groups), []
        for find in (partial(lettering, text), partial(sensed, nouns=self._nouns), partial(similes, nouns=self._nouns)):
            spans = find(clause.tokens)
            for start, end in spans:
                world.note(f'not modelled: "{quoted(text, clause.tokens[start:end]).strip(" ,")}"')
            clause = replace(clause, tokens=without(clause.tokens, spans))
        for aside in clause.aside:
            world.note(f'not modelled: "{aside}"')
        if clause.heading:
            # "Sort the toys: put the cars in the box": the cars are the toys.
            world.note(f'not modelled: "{clause.said}"')
            return world, None
        several = len(world.groups) > 1 and [token.text for token in clause.tokens[:3]] in _COLOURS_ARE
        if several:
            # "An orange and a melon. The colors are bright, orange and green": which has which is not said.
            world.note(f'not modelled: "{quoted(text, clause.tokens[:-1])}"')
            return world, None
        if clause.verb in ("ensure", "ensuring") and self._adds_nothing(clause, world, None):
            world.note(f'not modelled: "{clause.said}": no task does that.')
            return world, None
        try:
            return self._told(text, clause, copied(world), company)
        except UnreadError as error:
            first = failure = error
        spans = Remarks(clause.tokens, self._nouns).spans()[:REMARKS]
        for left_out in [[span] for span in spans] + ([spans] if len(spans) > 1 else []):
            lighter = copied(world)
            kept = doing_nothing(clause.tokens, left_out)
            if not Remarks(kept, self._nouns).things():
                continue
            for start, end in left_out:
                lighter.note(f'not modelled: "{quoted(text, clause.tokens[start:end])}"')
            try:
                return self._told(text, replace(clause, tokens=kept), lighter, company)
            except UnreadError as error:
                failure = failure if isinstance(error, UnknownNounError) else error
            except PromptError:
                continue
        if (told := self._without_tails(text, clause, world, company, failure)) is not None:
            return told
        if isinstance(failure, UnknownNounError) and (spelled := self._respelled(clause, failure.phrase)) is not None:
            said = failure.phrase.head
            world.note(f'"{said}" is read as "{" ".join(self._nouns.respelled(said))}".')
            return self._read(text, spelled, world, company)
        if self._adds_nothing(clause, world, failure):
            done = ": no task does that." if clause.manner is not None else ""
            world.note(f'not modelled: "{clause.said or quoted(text, clause.tokens[:-1])}"{done}')
            return world, None
        tails = Tails(clause.tokens, self._nouns, _known(world))
        if told := self._without_one(text, clause, world, company, tails.loose(failure.number)):
            return told
        if told := self._beside(text, clause, world, company, tails.unrelated(failure.number)):
            return told
        fault = first if isinstance(first, UnknownNounError) else self._fault(clause, failure)
        if (told := self._in_pieces(text, clause, world, company, fault)) is not None:
            return told
        raise fault

    def _beside(
        self, text: str, clause: Clause, world: World, company: Collection[str], verbs: Sequence[Span]
    ) -> tuple[World, World | None] | None:
        """`world` with what `clause` says, one of `verbs` read as "is next to"; None where it is not read so."""
        for start, end in verbs if clause.manner is None else ():
            verb = clause.tokens[start]
            said = ("next", "to") if verb.text.endswith("ing") else ("is", "next", "to")
            kept = [replace(verb, text=word) for word in said]
            nearer = copied(world)
            nearer.note(f'"{quoted(text, clause.tokens[start:end])}" is read as "next to".')
            plain = replace(clause, tokens=(*clause.tokens[:start], *kept, *clause.tokens[end:]))
            try:
                return self._told(text, plain, nearer, company)
            except PromptError:
                continue
        return None

    def _fault(self, clause: Clause, failure: UnreadError) -> PromptError:
        """`failure`, or that a thing of `clause` is not in the catalogue where only some other word was not read."""
        at_fault = {token.text for token in clause.tokens if token.number == failure.number}
        if isinstance(failure, UnknownNounError) or failure.number == 0 or at_fault & lexicon.MEALS:
            return failure
        for token in Tails(clause.tokens, self._nouns, {}).unknown():
            if not self._maker.no_thing(token.text):
                return self._maker.unknown(
                    Phrase(kind="unknown", head=token.text, number=token.number, determined=True)
                )
        return failure

    def _without_tails(
        self, text: str, clause: Clause, world: World, company: Collection[str], failure: UnreadError
    ) -> tuple[World, World | None] | None:
        """`world` with what `clause` says around what names nothing at its word at fault; None without."""
        tails = Tails(clause.tokens, self._nouns, _known(world))
        if world.groups and clause.manner is None and (tails.whole() or tails.depicts(_known(world))):
            world.note(f'not modelled: "{quoted(text, clause.tokens[:-1])}"')
            return world, None
        return self._without_one(text, clause, world, company, tails.around(failure.number))

    def _without_one(
        self, text: str, clause: Clause, world: World, company: Collection[str], spans: Sequence[Span], depth: int = 1
    ) -> tuple[World, World | None] | None:
        """`world` with what `clause` says without the first of `spans` without which it is read; None without.

        Where none is enough, another such span is left out as well, `depth` times.
        """
        further: list[tuple[Clause, World, int]] = []
        for start, end in spans:
            look = clause.tokens[start - 1].text if start else ""
            if is_colour_word(look) and not find_material(look) and self._nouns.match([look]):
                # Without its "cover" an orange cover would be an orange.
                start -= 1
            lighter = copied(world)
            lighter.note(f'not modelled: "{quoted(text, clause.tokens[start:end])}"')
            kept = replace(clause, tokens=without(clause.tokens, [(start, end)]))
            if not (world.groups or Remarks(kept.tokens, self._nouns).things()):
                continue
            try:
                return self._told(text, kept, copied(lighter), company)
            except UnreadError as error:
                further.append((kept, lighter, error.number))
            except PromptError:
                continue
        for kept, lighter, number in further[:TAILS] if depth else ():
            around = Tails(kept.tokens, self._nouns, _known(world)).around(number)
            if told := self._without_one(text, kept, lighter, company, around, depth - 1):
                return told
        return None

    def _adds_nothing(self, clause: Clause, world: World, failure: PromptError | None) -> bool:
        """Whether `clause`, which cannot be read, only tells more of what was named, or asks what no task does."""
        known = [group.noun for group in world.groups]
        sentence = Tails(clause.tokens, self._nouns, {})
        if not known or clause.manner not in (None, "other") or not sentence.adds_nothing(known):
            return False
        # "The challenge lies in the angles": of nothing that is there.
        if not isinstance(failure, UnknownNounError):
            return True
        shadows = lexicon.BACKGROUND & set(failure.phrase.modifiers.adjectives)
        return bool(shadows) or (failure.phrase.definite and not sentence.things())

    def _respelled(self, clause: Clause, phrase: Phrase) -> Clause | None:
        """`clause` with the head of `phrase` as the name that it is a misspelling of; None where it is none."""
        words = self._nouns.respelled(phrase.head)
        at = next((at for at, token in enumerate(clause.tokens) if token.text == phrase.head), None)
        if not words or at is None:
            return None
        said = [replace(clause.tokens[at], text=word) for word in words]
        return replace(clause, tokens=(*clause.tokens[:at], *said, *clause.tokens[at + 1 :]))

    def _told(self, text: str, clause: Clause, world: World, company: Collection[str]) -> tuple[World, World | None]:
        """`world` with what `clause` says, and the next likely reading where it is nearly as likely."""
        sentence = Cutter(text, clause.tokens, self._nouns, company).cut()
        known = [group.phrase for group in world.groups if not group.replaced]
        chunks = completed(trimmed(sentence.chunks), self._nouns, known, sentence.doubts)
        chunks = chunks if clause.manner is not None else vessels_meant(chunks, known)
        world.hear(sentence)
        for word in sentence.unread:
            world.note(_CHOICE if word == "or" else f'not modelled: "{word}"')
        if not any(chunk.kind == "noun" for chunk in chunks):
            for chunk in chunks:
                if chunk.kind in ("rel", "have", "place", "quality", "form"):
                    world.note(f'not understood: "{chunk.text}"')
            if clause.manner is not None:
                world.note(f'not modelled: "{clause.said}": it names no object.')
            return world, None
        readings, chunks = covering(chunks, clause, world, self._maker, self._nouns)
        tried: list[tuple[float, World]] = []
        error: PromptError | None = None
        for reading in readings[:TRIED]:
            trial = copied(world)
            try:
                cost = reading.cost + Interpreter(trial, chunks, self._maker, clause).add(reading)
                refuse_both_sides(trial)
            except PromptError as caught:
                error = error or caught
                continue
            tried.append((cost, trial))
        if not tried:
            raise error or PromptError(f'cannot read "{clause.said}". Say one thing a sentence.')
        tried.sort(key=lambda each: each[0])
        best, first = tried[0]
        rivals = (trial for cost, trial in tried[1:]
                  if cost - best < CLOSE and (trial.rivals(first) or attached_higher(trial, first)))  # fmt: skip
        return first, next(rivals, None)


def _relations(plan: ScenePlan) -> tuple[set[str], set[Relation], set[tuple[str, str, str]]]:
    """What there is, what carries it, and what stands where beside what, said of either of the two."""
    beside = [each for each in plan.relations if not each.supports]
    turned = {(each.parent, OPPOSITE[each.kind], each.child) for each in beside if each.kind in OPPOSITE}
    plain = {(each.child, each.kind, each.parent) for each in beside}
    return {obj.name for obj in plan.objects}, set(plan.relations) - set(beside), plain | turned


def _known(world: World) -> dict[str, str]:
    """The catalogue nouns of `world`, with the words they were in."""
    return {group.noun: group.words.lower() for group in world.groups}
