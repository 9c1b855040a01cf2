"""Places on a surface that is named once: "a lamp in the corner of the desk, and a pen at the edge"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexicon import STANDING
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import LINKS, WHICH_EDGE
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_NEAR = frozenset({"in", "at", "on", "near"})
_MIDDLES = frozenset({"middle", "center", "centre"})
_OFF = {
    "left": "on the left side",
    "right": "on the right side",
    "back": "at the back",
    "behind": "at the back",
    "front": "at the front",
    **dict.fromkeys(("slightly", "just", "a", "bit", "little", "and", "to", "the", "in"), ""),
}
"""Words before "the center of", and on which side of it is what they are said of."""
_RIMS = frozenset({"edge", "corner", "rim"})
_BEHIND = frozenset({"and", "with", "while"})
"""What may follow a place that nothing is said of, beside marks."""
_AT_ENDS = tuple([":", near, each, "end"] for near in ("at", "on") for each in ("each", "either", "every"))
_OTHERS = tuple(tuple(said.split()) for said in (
    "the other", "the opposite", "the far", "the next", "a second", "the second", "a third", "the third",
))  # fmt: skip


def on_the_surface(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a pen at the edge" as "a pen at the edge of the desk", where that is the surface spoken of.

    It is the one whose edge, corner or middle the sentence names, or else the only level thing in it. What stands on
    the floor stands in the corner of a room.
    """
    tokens = _whole(_other_places(_parts_again(_by_middles(tokens, nouns), nouns)), nouns)
    words = [token.text for token in tokens]
    told = _told(words, nouns)
    level = {said for at in range(len(words)) if (said := _surface(words[at : at + 3], nouns))}
    level -= {said for said in level if any(other.endswith(f" {said}") for other in level)}
    made: list[Token] = []
    for at, token in enumerate(tokens):
        made.append(token)
        lead = at - 1
        while token.text in ("corner", "edge") and lead > 1 and words[lead] in WHICH_EDGE:
            lead -= 1
        bare = lead > 0 and words[lead - 1] in _NEAR and words[lead] in ("the", "a", "one", "each", "every")
        ends = at + 1 == len(tokens) or tokens[at + 1].mark or words[at + 1] in _BEHIND
        fronted = words[max(at - 3, 0) : at + 1] in _AT_ENDS and words[at + 1] in lexicon.DETERMINERS
        if fronted and len(level) == 1 and next(iter(level)).split()[-1] in words[:at]:
            # "The table is set: at each end a mug"
            made += [replace(token, text=word) for word in ("of", "the", *next(iter(level)).split())]
            continue
        if at < 3 or not (bare and ends and _small(words[: lead - 1], nouns)):
            continue
        owner = told if token.text in _MIDDLES | _RIMS else ""
        if not owner and token.text in _RIMS and len(level) == 1:
            owner = next(iter(level))
        if owner:
            made += [replace(token, text=word) for word in ("of", "the", *owner.split())]
    return made


def _by_middles(tokens: Sequence[Token], nouns: Nouns) -> Sequence[Token]:
    """`tokens` with "slightly left of the center of the desk" as "on the left side of the desk".

    "A rug in the middle in front of the sofa" is in front of it: the middle is that of the room.
    """
    words = [token.text for token in tokens]
    for at in (n for n in range(2, len(words) - 3) if words[n - 1] == "the" and words[n] in _MIDDLES):
        after = at + 1 + (words[at + 1] == ",")
        beside = LINKS.get(tuple(words[after : after + link_at(tokens, after)]))
        lateral = words[at - 2] in _NEAR and beside is not None and beside.kind in LATERAL_KINDS
        if lateral and not _small(words[: at - 2], nouns):
            return [*tokens[: at - 2], *tokens[after:]]
        start = at - 1 - (words[at - 2] in ("of", "from"))
        while start and words[start - 1] in _OFF:
            start -= 1
        side = next((_OFF[word] for word in words[start : at - 1] if _OFF.get(word)), "")
        owner = at + 2 + (words[at + 2] in lexicon.DETERMINERS | lexicon.POSSESSIVES)
        if words[at + 1] == "of" and side and _surface(words[owner : owner + 3], nouns):
            place = [replace(tokens[start], text=word, end=tokens[at].end) for word in side.split()]
            return [*tokens[:start], *place, *tokens[at + 1 :]]
    return tokens


