"""The plan while a prompt is being read: groups of like objects and the relations between groups."""

from __future__ import annotations

from dataclasses import dataclass, field

from pat3d.errors import PromptError
from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.modifiers import Modifiers
from pat3d.plan.grammar.vocabulary import Nouns
from pat3d.scene.model import RelationKind


@dataclass(kw_only=True, eq=False)
class Group:
    """Objects asked for by one noun phrase."""

    noun: str
    said: str
    phrase: str
    count: int
    counted: bool
    """Whether the prompt gives the number."""
    exact: bool
    """Whether it is a number of objects and not "some"."""
    plural: bool
    modifiers: Modifiers
    member_colours: list[tuple[str, ...]] = field(default_factory=list)
    """Colours of the single members, where the prompt tells them apart."""
    cycle: tuple[str, ...] = ()
    height: int = 1
    """Objects in each stack; 1 where they are not stacked."""
    heap: bool = False
    rows: int = 0
    """Rows that the objects stand in, one behind the other; 0 where nothing is said."""
    proxy: bool = False
    one_of: bool = False
    """The prompt speaks of one of them: "on one of two boxes"."""
    whole: Group | None = None
    """The group that these are members of."""
    place: str = ""
    """By which it is told from others of its kind: "left" for "the left box"."""
    replaced: bool = False
    """A generic whose members were listed ("plush toys, including ...")."""


@dataclass(kw_only=True, eq=False)
class Edge:
    """`child` stands in relation `kind` to `parent`."""

    child: Group
    kind: RelationKind
    parent: Group
    weak: bool = False
    """Guessed from "with": gives way to anything the prompt says outright."""


@dataclass(kw_only=True, eq=False)
class Flank:
    """What stands on both sides of something."""

    parent: Group
    members: list[Group] = field(default_factory=list)
    sides: dict[int, str] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True, eq=False)
class Sided:
    """A group said to be on the left, in the middle, behind, ... of something that is not said with it."""

    group: Group
    side: str
    """left, right, one, other, centre, front or back."""
    owner: Group | None = None
    """What has the side, where the prompt lets know."""
    implied: Group | None = None
    """What the group stands beside where nothing else is on a side."""
    begun: bool = False
    """Whether the clause begins with `implied`, so that the side is its side: "a mug, a spoon on the left"."""


def carried_by_two(child: Group, parents: Group) -> PromptError:
    """The error for one thing that would rest on several."""
    what = f'"{parents.phrase}" together' if parents.count > 1 else f'"{parents.phrase}" and something else'
    hint = f'Say "on one of ..." or "on a stack of {parents.count} ...".' if parents.count > 1 else "Say which one."
    return PromptError(
        f'"{child.phrase}" cannot be carried by {what}: every object of a scene is carried by one other. {hint}'
    )


