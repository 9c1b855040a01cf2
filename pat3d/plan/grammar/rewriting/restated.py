"""Verbs and small words in plainer ones: "two books cover the desk" as "two books are on the desk"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.english import plural
from pat3d.plan.grammar.rewriting.wordings import wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_marked, is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import SUPPORT_KINDS

EMPTIED = wordings(((
    rf"(?:{'|'.join(lexicon.COPULAS)}) (?:empty|bare|clear|free|clean) (?:(?:except|but|save) for|(?:apart|aside) from"
    rf"|except) (?=(?:{'|'.join(lexicon.DETERMINERS | lexicon.NUMBERS.keys())}) )", "carries"),))  # fmt: skip
"""What carries something where it is "empty except for" that."""
_INTO = frozenset({"in", "into", "inside", "on", "onto", "upon", "to", "at"})
"""Words before what something is put in or on."""
_COVERING = frozenset({"litter", "litters", "clutter", "clutters", "cluttered", "occupy", "occupies",
    "occupied", "adorn", "adorns", "adorned", "grace", "graces", "graced", "decorate", "decorates", "crowd", "crowds",
    "littered", "littering", "cluttering", "adorning", "crowding", "dotting"})  # fmt: skip
"""Verbs of what is on something."""
_OVER = frozenset({"cover", "covers"})
"""Verbs of what is on something, or over it: a bowl upside down."""
_TOWERING = frozenset({"towers", "looms"})
_POSING = _TOWERING | {"glows", "glow", "shines", "shine", "gleams", "gleam", "flickers", "flicker", "burns",
    "glistens", "sparkles"}  # fmt: skip
"""Verbs of how something looks where it stands."""
_SHINING = {"shines": ("points", "at"), "shine": ("are", "pointing", "at"), "shining": ("pointing", "at")}
_UPON = frozenset({"on", "onto", "upon", "at", "over"})
"""Words before what a lamp lights."""
_NEAR = frozenset({"behind", "beside", "under", "on", "near", "between", "over", "above", "by", "beneath"})
_BELOW = frozenset({"under", "underneath", "beneath", "below"})
_JOINING = frozenset({"and", ",", "with"})
_ONE_OF = frozenset({"one", "other", "another", "first", "second", "third", "fourth", "last", "left", "right"})
"""Words for one of several that are not named again."""


def _own(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "each on its own mat" and "each on a mat of its own" as "each on a mat"."""
    made: list[Token] = []
    each = False
    for at, token in enumerate(tokens):
        words = [other.text for other in tokens[at : at + 3]]
        each = each or token.text == "each"
        owned = each and words[1:2] == ["own"] and words[0] in ("its", "their")
        if made and made[-1].text == "of" and owned:
            made.pop()
        elif owned:
            made.append(replace(token, text="a"))
        elif not (each and token.text == "own"):
            made.append(token)
    return made


