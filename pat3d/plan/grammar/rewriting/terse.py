"""Notes and lists as people jot them down: "table round, 4 chairs", "soda can x3", "5 mugs in row, fork on left"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS, LONGEST_LINK
from pat3d.plan.grammar.words.modifiers import TOLD_BY_PLACE, is_colour_word, is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_GRID = re.compile(r"[2-9]x[2-9]")
_FORMS = frozenset({"row", "line", "circle", "ring", "stack", "pile"})
_TELLING = frozenset({"biggest", "smallest", "tallest", "shortest", "largest", "longest"}) | {
    word for word in lexicon.POSITIONS if word not in ("left", "right", "front", "back")
}
_COUNTED = lexicon.NUMBERS.keys() - {"one", "set", "single", "couple", "pair", "dozen", "trio"}
_SAYING = lexicon.STANDING | FINITE | {"of", "than", "as", "there", "to", "that", "which", ":"}
_LOOKS = lexicon.SIZES.keys() | {"round", "square", "open", "empty", "tall", "short"}


def in_full(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with the small words that a jotted note leaves out."""
    tokens = _fruits(_times(_sized_grids(_set_off(tokens, nouns)), nouns), nouns)
    told = _the_counted(_the(_articles(tokens, nouns)), nouns)
    return _are(_listed(_before(told, nouns), nouns), nouns)


def _set_off(tokens: Sequence[Token], nouns: Nouns) -> Sequence[Token]:
    """`tokens` with "a cup, red; a jug, white" as "a red cup; a white jug", so of "another, small, is"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 2):
        if words[at] != "," or not tokens[at + 2].mark:
            continue
        if words[at - 1] == "another" and is_modifier(words[at + 1]) and words[at + 3] in FINITE:
            one = replace(tokens[at + 1], text="one")
            return _set_off([*tokens[:at], tokens[at + 1], one, *tokens[at + 3 :]], nouns)
        size = _noun_before(tokens, at, nouns) if is_colour_word(words[at + 1]) else 0
        if size and words[at - size - 1] in ("a", "an", "one") and words[at + 2] in (";", "."):
            name = [*tokens[at - size : at - 1], replace(tokens[at - 1], end=tokens[at + 1].end)]
            return _set_off([*tokens[: at - size], tokens[at + 1], *name, *tokens[at + 2 :]], nouns)
    return tokens


def _fruits(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "3 forks, lime, purple cup" as "3 forks, a lime, a purple cup": no cup in two colours."""
    made: list[Token] = []
    fruit = False
    for at, token in enumerate(tokens):
        if fruit and made[-1].text == ",":
            made.append(replace(token, text="a", end=token.start))
            fruit = False
        behind = [each.text for each in tokens[at + 1 : at + 6]]
        alone = at > 1 and tokens[at - 1].mark and behind[:1] == [","] and is_colour_word(token.text)
        alone = alone and nouns.match([token.text]) is not None and not is_colour_word(tokens[at - 2].text)
        name = next((n for n in range(1, len(behind)) if not (is_modifier(behind[n]) or is_colour_word(behind[n]))), 0)
        if alone and name > 1 and not singulars(behind[name]) and nouns.match(behind[name : name + 1]):
            made.append(replace(token, text="a", end=token.start))
            fruit = True
        made.append(token)
    return made


