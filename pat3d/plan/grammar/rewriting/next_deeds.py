"""What leads to the next deed: "after that put it away" as "then put ...", "repeat for the fork" as "do the same"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token

_LATER = tuple(tuple(said.split()) for said in (
    "then after that", "after that", "after this", "afterwards", "afterward", "next", "subsequently", "thereafter",
    "finally", "lastly", "second", "third",
))  # fmt: skip
_AGAIN = ("likewise",), *(tuple(f"{said} {joint}".split()) for joint in ("with", "for", "to") for said in (
    "repeat", "repeat this", "repeat that", "repeat it", "repeat the same", "the same", "same", "same thing",
    "the same thing", "the same goes", "same goes", "likewise", "do likewise", "do this", "do it"))  # fmt: skip
_LEADS = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys()


def next_deeds(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with what leads to another deed as "then", and what repeats the last one as "do the same with"."""
    made, asked, at = list[Token](), False, 0
    words = [token.text for token in tokens]
    while at < len(words) - 1:
        opens = not made or made[-1].mark or made[-1].text in ("and", "then", "but")
        phrases = _AGAIN if opens else _LATER
        size = max((len(said) for said in phrases if tuple(words[at : at + len(said)]) == said), default=0)
        deed, behind = (*words[at + size : at + size + 2], "", "")[:2]
        follows = deed in _LEADS if opens else known_verb(deed) and behind in _LEADS | {"it", "them", "up"}
        if asked and size and follows:
            told = ("do", "the", "same", "with") if opens else ("then",)
            made += [replace(tokens[at + min(n, size - 1)], text=word) for n, word in enumerate(told)]
        else:
            asked = asked or (known_verb(words[at]) and words[at + 1] in _LEADS | {"up"})
            size = 1
            made.append(tokens[at])
        at += size
    return [*made, tokens[-1]]
