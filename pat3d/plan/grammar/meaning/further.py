"""One more of a kind: "another", "a third one"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.chunking.plausible import USUAL
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.matching import position
from pat3d.plan.grammar.meaning.shared_out import SharedOut
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS
from pat3d.scene.relations import SUPPORT_KINDS


class Further(SharedOut):
    """Makes what a sentence names as one more."""

    def _another(self, at: int, phrase: Phrase) -> list[Item]:
        """The next of those that are told of one by one, or one more of what was named first in the sentence."""
        words = phrase.words.lower()
        if self._world.telling and (words in ("another", "another one") or words.startswith("another of ")):
            # "Four mugs, one of which holds a pen and another a spoon"
            return [self._world.telling.pop(0)]
        named = [self.known[head] for heads in self.clauses.values() for head in heads if self.known.get(head)]
        before = [item.group for item in self._world.subject[:1]] or self._world.groups[-1:]
        groups = [named[0][0].group] if named else before
        groups = self._had_like(at, groups[:1]) or groups
        if (alike := self._carrier_like(at)) is not None:
            groups = [alike]
        counted = [group for group in reversed(self._world.groups) if len(group.items) > 1 and group.counted]
        counted = [group for group in counted if not group.replaced and not alike]
        said = set(phrase.words.lower().split())
        if counted and said & {"more", *lexicon.POSITIONS}:
            # "Five balls in a box and one more on it": one more ball; "two cups, a third one": a third cup.
            place = next((lexicon.POSITIONS[word] for word in said & lexicon.POSITIONS.keys()), 0)
            groups = [group for group in counted if len(group.items) == place] or counted
        if not groups or groups[0].proxy:
            return []
        like, own = replace(groups[0].phrase.modifiers, postures=()), phrase.modifiers
        alike = {one.modifiers.colours for one in self._world.groups if one.noun == groups[0].noun and not one.replaced}
        if len(alike) > 1:
            # "A red box, a blue one beside it, another on top": of which colour is not said.
            like = replace(like, colours=())
        told = ("colours", "palette", "palette_word", "material", "material_word", "size_word", "adjectives")
        # "Another red one", "another small one"
        like = replace(like, **{name: getattr(own, name) for name in told if getattr(own, name)})
        like = replace(like, scale=own.scale) if own.size_word else like
        more = replace(groups[0].phrase, words=phrase.words, count=phrase.count or 1, plural=False, height=None,
                       definite=False, modifiers=like.marked_as(phrase.modifiers))  # fmt: skip
        return list(self._maker.make(self._world, more).items)

    def _had_like(self, at: int, owners: Sequence[Group]) -> list[Group]:
        """What the `owners` have that chunk `at` has more of: "a bowl holds an egg; two are on the table" are eggs."""
        world, (link, landmark) = self._world, self._stands(at)
        verb = self._chunks[min(at + 1, len(self._chunks) - 1)]
        agrees = (self._chunks[at].named.count or 1) > 1 or not {*verb.words} & lexicon.OF_SEVERAL
        if verb.kind != "verb" or not agrees or link is None or landmark is None or link.kind not in SUPPORT_KINDS:
            return []
        edges = [(item, edge.parent) for item, edge in world.supports.items() if not edge.weak]
        for one, other in self.related:
            said = self._chunks[min(other, default=1) - 1].link
            if said is not None and (said.inverse or said.kind in SUPPORT_KINDS):
                items, holders = (other, one) if said.inverse else (one, other)
                told = self.ref_all([head for head in items if head < at])
                edges += [(item, each) for item in told for each in self.ref_all([*holders])]
        likes = list(dict.fromkeys(item.group for item, owner in edges if owner.group in owners))
        costs = [world.likely.relation(link, one.noun, landmark.noun) for one in likes if one not in owners]
        return likes if len(costs) == len(likes) == 1 and (landmark.head == "floor" or costs[0] < USUAL) else []

    def _another_of(self, at: int, phrase: Phrase) -> list[Item] | None:
        """The next of those that are told of one by one, where "another mug" at chunk `at` is one of them."""
        told = [item for item in self._world.telling if item.group.noun == phrase.noun]
        plain = phrase.modifiers in (NO_MODIFIERS, *(item.group.modifiers for item in told))
        if not told or not plain or phrase.opening != "another" or phrase.count not in (None, 1):
            return None
        link, landmark = self._stands(at)
        if link is not None and landmark is not None and self._apart(told[0], link, landmark):
            return None
        self._world.telling.remove(told[0])
        return told[:1]

    def _other_carrier(self, at: int, phrase: Phrase) -> list[Item]:
        """What "the one" at chunk `at`, told by its place, is where something else of its kind was told to carry.

        "The lamp is on the table left of the bed. The clock is on the one right of it.": another table, or the other
        where there are two.
        """
        link = self._chunks[at - 1].link if at > 1 else None
        behind = self._chunks[at + 1].kind if at + 1 < len(self._chunks) else ""
        if link is None or link.kind not in SUPPORT_KINDS or behind not in ("rel", "place") or position(phrase):
            return []
        told = {item for items in self.known.values() for item in items}
        if (like := self._carrier_like(at)) is not None:
            return [item for item in like.items if len(like.items) > 1 and item not in told][:1]
        subject, own = self._world.subject[:1], next(iter(self.known.get(0, ())), None)
        edge = self._world.supports.get(subject[0]) if subject else None
        if edge is None or own is None or own.group is subject[0].group or edge.weak or edge.kind != link.kind:
            return []
        if len(edge.parent.group.items) > 1:
            return [item for item in edge.parent.group.items if item is not edge.parent][:1]
        return self._one_like([edge.parent], phrase)

    def _next_of(self, group: Group, index: int, phrase: Phrase) -> list[Item]:
        """The fourth where three were named: "three mugs hang on a rack; the fourth stands next to it"."""
        likes = [
            item for one in self._world.groups if one.noun == group.noun and not one.replaced for item in one.items
        ]
        apart = group.rows or group.height > 1 or not group.exact or group.proxy or group.cycle
        if apart or " of " in phrase.words.lower() or index > len(likes):
            return []
        if index < len(likes):
            return [likes[index]]
        like = replace(group.phrase.modifiers, postures=(), palette=())
        like = replace(like, colours=like.colours if len(like.colours) < 2 else ())
        self._world.note(f'"{phrase.words}" is read as a further one, {index + 1} in all.')
        return self._one_like(group.items, replace(phrase, modifiers=like, count=1))

    def _carrier_like(self, at: int) -> Group | None:
        """What carries in the same way as "another" at chunk `at` is to: "a doll on a chair and a bear on another"."""
        link = self._chunks[at - 1].link if at else None
        if link is None or link.kind not in SUPPORT_KINDS:
            return None
        before = (head for head in range(at - 2, 0, -1) if self.known.get(head))
        told = (head for head in before if (piece := self._chunks[head - 1]).link and piece.link.kind == link.kind)
        head = next(told, None)
        return None if head is None else self.known[head][0].group

    def _that_have(self, at: int, before: Sequence[Item]) -> list[Item]:
        """Of `before`, or of what they are in, those that may sooner have what "both" or "each" at chunk `at` have.

        "The nuts are in the left jar and the bolts in the right jar, both of which have lids": the jars.
        """
        have, thing = (*self._chunks[at + 1 : at + 3], None, None)[:2]
        link = have.link if have is not None else None
        if link is None or not link.inverse or thing is None or thing.phrase is None or not thing.phrase.noun:
            return list(before)
        told = {item: self.ref_all(sorted(other))[:1] for one, other in self.related for item in self.ref_all([*one])}
        edges = {item: [edge.parent] for item in before if (edge := self._world.supports.get(item)) is not None}
        below = list(dict.fromkeys(each for item in before for each in told.get(item) or edges.get(item, [])))
        costs = [
            sum(self._world.likely.having(link, self._world.noun(item), thing.phrase.noun) for item in items)
            / max(len(items), 1)
            for items in (below, before)
        ]
        return below if len(below) > 1 and costs[0] < costs[1] else list(before)
