"""What a sentence says is not there, or not yet, beside what is: "the green cup, not the red one", "neither box".

What is denied is set aside in a note; what the denial is said of is there ("neither of the two boxes").
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.sentences import CONDITIONS
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

Told = tuple[list[Token], list[tuple[Token, Token]]]
"""A sentence without its denials, and the first and the last token of each of these."""

_NOTHING = frozenset({"nothing", "nobody"})
_NO = frozenset({"neither", "none"})
_UNABLE = tuple(tuple(said.split()) for said in (
    "does not", "do not", "will not", "could not", "is not", "are not", "no longer", "doesn't", "don't", "won't",
    "can't", "cannot", "isn't", "aren't", "never",
))  # fmt: skip
_WORKING = frozenset({"work", "works", "function", "functions", "run", "runs", "tick", "ticks", "ring", "rings"})
"""What a thing does wherever it stands: what follows is where it does not."""
_WITHOUT = (("free", "of"), ("free", "from"), ("devoid", "of"), ("void", "of"), ("bare", "of"), ("bereft", "of"),
            ("missing",), ("lacking",), ("lacks",), ("lack",), ("minus",), ("sans",), ("empty", "of"), ("out", "of"),
            ("low", "on"), ("short", "of"))  # fmt: skip
_BUT = (("except", "for"), ("apart", "from"), ("aside", "from"), ("other", "than"), ("save", "for"), ("but", "for"),
        ("but",), ("except",), ("save",), ("besides",), ("than",))  # fmt: skip


def without_denials(tokens: Sequence[Token], nouns: Nouns) -> Told:
    """`tokens` of one sentence, which ends in a stop, without what they deny."""
    words = [token.text for token in tokens]
    for told in (_nor, _no, _lacking, _condition, _not_but, _rather, _set_off, _none_behind, _nothing, _none_of,
                 _among, _useless, _all_listed):  # fmt: skip
        if (found := told(tokens, words, nouns)) is not None:
            kept, denied = found
            rest, more = without_denials(kept, nouns)
            return rest, [*denied, *more]
    return list(tokens), []


def _nor(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "neither the bowl nor the jar has anything in it" as "there are the bowl and the jar"."""
    nor = words.index("nor") if words[0] == "neither" and "nor" in words else 0
    verb = next((n for n in range(nor + 1, len(words)) if words[n] in FINITE), 0) if nor else 0
    if not verb or any(token.mark or link_at(tokens, n) for n, token in enumerate(tokens[:verb])):
        return None
    spans = [(1, nor), (nor + 1, verb)]
    end = next(n for n in range(verb, len(words)) if tokens[n].mark)
    # "Neither a fork nor a spoon is on the plate" tells of a plate alone.
    known = all(words[start] in lexicon.DEFINITE | lexicon.POSSESSIVES for start, _ in spans)
    if not known or not all(nouns.longest(words[start:stop]) for start, stop in spans) or tokens[end].text != ".":
        return None
    if (size := link_at(tokens, verb + 1)) and nouns.longest(words[verb + 1 + size : end]):
        # "Neither the cup nor the plate is on the tray": the tray is there too.
        spans.append((verb + 1 + size, end))
    joints = [replace(tokens[nor], text="and") for _ in spans]
    there = [replace(tokens[0], text=word) for word in ("there", "are")]
    each = [token for (start, stop), joint in zip(spans, joints, strict=True) for token in (joint, *tokens[start:stop])]
    return [*there, *each[1:], tokens[end]], [(tokens[0], tokens[end - 1])]


