"""Vessels upside down over what they cover: a bowl over a dice stands around it, not on it.

Whether something fits is judged by the outer sizes that the catalogue ships: walls and tapers take their share.
"""

from __future__ import annotations

import math

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.modifiers import read_modifiers
from pat3d.plan.grammar.postures import is_held, kind_of, token_text
from pat3d.plan.grammar.sizes import extents
from pat3d.plan.grammar.world import Edge, Item, World

_HIGH = 0.75
"""Height of what fits over the vessel's."""
_WIDE, _NARROW = 0.65, 0.5
"""Diagonal of what fits, seen from above, over the vessel's smaller side."""


def may_cover(world: World, vessel: Item, item: Item) -> bool:
    """Whether `vessel` may be upside down over `item`: it is open, the other has room in it, and nothing else is said.

    What has another size than the catalogue's is taken for its like.
    """
    said = (*vessel.group.modifiers.postures, *vessel.told.postures)
    other = any(kind_of(posture) != "upside_down" or not is_held(posture, lies=False) for posture in said)
    if other or not world.is_a(vessel, lexicon.COVERS) or world.is_table(item):
        return False
    outer, inner = (extents(world.noun(each)) for each in (vessel, item))
    if len(outer) != 3 or len(inner) != 3:
        return False
    ratio = _ratio(item) / _ratio(vessel)
    share = _NARROW if world.is_a(vessel, lexicon.NARROW) else _WIDE
    low = inner[2] * ratio <= _HIGH * outer[2]
    return low and math.hypot(*inner[:2]) * ratio <= share * min(outer[:2])


def stands_over(world: World, vessel: Item, item: Item) -> bool:
    """Whether `vessel` covers `item`, which is under it; it is upside down then."""
    free = all(edge.parent is not vessel or edge.child is item for edge in world.supports.values())
    if not free or not may_cover(world, vessel, item):
        return False
    _turn_over(vessel)
    return True


def settle(world: World) -> None:
    """Stand what is over something, or upside down on what carries nothing, around it, where it has room."""
    wished = [pair for pair in dict.fromkeys(world.over) if set(pair) <= set(world.items())]
    turned = [
        (edge.child, edge.parent)
        for edge in world.supports.values()
        if edge.kind == "on"
        and _turned_over(edge.child)
        and world.likely.on(world.noun(edge.child), world.noun(edge.parent)) >= 1.0
    ]
    for child, below in dict.fromkeys((*wished, *turned)):
        noun = world.noun(below)
        if not world.is_a(child, lexicon.COVERS) or world.likely.level(noun) or world.likely.hollow(noun):
            continue
        several = sum(one is child for one, _ in wished) > max(1, sum(other is below for _, other in wished))
        if not several and (child, below) in wished and not _together(world, child, below):
            continue
        _stand_beside(world, child, below)
        said = f'"{child.group.words}" over "{below.group.words}"'
        if not several and may_cover(world, child, below):
            _turn_over(child)
            world.arrange("under", [below], [child], said)
        else:
            world.note(f"not arranged: {said}; it is placed next to it")
            world.beside([child], "next_to", [below])


def _together(world: World, child: Item, below: Item) -> bool:
    """Whether `child` is on `below`, or where that is."""
    return world.support(child) in (below, world.support(below))


def _stand_beside(world: World, child: Item, below: Item) -> None:
    """Let `child` stand where `below` does instead of on it."""
    if world.support(child) is not below:
        return
    carrier = world.supports.get(below)
    del world.supports[child]
    if carrier is not None:
        world.supports[child] = Edge(child=child, kind=carrier.kind, parent=carrier.parent, weak=carrier.weak)
    hardly = f'"{child.group.words}" on "{below.group.words}": it hardly stays there.'
    world.notes = [note for note in world.notes if note != hardly]


def _turned_over(item: Item) -> bool:
    said = (*item.group.modifiers.postures, *item.told.postures)
    return any(kind_of(posture) == "upside_down" for posture in said)


def _turn_over(item: Item) -> None:
    if not _turned_over(item):
        item.told = item.told.marked_as(read_modifiers([token_text("upside down")]))


def _ratio(item: Item) -> float:
    """Factor on the size of `item` that its size word asks for."""
    return item.group.modifiers.scale * item.told.scale
