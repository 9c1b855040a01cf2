"""What is said of objects that are there: colours shared out among them, colours and sizes of a later remark."""

from __future__ import annotations

from dataclasses import replace

from pat3d.assets.colours import COLOURS
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.modifiers import COLOURED, Modifiers

_PUT_ON = frozenset({"bow", "ribbon", "scarf", "sticker", "label", "strap", "lace"})
"""Parts that are things of their own."""
LEAVES = frozenset({"leaf", "stem", "stalk"})
"""Parts that give no colour but to a plant or a tree: a vase with green leaves is none, nor is a rose."""


def share_colours(group: Group) -> None:
    """As many colours as objects, or three and more, are shared out among the objects."""
    named, palette = group.modifiers.colours, group.modifiers.palette
    count = len(group.items)
    in_turn = not group.counted or "alternating" in group.modifiers.adjectives
    # "Two turquoise-blue mugs": each is of both.
    mixed = any(len(COLOURS.keys() & {*word.split("-")}) > 1 for word in group.words.lower().split())
    if palette and count == 1 and not named:
        # "A colored mat" has one colour, which is not said.
        own = palette if group.modifiers.palette_word != COLOURED else ()
        group.modifiers = replace(group.modifiers, colours=own)
        return
    shared = palette or (
        named
        if count > 1 and not mixed and (len(named) == count or len(named) >= 3 or (len(named) == 2 and in_turn))
        else ()
    )
    for index, item in enumerate(group.items):
        item.colours = (shared[index % len(shared)],) if shared else item.colours


def _inherited(group: Group) -> bool:
    """Whether `group` is one more of a kind, and its colour is that of those before: "two red cups, a third one"."""
    words = group.words.lower().split()
    return words[-1:] in (["one"], ["another"]) and not any(word in COLOURS for word in words)


def describe(group: Group, told: Modifiers, part: str = "") -> None:
    """Give `group` what a later remark says of it: "is wooden", or of its `part`: "with red covers".

    The colour of a part that shows little ("a mug with a blue handle") is not the object's main colour, and that of
    what is only put on it ("a white dog with orange bows") is none of its colours.
    """
    own = group.modifiers
    colours = (*told.colours, *told.palette[: 1 if len(group.items) > 1 else None])
    if told.colours and not part and _inherited(group):
        own = replace(own, colours=())
    adjectives = told.adjectives
    if part and part not in lexicon.MAIN_PARTS and (not own.colours or part in _PUT_ON):
        adjectives, colours = (*adjectives, *(f"{colour}-{part}" for colour in colours)), ()
    group.modifiers = replace(
        own.marked_as(told),
        colours=tuple(dict.fromkeys((*own.colours, *colours))),
        material=own.material or (told.material if not part else None),
        adjectives=(*own.adjectives, *adjectives),
    )


def tell(item: Item, told: Modifiers) -> None:
    """Give one object the colour and the size by which the prompt tells it from its like."""
    if told.colours and item.colours is None and not item.group.modifiers.colours:
        item.colours = told.colours
    size = told.size_word if not item.told.size_word else item.told.size_word
    kept = replace(item.told, size_word=size, scale=told.scale if told.size_word else item.told.scale)
    item.told = kept.marked_as(told)