def _parts_again(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "on the left burner and a pot on the right one" as "... on the right burner".

    "A pot on the one behind it" is "behind it".
    """
    words, part = [token.text for token in tokens], ""
    named = {found.noun for word in words if (found := nouns.match([word])) is not None}
    for at, word in enumerate(words):
        lead = next((n for n in range(at - 1, max(at - 4, 0), -1) if words[n] == "the" and words[n - 1] == "on"), 0)
        if lead and {*lexicon.PARTS_OF.get(word, ())} & named:
            part = word
        elif lead and part and word == "one":
            which = [token for token in tokens[lead:at] if token.text != "other"]
            beside = link_at(tokens, at + 1) and "it" in words[at + 2 : at + 4]
            again = [] if beside else [tokens[lead - 1], *which, replace(tokens[at], text=part)]
            return _parts_again([*tokens[: lead - 1], *again, *tokens[at + 1 :]], nouns)
    return list(tokens)


def _whole(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the table surface" and "the table top" as "the table", "the sink area" as "the sink"."""
    words = [token.text for token in tokens]
    made = []
    for at, token in enumerate(tokens):
        name = nouns.match(words[at - 1 : at]) if token.text in ("surface", "top", "area") and at > 1 else None
        whole = token.text == "area" or (name is not None and nouns.of_class(name.noun, lexicon.LEVEL))
        ends = name and whole and words[at + 1] != "of" and nouns.match(words[at - 1 : at + 1]) is None
        if not (ends and (tokens[at + 1].mark or link_at(tokens, at + 1) or words[at + 1] in ("and", "is", "are"))):
            made.append(token)
    return made


def _other_places(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a cup in one corner, a pen in another" as "a cup in the corner, a pen in the corner".

    What stands in one corner leaves the others, so they need not be told apart; of ends there are two.
    """
    words = [token.text for token in tokens]
    parts = {n: words[n] for n in range(2, len(words)) if words[n] in ("corner", "edge", "end")
             and words[n - 1] == "one" and words[n - 2] in _NEAR}  # fmt: skip
    if not parts:
        return list(tokens)
    first = min(parts)
    part, made, at = parts[first], list(tokens[: first + 1]), first + 1
    if part != "end":
        made[-2] = replace(made[-2], text="the")
    while at < len(tokens):
        size = _headless(words[at : at + 4], part) if words[at - 1] in _NEAR else 0
        if not size:
            made.append(tokens[at])
            at += 1
            continue
        told = ("the", "other", part) if part == "end" else ("the", part)
        made += [replace(tokens[at], text=word, end=tokens[at + size - 1].end) for word in told]
        at += size
    return made


def _headless(words: Sequence[str], part: str) -> int:
    """How many of `words` speak of one more `part`: "another", "the opposite one", "another corner"; 0 where none."""
    size = 1 if words[:1] == ["another"] else 2 if tuple(words[:2]) in _OTHERS else 0
    if not size:
        return 0
    follower = words[size] if size < len(words) else "."
    if follower in (part, "one"):
        return size + 1
    return size if not follower[0].isalnum() or follower in _BEHIND else 0


def stood_where(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a desk where a lamp stands at the back" as "on a desk, a lamp stands at the back"."""
    words = [token.text for token in tokens]
    first = 2 * (words[0] == "there" and words[1] in lexicon.COPULAS)
    at = next((n for n in range(first + 1, min(first + 8, len(words) - 3)) if words[n] == "where"), 0)
    begins = words[first] in ("a", "an", "one") and words[at + 1] in lexicon.DETERMINERS | lexicon.NUMBERS.keys()
    end = at - (words[at - 1] == ",")
    size = next((n for n in (3, 2, 1) if at and nouns.match(words[end - n : end])), 0)
    surface = _surface(words[end - size : end], nouns) if size else ""
    plain = not any(token.mark or link_at(tokens, n) for n, token in enumerate(tokens[first : end - size], first))
    # "A desk where a lamp stands is brown", "a table, where a lamp stands, is low": the sentence is about the desk.
    verbs = [n for n in range(at, len(words)) if words[n] in STANDING]
    about = any(words[n - 1] == "," or n - 1 in verbs for n in verbs)
    if not (at and begins and surface and plain and verbs) or about:
        return list(tokens)
    on, comma = replace(tokens[first], text="on"), replace(tokens[at], text=",", mark=True)
    return [on, *tokens[first:end], comma, *tokens[at + 1 :]]


def across_the_top(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a crate, and a saw across the top" as "a crate, and a saw across the crate", the one vessel."""
    words = [token.text for token in tokens]
    said = (["across", "the", "top"], ["over", "the", "top"])
    at = next((n for n in range(len(words) - 3) if words[n : n + 3] in said and words[n + 3] != "of"), 0)
    known = ((word, nouns.match([word])) for word in words[:at])
    named = [word for word, found in known if found is not None and nouns.of_class(found.noun, vessels.HOLLOW)]
    if not at or len({*named}) != 1:
        return list(tokens)
    across = replace(tokens[at], text="across")
    return [*tokens[:at], across, tokens[at + 1], replace(tokens[at + 2], text=named[0]), *tokens[at + 3 :]]


def _told(words: Sequence[str], nouns: Nouns) -> str:
    """The surface of which the sentence names the edge, a corner or the middle, where it is one; empty otherwise."""
    found = set()
    for at, word in enumerate(words[:-2]):
        if word in _MIDDLES | _RIMS and words[at + 1] == "of":
            start = at + 2 + (words[at + 2] in ("the", "a", "an"))
            found.add(_surface(words[start : start + 3], nouns))
    return found.pop() if len(found) == 1 else ""


def _surface(words: Sequence[str], nouns: Nouns) -> str:
    """The level thing that `words` begin with; empty where they do not."""
    match = next((one for size in (3, 2, 1) if (one := nouns.match(words[:size]))), None)
    return match.said if match is not None and nouns.of_class(match.noun, lexicon.LEVEL) else ""


def _small(before: Sequence[str], nouns: Nouns) -> bool:
    """Whether `before` ends in what stands on furniture, and speaks of all of it."""
    match = next((one for size in (3, 2, 1) if (one := nouns.match(list(before[-size:])))), None)
    return match is not None and not nouns.of_class(match.noun, lexicon.FLOOR)
