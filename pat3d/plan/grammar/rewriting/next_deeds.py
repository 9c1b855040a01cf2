"""What leads to the next deed: "after that put it away" as "then put ...", "repeat for the fork" as "do the same"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token

_LATER = tuple(tuple(said.split()) for said in (
    "then after that", "after that", "after this", "after which", "afterwards", "afterward", "next", "subsequently",
    "thereafter", "finally", "lastly", "once done", "when done", "following that", "second", "third",
))  # fmt: skip
_AGAIN = tuple(tuple(said.split()) for said in (
    *(f"{lead} {joint}" for joint in ("with", "for", "to") for lead in (
        "repeat", "repeat this", "repeat that", "repeat it", "repeat the same", "and the same", "the same", "same",
        "same thing", "the same thing", "the same goes", "same goes", "likewise", "do likewise", "do this", "do it")),
    "likewise",
))  # fmt: skip
_JOINTS = frozenset({"and", "then", "but"})
_LEADS = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys()
_THE_SAME = ("do", "the", "same", "with")


def next_deeds(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with what leads to another deed as "then", and what repeats the last one as "do the same with"."""
    made = list[Token]()
    words = [token.text for token in tokens]
    asked = at = 0
    while at < len(words):
        asked = asked or (known_verb(words[at]) and words[min(at + 1, len(words) - 1)] in _LEADS | {"up"})
        opens = not made or made[-1].mark or made[-1].text in _JOINTS
        later = next((len(said) for said in _LATER if tuple(words[at : at + len(said)]) == said), 0)
        verb = at + later + (words[at + later : at + later + 1] == ["please"])
        deed = later and verb < len(words) - 2 and known_verb(words[verb]) and words[verb] not in ("to", "set")
        deed = deed and words[verb + 1] in _LEADS | {"it", "them", "up"}
        if asked and deed and not opens:
            made.append(replace(tokens[at], text="then", end=tokens[at + later - 1].end))
            at += later
            continue
        same = next((len(said) for said in _AGAIN if tuple(words[at : at + len(said)]) == said), 0)
        if asked and same and opens and words[at + same] in _LEADS:
            last = min(same, len(_THE_SAME)) - 1
            made += [replace(tokens[at + min(n, last)], text=word) for n, word in enumerate(_THE_SAME)]
            at += same
            continue
        made.append(tokens[at])
        at += 1
    return made
