"""What opens a sentence before its scene does: who tells it, who put it there, "if you look closely"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.frames import begun, owned, without_duties
from pat3d.plan.grammar.rewriting.lids import on_its_lid
from pat3d.plan.grammar.rewriting.rooms import in_rooms, where_it_is
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_PERSONS = frozenset({"she", "he", "we", "i", "they", "somebody", "someone", "you", "people"})
_PUT = frozenset({"left", "put", "placed", "set", "laid", "arranged", "kept", "stored", "hung", "stacked", "piled",
    "scattered", "lined"})  # fmt: skip
_CHILDREN = frozenset(
    {"children", "child", "kids", "kid", "boy", "girl", "student", "students", "man", "woman", "cook"}
)
_BUILT = frozenset({"built", "made", "formed", "erected"})
_CONNECTING = tuple(tuple(said.split()) for said in (
    "however", "moreover", "furthermore", "additionally", "in addition", "besides", "therefore", "thus", "hence",
    "consequently", "for example", "for instance", "in particular", "in general", "in fact", "specifically", "notably",
    "as a result", "naturally", "obviously", "overall", "initially", "meanwhile", "as usual", "as always",
    "note that", "notice that", "luckily", "unfortunately", "fortunately", "sadly", "usually",
))  # fmt: skip
"""What joins a sentence to those before it, or tells how it is meant, and changes nothing in it."""
_FORMING = frozenset({"form", "forms", "forming", "makes", "make"})
_FORMED = frozenset({"row", "line", "stack", "pile", "tower", "column", "circle", "ring", "pyramid"})


def opened(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` from where the scene begins: "she left her keys on the shelf" as "her keys on the shelf"."""
    tokens = where_it_is(owned(without_duties(_connected(tokens))))
    tokens = in_rooms(on_its_lid(tokens), nouns)
    for at in (0, _after_purpose(tokens, nouns)):
        if (start := begun(tokens, at, nouns)) > at:
            return list(tokens[start:])
        start = _put_there(tokens, at)
        if start and _begins(tokens, start):
            return list(tokens[start:])
    return list(tokens)


def _put_there(tokens: Sequence[Token], at: int) -> int:
    """The token behind "somebody has built" at `at`; 0 where nobody has put anything there."""
    words = [token.text for token in tokens[at : at + 5]]
    who = 1 if words[0] in _PERSONS else 2 if words[0] in ("the", "a", "my") and words[1] in _CHILDREN else 0
    verb = who + (bool(who) and words[who] in ("has", "have", "had", "just"))
    built = bool(who) and verb < len(words) and words[verb] in _PUT | _BUILT
    return at + verb + 1 if built and at + verb + 1 < len(tokens) - 1 else 0


def _connected(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` without "however," and "note that" in front."""
    words = [token.text for token in tokens[:5]]
    size = next((len(said) for said in _CONNECTING if tuple(words[: len(said)]) == said), 0)
    comma = bool(size) and size < len(words) and words[size] == ","
    told = comma or (size > 1 and words[1] == "that")
    return tokens[size + comma :] if told and size + comma < len(tokens) - 1 else tokens


def formed(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "five cans form a row" as "five cans are in a row", "two chairs face a bed" with that verb."""
    made: list[Token] = []
    tokens = _formed_with(tokens)
    for at, token in enumerate(tokens):
        follows = [each.text for each in tokens[at + 1 : at + 4]]
        shape = follows[:1] == ["a"] and bool(set(follows[1:]) & _FORMED) and at > 0
        if token.text in _FORMING and shape and not (tokens[at - 1].mark or tokens[at - 1].text in ("you", "please")):
            made += [replace(token, text="are")] if token.text != "forming" else []
            made.append(replace(token, text="in"))
        elif (
            token.text == "face"
            and at > 1
            and _begins(tokens, at + 1)
            and (singulars(tokens[at - 1].text) or base_verb(tokens[0].text) is None)
        ):
            made.append(replace(token, text="faces"))
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


def _after_purpose(tokens: Sequence[Token], nouns: Nouns) -> int:
    """The token after "for the experiment", which names nothing that could be made; 0 where nothing like it opens."""
    if tokens[0].text not in ("for", "in", "during", "after", "before"):
        return 0
    end = next((at for at, token in enumerate(tokens) if token.text in _PERSONS or token.mark), 0)
    end += tokens[end].text == ","
    if end > 7 or any(nouns.match([token.text]) for token in tokens[:end]):
        return 0
    return end if tokens[end].text in _PERSONS else 0
