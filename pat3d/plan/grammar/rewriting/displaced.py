"""Phrases that stand elsewhere than what they are said of, where a plainer sentence has them.

"A fork to the left and a knife to the right of a plate" says "of a plate" once for both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.rewriting.colons import goals_of, places_of
from pat3d.plan.grammar.rewriting.wordings import reworded, wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexicon import STANDING
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import EACH_OTHER, LINKS
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

NEARNESS = frozenset({"closer", "closest", "nearer", "nearest"})
_TAKING = frozenset({"pick", "grab", "lift", "grasp"})
_SOME = rf"(?:{'|'.join(lexicon.NUMBERS)}) |the (?:{'|'.join(lexicon.SUPERLATIVES)}) "
_MEMBERS = wordings(
    (
        (rf"of which ({_SOME})(?=(?:{'|'.join(STANDING)}) )", r"\1 of which"),
        # "Two planks, one leaning against the other"
        (r"(, one )(leaning )[^ ]+ (?=[^ ]+ other )", r"\1 of them \2 against"),
    )
)
_BARE = r"(?<!the )(?<!its )((?:left|right) )"
_SIDES = wordings(((rf"{_BARE}(and [^.]*?){_BARE}(?=of )", r"to the \1 \2 to the \3"),))
"""A fork left and a knife right of a plate"""
_SIDE_WORDS = frozenset({"left", "right", "side"})


def in_place(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the other", "of which", orders and shared landmarks where what they are said of stands.

    What is nearest to something is next to it; that it is the nearest is not heard.
    """
    tokens = [
        replace(token, text="next") if token.text in ("nearest", "closest") and follower.text == "to" else token
        for token, follower in pairwise([*_nearer(tokens, nouns), tokens[-1]])
    ]
    return _shared_landmark(_last_in_order(_verb_again(reworded(tokens, _MEMBERS))))


