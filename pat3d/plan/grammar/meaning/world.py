"""The scene while it is being read: single objects, what carries them, where they stand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.meaning.entities import Arranged, Edge, Group, Item, Sided, Step
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.shapes import carriers_in_pyramid
from pat3d.plan.scene_plan import ArrangementKind
from pat3d.scene.relations import LateralKind, RelationKind

if TYPE_CHECKING:
    from pat3d.plan.grammar.chunking.chunks import Sentence

HARDLY = 2.0
"""Cost of a support from which on a note says that it is odd: what is round or slender carries nothing."""
CRAMPED = 1.3
"""Cost of being in a vessel from which on a note says so: dishes in a pan, a vase in a mug."""
_TALL = ("wardrobe", "fridge", "bookcase", "bookshelf", "shelf", "cabinet", "stove")
"""What has little room for a second thing beside one on top."""
UNUSUAL = 0.6
"""Cost of a support above which nobody thinks of it unless it is said outright."""
MAX_OBJECTS = 60
"""Objects in one scene."""


class World:
    """Objects, supports and lateral relations; supports stay a tree."""

    def __init__(self, likely: Plausible) -> None:
        self.likely = likely
        self.groups: list[Group] = []
        self.supports: dict[Item, Edge] = {}
        self.laterals: list[Edge] = []
        self.sided: list[Sided] = []
        self.arranged: list[Arranged] = []
        self.grounded: set[Item] = set()
        """Some of what something carries, said to be on the floor: "five books, two of them on the floor"."""
        self.floored: set[Item] = set()
        """What is said to be on the floor, and so not on the table of what it is beside."""
        self.outside: list[tuple[list[Item], Item]] = []
        """Some of several, said to be outside of what the others are in."""
        self.over: list[tuple[Item, Item]] = []
        """What is said to be over or to cover what, which a vessel turned over does around it."""
        self.steps: list[Step] = []
        """What an instruction asks for."""
        self.aside: list[str] = []
        self.notes: list[str] = []
        self.subject: list[Item] = []
        """What the sentence before is about."""
        self.unread: list[Item] | None = None
        """What the instruction before is about where that was not read: none where this is not known either."""
        self.spoken: list[Item] = []
        """What "it" last was as what something stands on or beside."""
        self.together: list[Item] = []
        """What "they" of the next sentence are: all that the sentence before is about, or the sentences before are."""
        self.front: list[Item] = []
        """What the sentence before opened with: the sofa of "behind the sofa there is"."""
        self.landmark: tuple[list[Item], bool] = ([], False)
        """What "to the left of" was last said of, and whether it was "on the left side of"."""
        self.emptied: list[Item] = []
        """What is to be emptied or cleared by what the sentence goes on with: what that moves is there before."""
        self.makes: list[Item] = []
        """What instructions have put where it is, as a scene to make: "put a cup on a tray"."""
        self.hanging = False
        """Whether the clause tells of what hangs, which nothing stands on."""
        self.settled = 0
        """Groups that the sentences before this one have named."""
        self.telling: list[Item] = []
        """Members of the group told of one by one that were not told of yet."""
        self.singled: list[Item] = []
        """Which of several "the cup to the left of the plate" meant, in the order of the prompt."""

    def items(self) -> list[Item]:
        """Every object, in the order of the prompt."""
        return [item for group in self.groups if not group.replaced for item in group.items]

    def signature(self) -> tuple[int, frozenset[tuple[int, str, int]]]:
        """How many objects there are, and what carries what."""
        number = {item: at for at, item in enumerate(self.items())}
        edges = ((number.get(e.child, -1), e.kind, number.get(e.parent, -1)) for e in self.supports.values())
        return len(number), frozenset(edges)

    def rivals(self, other: World) -> bool:
        """Whether a person may mean this as well as `other`: the same objects, as many of them carried, none oddly."""
        ours, theirs = self.signature(), other.signature()
        edges = [edge for edge in self.supports.values() if edge not in other.supports.values()]
        odd = (self.likely.held(self.noun(edge.child), edge.kind, self.noun(edge.parent)) > UNUSUAL for edge in edges)
        return ours != theirs and ours[0] == theirs[0] and len(ours[1]) >= len(theirs[1]) and not any(odd)

    def note(self, text: str) -> None:
        """Say `text` once."""
        if text not in self.notes:
            self.notes.append(text)

    def hear(self, sentence: Sentence) -> None:
        """Keep what is set aside in `sentence`, and what may be meant otherwise there."""
        self.aside += [said for said in sentence.aside if said not in self.aside]
        self.hanging = any({*said.split('"')} & lexicon.HANGING for said in sentence.unread)
        for doubt in sentence.doubts:
            self.note(doubt)

    # What things are

    def is_a(self, item: Item, *tables: tuple[str, ...]) -> bool:
        """Whether it belongs to one of these classes of the lexicon."""
        return self.likely.is_a(self.noun(item), *tables)

    def noun(self, item: Item) -> str:
        """Catalogue noun of `item`."""
        group = item.group
        if not group.cycle:
            return group.noun
        # One that a later number of its group has taken away again is of the first kind.
        return group.cycle[group.items.index(item) % len(group.cycle) if item in group.items else 0]

    def on_floor(self, item: Item) -> bool:
        """Whether it stands on the floor by nature."""
        return self.likely.floor(self.noun(item))

    def is_table(self, item: Item) -> bool:
        """Whether it is furniture with a level top, not a dish."""
        return self.is_a(item, lexicon.LEVEL) and not self.is_a(item, lexicon.DISHES)

    def closes(self, lids: Sequence[Item], vessel: Item) -> bool:
        """Whether `lids` close `vessel`."""
        return all(self.likely.closes(self.noun(lid), self.noun(vessel)) for lid in lids)

    def below_told(self, told: Sequence[Item], other: Sequence[Item]) -> list[Item]:
        """What is "it" again for `other` behind "a box sits on it": the wardrobe, and no table that may carry both."""
        below = self.support(told[0]) if told and other else None
        if below is None or below not in self.spoken or not self.on_floor(below):
            return []
        laid = self.is_table(below) and not self.is_a(below, lexicon.SEATS, _TALL) and not self.on_floor(other[0])
        return [] if laid else [below]

    def flat(self, item: Item) -> bool:
        """Whether nothing can be in it."""
        return not self.is_a(item, vessels.HOLLOW, tuple(vessels.OPENED)) and self.likely.level(self.noun(item))

    def oddly_below(self, child: Item, parent: Item) -> bool:
        """Whether `parent` is a small thing that nobody puts the furniture `child` on."""
        small = (
            not self.on_floor(parent)
            and not self.is_a(parent, lexicon.THIN)
            and not self.likely.level(self.noun(parent))
        )
        return small and self.is_table(child) and self.on_floor(child)

    def has_inside(self, item: Item) -> bool:
        """Whether it may carry something in it or on it: a vessel, a cupboard, a holder, a level top."""
        noun = self.noun(item)
        return (
            self.is_a(item, vessels.HOLLOW, tuple(vessels.OPENED), vessels.HOLDERS)
            or self.likely.closet(noun)
            or self.likely.level(noun)
        )

    def houses(self, item: Item) -> bool:
        """Whether things go into it from the front, which it is made open for."""
        noun = self.noun(item)
        # Of a stove the oven is spoken of as a thing of its own.
        return noun in {*lexicon.HOUSES, *lexicon.HOUSES.values()} and (noun != "stove" or "oven" in item.group.said)

    def containment(self, parent: Item) -> RelationKind:
        """What "in", "with" and "holding" mean at `parent`: "in" where it is hollow, else "on"."""
        return "in" if self.is_a(parent, vessels.HOLLOW, vessels.RACKS, tuple(vessels.OPENED)) else "on"

    # Stacks

    def bases(self, items: Sequence[Item]) -> list[Item]:
        """Those that stand on the support of `items`: all, or the lowest of each stack."""
        return [item for item in items if not self._inside_stack(item, 0) or len(items) == 1]

    def was_taken(self, items: Sequence[Item]) -> bool:
        """Whether `items` were taken from elsewhere just before: "take the book from the pile, open it on ..."."""
        taken = self.steps[-1] if self.steps else None
        groups = {item.group for item in items}
        if taken is None or taken.manner != "pick" or groups != {item.group for item in taken.items}:
            return False
        return any(each.height > 1 for each in groups) or bool({"from", "off", "out"} & {*taken.said.lower().split()})

    def tops(self, items: Sequence[Item]) -> list[Item]:
        """Those that carry what is on `items`: all, or the highest of each stack."""
        kept = [item for item in items if not self._inside_stack(item, -1) or len(items) == 1]
        return kept or list(items[-1:])

    @staticmethod
    def _inside_stack(item: Item, end: int) -> bool:
        group, height = item.group, item.group.height
        # What a later phrase took out of its group ("the blue one of the blocks") is no longer among its items.
        if (height <= 1 and not group.pyramid) or item not in group.items:
            return False
        at = group.items.index(item)
        if lowest := group.lowest:
            return at >= lowest if end == 0 else at < len(group.items) - 1
        last = at % height == height - 1 or at == len(group.items) - 1
        return not (at % height == 0 if end == 0 else last)

    # Supports

    def support(self, item: Item) -> Item | None:
        """What carries `item`, or None for the ground."""
        edge = self.supports.get(item)
        if edge is not None:
            return edge.parent
        if (lowest := item.group.lowest) and item in item.group.items:
            below = carriers_in_pyramid(item.group.items.index(item), lowest)
            return item.group.items[below[0]] if below else None
        at = item.group.items.index(item) if item.group.height > 1 else 0
        return item.group.items[at - 1] if at % item.group.height else None

    def ancestors(self, item: Item) -> list[Item]:
        """What carries `item`, what carries that, and so on."""
        path: list[Item] = []
        while (parent := self.support(path[-1] if path else item)) is not None:
            path.append(parent)
        return path

    def place(self, children: Sequence[Item], kind: RelationKind, parents: Sequence[Item], weak: bool = False) -> None:
        """Record that `children` are carried by `parents`, in turn where there are several.

        Raises:
            PromptError: the prompt has an object carry itself.
        """
        tops = self.tops(parents)
        # Of a tower the lowest stands on what the tower is on.
        lowest = [child for child in self.bases(children) if not set(self.ancestors(child)) & set(children)]
        for index, child in enumerate(lowest):
            self._put(child, kind, tops[index % len(tops)], weak)

    def _put(self, child: Item, kind: RelationKind, parent: Item, weak: bool) -> None:
        if kind == "in" and self.flat(parent) and not self.houses(parent):
            kind = "on"
        if self.is_a(parent, lexicon.HOOKED):
            kind = "hangs_from"
            if self.noun(child) == "hook":
                whole, part = parent.group.words, child.group.words
                raise PromptError(
                    f'"{part}" are part of "{whole}", and not told apart: say what hangs from "{whole}" itself.'
                )
        old = self.supports.get(child)
        if parent is child or child in self.ancestors(parent):
            known = self.supports.get(parent)
            if weak:
                return
            if known is not None and known.weak and known.parent is child:
                del self.supports[parent]
            else:
                # "a lamp and a table with the lamp on it" may repeat what is known, never turn it round.
                raise PromptError(
                    f'"{child.group.words}" would rest on itself: it already carries "{parent.group.words}". '
                    "Say which one is below."
                )
        shut_in = kind == "in" and self.houses(parent) and self.likely.floor(self.noun(child))
        if self.oddly_below(child, parent) or (shut_in and not self.is_a(child, lexicon.SEATS)):
            raise PromptError(
                f'"{child.group.words}" {kind} "{parent.group.words}": furniture rests {kind} no such thing. Say which '
                "one is below."
            )
        if old is not None and not old.weak:
            below = old.parent
            free = self.support(below) is None and not self.on_floor(below)
            carries = self.is_table(parent) or self.likely.on(self.noun(below), self.noun(parent)) < 1.0
            if carries and free and parent is not below and (not weak or self.is_a(parent, lexicon.LEVEL)):
                # "A lamp on a book" that is "on a table": the book is, and so are the saucers of a tray's cups.
                self._put(below, kind, parent, weak)
                if not weak:
                    self.note(f'"{below.group.words}" is {kind} "{parent.group.words}", with what it carries.')
            if weak or parent is below or parent in self.ancestors(child):
                return
            if below not in self.ancestors(parent):
                known_words = f'"{child.group.words}" is {old.kind} "{below.group.words}"'
                self.note(f'{known_words}; also being {kind} "{parent.group.words}" is left out.')
                return
        self.supports[child] = Edge(child=child, kind=kind, parent=parent, weak=weak)
        if not weak and kind == "on" and self.likely.on(self.noun(child), self.noun(parent)) >= HARDLY:
            self.note(f'"{child.group.words}" on "{parent.group.words}": it hardly stays there.')
        hollow = kind == "in" and self.is_a(parent, vessels.HOLLOW) and not self.is_a(child, ("plant", "potted plant"))
        if kind == "in" and not weak and not self.has_inside(parent):
            self.note(f'"{child.group.words}" in "{parent.group.words}": whether that has an inside is not known.')
        larger = parent.group.modifiers.scale > child.group.modifiers.scale
        if hollow and not larger and not weak and self.likely.within(self.noun(child), self.noun(parent)) >= CRAMPED:
            self.note(f'"{child.group.words}" in "{parent.group.words}": it hardly fits there.')
        if not weak:
            self.laterals = [edge for edge in self.laterals if not (edge.weak and edge.child is child)]
            if old is not None and old.weak and self._may_stand(parent, old.parent):
                # Where "a desk with a lamp" goes on "on two books", the books stand where the lamp was to stand.
                for each in parent.group.items if parent.group.height == 1 else [parent]:
                    if self.support(each) is None:
                        self._put(self._lowest(each), old.kind, old.parent, True)

    def _lowest(self, item: Item) -> Item:
        return [item, *self.ancestors(item)][-1]

    def _may_stand(self, item: Item, where: Item) -> bool:
        lowest = self._lowest(item)
        newest = bool(self.groups) and item.group in self.groups and item.group is not where.group
        clear = where not in [lowest, *self.ancestors(item)] and lowest not in self.ancestors(where)
        return newest and clear and not self.on_floor(lowest) and lowest is not where

    # Laterals

    def beside(self, children: Sequence[Item], kind: LateralKind, parents: Sequence[Item], weak: bool = False) -> None:
        """Record a lateral relation, with `parents` in turn."""
        # What rests on itself by now has no lowest.
        places = self.bases(parents) or list(parents)
        for index, child in enumerate(self.bases(children) if places else ()):
            parent = places[index % len(places)]
            if child is not parent:
                self.forget_guess(child, parent)
                self.laterals.append(Edge(child=child, kind=kind, parent=parent, weak=weak))

    def forget_guess(self, child: Item, parent: Item) -> None:
        """`child` does not stand on or beside `parent` after all, unless the prompt says so outright."""
        old = self.supports.get(child)
        if old is not None and old.weak and old.parent is parent:
            del self.supports[child]
        self.laterals = [
            edge for edge in self.laterals if not (edge.weak and edge.child is child and edge.parent is parent)
        ]

    def siblings(self, child: Item, parent: Item) -> tuple[Item, Item] | None:
        """The nearest carriers of `child` and `parent` (or they themselves) that share a support."""
        above_child = [child, *self.ancestors(child)]
        above_parent = [parent, *self.ancestors(parent)]
        for one in above_child:
            for other in above_parent:
                if one is not other and self.support(one) is self.support(other):
                    return None if one in above_parent or other in above_child else (one, other)
        return None

    def arrange(
        self, kind: ArrangementKind, items: Sequence[Item], of: Sequence[Item] = (), note: str = "", exact: bool = True
    ) -> None:
        """Record an arrangement; `note` says what is not arranged where it is not `exact` or no scene can hold it."""
        self.arranged.append(
            Arranged(kind=kind, items=list(items), of=list(of), arranged=not note, otherwise=note, exact=exact)
        )
