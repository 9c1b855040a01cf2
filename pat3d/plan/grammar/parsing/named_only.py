"""The things that a sentence names, where nothing else of it can be read: "the globe is as far off as the desk allows".

They are placed, and a note has the whole sentence. A sentence that counts, denies or leaves a choice is none of these:
of what it names there might be more, or less.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.chunking.phrases import PhraseReader
from pat3d.plan.grammar.rewriting.outcomes import TAKING
from pat3d.plan.grammar.rewriting.tails import Tails
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE, LONGEST_LINK
from pat3d.plan.grammar.words.unmade import base_verb, is_quality
from pat3d.plan.grammar.words.vocabulary import Nouns

_COUNTING = frozenset({
    "each", "every", "either", "neither", "both", "half", "twice", "double", "triple", "other", "others", "another",
    "one", "ones", "rest", "none", "more", "fewer", "less", "without", "instead", "or", "no", "not", "nothing",
    "nobody", "never", "if", "unless", "whether", "whichever", "whatever", "except", "apart", "minus", "all",
    "respectively", "same", "order", "remaining", "replaced", "missing", "gone", "removed", "lacks", "absent",
    "partner", "mate", "labelled", "labeled", "marked", "until", "unlike", "such",
})  # fmt: skip
"""Words by which there are more or fewer things than the phrases of a sentence say."""

_DENYING = frozenset({"without", "no", "any", "instead", "omit", "skip", "exclude", "rather", "nobody", "nothing"})
"""Words behind which something is not there."""


def names_all(tokens: Sequence[Token], nouns: Nouns, number: int, *, asked: bool = False) -> bool:
    """Whether what `tokens` of one sentence name is all that it tells of, whatever it tells of that.

    Word `number` of the prompt is where its reading fails. What is `asked` for has lost its verb.
    """
    fault = next((token.text for token in tokens if token.number == number and not token.mark), "")
    inserted = any(one.text == "and" and two.mark for one, two in pairwise(tokens))
    counted = {token.text for token in tokens} & (_COUNTING | lexicon.MEALS)
    unsaid = (
        inserted
        or counted
        or not fault
        or fault.endswith("n't")
        or fault in lexicon.PRONOUNS
        or is_thing(tokens, number)
    )
    return not unsaid and (asked or has_verb(tokens, nouns)) and not Tails(tokens, nouns, {}).unknown()


def things_named(text: str, tokens: Sequence[Token], nouns: Nouns) -> tuple[list[Token], list[str]]:
    """The things that `tokens` of one sentence name as "there is a cup and a plate"; empty without any.

    Second are phrases of what is not made, as "the yellow heart".

    "Without a lid", "leave out the knives" name what is not there.
    """
    reader = PhraseReader(text, [*tokens, *[tokens[-1]] * (LONGEST_LINK + 4)], nouns)
    told, missing = list[Token](), list[str]()
    at, denied = 0, False
    while at < len(tokens) - 1:
        word = tokens[at].text
        denied = (denied and not tokens[at].mark) or word in _DENYING or (word, tokens[at + 1].text) == ("leave", "out")
        before = tokens[at - 1].text if at else ""
        # "its handle shouldn't stick out", "if you can"
        does = before in lexicon.MODALS or before.endswith("n't") or "you" in (before, word)
        read = None if tokens[at].mark or link_at(tokens, at) or does else reader.read(at)
        lacking = read[0].words if read is not None and read[0].kind == "unknown" and read[0].determined else ""
        while read is not None and read[0].kind == "unknown" and read[1] > at + 1:
            # "the keys wherever the wallet is"
            read = PhraseReader(text, [*tokens[: read[1] - 1], *[tokens[-1]] * (LONGEST_LINK + 4)], nouns).read(at)
        if read is not None and read[0].kind == "object" and not denied:
            told += [replace(tokens[at], text="and"), *tokens[at : read[1]]]
        elif lacking and not denied:
            missing.append(lacking)
        at = read[1] if read is not None and read[0].kind == "object" else at + max(1, link_at(tokens, at))
    there = [replace(tokens[0], text=word, mark=False) for word in ("there", "is")]
    return ([*there, *told[1:], tokens[-1]] if told else []), missing


def begins_with_thing(text: str, tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether what `tokens` of one instruction are about is named first: "pick up the bowl right beside the box"."""
    words = [token.text for token in tokens]
    verb = next((at for at in range(len(words) - 2, -1, -1) if words[at] in TAKING), -1)
    start = verb + 1 + (words[verb + 1] == "up")
    there, _ = things_named(text, tokens, nouns)
    return bool(there) and there[2].number == tokens[start].number


def has_verb(tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether one of `tokens` may be a verb and names nothing."""
    return any(_is_verb(token.text) and nouns.match([token.text]) is None for token in tokens)


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
