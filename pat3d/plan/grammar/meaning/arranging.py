"""Which of the arrangements that a prompt asks for the scene is to hold; a note names every other one."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise, product

from pat3d.plan.grammar.meaning import covers
from pat3d.plan.grammar.meaning.entities import Arranged, Edge, Group, Item
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.shapes import carriers_in_pyramid
from pat3d.scene.arrangements import ARRANGEMENTS, LINES, TIERS
from pat3d.scene.relations import Relation, RelationKind

_SHARED: dict[str, RelationKind] = {"far_from": "next_to", "under": "next_to", "circle": "around"}
"""Kinds that have both on the same support as this relation does, and no lateral relation that says so: a circle
around several."""


_LIES = re.compile(r"\b(?:lying|lies?|laid|lay|flat|scattered|strewn)\b", re.IGNORECASE)
"""What is said where books do not stand."""
_ROW = 12
"""Books in one row at most, where nobody says how many."""


def together(world: World) -> list[Edge]:
    """What stands on the same surface because of an arrangement, as lateral relations of `world`.

    What is under something may stand on a dish with it.
    """
    arranged = [
        Edge(child=child, kind=_SHARED[each.kind], parent=parent, weak=each.kind == "under")
        for each in world.arranged
        if each.kind in _SHARED and (each.kind != "circle" or len(each.of) > 1)
        for child, parent in _pairs(each)
    ]
    return [*arranged, *_left_over(world)]


def _left_over(world: World) -> list[Edge]:
    """Of "two cups on a table next to three plates" the third plate beside the other two, as lateral relations."""
    beside = {edge.parent for edge in world.laterals if edge.kind == "next_to"}
    told = {item for edge in world.laterals for item in (edge.child, edge.parent)}
    made: list[Edge] = []
    for group in world.groups:
        first = next((item for item in group.items if item in beside), None)
        rest = [item for item in group.items if item not in told]
        if first is not None and rest and len(beside & {*group.items}) > 1:
            made += [Edge(child=item, kind="next_to", parent=first, weak=True) for item in rest]
    return made


def _pairs(each: Arranged) -> Iterable[tuple[Item, Item]]:
    """Of "a plate under each cup" every plate with its own cup, else all with all."""
    own = each.kind == "under" and len(each.items) == len(each.of)
    return zip(each.items, each.of, strict=True) if own else product(each.items, each.of)


def settle(world: World, prompt: str) -> None:
    """Mark what the scene is to hold, now that it is known what carries what; note what it is not."""
    for group in world.groups:
        if group.pyramid:
            _heap_up(world, group)
        if group.rows:
            _line_up(world, group)
        elif _LIES.search(prompt) is None and _may_line_up(world, group):
            rows = -(-len(group.items) // _ROW)
            for at in range(rows):
                world.arrange("row", group.items[len(group.items) * at // rows : len(group.items) * (at + 1) // rows])
    ringed = [{*each.items} for each in world.arranged if each.kind == "circle" and each.of]
    world.arranged = [
        each for each in world.arranged if each.kind != "circle" or each.of or {*each.items} not in ringed
    ]
    world.arranged = [one for each in world.arranged for one in _one_by_one(world, each)]
    for each in world.arranged:
        if each.kind in LINES:
            # Of stacks in a row the lowest stand in it.
            each.items = world.bases(each.items)
        if each.kind == "in_middle" and not each.of:
            carrier = world.support(each.items[0])
            each.of = [] if carrier is None else [carrier]
        if not each.otherwise:
            continue
        each.arranged = each.exact and (_spans(world, each) if each.kind == "across" else _holds(world, each))
        if not each.arranged:
            world.note(f"not arranged: {each.otherwise}")
            if each.kind == "under":
                world.beside(each.items, "next_to", each.of)


def _one_by_one(world: World, each: Arranged) -> list[Arranged]:
    """`each`, or where several lean on furniture, which is wide enough for them, that each of them does."""
    if each.kind != "leaning_against" or len(each.items) < 2 or not (each.of and world.on_floor(each.of[0])):
        return [each]
    return [replace(each, items=[item]) for item in each.items]


def in_order(world: World, row: Sequence[Item]) -> None:
    """Let the objects of a row stand in the order of `row` from left to right."""
    own, group = set(row), row[0].group
    for each in world.arranged:
        if each.kind in LINES and set(each.items) == own:
            each.items = list(row)
    world.laterals = [
        edge
        for edge in world.laterals
        if not ({edge.child, edge.parent} <= own and edge.kind in ("left_of", "right_of"))
    ]
    if set(group.items) == own and not group.cycle:
        group.items = list(row)
    else:
        for left, right in pairwise(row):
            world.beside([left], "left_of", [right])


def rows_of(world: World, group: Group) -> list[list[Item]]:
    """The rows that the objects of `group` stand in, the first in front, each from left to right."""
    own = world.bases(group.items)
    length = -(-len(own) // group.rows) if group.rows else len(own)
    return [own[at : at + length] for at in range(0, len(own), length)]


def shelved(world: World, item: Item) -> bool:
    """Whether `item` stands upright because people have its like so: books in a row on a shelf."""
    carrier, edges = world.support(item), world.supports.values()
    if carrier is None or not (world.is_a(item, lexicon.BOUND) and world.is_a(carrier, lexicon.SHELVES)):
        return False
    leans = any(each.kind == "leaning_against" and item in each.items for each in world.arranged)
    row = any(each.kind in LINES and each.arranged and item in each.items for each in world.arranged)
    return row and not leans and item.group.height == 1 and all(edge.parent is not item for edge in edges)


def _may_line_up(world: World, group: Group) -> bool:
    """Whether `group` are books on a shelf of which nothing else is said, so that they stand in rows there."""
    carriers = {world.support(item) for item in group.items}
    carrier = carriers.pop() if len(carriers) == 1 else None
    if carrier is None or len(group.items) < 3 or group.height > 1 or group.heap or group.pyramid:
        return False
    own = {*group.items}
    placed = [{edge.child, edge.parent} for edge in world.laterals]
    placed += [{*each.items, *each.of} for each in world.arranged if each.kind not in TIERS]
    placed += [{*each.items} for each in world.sided]
    told = any(own & each for each in placed)
    lies = group.modifiers.postures or any(item.told.postures for item in own)
    carries = any(edge.parent in own for edge in world.supports.values())
    bound = all(world.is_a(item, lexicon.BOUND) for item in own) and world.is_a(carrier, lexicon.SHELVES)
    return bound and not (told or lies or carries)


def further_carriers(world: World, names: dict[Item, str]) -> list[Relation]:
    """The carriers, beyond the first, of what lies across several."""
    return [
        Relation(child=names[child], kind="on", parent=names[parent])
        for each in world.arranged
        if each.kind == "across" and each.arranged
        for child in world.bases(each.items)
        for parent in each.of
        if parent is not world.support(child)
    ]


def _heap_up(world: World, group: Group) -> None:
    """Arrange a pyramid: the lowest side by side, every other one across two neighbours below it."""
    lowest, items = group.lowest, group.items
    if not lowest:
        world.note(f'not arranged: "{group.words}" in a pyramid, which {len(items)} do not make')
        return
    world.arrange("side_by_side", items[:lowest])
    for left, right in zip(items, items[1:lowest], strict=False):
        world.beside([left], "left_of", [right])
    for at in range(lowest, len(items)):
        world.arrange("across", [items[at]], [items[below] for below in carriers_in_pyramid(at, lowest)])


def _line_up(world: World, group: Group) -> None:
    """Arrange every row of `group`, and where there are several every column from front to back."""
    rows = rows_of(world, group)
    columns = [[row[at] for row in rows if at < len(row)] for at in range(len(rows[0]))] if len(rows) > 1 else []
    known = [{*world.bases(each.items)} for each in world.arranged if each.kind in LINES]
    for line in (*rows, *columns):
        if len(line) > 1 and {*line} not in known:
            world.arrange("row", line, (), f'"{group.words}" in a row')


def _takes(each: Arranged) -> bool:
    rule = ARRANGEMENTS.get(each.kind)
    if rule is None or not rule.takes(len(each.items), len(each.of)) or set(each.items) & set(each.of):
        return False
    alone = {"facing": len(each.items) == 2, "far_from": len(each.items) > 1}
    return (each.kind != "between" or len(each.of) < 3 or len(each.items) == 1) and (
        bool(each.of) or alone.get(each.kind, True)
    )


def _holds(world: World, each: Arranged) -> bool:
    """Whether a scene can say `each`: so many objects, on what is to carry them, and not on one another."""
    if not _takes(each):
        return False
    if ARRANGEMENTS[each.kind].on_it:
        edges = [world.supports.get(item) for item in each.items]
        level = world.likely.level(world.noun(each.of[0]))
        return level and all(edge is not None and edge.kind == "on" and edge.parent is each.of[0] for edge in edges)
    stack = each.kind == "leaning_against" and each.of[0].group.height > 1
    everything = {*each.items, *(world.bases(each.of) if stack else each.of)}
    if each.kind == "leaning_against" and len(everything) > 2:
        return False
    supports = {world.support(item) for item in everything}
    kinds = {edge.kind for item in everything if (edge := world.supports.get(item)) is not None}
    if each.kind == "circle" and len(each.of) > 1 and len(supports) > 1:
        return False
    if each.kind in ("leaning_against", "under") and (len(supports) > 1 or kinds - {"on"}):
        return False
    over = each.kind != "under" or world.is_a(each.of[0], lexicon.OVERHANGING)
    if not over and not covers.stands_over(world, each.of[0], each.items):
        return False
    if not _moved_apart(world, everything):
        return False
    within = len(supports) == 1 and "in" in kinds
    return not within and not any(everything & set(world.ancestors(item)) for item in everything)


def _moved_apart(world: World, items: set[Item]) -> bool:
    """Whether on the surface that `items` have in common each of them is, or is on, a thing of its own."""
    chains = [[item, *world.ancestors(item)] for item in items]
    shared = next((one for one in chains[0] if all(one in chain for chain in chains)), None)
    moved = {chain[-1] if shared is None else chain[max(chain.index(shared) - 1, 0)] for chain in chains}
    return len(moved) == len(chains)


def _spans(world: World, each: Arranged) -> bool:
    """Whether one thing can lie on all of the others: they are alike and stand on one surface."""
    alike = len({item.group.noun for item in each.of}) == 1 and len({world.support(item) for item in each.of}) == 1
    edges = [world.supports.get(item) for item in world.bases(each.items)]
    return alike and all(edge is not None and edge.kind == "on" and edge.parent in each.of for edge in edges)
