"""What it comes to that one thing has another: in it, on it, hanging from it or only beside it."""

from __future__ import annotations

from pat3d.plan.grammar.meaning.entities import Item
from pat3d.plan.grammar.meaning.relating import Relating, paired
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import Link

_HARDLY_CARRIED = 0.9
"""Cost of being on what only hands would hold it on, see Plausible.on."""


class Having(Relating):
    """Relates what is had to what has it."""

    def hold(self, link: Link, owners: list[Item], children: list[Item]) -> None:
        """Record what it means that `owners` have `children`."""
        world, owner = self.world, owners[0]
        self.settle(children, owners)
        weak = link.manner == "with" and link.kind is None
        odd = world.likely.on(world.noun(children[0]), world.noun(owner)) >= _HARDLY_CARRIED
        if link.manner == "surround":
            world.beside(children, "around", self.centre(children, owners))
        elif world.is_a(owner, lexicon.HOOKED) and not world.on_floor(children[0]):
            world.place(children, "hangs_from", owners, weak=weak)
        elif (
            link.manner == "hold"
            and odd
            and not world.has_inside(owner)
            and not world.is_a(children[0], vessels.ON_RIMS)
        ):
            # "A statue holding a cup"
            said = f'"{owner.group.words}" holding "{children[0].group.words}"'
            world.note(f"not arranged: {said}, which is placed next to it")
            if (below := world.supports.get(owner)) is not None:
                world.place(children, below.kind, [below.parent], weak=True)
            world.beside(children, "next_to", owners)
        elif weak and world.is_a(children[0], lexicon.SIDE_DISHES) and world.is_a(owner, lexicon.MAIN_DISHES):
            self.accompany(children, owners)
        elif weak and world.is_a(children[0], lexicon.BENEATH_CUPS) and world.is_a(owner, vessels.NARROW):
            world.place(owners, "on", children, weak=True)
        elif weak and (
            world.is_a(owner, lexicon.DEVICES)
            or (world.is_a(owner, ("chair", "armchair", "sofa")) and world.is_a(children[0], ("lamp",)))
        ):
            # "A reading chair with a lamp": beside it.
            self.accompany(children, owners)
        elif world.is_a(owner, vessels.RACKS):
            world.place(children, "in", owners, weak=weak)
        elif link.kind == "on" or world.is_a(children[0], vessels.ON_RIMS):
            if link.said == "over":
                world.over += paired(children, owners)
            world.place(children, "on", owners, weak=weak)
        elif (
            weak
            and world.is_a(children[0], lexicon.ON_HEAD)
            and not world.flat(owner)
            and not world.is_a(owner, vessels.HOLLOW)
        ):
            world.place(children, "on", owners, weak=True)
        elif weak and world.on_floor(children[0]) and not world.is_a(children[0], lexicon.SEATS[-4:]):
            around = len(children) >= 3 and world.is_a(children[0], ("chair", "stool", "armchair"))
            if around:
                world.beside(children, "around", owners, weak=True)
            else:
                self.accompany(children, owners)
        elif (
            not weak
            or world.is_a(owner, vessels.HOLLOW, tuple(vessels.OPENED))
            or world.flat(owner)
            or world.likely.on(world.noun(children[0]), world.noun(owner)) < 0.6
        ):
            housed = world.houses(owner) and self._belongs_inside(owner, children[0], weak=weak)
            kind = "in" if housed else world.containment(owner)
            world.place(children, kind, owners, weak=weak)
            if not housed:
                self._not_inside(owner, children[0], "on", weak=weak)
        else:
            self.accompany(children, owners)
            self._not_inside(owner, children[0], "next to")

    def accompany(self, children: list[Item], owners: list[Item]) -> None:
        """`children` are next to the `owners` that they are only said to be with, until more is said."""
        said = f'"{children[0].group.words}" {{}} "{owners[0].group.words}"'
        for landmarks in self.landmarks(children, Link(kind="next_to"), owners, said, each=False):
            self.world.beside(children, "next_to", landmarks, weak=True)

    def _not_inside(self, owner: Item, child: Item, where: str, *, weak: bool = True) -> None:
        """Say that what a closed thing or a holder is said to have does not stand inside."""
        world = self.world
        if self._belongs_inside(owner, child, weak=weak) and world.containment(owner) != "in":
            said = f'"{child.group.words}" inside "{owner.group.words}"'
            world.note(f"not arranged: {said}; it is placed {where} it")

    def _belongs_inside(self, owner: Item, child: Item, *, weak: bool) -> bool:
        """Whether what the closed thing or holder `owner` is said to have is inside of it."""
        world = self.world
        if world.on_floor(child) or world.is_a(child, lexicon.BY_A_SEAT):
            return False
        if world.houses(owner):
            return not world.is_a(child, vessels.NOT_IN_VESSEL)
        shut = vessels.SHUT if weak else ()
        return world.is_a(owner, vessels.CLOSED, shut, vessels.HOLDERS) and owner.group.said != "stove"
