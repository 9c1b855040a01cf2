"""What is near the one who is told: "put the jar nearest to you on the shelf" is told to the robot."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words.lexing import Token

_VIEWED = frozenset({"you", "me", "yourself", "us"})
_NEAR = frozenset({"nearest", "closest", "nearer", "closer", "furthest", "farthest", "next", "close"})


def by_the_robot(sentence: list[Token]) -> list[Token]:
    """Read "put the jar nearest to you on the shelf" as "... nearest to the robot": it is told what to do."""
    words = [token.text for token in sentence]
    asked = known_verb(words[int(words[0] == "please")])
    at = next((n for n in range(2, len(words) - 2) if words[n] == "to" and words[n - 1] in _NEAR
               and words[n + 1] in _VIEWED), 0)  # fmt: skip
    if not asked or not at:
        return sentence
    robot = [replace(sentence[at + 1], text=word) for word in ("the", "robot")]
    return [*sentence[: at + 1], *robot, *sentence[at + 2 :]]