def _times(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "x3 soda cans" and "soda can x3" as "3 soda cans"."""
    made: list[Token] = []
    for token in tokens:
        number = token.text.removeprefix("x")
        if not (token.text.startswith("x") and number.isdecimal() and len(number) < 3):
            made.append(token)
            continue
        counted = replace(token, text=number)
        size = _noun_before(made, len(made), nouns)
        start = len(made) - size
        while size and start and (is_modifier(made[start - 1].text) or is_colour_word(made[start - 1].text)):
            start -= 1
        made.insert(start if size else len(made), counted)
    return made


def _noun_before(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """Words of the name that ends right before `at`; 0 where none does."""
    words = [token.text for token in tokens[max(0, at - 3) : at]]
    return next((n for n in range(len(words), 0, -1) if nouns.match(words[-n:])), 0)


def _articles(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "in row" as "in a row", "on left" as "on the left"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        before = tokens[at - 1].text if at else "."
        told = [each.text for each in tokens[:at]]
        joined = before == "between" or (before == "and" and "between" in told[-4:])
        if joined and token.text in told[:-2] and nouns.match([token.text]) is not None:
            # "A sofa, a TV and a rug between sofa and TV": between those two.
            made.append(replace(token, text="the", end=token.start))
        if _GRID.fullmatch(token.text) and _noun_before(tokens, at, nouns):
            # "4 cans 2x2 on a tray"
            made += [replace(token, text=word) for word in ("in", "a", token.text, "grid")]
            continue
        after = tokens[min(at + 1, len(tokens) - 1)]
        if token.text in _FORMS and before == "in":
            made.append(replace(token, text="a", end=token.start))
        side = token.text in ("left", "right") and before in ("on", "from")
        if side and (after.mark or after.text in ("side", "of") or is_colour_word(after.text)):
            made.append(replace(token, text="the", end=token.start))
        made.append(token)
    return made


def _sized_grids(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a 3 by 3 grid" as "a 3x3 grid"."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        said = [each.text for each in tokens[at : at + 4]]
        sized = said[1:2] == ["by"] and said[3:] == ["grid"] and numeral(said[0]) and numeral(said[2])
        size = f"{numeral(said[0])}x{numeral(said[2])}" if sized else said[0]
        made.append(replace(tokens[at], text=size, end=tokens[at + 2 * bool(sized)].end))
        at += 3 if sized else 1
    return made


def _the(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "four mugs, third one upside down" as "four mugs, the third one upside down"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        told = token.text in TOLD_BY_PLACE | lexicon.POSITIONS.keys() | lexicon.LEVELS.keys()
        one = at + 2 < len(tokens) and tokens[at + 1].text == "one" and not tokens[at + 2].mark
        if told and one and at and (tokens[at - 1].mark or tokens[at - 1].text == "and"):
            made.append(replace(token, text="the"))
        made.append(token)
    return made


def _the_counted(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "3 flasks, 2 beakers, flasks behind beakers" as "..., the flasks behind the beakers"."""
    made: list[Token] = []
    free: dict[tuple[str, bool], bool] = {}
    words = [token.text for token in tokens]
    for at, token in enumerate(tokens):
        name = nouns.match([token.text])
        if name is None:
            made.append(token)
            continue
        kind = name.noun, name.plural
        size = next((n for n in range(min(LONGEST_LINK, at), 0, -1) if link_at(tokens, at - n) == n), 0)
        placed = size > 0 and words[at - size : at] not in (["with"], ["of"])
        link = LINKS.get(tuple(words[at + 1 : at + 1 + link_at(tokens, at + 1)]))
        opens = words[at - 1] in (",", ";") and link is not None and not link.inverse
        # "Five books on the shelf, books on the floor": others.
        stays = link is not None and (link.kind in LATERAL_KINDS or free.get(kind, False))
        if kind in free and at and (placed or (opens and stays)):
            made.append(replace(token, text="the", end=token.start))
        first = at
        while first and is_modifier(words[first - 1]):
            first -= 1
        if first and words[first - 1] not in ("a", "an") and numeral(words[first - 1]):
            # "Beaker x3"
            kind = name.noun, name.plural or numeral(words[first - 1]) > 1
            free[kind] = tokens[at + 1].mark and kind not in free
        made.append(token)
    return made


def _before(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "table round, cup white on a tray" as "round table, white cup on a tray"."""
    made = list(tokens)
    for at in range(1, len(tokens) - 1):
        size = _noun_before(tokens, at, nouns)
        start = at - size
        opens = size and (not start or tokens[start - 1].mark)
        ends = tokens[at + 1].mark or tokens[at + 1].text.isdecimal() or link_at(tokens, at + 1) > 0
        looks = tokens[at].text in _LOOKS or is_colour_word(tokens[at].text)
        whole = nouns.match([token.text for token in tokens[start : at + 1]]) is not None
        looks = looks and nouns.match([tokens[at].text]) is None
        if opens and ends and looks and not whole and not singulars(tokens[at - 1].text):
            made[start : at + 1] = [tokens[at], *tokens[start:at]]
    return made


def _listed(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a bed a lamp and two books" as "a bed, a lamp and two books", where a sentence is such a list."""
    made: list[Token] = []
    start = 0
    for end in [at + 1 for at, token in enumerate(tokens) if token.text in (".", ";") and token.mark] or [len(tokens)]:
        part = tokens[start:end]
        leads = [at for at, token in enumerate(part) if token.text in ("a", "an") or token.text in _COUNTED]
        bare = all(not link_at(part, at) and token.text not in _SAYING for at, token in enumerate(part))
        bare = bare and leads[:1] == [0]
        for at, token in enumerate(part):
            if bare and at in leads[1:] and _noun_before(part, at, nouns):
                made.append(replace(token, text=",", end=token.start, mark=True))
            made.append(token)
        start = end
    return [*made, *tokens[start:]]


def _are(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "five balls, the biggest blue" as "five balls, the biggest is blue"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        words = [each.text for each in tokens[max(0, at - 6) : at]]
        marked = next((n for n in range(len(words) - 1, -1, -1) if words[n] in (",", ":", ".", ";")), -1)
        head = words[marked + 1 :] if marked >= 0 else []
        alone = (
            is_colour_word(token.text)
            and nouns.match([token.text]) is None
            and tokens[at + 1].mark
            and "and" not in head
        )
        ordinal = [word for word in head if word not in ("the", "from", "left", "right")]
        if alone and len(ordinal) == 1 and ordinal[0] in _TELLING and head[-1] not in ("the", "from"):
            if head[0] in _TELLING:
                made.insert(len(made) - len(head), replace(made[-len(head)], text="the", end=made[-len(head)].start))
            made.append(replace(token, text="is", end=token.start))
        made.append(token)
    return made