def _no(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "neither a fork nor a knife, just a spoon" as "no fork, just a spoon"."""
    at = words.index("neither") if "neither" in words else len(words)
    nor = words.index("nor") if "nor" in words[at:] else 0
    end = next((n for n in range(nor + 1, len(words)) if tokens[n].mark or link_at(tokens, n)), 0)
    first = at + 1 + ("".join(words[at + 1 : at + 2]) in lexicon.COUNTING)
    instead = {"just", "only"} & {*words[end:]} if nor and not FINITE & {*words[nor:end]} else ()
    if not instead or nouns.longest(words[first:nor]) is None or words[first] in lexicon.DETERMINERS:
        return None
    return [*tokens[:at], replace(tokens[at], text="no"), *tokens[first:nor], *tokens[end:]], [
        (tokens[nor], tokens[end - 1])
    ]


def _lacking(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a vase missing red flowers", "a pot lacks a lid", "a desk free of cups" as "a vase without red flowers"."""
    for at in range(1, len(words) - 2):
        size = next((len(said) for said in _WITHOUT if tuple(words[at : at + len(said)]) == said), 0)
        known = nouns.match(words[at - 1 : at]) is not None or (words[at - 1] in lexicon.COPULAS and size == 2)
        which = 1 if words[at - 1] in lexicon.RELATIVES else 2 * (words[at - 2] in lexicon.RELATIVES)
        which = which if which < 2 or words[at - 1] in lexicon.COPULAS else 0
        if not size or not (known or which or words[at - 1] in (",", "and", "but")):
            continue
        # "Out of paper", and no "out of the box"
        start, run_out = at + size, words[at] in ("out", "low", "short")
        if run_out and (words[at - 1] not in lexicon.COPULAS or words[start] in lexicon.LEADING | lexicon.PRONOUNS):
            continue
        behind = next(n for n in range(start, len(words)) if tokens[n].mark or link_at(tokens, n))
        part = {words[behind - 1], *singulars(words[behind - 1])} & (lexicon.PARTS | lexicon.PORTIONS)
        if behind > start and (part or run_out or nouns.longest(words[start:behind]) is not None):
            without = replace(tokens[at], text="without", end=tokens[start - 1].end)
            return [*tokens[: at - which], without, *tokens[start:]], []
    return None


def _condition(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "once the box is open", which `sentences` has cut off, as "the box is open"."""
    opens = words[0] in CONDITIONS and "," not in words and (words[1] in lexicon.DETERMINERS or words[1] == "there")
    if not opens or not set(words) & FINITE:
        return None
    return list(tokens[1:]), [(tokens[0], tokens[-2])]


def _not_but(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "not a mug but a glass stands", "is not on the tray but under it", "in neither the box nor the bag but"."""
    for at, word in enumerate(words[:-2]):
        neither = word == "neither" or (word == "not" and words[at + 1] != "only")
        if not neither:
            continue
        stop = next(n for n in range(at, len(words)) if tokens[n].mark and words[n] != ",")
        but = next((n for n in range(at + 2, stop - 1) if words[n] == "but"), 0)
        if not but or set(words[at:but]) & FINITE or words[but + 1] == "not":
            continue
        # "in neither the box nor the bag but under the table": the relation goes with it.
        start = at - 1 if link_at(tokens, but + 1) and at and link_at(tokens, at - 1) == 1 else at
        if "two" in words[but:stop] or {"it", "them"} & set(words[but:stop]):
            named = [n for n in range(start, but) if nouns.match([words[n]])]
            if len(named) != 1 or "it" not in words[but:stop]:
                return None
            # "not on the tray but next to it": next to the tray.
            it = words.index("it", but)
            owner = [replace(tokens[named[0] - 1], text="the"), tokens[named[0]]]
            return [*tokens[:start], *tokens[but + 1 : it], *owner, *tokens[it + 1 :]], [
                (tokens[start], tokens[but - 1])
            ]
        end = but - (words[but - 1] == ",")
        return [*tokens[:start], *tokens[but + 1 :]], [(tokens[start], tokens[end - 1])]
    return None


def _rather(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a spoon rather than a fork lies on the plate", and "instead of a vase, ...", without the other thing."""
    for at in range(len(words) - 3):
        if words[at : at + 2] not in (["rather", "than"], ["instead", "of"]):
            continue
        if words[at + 2] not in lexicon.DETERMINERS:
            continue
        ends = (n for n in range(at + 3, len(words)) if tokens[n].mark or words[n] in FINITE or link_at(tokens, n))
        end = next(ends, 0)
        if end and not set(words[at + 3 : end]) & lexicon.DETERMINERS:
            after = end + (words[end] == "," and not at)
            return [*tokens[:at], *tokens[after:]], [(tokens[at], tokens[end - 1])]
    return None


def _set_off(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "the green cup, not the red one, is", "a bag, but not its strap," and "touches it but not the other"."""
    for at in range(1, len(words) - 2):
        size = next((len(no) for no in (["but", "not"], ["and", "not"], ["not"]) if words[at : at + len(no)] == no), 0)
        comma = words[at - 1] == ","
        if not size or words[at - 1] in FINITE or not (comma or size == 2):
            continue
        end = next(n for n in range(at + size, len(words)) if tokens[n].mark or words[n] == "but")
        inside = words[at + size : end]
        linked = next((n for n in range(max(0, at - 4), at) if n + link_at(tokens, n) == at), -1)
        if linked >= 0 and (other := link_at(tokens, at + size)):
            # "next to but not touching the phone"
            return [*tokens[:at], *tokens[at + size + other :]], [(tokens[at], tokens[at + size + other - 1])]
        if not inside or set(inside) & FINITE or (words[end] == "but"):
            continue
        after = end + (comma and words[end] == ",")
        return [*tokens[: at - comma], *tokens[after:]], [(tokens[at], tokens[end - 1])]
    return None


def _none_behind(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "ten screws in a dish, and none on the table", "but none of them are red" without that."""
    for at in range(2, len(words) - 2):
        if words[at] not in _NO or words[at - 1] not in ("and", "but", ",", "with"):
            continue
        start = at - 1 - (words[at - 2] == ",")
        end = next(n for n in range(at, len(words)) if tokens[n].mark)
        kinds = any(word in lexicon.GENERICS for word in words[:start])
        if (words[at - 1] == "with" and "nor" not in words[at:end]) or (kinds and set(words[at:end]) & FINITE):
            # "three pieces of fruit, but none of them are pears"
            return None
        return [*tokens[:start], *tokens[end:]], [(tokens[at - (words[at - 1] != ",")], tokens[end - 1])]
    return None


def _nothing(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "nothing is on the plate" as "there is the plate", and "nobody is there, only a cup" as "a cup"."""
    opens = (n for n in range(2, len(words) - 3) if words[n] == "nothing" and words[n - 1] in ("and", "but", "while"))
    first = 0 if words[0] in _NOTHING else next(opens, None)
    if first is None:
        return None
    if not first and (found := _nothing_but(tokens, words)) is not None:
        return found, []
    if words[first + 1] == "else" or any(tuple(words[first + 1 : first + 1 + len(said)]) == said for said in _BUT):
        return None
    end = next(n for n in range(first, len(words)) if tokens[n].mark)
    if not first and words[end] == ",":
        after = end + 1 + (words[end + 1] in ("only", "but"))
        return (list(tokens[after:]), [(tokens[0], tokens[end - 1])]) if words[after] in lexicon.DETERMINERS else None
    link = next((n for n in range(first + 1, end - 1) if link_at(tokens, n)), 0)
    the = max((n for n in range(link, end) if words[n] in lexicon.DETERMINERS | lexicon.POSSESSIVES), default=0)
    if not link or not the or not (nouns.match([words[end - 1]]) or words[end - 1] in ("one", "other")):
        return None
    there = [replace(tokens[first], text="there"), replace(tokens[first], text="is")]
    return [*tokens[:first], *there, *tokens[the:]], [(tokens[first], tokens[end - 1])]


def _nothing_but(tokens: Sequence[Token], words: list[str]) -> list[Token] | None:
    """Read "nothing remained on the shelf but a cup and a can" as "on the shelf are a cup and a can"."""
    link = next((n for n in range(1, len(words) - 3) if link_at(tokens, n)), 0)
    but, size = next(
        ((n, len(said)) for n in range(link + 2, len(words) - 2) for said in _BUT
         if tuple(words[n : n + len(said)]) == said and link), (0, 0))  # fmt: skip
    the = but + size
    place = tokens[link : but - (words[but - 1] == ",")]
    counted = words[the] in lexicon.LEADING or words[the].isdecimal()
    if not but or not counted or any(token.mark for token in (*tokens[:link], *place)):
        return None
    verb = next((n for n in range(the, len(words)) if words[n] in FINITE), 0)
    if verb and not lexicon.RELATIVES & {*words[the:verb]}:
        # "Nothing is on the plate but the cup holds a pen."
        return None
    several = numeral(words[the]) > 1 or bool({",", "and"} & {*words[the:]})
    return [*place, replace(tokens[but], text="are" if several else "is"), *tokens[the:]]


def _none_of(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "neither of the two boxes is empty" as "there are two boxes", and "neither chair has a cushion" the same."""
    if words[0] not in _NO or len(words) < 4:
        return None
    start = 2 if words[1] == "of" else 1
    stops = (n for n in range(start + 1, len(words)) if tokens[n].mark or words[n] in FINITE or words[n] == "has")
    verb = next(stops)
    but = [n for n in range(verb, len(words) - 1) if words[n] == "," and words[n + 1] == "but"]
    end = next(n for n in range(verb, len(words)) if n in but or (tokens[n].mark and words[n] != ","))
    named = words[start + (words[start] == "the") : verb]
    if not named or not nouns.match(named[-1:]) or "nor" in named or words[start] in ("but", "them", "these", "those"):
        return None
    number = [] if set(named) & lexicon.NUMBERS.keys() or words[0] == "none" else [replace(tokens[0], text="two")]
    there = [replace(tokens[0], text="there"), replace(tokens[0], text="are"), *number]
    subject = tokens[start + (words[start] == "the" and bool(set(named) & lexicon.NUMBERS.keys())) : verb]
    return [*there, *subject, *tokens[end:]], [(tokens[0], tokens[end - 1])]


def _among(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a shelf holding, among other things, a clock" without the other things."""
    for at in range(1, len(words) - 3):
        if words[at : at + 3] in (["among", "other", "things"], ["amongst", "other", "things"]):
            start, end = at - (words[at - 1] == ","), at + 3 + (words[at + 3] == ",")
            return [*tokens[:start], *tokens[end:]], [(tokens[at], tokens[at + 2])]
    return None


def _useless(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a lamp that doesn't work stands", "a drawer that won't close", without that.

    What it is not on, and does not hold, is more than a remark.
    """
    for at in range(1, len(words) - 3):
        size = next((len(said) for said in _UNABLE if tuple(words[at + 1 : at + 1 + len(said)]) == said), 0)
        if words[at] not in ("that", "which") or not size or at + size > len(words) - 3:
            continue
        verb = at + 1 + size
        end = next(n for n in range(verb, len(words)) if n > verb and (
            tokens[n].mark or words[n] in FINITE | lexicon.STANDING | {"and", "with"} or link_at(tokens, n)
        ))  # fmt: skip
        inside = words[verb:end]
        placed = link_at(tokens, end) > 0 and words[verb] not in _WORKING
        named = any(nouns.match([word]) for word in inside[1:]) or {*inside} & lexicon.DETERMINERS
        if tokens[verb].mark or link_at(tokens, verb) or placed or named or len(inside) > 2:
            continue
        start, after = at - (words[at - 1] == ","), end + (words[at - 1] == "," == words[end])
        return [*tokens[:start], *tokens[after:]], [(tokens[at], tokens[end - 1])]
    return None


def _all_listed(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "everything but the fork: a plate, a knife" as "a plate, a knife"."""
    at = words.index("everything") if "everything" in words else -1
    colon = words.index(":") if at >= 0 and ":" in words[at:] else 0
    excepted = any(tuple(words[n : n + len(said)]) == said for n in range(at + 1, colon) for said in _BUT)
    if not excepted or any(tokens[n].mark for n in (*range(at, colon), colon + 1)):
        return None
    return [*tokens[:at], *tokens[colon + 1 :]], [(tokens[at], tokens[colon - 1])]
