"""By what a phrase tells one object from others: its noun, its colour, its place."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.entities import Edge, Group, Item
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.number_words import ORDINALS
from pat3d.scene.relations import LateralKind

SAME = {"leftmost": "left", "rightmost": "right"}
PLACES = {**lexicon.POSITIONS, **lexicon.LEVELS}
ALONG = {"left": 0, "middle": 1, "center": 1, "centre": 1, "right": 2}
"""Places of likes from left to right."""
COUNTED = {**{word: at for at, word in enumerate(ORDINALS)}, "last": -1}
"""Places in the order in which things are named."""
OPPOSITE = {"left": "right", "right": "left", "front": "back", "back": "front"}
LATERAL_SIDES: dict[str, LateralKind] = {
    "left": "left_of",
    "right": "right_of",
    "front": "in_front_of",
    "back": "behind",
}


def colours_of(item: Item) -> tuple[str, ...]:
    """The colours of `item`, its own before those of its group."""
    return item.colours if item.colours is not None else item.group.modifiers.colours


def position(phrase: Phrase) -> str:
    """The place by which `phrase` tells its object from others of the kind ("left"), or nothing."""
    found = next((word for word in phrase.modifiers.adjectives if word in PLACES), "")
    return SAME.get(found, found) if phrase.definite else ""


def ranked(phrases: Sequence[Phrase]) -> bool:
    """Whether `phrases` tell likes by their places: a lamp "on the left and the right table" is one on each."""
    return len(phrases) > 1 and len({one.noun for one in phrases}) == 1 and all(map(position, phrases))


def is_numbered(phrase: Phrase) -> bool:
    """Whether `phrase` tells its object by the order of a list alone: "the last", "the second one", "... one red"."""
    where = position(phrase)
    words = phrase.words.lower().split()
    one = words[2:3] == ["one"] and all(is_colour_word(word) for word in words[3:])
    return where in COUNTED and words[:2] == ["the", where] and (len(words) == 2 or one)


def same_noun(group: Group, phrase: Phrase) -> bool:
    """Whether `phrase` names what `group` is."""
    if phrase.kind == "unknown":
        return group.phrase.kind == "unknown" and group.said.split()[-1] in (phrase.head, *singulars(phrase.head))
    return group.noun == phrase.noun if phrase.noun else bool(group.cycle) and {*group.cycle} == {*phrase.cycle}


def same_head(group: Group, phrase: Phrase) -> bool:
    """Whether "the ..." may call `group` by its last word: "bowl" for a fruit bowl, "loaf" for a loaf of bread."""
    wanted = {phrase.said or phrase.head, *singulars(phrase.said or phrase.head)}
    names = (group.said, group.noun) if not group.proxy else (group.said,)
    heads = {word for name in names for words in [name.split(" of ")] for word in words[0].split()[-1:]}
    # "The cake" of three slices of cake
    heads |= {name.split(" of ")[1] for name in names if name.split(" of ")[0] in lexicon.PORTIONS and " of " in name}
    return not group.cycle and bool(wanted & heads)


def same_word(group: Group, phrase: Phrase) -> bool:
    """Whether `group` was called by a word of `phrase` before."""
    return bool({phrase.said or phrase.head, *singulars(phrase.said or phrase.head)} & {*group.said.split()})


def line_up(world: World, placed: Item) -> None:
    """Relate the left one, the middle one and the right one of a kind to each other."""
    if placed.place not in ALONG:
        return
    for other in world.items():
        same = other.group.noun == placed.group.noun and not other.group.cycle
        known = any({edge.child, edge.parent} == {placed, other} for edge in world.laterals)
        if known or not same or other is placed:
            continue
        order = ALONG[placed.place] - ALONG.get(other.place, 1)
        if order and other.place in ("", *ALONG):
            world.laterals.append(Edge(child=placed, kind="left_of" if order < 0 else "right_of", parent=other))
