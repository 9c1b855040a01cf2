"""What something has, in one reading: "a desk with a lamp", "each plate holds an apple"; what is put side by side."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.meaning.distribution import all_like, for_each, hand_out, share
from pat3d.plan.grammar.meaning.doing import Doing
from pat3d.plan.grammar.meaning.entities import Item
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.tiers import is_tier
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.rewriting.instructions import Clause
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import INSIDE, Link

_WALLS = frozenset({"wall", "walls", "ceiling"})
_BASINS = ("sink", "bathtub", "toilet")
_ABOUT_BASINS = ("mirror", "hair dryer", "towel rack", "tile", "picture frame", "clock", "lamp", "plant",
                 "potted plant", "cabinet", "shelf", "scale", "light bulb", "painting")  # fmt: skip
"""What stands or hangs near a basin, and is never in it unless that is said."""
_FINDING = frozenset({"open", "close", "shut", "go", "navigate", "walk", "touch", "reach", "avoid", "check", "inspect",
    "ignore", "use", "give", "clear", "tidy", "serve", "turn", "rotate", "flip", "tilt"})  # fmt: skip
"""Verbs after which "with" tells which thing is meant, and not what it is done with."""


class Holding(Doing):
    """Puts what is had in or on what has it."""

    def __init__(self, world: World, chunks: Sequence[Chunk], maker: Maker, clause: Clause) -> None:
        super().__init__(world, chunks, maker, clause)
        self._sides: dict[int, str] = {}
        """On which side of what they flank things are, by chunk."""

    def _put_abreast(self) -> bool:
        """Put each of what is to stand next to each other next to the one before it; whether there are such."""
        for left, right in pairwise(self._abreast):
            self._step([right], Link(kind="next_to"), [left])
        return len(self._abreast) > 1

    def _had(self, at: int, owner_heads: Sequence[int], child_heads: Sequence[int]) -> None:
        self._have(self._chunks[at].relation, owner_heads, child_heads, each=bool(self._chunks[at].each))

    def _listed(self, _at: int, owner_heads: Sequence[int], child_heads: Sequence[int]) -> None:
        self._have(Link(manner="with"), owner_heads, child_heads)

    def _have(self, link: Link, owner_heads: Sequence[int], child_heads: Sequence[int], *, each: bool = False) -> None:
        world = self._world
        # "A desk has a bowl on it. It contains two plums": the bowl does.
        owners = self._said.refs_of(owner_heads, link if link.said == INSIDE else None, child_heads)
        if len(owners) == 1 and owners[0].group.multiplied and owners[0].group.phrase.determined:
            # "A nightstand on either side of the bed holds a lamp": each of the two does.
            owners = list(owners[0].group.items)
        each = each or self._said.speaks_of_each(owner_heads, carrying=True)
        each = each or len(owners) > len(self._said.refs_of(owner_heads))
        ordered = [(head, self._chunks[head].phrase) for head in child_heads]
        things = [head for head, phrase in ordered if phrase and phrase.kind not in ("part", "pieces", "background")]
        for head, phrase in ordered:
            if phrase is not None and phrase.kind == "part":
                self._own_part(owners, phrase)
            elif phrase is not None and phrase.kind == "background" and phrase.substance:
                # What fills a vessel is named in a note when the phrase is made.
                continue
            elif phrase is not None and phrase.kind == "pieces" and link.manner not in ("include", "with") and owners:
                things.append(head)
        told = bool(owners) and link.manner != "include"
        # "Stir the pot with it": the pot does not have it before.
        besides = owner_heads if self._clause.manner is None else ()
        children = self._said.refs_of(sorted(things), other=besides) if told else []
        if not children:
            return
        if len(owner_heads) == 1:
            # "The upper tier holds a drill, the lower a bucket": what is behind the other is not on the first.
            others = (at for at in range(owner_heads[0] + 1, max(things)) if is_tier(self._chunks[at].phrase))
            end = next(others, len(self._chunks))
            first = [item for head in things if head < end for item in self._said.ref(head) if item in children]
            if self._on_tier(first, owner_heads[0], owners):
                things = [head for head in things if head > end]
                children = [item for item in children if item not in first]
                if not children:
                    return
        if link.manner == "flank":
            sides = [self._sides.get(head, "") for head in things for _ in self._said.ref(head)]
            if "both" in sides:
                self._relating.both_sides(children, owners)
            else:
                self._relating.flanked(children, owners, sides)
            return
        having = link.manner == "hold" or link.finite
        placed = any(head in one for head in things for one, _ in self._said.related)
        loose = link.manner == "with" and not having and not placed
        had = share(world, link, owners, children, all_of=each, having=having, loose=loose)
        if had == "each":
            if loose and not each and any(item.group.phrase.determined for item in children):
                listed = " and ".join(dict.fromkeys(f'"{item.group.words}"' for item in children))
                world.note(f'{listed} with "{owners[0].group.words}": one for each is assumed.')
            for_each(world, owners, children)
            for head in things:
                self._said.known[head] = all_like(self._said.ref(head))
        elif hand_out(self._relating, link, owners, children, had):
            return
        for head in things:
            items = [item for item in self._said.ref(head) if item not in owners]
            if items and link.manner == "with" and link.kind is None and self._by_the_wall(head, owners[0]):
                self._relating.accompany(items, owners)
                continue
            carriers = world.tops(owners)
            if len({world.containment(each) for each in carriers}) > 1:
                # "A tray and a box hold balls": on the one, in the other.
                for at, item in enumerate(items):
                    self._relating.hold(link, [carriers[at % len(carriers)]], [item])
            elif items:
                self._relating.hold(link, owners, items)
            edge = world.supports.get(items[0]) if loose and len(items) == 1 else None
            if edge is not None and edge.parent in owners and len(world.tops(owners)) > 1:
                said = f'"{items[0].group.words}" with "{owners[0].group.words}"'
                world.note(f"{said}: {edge.kind} one of them is assumed.")

    def _by_the_wall(self, head: int, owner: Item) -> bool:
        """Whether chunk `head`, and not `owner`, is on the wall or the floor: "a sink with a mirror on the wall".

        "A bowl with plums on the floor", "a shelf with books on the wall": the bowl is, and the shelf. "A sink with a
        mirror" has it on the wall as well.
        """
        if self._world.is_a(owner, _BASINS) and self._world.is_a(self._said.ref(head)[0], _ABOUT_BASINS):
            return True
        if self._world.is_table(owner) and self._on_wall(self._said.ref(head)[0]):
            return True
        told = [other for one, other in self._said.related if head in one]
        places = {self._chunks[each].named.head for other in told for each in other}
        if self._world.is_a(owner, lexicon.SHELVES, vessels.SHUT):
            return False
        stands = self._world.on_floor(owner) and not self._world.is_a(owner, vessels.HOLLOW)
        return bool(places & _WALLS) or (stands and bool(places & {"floor", "ground"}))

    def _on_no_wall(self, items: list[Item]) -> list[Item]:
        """The lamp of "a wall clock and a lamp on the table"; all where nothing else is named."""
        return [item for item in items if not self._on_wall(item)] or items

    def _on_wall(self, item: Item) -> bool:
        return self._world.is_a(item, lexicon.ON_WALLS) or "wall" in item.group.words.lower().split()

    def _beside_both(self, fact: tuple, facts: Sequence[tuple]) -> bool:
        """Whether `fact` has what something is with on both sides: "a nightstand with a lamp on each side of it"."""
        held = {head for other in facts if other[0] == "have" for head in other[3]}
        return fact[0] == "rel" and self._chunks[fact[1]].relation.manner == "sides" and held >= {*fact[2]}

    def _is_had(self, at: int, parent_heads: Sequence[int]) -> bool:
        """Whether chunk `at` says where what its parents have is: "both plates have an apple on them"."""
        if not all(head in self._said.bound for head in parent_heads):
            return False
        owners = [inner for head in parent_heads for inner in self._said.bound[head]]
        links = [chunk.link for chunk in self._chunks[max(owners) : at]]
        return any(link is not None and link.finite and link.inverse for link in links)

    def _means(self, fact: tuple) -> bool:
        """Whether `fact` says what something is done with, and not what has it: "cover the pot with a plate"."""
        doing = self._clause.manner == "other" and self._clause.verb not in _FINDING
        link = self._chunks[fact[1]].relation if doing and fact[0] == "have" else None
        things = all(self._chunks[head].named.kind == "object" for head in fact[3]) if link is not None else False
        return link is not None and link.manner == "with" and link.kind is None and things
