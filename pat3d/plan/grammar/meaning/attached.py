"""Places that may be said of a thing or of what it is on: "a cup on a tray next to a bowl".

The bowl is next to the tray, or next to the cup and then on the tray as well.
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunking.plausible import LARGE
from pat3d.plan.grammar.meaning.entities import Edge, Item
from pat3d.plan.grammar.meaning.world import UNUSUAL, World
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.sizes import too_large

_BORNE = 1.2
"""Cost of being on something, see Plausible.on, at which what is above that may rest on it."""
_REACHING = ("tree", "rod", "lamp", "floor lamp", "faucet", "umbrella", "monitor", "tv", "clock", "mirror",
             "picture frame", "shelf")  # fmt: skip
"""What is above other things without resting on them."""
_TABLES = ("table", "coffee table", "side table", "counter", "kitchen island")
"""What is laid for a meal."""
_FOR_ONE = ("tripod", "easel", "coaster", "saucer", "candlestick")
"""What carries one thing, and what is slender besides."""


def attached_higher(other: World, first: World) -> bool:
    """Whether `other` says of what is on something the place that `first` says of that; its landmark is put there too.

    Not where nothing else would stand there: what is on a saucer, or on what is too small, is where that is.
    """
    mine, theirs = other.items(), first.items()
    ours, lower = _moved(other, first), _moved(first, other)
    if len(mine) != len(theirs) or not ours or len(lower) != 1:
        return False
    said = {(edge.kind, mine.index(edge.parent)) for edge in ours}
    below = mine[theirs.index(lower[0].child)]
    held = [other.supports.get(edge.child) for edge in ours]
    carried = all(edge is not None and edge.kind == "on" and edge.parent is below for edge in held)
    landmark = mine[theirs.index(lower[0].parent)]
    if said != {(lower[0].kind, mine.index(landmark))} or not carried or not has_room(other, below, landmark):
        return False
    other.place([landmark], "on", [below])
    return True


def has_room(world: World, below: Item, landmark: Item) -> bool:
    """Whether `landmark`, which stands nowhere yet, may stand on top of `below` beside something else."""
    level = world.likely.level(world.noun(below)) and not world.is_a(below, lexicon.BENEATH_CUPS)
    return level and fits(world, below, landmark)


def fits(world: World, below: Item, landmark: Item) -> bool:
    """Whether `landmark`, which stands nowhere yet, may be on `below`, or in it where that is hollow."""
    noun, carrier = world.noun(landmark), world.noun(below)
    known = landmark.group in world.groups[: world.settled]
    free = world.support(landmark) is None and not known and not world.on_floor(landmark)
    kind = world.containment(below)
    cost = world.likely.held(noun, kind, carrier)
    room = landmark is not below and (kind == "in" or world.likely.level(carrier)) and not too_large(noun, carrier)
    return free and room and cost < UNUSUAL


def beside_each_other(world: World, below: Item, marks: Sequence[Item]) -> bool:
    """Whether `marks`, which stand nowhere yet, may stand beside `below`."""
    return all(
        world.support(mark) is None and world.likely.beside(world.noun(below), world.noun(mark)) < UNUSUAL
        for mark in marks
    )


def lids_beside(world: World, children: Sequence[Item], vessel: Item) -> None:
    """Put the lids among `children`, which are beside the `vessel` that they close, on what that stands on."""
    edge = world.supports.get(vessel)
    free = [item for item in children if world.closes([item], vessel) and world.support(item) is None]
    if free and edge is not None and edge.kind == "on":
        world.place(free, "on", [edge.parent], weak=True)


def bears(world: World, below: Item, above: Item) -> bool:
    """Whether what is said to be above `below` is on it, and neither hangs nor reaches over it."""
    noun, load = world.noun(below), world.noun(above)
    solid = not world.likely.hollow(noun) and not world.on_floor(below)
    stays = solid and world.likely.on(load, noun) <= _BORNE and not world.is_a(above, _REACHING)
    return world.is_a(below, lexicon.STACKABLE) or (stays and not world.is_a(above, ("arch",)))


def crowding(world: World, children: Sequence[Item], parent: Item) -> float:
    """What it costs that `children` are on `parent`: of "a lamp, a cup and a phone on a tripod" the phone alone is."""
    broad = {item.group for item in children if not world.is_a(item, vessels.SLENDER)}
    return 1.5 if len(broad) > 1 and world.is_a(parent, _FOR_ONE) else 0.0


def with_its_carrier(world: World, children: list[Item], parents: Sequence[Item]) -> list[Item]:
    """What is on both sides of `parents` with `children`: of "a nightstand with a lamp on each side" that itself."""
    edge = world.supports.get(children[0]) if len(children) == 1 and world.on_floor(parents[0]) else None
    if edge is None or not edge.weak or {edge.parent, *world.ancestors(edge.parent)} & {*parents}:
        return children
    return [edge.parent] if world.on_floor(edge.parent) else children


def slip_under(world: World, children: Sequence[Item], parents: Sequence[Item]) -> None:
    """Let `children`, which are under `parents`, stand where those stood: "a cup on a table, a tray under it"."""
    edges = [edge for parent in parents if (edge := world.supports.get(parent)) and edge.kind == "on" and not edge.weak]
    below = {edge.parent for edge in edges}
    free = all(world.support(child) in (None, *below) for child in children) and not below & {*children}
    if free and len(below) == 1 and len(edges) == len(parents):
        for parent in parents:
            del world.supports[parent]
        world.place([*children], "on", [*below])


def put_carriers(world: World, named: Sequence[Item], table: Item) -> None:
    """Put on `table` what carries one of `named` and stands nowhere: the saucer of a cup."""
    for item in named if world.support(table) is None else ():
        path = [item, *world.ancestors(item)]
        lowest = path[-1]
        edges = [world.supports[each] for each in path if each in world.supports]
        placed = bool({*path, *lowest.group.items} & world.grounded) or world.on_floor(lowest) or lowest is table
        soft = world.is_a(lowest, ("mat", "pillow", "cushion"))
        beside = any({edge.child, edge.parent} & {*path} and table in (edge.child, edge.parent)
                     for edge in world.laterals)  # fmt: skip
        carried = bool(edges) and all(edge.kind == "on" and not edge.weak for edge in edges)
        if carried and not (placed or soft or beside):
            world.place([lowest], "on", [table], weak=True)


def lay_table(world: World) -> None:
    """Put what is named behind a table on it: "a table, a runner and two candles", "a desk and three monitors"."""
    items = world.items()
    taken = {item for edge in world.laterals for item in (edge.child, edge.parent)} | world.grounded | world.floored
    taken |= {*world.supports, *(item for each in world.arranged for item in each.items)}
    for names in (_TABLES, ("desk",)):
        tables = [item for item in items if world.is_a(item, names)]
        free = [item for item in items[items.index(tables[0]) :] if item not in taken] if len(tables) == 1 else []
        laid = (at for at, one in enumerate(free) if lexicon.LAID & {one.group.said, *singulars(one.group.said)})
        first = next(laid, len(free)) if names is _TABLES else 0
        for item in free[first:]:
            device = names is _TABLES or world.is_a(item, (*lexicon.DEVICES, "computer mouse"))
            if device and not (world.on_floor(item) or world.is_a(item, LARGE)):
                world.place([item], "on", tables, weak=True)
                world.note(f'assumed: "{item.group.words}" on "{tables[0].group.words}"')


def _moved(world: World, than: World) -> Sequence[Edge]:
    """The lateral relations of `world` that are none of `than`."""
    known = {_by_number(than, edge) for edge in than.laterals}
    return [edge for edge in world.laterals if None not in (said := _by_number(world, edge)) and said not in known]


def _by_number(world: World, edge: Edge) -> tuple[int | None, str, int | None]:
    number = {item: at for at, item in enumerate(world.items())}
    return number.get(edge.child), edge.kind, number.get(edge.parent)
