"""Of what things are made: "a frog made out of chocolate", "the chairs are of oak", "two boxes, one of tin"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.assets.materials import find_material
from pat3d.plan.grammar.rewriting.denials import Told
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_MADE = frozenset({"made", "crafted", "built", "constructed", "carved", "formed", "fashioned"})
_TOLD = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.PRONOUNS | lexicon.NUMBERS.keys()


def made_of(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a frog made out of chocolate" as "a chocolate frog", where the catalogue has chocolate as well.

    So is "they are made of wood" "they are wood".
    """
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 2):
        predicate = words[at - 1] in lexicon.COPULAS and not {*words[max(at - 2, 0) : at - 1]} & lexicon.RELATIVES
        said = predicate and (words[at] in _MADE or words[at] == "of")
        # "A boat out of paper"
        out = words[at : at + 2] == ["out", "of"] and find_material(words[at + 2]) and base_verb(words[0]) != words[0]
        name = next((n for n in (3, 2, 1) if nouns.match(words[max(0, at - n) : at])), 0)
        if not said and not (name and (out or words[at] in _MADE)):
            continue
        of = at + (words[at] in _MADE)
        of += words[of] == "out"
        end = of + 2
        material = words[of + 1] if words[of] in ("of", "from") and end < len(words) else ""
        known = find_material(material) is not None
        alone = tokens[end].mark or link_at(tokens, end) or words[end] in FINITE | {"and"} if material else False
        if said and alone and known:
            return made_of([*tokens[:at], *tokens[of + 1 :]], nouns)
        if not said and alone and (nouns.match([material]) or known):
            made = [*tokens[: at - name], tokens[of + 1], *tokens[at - name : at], *tokens[end:]]
            return made_of(made, nouns)
    return list(tokens)


def one_of_stuff(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "two bowls, one of nuts" as "two bowls, one with nuts", and "two houses, one of straw" as "two houses"."""
    for at in range(3, len(words) - 2):
        if words[at : at + 2] != ["one", "of"] or words[at - 1] not in (",", "and", ":", ";"):
            continue
        end = next(n for n in range(at + 2, len(words)) if tokens[n].mark or words[n] == "and")
        told = _TOLD & {*words[at + 2 : end]} or any(link_at(tokens, n) for n in range(at + 2, end))
        counted = next((n for n in range(1, at) if numeral(words[n - 1]) > 1), 0)
        if told or not counted or words[end - 1] == "of":
            continue
        owner = next(filter(None, (nouns.match(words[n : n + 1]) for n in range(counted, min(counted + 3, at)))), None)
        vessel = owner is not None and nouns.of_class(owner.noun, (*vessels.HOLLOW, *lexicon.LEVEL))
        if vessel and find_material(words[end - 1]) is None:
            return [*tokens[: at + 1], replace(tokens[at + 1], text="with"), *tokens[at + 2 :]], []
        return [*tokens[: at - 1], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None
