"""What the rules of the grammar ask of phrases: what they name, whether they speak of one another, what is likely."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.parsing.chart import Node
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexicon import DEMONSTRATIVES, FIGURES, LEVEL, TELLING
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.sizes import too_large
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_OF_ONE = frozenset({"is", "was", "sits", "stands", "lies", "rests", "hangs", "leans", "has", "holds", "contains"})
HEADLESS = ("pieces", "part")

_NATURAL = 0.25
"""Cost of a relation below which people expect it."""
_CARRYING = 0.35
"""Cost of being on something below which that can carry it."""
_HELD_BY_SUBJECT = 0.4
"""Cost of what a clause is about not being what is "holding" something at its end."""
_HELD = 0.2
"""Cost of holding something below which it is usual."""
_HOLDING = ("holding", "containing", "carrying", "bearing")
_HARDLY_IN = 1.0
"""Cost of being in something from which on that is not thought of."""
_HARDLY = 3.0
"""Cost of what hardly happens."""


class Judging:
    """Questions about the chunks of one sentence."""

    def __init__(self, chunks: Sequence[Chunk], likely: Plausible) -> None:
        self._chunks = chunks
        self._likely = likely

    def _phrase(self, at: int) -> Phrase:
        return self._chunks[at].named

    def _link(self, at: int) -> Link:
        return self._chunks[at].relation

    def _noun(self, at: int) -> str:
        if self._phrase(at).head == "another":
            return self._kind_of_another(at)
        return self._likely.fits(self._phrase(at))

    def _kind_of_another(self, at: int) -> str:
        """The noun of the only thing before chunk `at` that is no place of another: the cups of "a cup on a desk"."""
        told = (before for before in range(at) if not before or self._chunks[before - 1].kind != "rel")
        phrases = (phrase for before in told if (phrase := self._chunks[before].phrase) is not None)
        named = {self._likely.fits(phrase) for phrase in phrases if phrase.kind == "object"}
        return named.pop() if len(named) == 1 else ""

    def _both_places(self, outer: tuple[int, ...], nearer: tuple[int, ...]) -> float:
        """Cost of `outer` not being beside `nearer`, which may stand on it."""
        holds = min(self._likely.having(Link(manner="with"), self._noun(outer[0]), self._noun(head)) for head in nearer)
        return 0.05 if holds < _HELD else 0.25

    def _again(self, head: int, facts: tuple[tuple, ...]) -> float:
        """The cost of a second support for what has one."""
        told = (fact for fact in facts if fact[0] == "rel" and head in fact[2] and len(fact[2]) == 1)
        return 0.25 if any(self._link(fact[1]).kind in SUPPORT_KINDS for fact in told) else 0.0

    def _named_again(self, head: int, named: Node) -> bool:
        """Whether `head` speaks of `named`, or of what it stands by: "a knife on a board, with a fork by the board"."""
        phrase = self._phrase(head)
        same = phrase.definite and any(_same(self._phrase(each), phrase) for each in named.heads)
        return same or self._said_of(named, head)

    def _said_of(self, named: Node, parent: int) -> bool:
        """Whether `named` is related to what `parent` speaks of already, or has it.

        "a pot on the stove ... beside the stove", "a plate with a knife, ... behind the knife", "a monitor with a mouse
        beside it ... behind the mouse"
        """
        phrase = self._phrase(parent)
        if not phrase.definite:
            return False
        related = [(fact[2], fact[3][:1]) for fact in named.facts if fact[0] == "rel"]
        related += [(fact[2], fact[3]) for fact in named.facts if fact[0] == "have"]
        related += [(fact[3], fact[2]) for fact in named.facts if fact[0] == "place"]
        its = {fact[1]: fact[2] for fact in named.facts if fact[0] == "bind"}
        related += [(its[at], fact[2]) for fact in named.facts if fact[0] == "rel" for at in fact[3][:1] if at in its]
        return any(
            set(those) & set(named.heads) and any(_same(self._phrase(head), phrase) for head in by)
            for those, by in related
        )

    def _again_named(self, head: int, heads: tuple[int, ...]) -> bool:
        """Whether `head` speaks of one of `heads`: "a basket and a jar in front of the jar", "in front of each"."""
        phrase = self._phrase(head)
        same = phrase.definite and not phrase.other and any(_same(self._phrase(each), phrase) for each in heads)
        told = phrase.kind == "pieces" and phrase.definite and phrase.modifiers.adjectives
        member = told and any(self._phrase(each).kind == "object" and self._several(each) for each in heads)
        # "two blue, and a green one on top of a blue one"
        colours = phrase.kind == "pieces" and phrase.modifiers.colours
        coloured = colours and any(self._phrase(each).modifiers.colours == colours for each in heads)
        return (
            same
            or bool(member or coloured)
            or (phrase.head == "each" and len(heads) > 1 and not self._named_before(heads[0]))
        )

    def _ranked(self, heads: tuple[int, ...]) -> bool:
        """Whether `heads` are likes told by their places: "on the left table and the right table" is on both."""
        told = all(self._phrase(head).definite and self._adjectives(head) & TELLING for head in heads)
        return told and len({*map(self._noun, heads)}) == 1

    def _adjectives(self, head: int) -> set[str]:
        return set(self._phrase(head).modifiers.adjectives)

    def _on_one(self, heads: tuple[int, ...], parent: int) -> float:
        """The cost of furniture on "the right one", with what stands on that: "a sofa with ... and a book on it"."""
        furniture = any(self._likely.floor(self._noun(head)) for head in heads[:-1])
        return 0.4 * (furniture and self._phrase(parent).kind in HEADLESS)

    def _named_before(self, at: int) -> bool:
        """Whether several objects are named before chunk `at`: "two boxes with a ball and a cup in each" of them."""
        named = [head for head in range(at) if self._chunks[head].phrase and self._phrase(head).kind == "object"]
        return len(named) > 1 or any(self._several(head) for head in named)

    def _carrier(self, head: int, facts: tuple[tuple, ...]) -> int:
        """What "with a lamp on two books" has: the books."""
        for fact in facts:
            if fact[0] != "rel" or head not in fact[2]:
                continue
            link, parent = self._link(fact[1]), fact[3][0]
            carried = link.kind in SUPPORT_KINDS and link.manner == "place"
            if carried and self._phrase(parent).kind in ("object", "unknown"):
                return parent
        return head

    def _stands(self, node: Node) -> bool:
        """Whether what `node` tells of is said to be on or in something, and does not hang."""
        head = node.heads[0]
        hung = any(
            fact[0] == "rel" and head in fact[2] and self._link(fact[1]).kind == "hangs_from" for fact in node.facts
        )
        return not hung and self._carrier(head, node.facts) != head

    def _arcs(self, link: Link, children: tuple[int, ...], parents: tuple[int, ...]) -> float:
        costs = [self._likely.relation(link, self._noun(c), self._noun(p)) for c in children for p in parents]
        if link.kind == "in" and link.manner == "place" and len(parents) == 1 < len(children):
            # What is in one thing together is as unlikely as the unlikeliest.
            large = any(too_large(self._noun(child), self._noun(parents[0])) for child in children)
            return max(*costs, 1.3 * large)
        return sum(costs) / max(len(costs), 1)

    def _carries_it(self, link: Link, named: Node, modifier: Node) -> float:
        """How surely what is "on it" in `modifier` is on `named`: "a plate on a desk with a bun on it".

        As much where it is said on which part: "a plate in the corner of a desk with a bun on it"; and of what is
        only beside something where nothing is put on that: "a plate next to a radio with a bun on it".
        """
        rests = (link.kind in SUPPORT_KINDS and link.manner == "place") or link.manner in ("edge", "half")
        beside = link.kind in LATERAL_KINDS and link.manner == "place"
        if not (rests or beside) or len(named.heads) != 1:
            return 0.0
        its = {fact[1] for fact in modifier.facts if fact[0] == "bind" and fact[2] == modifier.heads}
        rels = [fact for fact in modifier.facts if fact[0] == "rel" and its & set(fact[3])]
        carried = [fact for fact in rels if self._link(fact[1]).kind in SUPPORT_KINDS]
        owner = self._noun(named.heads[0])
        costs = [self._likely.relation(self._link(fact[1]), self._noun(fact[2][0]), owner) for fact in carried]
        # "On top of it" is said where a table carries more than this: "a radio on a desk with a cup on top of it".
        on_top = any("top" in (*self._chunks[fact[1]].words, *self._chunks[fact[3][0]].words) for fact in carried)
        cost = min(costs, default=_HARDLY)
        if beside:
            landmark = self._noun(modifier.heads[0])
            borne = (self._likely.relation(self._link(fact[1]), self._noun(fact[2][0]), landmark) for fact in carried)
            return 0.3 * (cost < _NATURAL < min(borne, default=0.0))
        if cost < _CARRYING and on_top:
            return 0.7
        within = [self._noun(fact[2][0]) for fact in carried if self._link(fact[1]).kind == "in"]
        if within and not self._likely.hollow(self._noun(modifier.heads[0])) and self._may_hold(owner, within):
            # "A jar on a shelf with a nut in it"
            return 0.5
        return 0.5 if cost < _NATURAL else 0.4 if cost < _CARRYING else 0.0

    def _holds_itself(self, named: Node, modifier: Node) -> float:
        """How surely `named`, and not what `modifier` says it is on, is ", holding" what is said behind that."""
        below = modifier.heads[0]
        held = [fact[1] for fact in modifier.facts if fact[0] == "have" and fact[2] == (below,)]
        set_off = [at for at in held if self._chunks[at - 1].kind == "joint" and self._chunks[at].words[0] in _HOLDING]
        # "A doll sits on a chair, holding a flower"
        return len(set_off) * (0.9 if self._likely.is_a(self._noun(named.heads[0]), FIGURES) else _HELD_BY_SUBJECT)

    def _has_sides(self, named: Node, modifier: Node) -> float:
        """How surely "with a vase in the middle" is said of the table `named`, and not of the chair in `modifier`."""
        sided = [fact for fact in modifier.facts if fact[0] == "place" and fact[3] == modifier.heads]
        told = any(self._chunks[fact[1]].link is None for fact in sided)
        tables = [self._likely.is_a(self._noun(node.heads[0]), LEVEL) for node in (named, modifier)]
        return _HELD_BY_SUBJECT * (told and tables == [True, False])

    def _beside_too(self, named: Node, modifier: Node) -> float:
        """How surely "and to the right of the sink" is not said of the landmark `named` that stands before it."""
        before = self._chunks[named.start - 1] if named.start else None
        beside = before is not None and before.kind == "rel" and before.relation.kind in LATERAL_KINDS
        kind, at = modifier.mod  # type: ignore[misc]
        return 1.0 * (beside and kind == "link" and self._link(at).kind in LATERAL_KINDS)

    def _owned_again(self, at: int, start: int) -> bool:
        """Whether "on its right" at chunk `at` follows "on its left" before chunk `start`, of the same thing."""
        across = {"left": "right", "right": "left"}.get(self._chunks[at].text)
        sides = [chunk for chunk in self._chunks[:start] if chunk.kind == "place" and chunk.link is None]
        return self._chunks[at].link is None and any(chunk.text == across for chunk in sides)

    def _may_hold(self, owner: str, children: Sequence[str]) -> bool:
        """Whether all `children` may be in `owner`, which may be "another one"."""
        fits = all(self._likely.within(child, owner) < _HARDLY_IN for child in children) if owner else True
        return fits and (not owner or self._likely.hollow(owner))

    def _is_pronoun(self, heads: tuple[int, ...]) -> bool:
        return len(heads) == 1 and (
            (self._phrase(heads[0]).kind == "pronoun" and self._phrase(heads[0]).head not in DEMONSTRATIVES)
            or (self._phrase(heads[0]).kind == "part" and self._phrase(heads[0]).possessive)
        )

    def _behind_it(self, at: int) -> bool:
        """Whether chunk `at` stands behind "in it", "on them"."""
        return self._chunks[at - 1].kind == "noun" and self._is_pronoun((at - 1,))

    def _means(self, heads: tuple[int, ...], owners: tuple[int, ...]) -> bool:
        """Whether the pronoun `heads` may mean `owners`."""
        plural = len(owners) > 1 or any(self._several(owner) for owner in owners)
        if self._only_background(owners):
            return False
        return self._is_pronoun(heads) and (plural or self._phrase(heads[0]).head not in ("them", "they"))

    def _one_of(self, heads: tuple[int, ...], owners: tuple[int, ...]) -> bool:
        """Whether `heads` is one of `owners` told by its place: "the last one", "the top book"."""
        phrase = self._phrase(heads[0])
        told = len(heads) == 1 and phrase.definite and set(phrase.modifiers.adjectives) & TELLING
        nouns = {self._phrase(owner).noun for owner in owners if self._several(owner)}
        return bool(told and nouns) and (phrase.kind == "pieces" or phrase.noun in nouns)

    def _each_of(self, heads: tuple[int, ...], owners: tuple[int, ...]) -> bool:
        """Whether `heads` is "each", and `owners` are several."""
        return self._phrase(heads[0]).head == "each" and any(self._several(owner) for owner in owners)

    def _each_else(self, heads: tuple[int, ...], owners: tuple[int, ...]) -> bool:
        """Whether `heads` is "each" of what is named up to `owners`: not only of these."""
        return self._phrase(heads[0]).head == "each" and self._named_before(max(owners) + 1)

    def _some_of(self, at: int) -> bool:
        """Whether chunk `at` speaks of some of what is named before: "three of them", "the red ones", "the rest"."""
        phrase = self._chunks[at].phrase if at >= 0 else None
        ones = phrase is not None and (phrase.head in ("rest", "others") or phrase.words.lower().endswith(" ones"))
        return phrase is not None and phrase.kind == "pieces" and (ones or (phrase.count or 1) > 1)

    def _several(self, at: int) -> bool:
        phrase = self._phrase(at)
        return phrase.several or phrase.kind in ("pronoun", "pieces", "items")

    def _definite(self, heads: tuple[int, ...]) -> bool:
        """Whether all `heads` are spoken of as known: "the clock"."""
        return all(self._phrase(head).definite and self._phrase(head).kind not in HEADLESS for head in heads)

    def _said_of_several(self, heads: tuple[int, ...], verb: int) -> bool:
        """Whether the verb at chunk `verb` is of several and `heads` are one: "are" + "a jar that holds a nut"."""
        phrase = self._phrase(heads[0])
        one = len(heads) == 1 and phrase.kind == "object" and not phrase.plural and (phrase.count or 1) == 1
        one = one and phrase.height is None and not phrase.cycle and not phrase.some
        return one and self._chunks[verb].words[-1:] != () and self._chunks[verb].words[-1] in lexicon.OF_SEVERAL

    def _of_several(self, verb: int) -> bool:
        """Whether the verb at chunk `verb` is of several things: "hold"."""
        return self._chunks[verb].words[:1] != () and self._chunks[verb].words[0] in lexicon.OF_SEVERAL

    def _disagrees(self, heads: tuple[int, ...], verb: int) -> bool:
        """Whether the verb at chunk `verb` is of one thing and `heads` are several, or the other way round."""
        word = self._chunks[verb + (self._chunks[verb].kind == "joint")].words[:1]
        named = [self._phrase(head) for head in heads]
        if word and len(named) == 1 and named[0].kind == "pieces" and named[0].count == 1:
            # "A bottle and two glasses, one of which is red, stand": not the one.
            return word[0] in lexicon.OF_SEVERAL
        if not word or any(phrase.kind != "object" or phrase.cycle for phrase in named):
            return False
        several = len(named) > 1 or named[0].several
        stacked = named[0].height is not None or named[0].some == 1
        return not stacked and ((word[0] in _OF_ONE and several) or (word[0] in lexicon.OF_SEVERAL and not several))

    def _kind_named(self, start: int, end: int) -> int | None:
        """The last phrase from chunk `start` to `end` that names a kind of things, of which a list may follow."""
        phrases = ((at, self._chunks[at].phrase) for at in range(end - 1, start - 1, -1))
        return next((at for at, phrase in phrases if phrase is not None and phrase.cycle), None)

    def _one_more(self, head: int) -> bool:
        """Whether "two green ones" names more objects of a kind and tells nothing of those before."""
        phrase = self._phrase(head)
        return phrase.words.split()[-1:] in (["one"], ["ones"]) and bool(phrase.modifiers.colours)

    def _says_nothing(self, head: int, facts: tuple[tuple, ...]) -> bool:
        phrase = self._phrase(head)
        words, place = phrase.modifiers, set(phrase.modifiers.adjectives) & TELLING
        if phrase.definite and not place:
            # "The red one" tells which.
            return not any(head in fact[2] for fact in facts if len(fact) > 2)
        told = words.colours or words.palette or words.size_word or words.material or words.postures
        told = told or set(words.adjectives) - place
        return not told and not any(head in fact[2] for fact in facts if len(fact) > 2)

    def _only_background(self, heads: tuple[int, ...]) -> bool:
        return all(self._phrase(head).kind == "background" and not self._phrase(head).substance for head in heads)


def _same(one: Phrase, other: Phrase) -> bool:
    """Whether the two may name the same object: a red mug is no blue one, "the mat" may be a yoga mat."""
    ours, theirs = one.modifiers, other.modifiers
    apart = ours.colours and theirs.colours and ours.colours != theirs.colours
    sizes = ours.size_word and theirs.size_word and ours.size_word != theirs.size_word
    shortened = bool(other.said) and one.said.split()[-1:] == [other.said]
    return bool(one.noun) and (one.noun == other.noun or shortened) and not apart and not sizes
