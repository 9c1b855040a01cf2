"""Things told apart by a number or a letter behind their name: "put the pear in bin 1 and the fig in bin 2"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.english import NUMBERED, NUMBERED_BARE
from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.number_words import ORDINALS, numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

LABELLED = frozenset({"labelled", "labeled", "marked", "lettered", "numbered", "named", "called"})
_MOVING = frozenset({"move", "slide", "push", "take", "place", "put", "stack", "lift", "grab", "pick", "up", "and"})
_FORMS = frozenset({"structure", "formation", "wall", "square", "space", "spaces", "high", "wide", "long", "tall"})


def steps(text: str, tokens: Sequence[Token], _: Nouns) -> list[Token]:
    """`tokens` of the prompt `text` with "1- take the pen 2- put it in the cup" as sentences without numbers."""
    made: list[Token] = []
    number = 0
    for at, token in enumerate(tokens):
        marked = token.mark and at > 0 and tokens[at - 1].text == str(number) and token.text == "."
        if marked and text[tokens[at - 1].end - 1 : token.end] == f"{number}.":
            continue
        behind = at + 1 + (tokens[min(at + 1, len(tokens) - 1)].text == ".")
        verb = tokens[min(behind, len(tokens) - 1)].text
        begins = token.text in (str(number + 1), "2"[number:]) and text[token.end : token.end + 1] in ("-", ".", ")")
        # "On block 2. Block 1 ..."
        begins = begins and tokens[at - 1].text != verb
        if begins and (known_verb(verb) or verb == "done"):
            number = int(token.text)
            made += [replace(token, text=".", mark=True)] if made and not made[-1].mark else []
        elif not (number and token.text == "done" and at + 1 < len(tokens) and tokens[at + 1].mark and made[-1].mark):
            made.append(token)
    return made


def ordinals(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of the prompt `text` with "bin 1 and bin 2", or "the 1 bin", as "the first bin and the second bin".

    A number before its name stays as "number-4" there, which nothing shows.
    """
    tokens = _called(text, tokens, nouns)
    labels: dict[str, dict[str, None]] = {}
    found: dict[int, tuple[Sequence[Token], Token, int]] = {}
    """Behind the first token of each: the name, its label, and where both end."""
    for at in range(1, len(tokens) - 1):
        begin = at - (tokens[at - 1].text == "number")
        words = [token.text for token in tokens[:begin]]
        size = next((n for n in (3, 2, 1) if n <= begin and (match := nouns.match(words[-n:])) and not match.plural), 0)
        if size and _label(text, tokens, at):
            found[begin - size] = tokens[begin - size : begin], tokens[at], at + 1
        elif size := _size_of_numbered(tokens, begin, at, nouns):
            found[begin] = tokens[at + 1 : at + 1 + size], tokens[at], at + 1 + size
    for named, label, _ in found.values():
        labels.setdefault(_name(named), {})[label.text] = None
    for at, token in enumerate(tokens):
        several = nouns.match([tokens[at - 1].text]) if at and token.text in LABELLED else None
        if several is not None and several.plural:
            listed = [each.text for each in tokens[at + 1 : labels_end(tokens, at)] if each.text not in (",", "and")]
            for name in singulars(tokens[at - 1].text) if listed == sorted(listed) else ():
                labels.setdefault(name, {}).update(dict.fromkeys(listed))
    told = {name: sorted(each, key=lambda label: (len(label), label)) for name, each in labels.items()}
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        named, label, end = found.get(at, ((), tokens[at], at + 1))
        ranks = told.get(_name(named), []) if named else []
        several, leads = 2 <= len(ranks) <= len(ORDINALS), bool(named) and label.start < named[0].start
        if not (several or leads):
            made.append(tokens[at])
            at += 1
            continue
        named = [replace(each, end=max(each.end, label.end)) for each in named]
        first = replace(label if leads else named[0], number=named[0].number)
        number = [replace(first, text=f"number-{label.text}")] if leads else []
        which = [replace(first, text=ORDINALS[ranks.index(label.text)])] if several else []
        if made and made[-1].text in ("a", "an"):
            made.pop()
        article = [] if made and made[-1].text in lexicon.DETERMINERS else [replace(first, text="the")]
        made += [*article, *which, *number, *named]
        at = end
    return made


def _called(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "4 blocks. b3 is on b2", "4 blocks. C is on B", as "4 blocks. block 3 is on block 2"."""
    words, named = [token.text for token in tokens], dict[int, tuple[Token, ...]]()
    count = next((n for n in range(len(words) - 2) if numeral(words[n]) > 1 and singulars(words[n + 1])), len(words))
    name = next((one for one in singulars(words[count + 1]) if nouns.match([one])), "") if count < len(words) else ""
    for at in range(count + 2, len(words) - 1 if name and not LABELLED & {*words} else 0):
        before, short = nouns.match(words[at - 1 : at]), re.fullmatch(r"[a-z](\d)", words[at])
        label = short[1] if short else _label(text, tokens, at) if words[at].isalpha() else ""
        if label and not nouns.match(words[at : at + 1]) and (before is None or before.plural):
            named[at] = replace(tokens[at], text=name), replace(tokens[at], text=label)
    several = len({label.text for _, label in named.values()}) > 1
    return [one for at, token in enumerate(tokens) for one in (several and named.get(at)) or (token,)]


def _name(named: Sequence[Token]) -> str:
    return " ".join(token.text for token in named)


def _size_of_numbered(tokens: Sequence[Token], begin: int, at: int, nouns: Nouns) -> int:
    """The words of the name behind the number at token `at` of "the 4 block", from `begin` on; 0 where it counts."""
    words = [token.text for token in tokens]
    before = words[begin - 1] if begin else "."
    size = next((n for n in (2, 1) if (match := nouns.match(words[at + 1 : at + 1 + n])) and not match.plural), 0)
    after = words[at + 1 + size : at + 2 + size]
    more = {*after} & (lexicon.STACK_NOUNS | lexicon.ROWS | lexicon.COLLECTIVES | _FORMS) or nouns.match(after)
    if not size or more or words[at + size] not in NUMBERED or not (words[at].isdecimal() and len(words[at]) < 3):
        return 0
    bare = begin > 0 and words[at] != "1" and (link_at(tokens, begin - 1) > 0 or before in _MOVING)
    return size if before in lexicon.DEFINITE or begin < at or (bare and words[at + size] in NUMBERED_BARE) else 0


def labels_end(tokens: Sequence[Token], at: int) -> int:
    """The token behind the letters or numbers of "labelled A, B and C", which begins at token `at`; 0 without two."""
    end, found, last = at + 1, 0, 0
    while end < len(tokens) - 1:
        word = tokens[end].text
        apart = end > at + 1 and tokens[end - 1].text not in (",", "and")
        if word.isalnum() and len(word) == 1 and not apart and (word != "a" or not found):
            found, last = found + 1, end + 1
        elif word not in (",", "and"):
            break
        end += 1
    return last if found > 1 else 0


def _label(text: str, tokens: Sequence[Token], at: int) -> str:
    """The number or letter at token `at` that ends a phrase; empty where it counts or begins something."""
    token, after = tokens[at], tokens[at + 1]
    number = token.text.isdecimal() and len(token.text) < 3
    letter = len(token.text) == 1 and text[token.start : token.end].isupper() and token.text != "i"
    ends = after.mark or after.text in FINITE | {"and", "or", "to", "then"} or link_at(tokens, at + 1) > 0
    return token.text if (number or letter) and ends else ""
