"""What a deed is done with: the stick of "push the box with the stick" lies by itself, and is nothing the box has.

Only for what is moved: of a deed that no task does, nothing it is done with is there before.
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Nouns

_WORKING = frozenset({"push", "sweep", "drag", "nudge", "shove", "slide", "shift", "clean", "collect", "plate"})
"""Deeds that are done with a tool more often than to what a thing holds."""
_TURNING = frozenset({"turn", "flip", "rotate", "tilt", "roll"})
"""Deeds that are done with a tool, or to what is told by what it holds."""
_HANDLING = frozenset({"pick", "lift", "grab", "grasp", "take", "move", "put", "place", "transfer", "remove", "hold",
    "get"})  # fmt: skip
_TOOLS = (
    "stick", "baseball bat", "bat", "hammer", "mallet", "knife", "kitchen knife", "tongs", "spatula", "broom", "mop",
    "brush", "paintbrush", "sponge", "towel", "dish towel", "rake", "shovel", "trowel", "ladle", "rod", "wrench",
    "pliers", "scissors", "tweezers", "chopsticks", "screwdriver", "spoon", "fork", "ruler", "peeler", "whisk",
    "pizza cutter", "cue", "tennis racket", "meat cleaver", "saw", "chisel", "power drill", "tape measure",
    "utility knife", "crowbar",
)  # fmt: skip
_GRIPPING = ("tongs", "spatula", "stick", "tweezers", "chopsticks", "pliers", "ladle")
"""What things are picked up and put down with."""


def wielded(body: Sequence[Token], verb: str, before: Sequence[Token], nouns: Nouns) -> tuple[int, int]:
    """Where `body` of an instruction with `verb` says what it is done with, from "with" on; (0, 0) where it does not.

    A tool is one by its kind, or because it was taken before: `before` are the tokens up to the instruction.
    """
    words = [token.text for token in body]
    for at in (n for n in range(1, len(words) - 1) if words[n] in ("with", "using")):
        if words[at : at + 3] == ["using", "the", "light"] and words[at + 3 : at + 4] in (["from"], ["of"]):
            # "Read the book using the light from the lamp"
            return at + 3, next((n for n in range(at + 4, len(words)) if body[n].mark), len(words))
        leads = at + 1 + (words[at + 1] in lexicon.DETERMINERS | lexicon.POSSESSIVES)
        end = next(
            (n for n in range(leads, len(words)) if body[n].mark or words[n] == "and" or link_at(body, n)), len(words)
        )
        found = next((one for n in range(leads, end) if (one := nouns.match(words[n:end])) is not None), None)
        behind = words[end : end + 1]
        ends = not behind or behind[0] in ("to", "into", "onto", "towards", "toward", "and", "from", "off")
        using = words[at] == "using" and (found is not None or words[leads] in lexicon.GENERICS)
        if not ends or not (using or (found is not None and not found.plural and leads > at + 1)):
            continue
        taken = (
            words[leads - 1] == "the" and verb in _WORKING | _HANDLING and words[end - 1] in {t.text for t in before}
        )
        # "Open the box with the knife" may mean the box that has it; not so "the box by the lamp with the knife".
        placed = verb in ("open", "close") and any(link_at(body, n) for n in range(1, at))
        # "Get it out with the stick"
        placed = placed or (verb in _HANDLING and words[0] in ("it", "them"))
        noun = found.noun if found is not None else ""
        tool = (verb in _WORKING | _TURNING or placed) and nouns.of_class(noun, _TOOLS)
        if taken or tool or using or (verb in _HANDLING and nouns.of_class(noun, _GRIPPING)):
            return at, end
    return 0, 0
