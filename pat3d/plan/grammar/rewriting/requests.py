"""Requests for a thing: "give me the spoon", "I need the saw from the shelf" and "bring the cup here" are to fetch it.

"Give me a red mug on a wooden table" tells of a scene, and "I'd like the lamp on the desk" of a wanted state.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.wanted_states import SWITCHED
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Nouns

_GIVE = (("give", "me"), ("give", "us"))
_WISHES = (*_GIVE, *(tuple(said.split()) for said in (
    "i need", "we need", "i want", "we want", "i'd like", "i would like", "we'd like", "could i have", "may i have",
    "could i get", "i'll take",
)))  # fmt: skip
_BRINGING = frozenset({"bring", "carry", "get", "fetch", "take"})
_HERE = (("over", "here"), ("here",), ("over", "to", "me"), ("to", "me"), ("to", "us"))
_IN_HAND = frozenset({"shake", "hold", "wave", "tilt", "tip", "squeeze", "pour", "sprinkle", "crack", "grate",
                      "rinse", "wash", "dip", "soak"})  # fmt: skip
"""Deeds over something, by which nothing comes to stand on it."""
_POURED = frozenset({"pour", "sprinkle", "crack", "grate"})
"""Those by which something comes into what is named, and is not in it before."""
_LEADS = lexicon.DEFINITE | lexicon.POSSESSIVES
_OPENING = frozenset({"and", "then", ",", "please", "."})
_WITHIN = frozenset({"of", "with", "from", "off", "out"})
"""Words that tell which thing is meant, or where it is taken from."""


def requested(sentence: list[Token], alone: bool, nouns: Nouns) -> list[Token]:
    """`sentence`, which is the whole prompt where `alone`, with what is asked for as what is to be fetched."""
    words = [token.text for token in sentence]
    opening = int(words[0] == "please")
    end = len(words) - 1 - (words[-2] == "please")
    end -= words[end - 1] == ","
    # "I want the red one, not the blue one."
    end = next((n for n in range(opening, end - 1) if words[n : n + 2] == [",", "not"]), end)
    here = next((said for said in _HERE if tuple(words[end - len(said) : end]) == said), ())
    plain = not {"and", "then", ","} & {*words[opening:end]}
    if words[opening] in _BRINGING and here and plain and end > opening + len(here) + 1:
        return _fetch(sentence, sentence[opening + 1 : end - len(here)])
    wish = next((said for said in _WISHES if tuple(words[opening : opening + len(said)]) == said), ())
    start = opening + len(wish)
    named = sentence[start:end]
    state = named[-1].text if wish and len(named) > 2 and words[start] in _LEADS else ""
    if state in SWITCHED or state in ("on", "off"):
        # "I want the microwave open", "I'd like the lamp to be off"
        named = named[:-3] if words[end - 3 : end - 1] == ["to", "be"] else named[:-1]
        last = replace(named[-1], end=sentence[end - 1].end) if state in SWITCHED else named[-1]
        rest = sentence[end - 1 + (state in SWITCHED) :]
        return [replace(sentence[0], text=SWITCHED.get(state, "turn")), *named[:-1], last, *rest]
    linked = {n + k for n in range(len(named)) for k in range(link_at(named, n) if named[n].text != "to" else 0)}
    other = (token.mark or token.text in ("to", "and", "or") for n, token in enumerate(named) if n not in linked)
    if not wish or len(named) < 2 or any(other):
        return sentence
    links = {named[n].text for n in linked if n < len(named)}
    definite = words[start] in _LEADS and words[end - 1] not in SWITCHED
    if definite and (wish in _GIVE or links <= _WITHIN or lexicon.RELATIVES & {*words[start + 1 : end]}):
        return _fetch(sentence, sentence[start:-1] if words[end : end + 2] == [",", "not"] else named)
    # "Give me a spoon"; a table is a scene.
    thing = next((found for n in (3, 2, 1) if (found := nouns.match(words[max(end - n, start) : end]))), None)
    plain = thing is not None and not thing.plural and not nouns.of_class(thing.noun, lexicon.FLOOR)
    single = words[start] in ("a", "an", "another") and not links - {"of"}
    return _fetch(sentence, named) if alone and plain and single else sentence


def _fetch(sentence: Sequence[Token], named: Sequence[Token]) -> list[Token]:
    return [replace(sentence[0], text="fetch"), *named, sentence[-1]]


def held_over(sentence: list[Token]) -> list[list[Token]]:
    """Tell "shake the salt over the pan" as "there is the pan", "shake the salt": it does not stand on the pan."""
    words = [token.text for token in sentence]
    for at in (n for n, word in enumerate(words) if word in _IN_HAND and (not n or words[n - 1] in _OPENING)):
        end = next(n for n in range(at, len(words)) if sentence[n].mark or words[n] in ("and", "then"))
        into = words[at] in _POURED or (words[at] in ("rinse", "wash", "dip", "soak") and at > 0)
        places = ("over", "above", "in", "on", "onto") if into else ("over", "above")
        goal = next((n for n in range(at + 1, end) if words[n] in ("into", *places)), end)
        source = next((n for n in range(goal, end) if words[n] == "from"), 0)
        if words[at] in _POURED and source:
            # "Pour milk into the cup from the jug": the cup is not from there.
            kept = [*sentence[:goal], *sentence[source:end], *sentence[goal:source]]
            return held_over([*kept, *sentence[end:]])
        over = next((n for n in range(end - 2, at + 1, -1) if words[n] in places and link_at(sentence, n) == 1), 0)
        over = 0 if any(link_at(sentence, n) for n in range(over + 1, end)) else over
        if not over or (words[over + 1] not in lexicon.DETERMINERS | lexicon.POSSESSIVES and end - over > 2):
            continue
        there = [replace(sentence[over], text=word) for word in ("there", "is")]
        rest = sentence[end:]
        then = next((n for n, token in enumerate(rest[:2]) if token.text in ("and", "then")), 0)
        if words[at] in _POURED and rest[min(then + 1, len(rest) - 1)].text in lexicon.DEFINITE:
            # "Pour the nuts in the bowl, then the figs over them"
            rest = [*rest[: then + 1], replace(sentence[at], number=rest[then].number), *rest[then + 1 :]]
        held = [*sentence[:at], replace(sentence[at], end=sentence[end - 1].end), *sentence[at + 1 : over], *rest]
        known = words[over + 1] in lexicon.PRONOUNS
        there = [] if known else [[*there, *sentence[over + 1 : end], sentence[-1]]]
        return [*there, *(held_over(held) if len(rest) > len(sentence[end:]) else [held])]
    return [sentence]
