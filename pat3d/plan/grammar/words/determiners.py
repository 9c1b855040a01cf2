"""What a noun phrase opens with: determiners and numbers ("both of the", "half a dozen", "another two")."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token

_POINTING = frozenset({"that", "this", "those", "these"})


def opening(tokens: Sequence[Token], at: int) -> tuple[int, int | None, dict[str, bool]]:
    """Determiners and numbers from token `at`: the token after them, the count and the flags of a phrase."""
    count: int | None = None
    flags: dict[str, bool] = {}
    while not (token := tokens[at]).mark:
        word = token.text
        follower = tokens[at + 1].text
        if word == "each" and follower == "of":
            flags["each"] = flags["determined"] = True
            at += 1
        elif word in lexicon.POSSESSIVES:
            flags["possessive"] = flags["definite"] = True
        elif word == "half" and "dozen" in (follower, *(each.text for each in tokens[at + 2 : at + 3])):
            count, at = 6, at + (2 if follower == "a" else 1)
            flags["determined"] = True
        elif word == "half" and follower in ("a", "an"):
            # "Half a loaf": a note says that it is a whole one.
            count = None
        elif word in ("dozen", "couple", "pair", "trio", "set") and follower == "of":
            break
        elif word in ("dozen", "hundred", "thousand") and (count is not None or flags.get("determined")):
            count = (count or 1) * lexicon.NUMBERS[word]
        elif word in lexicon.NUMBERS and word not in ("couple", "dozen", "trio", "single"):
            count = lexicon.NUMBERS[word]
            flags["determined"] = True
            flags["one"] = word == "one"
            if word == "both":
                flags["definite"] = True
        elif word.isascii() and word.isdecimal():
            count = int(word[:9])
            flags["determined"] = True
        elif word in lexicon.VAGUE and word != "couple":
            count = lexicon.VAGUE[word]
            flags["determined"] = flags["vague"] = True
        elif word in ("couple", "dozen") and not tokens[at + 1].mark:
            count = lexicon.NUMBERS[word]
        elif word == "more" and count is not None and "another" not in flags:
            flags["another"] = True
        elif flags.get("determined") and (word in ("a", "an") or (word == "the" and tokens[at - 1].text in _POINTING)):
            # "and that one a lemon", "on those the small one" are of two things.
            break
        elif word in lexicon.DETERMINERS:
            flags["determined"] = True
            if word == "another":
                flags["another"] = True
            if word in lexicon.DEFINITE:
                flags["definite"] = True
            if word in ("each", "every"):
                flags["each"] = True
        elif word in ("other", "same", "single") and flags.get("determined"):
            flags["other"] = word == "other"
        else:
            break
        at += 1
    return at, count, flags
