"""The things that a sentence names, where nothing else of it can be read: "the globe is as far off as the desk allows".

They are placed, and a note has the whole sentence. A sentence that counts, denies or leaves a choice is none of these:
of what it names there might be more, or less.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.chunking.phrases import Phrase, PhraseReader
from pat3d.plan.grammar.rewriting.tails import Tails
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import JOINERS, link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LONGEST_LINK
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS, Modifiers, is_modifier
from pat3d.plan.grammar.words.unmade import base_verb, is_quality, makes_nothing
from pat3d.plan.grammar.words.vocabulary import Nouns

_COUNTING = frozenset({
    "each", "every", "either", "neither", "both", "half", "twice", "double", "triple", "other", "others", "another",
    "one", "ones", "rest", "none", "more", "fewer", "less", "without", "instead", "or", "no", "not", "nothing",
    "nobody", "never", "if", "unless", "whether", "whichever", "whatever", "except", "apart", "minus", "all",
    "respectively", "same", "order", "remaining", "replaced", "missing", "gone", "removed", "lacks", "absent",
    "partner", "mate", "labelled", "labeled", "marked", "until",
})  # fmt: skip
"""Words by which there are more or fewer things than the phrases of a sentence say."""

_DENYING = frozenset({"without", "no", "any", "instead", "omit", "skip", "exclude", "rather", "nobody", "nothing"})
"""Words behind which something is not there."""


def named_only(
    text: str, tokens: Sequence[Token], nouns: Nouns, number: int, *, asked: bool = False
) -> list[Token] | None:
    """The things that `tokens` of one sentence name as "there is a cup and a plate"; None where that is not all.

    Word `number` of the prompt is where its reading fails. What is `asked` for has lost its verb.
    """
    at_fault = next((at for at, token in enumerate(tokens) if token.number == number and not token.mark), -1)
    inserted = any(one.text == "and" and two.mark for one, two in pairwise(tokens))
    if (
        inserted
        or at_fault < 0
        or tokens[at_fault].text in lexicon.PRONOUNS
        or is_thing(tokens, number)
        or Tails(tokens, nouns, {}).unknown()
    ):
        return None
    reader = PhraseReader(text, [*tokens, *[tokens[-1]] * (LONGEST_LINK + 4)], nouns)
    told: list[Token] = []
    known: set[tuple[str, Modifiers]] = set()
    at = 0
    while at < len(tokens) - 1:
        size = link_at(tokens, at)
        read = None if size or tokens[at].mark else reader.read(at)
        words = [token.text for token in tokens[at : read[1] if read else at + max(size, 1)]]
        if {*words} & (_COUNTING - ({"one"} if read else set())) or (not size and not _heard(words, read, nouns)):
            return None
        if read is not None and read[0].kind == "object":
            thing = read[0].noun, read[0].modifiers
            if not (read[0].definite and known & {thing, (thing[0], NO_MODIFIERS)}):
                told += [replace(tokens[at], text="and"), *tokens[at : read[1]]]
            known |= {thing, (thing[0], NO_MODIFIERS)} if thing[1] == NO_MODIFIERS else {thing}
        at += len(words)
    if not told or not (asked or has_verb(tokens, nouns)):
        return None
    there = [replace(tokens[0], text="there"), replace(tokens[0], text="is")]
    return [*there, *told[1:], tokens[-1]]


def things_named(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """The things that `tokens` of one sentence name as "there is a cup and a plate"; empty without any.

    "Without a lid", "leave out the knives" name what is not there.
    """
    reader = PhraseReader(text, [*tokens, *[tokens[-1]] * (LONGEST_LINK + 4)], nouns)
    told: list[Token] = []
    at, denied = 0, False
    while at < len(tokens) - 1:
        word = tokens[at].text
        denied = (denied and not tokens[at].mark) or word in _DENYING or (word, tokens[at + 1].text) == ("leave", "out")
        read = None if tokens[at].mark or link_at(tokens, at) else reader.read(at)
        if read is not None and read[0].kind == "object" and not denied:
            told += [replace(tokens[at], text="and"), *tokens[at : read[1]]]
        at = read[1] if read is not None and read[0].kind == "object" else at + max(1, link_at(tokens, at))
    there = [replace(tokens[0], text=word, mark=False) for word in ("there", "is")]
    return [*there, *told[1:], tokens[-1]] if told else []


def has_verb(tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether one of `tokens` may be a verb and names nothing."""
    return any(_is_verb(token.text) and nouns.match([token.text]) is None for token in tokens)


def _heard(words: Sequence[str], read: tuple[Phrase, int] | None, nouns: Nouns) -> bool:
    """Whether `words`, of the phrase that was `read` if they are one, name nothing but that."""
    if read is None:
        return all((_is_nothing(word) and nouns.match([word]) is None) or not word[0].isalpha() for word in words)
    phrase = read[0]
    if phrase.kind == "object":
        named = [found.noun for word in words if (found := nouns.match([word])) is not None and not is_modifier(word)]
        plain = all(_is_nothing(word) or nouns.match([word]) is not None for word in words)
        return plain and all(noun == phrase.noun or noun in phrase.noun for noun in named)
    head = {phrase.head, *singulars(phrase.head)}
    nothing = phrase.kind in ("part", "background") or is_quality(phrase.head) or bool(head & lexicon.PARTS)
    nothing = nothing or phrase.head in lexicon.PRONOUNS or not phrase.determined
    return nothing and not head & (lexicon.STACK_NOUNS | lexicon.MEALS) and all(_is_nothing(word) for word in words)


def _is_nothing(word: str) -> bool:
    return makes_nothing(word) or is_modifier(word) or word in lexicon.NUMBERS or word in JOINERS or word.isdecimal()


def _is_verb(word: str) -> bool:
    return word in FINITE or word in lexicon.HAVING or base_verb(word) is not None or word.endswith(("ing", "ed"))


def is_thing(tokens: Sequence[Token], number: int) -> bool:
    """Whether word `number` is the head of "a corner structure": what cannot be made is no manner of speaking."""
    at = next((at for at, token in enumerate(tokens) if token.number == number and not token.mark), -1)
    if at < 0 or is_quality(tokens[at].text):
        return False
    words = [token.text for token in tokens]
    ends = tokens[at + 1].mark or words[at + 1] in ("and", "with") or link_at(tokens, at + 1) > 0
    counted = {"a", "an", *lexicon.NUMBERS} & {*words[max(0, at - 3) : at]}
    return ends and bool(counted)
