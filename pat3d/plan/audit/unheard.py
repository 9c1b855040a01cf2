"""Words of a sentence that its plan has nothing of: in no name, in no phrase of an object and in no note."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.stacks import singulars
from pat3d.plan.audit.tallied import compared_words
from pat3d.plan.audit.words import DEEDS, EACH, FALLEN, FARTHEST, GUESTS, SILENT, THINGS, UNITS
from pat3d.scene.arrangements import crossing
from pat3d.scene.relations import carriers_of
from pat3d.scene.task_spec import SLIDING, steps_of

_MEASURING = (*UNITS, "radius", "diameter", "edge", "side", "height", "width", "depth", "length", "thickness", "wide",
              "tall", "long", "high", "deep")  # fmt: skip
"""Beginnings of words that say how large a thing is."""
_COLOURS = frozenset({"color", "colors", "colour", "colours", "different", "various", "colored", "coloured"})
_WEIGHED = frozenset({"heavier", "heaviest", "lightest"})
"""What tells things by their weight, which is that of their kind."""
_DRAPED = frozenset({"draped", "drapes", "drape", "slung", "hooked"})
"""Ways of hanging."""
_SIDES = frozenset({"left", "right", "front", "behind"})
_ENDS = frozenset({"goal", "aim", "task", "finally", "afterward", "afterwards"})
"""What a task is, and when it is done."""
_ALONG = frozenset({"left-hand", "right-hand", "central", "fourth", "fifth"})
_ACROSS = frozenset({"rear", "rearmost", "backmost", "hindmost", "frontmost", "foremost", "central", "fourth", "fifth"})
"""Places of likes beside each other, and of likes one behind the other."""
_SLIDING = frozenset({"open", "opened", "opening", "pull", "close", "closed", "shut", "push", "slide", "out", "in"})
"""What is done to a drawer."""
_MADE = frozenset({"made", "crafted", "carved"})
_NEIGHBOURS = frozenset({"pair", "neighbour", "neighbor", "neighbouring", "neighboring", "adjacent"})
"""What something is between: each of several and its neighbour."""
_IN_ROWS = frozenset({"form", "forms", "neat", "tidy", "orderly", "straight", "even"})
"""What a row does and is."""

_BUILT = frozenset({"tower", "pile", "column", "construct", "erect", "assemble"})
"""What is asked for by tasks of stacking."""


def unheard(it: Compared) -> list[tuple[int, str]]:
    """Words that are in no name, in no phrase of an object and in no note, and mean something."""
    words = it.said.words
    named = {at for mention in (*it.said.mentions, *it.said.compounds)
             for at in range(mention.start, mention.end)} | compared_words(it)  # fmt: skip
    told = [text for obj in it.plan.objects for text in (obj.phrase.lower(), obj.name, *obj.adjectives)]
    phrases = {word for text in told for word in re.findall(r"[\w'-]+", text)}
    # "a rubik's cube" is a name with an owner in it
    phrases |= {owner for obj in it.plan.objects for owner in re.findall(r"(\w+)'s\b", obj.name)}
    materials = {obj.material for obj in it.plan.objects if obj.material}
    asked = it.tasks.strip() or it.undone or "is read as the scene" in it.quoted
    made: list[tuple[int, str]] = []
    shapes = _shapes(it)
    measured = any(obj.extent is not None for obj in it.plan.objects) or "distances between" in it.quoted
    parts = {adjective for obj in it.plan.objects for adjective in obj.adjectives if "-" in adjective}
    for at, word in enumerate(words):
        # The blue rim of a plate, of which nothing is made, tells it from other plates.
        unpainted = bool({f"{words[at - 1]}-{one}" for one in (word, *singulars(word))} & parts)
        weighs = word in _WEIGHED or (word == "lighter" and all(obj.noun != "lighter" for obj in it.plan.objects))
        if weighs and not re.search(rf"\b{word}\b", it.quoted):
            made.append((at, f'not modelled: "{word}"'))
        if (
            at in named
            or weighs
            or phrases & {word, word.removesuffix("er"), word.removesuffix("est"), word[:-3], word[:-4]}
            or word in shapes
            or (word in SILENT and not unpainted)
            or not (word[0].isalpha() and word[1:].strip("0123456789"))
        ):
            continue
        if measured and word.startswith(_MEASURING):
            continue
        wished = word in ("get", "have") and words[at - 1 : at] in (["i"], ["we"], ["to"])
        wished = wished or (word in FARTHEST and it.beside_row([obj.name for obj in it.plan.objects]))
        wished = wished or (word in THINGS and it.ranked_thing(at))
        wished = wished or _goes_without_saying(words, at) or (word in GUESTS and _shared(it, words[at - 2 : at]))
        wished = wished or (word in _ENDS and bool(it.tasks.strip()))
        wished = wished or (word in _SLIDING and SLIDING & {kind for kind, *_ in steps_of(it.plan.task or "")} != set())
        acts = wished or (word == "robot" and words[at + 1 : at + 2] in (["should"], ["will"], ["finds"], ["can"]))
        hued = word in _COLOURS and len({obj.colours for obj in it.plan.objects}) > 2
        acts = acts or (word in ("surface", "area") and at - 1 in named) or it.tier_at(at) or it.tier_at(at + 1)
        gone = acts or hued or (word in FALLEN and words[at + 1 : at + 2] in (["out"], ["off"], ["from"], ["down"]))
        gone = gone or (word in _DRAPED and any(rel.kind == "hangs_from" for rel in it.plan.relations))
        gone = gone or (
            word in _MADE and any(find_material(one) in materials - {None} for one in words[at + 2 : at + 4])
        )
        if gone or find_colour(word) or find_material(word) in materials or (word == "half" and _halved(it)):
            continue
        if not re.search(rf"\b{re.escape(word)}\b", it.quoted) and not (asked and word in DEEDS):
            start = at
            while start and find_colour(words[start - 1]) and start - 1 not in named:
                start -= 1
            made.append((at, f'not heard: "{" ".join(words[start : at + 1])}"'))
    return made


def _goes_without_saying(words: Sequence[str], at: int) -> bool:
    """Whether the word at `at` is the "flat" of "lies flat on it", the "number" of "the number of them is two"."""
    word, before, after = words[at], words[at - 1], words[at + 1 : at + 2]
    flat = word == "flat" and (before in ("lies", "lie", "lying", "lay") or after in (["on"], ["onto"]))
    counted = word == "number" and before == "the" and after == ["of"]
    sided = word == "respectively" and len(_SIDES & {*words[:at]}) > 1
    sided = sided or (word == "apart" and after == ["from"])
    sided = sided or (word == "after" and (before == "one" or (after in (["that"], ["this"]) and at + 3 < len(words))))
    hued = word in ("color", "colour") and before == "in" and find_colour(words[at - 2]) is not None
    return flat or counted or sided or hued or (word in FARTHEST and after in (["left"], ["right"], ["to"]))


def _shared(it: Compared, before: Sequence[str]) -> bool:
    """Whether there is something for every one of the guests that stand behind the words `before`."""
    several = any(len(it.which(one)) > 1 for one in it.said.mentions if not one.plural and one.number in (None, 1))
    return several and ({*before[-1:]} <= EACH | {"per"} or before[:1] == ["for"])


def _shapes(it: Compared) -> frozenset[str]:
    """Words for how things stand that the plan has."""
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    stacked = any(rel.kind == "on" and nouns[rel.child] == nouns.get(rel.parent) for rel in it.plan.relations)
    round_about = {one.kind for one in it.plan.arrangements} & {"circle", "around"}
    lying = any(one.kind == "on_its_side" for one in it.plan.postures)
    heaped = any(len(carriers_of(name, it.plan.relations)) > 1 for name in nouns)
    left, right = ({rel.parent for rel in it.plan.relations if rel.kind == side} for side in ("left_of", "right_of"))
    ended = bool(left & right) or any(one.kind == "at_ends" for one in it.plan.arrangements)
    beside = {kind for one, kind, other in it.edges if nouns.get(one) == nouns.get(other)}
    colours = {obj.name: obj.colours for obj in it.plan.objects}
    alternating = any(
        len({colours[name] for name in one.objects}) > 1
        and all(colours[left] != colours[right] for left, right in pairwise(one.objects))
        for one in it.plan.arrangements
        if one.kind == "row"
    )
    stacked_in_turn = [names for kind, *names in steps_of(it.plan.task or "") if kind == "stack"]
    alternating |= len(stacked_in_turn) > 1 and all(colours[one] != colours[two] for one, two in stacked_in_turn)
    return (
        frozenset({"alternate", "alternates", "alternately", "alternating"} if alternating else ())
        | frozenset({"pyramid"} if heaped else ())
        | frozenset({"grid"} if crossing([one.objects for one in it.plan.arrangements if one.kind == "row"]) else ())
        | frozenset({"tower", "towers", "piles", "stacks", "high", "vertically"} if stacked else ())
        | {one.said for one in it.plan.postures}
        | frozenset({"vertically"} if "dish rack" in nouns.values() else ())
        | (_BUILT if "stack:" in it.tasks else frozenset[str]())
        | frozenset({"circle", "ring"} if round_about else ())
        | frozenset({"flat", "tipped", "toppled", "fallen", "knocked"} if lying else ())
        | frozenset({"ends"} if ended else ())
        | frozenset(_NEIGHBOURS if any(one.kind == "between" for one in it.plan.arrangements) else ())
        | (_ALONG if "left_of" in beside else frozenset[str]())
        | (_ACROSS if "behind" in beside else frozenset[str]())
        | frozenset(_IN_ROWS if any(one.kind == "row" for one in it.plan.arrangements) else ())
    )


def _halved(it: Compared) -> bool:
    """Whether half of some likes are told from the others by their colour, their posture or what they are on."""
    turned = {one.object for one in it.plan.postures}
    for mention in it.said.mentions:
        names = [obj.name for obj in it.of(mention)]
        for one in ((obj.colours, obj.name in turned, it.above(obj.name)[:1]) for obj in it.of(mention)):
            same = sum((obj.colours, obj.name in turned, it.above(obj.name)[:1]) == one for obj in it.of(mention))
            if 0 < same * 2 == len(names):
                return True
    return False
