"""Which are "the others": what the clauses before, or the one behind, have not told of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.matching import colours_of
from pat3d.plan.grammar.meaning.pronouns import Pronouns
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS


class Others(Pronouns):
    """Finds what is left of several."""

    @staticmethod
    def _unplaced(groups: list[Group], phrase: Phrase) -> list[Item]:
        """Those of a row that no place told of: "five cups in a row: the middle one is red, the others are blue"."""
        several = phrase.head != "other" or (phrase.count or 1) > 1
        for group in groups:
            left = [item for item in group.items if not item.place]
            if len(group.items) > len(left) >= (phrase.count or 1 + several):
                return left[: phrase.count or (None if several else 1)]
        return []

    def _untold(self, at: int, phrase: Phrase) -> list[Item] | None:
        """What "the others" at chunk `at` are where all that was named stands elsewhere: as many more as are assumed.

        "Put the red cups on the tray and the others on the shelf": cups that are told by nothing. None where some of
        what was named are left; nothing where what was named is told from no others.
        """
        moved = [head for one, _ in self.related for head in sorted(one) if head < at and self.known.get(head)]
        head = max((head for head in moved if self._chunks[head].named.kind == "object"), default=None)
        items = self.known[head] if head is not None else self._world.subject
        if head is None and (left := self._but_one_ahead(at, phrase, items)):
            return left
        if not items or any(at in one and head in one for one, _ in self.related):
            return None
        group, gone = items[0].group, {*items, *(item for step in self._world.steps for item in step.items)}
        if not set(group.items) <= gone or group.phrase.some or group.cycle or group.height > 1:
            return None
        several = phrase.head != "other" or (phrase.count or 1) > 1
        alike = [item for item in self._world.items() if item.group.noun == group.noun and item not in gone]
        if alike:
            return alike[: phrase.count or (None if several else 1)]
        by = {each for one, other in self.related if at in other for each in one}
        if head is not None and head in by and self._chunks[head].words[:1] != ("one",):
            # "Put the fork in the other": in no other fork, but "put one brick on the other".
            return None
        behind = self._chunks[head + 1].kind if head is not None and head + 1 < at else ""
        alone = len(group.items) == 1 and not several
        if not alone and not group.exact and group.modifiers == NO_MODIFIERS and behind not in ("which", "quality"):
            return [] if group.phrase.plural and group.phrase.definite else None
        kept = group.modifiers if group.exact and not group.phrase.definite else NO_MODIFIERS
        more = replace(group.phrase, words=phrase.words, modifiers=kept, superlative=NO_MODIFIERS, definite=True,
                       determined=True, plural=several, count=phrase.count or (None if several else 1))  # fmt: skip
        return list(self._maker.make(self._world, more).items)

    def _but_one_ahead(self, at: int, phrase: Phrase, items: Sequence[Item]) -> list[Item]:
        """Those of `items` beside the one that is named behind chunk `at`: "stack the other two on the red one"."""
        ahead = [self._chunks[head].named for one, other in self.related if at in one for head in other if head > at]
        single = len(ahead) == 1 and ahead[0].definite and not ahead[0].plural and bool(ahead[0].modifiers.colours)
        if not single or not items or len(items) != (phrase.count or 0) + 1:
            return []
        named = [item for item in items if colours_of(item) == ahead[0].modifiers.colours]
        return [item for item in items if item is not (named or items)[0]]

    def _left_over(self, at: int, phrase: Phrase) -> list[Item]:
        """Those of which the clauses before told some apart: "the left cup is red and the other is blue"."""
        for head in sorted((head for head in self.known if head < at), reverse=True):
            items = self.known[head]
            group = items[0].group if items else None
            some = group is not None and group.height == 1 and 0 < len(items) < len(group.items) and not group.cycle
            named = self._chunks[head].named
            if group is None or not some or not (named.definite or named.superlative != NO_MODIFIERS):
                continue
            others = [item for item in group.items if item not in items and not (item.place and items[0].place)]
            wanted = phrase.count or (1 if phrase.head == "other" or phrase.words.lower() == "the other one" else 0)
            return others if len(others) == (wanted or len(others)) else []
        return []
