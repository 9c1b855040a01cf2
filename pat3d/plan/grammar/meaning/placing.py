"""Places without a landmark of one reading: "on the left", "inside", "too"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.chunking.plausible import LARGE, LEAFY
from pat3d.plan.grammar.meaning.attached import has_room, put_carriers
from pat3d.plan.grammar.meaning.counting import multiply
from pat3d.plan.grammar.meaning.described import LEAVES, describe
from pat3d.plan.grammar.meaning.entities import Item, Sided
from pat3d.plan.grammar.meaning.forming import Forming
from pat3d.plan.grammar.meaning.matching import LATERAL_SIDES
from pat3d.plan.grammar.meaning.tiers import has_tiers
from pat3d.plan.grammar.meaning.world import UNUSUAL
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import read_modifiers
from pat3d.plan.grammar.words.postures import token_text
from pat3d.scene.relations import LATERAL_KINDS, OPPOSITE

_ON_ITS = {"head": "upside down", "side": "on its side", "back": "lying on its back", "face": "lying on its face"}
"""What an object may lie on that is a part of itself, and how it is turned then."""
_UNSAID = 0.4
"""Cost of a place of which it is left open what it is at."""
_HARDLY_IN = 1.7
"""Cost of being inside what has no inside, see Plausible.within."""


class Placing(Forming):
    """Places the objects of one sentence by what is implied, or as a whole."""

    def _placed(self, at: int, heads: Sequence[int], owner_heads: Sequence[int]) -> None:
        """Read "a plate with a fork on the left", "a mug, and a bowl nearby"."""
        world = self._world
        chunk = self._chunks[at]
        children = self._said.refs_of(heads)
        owners = self._said.refs_of(owner_heads)
        if not children:
            return
        if len(owners) > 1 and len(children) < len(owners) and self._said.speaks_of_each(owner_heads):
            children = multiply(world, children, len(owners))
        if len(owners) > 1 and len(children) == len(owners) and chunk.text in LATERAL_SIDES:
            # "Three plates, each with a fork on its left"
            self._relating.relate(children, Link(kind=LATERAL_SIDES[chunk.text]), owners)
            return
        begun = self._begun(at, heads)
        implied = begun or self._previous(at)
        if chunk.link is not None and chunk.link.kind in LATERAL_KINDS and not begun:
            # "A backpack lies on it. A bottle stands in front": of the bench.
            implied = world.below_told(implied, children) or implied
        if chunk.link is not None and chunk.link.manner == "between":
            self._in_between(at, children, owners)
            return
        if chunk.link is not None:
            depth = chunk.link.kind in ("in_front_of", "behind") and not set(self._relating.landmark[0]) & set(children)
            parents = owners or (self._relating.landmark[0] if depth else []) or implied
            same = not owners and bool(implied) and implied[0].group.noun == children[0].group.noun
            if same and self._relating.landmark[0] and chunk.link.kind not in LATERAL_KINDS:
                # "A ball in front of the box, a second behind it and a third on top": of the box.
                parents = self._relating.landmark[0]
            lateral = chunk.link.kind in LATERAL_KINDS
            if owners and lateral and world.is_table(owners[0]) and not world.on_floor(children[0]):
                others = [item for item in self._on(owners[0]) if item not in children]
                world.place(children, "on", owners, weak=True)
                parents = others[:1] or owners
            if chunk.link.kind == "in" and parents and not owners:
                parents = self._that_holds(children[0], parents)
            if not parents and chunk.link.kind in ("in_front_of", "behind"):
                side = "front" if chunk.link.kind == "in_front_of" else "back"
                world.sided.append(Sided(items=children, side=side, owner=[], implied=[]))
            elif not parents and self._holds_list(chunk, children[0]) and (inner := self._just_named(at, children)):
                # "a microwave on a counter with a bowl inside"
                self._relating.relate(inner, chunk.link, children)
            elif not parents:
                world.note(f'"{children[0].group.words}": what it is {chunk.text} is not said.')
                self._relating.cost += _UNSAID * (world.containment(children[0]) != "in")
            else:
                if not owners and depth and len(children) < len(children[0].group.items):
                    # "A rack with six tubes, three of them in front": of the rack, or the front ones.
                    of = parents[0].group.words
                    world.note(f'"{chunk.text}" is read as said of "{of}".')
                self._relating.relate(children, chunk.link, parents)
            return
        side = chunk.text
        if side == "too":
            self._alike(children)
            return
        if side in ("both", "ends"):
            some, whole = self._chunks[heads[0]].named, children[0].group.items
            if {"each", "either"} & set(chunk.words) and some.kind == "pieces" and 2 * (some.count or 0) == len(whole):
                # "Six chairs, three on each side"
                children = list(whole)
            stood_by = [edge.parent for edge in world.laterals if edge.child in whole and edge.parent not in whole]
            around = owners or [item for item in implied if item not in whole] or stood_by
            if "each" in chunk.words and some.kind == "pieces" and around and 4 * (some.count or 0) == len(whole):
                # "Four chairs surround a table, one on each side": of its four sides.
                self._relating.relate(list(whole), Link(kind="around"), around[:1])
                return
            parents = owners or [item for item in implied if item not in children]
            parents = around[:1] if stood_by and {*parents} <= {*whole} else parents
            below = world.support(parents[0]) if parents and side == "ends" else None
            small = parents and not world.on_floor(parents[0]) and (below is not None and world.on_floor(below))
            if below is not None and world.is_table(below) and (small or not world.is_table(parents[0])):
                # "A bowl is in the middle of the table and a candle at each end": of the table.
                parents = [below]
            if parents:
                row = parents if parents[0].group.rows or len({item.group for item in parents}) > 1 else parents[:1]
                each = "each" in chunk.words and some.kind == "object"
                self._relating.both_sides(children, row, on_it=side == "ends", each=each)
            return
        told = self._landmark_of(chunk, owners, children) or (
            [] if owners or begun else self._alone_on(chunk, children)
        )
        if side in LATERAL_SIDES and told:
            self._relating.relate(children, Link(kind=LATERAL_SIDES[side]), told)
            return
        seat = bool(owners) and world.is_a(owners[0], lexicon.SEATS) and not world.is_table(owners[0])
        if seat and side in LATERAL_SIDES and self._stands_by_seats(children[0]):
            # "The bed has a lamp on its left"
            self._relating.relate(children, Link(kind=LATERAL_SIDES[side]), owners)
            return
        if owners:
            world.sided.append(Sided(items=children, side=side, owner=owners, implied=[]))
            level = world.is_a(owners[0], lexicon.LEVEL, lexicon.SEATS)
            child, owner = children[0], owners[0]
            stays = not world.on_floor(child) or world.likely.on(world.noun(child), world.noun(owner)) < UNUSUAL
            if level and world.support(child) is None and stays:
                world.place(children, world.containment(owner), owners, weak=True)
            return
        before = max((head for head in self._landmarks if head < at), default=None)
        last = self._relating.landmark if before is None else self._landmarks[before]
        landmark, surface = last if last[0] else ([], False) if begun else world.landmark
        if side == "centre" and not landmark:
            landmark = self._relating.edged
        if side == "other" and not landmark:
            landmark = self._across(children, implied)
        if landmark and side == "other" and not surface:
            # "On one side of the plate is a fork, on the other a knife."
            side = "right"
        if landmark and side in ("left", "right", "centre") and not set(landmark) & set(children):
            sides = [edge.child for edge in self._world.laterals if edge.parent in landmark]
            items = world.items()
            named = items[: items.index(children[0])]
            rivals = [item for item in sides if item in named and item not in (*landmark, *children)]
            if rivals and {"its", "their"} & set(chunk.words):
                world.note(
                    f'"{" ".join(chunk.words)}" is said of "{landmark[0].group.words}"; it may be said of '
                    f'"{rivals[0].group.words}" too.'
                )
            if "far" in chunk.words:  # "a saw is left of a vise, a mallet left of the saw, a can at the far right"
                landmark = self._outermost(landmark, LATERAL_SIDES.get(side), children)
            half = surface or side == "centre"
            link = Link(manner="half", kind="on", side=side) if half else Link(kind=LATERAL_SIDES[side])  # type: ignore[arg-type]
            self._relating.relate(children, link, landmark)
            return
        if not begun and set(children) < set(world.together):
            # "A cup and a bowl are on the table. The cup is on the left."
            implied = [item for item in world.together if item not in children]
        world.sided.append(Sided(items=children, side=side, owner=[], implied=implied, begun=bool(begun)))

    def _across(self, children: list[Item], beside: list[Item]) -> list[Item]:
        """What `beside` stands next to, of which `children` are "on the other side"; that is on its left then."""
        world = self._world
        edge = next((each for each in world.laterals[::-1] if each.kind == "next_to" and each.child in beside), None)
        if edge is None or edge.parent in children:
            return []
        world.laterals = [replace(each, kind="left_of") if each is edge else each for each in world.laterals]
        below = world.support(edge.child)
        if below is not None and below is world.support(edge.parent) and has_room(world, below, children[0]):
            world.place(children, "on", [below], weak=True)
        return [edge.parent]

    def _outermost(self, items: list[Item], kind: str | None, children: list[Item]) -> list[Item]:
        """The farthest on side `kind` of `items`, by what was said of which is beside which."""
        edges = [edge for edge in self._world.laterals if kind and not {edge.child, edge.parent} & {*children}]
        further = {edge.parent: edge.child for edge in edges if edge.kind == kind}
        further |= {edge.child: edge.parent for edge in edges if OPPOSITE.get(edge.kind) == kind}
        for _ in range(len(further)):
            items = [further[items[0]]] if items[0] in further else items
        return items

    def _stands_by_seats(self, item: Item) -> bool:
        return self._world.on_floor(item) or self._world.is_a(item, lexicon.BY_A_SEAT)

    def _in_between(self, at: int, children: list[Item], owners: list[Item]) -> None:
        """Read "a cushion at either end and a cat in between": between the two named last."""
        nearest = [items for head, items in sorted(self._said.known.items(), reverse=True) if head < at and items]
        groups = [g for g in dict.fromkeys(items[0].group for items in nearest)
                  if g is not children[0].group and not any(item in g.items for item in owners)]  # fmt: skip
        carriers = {self._world.support(item) for group in groups for item in group.items}
        groups = [group for group in groups if not carriers & set(group.items)]
        pair = groups[:1] if groups and len(groups[0].items) == 2 else groups[1::-1] if len(groups) > 1 else []
        # "Two chairs facing each other with a table in between"
        neighbours = [item for group in pair for item in group.items] or owners
        if len(neighbours) != 2:
            self._world.note(f'not understood: "{" ".join(self._chunks[at].words)}": between what is not said.')
            return
        self._relating.relate(children, Link(manner="between", kind="right_of"), neighbours)

    def _landmark_of(self, chunk: Chunk, owners: list[Item], children: list[Item]) -> list[Item]:
        """Of what "to its left" is the left, or "to the left" behind "beside the plate are"; or nothing."""
        fronts = sorted(self._said.fronts)
        links = [self._chunks[head - 1].link for head in fronts if head]
        if not owners and links and all(link is not None and link.kind == "next_to" for link in links):
            items = self._said.ref_all(fronts)
            return items if len(items) == 1 else []
        across = [edge.parent for edge in self._world.laterals if edge.child in owners and edge.parent not in children
                  and edge.kind == OPPOSITE.get(LATERAL_SIDES.get(chunk.text, ""))]  # fmt: skip
        if across and "its" not in chunk.words:
            # "A nightstand to the left of the bed, with a dresser on the right": of the bed.
            return across[-1:]
        if "its" not in chunk.words or not owners or not self._world.is_table(owners[0]):
            return []
        # "A laptop is on the desk with a mouse to its right": of what stands on the desk.
        subject = [item for head in self._said.clauses[max(self._said.clauses)] for item in self._said.ref(head)]
        there = [item for item in subject if self._world.support(item) is owners[0] and item not in children]
        if owners[0] in subject:
            # "A desk with a lamp in the middle and a mug to its right": of the lamp.
            centres = [told.items for told in self._world.sided if told.side == "centre" and told.owner == owners]
            there = [item for item in (centres[-1] if centres else ()) if item not in children]
        if len(there) == 1:
            self._world.place(children, "on", owners, weak=True)
        return there if len(there) == 1 else []

    def _alone_on(self, chunk: Chunk, children: list[Item]) -> list[Item]:
        """Of what "to its left" is the left behind "a desk with a lamp on it", of what stands on no floor; or nothing.

        The lamp, as what the clause before is about carries that alone.
        """
        world, before = self._world, self._world.subject
        if "its" not in chunk.words or len(before) != 1 or not world.is_table(before[0]):
            return []
        likely = world.likely.beside(world.noun(children[0]), world.noun(before[0]))
        there = [item for item in self._on(before[0]) if item not in children]
        return there if likely > 1 and len(there) == 1 else []

    def _with_carriers(self, facts: Sequence[tuple]) -> None:
        """Put what carries something, and stands nowhere, on the table that the sentence has a corner or a side of.

        "A cup on a saucer, and a lamp in the corner of the desk": the saucer is on the desk too.
        """
        world = self._world
        there = set(world.items())
        named = [item for head in sorted(self._said.known) for item in self._said.known[head] if item in there]
        links = {fact[1]: self._chunks[fact[1]].relation for fact in facts if fact[0] == "rel"}
        sided = [fact[3] for fact in facts if fact[0] == "rel" and links[fact[1]].manner in ("edge", "half")]
        tables = {item for heads in sided for item in self._said.ref_all(heads) if world.is_a(item, lexicon.LEVEL)}
        heads = {chunk.phrase.head for chunk in self._chunks if chunk.phrase is not None}
        if len(tables) == 1 and not heads & {"floor", "ground"}:
            put_carriers(world, named, tables.pop())

    def _loose(self) -> float:
        """What it costs that small things are nowhere, where something is there to carry them."""
        world = self._world
        items = world.items()
        carried = any(world.support(item) is not None for item in items)
        if not carried or not any(world.is_table(item) for item in items):
            return 0.0
        beside = [{edge.child, edge.parent} for edge in world.laterals]
        # What is beside something small that is nowhere either, is nowhere.
        placed = {item for item in items if world.support(item) is not None or world.on_floor(item)
                  or world.is_a(item, lexicon.BY_A_SEAT, LARGE)}  # fmt: skip
        for _ in beside:
            placed |= {item for pair in beside if pair & placed for item in pair}
        related = {item for pair in beside for item in pair if item in placed}
        related |= {item for each in world.arranged if each.kind == "under" for item in (*each.items, *each.of)}
        told = {item for each in world.sided for item in each.items}
        loose = [
            item for item in items
            if world.support(item) is None and not world.on_floor(item) and item not in related and item not in told
            and not world.is_a(item, lexicon.BY_A_SEAT, LARGE)
            and not (world.is_a(item, lexicon.THIN) and any(world.support(other) is item for other in items))
        ]  # fmt: skip
        return 0.5 * len({id(item.group) for item in loose})

    def _that_holds(self, child: Item, meant: list[Item]) -> list[Item]:
        """What `child` is inside: `meant`, or what was named last that can hold it where that cannot."""
        world = self._world

        def within(item: Item) -> float:
            return world.likely.within(world.noun(child), world.noun(item))

        if world.is_a(meant[0], tuple(vessels.OPENED)) or within(meant[0]) < _HARDLY_IN:
            return meant
        fit = [item for item in world.items() if item is not child and (
            world.is_a(item, tuple(vessels.OPENED))
            or ((world.likely.hollow(world.noun(item)) or world.likely.closet(world.noun(item)))
                and within(item) < _HARDLY_IN)
        )]  # fmt: skip
        return fit[-1:] or meant

    def _holds_list(self, chunk: Chunk, holder: Item) -> bool:
        """Whether `holder` with a list and `chunk` behind it has that list there: what is on top of fruit is in it."""
        hollow = self._world.likely.hollow(self._world.noun(holder))
        return chunk.text == "inside" or (chunk.text == "on top" and not hollow)

    def _just_named(self, at: int, besides: Sequence[Item]) -> list[Item]:
        """What stands right before chunk `at`, with the list that something has and that it ends; none of `besides`."""
        if not at or self._chunks[at - 1].kind != "noun":
            return []
        had = (things for owners, things in self._said.related if at - 1 in things and min(owners) < min(things))
        items = self._said.ref_all(sorted(next(had, {at - 1})))
        return items if not set(items) & set(besides) else []

    def _alike(self, children: list[Item]) -> None:
        """Put `children` where the thing named before them is."""
        world = self._world
        placed = [item for item in world.items() if item in world.supports and item not in children]
        if placed:
            edge = world.supports[placed[-1]]
            world.place(children, edge.kind, [edge.parent])
        else:
            world.note(f'"{children[0].group.words}" too: like what is not said.')

    def _on(self, parent: Item) -> list[Item]:
        return [item for item in self._world.items() if self._world.support(item) is parent]

    def _begun(self, at: int, heads: Sequence[int]) -> list[Item]:
        """What the clause begins with, besides what the place is said of."""
        start = max((start for start in self._said.clauses if start <= at), default=0)
        first = next((head for head in self._said.clauses.get(start, ()) if head not in heads), None)
        if first is None or first > min(heads, default=at):
            return []
        return self._said.ref(first)

    def _previous(self, at: int) -> list[Item]:
        starts = [start for start in sorted(self._said.clauses) if start <= at]
        for start in reversed(starts[:-1]):
            if items := self._said.ref(self._said.clauses[start][0]):
                return items
        return self._world.subject

    def _resting(self, at: int, link: Link, children: list[Item], parents: list[Item]) -> Link:
        """What `link` at chunk `at` says of what is there: what is off a couch is no longer on it."""
        if link.manner != "source" or self._chunks[at].words[:1] != ("off",):
            return link
        if children and parents:
            words, of = children[0].group.words, parents[0].group.words
            self._world.note(f'"off {of}": "{words}" is read as next to it, not on it.')
        return Link(kind="next_to")

    def _lies_on(self, phrase: Phrase, children: list[Item], parents: list[Item]) -> bool:
        """Read "two cups, one of them on its head": of what has no head it says how it is turned."""
        own = phrase.kind == "part" and phrase.possessive and phrase.said in _ON_ITS
        likely, noun = self._world.likely, self._world.noun(parents[0])
        headless = likely.level(noun) or likely.hollow(noun) or self._world.is_a(parents[0], vessels.NARROW)
        if not own or not (headless or set(children) <= set(parents)):
            return False
        for item in children:
            item.told = item.told.marked_as(read_modifiers([token_text(_ON_ITS[phrase.said])]))
        return True

    def _own_part(self, owners: list[Item], phrase: Phrase) -> None:
        for group in dict.fromkeys(item.group for item in owners):
            words = phrase.modifiers
            if has_tiers(self._world, group, phrase):
                continue
            own = phrase.said not in LEAVES or self._world.is_a(owners[0], LEAFY)
            if own and (words.colours or words.palette or words.material):
                describe(group, words, part=phrase.said)
                idle = [word for word in words.adjectives if word not in lexicon.HONOURED | lexicon.SAID_OTHERWISE]
                if idle := [word for word in idle if word not in lexicon.SHADE_WORDS]:
                    said = ", ".join(f'"{word}"' for word in idle)
                    self._world.note(f'not modelled: {said} of "{phrase.words}"')
            elif not own or phrase.said not in lexicon.SILENT_PARTS or words.adjectives:
                said = " ".join((phrase.words, *words.postures))
                self._world.note(f'not modelled: "{said}" of "{group.words}"')
        if not owners and phrase.words not in self._world.aside:
            self._world.aside.append(phrase.words)

    def _fillings(self, facts: Sequence[tuple]) -> tuple[set[int], dict[int, int]]:
        """Phrases of which a bare plural means many, and the generics that list others."""
        fillings: set[int] = set()
        kinds: dict[int, int] = {}
        for fact in facts:
            link = self._chunks[fact[1]].link if fact[0] == "have" else None
            if link is not None and link.filling and len(fact[3]) == 1:
                fillings |= set(fact[3])
            if fact[0] == "include":
                kinds |= dict.fromkeys(fact[3], fact[2][0])
        return fillings, kinds
