"""Deeds of which a name is no name, stands behind one without a joint, or tells how another comes about.

"Nail the board to the wall", "take the egg put it in the pot", "make a snack by placing bread on the plate".
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_NAMES = """
    screw nail clip plug button bolt pin staple tape glue zip buckle hammer saw brush comb iron lock latch peg rope
    chain lace sponge mop vacuum drill
"""
FASTENING = frozenset(_NAMES.split())
_MEANT = lexicon.DEFINITE | lexicon.POSSESSIVES | {"it", "them", "both", "all"}
_FITTED = frozenset({"lid", "cap", "top", "cover", "bulb", "nozzle", "handle", "knob", "plug", "lens", "hook", "lids",
                     "caps", "bulbs"})  # fmt: skip
"""What is screwed or clipped on or in."""
_TOGETHER = frozenset({"up", "down", "off", "together", "shut"})
_OPENING = frozenset({"please", "first", "now", "then", "finally", "could", "can", "would", "you", ",", "and"})
_MAKING = frozenset({"make", "build", "create", "prepare", "assemble", "form", "construct", "compose", "fix"})
"""Verbs of what comes about by other deeds."""
_PLACING = frozenset({"put", "place", "set", "lay", "arrange", "move", "add", "drop", "insert", "bring", "transfer"})


def fastens(tokens: Sequence[Token], at: int) -> bool:
    """Whether the name at token `at` is a verb there: before what is meant, or before "on the lid"."""
    follower, behind = tokens[at + 1].text, tokens[min(at + 2, len(tokens) - 1)].text
    if follower in _MEANT or (follower in ("a", "an") and not at):
        return True
    if follower not in {"on", "in", *_TOGETHER} or behind not in _MEANT:
        return False
    stop = next(n for n in range(at + 2, len(tokens)) if tokens[n].mark or link_at(tokens, n))
    plugs = tokens[at].text == "plug" and follower == "in"
    return plugs or follower in _TOGETHER or tokens[stop - 1].text in _FITTED


def runs_on(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether a deed begins behind the name at token `at` without a word between: "take the egg put it in the pot"."""
    words = [token.text for token in tokens[at : at + 4]]
    named = nouns.match(words[:1]) is not None and len(words) > 3 and nouns.match(words[:2]) is None
    first = 2 + (words[1:3] == ["pick", "up"])
    return named and words[1] in ("put", "place", "pick", "get", "take", "open", "close") and (
        words[min(first, len(words) - 1)] in (*lexicon.DEFINITE, "it", "them", "a", "an"))  # fmt: skip


def made_by(tokens: Sequence[Token]) -> int:
    """The "by" of "make a snack by placing bread and ham on the plate": what is made so is no object; 0 without."""
    words = [token.text for token in tokens]
    verb = next((n for n, word in enumerate(words) if word not in _OPENING), 0)
    by = words.index("by") if words[verb] in _MAKING and "by" in words[verb + 2 : -1] else 0
    deed = (base_verb(words[by + 1]) if by and words[by + 1].endswith("ing") else None) or ""
    # "Make a tower by stacking the cubes" is to stack them.
    plain = not {"scene", "scenario", "setup", "image"} & {*words[verb:by]} and deed != "stack"
    plain = plain and not any(tokens[n].mark or link_at(tokens, n) for n in range(verb, by))
    return by if by and plain and deed in _PLACING else 0
