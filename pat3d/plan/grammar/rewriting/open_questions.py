"""What a sentence leaves open: what is not there, half of some, and either of two, of which any one will do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.english import plural
from pat3d.plan.grammar.chunking.failures import UnreadError
from pat3d.plan.grammar.rewriting.denials import Told
from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_NEGATIONS = frozenset({
    "not", "never", "neither", "nor", "isn't", "aren't", "don't", "doesn't", "cannot", "can't", "none", "nobody",
    "wasn't", "weren't", "hasn't", "haven't",
})  # fmt: skip
_CHOICES = frozenset({"either", "whichever", "if", "unless", "whether"})
_ALTERNATE = frozenset({"second", "third", "fourth", "fifth", "sixth", "2nd", "3rd"})
"""Ordinals after "every"."""
_POSTURES = frozenset({"standing", "lying", "sitting", "resting"})
_EXCEPTIONS = frozenset({("all", "but"), ("everything", "but"), ("other", "than"), ("apart", "from")})


def choice(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "either of the two jars" and "either jar" as "one of the two jars".

    So is "whichever jar is taller" "the taller of the two jars", and "put it in either the jar or the box" without
    "either". "A shelf or rack" is one thing, the first.
    """
    for at in (n for n in range(2, len(words) - 2) if words[n] == "or" and not is_colour_word(words[n - 1])):
        start = at - next((n for n in (3, 2, 1) if nouns.match(words[max(at - n, 0) : at])), at)
        while start and is_modifier(words[start - 1]):
            start -= 1
        end = next((n for n in range(at + 1, at + 4) if nouns.longest(words[at + 1 : n + 1])), 0)
        end += bool(end and nouns.match(words[end : end + 2]))
        one = start and words[start - 1] in ("a", "an") and not {*words[at + 1 : end + 1]} & lexicon.LEADING
        if one and end and (tokens[end + 1].mark or link_at(tokens, end + 1) or words[end + 1] in FINITE | {"and"}):
            return [*tokens[:at], *tokens[end + 1 :]], [(tokens[at], tokens[end])]
    for at in range(len(words) - 2):
        if words[at] not in ("either", "whichever") or words[at + 1] in ("side", "end", "is"):
            continue
        stop = next(n for n in range(at, len(words)) if tokens[n].mark)
        either = words[at] == "either"
        if either and "or" in words[at:stop]:
            # "Either a mug or a glass is there" leaves open what is.
            asked = known_verb(words[0]) and words[at + 1] in lexicon.DEFINITE
            return ([*tokens[:at], *tokens[at + 1 :]], []) if asked else None
        of = at + 1 + (words[at + 1] == "one")
        if either and words[of] == "of":
            return [*tokens[:at], replace(tokens[at], text="one"), *tokens[of:]], []
        head = next((n for n in range(at + 1, min(at + 4, stop)) if nouns.match([words[n]])), 0)
        ranked = head and words[head + 1] == "is" and words[head + 2].endswith("er") and tokens[head + 3].mark
        if not head or singulars(words[head]) or not (either or ranked):
            continue
        which = ["the", words[head + 2]] if ranked and words[head + 2] in lexicon.SUPERLATIVES else ["one"]
        said = [replace(tokens[at], text=word) for word in (*which, "of", "the", "two")]
        several, end = replace(tokens[head], text=plural(words[head])), head + 2 * bool(ranked)
        kept = [*tokens[:at], *said, *tokens[at + 1 : head], several, *tokens[end + 1 :]]
        return kept, [(tokens[at], tokens[end])]
    return None


def refuse_negations(tokens: Sequence[Token]) -> None:
    """Raises: PromptError: the sentence denies, leaves a choice, or counts by a fraction."""
    for at, token in enumerate(tokens[:-1]):
        follower = tokens[at + 1].text
        if token.text in _NEGATIONS:
            raise UnreadError(
                f'"{token.text}" (word {token.number}): a prompt says what is there, not what is not. Say where things '
                "are, and leave the rest out.",
                token.number,
            )
        if (token.text, follower) in _EXCEPTIONS or token.text in ("except", "excluding"):
            raise UnreadError(
                f'"{token.text}" (word {token.number}): a prompt says what is there, not what is not. Say what is '
                'there, and how many in numbers: "four of the five apples are in the basket".',
                token.number,
            )
        if (
            token.text == "but"
            and follower in lexicon.NUMBERS
            and "all" in [each.text for each in tokens[max(0, at - 4) : at]]
        ):
            raise PromptError(
                f'"all ... but {follower}" (word {token.number}): of how many is not said. Say how many there are: '
                '"all but one of the six cups are red".'
            )
        excepted = next(
            (n for n in range(at + 2, min(at + 5, len(tokens) - 1)) if tokens[n].text in ("but", "save")), 0
        )
        if token.text in ("every", "each") and excepted and not any(each.mark for each in tokens[at:excepted]):
            raise PromptError(
                f'"{token.text} ... {tokens[excepted].text} {tokens[excepted + 1].text}" (word {token.number}): of how '
                'many is not said. Say how many there are, and how many it is said of: "three of the four cups hold a '
                'pen".'
            )
        if token.text in ("every", "each") and follower in _ALTERNATE:
            raise PromptError(
                f'"{token.text} {follower}" (word {token.number}): say which of them by their places: "the first '
                'and the third of four jars".'
            )
        side = follower in ("side", "end")
        if token.text in _CHOICES and not side:
            raise PromptError(f'"{token.text}" (word {token.number}): say the one thing that is to be there.')
        number = follower == "of" and at + 2 < len(tokens) and tokens[at + 2].text in ("the", "them", "these", "all")
        plural = number and any(
            each.text in lexicon.NUMBERS or each.text in lexicon.PRONOUNS or singulars(each.text)
            for each in tokens[at + 2 : at + 6]
        )
        if token.text in ("most", "majority") and plural and not tokens[at + 1].mark:
            raise PromptError(
                f'"{token.text}" (word {token.number}): say how many in numbers: "four of the eight blocks are red".'
            )


def refuse_inserted(text: str, tokens: Sequence[Token]) -> None:
    """Raises: PromptError: "with two eggs and, next to it, a mill" leaves open what "it" is, and what is in what."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 4):
        if words[at] in _POSTURES and words[at + 1] == "," and words[at + 2] in ("with", "together", "along"):
            raise PromptError(
                f'"{words[at]}, {words[at + 2]}" (word {tokens[at].number}): what is inserted may be said of several '
                'things. Say it in a sentence of its own: "The lamp stands on the table."'
            )
        size = link_at(tokens, at + 2) if words[at : at + 2] == ["and", ","] else 0
        end = at + 2 + size
        inserted = size and words[end] == "it" and words[end + 1] == ","
        if inserted and set(words[:at]) & lexicon.HAVING:
            said = text[tokens[at + 2].start : tokens[end].end]
            raise PromptError(
                f'"{said}" (word {tokens[at + 2].number}) is inserted where it may be said of several things. Say it '
                'in a sentence of its own: "Next to the pan is a pepper mill."'
            )
