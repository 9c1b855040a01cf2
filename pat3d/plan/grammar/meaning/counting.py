"""How many objects a group has once more is said of it: counted anew, once for each of several, by its colours."""

from __future__ import annotations

from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar.meaning.described import share_colours
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.world import MAX_OBJECTS, World
from pat3d.plan.grammar.words.modifiers import Modifiers


def check_total(world: World) -> None:
    """Raises: PromptError: there are too many objects."""
    total = len(world.items())
    if total > MAX_OBJECTS:
        raise PromptError(
            f'the prompt asks for {total} objects by "{world.groups[-1].words[:60]}"; a scene holds at most '
            f"{MAX_OBJECTS}. Ask for fewer."
        )


def recount(world: World, group: Group, count: int) -> None:
    """`group` has `count` objects (0: nothing new is said): "in three rows of four".

    Raises:
        PromptError: the prompt has given another number, or there would be too many.
    """
    if group.exact and count not in (0, len(group.items)):
        raise PromptError(f'"{group.words}" are {len(group.items)} objects and cannot stand as {count}.')
    if count:
        group.items = [*group.items, *(Item(group=group) for _ in range(count - len(group.items)))][:count]
        forget_count(world, group)
        share_colours(group)
        check_total(world)


def multiply(world: World, items: list[Item], factor: int) -> list[Item]:
    """`items`, whole groups, once for each of `factor` objects."""
    if factor < 2:
        return items
    for group in dict.fromkeys(item.group for item in items):
        before = list(group.items)
        group.items += [Item(group=group) for _ in range(len(group.items) * (factor - 1))]
        group.multiplied = True
        share_colours(group)
        below = world.supports.get(before[0]) if len(before) == 1 else None
        if below is not None:
            # "Three mugs, each on a coaster, on a tray": all coasters are on the tray.
            world.place(group.items[1:], below.kind, [below.parent], weak=True)
        carried = [edge for edge in world.supports.values() if edge.parent in before and len(before) == 1]
        for own in dict.fromkeys(edge.child.group for edge in carried if not edge.child.group.phrase.definite):
            # "On each side of a bed a nightstand with a lamp": a lamp on each.
            edges = [edge for edge in carried if edge.child.group is own]
            if len(edges) == len(own.items):
                more = multiply(world, list(own.items), factor)[len(edges) :]
                world.place(more, edges[0].kind, group.items[len(before) :], edges[0].weak)
    check_total(world)
    return [each for group in dict.fromkeys(item.group for item in items) for each in group.items]


def on_each_side(world: World, items: list[Item], *, each: bool) -> list[Item]:
    """What stands left and right of something where `items` do, on `each` side as many where it is said so."""
    group = items[0].group
    if len(items) == 1:
        return list(group.items) if len(group.items) == 2 else multiply(world, items, 2)
    if group.phrase.definite or group in world.groups[: world.settled] or not each or items != group.items:
        return items
    world.note(f'"{group.words}": as many on each side, {2 * len(items)} in all.')
    return multiply(world, items, 2)


def forget_count(world: World, group: Group) -> None:
    """The number of `group` is not assumed any more."""
    world.notes = [note for note in world.notes if not note.startswith(f'"{group.words}": ')]


def tell_colours(world: World, group: Group, told: Modifiers) -> None:
    """Read "blocks, featuring red, blue and green pieces"."""
    shared = told.palette or told.colours
    group.modifiers = group.modifiers.marked_as(told)
    count = len(group.items)
    coloured = (
        count > 1
        and not group.modifiers.palette
        and all(item.colours or group.modifiers.colours for item in group.items)
    )
    if not shared or coloured:
        # "Four red and four blue blocks: sort the blocks by colour": they have theirs.
        return
    if count == 1:
        group.modifiers = replace(group.modifiers, colours=(*group.modifiers.colours, *shared))
        return
    if not group.counted:
        tall = group.height == count
        wanted = max(len(shared), count if told.palette else len(shared))
        group.items = [*group.items, *(Item(group=group) for _ in range(wanted - count))][:wanted]
        group.height = wanted if tall else group.height
        forget_count(world, group)
        check_total(world)
    for index, item in enumerate(group.items):
        item.colours = (shared[index % len(shared)],)