def _nearer(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the can that's closer to the box" as "the can nearest to the box", where it tells which can."""
    words = [token.text for token in tokens]
    made = list(tokens)
    for at in range(len(words) - 2, 1, -1):
        if words[at] not in NEARNESS or "than" in words:
            continue
        relative = words[at - 2] in ("that", "which") and words[at - 1] in ("is", "'s")
        start = at - 2 if relative else at
        name = next((n for n in (3, 2, 1) if n < start and nouns.match(words[start - n : start])), 0)
        named = name and words[start - name - 1] == "the"
        # "Move the can closer to the box" is no name.
        picked = words[0] in _TAKING or start == name + 1 or relative
        if named and picked:
            to = [] if words[at + 1] == "to" else [replace(tokens[at], text="to")]
            made[start : at + 1] = [replace(tokens[at], text="nearest"), *to]
    return made


def by_which(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a bed, next to which there is a rug" as "a bed, and next to the bed is a rug"."""
    made = list(tokens)
    joined = any(
        tokens[at].text == "and" and (size := link_at(tokens, at + 1)) and tokens[at + 1 + size].text == "which"
        for at in range(len(tokens) - 2)
    )
    if joined and sum(token.text == "which" for token in tokens) > 1:
        # "A plate, to the left of which is a fork and to the right of which a knife": both of the plate.
        return made
    for at in range(len(tokens) - 3, 0, -1):
        size = link_at(tokens, at)
        which = at + size
        after = which + 1 + (tokens[min(which + 1, len(tokens) - 1)].text == "there")
        if not size or tokens[which].text != "which" or tokens[min(after, len(tokens) - 1)].text not in STANDING:
            continue
        end = at - (tokens[at - 1].text == ",")
        told = end < at or after > which + 1
        words = [token.text for token in tokens[:end]]
        name = next((n for n in (3, 2, 1) if told and n <= end and nouns.match(words[end - n :])), 0)
        if name:
            joint, the = replace(tokens[at], text="and"), replace(tokens[which], text="the")
            owner = [the, *tokens[end - name : end]] if tokens[at].text != "between" else [replace(the, text="them")]
            made[end:after] = [joint, *tokens[at:which], *owner]
    return made


def which_last(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a bed, next to which a rug lies" as "a bed, next to which lies a rug"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 4):
        size = link_at(tokens, at)
        start = at + size + 1
        if not size or words[start - 1] != "which" or words[start] not in lexicon.DETERMINERS | lexicon.NUMBERS.keys():
            continue
        carried = LINKS.get(tuple(words[at : start - 1]))
        carried = carried is not None and carried.kind in SUPPORT_KINDS
        end = next(n for n in range(start, len(words)) if tokens[n].mark)
        plain = not any(link_at(tokens, n) or words[n] in STANDING for n in range(start, end - 1))
        if end > start + 2 and plain and words[end - 1] in STANDING and not carried:
            return [*tokens[:start], tokens[end - 1], *tokens[start : end - 1], *tokens[end:]]
    return list(tokens)


def which_carries(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a book on which a cup stands lies ..." as "a book with a cup on it lies ...".

    The clause may be set off: "a book, on which a cup stands, lies ...".
    """
    for at in range(1, len(tokens) - 5):
        size = link_at(tokens, at)
        start = at + size + 1
        comma = int(tokens[at - 1].text == ",")
        owner = tokens[at - 1 - comma].text
        if not size or tokens[start - 1].text != "which" or not nouns.match([owner]):
            continue
        there = tokens[start].text == "there" and tokens[start + 1].text in lexicon.COPULAS
        first = start + 2 * there
        named = tokens[first].text in lexicon.DETERMINERS or tokens[first].text in lexicon.NUMBERS
        verb = next((n for n in range(first + 1, len(tokens)) if tokens[n].mark or tokens[n].text in STANDING), first)
        end = verb if there else verb + 1
        plain = not any(link_at(tokens, n) or tokens[n].text == "and" for n in range(first, verb))
        closed = not comma or tokens[min(end, len(tokens) - 1)].text == ","
        end += comma
        goes_on = tokens[min(end, len(tokens) - 1)].text in STANDING
        if named and plain and closed and not (tokens[verb].mark and not (there and comma)) and goes_on:
            them = replace(tokens[start - 1], text="them" if singulars(owner) else "it")
            return [*tokens[: at - comma], replace(tokens[at], text="with"), *tokens[first:verb],
                    *tokens[at : start - 1], them, *tokens[end:]]  # fmt: skip
    return list(tokens)


def which_bears(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a desk on which a cup, a mug and a can are arranged" as "a desk on which are a cup, ...".

    Where the sentence goes on behind its verb, the desk is one "with a cup, a mug and a can on it".
    """
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 5):
        size, comma = link_at(tokens, at), words[at - 1] == ","
        first = at + size + 1
        if not size or words[first - 1] != "which" or not nouns.match([words[at - 1 - comma]]):
            continue
        if words[first] not in lexicon.DETERMINERS | lexicon.NUMBERS.keys() and not words[first].isdecimal():
            continue
        stop = next(n for n in range(first, len(words)) if words[n] in (".", ":"))
        verb = next((n for n in range(first + 1, stop) if words[n] in STANDING), 0)
        named = any(nouns.match([word]) for word in words[verb + 1 : stop] if word not in lexicon.PARTICIPLES)
        if not verb or "and" not in words[first:verb]:
            continue
        if not named and stop - verb < 4:
            return [*tokens[:first], replace(tokens[verb], text="are"), *tokens[first:verb], *tokens[stop:]]
        further = verb + 1 + (words[verb + 1] == ",")
        if words[further] in STANDING:
            having, it = replace(tokens[at], text="with"), replace(tokens[first - 1], text="it")
            return [*tokens[: at - comma], having, *tokens[first:verb], *tokens[at : first - 1], it, *tokens[further:]]
    return list(tokens)


def _last_in_order(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "on it stand, in a row, a clock and a lamp" as "on it stand a clock and a lamp in a row"."""
    words = [token.text for token in tokens]
    size = next((n for n in range(2, 6) if tuple(words[:n]) in EACH_OTHER and link_at(tokens, n)), 0)
    if size and ":" in words:
        # "From left to right on a shelf: a clock and a vase"
        stop = next(n for n in range(size, len(words)) if tokens[n].mark and words[n] not in (",", ":"))
        return [*tokens[size:stop], *tokens[:size], *tokens[stop:]]
    for at in range(1, len(words) - 3):
        told = words[at - 1] in ("it", "them", "with") or words[at - 1] in STANDING
        close = next((n for n in range(at + 2, min(at + 7, len(words) - 1)) if words[n] in (",", ":")), 0)
        if words[at] != "," or not told or not close or tuple(words[at + 1 : close]) not in EACH_OTHER:
            continue
        stop = next(n for n in range(close, len(words)) if tokens[n].mark and words[n] not in (",", ":"))
        owned = words[stop - 2 : stop] in (["on", "it"], ["in", "it"])
        end = stop - 2 if owned and words[at - 1] == "with" else stop
        stands = words[close + 1] in STANDING or words[at - 1] not in ("it", "them")
        verb = [] if stands else [replace(tokens[at], text="are", mark=False)]
        return [*tokens[:at], *verb, *tokens[close + 1 : end], *tokens[at + 1 : close], *tokens[stop:]]
    return list(tokens)


def stateless(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "lies folded on" as "lies on", "the remaining two" as "the other two".

    "The remaining ones grey" are "the others grey".
    """
    made: list[Token] = []
    for at, token in enumerate(tokens):
        ones = token.text == "ones" and at > 1 and tokens[at - 1].text == "remaining" and tokens[at - 2].text == "the"
        if ones and is_colour_word(tokens[at + 1].text):
            made[-1] = replace(made[-1], text="others", end=token.end)
            continue
        state = token.text.endswith("ed") and token.text not in lexicon.PARTICIPLES and not nouns.match([token.text])
        follows = made and made[-1].text in lexicon.VERBS and not link_at(tokens, at)
        if state and follows and link_at(tokens, at + 1):
            continue
        made.append(
            replace(token, text="other") if token.text == "remaining" and made and made[-1].text == "the" else token
        )
    return made


def _shared_landmark(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a fork to the left, and a knife to the right, of a plate" as "to the left of a plate and ...

    a knife to the right of the plate".
    """
    tokens = reworded(tokens, _SIDES)
    words = [token.text for token in tokens]
    sides = [at for at in range(len(words) - 3) if words[at] in ("to", "on") and words[at + 1] == "the"
             and words[at + 2] in ("left", "right", "front", "back")]  # fmt: skip
    for one, two in pairwise(sides):
        of = two + 3 + (words[two + 3] == ",")
        between = words[one + 3 : two]
        if (
            words[of] != "of"
            or "and" not in between[:2]
            or len(between) < 3
            or any(link_at(tokens, n) > 1 for n in range(one + 3, two))
        ):
            continue
        end = next(n for n in range(of + 1, len(words)) if tokens[n].mark or (n > of + 1 and (
            words[n] == "and" or (words[n] != "of" and (link_at(tokens, n) or words[n] in STANDING)))))  # fmt: skip
        landmark = list(tokens[of:end])
        if tokens[end - 1].text == words[one - 1]:
            # "a knife to the right and a spoon to the right of the knife": the knife is right of what is said before.
            continue
        counts = {"a", "an", *lexicon.NUMBERS}
        again = [replace(token, text="the") if token.text in counts and before.text != "the" else token
                 for before, token in pairwise([tokens[two], *landmark])]  # fmt: skip
        start = one + 3 + (words[one + 3] == ",")
        return [*tokens[: one + 3], *landmark, *tokens[start : two + 3], *again, *tokens[end:]]
    return list(tokens)


def _verb_again(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "put the jam left of the plate and the mug on it" as "... and put the mug on it".

    So is "put the ring in the box and the box in the drawer", where the box is to be moved.
    """
    words = [token.text for token in tokens]
    for at in (n for n, word in enumerate(words) if word in ("put", "place", "set") and (not n or tokens[n - 1].mark)):
        end = next(n for n in range(at, len(words)) if words[n] in (".", ":") or words[n : n + 2] == [",", "then"])
        parts = goals_of(tokens[at + 1 : end])
        plain = len(parts) > 1 and all(part[0].text == "the" and len(places_of(part)) == 1 for part in parts)
        start, stop = places_of(parts[0])[0] if plain else (0, 0)
        first = LINKS.get(tuple(each.text for each in parts[0][start:stop])) if plain else None
        beside = first is not None and first.kind in LATERAL_KINDS and first.manner != "between"
        # The box of "in the box and the box in the drawer"
        again = plain and any(one[-1].text == other[places_of(other)[0][0] - 1].text for one, other in pairwise(parts))
        if (beside and words[end - 1] not in _SIDE_WORDS) or again:
            told = [(replace(part[0], text="and"), replace(part[0], text=words[at]), *part) for part in parts]
            return [*tokens[: at + 1], *[each for part in told for each in part][2:], *tokens[end:]]
    return list(tokens)


def fronted(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "stacked on the chair are three books" as "on the chair are three books stacked"."""
    tokens = _places_ahead(tokens)
    verb = next((n for n, token in enumerate(tokens) if token.text in ("is", "are")), 0)
    if verb < 3 or tokens[0].text not in ("stacked", "piled") or not link_at(tokens, 1):
        return list(tokens)
    end = next(n for n in range(verb, len(tokens)) if tokens[n].mark)
    return [*tokens[1:end], replace(tokens[0], text="stacked"), *tokens[end:]]


def _places_ahead(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "on the desk, next to the clock, is a cup" as "on the desk, next to the clock is a cup"."""
    words = [token.text for token in tokens]
    size = link_at(tokens, 0)
    verb = next((n for n, word in enumerate(words) if word in STANDING or word == "there"), 0)
    first = words.index(",") if "," in words else 0
    place = tuple(words[first + 1 : first + 1 + link_at(tokens, first + 1)]) in LINKS
    if size and size < first < verb - 2 and words[verb - 1] == "," and place:
        return [*tokens[: verb - 1], *tokens[verb:]]
    return tokens
