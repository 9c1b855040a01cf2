"""Edges of a plan against the words of its sentence: what is carried without a word that says so."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from pat3d.plan.audit.claims import fronted, whose_of
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.subjects import listed, row_of, said_of
from pat3d.plan.audit.text import Claim, Mention
from pat3d.plan.audit.words import DEEDS, FORMED, HEADLESS, NUMBERS, PRONOUNS, REACHING, REPEATS
from pat3d.scene.relations import OPPOSITE, RELATION_WORDS, Relation

_SIDES = {"left": "left_of", "right": "right_of", "front": "in_front_of"}
_ORDERS = frozenset({"row", "rows", "line", "lined", "order", "side"})
_FLANKING = frozenset({"flank", "flanks", "flanked", "flanking"})
_ADDING = frozenset({"too", "likewise"})
_STACKING = FORMED | frozenset(
    {"stacked", "stack", "towers", "tower", "column", "piled", "pyramid", "nested", "heaped"}
)
"""Words by which likes stand on one another."""
_UPON = frozenset({"on", "onto", "upon", "atop", "top", "carries", "holds", "supports", "bears", "carrying", "holding",
                   "supporting", "below", "beneath", "under", "in", "inside", "contains", "containing"})  # fmt: skip
_ANOTHER = (REPEATS | HEADLESS | PRONOUNS | frozenset({"others", "itself"})) - {"left", "right"}
_WITHIN = 4
"""Words from a relation word to the like without a noun that it leads to."""
_FEATURING = frozenset({"decorated", "including", "includes", "features", "featuring"})
"""Words by which what is first named has all that follows."""
_PLACES = ("in_corner", "at_edge", "at_ends")
"""Places on something, which only words for them give."""
_SO = frozenset({"is", "are", "does", "do", "was", "were"})
_HEADLESS_INSIDE = re.compile(
    r"\b(in|inside|into|within|contains?|containing|holds?|holding) ((?!and\b)[a-z]+ ){0,3}"
    r"(one|another|others?|larger|smaller|largest|smallest|bigger)\b"
)
_NEAR = 6
"""Words between names that are joined."""


def unsaid(it: Compared, found: Sequence[str]) -> Iterator[str]:
    """Relations of the plan that no word of the sentence gives, but at what the notes `found` name."""
    noted = " ".join(found).lower()
    objects = {obj.name: obj for obj in it.plan.objects}
    pairs: dict[tuple[str, str], list[Relation]] = {}
    for rel in it.plan.relations:
        alike = rel.parent in objects and objects[rel.child].noun == objects[rel.parent].noun
        nested = _HEADLESS_INSIDE.search(" ".join(it.said.words)) or any(_nests(it, c, rel) for c in it.said.claims)
        if alike and rel.kind == "in" and not nested:
            yield f'assumed: "{rel.child}" in "{rel.parent}"'
        told = not alike or _stacked(it.said.words) or _licensed(it, rel.child, rel.kind, rel.parent)
        if rel.kind == "on" and not told:
            yield f'assumed: "{objects[rel.child].phrase}" on "{objects[rel.parent].phrase}"'
        if rel.parent in objects and not alike and not it.on_tier(rel):
            pairs.setdefault((objects[rel.child].phrase, objects[rel.parent].phrase), []).append(rel)
    all_found = " ".join(found)
    broken = [_told_of(it, claim) for claim in it.said.claims
              if f'as said: "{claim.said}"' in all_found or f'"{claim.said}" is not read as' in all_found]  # fmt: skip
    for (child, parent), relations in pairs.items():
        if any(rel.child in names for rel in relations for names in broken):
            continue
        given = (_licensed(it, rel.child, rel.kind, rel.parent) if rel.supports else _stands(it, rel)
                 for rel in relations)  # fmt: skip
        if child != parent and not any(given) and parent.lower() not in noted and child.lower() not in it.told:
            yield f'assumed: "{child}" {RELATION_WORDS[relations[0].kind]} "{parent}"'


def _stacked(words: Sequence[str]) -> bool:
    """Whether a word says that likes stand on one another, or something on one of which the noun is not said."""
    upon = (at for at, word in enumerate(words) if word in _UPON)
    return (
        bool(_STACKING & set(words))
        or {"bottom", "top"} <= set(words)
        or any(_ANOTHER & set(words[at + 1 : at + 1 + _WITHIN]) and "'s" not in words[at : at + _WITHIN] for at in upon)
    )


def _from_below(words: Sequence[str]) -> bool:
    """Whether the sentence says who is at the bottom and who on top."""
    return any(each <= set(words) for each in ({"bottom", "top"}, {"from", "top", "down"}, {"from", "bottom", "up"}))


def _told_of(it: Compared, claim: Claim) -> set[str]:
    """The objects of which `claim` says where they are."""
    if claim.of is not None and claim.place in ("holding", "with"):
        return _names(it, [claim.of])
    subjects, _ = said_of(it, claim)
    return _names(it, subjects) if subjects else _said_of(it, claim)


def _nests(it: Compared, claim: Claim, rel: Relation) -> bool:
    """Whether `claim` may say that one of two likes is in the other."""
    if claim.of is not None:
        return claim.place in ("in", "holding") and bool({rel.child, rel.parent} & _names(it, [claim.of]))
    near = [mention for mention in it.said.mentions if mention.end == claim.at]
    if not near and it.said.words[claim.at - 1] == "nothing":
        return False
    return claim.place == "in" and all(rel.child in _names(it, [mention]) for mention in near)


def _stands(it: Compared, rel: Relation) -> bool:
    """Whether a word of the sentence, or a note, gives the lateral relation `rel`."""
    words = set(it.said.words)
    rows = [one.objects for one in it.plan.arrangements if one.kind in ("row", "side_by_side")]
    ordered = words & _ORDERS or "from left to right" in " ".join(it.said.words)
    if rel.kind == "around" or (ordered and any({rel.child, rel.parent} <= set(row) for row in rows)):
        return True
    if _aside(it, rel.child, rel.kind) or _aside(it, rel.parent, OPPOSITE.get(rel.kind, "")) or _flanked(it, rel):
        return True
    phrases = [obj.phrase.lower() for obj in it.plan.objects if obj.name in (rel.child, rel.parent)]
    if any(all(phrase in note for phrase in phrases) for note in it.notes):
        return True
    return any(_licensed(it, a, kind, b) for a, kind, b in it.edges if {a, b} == {rel.child, rel.parent})


def _aside(it: Compared, name: str, kind: str) -> bool:
    """Whether a side without a landmark is said of `name`: "a wrench to the right", "on the left a sponge"."""
    for at, word in enumerate(it.said.words):
        if _SIDES.get(word) != kind:
            continue
        before = [mention for mention in it.said.mentions if mention.end <= at][-1:]
        behind = [mention for mention in it.said.mentions if mention.start > at][:1]
        near = [mention for mention in (*before, *behind) if mention.start - at < _NEAR and at - mention.end < _NEAR]
        if name in _names(it, near):
            return True
    return False


def _flanked(it: Compared, rel: Relation) -> bool:
    """Whether one of the two has the other at its side by "flank"."""
    at = next((at for at, word in enumerate(it.said.words) if word in _FLANKING), None)
    if at is None or rel.kind not in ("left_of", "right_of", "next_to", "in_front_of", "behind"):
        return False
    before = [mention for mention in it.said.mentions if mention.end <= at]
    behind = [mention for mention in it.said.mentions if mention.start > at]
    inner = before if it.said.words[at] == "flanked" else behind[:1]
    return bool({rel.child, rel.parent} & _names(it, inner))


def _licensed(it: Compared, child: str, kind: str, parent: str) -> bool:
    """Whether a word of the sentence says that `child` is at `parent`, or what is in `child` is: "a rose in a vase"."""
    return _said_at(it, child, kind, parent) or (kind == "on" and any(
        b == child and k == "in" and _said_at(it, a, kind, parent) for a, k, b in sorted(it.edges)
    ))  # fmt: skip


def _in_one_list(it: Compared, one: str, other: str) -> bool:
    """Whether both are named in one list: "a ball, a cube and a cone are stacked"."""
    lists = ([{obj.name for obj in it.which(each)} for each in row_of(it, mention)] for mention in it.said.mentions)
    return any(any(one in names for names in row) and any(other in names for names in row) for row in lists)


def _said_at(it: Compared, child: str, kind: str, parent: str) -> bool:
    named = {obj.name for mention in it.said.mentions for obj in it.of(mention)}
    inside = kind == "in" and _HEADLESS_INSIDE.search(" ".join(it.said.words))
    if kind == "on" and _STACKING & {*it.said.words} and _in_one_list(it, child, parent):
        return True
    if inside or (kind == "on" and _from_below(it.said.words)) or not {child, parent} <= named:
        return True
    for claim in it.said.claims:
        below, above = _landmarks(it, claim), _said_of(it, claim)
        subjects, _ = said_of(it, claim)
        if subjects and claim.of is not None and claim.place not in ("with", "holding"):
            above = _names(it, subjects)
        if fronted(it, claim):
            # "On the chest next to the bed is a lamp": the chest may be next to the bed as well.
            near = (each for each in it.said.mentions if each.start >= claim.end or each.end == claim.at)
            above = above | _names(it, list(near))
        if claim.whole:
            above |= _names(it, claim.whose)
        if claim.place in ("with", "holding", "under") and child in below and parent in above:
            return True
        if parent in below and child in _names(it, _added(it, claim)):
            return True
        owner = [mention for mention in it.said.mentions if mention.end == claim.at]
        if claim.place == "with" and owner and not claim.whose:
            above = _names(it, owner)
        taken = claim.place in ("far", "from") and bool(it.tasks.strip() or it.undone)
        kinds = ("on", "in", *(("next_to",) if taken else ())) if claim.place == "with" or taken else it.kinds(claim)
        if kind in kinds and parent in below and child in above:
            return True
    had = [claim.end for claim in it.said.claims if claim.place in ("with", "holding")]
    for one, other in pairwise(it.said.mentions):
        # "The tray holds a cup and the plate a bun": the verb is left out.
        gap = one.end == other.first and any(end <= one.first for end in had)
        if gap and parent in _names(it, [one]) and child in _names(it, [other]):
            return True
    if any(one.kind in _PLACES and child in one.objects and parent in one.of for one in it.plan.arrangements):
        return True
    for at in (at for at, word in enumerate(it.said.words) if word in _FEATURING):
        before, behind = ([mention for mention in it.said.mentions if (mention.start < at) is first]
                          for first in (True, False))  # fmt: skip
        if kind in ("on", "in") and parent in _names(it, before[:1]) and child in _names(it, behind):
            return True
    for mention in it.said.mentions:
        if kind in ("on", "in") and child in _names(it, [mention]) and _so_is(it.said.words, mention):
            return True
        if kind == "in" and child in _names(it, listed(it, mention)) and _inside(it.said.words, mention.end):
            return True
        if it.said.words[:1] == ["set"] and mention.first < 3 and parent in _names(it, [mention]):
            # "Set the table for two: two plates"
            return True
        after = it.said.words[mention.end : mention.end + 1]
        at_it = after in ([":"], ["("]) or "at" in it.said.words[max(mention.start - _NEAR, 0) : mention.start]
        if _full_of(it, mention, child, parent) or (at_it and parent in _names(it, [mention])):
            return True
    for mention in it.said.mentions:
        led = it.said.words[max(mention.first - 1, 0) : mention.first] == ["to"]
        if led and DEEDS & set(it.said.words[: mention.first]) and parent in _names(it, [mention]):
            # "Put a spoon to the counter"
            return True
    # What stands by something on a table stands there too.
    beside = {b for a, k, b in it.edges if a == child and k not in ("on", "in", "under")}
    beside |= {
        cover for one in it.plan.arrangements if one.kind == "under" and child in one.objects for cover in one.of
    }
    return any((b, k, parent) in it.edges for b in beside for k in ("on", "in"))


def _added(it: Compared, claim: Claim) -> list[Mention]:
    """What a sentence ends with behind `claim`: the pen of "A mug is on the table, and a pen."."""
    words = it.said.words
    return [
        mention
        for mention in it.said.mentions
        if words[claim.end : mention.first] == [",", "and"] and words[mention.end : mention.end + 1] in ([], ["."])
    ]


def _inside(words: Sequence[str], at: int) -> bool:
    """Whether "inside" stands at word `at` and leads to no landmark: "a drill inside, and a saw"."""
    return words[at : at + 1] == ["inside"] and not any(word[0].isalnum() for word in words[at + 1 : at + 2])


def _so_is(words: Sequence[str], mention: Mention) -> bool:
    """Whether what `mention` names is said to be where something else is: "a hammer, too", "and so is the hammer"."""
    start = mention.first
    if words[start - 2 : start] == ["of", "the"] and words[start - 3] in NUMBERS:
        start -= 3
    before, after = words[:start], [word for word in words[mention.end : mention.end + 2] if word != ","]
    return bool(set(after) & _ADDING) or (before[-2:-1] == ["so"] and before[-1] in _SO)


def _full_of(it: Compared, whole: Mention, child: str, parent: str) -> bool:
    """Whether "a bowl of cherries and plums" names both."""
    inside = next((mention for mention in it.said.mentions if mention.start > whole.start), None)
    if inside is None or it.said.words[whole.end : whole.end + 1] != ["of"]:
        return False
    return parent in _names(it, [whole]) and child in _names(it, _joined(it, inside))


def _names(it: Compared, mentions: Sequence[Mention]) -> set[str]:
    """The objects that `mentions` may name, and those that no mention does."""
    named = {obj.name for mention in it.said.mentions for obj in it.of(mention)}
    own = {obj.name for mention in mentions for obj in it.of(mention)}
    return own | ({obj.name for obj in it.plan.objects} - named)


def _joined(it: Compared, first: Mention) -> list[Mention]:
    """`first` and what "and" and commas join to it, with what is said of that between them."""
    mentions = [mention for mention in it.said.mentions if mention.start >= first.start]
    found = [first]
    for before, mention in pairwise(mentions):
        between = it.said.words[before.end : mention.start]
        stands = any(before.end <= claim.at < mention.start and claim.place != "with" for claim in it.said.claims)
        if {"and", ","} & set(between) and len(between) < _NEAR and not stands:
            found.append(mention)
    return found


def _landmarks(it: Compared, claim: Claim) -> set[str]:
    """What `claim` may lead to: what is named behind it and is joined to that, or all that a pronoun may mean."""
    if claim.of is not None:
        return _names(it, _joined(it, claim.of))
    last = {*it.said.words[claim.end - 1 : claim.end]}
    one_of_several = bool(last & {"other", "others"}) and "one" in it.said.words[: claim.at]
    nouns = [obj.noun for obj in it.plan.objects]
    return {obj.name for obj in it.plan.objects if not one_of_several or nouns.count(obj.noun) > 1}


def _said_of(it: Compared, claim: Claim) -> set[str]:
    """What `claim` may be said of: what its part of the sentence names, and all before it where a word reaches back."""
    if whose := whose_of(it, claim):
        return whose
    others = [mention for mention in it.said.mentions if mention is not claim.of]
    said = it.said.words[: claim.at]
    start = next((at + 1 for at in range(len(said) - 1, -1, -1) if said[at] in (".", ";", "!", "?")), 0)
    # "Both hold a nut": of what the sentence before names.
    reaches = bool(REACHING & set(said[start:]) or {"both", "each", "all"} & set(said[start : start + 1]))
    reaches = reaches or claim.of is None
    return _names(it, [mention for mention in others if mention.part == claim.part or reaches])
