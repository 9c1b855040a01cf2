"""What a sentence remarks of its things that no scene has: "a fan, switched off", "a box marked fragile".

A sentence that cannot be read as it stands is read without its remarks, which notes then name. No remark names a thing
that could be made, or says how many there are.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import JOINERS, link_at
from pat3d.plan.grammar.words.descriptions import only_describes
from pat3d.plan.grammar.words.lexing import Span, Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.measures import is_measure
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.unmade import base_verb, is_quality
from pat3d.plan.grammar.words.vocabulary import Nouns

_PARTICLES = frozenset({"off", "up", "out", "down", "away", "back", "open", "apart", "together", "over", "in", "on"})
_IRREGULAR = frozenset({"cut", "broken", "taken", "worn", "torn", "bent", "drawn", "written", "woven", "swept", "built",
    "burnt", "spilt", "shut", "open", "grown", "blown", "made", "spun", "wound", "bound", "hidden", "half-eaten",
    "empty", "full", "closed",
    "asleep", "awake", "ajar", "upright", "damp", "moist", "wet", "dry", "intact", "alone", "unlit", "off-centre",
    "off-center", "ready", "visible", "similar", "identical", "parallel", "perpendicular", "flush",
    "askew"})  # fmt: skip
"""Words behind a noun that tell how it is, beside those that end in -ed and -ing."""
_SORTED = frozenset({"different", "various", "varying", "equal", "similar", "identical", "unequal", "differing",
    "increasing", "decreasing", "ascending", "descending", "growing", "diminishing"})  # fmt: skip
_SORTS = frozenset({"sizes", "heights", "lengths", "shapes", "kinds", "types", "designs", "styles", "ages", "brands",
    "widths", "size", "height", "length", "shape", "colors", "colours", "shades", "materials"})  # fmt: skip
_MANNERS = frozenset({"order", "sequence", "manner", "way", "fashion", "position", "orientation", "angle", "angles",
    "direction", "motion", "speed", "pace", "precision", "care", "caution", "time"})  # fmt: skip
_HELD = frozenset({"handle", "handles", "neck", "rim", "edge", "top", "lid", "strap", "stem", "corner", "side"})
"""Parts by which things are held."""
MOVING = frozenset({"rolling", "falling", "dropping", "flying", "pouring", "spilling", "running", "jumping", "rolled",
    "divided", "distributed", "shared", "followed", "donning", "missing", "removed", "surrounded"})  # fmt: skip
"""Words in -ed and -ing that say where things are, or how many."""
_OPENING = frozenset({"in", "at", "of", "by", "for", "from", "as", "though", "although", "because", "since", "so",
    "like", "without", "per", "each", "spines", "face", "facing", "to"})  # fmt: skip
"""Words that open a remark between two marks, beside participles, adverbs and superlatives."""
_HEADINGS = lexicon.MEALS | lexicon.BACKGROUND | {"imagine", "spec", "task", "goal", "description", "prompt",
    "instruction", "caption", "note", "ready", "done"}  # fmt: skip
_UNMADE = lexicon.PARTS | lexicon.BACKGROUND | lexicon.SUBSTANCES | lexicon.SIZES.keys() | {"triangle"}
"""Nouns of what is never an object."""
_SOME = frozenset({"them", "others", "rest", "other"})
"""Words for what was named before."""
_GAPS = frozenset({"gap", "space", "distance", "room", "gaps", "spaces"})
_SAYING = frozenset({"that", "which", "who"})
_ANY = lexicon.DETERMINERS | lexicon.POSSESSIVES
_ONE_MORE = frozenset({"a", "an", "another", *lexicon.NUMBERS})


class Remarks:
    """Finds the remarks of one sentence, which ends in a stop."""

    def __init__(self, tokens: Sequence[Token], nouns: Nouns) -> None:
        self._tokens = tokens
        self._words = [token.text for token in tokens]
        self._nouns = nouns
        self._named = self._names()

    def spans(self) -> list[Span]:
        """The remarks, in order."""
        made: list[Span] = []
        at = 0
        while at < len(self._words) - 1:
            end = (
                self._set_off(at)
                or self._sort(at)
                or self._manner(at)
                or self._apart(at)
                or self._lacking(at)
                or self._participle(at)
                or self._verb(at)
                or self._owner(at)
            )
            if end:
                made.append((at, end))
            at = max(end, at + 1)
        return made

    def things(self, *, plainly: bool = False) -> set[str]:
        """Catalogue nouns that the sentence names; `plainly`, but those of "a glass surface", "a box office theme"."""
        ends = {at: at + size for at, size in self._named.items()}
        if plainly:
            plain = {end for end in ends.values() if {*self._words[end - 1 : end + 1]} & lexicon.BACKGROUND}
            ends = {at: end for at, end in ends.items() if end not in plain and not is_quality(self._words[end])}
        return {found.noun for at, end in ends.items() if (found := self._nouns.match(self._words[at:end]))}

    def adds_nothing(self, known: Collection[str]) -> bool:
        """Whether the sentence only tells more of the `known` catalogue nouns."""
        indefinite = any(word in ("a", "an", "another") or word in lexicon.NUMBERS for word in self._words)
        told = self.things(plainly=True) <= set(known)
        return told and not (indefinite and self._names_a_thing(0, len(self._words) - 1, _ONE_MORE))

    def _names(self) -> dict[int, int]:
        """Where names of the catalogue begin, and how many words they have."""
        made: dict[int, int] = {}
        at = 0
        while at < len(self._words):
            size = next((n for n in (3, 2, 1) if self._nouns.match(self._words[at : at + n])), 0)
            if size and not (size == 1 and self._colours(at)):
                made[at] = size
            at += size or 1
        return made

    def _colours(self, at: int) -> bool:
        """Whether the fruit at `at` is the colour of what no table has: "with orange bows", but not "an orange"."""
        after = self._words[min(at + 1, len(self._words) - 1)]
        forms = {after, *singulars(after)}
        plain = after.isalpha() and not (
            forms & lexicon.PORTIONS or after in JOINERS | FINITE or link_at(self._tokens, at + 1)
        )
        several = bool(singulars(after)) and (not at or self._words[at - 1] not in lexicon.DETERMINERS | {"one"})
        return is_colour_word(self._words[at]) and plain and several and self._nouns.match([after]) is None

    def _empty(self, start: int, end: int) -> bool:
        """Whether nothing is named or counted from token `start` up to `end`."""
        words = self._words[start:end]
        general = lexicon.NUMBERS.keys() | lexicon.GENERICS.keys() | lexicon.VAGUE.keys() | lexicon.STACK_NOUNS
        counted = any(word in general or word.isdecimal() for word in words)
        return start < end and not counted and not any(at in self._named for at in range(start, end))

    def _names_a_thing(self, start: int, end: int, leads: Collection[str] = _ANY) -> bool:
        """Whether "a map" stands from token `start` up to `end`, which is no part, no place and no stuff."""
        for at in range(start, end):
            if self._words[at] not in leads or self._words[at + 1] == "other":
                continue
            head = at
            while head + 1 < end and not (self._tokens[head + 1].mark or link_at(self._tokens, head + 1)
                                          or self._words[head + 1] in JOINERS or self._does(head + 1)):  # fmt: skip
                head += 1
            word = self._words[head]
            if head > at and not ({word, *singulars(word)} & _UNMADE or is_quality(word) or is_colour_word(word)):
                return True
        return False

    def _does(self, at: int) -> bool:
        """Whether the word at `at` ends a phrase: "a window allows light", "a rhythm that recalls it"."""
        word = self._words[at]
        return word in FINITE | lexicon.RELATIVES or (word.endswith("s") and base_verb(word) is not None)

    def _set_off(self, at: int) -> int:
        """The end of what stands between two marks at `at` and names nothing: "in plain sight,"."""
        if at and not self._tokens[at - 1].mark:
            return 0
        end = next(n for n in range(at, len(self._words)) if self._tokens[n].mark)
        words, first = self._words[at:end], self._words[at]
        if self._words[end] == ":" and not at and set(words) - lexicon.DETERMINERS <= _HEADINGS:
            return end
        part = words[1:2] if first in ("the", "its", "their") else []
        if at and part and {*part, *singulars(part[0])} & (lexicon.PARTS | {"screen"}):
            # "its screen dark", "the bristles still damp"
            state = words[2 + (words[2:3] in (["still"], ["slightly"], ["all"], ["half"])) :]
            return end if state and _tells_state(state[0]) and self._empty(at + 2, end) else 0
        if at and {*words} & lexicon.STYLES and self._empty(at, end):
            # "A teapot on a table, 8k, unreal engine"
            return end
        opens = first in _OPENING | lexicon.SUPERLATIVES.keys() or first.endswith(("ed", "ing", "ly"))
        opens = opens or only_describes(first)
        told = any(is_colour_word(word) or word in ("one", "ones") or word in FINITE for word in words)
        if not opens or first in MOVING or told or self._names_a_thing(at, end):
            return 0
        return end if self._empty(at, end) else 0

    def _sort(self, at: int) -> int:
        """The end of "of different sizes", "of a different color" at `at`."""
        first = at + 1 + (self._words[at + 1] in ("a", "an"))
        words = self._words[first : first + 2]
        told = self._words[at] == "of" and self._behind_noun(at) and "".join(words[:1]) in _SORTED
        return first + 2 if told and {*words[1:]} & (_SORTS | {"color", "colour"}) else 0

    def _manner(self, at: int) -> int:
        """The end of "in the specified sequence", "by its handle" at `at`; what a colon lists is no remark."""
        if self._words[at] == "by" and self._words[at + 1] in ("its", "the", "their") and self._words[at + 2] in _HELD:
            return at + 3
        if self._words[at] not in ("in", "at", "to", "with"):
            return 0
        end = next((n for n in range(at + 1, min(at + 6, len(self._words))) if self._words[n] in _MANNERS), 0)
        inner = self._words[at + 1 : end]
        told = any(link_at(self._tokens, n) or self._tokens[n].mark for n in range(at + 1, end))
        if not end or told or self._words[end + 1] == ":" or {"same", "opposite"} & set(inner):
            return 0
        return end + 1 if not any(n in self._named for n in range(at, end)) else 0

    def _apart(self, at: int) -> int:
        """The end of "parallel to each other", "with a gap between them", "one kind"."""
        words = self._words[at : at + 7]
        if words[0] in ("parallel", "perpendicular") and words[1] in ("to", "with") and words[2] in ("each", "one"):
            return at + 4
        gap = next((n for n in (2, 3) if words[0] == "with" and words[n : n + 1] and words[n] in _GAPS), 0)
        if gap and words[1] in ("a", "an", "some", "little", "no"):
            wide = gap + 1 + 2 * (words[gap + 1 : gap + 2] == ["of"] and is_measure("".join(words[gap + 2 : gap + 3])))
            between = words[wide : wide + 2]
            return at + wide + 2 if between in (["between", "them"], ["in", "between"]) else 0
        kinds = words[0] in ("one", "each") and words[1] in ("kind", "type", "sort", "color", "colour", "size")
        if kinds and at and self._words[at - 1] == ",":
            return next(n for n in range(at, len(self._words)) if self._tokens[n].mark)
        return 0

    def _lacking(self, at: int) -> int:
        """The end of "with a slice missing" at `at`, behind a noun: of a part, or of a piece."""
        end = next((n for n in range(at + 2, min(at + 5, len(self._words))) if self._words[n] == "missing"), 0)
        part = {self._words[end - 1], *singulars(self._words[end - 1])}
        plain = part & (lexicon.PARTS | lexicon.PIECES | {"section", "slice", "piece", "chunk", "string", "button"})
        lacks = self._words[at] == "with" and end and self._begins(at + 1)
        return end + 1 if lacks and self._behind_noun(at) and (plain or end - 1 not in self._named) else 0

    def _participle(self, at: int) -> int:
        """The end of "marked fragile" at `at`, behind a noun; 0 where nothing of that kind begins there."""
        word = self._words[at]
        behind = self._behind_noun(at) or (at > 1 and self._words[at - 1] in _SOME)
        passive = self._words[at + 1] in lexicon.COPULAS and "".join(self._words[at + 2 : at + 3]).endswith("ed")
        saying = word in _SAYING and behind and (passive or self._words[at + 1] not in FINITE)
        participle = word.endswith(("ing", "ed")) or word in _IRREGULAR
        known = (
            at in self._named
            or word in MOVING
            or word in lexicon.NOT_VERBS
            or link_at(self._tokens, at)
            or is_colour_word(word)
        )
        if not saying and (not participle or known or not (behind or self._words[at - 1] in lexicon.COPULAS)):
            return 0
        end = at + 1 + (saying and passive)
        if self._words[end] in ("in", "into") and self._words[end + 1] in lexicon.CUT_INTO | lexicon.NUMBERS.keys():
            # "cut in two"
            pieces = lexicon.CUT_INTO | lexicon.NUMBERS.keys()
            end += 1 + next(n for n in range(1, 5) if self._words[end + 1 + n] not in pieces)
            return end
        while self._words[end] in _PARTICLES and not self._leads(end + max(link_at(self._tokens, end), 1)):
            end += 1
        while not self._tokens[end].mark and end not in self._named and self._words[end] != "and":
            size = link_at(self._tokens, end)
            if size and self._leads(end + size):
                break
            if self._words[end] in FINITE:
                break
            end += max(size, 1)
        if end in self._named or self._names_a_thing(at + saying, end) or (saying and self._words[end] in FINITE):
            return 0
        return end if self._empty(at, end) else 0

    def _verb(self, at: int) -> int:
        """The end of a verb nobody knows, between a noun and a relation: "a phone charges on a desk"."""
        word = self._words[at]
        unknown = at not in self._named and not is_modifier(word) and word not in JOINERS | FINITE
        unknown = unknown and word.isalpha() and not link_at(self._tokens, at) and word not in lexicon.PARTS
        verb = word.endswith("s") and not word.endswith("ss") and word not in lexicon.ADVERBS
        verb = verb and not set(singulars(word)) & (lexicon.PARTS | lexicon.BACKGROUND | lexicon.PIECES)
        size = link_at(self._tokens, at + 1)
        link = LINKS.get(tuple(self._words[at + 1 : at + 1 + size]))
        placing = link is not None and link.manner not in ("source", "goal", "of") and self._begins(at + 1 + size)
        return at + 1 if unknown and verb and placing and self._single(at) else 0

    def _owner(self, at: int) -> int:
        """The end of "of a student" at `at`, behind furniture or a room: who is no thing."""
        names = (self._nouns.match(self._words[at - n : at]) for n in (2, 1) if self._named.get(at - n) == n)
        found = next(names, None)
        whole = self._words[at - 1] in lexicon.BACKGROUND or (found and self._nouns.of_class(found.noun, lexicon.FLOOR))
        told = (n for n in range(at + 2, len(self._words)) if self._tokens[n].mark or link_at(self._tokens, n)
                or self._words[n] in JOINERS | FINITE)  # fmt: skip
        end = next(told, 0) if whole and self._words[at] == "of" and self._words[at + 1] in ("a", "an", "my") else 0
        return end if end > at + 2 and self._empty(at, end) else 0

    def _behind_noun(self, at: int) -> bool:
        """Whether a noun, or a part of one, ends right before `at` or before the comma there."""
        end = at - (self._words[at - 1] == ",") if at else 0
        part = end and {self._words[end - 1], *singulars(self._words[end - 1])} & lexicon.PARTS
        return bool(part) or any(start + size == end for start, size in self._named.items())

    def _single(self, at: int) -> bool:
        """Whether one thing ends right before `at`: what follows in -s is no plural then."""
        start = next((start for start, size in self._named.items() if start + size == at), None)
        if start is None:
            return False
        while start and is_modifier(self._words[start - 1]):
            start -= 1
        return self._words[start - 1] in ("a", "an", "the", "one", "each", "every", "another", "this", "that")

    def _begins(self, at: int) -> bool:
        word = self._words[min(at, len(self._words) - 1)]
        leads = word in lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.PRONOUNS | lexicon.NUMBERS.keys()
        return leads or word.isdecimal()

    def _leads(self, at: int) -> bool:
        """Whether a phrase that names something begins at `at`."""
        while at < len(self._words) and (self._begins(at) or is_modifier(self._words[at])):
            at += 1
        return at in self._named


def _tells_state(word: str) -> bool:
    return is_modifier(word) or word in _IRREGULAR or word in lexicon.STATES
