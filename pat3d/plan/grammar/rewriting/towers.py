"""Stacks of which the sentence says who is below whom, as "a stack of a plate, a bowl and a cup", the lowest first.

"From bottom to top: a plate, a bowl", "three blocks, the red one at the bottom, the blue one on top" and "a tower of
blocks from top to bottom: red, blue" all say so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_UPWARDS = (("from", "bottom", "to", "top"), ("from", "the", "bottom", "to", "the", "top"), ("bottom", "to", "top"),
            ("from", "the", "bottom", "up"), ("from", "bottom", "up"))  # fmt: skip
_DOWNWARDS = (("from", "top", "to", "bottom"), ("from", "the", "top", "to", "the", "bottom"), ("top", "to", "bottom"),
              ("from", "the", "top", "down"), ("from", "top", "down"))  # fmt: skip
_LEVELS: dict[tuple[str, ...], int] = {
    **dict.fromkeys([("at", "the", "bottom"), ("on", "the", "bottom"), ("on", "bottom"), ("at", "bottom"),
                     ("at", "its", "base"), ("at", "the", "base")], 0),
    **dict.fromkeys([("in", "the", "middle"), ("in", "between"), ("in", "the", "centre"), ("in", "the", "center")], 50),
    **dict.fromkeys([("at", "the", "top"), ("on", "top"), ("on", "the", "top"), ("at", "top")], 100),
}  # fmt: skip
_PLAIN = {
    **{word: plain for word, (plain, _) in lexicon.SUPERLATIVES.items() if word.endswith("est")},
    "smallest": "smaller", "largest": "larger", "biggest": "bigger",
}  # fmt: skip
"""Superlatives in words that things are described with; a small plate is a saucer."""
_JOINTS = frozenset({",", ":", "and", ";", "with", "then", "-"})
_ARTICLES = frozenset({"the", "a", "an", "one"})
_STACKS = frozenset({"stack", "tower", "pile", "column", "stacked", "piled"})

_PUTTING = frozenset({"put", "place", "set", "lay", "add", "balance", "rest"})
_BUILDING = frozenset({"build", "make", "create", "construct", "erect", "form"})
_BUILT = frozenset({"stack", "tower", "pile", "column", "pyramid"})
_MADE_OF = (("with",), ("which", "has"), ("that", "has"), ("made", "of"), ("built", "of"), ("built", "from"),
            ("consisting", "of"), ("of",), ("has",), ("made", "from"), ("containing",), ("out", "of"),
            ("built", "out", "of"), ("made", "out", "of"), ("built", "with"), ("using",))  # fmt: skip
_UPON = (("on", "top"), ("on", "it"), ("on", "that"), ("on", "top", "of", "it"), ("on", "top", "of", "that"))
"""What is said of each of a tower behind the lowest."""


def from_below(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence, with a stack of which the order is said as a list from its lowest to its highest."""
    tokens = _climbing(tokens)
    words = [token.text for token in tokens]
    found = _listed(tokens, words) or _levelled(tokens, words, nouns) or _topped(tokens, words)
    if found is None:
        return list(tokens)
    intro, parts = _stacked(found[0]), found[1]
    said = [token.text for token in intro]
    if to_stack := _to_be_stacked(intro, parts, nouns):
        return _one_on_another(tokens, to_stack)
    if {"the", "and"} & set(said) or any(word in FINITE for word in said):
        # What is there already is to be stacked, or is listed before.
        return list(tokens)
    if _asked_for(said) and all(part[0].text == "the" and not _headless(part, nouns) for part in parts):
        return _one_on_another(tokens, parts)
    noun, tail, count = _intro(intro, nouns)
    look = _look(intro, noun)
    headless = all(_headless(part, nouns) for part in parts)
    if noun is not None and not headless and not _STACKS & set(said):
        # "A box with a ball at the bottom and a cup on top"
        return list(tokens)
    named = [_named(part, noun, look, nouns) for part in parts]
    if None in named or any(link_at(part, n) for part in parts for n in range(len(part))):
        return list(tokens)
    if count and count < len(parts) + (len(parts) == 1):
        return list(tokens)
    lowest = [part for part in named if part is not None]
    builds = _BUILDING & {*said[:2]} and _BUILT & {*said} and not tail
    if builds and headless and count in (0, len(parts)) and len(parts) > 1:
        return _one_on_another(tokens, [[replace(part[0], text="the"), *part[1:]] for part in lowest])
    if noun is not None and count > len(parts):
        *number, others = _others(noun, count - len(parts))
        lowest.insert(len(parts) > 1, [*number, *look, others])
    like = tokens[0]
    a, stack, of = (replace(like, text=word, mark=False) for word in ("a", "stack", "of"))
    listed: list[Token] = []
    for at, part in enumerate(lowest):
        if at:
            last = at == len(lowest) - 1
            listed.append(replace(part[0], text="and" if last else ",", mark=not last))
        listed += part
    if len(parts) == 1 and count != 2:
        listed = [*lowest[0], *(replace(like, text=word, mark=False) for word in ("with",)), *lowest[-1]]
        listed += [replace(like, text=word, mark=False) for word in ("on", "top")]
    opening = [*tail, replace(like, text="is", mark=False)] if tail and link_at(tail, 0) else []
    return [*opening, a, stack, of, *listed, tokens[-1]]


