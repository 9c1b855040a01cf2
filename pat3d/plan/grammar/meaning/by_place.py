"""Which of several its place, what it stands beside or what is in it tells: "the left cup", "the jar of nuts"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.described import tell
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.further import Further
from pat3d.plan.grammar.meaning.matching import (
    COUNTED,
    OPPOSITE,
    PLACES,
    colours_of,
    line_up,
    position,
    same_head,
    same_noun,
)
from pat3d.plan.grammar.meaning.unlike import from_the_front, one_of_unlike
from pat3d.plan.grammar.rewriting.displaced import NEARNESS
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS


class ByPlace(Further):
    """Chooses one of several by where it is, or by what is in it."""

    def _singled(self, items: list[Item], phrase: Phrase, at: int | None) -> list[Item]:
        """The one of several that "the cup to the left of the plate" means: one that was not singled out before.

        It is told by the relation behind chunk `at`; where nothing tells it ("the cup") it is the one singled out last.
        """
        world, group = self._world, items[0].group
        named = phrase.words.lower().startswith("the ") and phrase.count in (None, 1) and not phrase.each
        before = [item for item in world.singled if item in items]
        # "the container of the same color": one in turn
        matched = at is None and not before and len({colours_of(item) for item in items}) > 1
        if not named or matched or not (group.phrase.plural and group.counted) or group.multiplied or group.cycle:
            return items
        if at is None:
            return before[-1:] or items[:1]
        free = next((item for item in items if item not in before), items[-1])
        one = next((item for item in items if self._is_there(at, item)), free)
        world.singled.append(one)
        if NEARNESS & {*(place := self._chunks[at + 1].text.lower()).split()}:
            said = f"{phrase.words} {place} {self._chunks[at + 2].text}"
            world.note(f'"{said}" is read as one of {len(group.items)}, next to it; how near the others are is open.')
        return [one]

    def _at(self, items: list[Item], where: str, phrase: Phrase) -> list[Item]:
        index = len(items) // 2 if where in ("middle", "center", "centre") else PLACES[where]
        if not -len(items) <= index < len(items):
            if where in COUNTED and (more := self._next_of(items[0].group, index, phrase)):
                return more
            self._world.note(f'"{phrase.words}": there are only {len(items)}.')
            return items[-1:]
        item = items[index]
        if where in OPPOSITE and item.place in OPPOSITE and item.place != where:
            # "The left one is red, the front one is blue": another one.
            item = next((one for one in items if not one.place), item)
        item.place, item.placed_by = where, phrase.words
        tell(item, phrase.modifiers)
        if not item.group.rows and item.group.height == 1:
            line_up(self._world, item)
        return [item]

    def _other_of_two(self, at: int) -> list[Item]:
        """What "the other" at chunk `at` is of two of a kind, of which one was spoken of last: of mugs, and no spoon.

        "Put the red mug on the shelf and the spoon in the other."
        """
        pairs = [(one, other) for one, other in self.related if at in one | other]
        beside = {head for one, other in pairs for head in one | other}
        landmark = any(at in other for _, other in pairs)
        sides = {head for one, other in self.related for head in (other if landmark else one)}
        heads = sorted((head for head in self.known if head < at and head not in beside), reverse=True)
        heads.sort(key=lambda head: head not in sides)
        steps = [list(step.items) for step in self._world.steps[-1:]]
        apart = {item.group.noun for head in beside - {at} for item in self.known.get(head, ())}
        for items in (*(self.known[head] for head in heads), *steps, self._world.subject):
            if len(items) != 1 or items[0].group.noun in apart or items[0].group.height > 1:
                continue
            name = items[0].group.said.split()[-1:]
            alike = [one for one in self._world.items() if one.group.said.split()[-1:] == name]
            for pair in (alike, self._world.together):
                if len(pair) == 2 and items[0] in pair:
                    return [one for one in pair if one is not items[0]]
        return []

    def _those_there(self, at: int, phrase: Phrase) -> list[Item]:
        """What "the ones on the table" at chunk `at`, or "the one without", are of what a sentence before has named."""
        world = self._world
        if phrase.words.lower() not in ("the one", "the ones"):
            return []
        items = [item for group in world.groups[: world.settled] if not group.replaced for item in group.items]
        there = [item for item in items if self._is_there(at, item, held=True)]
        if phrase.head == "without":
            likes = [item for item in items if sum(one.group.noun == item.group.noun for one in items) > 1]
            bare = [item for item in likes if not any(edge.parent is item for edge in world.supports.values())]
            there = bare if len(bare) < len(likes) else []
        about = [item for item in there if world.subject and item.group.noun == world.subject[0].group.noun]
        alike = [item for item in about or there if item.group.noun == (about or there)[0].group.noun]
        return alike if phrase.words.lower() == "the ones" or len(alike) == 1 else []

    def _by_place(self, groups: Sequence[Group], phrase: Phrase) -> list[Item]:
        """Which of several that were named one by one a place tells: "a red cup and a blue cup ... the left cup"."""
        world, where = self._world, position(phrase)
        items = [item for group in groups for item in group.items]
        bare = replace(phrase.modifiers, adjectives=()) == NO_MODIFIERS and not phrase.plural
        if where not in lexicon.POSITIONS or not bare or not len(items) == len(groups) > 1:
            return []
        if any(item.place for item in items):
            return []
        if where not in COUNTED and len({world.support(item) for item in items} - {None}) > 1:
            world.note(f'not arranged: "{phrase.words}"')
            return []
        known = len(world.laterals)
        one = one_of_unlike(world, items, where) or self._at(from_the_front(world, items), where, phrase)
        if (where not in COUNTED and len(world.laterals) > known) or (where in OPPOSITE and not known):
            world.note(f'assumed: "{phrase.words}" is "{one[0].group.words}"')
        return one

    def _of_contents(self, at: int, phrase: Phrase) -> list[Item]:
        """The jar of "the jar of nuts" at chunk `at`, or the nuts of that, where both were named before."""
        ours = self._contents(at) if phrase.definite else set[str]()
        named = [one for one in reversed(self._world.groups) if same_noun(one, phrase) or same_head(one, phrase)]
        for group in named:
            of_it = phrase.definite and bool(phrase.substance) and phrase.substance == group.phrase.substance
            if of_it or ours & self._held(group):
                return list(group.items)
        owners = self.known.get(at - 2, ()) if at > 1 and self._chunks[at - 1].text == "of" else ()
        again = owners and self._chunks[at - 2].named.definite and phrase.count is None
        held = [edge.child for edge in self._world.supports.values() if again and edge.parent in owners]
        return [item for item in held if item.group in named]

    def _held(self, group: Group) -> set[str]:
        """The nouns of what is in or on `group`."""
        return {self._world.noun(edge.child) for edge in self._world.supports.values() if edge.parent in group.items}

    def _holds_others(self, at: int, group: Group) -> bool:
        """Whether chunk `at` is told by what is in it, and `group` by something else: "the jar with the nuts"."""
        ours = self._contents(at)
        heads = [head for head, items in self.known.items() if items and items[0].group is group]
        theirs = {noun for head in heads for noun in self._contents(head)} | self._held(group)
        other = ours and theirs and not ours & theirs and len(group.items) == 1
        return bool(other) and self._world.likely.hollow(group.noun)

    def _contents(self, at: int) -> set[str]:
        """The noun of the apples of "the bowl with the apples", "the bowl of apples" at chunk `at`; none without."""
        have, thing = (*self._chunks[at + 1 : at + 3], None, None)[:2]
        named = have is not None and have.text in ("with", "of") and thing is not None and thing.phrase is not None
        return {thing.phrase.noun} - {""} if named else set()  # type: ignore[union-attr]
