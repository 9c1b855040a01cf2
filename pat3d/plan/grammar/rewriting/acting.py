"""The robot that does what is told is no object of the scene: "put the cup in front of the robot" places no robot.

What is said of where it stands, reaches or looks from is taken out of an instruction, and a note names it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import Clause
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.vocabulary import Nouns

_ACTORS = frozenset({"robot", "gripper", "manipulator"})
_LIMBS = frozenset({"arm", "arms", "gripper", "hand", "hands", "base", "manipulator", "end", "effector"})
_OWN = frozenset({
    "left", "right", "front", "side", "hand", "left-hand", "right-hand", "reach", "base", "workspace", "perspective",
    "view", "viewpoint", "point", "of", "gripper", "arm", "grasp", "body", "direction",
})  # fmt: skip
"""Words of "the robot's left side", "the robot's point of view"."""
_REACH = frozenset({"reach", "workspace", "perspective", "view", "viewpoint", "gripper", "arm"})
"""What only a robot that acts has."""
_DEGREES = frozenset({"closer", "closest", "nearer", "nearest", "further", "furthest", "farther", "farthest", "close",
                      "near", "directly", "right", "just", "back"})  # fmt: skip
_MEANS = (("with",), ("using",), ("by",), ("with", "the", "help", "of"))
_VIEWS = (("as", "seen", "from"), ("seen", "from"), ("viewed", "from"), ("from",), ("within",), ("facing",), ("for",),
          ("out", "of"), ("relative", "to"))  # fmt: skip


def asked_of_the_robot(tokens: Sequence[Token], _: Nouns) -> list[Token]:
    """`tokens` of a prompt with "can the robot reach it?" as "the robot can reach it?", where "can" names no can."""
    made = list(tokens)
    for at in range(len(made) - 3):
        opens = not at or made[at - 1].mark
        if opens and made[at].text in lexicon.MODALS and made[at + 1].text == "the" and made[at + 2].text in _ACTORS:
            made[at : at + 3] = [*made[at + 1 : at + 3], made[at]]
    return made


def without_actor(text: str, told: Sequence[Clause]) -> tuple[list[Clause], list[str], list[str]]:
    """The clauses `told` of `text` without the robot that acts, what a note is to name, and what it acts with.

    Nothing changes where a robot is an object ("a robot", "the toy robot"), or nobody is told what to do and no
    reach or view of it is spoken of.
    """
    tokens = [token for clause in told for token in clause.tokens]
    objects = any(
        {token.text, *singulars(token.text)} & {"robot"} and (at == 0 or tokens[at - 1].text != "the")
        for at, token in enumerate(tokens)
    )
    if objects:
        return list(told), [], []
    commanded = any(clause.manner is not None for clause in told)
    kept: list[Clause] = []
    named: list[str] = []
    means: list[str] = []
    for clause in told:
        plain = list(clause.tokens)
        while (span := _span(plain)) is not None:
            start, end, between = span
            if not commanded and not _REACH & {token.text for token in plain[start:end]}:
                break
            away = plain[start:end]
            said = text[min(token.start for token in away) : max(token.end for token in away)]
            (means if (away[0].text,) in _MEANS else named).append(said)
            plain[start:end] = between
            side = next((token for token in away if token.text in ("left", "right")), None)
            noun = plain[start - 1].text if start > 1 else ""
            if side is not None and plain[start - 2].text == "the" and [token.text for token in tokens].count(noun) > 1:
                # "the bowl to the left of the robot" beside another bowl
                plain.insert(start - 1, side)
        if len(plain) == len(clause.tokens) or any(not token.mark for token in plain):
            kept.append(replace(clause, tokens=tuple(plain)))
    return kept, named, means


def _span(tokens: Sequence[Token]) -> tuple[int, int, list[Token]] | None:
    """Where `tokens` say where something is by the robot that acts, and what stays there; None where they do not."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 1):
        end = _named(words, at)
        if not end:
            continue
        start = _leads(tokens, words, at)
        if start < at:
            return start, end, []
        if words[at - 1] == "and" and (start := _between(words, at)):
            return start, end, [replace(tokens[start], text="near"), *tokens[start + 1 : at - 1]]
    return None


def _named(words: Sequence[str], at: int) -> int:
    """The word after "the robot", "the robot's left side" at word `at`; 0 where it is not named there."""
    if words[at] == "your":
        return next((n for n in range(at + 1, len(words)) if words[n] not in _LIMBS | {"left", "right", "own"}), 0)
    if words[at] != "the" or words[at + 1] not in (*_ACTORS, "robotic"):
        return 0
    end = at + 2
    while words[end] in _LIMBS:
        end += 1
    if words[end] == "'s":
        end += 1
        while words[end] in _OWN:
            end += 1
    return end


def _leads(tokens: Sequence[Token], words: Sequence[str], at: int) -> int:
    """The first word of the relation that leads to word `at`; `at` where none does."""
    spans = [at - len(view) for view in (*_VIEWS, *_MEANS) if tuple(words[max(at - len(view), 0) : at]) == view]
    spans += [n for n in range(max(at - 6, 0), at) if n + link_at(tokens, n) == at and words[n] != "of"]
    start = min(spans, default=at)
    while start < at and start and words[start - 1] in _DEGREES:
        start -= 1
    return start


def _between(words: Sequence[str], at: int) -> int:
    """The "between" of "between the bowl and the robot" at word `at`; 0 where there is none near."""
    return next((n for n in range(at - 2, max(at - 8, 0), -1) if words[n] == "between"), 0)