def _climbing(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "a tower: a cube on the mat, a can on it, then a ball on top" as "... a ball on the can".

    "Put the cube on the mat, the can on it, then the ball on top" so too.
    """
    words = [token.text for token in tokens]
    start = words.index(":") + 1 if ":" in words and {*_BUILT} & {*words[: words.index(":")]} else 0
    tasks = words[start] in _PUTTING
    parts = _parts(tokens[start + tasks : -1])
    tails = [next((size for size in (4, 2) if tuple(each.text for each in part[-size:]) in _UPON), 0) for part in parts]
    places = [next((n for n in range(1, len(part)) if link_at(part, n) and part[n].text != "of"), 0) for part in parts]
    whole = all(tail and len(part) > tail for part, tail in zip(parts[1:], tails[1:], strict=True)) and places[:1] > [0]
    plain = (start or words[-3:] == ["on", "top", "."]) and not any(word in FINITE for word in words[start:])
    if len(parts) < (2 if start else 3) or not whole or not plain or tails[0]:
        return tokens
    tasks = tasks or (words[0] in _BUILDING and all(part[0].text == "the" for part in parts))
    made, below = list[Token](), list[Token]()
    for part, tail, place in zip(parts, tails, places, strict=True):
        name = part[: -tail if tail else place]
        goal = [replace(part[-1], text="on"), *below] if tail else part[place:]
        made += [replace(name[0], text=",", mark=True)] if made else []
        made += [*([replace(name[0], text="put")] if tasks else []), *name]
        made += goal if tasks else [replace(name[-1], text="is"), *goal]
        below = [replace(name[0], text="the"), *name[name[0].text in lexicon.DETERMINERS :]]
    return [*made, tokens[-1]]


def _stacked(intro: list[Token]) -> list[Token]:
    """`intro` with "three cubes are stacked in a tower" as "three cubes stacked"."""
    words = [token.text for token in intro]
    at = next((n for n in range(1, len(words) - 1) if words[n] == "are" and words[n + 1] in _STACKS), 0)
    said = at and tuple(words[at + 2 :])
    plain = said in ((), ("up",), ("on", "top", "of", "each", "other"), ("on", "top", "of", "one", "another"))
    plain = plain or (at and len(words) == at + 5 and words[at + 2] == "in" and words[at + 4] in _STACKS)
    return [*intro[:at], intro[at + 1]] if at and plain else intro


def _others(noun: Token, more: int) -> list[Token]:
    """As many of `noun` as are in a stack besides those that are told of; "cubes" where nobody says how many."""
    if more < 0:
        return [replace(noun, text=_plural(noun, 2))]
    number = next(word for word, value in lexicon.NUMBERS.items() if value == more and word not in ("an", "single"))
    return [replace(noun, text=number if more > 1 else "a"), replace(noun, text=_plural(noun, more))]


def _asked_for(words: list[str]) -> bool:
    """Whether `words` are "build a tower", and a sentence that goes on with what is there is a task."""
    asked = words[1:] if words[:1] == ["please"] else words
    counted = any(word in lexicon.NUMBERS and word != "a" for word in asked)
    return len(asked) > 1 and asked[0] in _BUILDING and asked[-1] in _BUILT and not counted


def _to_be_stacked(intro: list[Token], parts: Sequence[Sequence[Token]], nouns: Nouns) -> list[list[Token]] | None:
    """The `parts` of "stack the bowls, red at the bottom and blue on top" as "the red bowl", "the blue bowl"."""
    words = [token.text for token in intro]
    first = 1 + (words[:1] == ["please"])
    led = words[first - 1 : first] in (["stack"], ["pile"]) and words[first : first + 1] in (["the"], ["these"])
    noun, rest, count = _intro(intro[first:], nouns) if led else (None, [], 0)
    ones = all(_headless(part, nouns) or (noun and part[-1].text == noun.text) for part in parts)
    if noun is None or rest or count > len(parts) or "and" in words or not ones:
        return None
    named = (_named(part, noun, _look(intro[first:], noun), nouns) for part in parts)
    return [[replace(part[0], text="the"), *part[1:]] for part in named if part]


def _one_on_another(tokens: Sequence[Token], parts: Sequence[Sequence[Token]]) -> list[Token]:
    """The tasks by which `parts`, the lowest first, come to be a tower: "stack the red cube on the blue one"."""
    made: list[Token] = []
    for below, part in pairwise(parts):
        stack, on, joint = (replace(part[0], text=word) for word in ("stack", "on", "and"))
        made += [*([joint] if made else []), replace(stack, start=tokens[0].start), *part, on, *below]
    return [*made, tokens[-1]]


def of_things(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a tower with exactly three blocks" as "a tower of three blocks", and what is on top with it."""
    tokens = _topping(_in_a_tower(_out_of(tokens), nouns), nouns)
    words = [token.text for token in tokens]
    for at in range(len(words) - 3):
        if words[at] not in _BUILT:
            continue
        end = next((at + 1 + len(said) for said in _MADE_OF if tuple(words[at + 1 : at + 1 + len(said)]) == said), 0)
        end += end and words[end] in ("exactly", "precisely")
        if (
            not end
            or lexicon.NUMBERS.get(words[end], 1 if words[end].isdecimal() else 0) < 1
            or words[end] in _ARTICLES
        ):
            continue
        stop = next(n for n in range(end, len(words)) if tokens[n].mark or words[n] == "and" or link_at(tokens, n))
        if not any(nouns.match([guess]) for guess in (words[stop - 1], *singulars(words[stop - 1]))):
            continue
        made = [*tokens[: at + 1], replace(tokens[at + 1], text="of"), *tokens[end:stop]]
        top = next((n for n in range(stop, len(words)) if tuple(words[n : n + 3]) == ("at", "the", "top")
                    or tuple(words[n : n + 2]) == ("on", "top")), 0)  # fmt: skip
        size = 2 if top and words[top] == "on" else 3
        upper = list(tokens[stop + 1 + (top > 0 and words[stop + 1] in _PUTTING) : top])
        whole = top and words[stop] == "and" and not any(each.mark or each.text == "and" for each in upper)
        deed = bool(upper) and upper[0].text in _PUTTING
        if whole and not deed and words[top + size] != "of" and not any(link_at(upper, n) for n in range(len(upper))):
            name = next((guess for guess in (*singulars(words[stop - 1]), words[stop - 1]) if nouns.match([guess])), "")
            upper = [replace(each, text=name) if each.text == "one" and n else each for n, each in enumerate(upper)]
            on_top = [replace(tokens[top], text=word) for word in ("on", "top")]
            return [*made, replace(tokens[stop], text="with"), *upper, *on_top, *tokens[top + size :]]
        return [*made, *tokens[stop:]]
    return list(tokens)


def _in_a_tower(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a doll and five blocks stacked in a tower" as "a doll and a tower of five blocks"."""
    words = [token.text for token in tokens]
    for at in range(3, len(words) - 4):
        stacked = words[at] in ("stacked", "piled") and words[at + 1] in ("in", "into") and words[at + 3] in _BUILT
        first = at - 1
        while first and is_modifier(words[first - 1]):
            first -= 1
        number = lexicon.NUMBERS.get(words[first - 1], 2 if words[first - 1].isdecimal() else 0)
        named = nouns.match(words[at - 1 : at]) is not None and number > 1
        if stacked and words[at + 2] == "a" and named and words[first - 2] in ("and", ","):
            like = tokens[first - 1]
            form = [replace(like, text=word, end=like.start) for word in ("a", words[at + 3], "of")]
            return [*tokens[: first - 1], *form, *tokens[first - 1 : at], *tokens[at + 4 :]]
    return list(tokens)


def _topping(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "with three stacked plates and a bowl on top" as "... a bowl on top of the plates"."""
    words = [token.text for token in tokens]
    for at in range(3, len(words) - 4):
        top = next((n for n in range(at + 2, min(at + 7, len(words) - 1)) if words[n : n + 2] == ["on", "top"]), 0)
        end = top + 2 + 2 * (words[top + 2 : top + 4] in (["of", "them"], ["of", "it"]))
        led = words[at] == "and" or (words[at] == "with" and {"with", "holding"} & {*words[:at]})
        if not led or words[at + 1] not in ("a", "an", "one") or not top or not tokens[end].mark:
            continue
        first = at - 1
        while first and (is_modifier(words[first - 1]) or words[first - 1] == "stacked"):
            first -= 1
        stacked = "stacked" in words[first:at] or (
            words[first - 2 : first - 1] == ["of"] and words[first - 3] in _BUILT
        )
        members, upper = nouns.match([words[at - 1]]), nouns.match([words[top - 1]])
        whole = stacked and members is not None and members.plural and upper is not None
        if whole and not any(link_at(tokens, n) for n in range(at + 1, top)):
            number = [word for word in words[max(first - 1, 0) : at] if word in lexicon.NUMBERS or word.isdecimal()]
            of = [replace(tokens[end - 1], text=word) for word in ("of", "the", *number[:1], words[at - 1])]
            return [*tokens[: top + 2], *of, *tokens[end:]]
    return list(tokens)


def _out_of(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a tower out of three blocks" as "a tower of three blocks"."""
    return [
        token for at, token in enumerate(tokens)
        if not (token.text == "out" and at and tokens[at - 1].text in _BUILT and tokens[at + 1].text == "of")
    ]  # fmt: skip


def _listed(tokens: Sequence[Token], words: Sequence[str]) -> tuple[list[Token], list[list[Token]]] | None:
    """What stands before "from bottom to top:", and what is listed behind it, the lowest first."""
    for at in range(len(words)):
        for phrases, way in ((_UPWARDS, 1), (_DOWNWARDS, -1)):
            size = next((len(p) for p in phrases if tuple(words[at : at + len(p)]) == p), 0)
            if not size:
                continue
            parts = _parts(tokens[at + size : -1])
            before = list(tokens[:at])
            while before and before[-1].text in (":", ",", "-", "in", "order", "this", "following"):
                before.pop()
            if len(parts) > 1:
                return before, parts[::way]
    return None


def _levelled(
    tokens: Sequence[Token], words: Sequence[str], nouns: Nouns
) -> tuple[list[Token], list[list[Token]]] | None:
    """What stands before "the red one at the bottom, the blue one on top", and these, the lowest first."""
    end = len(tokens) - 1
    levels_said = _LEVELS | ({("below",): 0, ("above",): 100} if "stack" in words[:2] else {})
    ranked: list[tuple[int, list[Token]]] = []
    starts = [0, *(at + 1 for at, word in enumerate(words[:-1]) if word in _JOINTS)]
    first = end
    for at, start in enumerate(starts):
        stop = starts[at + 1] - 1 if at + 1 < len(starts) else end
        part = [token for token in tokens[start:stop] if token.text not in ("finally", "lastly")]
        if not part:
            continue
        key = next(
            (key for key in levels_said if tuple(words[stop - len(key) : stop]) == key and len(part) > len(key)), None
        )
        if key is not None:
            ranked.append((levels_said[key], part[: -len(key)]))
            first = min(first, start)
        elif ranked and (words[start - 1] == "then" or (_headless(part, nouns) and stop < end)):
            # "red at the bottom, then blue, green and white on top"
            ranked.append((ranked[-1][0] + (-1 if ranked[0][0] == 100 else 1), part))
        elif ranked:
            return None
    levels = {level for level, _ in ranked}
    if len(ranked) < 2 or len(levels) < len(ranked) or 0 not in levels:
        return None
    before = list(tokens[:first])
    while before and before[-1].text in _JOINTS:
        before.pop()
    return before, [part for _, part in sorted(ranked, key=lambda each: each[0])]


def _topped(tokens: Sequence[Token], words: Sequence[str]) -> tuple[list[Token], list[list[Token]]] | None:
    """What stands before "the smallest on top" of a stack of which nothing else is told, and that."""
    size = next(
        (len(key) for key, level in _LEVELS.items() if level == 100 and tuple(words[-1 - len(key) : -1]) == key), 0
    )
    end = len(words) - 1 - size
    start = max((n + 1 for n in range(end) if words[n] in (",", "with", "and", ";")), default=0)
    part = [token for token in tokens[start:end] if token.text not in _ARTICLES]
    before = list(tokens[:start])
    while before and before[-1].text in _JOINTS:
        before.pop()
    stacked = bool(_STACKS & {token.text for token in before})
    sized = size and len(part) == 1 and part[0].text in lexicon.SUPERLATIVES
    return (before, [list(tokens[start:end])]) if stacked and sized else None


def _parts(tokens: Sequence[Token]) -> list[list[Token]]:
    """What commas and "and" part in `tokens`, without them."""
    made: list[list[Token]] = [[]]
    for token in tokens:
        if token.text in _JOINTS:
            made.append([])
        elif token.text not in ("finally", "lastly"):
            made[-1].append(token)
    return [part for part in made if part]


def _intro(tokens: Sequence[Token], nouns: Nouns) -> tuple[Token | None, list[Token], int]:
    """Of "a stack of four cubes on a table" the cubes, what follows them, and how many they are; 0 where not said."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 2) if words[n : n + 2] == ["in", "a"] and words[n + 2] in _STACKS), -1)
    tokens = [*tokens[:at], *tokens[at + 3 :]] if at > 0 else tokens
    for at, token in enumerate(tokens):
        name = next((guess for guess in (*singulars(token.text), token.text) if nouns.match([guess])), None)
        before_a_noun = at + 1 < len(tokens) and nouns.match([tokens[at + 1].text]) is not None
        if name is None or token.text in _STACKS or link_at(tokens, at) or (before_a_noun and is_modifier(token.text)):
            continue
        led = any(link_at(tokens, n) and tokens[n].text != "of" for n in range(at))
        if led:
            return None, list(tokens), 0
        numbers = [lexicon.NUMBERS.get(each.text, 0) for each in tokens[:at] if each.text not in ("a", "an", "one")]
        rest = [each for each in tokens[at + 1 :] if each.text not in _STACKS]
        return replace(token, text=name), rest, max([0, *numbers])
    link = next((n for n in range(len(tokens)) if link_at(tokens, n) and tokens[n].text != "of"), len(tokens))
    return None, list(tokens[link:]), 0


def _look(tokens: Sequence[Token], noun: Token | None) -> list[Token]:
    """What is said of `noun` in `tokens` before it, and so of each: the "wooden" of "four wooden cubes"."""
    at = next((n for n, token in enumerate(tokens) if noun is not None and token.start == noun.start), 0)
    first = at
    while first and is_modifier(tokens[first - 1].text) and tokens[first - 1].text not in _STACKS | {"stacked"}:
        first -= 1
    return list(tokens[first:at])


def _named(part: Sequence[Token], noun: Token | None, look: Sequence[Token], nouns: Nouns) -> list[Token] | None:
    """`part` as a thing of its own: "the red one" and "red" as "a red block"; None where it is none."""
    part = [replace(token, text=_PLAIN.get(token.text, token.text)) for token in part]
    words = [token.text for token in part]
    if any(word in FINITE for word in words):
        return None
    article = replace(part[0], text="a")
    if _headless(part, nouns):
        bare = [token for token in part if token.text not in _ARTICLES]
        return [article, *bare, *look, noun] if noun is not None else None
    if words[0] == "the" or not (
        words[0] in lexicon.DETERMINERS or words[0] in lexicon.NUMBERS or words[0].isdecimal()
    ):
        return [article, *part[words[0] == "the" :]]
    return list(part)


def _headless(part: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `part` describes and names nothing: "the red one", "red"."""
    bare = [token.text for token in part if token.text not in _ARTICLES]
    described = all(is_modifier(word) or word in lexicon.SUPERLATIVES for word in bare)
    return bool(bare) and described and not nouns.match(bare[-1:])


def _plural(noun: Token, count: int) -> str:
    return (
        noun.text if count == 1 else f"{noun.text}es" if noun.text.endswith(("x", "s", "ch", "sh")) else f"{noun.text}s"
    )
