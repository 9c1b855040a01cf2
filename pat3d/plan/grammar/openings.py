"""What opens a sentence before its scene does: who tells it, who put it there, "if you look closely"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token
from pat3d.plan.grammar.vocabulary import Nouns

_PERSONS = frozenset({"she", "he", "we", "i", "they", "somebody", "someone", "you", "people"})
_PUT = frozenset({"left", "put", "placed", "set", "laid", "arranged", "kept", "stored", "hung", "stacked", "piled",
    "scattered", "lined"})  # fmt: skip
_WISHES = (
    "is it possible to have", "would it be possible to have", "is it possible to see", "i count", "one can see",
    "you can see", "we can see", "i can see", "you see", "we see", "i need", "we need", "i see", "imagine", "picture",
    "i would like", "i'd like", "we would like", "we'd like", "i want", "we want", "show me", "give me", "can i have",
    "may i have", "could i have", "let us have", "let's have", "this is", "it is", "it's", "it shows",
    "make sure there are", "make sure there is", "make sure that there are", "make sure that there is",
    "ensure there are", "ensure there is", "ensure that there are", "ensure that there is",
    "the robot should find", "the robot finds", "the robot will find",
    "this shows", "the picture shows", "the image shows", "the photo shows", "the scene shows",
)  # fmt: skip
_TOLD = tuple(sorted((tuple(said.split()) for said in _WISHES), key=len, reverse=True))
_FORMING = frozenset({"form", "forms", "forming", "makes", "make"})
_FORMED = frozenset({"row", "line", "stack", "pile", "tower", "column", "circle", "ring", "pyramid"})


def opened(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` from where the scene begins: "she left her keys on the shelf" as "her keys on the shelf"."""
    tokens = _without_viewer(tokens)
    for at in (0, _after_purpose(tokens, nouns)):
        words = [token.text for token in tokens[at : at + 6]]
        size = next((len(told) for told in _TOLD if tuple(words[: len(told)]) == told), 0)
        if size and (at or len(words) > size) and _begins(tokens, at + size):
            return list(tokens[at + size :])
        if words[:1] and words[0] in _PERSONS and words[1] in _PUT and _begins(tokens, at + 2):
            return list(tokens[at + 2 :])
    return _fronted_participle(tokens, nouns)


def formed(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "five cans form a row" as "five cans are in a row"."""
    made: list[Token] = []
    tokens = _formed_with(tokens)
    for at, token in enumerate(tokens):
        follows = [each.text for each in tokens[at + 1 : at + 4]]
        shape = follows[:1] == ["a"] and bool(set(follows[1:]) & _FORMED) and at > 0
        if token.text in _FORMING and shape and not tokens[at - 1].mark:
            made += [replace(token, text="are")] if token.text != "forming" else []
            made.append(replace(token, text="in"))
        else:
            made.append(token)
    return made


def _formed_with(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "two cubes form a line with a ball" as "two cubes and a ball form a line"."""
    words = [token.text for token in tokens]
    for at in range(3, len(words) - 2):
        formed = words[at] == "with" and words[at - 1] in _FORMED and words[at - 2] in ("a", "one")
        formed = formed and words[at - 3] in (*_FORMING, "in", "into") and words[0] != "there"
        verb = next((n for n in range(1, at) if words[n] in _FORMING | lexicon.COPULAS | lexicon.VERBS), 0)
        end = next(n for n in range(at, len(words)) if tokens[n].mark)
        plain = not any(link_at(tokens, n) or tokens[n].mark for n in range(verb))
        if formed and verb and plain and words[verb] != "makes" and _begins(tokens, at + 1):
            joint = replace(tokens[at], text="and")
            return [*tokens[:verb], joint, *tokens[at + 1 : end], *tokens[verb:at], *tokens[end:]]
    return tokens


def _begins(tokens: Sequence[Token], at: int) -> bool:
    """Whether a phrase, or a list of some, begins at token `at`."""
    word = tokens[min(at, len(tokens) - 1)].text
    leads = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
    return word in leads or word.isdecimal()


def _without_viewer(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` without "if you look closely," and "when you enter,"."""
    if tokens[0].text not in ("if", "when", "as", "once") or tokens[1].text not in ("you", "one", "we"):
        return tokens
    comma = next((at for at, token in enumerate(tokens) if token.text == ","), 0)
    named = any(token.text in lexicon.DETERMINERS for token in tokens[:comma])
    return tokens[comma + 1 :] if comma and not named else tokens


def _after_purpose(tokens: Sequence[Token], nouns: Nouns) -> int:
    """The token after "for the experiment", which names nothing that could be made; 0 where nothing like it opens."""
    if tokens[0].text not in ("for", "in", "during", "after", "before"):
        return 0
    end = next((at for at, token in enumerate(tokens) if token.text in _PERSONS or token.mark), 0)
    end += tokens[end].text == ","
    if end > 7 or any(nouns.match([token.text]) for token in tokens[:end]):
        return 0
    return end if tokens[end].text in _PERSONS else 0


def _fronted_participle(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "swimming in the pool are four ducks" as "in the pool are four ducks"."""
    word = tokens[0].text
    opens = word.endswith(("ing", "ed")) and word not in lexicon.PARTICIPLES | lexicon.NOT_VERBS
    opens = opens and not word.endswith("thing") and not nouns.match([word])
    verb = any(token.text in lexicon.COPULAS for token in tokens)
    # "Hanging from" and "leaning against" are relations.
    plain = link_at(tokens, 1) and not link_at(tokens, 0)
    return list(tokens[1:]) if opens and verb and plain and _begins(tokens, 1 + link_at(tokens, 1)) else list(tokens)
