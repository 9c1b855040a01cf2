"""What a deed is done with: the stick of "push the box with the stick" lies by itself, and is nothing the box has.

Only for what is moved: of a deed that no task does, nothing it is done with is there before.
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Match, Nouns

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
_CUTLERY = ("knife", "kitchen knife", "fork", "spoon", "scissors")
"""What things are picked up with that have none of it: "pick up bread with knife"."""
_CARRYING = ("plate", "tray", "cutting board", "table", "desk", "counter", "toolbox", "shelf", "napkin", "placemat")
_CLOTHS = ("towel", "dish towel", "napkin", "paper towel", "sponge", "brush", "scrub brush", "paintbrush",
           "mop", "broom", "tissue box")  # fmt: skip
_DONE_WITH = {
    **dict.fromkeys(("dry", "wipe", "clean", "wash", "rinse", "scrub", "dust", "polish", "cover"), _CLOTHS),
    **dict.fromkeys(("cut", "slice", "chop", "carve", "split", "hold", "open"), _TOOLS),
}
"""Tools of what is done to a thing without an article: "dry plate with towel" tells no plate that has one."""


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
        found = noun_of(words[leads:end], nouns)
        behind = words[end : end + 1]
        ends = not behind or behind[0] in ("to", "into", "onto", "towards", "toward", "and", "from", "off")
        kinds = {*words[leads : leads + 1], words[end - 1]} & lexicon.GENERICS.keys()
        if words[at] == "using" and (kinds or (found is not None and ends)):
            return at, end
        if found is None or found.plural or not ends:
            continue
        owner = noun_of(words[:at], nouns)
        carried = owner is not None and any(nouns.of_class(owner.noun, each) for each in (vessels.HOLLOW, _CARRYING))
        picked = verb in _HANDLING and nouns.of_class(found.noun, _GRIPPING if carried else (*_GRIPPING, *_CUTLERY))
        taken = (
            words[leads - 1] == "the" and verb in _WORKING | _HANDLING and words[end - 1] in {t.text for t in before}
        )
        # "Open the box with the knife" may mean the box that has it; not so "the box by the lamp with the knife".
        placed = verb in ("open", "close") and any(link_at(body, n) for n in range(1, at))
        # "Get it out with the stick"
        placed = placed or (verb in _HANDLING and words[0] in ("it", "them"))
        tool = (verb in _WORKING | _TURNING or placed) and nouns.of_class(found.noun, _TOOLS)
        # "Pick up meat with spatula", and not "pick up plate with fork"
        bare = leads == at + 1 and carried and not any(link_at(body, n) for n in range(1, at))
        if (taken or tool or picked) and not bare:
            return at, end
    return 0, 0


def done_with(tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `tokens` begin with what is done to a thing with a tool: "cut bread with knife"."""
    words = [token.text for token in tokens]
    end = next((n for n in range(len(words)) if tokens[n].mark or words[n] in ("and", "then")), len(words))
    at = next((n for n in range(2, end - 1) if words[n] in ("with", "using")), 0)
    found = noun_of(words[at + 1 : end], nouns) if at and words[0] in _DONE_WITH else None
    return found is not None and nouns.of_class(found.noun, _DONE_WITH[words[0]])


def noun_of(words: Sequence[str], nouns: Nouns) -> Match | None:
    """The noun that ends `words`."""
    return next((one for n in range(max(len(words) - 3, 0), len(words)) if (one := nouns.match(words[n:]))), None)
