"""Forms of one reading: "in a row", "stacked", "in a circle"."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.meaning import arranging
from pat3d.plan.grammar.meaning.counting import recount
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.had import Having
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.references import References
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words.shapes import grid_rows

_ABREAST = frozenset({"beside", "side_by_side"})
"""Forms in which the tasks of two things put one beside the other."""


class Forming:
    """Arranges the objects of one sentence as a whole."""

    def __init__(self, world: World, chunks: Sequence[Chunk], maker: Maker) -> None:
        self._world = world
        self._chunks = chunks
        self._maker = maker
        self._relating = Having(world)
        self._said = References(world, chunks, maker, self._relating)
        self._landmarks: dict[int, tuple[list[Item], bool]] = {}
        """What the sentence has said a side of, by the relation that says it."""
        self._abreast: list[Item] = []
        """What is to be put next to each other."""

    def _stand_abreast(self, at: int, heads: Sequence[int]) -> bool:
        """Whether chunk `at` says that what `heads` mean is to be put next to each other, which is kept.

        "Move the toys to the couch with the cushions. Place them next to each other" is of what was moved.
        """
        told = self._said.refs_of(heads) if self._chunks[at].text in _ABREAST else []
        moved = {item for step in self._world.steps for item in step.items}
        pronoun = any(self._chunks[head].named.kind == "pronoun" for head in heads)
        self._abreast = told if not (pronoun and moved) or moved & {*told} else []
        return len(self._abreast) > 1

    def _formed(self, at: int, heads: Sequence[int]) -> None:
        chunk = self._chunks[at]
        world = self._world
        told = self._said.refs_of(heads)
        groups = list(dict.fromkeys(item.group for item in told))
        if chunk.text == "stack" and len(told) == 1 < len(groups[0].items) and self._chunks[at + 1 : at + 2]:
            # "Three cubes ... The green one is stacked on the red one": the blue one is on neither.
            return
        if not groups:
            world.note(f'"{chunk.text}": of what is not said.')
            return
        whole = groups[0] if len(groups) == 1 and len(groups[0].items) > 1 else None
        items = [item for group in groups for item in group.items]
        if whole is not None and (some := self._some_of(whole, heads)):
            whole, items = None, some
            if chunk.text in ("stack", "tower"):
                for lower, upper in zip(some, some[1:], strict=False):
                    world.place([upper], "on", [lower])
                return
            if chunk.text in ("row", "side_by_side"):
                world.arrange(chunk.text, some)
                return
        if chunk.text in ("rows", "stacks"):
            plural = next((group for group in groups if len(group.items) > 1), None)
            if plural is None:
                world.note(f'"{chunk.size} {chunk.text}": of what is not said.')
                return
            before = set(plural.items)
            recount(world, plural, chunk.size * chunk.each)
            for head, items in self._said.known.items():
                if set(items) == before:
                    self._said.known[head] = list(plural.items)
            if chunk.text == "rows":
                plural.rows = chunk.size or grid_rows(len(plural.items))
            else:
                plural.height = -(-len(plural.items) // chunk.size)
        elif chunk.text in ("stack", "tower"):
            self._stacked(groups, tall=whole is not None or chunk.text == "tower")
        elif chunk.text == "chain" and chunk.link is not None:
            for one, other in zip(items, items[1:], strict=False):
                world.beside([other], chunk.link.kind, [one])  # type: ignore[arg-type]
        elif chunk.link is not None and chunk.text != "beside":
            kind = chunk.link.says or "far_from"
            world.arrange(kind, items, (), f'"{groups[0].words}" {chunk.text.replace("_", " ")} each other')
        elif chunk.text == "circle":
            world.arrange("circle", items, self._ringed(items), f'"{groups[0].words}" in a circle')
        elif chunk.text == "beside":
            for left, right in zip(items, items[1:], strict=False):
                world.beside([right], "next_to", [left])
        elif whole is not None:
            whole.rows = 1
            world.arrange("side_by_side" if chunk.text == "side_by_side" else "row", items)
        elif chunk.text == "side_by_side":
            world.arrange("side_by_side", items)
            for left, right in zip(items, items[1:], strict=False):
                world.beside([right], "next_to", [left])
        else:
            standing = self._standing(items)
            ordered = standing[::-1] if chunk.text == "reverse" else standing
            if any(each.kind == "row" and set(each.items) == set(standing) for each in world.arranged):
                # "In a row from right to left"
                arranging.in_order(world, ordered)
                return
            world.arrange("row", ordered)
            for left, right in zip(ordered, ordered[1:], strict=False):
                world.beside([left], "left_of", [right])

    def _standing(self, items: Sequence[Item]) -> list[Item]:
        """`items`, or what alone carries one of them: "a pen in a cup, a bowl and a jar in a row" has the cup in it."""
        made: list[Item] = []
        for item in items:
            shared = {self._world.support(other) for other in items if other.group is not item.group} | {*items}
            while (below := self._world.support(item)) is not None and below not in shared:
                item = below
            made.append(item)
        return list(dict.fromkeys(made))

    def _some_of(self, whole: Group, heads: Sequence[int]) -> list[Item]:
        """The members of `whole` that `heads` speak of, where those are several and not all: "the red ones"."""
        some = [item for item in whole.items if item in self._said.refs_of(heads)]
        return some if 1 < len(some) < len(whole.items) and whole.height == 1 else []

    def _ringed(self, items: Sequence[Item]) -> list[Item]:
        """What all of `items` are around, if there is one such thing."""
        around = {
            item: edge.parent for edge in self._world.laterals for item in items
            if edge.kind == "around" and edge.child is item
        }  # fmt: skip
        return list(set(around.values())) if len(around) == len(items) and len(set(around.values())) == 1 else []

    def _stacked(self, groups: list[Group], *, tall: bool) -> None:
        """Put each of `groups` on the one before, or where they are several objects each on one another."""
        for group in groups:
            if group.height == 1 and (tall or all(len(each.items) > 1 for each in groups)):
                group.height = len(group.items)
                self._off_the_ground(group.items[0], group.items[1:])
        if tall or any(len(each.items) == 1 for each in groups):
            for lower, upper in zip(groups, groups[1:], strict=False):
                self._off_the_ground(groups[0].items[0], upper.items)
                self._world.place(upper.items, "on", lower.items)

    def _off_the_ground(self, lowest: Item, upper: Sequence[Item]) -> None:
        """Let `upper`, which are stacked on `lowest`, no longer stand on what that stands on."""
        supports, below = self._world.supports, self._world.supports.get(lowest)
        for item in upper:
            own = supports.get(item)
            if own is not None and below is not None and own.parent is below.parent:
                del supports[item]
