"""Some of what was counted before: "two spoons and a bowl are on the tray. One spoon is in the bowl." has two spoons.

A number in front of a noun counts anew in a list and beside another place: "two cups are on the table. One cup is on
the shelf."
"""

from __future__ import annotations

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.contrast import Contrast
from pat3d.plan.grammar.meaning.counting import recount
from pat3d.plan.grammar.meaning.described import tell
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS
from pat3d.plan.grammar.words.number_words import is_number
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_OPENS = ("joint", "clause")
_TELLS = ("verb", "rel", "have", "quality", "place", "form")
"""Chunks that say something of the subject before them."""
_MORE = frozenset({"more", "further", "additional", "extra", "another", "other", "last", "single"})
"""Words of what is not counted before."""


class SharedOut(Contrast):
    """Takes some of what was counted before as what a number counts."""

    def _of_those(self, at: int, phrase: Phrase) -> list[Item] | None:
        """Those of a group named before that "one spoon" at chunk `at` is said of; None where it is said of further."""
        alike = self._counted_before(at, phrase)
        if not alike or phrase.count is None:
            return None
        link, landmark = self._stands(at)
        group = alike[0].group
        if link is not None and landmark is not None and self._apart(alike[0], link, landmark):
            told = "is read as a further one" if phrase.count == 1 else "are read as further ones"
            total = len(alike) + phrase.count
            self._world.note(f'"{phrase.words}" behind "{group.words}" {told}, {total} in all.')
            return None
        if link is not None and (group.height > 1 or group.pyramid or group.heap):
            return None
        left = [item for item in self._world.telling if item in alike]
        items = left if len(left) >= phrase.count else alike
        self._world.telling = items[phrase.count :]
        return items[: phrase.count]

    def _counted_late(self, at: int, phrase: Phrase) -> list[Item] | None:
        """All of "a stack of coins", of which "there are ten coins" tells the number; None where it is no such."""
        world, words = self._world, phrase.words.lower().split()
        groups = [group for group in world.groups[: world.settled] if group.noun == phrase.noun]
        there = at == 1 and self._chunks[0].kind == "there" and not self._chunks[2:] and words[1:] == [phrase.head]
        if not there or not groups or groups[-1].counted or groups[-1].exact or not phrase.count:
            return None
        group = groups[-1]
        edge, formed = world.supports.get(group.items[0]), [one for one in world.arranged if one.items == group.items]
        group.height = phrase.count if group.height > 1 else 1
        recount(world, group, phrase.count)
        group.counted = group.exact = True
        for one in formed:
            one.items = list(group.items)
        if edge is not None:
            world.place(group.items, edge.kind, [edge.parent], edge.weak)
        return list(group.items)

    def _told_by_looks(self, at: int, phrase: Phrase) -> list[Item] | None:
        """Those of "books" in a sentence before that "a red book" at chunk `at` speaks of; None where it is one more.

        "There are books on a table. There is a red book next to a green book." has no more than the books.
        """
        looks = phrase.modifiers
        anew = phrase.definite or phrase.each or phrase.other or phrase.cycle or phrase.part or phrase.height
        if self.asked or anew or not (looks.colours or looks.size_word) or (phrase.plural and not phrase.count):
            return None
        groups = [group for group in self._world.groups[: self._world.settled] if group.noun == phrase.noun]
        if not groups or not _of_no_number(groups[-1]) or {"another", "more"} & {*phrase.words.lower().split()}:
            return None
        group, (link, landmark) = groups[-1], self._stands(at)
        like = landmark is not None and (landmark.kind == "pronoun" or landmark.noun == phrase.noun)
        carried = link is not None and link.kind in SUPPORT_KINDS
        if (
            link is not None
            and landmark is not None
            and (self._apart(group.items[0], link, landmark) or (carried and not like))
        ):
            return None
        taken = {item for items in self.known.values() for item in items}
        free = [item for item in group.items if item.told == NO_MODIFIERS and not item.colours and item not in taken]
        if (wanted := phrase.count or 1) > len(free):
            there = self._world.supports.get(group.items[0])
            recount(self._world, group, len(group.items) + wanted - len(free))
            free += group.items[-(wanted - len(free)) :]
            if there is not None:
                self._world.place(group.items, there.kind, [there.parent], there.weak)
        for item in free[:wanted]:
            tell(item, looks)
            if carried:
                # "A red book on a green book": and not where the books are.
                self._world.supports.pop(item, None)
        return free[:wanted]

    def _again(self, at: int, phrase: Phrase) -> list[Item] | None:
        """The one thing named before that "on a sofa" at chunk `at` names again; None where it is one more.

        "A room with a desk and a rug. On a desk stands a lamp."; where that bears something already there are two.
        """
        if self.asked or phrase.opening not in ("a", "an") or not any(at in other for _, other in self.related):
            return None
        like = [group for group in self._world.groups[: self._world.settled] if group.noun == phrase.noun]
        link, plain = self._chunks[at - 1].link, all(one.modifiers == NO_MODIFIERS for one in (phrase, *like))
        if len(like) != 1 or len(like[0].items) != 1 or not plain or link is None or link.kind not in SUPPORT_KINDS:
            return None
        (own,), bears = like[0].items, {edge.parent for edge in self._world.supports.values() if not edge.weak}
        if not self._world.on_floor(own) or like[0].said != phrase.said:
            return None
        again = "one more" if own in bears else "the one named before"
        self._world.note(f'"{phrase.words}" (word {phrase.number}) is read as {again}.')
        return None if own in bears else [own]

    def _counted_before(self, at: int, phrase: Phrase) -> list[Item]:
        """Of what "one spoon" at chunk `at`, which opens a clause that tells of it, may be some; nothing without."""
        opens = at == 0 or self._chunks[at - 1].kind in _OPENS
        tells = at + 1 < len(self._chunks) and self._chunks[at + 1].kind in _TELLS
        plain = phrase.superlative == NO_MODIFIERS and phrase.height is None and not phrase.part
        anew = phrase.definite or phrase.each or phrase.other or phrase.vague or phrase.some or phrase.cycle
        words = phrase.words.lower().split()
        if (
            self.asked
            or not (opens and tells and plain)
            or anew
            or phrase.count is None
            or not is_number((words or [""])[0])
        ):
            return []
        if _MORE & {*words} or phrase.plural != (phrase.count > 1):
            return []
        groups = [group for group in self._world.groups[: self._world.settled] if not group.replaced]
        name, bare = phrase.said or phrase.head, phrase.modifiers == NO_MODIFIERS
        # "Between two wine bottles. One bottle is open."
        shorter = [group for group in groups if len(group.items) > 1 and group.said.split()[-1] == name]
        groups = [group for group in groups if group.said == name or (bare and group in shorter)]
        if not groups or phrase.modifiers not in (NO_MODIFIERS, groups[-1].modifiers):
            return []
        if len(groups[-1].items) > phrase.count:
            return list(groups[-1].items)
        # "There are a red cup and a blue cup. One cup is upside down."
        likes = [item for group in groups for item in group.items]
        return likes if len(likes) > phrase.count and phrase.modifiers == NO_MODIFIERS else []

    def _stands(self, at: int) -> tuple[Link | None, Phrase | None]:
        """Where what chunk `at` tells of is said to be: the relation word of its clause, and its landmark."""
        for n in range(at + 1, len(self._chunks) - 1):
            piece = self._chunks[n]
            if piece.kind in (*_OPENS, "have", "noun"):
                break
            if piece.kind == "rel" and not piece.relation.inverse:
                return piece.relation, self._chunks[n + 1].phrase
        return None, None

    def _apart(self, item: Item, link: Link, landmark: Phrase) -> bool:
        """Whether what `item` is carried by leaves no room for what is said to stand at `landmark` by `link`."""
        world = self._world
        below = world.ancestors(item)
        if not below:
            return False
        inside = world.supports[item].kind == "in" if item in world.supports else False
        beside = link.kind in LATERAL_KINDS
        if landmark.kind == "pronoun":
            return beside and inside
        known = [one for one in world.items() if one.group.noun == landmark.noun and one.group is not item.group]
        if not (known and landmark.definite):
            if link.kind in SUPPORT_KINDS:
                return landmark.definite or not world.is_table(below[0]) or world.likely.floor(landmark.noun)
            return beside and inside
        if {*known} & {*below}:
            return beside
        return not any({*world.ancestors(one)} & {*below} for one in known)


def _of_no_number(group: Group) -> bool:
    """Whether `group` is "books", of which neither the number nor anything else is said."""
    plain = group.modifiers == NO_MODIFIERS and group.height == 1 and not (group.cycle or group.heap or group.pyramid)
    return plain and group.phrase.plural and not (group.exact or group.phrase.definite or group.replaced)