class Draft:
    """Groups, supports and lateral relations, kept a tree while they are collected."""

    def __init__(self, nouns: Nouns) -> None:
        self.nouns = nouns
        self.groups: list[Group] = []
        self.supports: dict[int, Edge] = {}
        """The support edge of each group that has one, by id of the group."""
        self.laterals: list[Edge] = []
        self.flanks: list[Flank] = []
        self.sided: list[Sided] = []
        self.set_aside: list[str] = []
        self.notes: list[str] = []

    def is_a(self, group: Group, table: tuple[str, ...]) -> bool:
        """Whether the group's noun belongs to a class of the lexicon."""
        return self.nouns.of_class(group.noun, table)

    def is_table(self, group: Group) -> bool:
        """Whether the group is furniture with a level top, not a dish."""
        return self.is_a(group, lexicon.LEVEL) and not self.is_a(group, lexicon.DISHES)

    def on_floor(self, group: Group) -> bool:
        """Whether the group's objects stand on the floor by nature."""
        return self.is_a(group, lexicon.FLOOR)

    def support(self, group: Group) -> Group | None:
        """What carries `group`, or None for the ground."""
        edge = self.supports.get(id(group))
        return edge.parent if edge else None

    def ancestors(self, group: Group) -> list[Group]:
        """What carries `group`, what carries that, and so on."""
        path: list[Group] = []
        while (parent := self.support(path[-1] if path else group)) is not None:
            path.append(parent)
        return path

    def containment(self, parent: Group) -> RelationKind:
        """What "in", "with" and "holding" mean at `parent`: "in" where it is hollow, else "on"."""
        return "in" if self.is_a(parent, lexicon.HOLLOW) else "on"

    def place(self, child: Group, kind: RelationKind, parent: Group, *, weak: bool = False) -> None:
        """Record that `child` is carried by `parent`.

        Raises:
            PromptError: the prompt has an object carry itself.
        """
        if kind == "in":
            kind = "in" if not self._flat(parent) else "on"
        old = self.supports.get(id(child))
        if parent is child or child in self.ancestors(parent):
            if weak:
                return
            # "a lamp and a table with the lamp on it" may repeat what is known, never turn it round.
            raise PromptError(
                f'"{child.phrase}" would rest on itself: it already carries "{parent.phrase}". Say which one is below.'
            )
        if old is not None and not old.weak:
            below = old.parent
            if not weak and self.is_table(parent) and self.support(below) is None and not self.on_floor(below):
                # "A lamp on a book" that is "on a table": the book is.
                self.place(below, kind, parent)
            if weak or parent is old.parent or parent in self.ancestors(child):
                return
            if old.parent not in self.ancestors(parent):
                known = f'"{child.phrase}" is {old.kind} "{old.parent.phrase}"'
                self.notes.append(f'{known}; also being {kind} "{parent.phrase}" is left out.')
                return
        self.supports[id(child)] = Edge(child=child, kind=kind, parent=parent, weak=weak)
        if not weak:
            self.laterals = [edge for edge in self.laterals if not (edge.weak and edge.child is child)]
            if old is not None and old.weak:
                self._pass_on(old, child, parent)

    def _pass_on(self, old: Edge, child: Group, parent: Group) -> None:
        """Where "a desk with a lamp" goes on "on two books", the books stand where the lamp was to stand."""
        newest = bool(self.groups) and parent is self.groups[-1] and old.parent is not parent
        above = self.ancestors(old.parent)
        free = self.support(parent) is None and not self.on_floor(parent)
        if newest and free and child not in above and parent not in above:
            self.place(parent, old.kind, old.parent, weak=True)

    def _flat(self, group: Group) -> bool:
        if self.is_a(group, lexicon.HOLLOW):
            return False
        return any(self.is_a(group, table) for table in (lexicon.LEVEL, lexicon.SEATS, lexicon.DISHES))

    def beside(self, child: Group, kind: RelationKind, parent: Group, *, weak: bool = False) -> None:
        """Record a lateral relation."""
        if child is parent:
            return
        self.forget_guess(child, parent)
        self.laterals.append(Edge(child=child, kind=kind, parent=parent, weak=weak))

    def forget_guess(self, child: Group, parent: Group) -> None:
        """`child` does not stand on or beside `parent` after all, unless the prompt says so outright."""
        old = self.supports.get(id(child))
        if old is not None and old.weak and old.parent is parent:
            del self.supports[id(child)]
        self.laterals = [
            edge for edge in self.laterals if not (edge.weak and edge.child is child and edge.parent is parent)
        ]

    def fits(self, child: Group, parent: Group) -> bool:
        """Whether one would list `child` among what `parent` carries."""
        if self.on_floor(child) and not self.is_a(child, ("floor cushion",)):
            return False
        if self.is_a(parent, lexicon.NARROW):
            return self.is_a(child, lexicon.SLENDER) or child.noun == parent.noun
        if self.is_a(parent, lexicon.HOLLOW) and child.noun != parent.noun:
            if self.is_a(child, lexicon.LARGE_VESSELS) or self.is_a(child, lexicon.NOT_IN_VESSEL):
                return False
            tables = (lexicon.HOLLOW, lexicon.LEVEL, lexicon.NOT_ON_DISH)
            if self.is_a(parent, lexicon.BOWLS) and (child.height != 1 or any(self.is_a(child, t) for t in tables)):
                return False
        if self.is_a(parent, lexicon.DISHES) and not self.is_a(parent, ("tray",)):
            return not self.is_a(child, lexicon.NOT_ON_DISH) and not self.is_a(child, lexicon.HOLLOW)
        return True

    def join_with(self, child: Group, parent: Group) -> None:
        """Record what `parent` "with" `child` means."""
        if self.is_a(child, lexicon.ON_HEAD) and not self._flat(parent) and not self.is_a(parent, lexicon.HOLLOW):
            self.place(child, "on", parent, weak=True)
        elif self.on_floor(child):
            around = child.count >= 3 and self.is_a(child, ("chair", "stool", "armchair"))
            kind = "around" if around else "next_to"
            self.beside(child, kind, parent, weak=True)
        elif self.is_a(parent, lexicon.HOLLOW) or self._flat(parent) or self._carries(parent):
            self.place(child, self.containment(parent), parent, weak=True)
        else:
            self.beside(child, "next_to", parent, weak=True)

    def _carries(self, group: Group) -> bool:
        return self.is_a(
            group, ("cake", "book", "box", "pillow", "radio", "basket", "block", "pizza", "laptop", "pancake")
        )
