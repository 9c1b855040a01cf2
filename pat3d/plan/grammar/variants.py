"""Other ways to write what is read: "lap top", "all of the cups", "near by", "a cut in half orange", "you can see"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token
from pat3d.plan.grammar.modifiers import is_modifier
from pat3d.plan.grammar.unmade import base_verb, is_no_noun
from pat3d.plan.grammar.vocabulary import Nouns

_PLAINER: dict[tuple[str, ...], tuple[str, ...]] = {
    **{("all", "of", the): ("all", the) for the in ("the", "these", "those", "my", "your", "our", "his", "her")},
    ("near", "by"): ("nearby",),
    ("atleast",): ("at", "least"),
    ("atmost",): ("at", "most"),
    ("with", "no"): ("without",),
    ("over", "there"): (),
    ("over", "here"): (),
    ("bridges", "the", "gap", "between"): ("bridges",),
    ("bridge", "the", "gap", "between"): ("bridges",),
    ("bridging", "the", "gap", "between"): ("bridging",),
    **{(*seen, "see"): ("there", "are") for seen in (("you", "can"), ("one", "can"), ("we", "can"), ("you",), ("we",))},
    **{(*seen, "find"): ("there", "are") for seen in (("you", "can"), ("one", "can"), ("you", "will"), ("you",))},
}
"""What is said, and the words instead."""
_INNER = frozenset({"there", "are"})
_PARTICLES = frozenset({"on", "off", "up", "down", "out", "open", "over", "in", "away"})
_HALVES = frozenset({"half", "two", "three", "four", "pieces", "slices", "wedges", "quarters", "halves"})
_CUT = frozenset({"cut", "split", "torn", "broken", "blown", "worn", "shut", "spread", "swept"})
_SIDES = frozenset({"on", "at", "to", "by", "from"})


def varied(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence in the usual words."""
    return _one_adjective(_one_word(_plain(tokens), nouns), nouns)


def _plain(tokens: Sequence[Token]) -> list[Token]:
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = tuple(token.text for token in tokens[at : at + 4])
        size = next((n for n in (4, 3, 2, 1) if words[:n] in _PLAINER), 0)
        told = _PLAINER[words[:size]] if size else ()
        follower = tokens[min(at + size, len(tokens) - 1)].text
        leads = follower in lexicon.DETERMINERS | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
        if size and _INNER & set(told) and not (made and leads and made[-1].text not in ("that", "which", "as")):
            size = 0
        if size:
            made += [replace(tokens[at + min(n, size - 1)], text=word) for n, word in enumerate(told)]
            at += size
            continue
        before = made[-1].text if made else ""
        if words[:3] in (("either", "side", "of"), ("each", "side", "of")) and before not in _SIDES:
            # "A lamp stands either side of the bed."
            made.append(replace(tokens[at], text="on"))
        if words == ("left", "and", "right", "of") and before != "the":
            made += [replace(tokens[at], text="to"), replace(tokens[at], text="the")]
        made.append(tokens[at])
        if (
            words[0] == "next"
            and words[1] in ("the", "a", "an")
            and before
            and before not in lexicon.DETERMINERS | {","}
        ):
            # "next the lamp"
            made.append(replace(tokens[at], text="to"))
        at += 1
    return made


def _one_word(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "lap top" and "pan cakes" as one word, where that names a thing and the two words do not."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        one, two = tokens[at], tokens[min(at + 1, len(tokens) - 1)]
        long = min(len(one.text), len(two.text)) > 2 and one.text.isalpha() and two.text.isalpha()
        joined = long and not (is_modifier(one.text) or is_no_noun(one.text) or link_at(tokens, at + 1))
        if joined and nouns.match([one.text + two.text]) and not nouns.match([one.text, two.text]):
            made.append(replace(one, text=one.text + two.text, end=two.end))
            at += 1
        else:
            made.append(one)
        at += 1
    return made


def _one_adjective(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a cut in half orange" as "a cut-in-half orange", "a turned off lamp" as "a turned-off lamp"."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        word, end = tokens[at].text, at + 1
        led = at and tokens[at - 1].text in lexicon.DETERMINERS | lexicon.NUMBERS.keys()
        if led and (word in _CUT or (word.endswith("ed") and base_verb(word))) and not nouns.match([word]):
            words = [token.text for token in tokens[at + 1 : at + 3]]
            if words[:1] in (["in"], ["into"]) and words[1] in _HALVES:
                end = at + 3
            elif words[0] in _PARTICLES:
                end = at + 2
        told = tokens[end].text if end < len(tokens) else "."
        if end > at + 1 and (is_modifier(told) or nouns.match([told])):
            made.append(
                replace(tokens[at], text="-".join(token.text for token in tokens[at:end]), end=tokens[end - 1].end)
            )
            at = end
        else:
            made.append(tokens[at])
            at += 1
    return made