def _shining(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a lamp shines on a book" as "points at a book": no lamp stands there, as it may on a desk."""
    words = [token.text for token in tokens]
    for at in (n for n in range(len(words) - 3, 0, -1) if words[n] in _SHINING):
        upon = at + 1 + (words[at + 1] == "down")
        named = next((n for n in range(upon + 1, len(words)) if tokens[n].mark or nouns.match([words[n]])), upon)
        lit = nouns.match([words[named]])
        desk = lit is None or (words[upon] == "on" and nouns.of_class(lit.noun, lexicon.LEVEL))
        if words[upon] in _UPON and (not desk or words[upon + 1] in ("it", "them")):
            points = [replace(tokens[at], text=word) for word in _SHINING[words[at]]]
            return _shining([*tokens[:at], *points, *tokens[upon + 1 :]], nouns)
    return list(tokens)


def _posing(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a lamp glows behind the clock" as "stands behind", "towers over it" as "stands next to it"."""
    made = _shining(tokens, nouns)
    tokens = list(made)
    for at in range(len(tokens) - 3, 0, -1):
        word, before = tokens[at].text, tokens[at - 1].text
        size = link_at(tokens, at + 1)
        near = size > 1 or tokens[at + 1].text in _NEAR
        # "Two cup towers on a table", "the block towers next to it": things.
        thing = nouns.match([before, word]) is not None or tokens[max(at - 2, 0)].text in lexicon.NUMBERS
        if word not in _POSING or not near or nouns.match([before]) is None or (word in _TOWERING and thing):
            continue
        made[at] = replace(tokens[at], text="stands" if word.endswith("s") else "stand")
        if word in _TOWERING and tokens[at + 1].text in ("over", "above"):
            made[at + 1 : at + 2] = [replace(tokens[at + 1], text=said) for said in ("next", "to")]
    return made


def _of_material(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the one on the right, which is made of metal, holds" as "the metal one on the right holds"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 6):
        told = words[at] == "," and words[at + 1] in ("which", "that") and words[at + 2] in ("is", "are")
        after = at + 6 + (words[at + 6] == ",")
        if not told or words[at + 3 : at + 5] != ["made", "of"] or not is_modifier(words[at + 5]):
            continue
        head = next((n for n in range(at - 1, 0, -1) if words[n] in ("one", "ones") or nouns.match([words[n]])), 0)
        while head > 1 and nouns.match(words[head - 1 : head + 1]):
            head -= 1
        if head and tokens[at + 6].mark and not any(token.mark for token in tokens[head:at]):
            return [*tokens[:head], tokens[at + 5], *tokens[head:at], *tokens[after:]]
    return list(tokens)


def bare(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "only a cup" as "a cup", "on that: a cup" as "on that one", "the rest red" as "... are red"."""
    tokens = _of_material(_posing(_own(tokens), nouns), nouns)
    kept: list[Token] = []
    for at, token in enumerate(tokens):
        if token.text == "others" and tokens[min(at + 1, len(tokens) - 1)].text in ("stay", "remain"):
            token = replace(token, text="rest")
        if token.text == "between" and "jaws" in [other.text for other in tokens[at + 2 : at + 4]]:
            token = replace(token, text="in")
        before, follower = (kept[-1].text if kept else ""), tokens[min(at + 1, len(tokens) - 1)]
        kept_rest = token.text in ("others", "rest", "other") and before == "the" and is_colour_word(follower.text)
        if kept_rest and tokens[min(at + 2, len(tokens) - 1)].mark:
            # "four of them are red, the others blue"
            kept += [token, replace(token, text="is" if token.text == "other" else "are")]
            continue
        if token.text in ("only", "just", "merely", "simply", "solely") and follower.text in ("a", "an", "some"):
            continue
        if token.text in ("itself", "themselves") and (before == "which" or (
                nouns.match([before]) and (follower.text in FINITE or (follower.text,) in LINKS))):  # fmt: skip
            continue
        first, placed = tokens[0].text in lexicon.DEFINITE, before in ("is", "are")
        if first and placed and token.text == "the" and follower.text == "one" and link_at(tokens, at + 2):
            # "The brown bottle is the one in the middle."
            continue
        if first and placed and token.text == "one" and tokens[at - 1].text == "the" and link_at(tokens, at + 1):
            continue
        if token.text == "nothing" and follower.mark and nouns.match([before]):
            # "The left bowl holds an egg and the right bowl nothing."
            kept += [replace(token, text=word) for word in ("is", "empty")]
            continue
        if token.text == "one" and before == "each" and follower.text in FINITE:
            continue
        if token.text == "they" and follower.text == "each" and not before:
            # "They each hold a ball."
            continue
        state = is_modifier(follower.text) or is_marked(follower.text)
        if token.text in ("both", "all") and before in lexicon.COPULAS and len(kept) > 1 and state:
            # "They are both yellow."
            continue
        # "In that one lies a coin", "on that: a cup": in and on the one named last. "By that a cup" is by it.
        later = tokens[min(at + 2, len(tokens) - 1)]
        one = follower.text == "one" and (later.mark or later.text in FINITE or later.text in lexicon.DETERMINERS)
        pointing = token.text in ("that", "this") and not one
        size = next((n for n in range(min(at, 4), 0, -1) if link_at(tokens, at - n) == n), 0) if pointing else 0
        opens = at == size or tokens[at - size - 1].text in (",", ";", "and")
        if size and (follower.text in ("a", "an", ",", ":") or follower.text in lexicon.NUMBERS or (
                opens and follower.text in lexicon.STANDING | {"there"})):  # fmt: skip
            link = LINKS.get(tuple(each.text for each in tokens[at - size : at]))
            carried = link is not None and link.kind in SUPPORT_KINDS
            kept += [replace(token, text=word) for word in (("that", "one") if carried else ("it",))]
            continue
        kept.append(token)
    return kept


def covering(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two books cover the desk" as "two books are on the desk"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        follower = tokens[min(at + 1, len(tokens) - 1)].text
        behind = at and (nouns.match([tokens[at - 1].text]) or is_marked(tokens[at - 1].text))
        behind = behind or token.text.endswith(("ed", "aces", "orns", "pies", "ing"))
        leads = follower in ("the", "a", "an", "its", "this") or follower in lexicon.NUMBERS
        if at and token.text in _COVERING | _OVER and behind and leads:
            upon = replace(token, text="over" if token.text in _OVER else "on")
            made += [replace(token, text="is" if token.text.endswith("s") else "are"), upon]
        else:
            made.append(token)
    return made


def upon_it(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "one with a ball inside" as "... in it", "a tray with a cup and a bun on top" as "... on it".

    So what is listed is all of it there, and in or on the one thing that has it.
    """
    words = [token.text for token in tokens]
    for at in range(len(words) - 2, 2, -1):
        size = 1 if words[at] == "inside" else 2 if words[at : at + 2] == ["on", "top"] else 0
        ends = size and (tokens[at + size].mark or words[at + size] in ("and", "while"))
        had = max((n for n in range(1, at) if words[n] == "with"), default=0)
        between = words[had + 1 : at]
        clause = {"is", "are", "has", "holds", "in", "on", "of", "each", ".", ";", ":"} & {*between}
        if not (ends and had and between) or clause:
            continue
        one = words[had - 1] in _ONE_OF or (words[had - 2] in _ONE_OF and words[had - 1] == "one")
        listed = {"and", ","} & {*between} and not singulars(words[had - 1]) and words[had - 1] not in ("each", "them")
        if one or listed:
            said = [replace(tokens[at], text="in" if size == 1 else "on"), replace(tokens[at], text="it")]
            tokens = [*tokens[:at], *said, *tokens[at + size :]]
    return list(tokens)


def on_top(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a crate, on top a lamp" as "... on top of it a lamp".

    Of "a crate under the table and a lamp on top" the lamp is on top of the table.
    """
    words = [token.text for token in tokens]
    new = {"a", "an", *lexicon.NUMBERS}
    under = next((n for n in range(len(words) - 3) if words[n] in _BELOW and words[n + 1] in lexicon.DETERMINERS), -1)
    joints = [n for n in range(under + 2, len(words)) if tokens[n].mark or words[n] in FINITE | _JOINING]
    for at in range(max(under, 2) + 1, len(words) - 2):
        after = at + 2 + (words[at + 2] in lexicon.STANDING)
        joint = max((n for n in range(at) if words[n] in _JOINING), default=-1)
        fronts = joint == at - 1 and words[after] in new
        listed = under >= 0 and words[joint] != "with" and words[joint + 1] in new and tokens[at + 2].mark
        last = joint > under and not any(link_at(tokens, n) for n in range(joint + 1, at))
        if words[at : at + 2] == ["on", "top"] and (fronts or (listed and last)):
            the, *name = tokens[under + 1 : joints[0]] if under >= 0 else tokens[at : at + 1]
            found = nouns.match([name[-1].text]) if name else None
            level = found is not None and nouns.of_class(found.noun, lexicon.LEVEL)
            if not (fronts or level):
                continue
            owner = [replace(the, text="the"), *name] if level else [replace(the, text="it")]
            return [*tokens[: at + 2], replace(tokens[at + 1], text="of"), *owner, *tokens[at + 2 :]]
    return list(tokens)


def become(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "has rolled off the plate and lies beside it" as "lies beside the plate"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 6):
        moved = words[at] in ("has", "have") and words[at + 1].endswith(("ed", "en"))
        size = link_at(tokens, at + 2) if moved else 0
        joint = next((n for n in range(at + 4, len(words)) if words[n] == "and" or tokens[n].mark), at)
        verb = joint + 1 + (words[min(joint + 1, len(words) - 1)] in ("now", "is", "are"))
        if not size or words[joint] != "and" or verb >= len(words) - 2:
            continue
        link = verb + (words[verb] in lexicon.VERBS | lexicon.PARTICIPLES)
        end = link + link_at(tokens, link)
        if end > link and words[end] in ("it", "them"):
            told = tokens[joint + 1 + (words[joint + 1] == "now") : end]
            return [*tokens[:at], *told, *tokens[at + 2 + size : joint], *tokens[end + 1 :]]
    return list(tokens)


def one_of_two(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "nuts into one box and bolts into the other" as "... one of the two boxes ... the other box"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 4):
        if words[at] != "one" or words[at - 1] not in _INTO | {"from"}:
            continue
        end = at + 1
        while is_modifier(words[end]):
            end += 1
        name, off = nouns.match([words[end]]), words[at - 1] == "from"
        other = next((n for n in range(end + 1 + (not off), len(words) - 1) if words[n : n + 2] == ["the", "other"]
                      and (words[n - 1] in _INTO or (off and words[n - 1] == "from"))), 0)  # fmt: skip
        known = (name is not None and not name.plural and words[end] != "side") or (off and other == end + 2)
        if not known or not other or "." in words[at:other]:
            continue
        behind = other + 2 + (words[other + 2] in ("one", words[end]))
        if not (tokens[behind].mark or words[behind] in ("and", "while")):
            continue
        if off:
            # "From one bowl to the other"
            named = [replace(tokens[other + 1], text=each.text) for each in tokens[at + 1 : end + 1]]
            return [*tokens[: other + 2], *named, *tokens[behind:]]
        some = [replace(tokens[at], text=word) for word in ("one", "of", "the", "two")]
        many = replace(tokens[end], text=plural(words[end]))
        return [*tokens[:at], *some, *tokens[at + 1 : end], many, *tokens[end + 1 : other + 2],
                replace(tokens[other + 1], text=words[end]), *tokens[behind:]]  # fmt: skip
    return list(tokens)


def chessmen(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a king" as "a chess king", "the board" as a chessboard, where the prompt is of chess."""
    if not {"chess", "chessboard", "pawn", "pawns"} & {token.text for token in tokens}:
        return list(tokens)
    made: list[Token] = []
    for token in tokens:
        named = {token.text, *singulars(token.text)} & {"king", "queen", "rook", "knight", "bishop"}
        if named and not (made and made[-1].text == "chess"):
            made.append(replace(token, text="chess"))
        board = token.text == "board" and made and made[-1].text in lexicon.DETERMINERS
        made.append(replace(token, text="chessboard") if board else token)
    return made
