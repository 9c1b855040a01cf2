"""Which of several things a phrase speaks of: "the second", "the red ones", "the other two", "another"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.by_place import ByPlace
from pat3d.plan.grammar.meaning.counting import recount, tell_colours
from pat3d.plan.grammar.meaning.described import tell
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.likes import SHAPES, measured
from pat3d.plan.grammar.meaning.matching import (
    ALONG,
    COUNTED,
    OPPOSITE,
    SAME,
    colours_of,
    is_numbered,
    position,
    same_noun,
)
from pat3d.plan.grammar.meaning.unlike import one_of_unlike
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS, TONES

_APART = 0.7
"""What it costs where only some of those of which "each" speaks are on a tray, or one of them is on "each"."""
_REST = frozenset({"other", "others", "rest", "remaining", "remainder"})
_ENUMERATED = {"former": 0, "latter": 1}
_LARGER = frozenset({"largest", "biggest", "larger", "bigger", "tallest", "taller", "large", "big", "tall"})
_SMALLER = frozenset({"smallest", "smaller", "littlest", "shortest", "shorter", "tiniest", "small", "little"})


def _told_apart(group: Group) -> bool:
    """Whether members of `group` are told by their colours."""
    return len(group.items) > 1 and not group.modifiers.colours and any(colours_of(item) for item in group.items)


class Members(ByPlace):
    """Chooses members among what was named."""

    def _rest_of(self, phrase: Phrase) -> list[Item]:
        """The other cups of which one or some were told apart: "one of three cups ..., the other two cups"."""
        for group in (group for group in reversed(self._world.groups) if same_noun(group, phrase)):
            untold = [item for item in self._world.telling if item in group.items]
            if group.phrase.some == 1:
                untold = group.items[1:]
            elif group.phrase.superlative != NO_MODIFIERS:
                untold = [item for item in group.items if not (item.place or item.told.size_word)]
            elif not untold and group.counted and not group.cycle:
                # "Three boxes in a row; the second box holds a ball, the other boxes are empty."
                untold = [item for item in group.items if not item.place]
            if untold and len(untold) < len(group.items) and len(untold) >= (phrase.count or 1):
                return untold[: phrase.count or (None if phrase.plural else 1)]
        return []

    def _besides(self, at: int) -> set[Group]:
        """Groups that other phrases name, to which chunk `at` is related."""
        partners = {head for one, other in self.related for head in (*one, *other) if at in (*one, *other)} - {at}
        named = [head for head in partners if head < at and self._chunks[head].phrase.kind in ("object", "unknown")]  # type: ignore[union-attr]
        return {item.group for head in named for item in self.known.get(head, ())}

    def _chosen(self, group: Group, phrase: Phrase, told: int | None = None) -> list[Item]:
        """The members of `group` that `phrase` speaks of; none where it cannot be meant."""
        if self._told_otherwise(group, phrase):
            return []
        items, where = group.items, position(phrase)
        told_by = phrase.modifiers
        wanted = {*told_by.colours[:1], *(told_by.palette if told_by.palette_word in TONES else ())}
        if wanted:
            own = [item for item in items if wanted & {*colours_of(item)}]
            blank = [item for item in items if not colours_of(item)]
            items = own or (blank if len(items) == len(blank) else [])
        if phrase.count is not None and phrase.count > len(items):
            return []
        placed = [item for item in items if item.place == where] if where else []
        if placed:
            return placed
        if where and any(item.place for item in items):
            if len(items) == 1:
                return []
            # "The left cup is red, the middle one blue": the middle of all.
            items = items if where in ALONG or where in COUNTED else [item for item in items if not item.place]
        piled = items and where in lexicon.LEVELS and not self.asked and self._world.is_a(items[0], lexicon.PILES)
        if piled and phrase.modifiers.stacked and items == group.items and group.height == 1:
            # "Books lie on a bed. The book at the bottom of the pile is white."
            group.height = len(items)
            for item in items[1:]:
                self._world.supports.pop(item, None)
        ranked = piled or group.height > 1 or where not in lexicon.LEVELS
        if where and len(items) > 1 and not phrase.plural and ranked:
            return self._at(items, where, phrase)
        size = phrase.modifiers.size_word
        if size and group.modifiers.size_word and size != group.modifiers.size_word:
            return []
        if phrase.definite and not phrase.plural and len(items) > 1 and group.height == 1:
            items = self._told_by_size(items, phrase)
        # "Two loaves of bread and a board, with the bread on the board"
        portions = phrase.definite and f" of {phrase.head}" in group.phrase.words.lower()
        if phrase.plural or len(items) == 1 or group.height > 1 or (portions and not where and phrase.count is None):
            return list(items)
        if wanted:
            return items[: phrase.count or 1]
        return self._singled(items, phrase, told)

    def _members(self, at: int, phrase: Phrase) -> list[Item]:
        """The members that a headless phrase ("one", "the red one", "the other two") speaks of."""
        world = self._world
        if phrase.said == "stack":
            towers = [group for group in world.groups if group.height > 1]
            if any(piece.kind == "form" and piece.text in ("stack", "tower") for piece in self._chunks[:at]):
                # "Three books are stacked on a desk, with a cup on the stack"
                towers += self._plural_before(at)[:1]
            return list(towers[-1].items) if towers and phrase.definite else []
        words, where = phrase.modifiers, position(phrase)
        groups = [*self._plural_before(at), *([world.subject[0].group] if world.subject else [])]
        groups += [group for group in reversed(world.groups) if not group.replaced]
        if phrase.words.lower() in ("that one", "that", "this"):
            single = [
                items for head, items in sorted(self.known.items(), reverse=True) if head < at and len(items) == 1
            ]
            before = [group.items for group in reversed(world.groups) if len(group.items) == 1 and not group.replaced]
            link, named = self._chunks[at - 1].link if at else None, single or before
            # "A crate is on a pallet. Inside that is a jar."
            inside = link is not None and link.kind == "in"
            hollow = [one for one in named if inside and world.is_a(one[0], vessels.HOLLOW, vessels.HOLDERS)]
            return next(iter(hollow or named), [])
        together = words == NO_MODIFIERS and not any(head < at for head in self.known)
        if together and phrase.definite and phrase.count == len(world.together) > 1:
            # "A cup and a jar are on the desk. Put both in the box."
            return list(world.together)
        if more := self._further(at, phrase):
            return more
        if phrase.definite and not phrase.plural and (there := self._told_by_side(at)):
            # "A cup behind the plate and a cup behind the jar. The one behind the plate is red."
            return there
        if (there := self._those_there(at, phrase)) or phrase.head == "without":
            return there
        if phrase.words.lower() == "the one" and (carrier := self._other_carrier(at, phrase)):
            return carrier
        counted = phrase.definite and phrase.count is not None and len(phrase.words.split()) == 2
        if (phrase.words.lower() == "the one" or counted) and (subject := self._subject_before(at)):
            # "The book on the chair is red, the one on the desk is blue": another book.
            return self._one_like(subject, phrase)
        if not phrase.definite and phrase.count:
            # "Two trays: ... on the second, two cups": of the trays none.
            upon = [item.group for one, other in self.related if at in one for head in other for item in self.ref(head)]
            groups = [group for group in groups if group not in upon]
        if where or (not words.colours and (words.size_word or phrase.head == "one")):
            besides = self._besides(at)
            # "the smaller of two boxes inside the larger one"
            pairs = {group for group in besides if words.size_word and len(group.items) > 1}
            groups = [group for group in groups if group not in besides or group in pairs]
            # "Two boxes ... Two balls are in the larger one": of the boxes.
            groups.sort(key=lambda group: group in besides)
        rest = phrase.head in _REST or (phrase.other and phrase.definite)
        if phrase.head in _ENUMERATED:
            told = self._earlier or [group for group in world.groups if group.items]
            # "A mug and a jar are on a shelf": of the two, not of what they are on.
            below = {below.group for group in told for item in group.items for below in world.ancestors(item)}
            told = [group for group in told if group not in below] or told
            told = told[-2:] if self._earlier else told[:2]
            return list(told[_ENUMERATED[phrase.head]].items) if len(told) == 2 else []
        listed = self._enumerated(at) if is_numbered(phrase) else []
        if len(listed) > max(1, COUNTED.get(where, 0)) and len({item.group for item in listed}) == len(listed):
            # "A cup and a bowl: the first is red, the second one holds an egg."
            found = listed[COUNTED[where] :][:1]
            for item in found:
                tell(item, replace(words, adjectives=()))
            return found
        if phrase.head in ("both", "all"):
            self.all.add(at)
            before = self._that_have(at, self._before(at))
            if len(before) != 1:
                return before
            # "A bench holds a pen and a ruler. Both are pink.", "A cup is by a jar. Both are pink.": of one are no two.
            by = [edge.parent for edge in world.laterals if edge.child is before[0]] if phrase.head == "both" else []
            return self.carried_by(before) or (before + by if len(by) == 1 else before)
        if phrase.head == "each":
            self.each.add(at)
            besides = self._besides(at)
            named = self._plural_before(at)
            plural = [group for group in named if group not in besides]
            # Nothing is on each of itself.
            self.cost += _APART if named and not plural else 0.0
            listed = [head for heads in self.clauses.values() for head in heads if head < at and self.known.get(head)]
            listed = [head for head in listed if not any(item.group in besides for item in self.known[head])]
            counts = [len(self.known[head]) > 1 for head in listed]
            alike = any(counts) and len(plural) == sum(counts) and self._alike([self.known[head][0] for head in listed])
            if len(listed) > 1 and (all(counts) or alike):
                # "Two mugs and two bowls, each with a spoon", "two red cups and a blue one, with a spoon in each"
                apart = any(one & {*listed} and not {*listed} <= one for one, _ in self.related)
                onto = any(one & {*listed} and at in other for one, other in self.related)
                self.cost += _APART * (apart + onto)
                return self._that_have(at, [item for head in listed for item in self.known[head]])
            # "At each end of a desk is a lamp, a cup right of each": no cup is right of a cup.
            subject = [item for item in self._before(at) if item.group not in besides] or self._before(at)
            again = [head for head in self.known if head < at and self._chunks[head].named.each]
            if again and self.known[again[-1]] and self.known[again[-1]][0].group not in besides:
                # "A fork left of each plate and a knife right of each": of each plate.
                subject = self.known[again[-1]]
            subject = list(plural[0].items) if plural else subject
            return list(subject[0].group.items) if len(subject) == 1 else self._that_have(at, subject)
        if rest:
            # "One of the bowls holds keys and the other one holds nuts": of the bowls.
            groups.sort(key=lambda group: not group.phrase.some)
        if rest and world.telling:
            self._two(phrase)
            told = world.telling[: phrase.count or len(world.telling)]
            world.telling = world.telling[len(told) :]
            return told
        if rest and (left := self._left_over(at, phrase) or self._unplaced(groups, phrase)):
            return left
        single = phrase.words.lower() in ("the other", "the other one")
        if rest and single and (other := self._other_of_two(at)):
            return other
        if rest and (told := self._untold(at, phrase)) is not None:
            return told
        count = phrase.count or 1
        if where:
            # "On the first are three cups, on the second ...": of the same kind as before.
            groups.sort(key=lambda group: not any(item.place for item in group.items))
        if where in lexicon.LEVELS:
            # What is stacked is often said after it is named.
            several = [group for group in groups if len(group.items) > 1]
            tower = next((group for group in several if group.height > 1), next(iter(several), None))
            return self._at(tower.items, where, phrase) if tower is not None else []
        if where in COUNTED or (where in ("left", "right") and "one" in phrase.words.lower().split()):
            # "The left tray carries three muffins, the right one a knife", "Books fill the top shelf; the second ...":
            # another tray, another shelf.
            others = {*COUNTED, *lexicon.LEVELS} - {where} if where in COUNTED else {OPPOSITE[where]}
            beside = [group for group in groups if len(group.items) == 1 and group.items[0].place in others]
            if beside:
                return self._one_like(beside[0].items, phrase)
        if self.asked and where and phrase.definite and (one := one_of_unlike(world, world.together, where)):
            return one
        if (like := self._partner(at, phrase)) is not None:
            return self._one_like(like, phrase)
        if where and words.colours:
            # "Four cans in a line, the second one blue"
            line = next((group for group in groups if len(group.items) > 1 and group.height == 1), None)
            behind = phrase.closing not in ("one", "ones", phrase.said)
            alike = line is not None and any(words.colours[0] in colours_of(item) for item in line.items)
            if line is not None and (behind or not alike):
                return self._numbered(at, line, where, phrase)
        compared = bool({*words.adjectives} & (_LARGER | _SMALLER | (SHAPES if phrase.definite else set())))
        if words.colours or words.palette or words.size_word or compared:
            return self._described(phrase, groups, count)
        if world.telling and len(world.telling) >= count and not where:
            told, world.telling = world.telling[:count], world.telling[count:]
            return told
        whole = next((group for group in groups if len(group.items) > count and group.height == 1), None)
        if whole is None:
            whole = next((group for group in groups if len(group.items) >= count), None)
            tall = next((group for group in groups if where and len(group.items) > count), None)
            if tall is not None:
                return self._at(tall.items, where, phrase)
            if where in COUNTED and where != "first":
                # "A box holds a pen and a ruler. The second one is red.": nothing named is one of several.
                return []
            return list(whole.items[:count]) if whole is not None else []
        if where:
            return self._numbered(at, whole, where, phrase)
        if rest:
            free = [item for item in whole.items if world.support(item) is None] or whole.items
            count = count if phrase.count or phrase.head == "other" else len(free)
            return list(free[len(free) - count :])
        world.telling = whole.items[count:]
        return list(whole.items[:count])

    def _numbered(self, at: int, group: Group, where: str, phrase: Phrase) -> list[Item]:
        """The one of `group` at `where`; with a note where other things were named with it.

        "Two cans and a mug. The last one is blue." may be told of the mug.
        """
        found = self._at(group.items, where, phrase)
        if is_numbered(phrase) and {*found} <= {*group.items} and len({item.group for item in self._before(at)}) > 1:
            self._world.note(f'"{phrase.words}" is read as one of "{group.words}".')
        return found

    def _two(self, phrase: Phrase) -> None:
        """Leave two of several of which no number is said, where "the other" is said of them: "one of the steaks"."""
        group = self._world.telling[0].group
        some = len(group.items) - len(self._world.telling)
        single = phrase.head == "other" and phrase.count is None and not phrase.plural
        if single and some == 1 and len(group.items) > 2 and not (group.counted or group.cycle):
            recount(self._world, group, 2)
            self._world.telling = self._world.telling[:1]

    def _described(self, phrase: Phrase, groups: list[Group], count: int) -> list[Item]:
        """Members told by colour or size: "one red and one blue", "two of them yellow", "the larger one"."""
        words = phrase.modifiers
        wanted = len(self._world.items()) if phrase.closing == "ones" else 1
        for shape in {*measured(words).adjectives} & SHAPES if phrase.definite else ():
            # "A tall vase and a short vase, the shorter one"
            own = [item for item in self._world.items()
                   if shape in (*item.told.adjectives, *item.group.modifiers.adjectives)]  # fmt: skip
            if own:
                return own[:wanted]
        if words.size_word and not words.colours:
            sizes = {item: item.told.size_word or group.modifiers.size_word for group in groups for item in group.items}
            alike = next((kind for kind in (_LARGER, _SMALLER) if words.size_word in kind), frozenset[str]())
            if own := [item for item, size in sizes.items() if size in alike]:
                return own[:wanted]
            groups = [group for group in groups if len(group.items) > 1]
            apart = [group for group in groups if group.modifiers.size_word not in ("", words.size_word)]
            if apart and len(apart) == len(groups):
                # "The two smaller bowls inside the big one": another bowl.
                return self._one_like(apart[0].items, phrase)
        for group in groups:
            own = [item for item in group.items if words.colours and words.colours[0] in colours_of(item)]
            if own and phrase.definite:
                if not (phrase.plural or phrase.words.lower().endswith(" ones")):
                    return own[:count]
                # "The red ones are stacked, the rest ..."
                self._world.telling = [item for item in group.items if item not in own]
                return own[: phrase.count]
        if phrase.definite and words.colours:
            # "Two buckets: the green one holds three balls, the red one is empty": of those told by colour.
            groups = sorted(groups, key=lambda group: not _told_apart(group))
        whole = next((group for group in groups if len(group.items) > 1), groups[0] if groups else None)
        if whole is None:
            return []
        told = next((group for group in self._world.groups[::-1] if group.modifiers.colours), None)
        anew = phrase.determined and len(whole.items) == 1 and not colours_of(whole.items[0])
        if words.colours and anew and told is not None and told is not whole:
            # "a red ball in the left box and the blue one in the right box": of what has another colour.
            whole = told
        if (
            words.palette
            or (not phrase.determined and phrase.count is None)
            or (phrase.plural and phrase.count is None)
        ):
            tell_colours(self._world, whole, words)
            return list(whole.items)
        free = [item for item in whole.items if not colours_of(item) and not item.told.size_word]
        known = {colour for item in whole.items for colour in colours_of(item)}
        if phrase.closing in ("one", "ones") and words.colours and known and not free:
            # "a blue cube and the yellow one": one more of the kind.
            own = [item for item in whole.items if words.colours[0] in colours_of(item)]
            if own and not phrase.definite and whole.exact and len(whole.items) > 1:
                # "Four cubes: two red, a blue and a white one on a red one": of those that were counted.
                return own[:count]
            several = phrase.plural or count > 1 or phrase.words.endswith("ones")
            more = replace(whole.phrase, words=phrase.words, count=phrase.count,
                           plural=several, modifiers=words, definite=phrase.definite)  # fmt: skip
            return list(self._maker.make(self._world, more).items)
        picked = ([item for item in free if item in self._world.telling] or free)[:count]
        for item in picked:
            tell(item, words)
        self._world.telling = [item for item in free if item not in picked]
        return picked or list(whole.items[:count])

    def _the_one(self, items: list[Item], phrase: Phrase) -> list[Item]:
        """The one of `items` that "the smallest of", "the second of" means; all where it tells none."""
        told = phrase.superlative
        where = next(iter(told.adjectives), "")
        if where:
            return self._at(items, SAME.get(where, where), replace(phrase, modifiers=told))
        if told.size_word:
            tell(items[0], told)
        if 0 < phrase.some < len(items):
            items = self._free(items, phrase.some)
            self._world.telling = items[phrase.some :]
        return items[: phrase.some or 1] if told.size_word or phrase.some else list(items)

    def _alike(self, items: Sequence[Item]) -> bool:
        """Whether `items` are of one kind, or all of them vessels, so that what each has may be had by all."""
        return len({item.group.noun for item in items}) == 1 or all(
            self._world.is_a(item, vessels.HOLLOW) for item in items
        )
