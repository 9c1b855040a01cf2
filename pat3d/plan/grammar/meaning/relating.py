"""What a relation word between objects comes to: supports, lateral relations, arrangements."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.plausible import LARGE
from pat3d.plan.grammar.meaning.apart import set_apart
from pat3d.plan.grammar.meaning.attached import bears, crowding, lids_beside, slip_under, with_its_carrier
from pat3d.plan.grammar.meaning.counting import forget_count, multiply, on_each_side, recount
from pat3d.plan.grammar.meaning.covers import may_cover
from pat3d.plan.grammar.meaning.entities import Item, Sided
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import DRAPED, Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS
from pat3d.scene.relations import LATERAL_KINDS, OPPOSITE, RELATION_WORDS, SUPPORT_KINDS, LateralKind

_HALVES: dict[str, LateralKind] = {
    "left": "left_of", "right": "right_of", "back": "behind", "front": "in_front_of",
}  # fmt: skip
"""What stands in for a half of what has no surface."""
_NEIGHBOURS = 3
"""Things that one can stand next to."""
_PAIRS = 30
"""Things before others that are related one by one to all of them."""
_ENDS = 2
"""Of a surface: "a candle at each end"."""
_CORNERS = 4
"""Of a surface: "a candle in each corner"."""

_POURING = ("bottle", "blender", "thermos", "kettle", "teapot")
"""What something is taken out of, though little is ever put into it."""


class Relating:
    """Relates objects of one world."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.landmark: tuple[list[Item], bool] = ([], False)
        """What the sentence last said "to the left of" of, and whether it was "on the left side of"."""
        self.edged: list[Item] = []  # at whose end something was last said to be
        self.cost = 0.0
        """Of what can only be arranged in part."""

    def relate(self, children: list[Item], link: Link, parents: list[Item], *, each: bool = False) -> None:
        """Record that `children` stand in relation `link` to `parents`, `each` of them to one where that is said."""
        world = self.world
        moved = " and ".join(dict.fromkeys(f'"{item.group.words}"' for item in children))
        said = f'{moved} {{}} "{parents[0].group.words}"'
        if set(children) == set(parents):
            if link.manner == "source":
                # "Pour the water from the bottle": water is made as its bottle.
                return
            if link.kind in SUPPORT_KINDS:
                raise PromptError(f'"{children[0].group.words}" would rest on itself. Say which one is below.')
            if link.kind in OPPOSITE and link.kind != "next_to" and len(children) == 1:
                told = f'{RELATION_WORDS[link.kind]} "{parents[0].group.words}"'
                raise PromptError(f'"{children[0].group.words}" would be {told}, which is itself. Say of what else.')
            world.note(f"not understood: {said.format(link.said or (link.kind or link.manner).replace('_', ' '))}")
            return
        children = [child for child in children if child not in parents] or children
        set_apart(world, children, link, parents)
        if link.manner == "than":
            world.note(f"not modelled: {said.format(link.said)}")
        elif link.manner == "gaze":
            world.arrange("facing", children, parents, said.format("facing"), link.says == "facing")
        elif link.manner == "far":
            world.arrange("far_from", children, parents, said.format("far from"))
        elif link.manner == "under":
            self._under(children, parents, said)
        elif link.manner == "sides":
            self.landmark = (parents, False)
            self.both_sides(children, parents, on_it=link.kind == "on", each=link.said == "each")
        elif link.manner == "between":
            self._between(children, parents)
        elif link.manner == "half":
            self._on_half(children, link.side or "centre", parents, link.said, each=each)
        elif link.manner == "edge" and link.says is not None:
            level = world.likely.level(world.noun(parents[0]))
            if link.said:
                part = "corner" if link.says == "in_corner" else "edge"
                world.note(f'not modelled: "{link.said}" of the {part} of "{parents[0].group.words}"')
            if link.says == "in_corners" and len(children) == 1 and level:
                own = children[0].group.items
                children = multiply(world, children, _CORNERS) if len(own) == 1 else list(own)
            at, place = link.says.split("_")
            where = f"{at} the {place} of"
            self.relate(children, Link(kind="on" if level else "next_to"), parents)
            self.edged = parents if level else []
            world.arrange(
                link.says, children, parents, f"{said.format(where)}; it is placed {'on' if level else 'next to'} it"
            )
        elif link.manner in ("source", "goal") and link.kind != "next_to":
            off = link.said == "off" and not world.is_a(parents[0], vessels.RACKS, ("dish rack",))
            lid = off or world.is_a(children[0], vessels.ON_RIMS)
            shut = world.is_a(parents[0], vessels.SHUT) and (link.manner == "source" or link.kind == "in")
            shut = shut or (link.kind == "in" and world.is_a(parents[0], vessels.CLOSED))
            housed = not (lid or off) and world.houses(parents[0]) and (shut or link.manner == "source")
            if not lid and shut and not housed:
                world.note(f"not arranged: {said.format('inside')}; it is placed on it")
            within = housed or (link.manner == "source" and world.is_a(parents[0], _POURING))
            kind = "on" if lid else "in" if within else world.containment(parents[0])
            self.relate(children, Link(kind=kind), parents)
        elif link.kind in SUPPORT_KINDS:
            self._carried(children, link, parents, said)
        elif link.kind in LATERAL_KINDS:
            if link.kind not in ("next_to", "around"):
                self.landmark = (parents, False)
            if link.says == "leaning_against":
                note = f"{said.format('leaning against')}; it is placed next to it"
                world.arrange("leaning_against", children, parents, note)
            together = link.kind == "around" and len(children) > 2 and len({item.group for item in parents}) > 1
            if link.says == "circle" or together:
                world.arrange("circle", children, parents, f"{said.format('in a circle around')}")
            self.settle(children, parents)
            lids_beside(world, children, parents[0])
            if link.kind == "around" and (together or (link.says == "circle" and len(parents) > 1)):
                # A ring around several things is around none of them alone.
                return
            if link.kind == "around":
                parents = self.centre(children, parents)
            small = not world.on_floor(children[0]) and not world.is_a(children[0], lexicon.BY_A_SEAT, LARGE)
            table = world.is_table(parents[0]) and world.on_floor(parents[0])
            if link.kind == "next_to" and small and table and world.support(children[0]) is None:
                world.note(f'{said.format("beside")}: it stands on the ground there; say "on" to have it on top.')
            for landmarks in self.landmarks(children, link, parents, said, each=each):
                world.beside(children, link.kind, landmarks)  # type: ignore[arg-type]

    def landmarks(
        self, children: list[Item], link: Link, parents: list[Item], said: str, *, each: bool
    ) -> list[list[Item]]:
        """What `children` stand beside, all of them for each: "behind two boxes" is behind the one and the other.

        Next to several like things several are so in turn: "two mugs next to two plates".
        """
        places, own = self.world.bases(parents) or parents, self.world.bases(children)
        each = each or any(item.group.multiplied for item in (*own, *places))
        alike = len({item.group.noun for item in places}) < len(places) or len(own) > _NEIGHBOURS
        if link.kind == "around" or len(places) < 2 or (len(own) > 1 and (each or (alike and link.kind == "next_to"))):
            return [parents]
        if len(own) * len(places) > _PAIRS or (link.kind == "next_to" and len(places) > _NEIGHBOURS):
            where = RELATION_WORDS[link.kind or "next_to"]
            self.world.note(f"not arranged: {said.format(where)}, all of them; each is {where} one of them")
            firsts = list({item.group: [item] for item in reversed(places)}.values())[::-1]
            return firsts if 1 < len(firsts) <= _NEIGHBOURS and len(own) == 1 else [parents]
        return [[place] for place in places]

    def centre(self, children: list[Item], parents: list[Item]) -> list[Item]:
        """What `children` stand around: a ring of several things has one centre, as a note says."""
        several = len({item.group for item in children}) > 1 or len(children) < len(parents)
        if len(parents) == 1 or not several:
            return parents
        around, inner = (" and ".join(dict.fromkeys(f'"{item.group.words}"' for item in each))
                         for each in (children, parents))  # fmt: skip
        self.world.note(f"not arranged: {around} around {inner} together; it is placed around the first")
        return parents[:1]

    def settle(self, children: list[Item], parents: list[Item]) -> None:
        """Let the counted mention win: "a basket of fruit" with "five fruits" in it holds five."""
        world = self.world
        cycle = children[0].group.cycle
        if not cycle:
            return
        for other in world.groups:
            same = other is not children[0].group and {*other.cycle} == {*cycle} and not other.replaced
            if same and other.items and world.support(other.items[0]) in parents and not other.counted:
                other.replaced = True
                forget_count(world, other)

    def _carried(self, children: list[Item], link: Link, parents: list[Item], said: str) -> None:
        world, kind = self.world, link.kind
        parent = parents[0]
        if kind == "in" and not world.is_a(parent, vessels.HOLLOW, tuple(vessels.OPENED)) and not world.houses(parent):
            if world.is_a(parent, vessels.CLOSED, lexicon.SOLID):
                world.note(f"not arranged: {said.format('inside')}; it is placed on it")
                kind = "on"
            elif world.on_floor(parent) or world.is_a(parent, lexicon.HOUSING):
                kind = "on"
                if world.is_a(parent, vessels.SHUT):
                    world.note(f"not arranged: {said.format('inside')}; it is placed on it")
        elif kind == "on" and world.is_a(parent, lexicon.HOUSING):
            world.note(f"not arranged: {said.format('on')}; it is placed in it")
        self.settle(children, parents)
        self.cost += crowding(world, children, parent) if kind == "on" else 0.0
        if link.said == "over":
            world.over += paired(children, parents)
        lies = world.is_a(children[0], lexicon.THIN, vessels.COVERS, vessels.ON_RIMS, lexicon.LONG, lexicon.ON_HEAD)
        hung = world.is_a(parent, lexicon.HOOKED)
        if link.said in DRAPED and not hung:
            world.note(f"not arranged: {said.format(link.said)}; it is placed on it")
        if link.said == "over" and not (lies or hung) and not world.is_a(parent, vessels.RACKS, vessels.HOLLOW):
            world.note(f"not arranged: {said.format('over')}; it is placed on it")
        if link.says == "above":
            world.arrange("above", children, parents, f"{said.format('above')}; it is placed on it")
        tops = world.tops(parents)
        if len(world.bases(children)) < len(tops) and parents[0].group.height == 1:
            told = any(item.told != NO_MODIFIERS or item.colours for item in parents)
            exact = told or parents[0].group.exact or len({item.group for item in parents}) > 1
            if exact and kind == "in":
                raise PromptError(
                    f'"{children[0].group.words}" cannot be in {len(tops)} things at once. Say "in one of ...", or '
                    "name one."
                )
            over = link.said == "over" and world.is_a(children[0], vessels.COVERS)
            if exact and len(world.bases(children)) == 1 and not over:
                names = " and ".join(dict.fromkeys(f'"{item.group.words}"' for item in parents))
                what = "across" if link.says == "across" else "on"
                note = f'"{children[0].group.words}" {what} {names} together; it is placed on the first'
                like = world.is_a(children[0], lexicon.LONG) or world.noun(children[0]) == world.noun(parent)
                world.arrange("across", children, tops, note, link.says == "across" or like)
                self.cost += 0.3
        elif link.says == "across" and world.is_a(parent, vessels.HOLLOW):
            note = f'"{children[0].group.words}" across "{parent.group.words}"; it is placed on it'
            world.arrange("across", children, parents, note, len(children) == len(parents) == 1)
        world.place(children, kind or "on", parents)

    def _under(self, children: list[Item], parents: list[Item], said: str) -> None:
        world = self.world
        child, parent = children[0], parents[0]
        world.forget_guess(child, parent)
        table = world.is_a(child, ("table",)) and not world.on_floor(parent)
        rug = world.is_a(child, ("rug", "mat", "carpet", "blanket")) or not world.on_floor(parent)
        thin = world.is_a(child, lexicon.THIN) and not table and rug
        if len(children) == len(parents) == 1 and may_cover(world, parent, child):
            world.arrange("under", children, parents, said.format("under"))
        elif not world.hanging and (thin or (bears(world, child, parent) and not world.on_floor(parent))):
            slip_under(world, children, parents)
            world.place(parents, "on", children)
            world.arrange("under", children, parents)
        else:
            rest = "".join(f' and "{words}"' for words in dict.fromkeys(item.group.words for item in parents[1:])
                           if words != parent.group.words)  # fmt: skip
            world.arrange("under", children, parents, f"{said.format('under')}{rest}; it is placed next to it")

    def both_sides(self, children: list[Item], parents: list[Item], *, on_it: bool = False, each: bool = False) -> None:
        """`children` stand on both sides of `parents`, `each` or together, or at both ends of its top."""
        world = self.world
        children = with_its_carrier(world, children, parents)
        group = children[0].group
        seat = world.is_a(parents[0], lexicon.SEATS)
        level = world.is_a(parents[0], lexicon.LEVEL, ("piano",)) and not world.on_floor(children[0])
        on_it = on_it and (seat or level)
        if not on_it and world.is_a(parents[0], lexicon.LEVEL) and not world.on_floor(children[0]):
            # "A tray with a teapot and a cup on either side of it"
            world.note(f'"{group.words}": both sides are read as those of "{parents[0].group.words}".')
        if len(world.bases(children)) == 2:
            # "Two stacks of books at either end of a bench": the lowest of each stand there.
            children = world.bases(children)
        elif len(children) > 2 and not group.counted:
            recount(world, group, 2)
            children = list(group.items)
        children = on_each_side(world, children, each=each)
        if on_it:
            world.place(children, "on", parents)
            said = f'"{group.words}" at the ends of "{parents[0].group.words}"; they are placed on it'
            world.arrange("at_ends", children, parents[:1], said if len(children) > _ENDS else "")
            return
        self.flanked(children, parents)

    def flanked(self, children: Sequence[Item], parents: list[Item], sides: Sequence[str] = ()) -> None:
        """`children` stand left and right of `parents`, as `sides` say or in turn."""
        kinds: dict[str, LateralKind] = {"one": "left_of", "left": "left_of", "other": "right_of", "right": "right_of"}
        given = {kinds[side] for side in sides if side in kinds}
        for index, child in enumerate(self.world.bases(children)):
            kind: LateralKind = "right_of" if (index % 2 if not given else "left_of" in given) else "left_of"
            if index < len(sides) and sides[index] in kinds:
                kind = kinds[sides[index]]
            self.world.beside([child], kind, parents[:1] if kind == "left_of" else parents[-1:])

    def _between(self, children: list[Item], parents: list[Item]) -> None:
        """Both neighbours are said of the one between them: "A left_of child", "B right_of child"."""
        world = self.world
        said = f'"{children[0].group.words}" between "{parents[0].group.words}"'
        groups = list(dict.fromkeys(item.group for item in parents))
        if len(parents) < 2 and len(groups) < 2:
            world.note(f"{said}: the other neighbour is not said.")
        sides = (
            list(parents) if len(groups) == 1 else [next(item for item in parents if item.group is g) for g in groups]
        )
        for child in children:
            world.forget_guess(child, parents[0])
        if len(sides) > 2:
            world.arrange("between", children, sides, f"{said}: between more than two")
            if len(children) > 1:
                world.beside(children, "next_to", sides[:1])
            return
        world.arrange("between", children, sides)
        for index, neighbour in enumerate(sides):
            world.beside([neighbour], "right_of" if index % 2 else "left_of", children[:1])

    def _on_half(self, children: list[Item], side: str, parents: list[Item], said: str, *, each: bool) -> None:
        """Read "on the left side of the table": on it when it is a surface, else beside it."""
        world, parent = self.world, parents[0]
        if side == "centre" and len(parents) > 1:
            # "In the middle of the plates"
            return self._between(children, parents)
        level = world.is_a(parent, lexicon.LEVEL, lexicon.SEATS) and not world.is_a(parent, ("pillow", "blanket"))
        self.landmark = (parents, True)
        if said == "on the back of" and world.is_a(parent, lexicon.BACKED):
            # "A bird stands on the back of an elephant": an animal's back is its top.
            return self.relate(children, Link(kind="on"), parents)
        on_it = level and not world.likely.stands_by(world.noun(children[0]), world.noun(parent))
        if on_it and side in ("left", "right") and said and "side" not in said.split():
            told = f'"{children[0].group.words}" {said} "{parent.group.words}"'
            world.note(f'{told}: on it; "to the {side} of" has it beside.')
        if side == "centre" or on_it:
            kind = world.containment(parent)
            world.place(children, kind, parents)
            world.sided.append(Sided(items=children, side=side, owner=[], implied=[]))
        else:
            words = f'"{children[0].group.words}" {{}} "{parent.group.words}"'
            alike = [item for item in parents if item.group is parent.group]
            for landmarks in self.landmarks(children, Link(kind=_HALVES[side]), alike, words, each=each):
                world.beside(children, _HALVES[side], landmarks)
        return None


def paired(one: Sequence[Item], other: Sequence[Item]) -> list[tuple[Item, Item]]:
    """Each of `one` with its own of `other` where they are as many, else with all."""
    return list(zip(one, other, strict=True) if len(one) == len(other) else product(one, other))
