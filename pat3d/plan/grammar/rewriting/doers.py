"""Who is told to act, and is told nothing by it: "have the left arm lift the cup" is "lift the cup".

The audit names the arm, which no task says.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import base_of, known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token

_LETTING = frozenset({"have", "let", "make", "get", "ask", "tell", "command"})
_WITH_TO = frozenset({"get", "ask", "tell", "command"})
"""Verbs that let someone act by "to": "ask the robot to put"."""
_LIMBS = frozenset({"arm", "arms", "hand", "hands", "gripper", "grippers", "manipulator", "effector"})
_ROBOTS = frozenset({"robot"})
_OWNERS = frozenset({"the", "your", "my", "our"})
"""Words before the limb of who is told; "its left arm" is a thing's."""
_OF_LIMBS = frozenset({"left", "right", "other", "robot", "robotic", "'s", "robot's", "end", "both", "free", "same"})
_MOVING = frozenset({"move", "raise", "extend", "reach", "lower"})
_TOLD_OF = frozenset({"picks", "places", "puts", "grabs", "grasps", "lifts", "takes", "moves", "pushes", "inserts",
                      "opens", "closes", "removes", "pours", "wipes", "holds"})  # fmt: skip
"""Deeds of somebody who is not named."""
_LED = frozenset({"and", "then", ",", "while", "please"})
_PARTICLES = frozenset({"up", "down", "out", "off", "away", "over", "back"})


def told_plainly(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` of a prompt without who is to do what is told."""
    left, made, at = list(tokens), list[Token](), 0
    while at < len(left):
        if end := _with_limb(left, at):
            at = end
            continue
        opens = not made or left[at - 1].mark or left[at - 1].text in _LED
        verb = _deed(left, at) if opens else 0
        # "Picks up the pear"
        unnamed = not made and left[at].text in _TOLD_OF and left[at + 1].text in lexicon.DETERMINERS | _PARTICLES
        if verb or unnamed:
            at = verb or at
            left = [*left[: at + 1], *_finished(left, at + 1)]
            left[at] = replace(left[at], text=base_of(left[at].text))
        made.append(left[at])
        at += 1
    return made


def _limb(tokens: Sequence[Token], at: int, heads: frozenset[str]) -> int:
    """The token behind "the left arm", "your right hand", at token `at`; 0 where none of `heads` is named."""
    end = at + (tokens[at].text in _OWNERS)
    while end < len(tokens) - 2 and tokens[end].text in _OF_LIMBS and tokens[end + 1].text in heads | _OF_LIMBS:
        end += 1
    while end < len(tokens) - 2 and tokens[end].text in heads and tokens[end + 1].text in heads:
        end += 1
    return end + 1 if tokens[end].text in heads else 0


def _with_limb(tokens: Sequence[Token], at: int) -> int:
    """The token behind "with your left hand", "using arm B", at token `at` of an instruction; 0 where none acts."""
    last = len(tokens) - 1
    end = _limb(tokens, at + 1, _LIMBS) if tokens[at].text in ("with", "using") and at < last else 0
    if not end or end > last:
        return 0
    label = end < last and len(tokens[end].text) == 1 and tokens[end].text.isalnum()
    label = label and tokens[end - 1].text in _LIMBS and (tokens[end].text != "a" or tokens[end + 1].mark)
    told = label or {"left", "right", "both", "other"} & {token.text for token in tokens[at:end]}
    end += label
    opens = not at or tokens[at - 1].text in ("and", "then", ",", ".")
    start = next((n + 1 for n in range(at - 1, -1, -1) if tokens[n].text == "."), 0)
    ends = tokens[end].mark or tokens[end].text in _LED or (link_at(tokens, end) and tokens[end].text != "of")
    asked = any(known_verb(token.text) for token in tokens[start : min(start + 4, at)])
    verb = end + (opens and tokens[end].text in (",", "to"))
    if opens and known_verb(tokens[min(verb, last)].text):
        return verb if told else 0
    return end if told and asked and ends else 0


def _deed(tokens: Sequence[Token], at: int) -> int:
    """The verb of what someone is told to do at token `at`: "let the robot VERB", "the left arm VERBs"; else 0."""
    word = tokens[at].text
    last = len(tokens) - 2
    if at >= last:
        return 0
    if word in _LETTING and (end := _limb(tokens, at + 1, _LIMBS | _ROBOTS)) and end < last:
        named = tokens[at + 1].text in _OWNERS
        verb = end + (tokens[end].text == "to")
        plain = (tokens[end].text == "to") == (word in _WITH_TO)
        return verb if named and plain and _is_told(tokens, verb, finite=False) else 0
    if word in _MOVING:
        start = at + 1 + (tokens[at + 1].text == "out")
        start += tokens[start].text == "with"
        end = _limb(tokens, start, _LIMBS)
        joined = end and end < last and tokens[end].text in ("to", "and")
        return end + 1 if joined and _is_told(tokens, end + 1, finite=False) else 0
    end = _limb(tokens, at, _LIMBS)
    if not end or end >= last or tokens[at].text not in _OWNERS | _OF_LIMBS:
        return 0
    marked = tokens[end].text in (":", "-", ",")
    verb = end + marked
    if marked and [token.text for token in tokens[verb : verb + 3]] == ["reach", "out", "and"]:
        verb += 3
    modal = tokens[verb].text in (*lexicon.MODALS, "to") and not marked
    verb += modal
    return verb if _is_told(tokens, verb, finite=not marked and not modal) else 0


def _is_told(tokens: Sequence[Token], verb: int, *, finite: bool) -> bool:
    """Whether a deed begins at token `verb`, with the ending of its person where it is `finite`."""
    word = tokens[min(verb, len(tokens) - 1)].text
    base = base_of(word)
    own = known_verb(base) and (word == base) != finite and word not in lexicon.COPULAS
    return own and not tokens[verb + 1].mark


def _finished(tokens: Sequence[Token], at: int) -> list[Token]:
    """`tokens` from `at` on, where "lifts the cup and places it" goes on with a verb in the same person."""
    made: list[Token] = []
    for n in range(at, len(tokens)):
        token = tokens[n]
        base = base_of(token.text) if tokens[n - 1].text in ("and", "then", ",") and n > at else ""
        follower = tokens[min(n + 1, len(tokens) - 1)].text
        object_ = follower in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"it", "them"} | _PARTICLES
        again = known_verb(base) and token.text != base and token.text.endswith("s") and object_
        made.append(replace(token, text=base) if again else token)
    return made
