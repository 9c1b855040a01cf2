"""Words of a sentence that its plan has nothing of: in no name, in no phrase of an object and in no note."""

from __future__ import annotations

import re

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.words import DEEDS, FALLEN, SILENT
from pat3d.scene.arrangements import crossing
from pat3d.scene.relations import carriers_of

_COLOURS = frozenset({"color", "colors", "colour", "colours", "different", "various", "colored", "coloured"})


def unheard(it: Compared) -> list[tuple[int, str]]:
    """Words that are in no name, in no phrase of an object and in no note, and mean something."""
    words = it.said.words
    named = {at for mention in (*it.said.mentions, *it.said.compounds)
             for at in range(mention.start, mention.end)}  # fmt: skip
    told = [text for obj in it.plan.objects for text in (obj.phrase.lower(), obj.name, *obj.adjectives)]
    phrases = {word for text in told for word in re.findall(r"[\w'-]+", text)}
    materials = {obj.material for obj in it.plan.objects if obj.material}
    asked = it.tasks.strip() or it.undone or "is read as the scene" in it.quoted
    made: list[tuple[int, str]] = []
    shapes = _shapes(it)
    for at, word in enumerate(words):
        if (
            at in named
            or phrases & {word, word.removesuffix("er"), word.removesuffix("est"), word[:-3], word[:-4]}
            or word in shapes
            or word in SILENT
            or not word[0].isalpha()
        ):
            continue
        acts = word == "robot" and words[at + 1 : at + 2] in (["should"], ["will"], ["finds"], ["can"])
        hued = word in _COLOURS and len({obj.colours for obj in it.plan.objects}) > 2
        gone = acts or hued or (word in FALLEN and words[at + 1 : at + 2] in (["out"], ["off"], ["from"], ["down"]))
        if gone or find_colour(word) or find_material(word) in materials or (word == "half" and _halved(it)):
            continue
        if not re.search(rf"\b{re.escape(word)}\b", it.quoted) and not (asked and word in DEEDS):
            start = at
            while start and find_colour(words[start - 1]) and start - 1 not in named:
                start -= 1
            made.append((at, f'not heard: "{" ".join(words[start : at + 1])}"'))
    return made


def _shapes(it: Compared) -> frozenset[str]:
    """Words for how things stand that the plan has."""
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    stacked = any(rel.kind == "on" and nouns[rel.child] == nouns.get(rel.parent) for rel in it.plan.relations)
    round_about = {one.kind for one in it.plan.arrangements} & {"circle", "around"}
    lying = any(one.kind == "on_its_side" for one in it.plan.postures)
    heaped = any(len(carriers_of(name, it.plan.relations)) > 1 for name in nouns)
    return (
        frozenset({"pyramid"} if heaped else ())
        | frozenset({"grid"} if crossing([one.objects for one in it.plan.arrangements if one.kind == "row"]) else ())
        | frozenset({"tower", "towers", "piles", "stacks"} if stacked else ())
        | frozenset({"tower", "pile"} if "stack:" in it.tasks else ())
        | frozenset({"circle", "ring"} if round_about else ())
        | frozenset({"flat", "tipped", "toppled", "fallen", "knocked"} if lying else ())
        | frozenset({"form", "forms"} if any(one.kind == "row" for one in it.plan.arrangements) else ())
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
