"""Vessels upside down over what they cover: a bowl over a dice stands around it, not on it.

Whether something fits is judged by the outer sizes that the catalogue ships: walls and tapers take their share.
"""

from __future__ import annotations

from pat3d.plan.grammar.meaning.entities import Edge, Item
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import vessels
from pat3d.plan.grammar.words.modifiers import read_modifiers
from pat3d.plan.grammar.words.postures import is_held, kind_of, token_text
from pat3d.plan.grammar.words.sizes import extents

_HIGH = 0.75
"""Height of what fits over the vessel's."""
_WIDE = 0.56
"""Longer side of what fits, seen from above, over the vessel's smaller side; of several, all side by side."""


def may_cover(world: World, vessel: Item, item: Item, *, beside: int = 1) -> bool:
    """Whether `vessel` may be upside down over `item`: it is open, the other has room in it, and nothing else is said.

    There are `beside` like it side by side.

    What has another size than the catalogue's is taken for its like.
    """
    said = (*vessel.group.modifiers.postures, *vessel.told.postures)
    other = any(kind_of(posture) != "upside_down" or not is_held(posture, lies=False) for posture in said)
    if other or not world.is_a(vessel, vessels.COVERS) or world.is_table(item):
        return False
    outer, inner = (extents(world.noun(each)) for each in (vessel, item))
    if len(outer) != 3 or len(inner) != 3:
        return False
    ratio = _ratio(item) / _ratio(vessel)
    return inner[2] * ratio <= _HIGH * outer[2] and beside * max(inner[:2]) * ratio <= _WIDE * min(outer[:2])


def stands_over(world: World, vessel: Item, items: list[Item]) -> bool:
    """Whether `vessel` covers `items`, which are under it; it is upside down then."""
    free = all(edge.parent is not vessel or edge.child in items for edge in world.supports.values())
    if not free or not all(may_cover(world, vessel, item, beside=len(items)) for item in items):
        return False
    _turn_over(world, vessel)
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
        if not world.is_a(child, vessels.COVERS) or world.likely.level(noun) or world.likely.hollow(noun):
            continue
        several = sum(one is child for one, _ in wished) > max(1, sum(other is below for _, other in wished))
        if not several and (child, below) in wished and not _together(world, child, below):
            continue
        _stand_beside(world, child, below)
        said = f'"{child.group.words}" over "{below.group.words}"'
        things = _said_under(world, child, below)
        if not several and all(may_cover(world, child, one, beside=len(things)) for one in things):
            _turn_over(world, child)
            world.arrange("under", things, [child], said)
        else:
            world.note(f"not arranged: {said}; it is placed next to it")
            world.beside([child], "next_to", [below])


def _said_under(world: World, vessel: Item, below: Item) -> list[Item]:
    """`below`, with what is said to be under `vessel` along with it; that it is on these is no longer held."""
    said = [each for each in world.arranged if each.kind == "under" and each.of == [vessel] and below in each.items]
    world.arranged = [each for each in world.arranged if each not in said]
    return list(dict.fromkeys(item for each in said for item in each.items)) or [below]


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


def _turn_over(world: World, item: Item) -> None:
    if not _turned_over(item) and not world.is_a(item, vessels.OPEN_BELOW):
        item.told = item.told.marked_as(read_modifiers([token_text("upside down")]))


def _ratio(item: Item) -> float:
    """Factor on the size of `item` that its size word asks for."""
    return item.group.modifiers.scale * item.told.scale
