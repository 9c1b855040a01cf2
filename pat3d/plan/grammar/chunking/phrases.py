"""Noun phrases: determiner, count, modifiers, head ("two large red-handled wooden brushes")."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from pat3d.assets.materials import find_material
from pat3d.plan.grammar.words import lexicon, shapes, vessels
from pat3d.plan.grammar.words.boundaries import Boundaries
from pat3d.plan.grammar.words.determiners import opening
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import (
    NO_MODIFIERS,
    TOLD_BY_PLACE,
    Modifiers,
    is_modifier,
    read_modifiers,
    telling,
)
from pat3d.plan.grammar.words.senses import PACKED
from pat3d.plan.grammar.words.shapes import PYRAMID, RINGS, USUAL_PYRAMID, can_be_pyramid, grid_size, refuse, shape_said
from pat3d.plan.grammar.words.vocabulary import Nouns

PhraseKind = Literal["object", "background", "items", "part", "pieces", "pronoun", "unknown"]
_FURTHER = (["second"], ["third"], ["fourth"], ["fifth"])  # what one more of a kind is called
_FIGURES = ("figure", "figures", "replica", "replicas")
_PLAYERS = (["cat"], ["pet"], ["baby"])  # whose toys do not look like them
_CUTS = frozenset({"wedge", "slice", "chunk", "segment", "half"})
_THESE = frozenset({"these", "those"})
_MEMBERS = frozenset({"others", "rest", "remainder", "former", "latter"})
"""Heads that speak of what was named before."""


@dataclass(frozen=True, kw_only=True)
class Phrase:
    """What one noun phrase says."""

    kind: PhraseKind
    words: str = ""
    """As written in the prompt."""
    head: str = ""
    number: int = 0
    """Position of the head in the prompt [words, from 1]."""
    noun: str = ""
    said: str = ""
    count: int | None = None
    """None where the prompt gives none."""
    vague: bool = False
    plural: bool = False
    determined: bool = False
    """Opens with a determiner or a number."""
    definite: bool = False
    each: bool = False
    superlative: Modifiers = NO_MODIFIERS
    """What tells one of them: "the smallest of three boxes"."""
    some: int = 0
    """How many of them are meant: 2 for "two of the five boxes"; 0 for all."""
    possessive: bool = False
    other: bool = False
    """Read "the other mug": not the one named before."""
    cycle: tuple[str, ...] = ()
    """Nouns standing in turn for a generic ("fruit")."""
    modifiers: Modifiers = NO_MODIFIERS
    height: int | None = None
    """Objects in one stack; 0 for a stack of unstated height."""
    chains: int = 1
    """Number of stacks."""
    pyramid: bool = False
    """Stands in a pyramid, every one of the upper ones on two."""
    heap: bool = False
    """Lies in a heap that is no stack: "a pile of toys"."""
    rows: int = 0
    """Rows that they stand in; 0 where nothing is said."""
    part: str = ""
    """The part of it that is spoken of: "drawer" for "the top drawer of a desk"."""
    left_out: str = ""
    """What stands after "of" and means nothing here."""
    substance: str = ""
    """Content that is no rigid body ("tea")."""

    @property
    def opening(self) -> str:
        """The first word as it is said; empty where a rewriting has put the phrase together."""
        return next(iter(self.words.lower().split()), "")

    @property
    def closing(self) -> str:
        """The last word as it is said; empty where a rewriting has put the phrase together."""
        return next(reversed(self.words.lower().split()), "")

    @property
    def several(self) -> bool:
        """Whether it names more than one."""
        return self.plural or (self.count or 1) > 1


_STUFF = (["straw"], ["stone"], ["cloth"], ["cork"], ["rope"], ["foam"])
"""What "a ..." is a thing of its own, and before a noun a material."""

_DRAWN = frozenset({"square", "squares", "circle", "circles", "rectangle", "rectangles"})


class PhraseReader:
    """Reads noun phrases from the tokens of one prompt."""

    def __init__(self, text: str, tokens: Sequence[Token], nouns: Nouns) -> None:
        self._text = text
        self._tokens = tokens
        self._nouns = nouns
        self._bounds = Boundaries(tokens, nouns)
        self._definite = False

    def read(self, start: int, depth: int = 0) -> tuple[Phrase, int] | None:
        """The phrase that begins at token `start` and the token after it; None where no phrase begins there."""
        at, count, flags = opening(self._tokens, start)
        self._definite = flags.get("definite", False)
        (run, after), tokens = self._bounds.run(at), self._tokens
        another = flags.pop("another", False)
        flags["other"], own = flags.get("other", False) or another, NO_MODIFIERS
        if not self._definite and count is None and [token.text for token in run[1:]] == ["one"]:
            # "Another red one"
            own = read_modifiers([run[0].text]) if another else own
            another = another or run[0].text in ("third", "fourth", "fifth")
            run = run[1:] if another else run
        elif not self._definite and count is None and [token.text for token in run] in _FURTHER:
            # "a second behind it and a third on top"
            another, run = flags.get("determined", False), run[1:] if flags.get("determined") else run
        if another and (not run or [token.text for token in run] in (["one"], ["ones"])):
            words = self._text[tokens[start].start : tokens[after - 1].end]
            said = Phrase(kind="pronoun", head="another", words=words, number=tokens[after - 1].number)
            return replace(said, count=count, modifiers=own), after
        if not run:
            if after == start:
                return None
            rest = tokens[after - 1].text == "other"
            phrase = Phrase(kind="pieces" if count is not None or rest else "pronoun", head=tokens[after - 1].text)
            if tokens[after].text == "of" and tokens[after + 1].text in lexicon.PRONOUNS | _THESE:
                after += 2
            if (
                count is not None
                and tokens[after].text == "of"
                and depth < 3
                and (inner := self.read(after + 1, depth + 1))
            ):
                single = flags.get("one", False) and not flags.get("each", False)
                count = None if flags.get("each", False) else count
                phrase, after = replace(inner[0], definite=inner[0].definite or single), inner[1]
                if single and ((phrase.count or 1) > 1 or (phrase.plural and phrase.definite)):
                    phrase, count = replace(phrase, some=1), phrase.count
                elif count is not None and 1 < count < (phrase.count or 0) and phrase.definite:
                    phrase, count = replace(phrase, some=count), phrase.count
        elif tokens[after].text == "of" and depth < 3 and (joined := self._of(run, after, count, depth)):
            phrase, after = joined
            count = phrase.count
        elif tokens[after].text == "of" and run[-1].text in lexicon.PICTURES:
            phrase = Phrase(kind="background", head=run[-1].text, number=run[-1].number)
        else:
            if run[-1].text in _MEMBERS and len(run) == 1 and flags.get("definite"):
                words = self._text[run[0].start : run[0].end]
                return Phrase(kind="pieces", head=run[0].text, number=run[0].number, words=words), after
            if flags.get("definite") and (told := telling(run)) is not None:
                return self._told(start, after, run[0], told, depth)
            if run[-1].text == "one" and flags.get("determined"):
                count = count or 1
            if len(run) == 2 and run[1].text == "one" and run[0].text in TOLD_BY_PLACE and not flags.get("definite"):
                words = self._text[tokens[start].start : tokens[after - 1].end]
                return Phrase(kind="pronoun", head="another", words=words, number=run[1].number), after
            drawn = run[-1].text in _DRAWN and tokens[after].text == "on" and tokens[after + 1].text in lexicon.PRONOUNS
            phrase = self._part(run, count) if drawn else self._simple(run, count)
        flags.pop("one", None)
        whole = phrase.kind == "object" and bool(phrase.noun) and not phrase.plural
        if flags.get("vague") and whole and (phrase.said in lexicon.PLURAL_ONLY or phrase.said in lexicon.BUNCHES):
            # "Some scissors" are one, and "a few grapes" one bunch.
            count, flags = 1, {**flags, "vague": False}
        words = self._text[tokens[start].start : tokens[after - 1].end]
        number = phrase.number or tokens[after - 1].number
        flags["other"] &= phrase.part not in lexicon.ENDS  # "The other side of the table" is of one table.
        merged = {key: value or getattr(phrase, key) for key, value in flags.items()}
        return replace(
            phrase, words=words, count=count if count is not None else phrase.count, number=number, **merged
        ), after

    def _told(self, start: int, after: int, word: Token, told: Modifiers, depth: int) -> tuple[Phrase, int]:
        """The phrase of "the second", "the top one", "the smallest of three boxes", "the last of them"."""
        tokens = self._tokens
        if tokens[after].text == "of" and tokens[after + 1].text in lexicon.PRONOUNS | _THESE:
            after += 2
        elif tokens[after].text == "of" and depth < 3 and (inner := self.read(after + 1, depth + 1)):
            words = self._text[tokens[start].start : tokens[inner[1] - 1].end]
            return replace(inner[0], words=words, definite=False, superlative=told), inner[1]
        words = self._text[tokens[start].start : tokens[after - 1].end]
        return Phrase(kind="pieces", head=word.text, number=word.number, words=words, determined=True, definite=True,
                      modifiers=told), after  # fmt: skip

    @staticmethod
    def _part(run: Sequence[Token], count: int | None) -> Phrase:
        """What is drawn on a thing, and is none beside it: "a mug with a dark square on it"."""
        head, modifiers = run[-1], read_modifiers([token.text for token in run[:-1]])
        return Phrase(kind="part", head=head.text, said=head.text, number=head.number, count=count, modifiers=modifiers)

    def _simple(self, run: list[Token], count: int | None) -> Phrase:
        """The phrase of a run without "of"."""
        words = [token.text for token in run]
        head, number = words[-1], run[-1].number
        if head in PACKED and self._definite and not (self._nouns.match([head]) or self._nouns.match(words[-2:])):
            packed = self._nouns.match(PACKED[head].split())
            if packed is not None:
                return Phrase(kind="object", head=head, number=number, count=count, noun=packed.noun, said=packed.said,
                              modifiers=read_modifiers(words[:-1]))  # fmt: skip
        base = Phrase(kind="unknown", head=head, number=number, count=count, modifiers=read_modifiers(words[:-1]))
        singular = (head, *singulars(head))
        for size in (2, 1):
            ends = [" ".join([*words[-size:-1], word]) for word in singular]
            generic = next((end for end in ends if len(words) >= size and end in lexicon.GENERICS), None)
            plural = head not in lexicon.GENERICS and head == words[-1] and len(singular) > 1
            longer = self._nouns.longest(words)
            if (
                generic
                and not (longer and len(longer[1]) > size)
                and (plural or generic in lexicon.MASS_GENERICS or size == 2 or not self._nouns.match([head]))
            ):
                cycle = self._known(lexicon.GENERICS[generic])
                owner = words[-size - 1 : -size]
                kind = self._nouns.match(owner) if generic == "toy" and owner not in _PLAYERS else None
                if kind is not None and not is_modifier(words[-size - 1]):
                    # "a dinosaur toy"
                    return replace(base, kind="object", noun=kind.noun, said=kind.said, plural=plural,
                                   modifiers=read_modifiers(words[: -size - 1]))  # fmt: skip
                if cycle:
                    return replace(base, kind="object", cycle=cycle, said=generic, noun="", plural=plural,
                                   modifiers=read_modifiers([*words[:-size], *words[-size:-1]]))  # fmt: skip
        shown = self._nouns.match(words[-2:-1]) if head in _FIGURES and not self._nouns.match(words[-2:]) else None
        if shown is not None and not is_modifier(words[-2]):
            # "the dinosaur figure"
            return replace(base, kind="object", noun=shown.noun, said=shown.said, plural=head.endswith("s"),
                           modifiers=read_modifiers(words[:-2]))  # fmt: skip
        closing = head in vessels.ON_RIMS and not self._definite
        if len(words) > 1 and head in lexicon.DETACHED and not closing and self._nouns.match(words[-2:]) is None:
            # "the top dresser drawer", "the cabinet shelf"
            whole = self._simple(run[:-1], count)
            inside = head not in lexicon.STORAGE_PARTS or self._nouns.of_class(whole.noun, lexicon.STORAGE)
            if whole.kind == "object" and not whole.cycle and inside and not is_modifier(words[-2]):
                return replace(whole, part=head)
        found = self._nouns.longest(words)
        if found is not None and not (head in lexicon.ITEMS and len(found[1]) == 1):
            match, used = found
            if match.said == "glasses" and (count or 0) > 1 and (drinking := self._nouns.match(["glass"])):
                match = replace(drinking, plural=True)
            rest = [word for index, word in enumerate(words) if index not in used]
            hidden = [word for word in match.said.split()[:-1] if word not in match.noun.split()]
            plural = match.plural and match.said not in lexicon.PLURAL_ONLY
            own = read_modifiers(rest, hidden, match.said.split()[-1])
            return replace(base, kind="object", noun=match.noun, said=match.said, plural=plural, modifiers=own)
        if len(words) > 1 and set(singular) & _CUTS and self._nouns.match(words[-2:-1]):
            # "three orange wedges"
            whole = self._simple(run[:-1], count)
            said = whole.modifiers.under(Modifiers(adjectives=(head,)))
            return replace(whole, plural=len(singular) > 1, modifiers=said)
        if any(word in lexicon.STACK_NOUNS for word in singular):
            return replace(base, kind="pieces", said="stack")
        if any(word in lexicon.PIECES for word in singular):
            return replace(base, kind="pieces")
        if head in lexicon.ITEMS:
            return replace(base, kind="items")
        if head in lexicon.BACKGROUND or " ".join(words[-2:]) in lexicon.BACKGROUND:
            return replace(base, kind="background")
        if any(word in lexicon.SUBSTANCES or (word in lexicon.ROWS and self._definite) for word in singular):
            return replace(base, kind="background", substance=head)  # "between the rows": nothing made
        if any(word in lexicon.PARTS for word in singular):
            whole = self._nouns.match(words[:-1]) if len(words) > 2 and self._definite else None
            if whole is not None:
                # "the stand mixer head"
                return replace(base, kind="object", noun=whole.noun, said=whole.said, part=head)
            return replace(base, kind="part", said=singular[-1])
        mark = (head, self._text.lower().count(head)) == ("square", 1)
        stuff = mark if self._definite else words in _STUFF and count is None
        if all(is_modifier(word) for word in words) and not stuff:
            return replace(base, kind="pieces", modifiers=read_modifiers(words))
        return base

    def _of(self, run: list[Token], at: int, count: int | None, depth: int) -> tuple[Phrase, int] | None:
        """The phrase of a run before the "of" at token `at`; None where "of" is a relation between two phrases."""
        words = [token.text for token in run]
        head, plural = words[-1], bool(singulars(words[-1]))
        singular = (head, *singulars(head))
        read = self.read(at + 1, depth + 1)
        if read is None:
            return None
        inner, after = read
        if inner.head in lexicon.SUBSTANCES and not inner.determined:
            inner = replace(inner, kind="background", substance=inner.head)
        if any(word in lexicon.STACK_NOUNS for word in singular):
            single = inner.determined and not inner.plural and inner.count in (None, 1) and not inner.cycle
            if inner.kind not in ("object", "unknown") or single:
                return None
            chains = count if count is not None else (2 if plural else 1)
            stated = inner.count if inner.count is not None and not (inner.count == 1 and not inner.plural) else 0
            own = read_modifiers(words[:-1])
            rolls = inner.cycle or self._nouns.of_class(inner.noun, lexicon.ROUND)
            flat = self._nouns.of_class(inner.noun, lexicon.PILES) or not inner.noun
            if lexicon.HEAPS & set(singular) or ("pile" in singular and (rolls or not flat)):
                amount = inner.count or lexicon.STACK_HEIGHT
                return replace(inner, count=amount * chains, vague=inner.count is None, heap=True,
                               modifiers=inner.modifiers.under(own)), after  # fmt: skip
            return replace(inner, height=stated, chains=chains, count=None if not stated else chains * stated,
                           modifiers=inner.modifiers.under(own)), after  # fmt: skip
        if (sides := grid_size(words)) and inner.kind in ("object", "unknown"):
            return replace(inner, count=sides[0] * sides[1], rows=sides[0], vague=False), after
        if RINGS & set(singular) and self._tokens[after].text in ("around", "surrounding") and inner.kind == "object":
            return inner, after
        amount = inner.count or USUAL_PYRAMID
        if head == PYRAMID and count in (None, 1) and can_be_pyramid(self._nouns, inner.noun, amount):
            own = inner.modifiers.under(read_modifiers(words[:-1]))
            return replace(inner, count=amount, vague=inner.count is None, pyramid=True, modifiers=own), after
        if head == shapes.GRID and count in (None, 1) and inner.kind == "object" and (inner.count or 0) > 1:
            own = inner.modifiers.under(read_modifiers(words[:-1]))
            return replace(inner, rows=shapes.grid_rows(inner.count or 0), modifiers=own), after
        if shape_said(head) and inner.kind in ("object", "unknown") and inner.several:
            others = [*(token for token in self._tokens if token.number < run[0].number), *self._tokens[after:]]
            if not any(self._nouns.match([token.text]) for token in others):
                raise refuse(head, run[-1].number)  # but "a spiral of cups on a table": the cups, and a note
            return replace(inner, modifiers=inner.modifiers.under(Modifiers(adjectives=(*words[:-1], head)))), after
        if head in lexicon.PICTURES:
            return None
        rows = any(word in lexicon.ROWS for word in singular)
        if rows and plural:
            number = (count or 2) * (inner.count or lexicon.BARE_PLURAL)
            return replace(inner, count=number, rows=count or 2, vague=inner.count is None,
                           modifiers=inner.modifiers.under(read_modifiers(words[:-1]))), after  # fmt: skip
        if rows or head in lexicon.COLLECTIVES:
            taken = {"pair": 2 * (count or 1), "couple": 2, "trio": 3, "dozen": 12, "pairs": 2 * (count or 2)}.get(head)
            if head in ("pair", "pairs") and inner.head in lexicon.PLURAL_ONLY:
                taken = count or (1 if head == "pair" else 2)
            taken = 3 if head in ("few", "handful", "number") else 5 if head in ("lot", "lots", "plenty") else taken
            if inner.kind == "background":
                return inner, after
            amount = inner.count if taken is None else taken
            if amount is None and inner.head in lexicon.ALIKE_IN_PLURAL:
                inner, amount = replace(inner, vague=True), lexicon.BARE_PLURAL
            if head in ("sets", "groups", "bunches", "bouquets", "collections", "clusters"):
                # "two sets of keys": how many are in each is not said.
                amount = (count or 2) * (inner.count or lexicon.BARE_PLURAL)
                inner = replace(inner, vague=inner.vague or inner.count is None)
            return replace(inner, count=amount, rows=int(rows) or inner.rows, vague=inner.vague,
                           modifiers=inner.modifiers.under(read_modifiers(words[:-1]))), after  # fmt: skip
        known = self._nouns.longest(words)
        pack = PACKED.get(inner.head, "") if head in lexicon.DETACHED and inner.kind == "background" else ""
        if (packed := self._nouns.match(pack.split())) is not None:  # "the cap of salt"
            return replace(inner, kind="object", noun=packed.noun, said=packed.said, substance="", part=head), after
        part = any(word in lexicon.PARTS for word in singular)
        if known is None:
            part = part and (inner.definite or not plural)
        elif inner.definite and (head in lexicon.DETACHED or self._built_in(singular, inner.noun)):
            part = True
        elif head in lexicon.FITTED and inner.definite:
            # "the top rack of the oven"
            part = self._nouns.of_class(inner.noun, (*lexicon.FLOOR, *vessels.CLOSED))
        else:
            # "one of the shelves of a bookcase", but not "a shelf of books".
            part = part and len(known[1]) == 1 and self._nouns.of_class(inner.noun, lexicon.LEVEL)
        if part and inner.kind in ("object", "pronoun", "background", "pieces", "items"):
            return replace(inner, count=inner.count if inner.kind == "object" else None, part=head), after
        if inner.kind == "background" and inner.substance:
            whole = self._simple(run, count)
            compound = self._nouns.match([inner.head, singular[-1]])
            if compound:
                return replace(whole, kind="object", noun=compound.noun, said=compound.said, plural=plural, count=count,
                               substance=inner.head), after  # fmt: skip
            return (replace(whole, substance=inner.head), after) if whole.kind == "object" else None
        tables = (vessels.HOLLOW, lexicon.LEVEL, lexicon.DISHES)
        holds = known is not None and any(self._nouns.of_class(known[0].noun, table) for table in tables)
        portion = any(word in lexicon.PORTIONS for word in singular)
        shape = any(word in lexicon.SHAPES for word in singular)
        if inner.kind in ("object", "unknown", "pieces") and (portion or shape):
            stem = (inner.said or inner.head).split()
            compound = None if holds and inner.kind == "object" else self._nouns.match([*stem, singular[-1]])
            rest = read_modifiers(words[:-1])
            if compound:
                return replace(inner, kind="object", noun=compound.noun, said=compound.said, plural=plural, count=count,
                               cycle=(), modifiers=inner.modifiers.under(rest)), after  # fmt: skip
            if (not holds and inner.kind == "object") or (portion and inner.kind == "unknown"):
                amount = inner.count if count is None and plural else count
                # "Two slices of pizza" are two whole ones.
                rest = rest.under(Modifiers(adjectives=(head,))) if portion and set(singular) & _CUTS else rest
                return replace(inner, plural=plural, count=amount, modifiers=inner.modifiers.under(rest)), after
        if known is not None and not holds and inner.kind in ("object", "unknown", "background", "part", "pieces"):
            left_out = inner.words if inner.kind in ("unknown", "object") and not find_material(inner.head) else ""
            return replace(self._simple(run, count), left_out=left_out), after
        return None

    def _built_in(self, heads: Sequence[str], noun: str) -> bool:
        """Whether one of `heads` is fixed in `noun`, though there are things of that name too: a stove's burner."""
        return any(head in lexicon.BUILT_IN and self._nouns.of_class(noun, lexicon.PARTS_OF[head]) for head in heads)

    def _known(self, names: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(name for name in names if self._nouns.resolve(name))
