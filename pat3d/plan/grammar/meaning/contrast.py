"""What tells one object from another of its kind: another noun before it, another place behind it, "the one on ..."."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.described import tell
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.likes import SHAPES, compared_anew, measured, oppositely_sized
from pat3d.plan.grammar.meaning.matching import colours_of, is_numbered, line_up, position
from pat3d.plan.grammar.meaning.ones import coloured_like
from pat3d.plan.grammar.meaning.others import Others
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS
from pat3d.scene.relations import LATERAL_KINDS, OPPOSITE, SUPPORT_KINDS, LateralKind

_ALONE = ("fridge", "microwave", "dishwasher")
"""What there is one of: "the fridge" is the refrigerator that was named."""


class Contrast(Others):
    """Whether phrases of one kind speak of different objects."""

    def _told_by_noun(self, one: Phrase, other: Phrase) -> bool:
        """Whether another noun tells the two apart: "the cat figurine" and "the dog figurine"."""
        words = (one.modifiers.adjectives, other.modifiers.adjectives)
        ours, theirs = ({word for word in each if self._maker.is_thing(word)} for each in words)
        return bool(ours and theirs) and not ours & theirs

    def _told_otherwise(self, group: Group, phrase: Phrase) -> bool:
        """Whether `phrase` describes what is no member of `group`: "the plastic cup" after "the glass cup".

        What is named twice in one sentence by other words is two things: "the hamper" and "the laundry basket".
        """
        ours, theirs = measured(group.modifiers), measured(phrase.modifiers)
        shades = [lexicon.SHADE_WORDS if each.colours or each.material else set() for each in (ours, theirs)]
        looks = [{*each.adjectives} - lexicon.SAID_OTHERWISE - shade
                 for each, shade in zip((ours, theirs), shades, strict=True)]  # fmt: skip
        if ours.material and theirs.material and ours.material != theirs.material:
            return True
        if any(pair & looks[0] and pair & looks[1] and not pair & looks[0] & looks[1] for pair in lexicon.OPPOSITES):
            return True
        if oppositely_sized(group.said, theirs.scale) or oppositely_sized(phrase.said or phrase.head, ours.scale):
            return True
        if compared_anew(phrase, [item for item in self._world.items() if item.group.noun == group.noun]):
            return True
        if phrase.definite and any(self._is_just_that(other, group, phrase) for other in self._world.groups):
            return True
        if not group.phrase.definite or group not in self._world.groups[self._world.settled :]:
            return False
        names = {phrase.said or phrase.head, group.said}
        part = names & (lexicon.STORAGE_PARTS | lexicon.DETACHED | lexicon.DRAWERS) or phrase.part or group.phrase.part
        part = part or self._world.is_a(group.items[0], _ALONE)
        renamed = not part and len({name.split()[-1] for name in names}) > 1 and group.noun == phrase.noun
        return renamed or bool(looks[0] and looks[1] and not looks[0] & looks[1])

    def _is_just_that(self, other: Group, group: Group, phrase: Phrase) -> bool:
        """Whether `other` is said to be of the size or material of `phrase`, and `group` of none.

        "The large comb" after "a large comb and a comb" is the first.
        """
        if other is group or other.noun != phrase.noun or other.replaced:
            return False
        said, ours, theirs = phrase.modifiers, group.modifiers, other.modifiers
        size = said.size_word == theirs.size_word != "" and not ours.size_word
        return size or (said.material is not None and said.material == theirs.material and not ours.material)

    def _listed_apart(self, at: int, group: Group, phrase: Phrase) -> bool:
        """Whether chunk `at` is listed with a thing of `group` and told from it: "the red cup and the tall cup"."""
        listed = at > 1 and self._chunks[at - 1].kind == "joint" and self._chunks[at - 1].text in ("and", ",")
        before = at - 2
        link = self._chunks[at - 3].link if at > 3 and not self.known.get(before) else None
        # "The mug with a printed text and the tall mug"
        before -= 2 * (link is not None and link.manner == "with")
        if not listed or group not in {item.group for item in self.known.get(before, ())}:
            return False
        behind = self._chunks[at + 1] if at + 1 < len(self._chunks) else None
        closer = {"with it"} if behind is not None and behind.link and behind.link.manner == "with" else set[str]()
        ours, theirs = _looks(group.phrase), _looks(phrase) | closer
        return group.phrase.definite and bool(ours - theirs and theirs - ours)

    @staticmethod
    def _told_by_size(items: list[Item], phrase: Phrase) -> list[Item]:
        """The one of `items` that is "the small box", or "the tallest box"; all where `phrase` gives no size."""
        words = measured(phrase.modifiers)
        shape = {*words.adjectives} & SHAPES
        if not words.size_word and not shape:
            return items
        own = items[0].group.modifiers
        own_size = words.size_word if words.size_word else next(iter(shape))
        if own_size in (own.size_word, *own.adjectives):
            return items
        told = [item for item in items if own_size in (item.told.size_word, *item.told.adjectives)]
        free = [item for item in items if not item.told.size_word and not {*item.told.adjectives} & SHAPES]
        for item in () if told else free[:1]:
            tell(item, words)
            item.told = replace(item.told, adjectives=(*item.told.adjectives, *shape))
        return told[:1] or free[:1] or items

    def _any_of(self, at: int, phrase: Phrase) -> list[Item] | None:
        """One of several that a sentence before has named, where "a box" is what something is in, or is to be moved."""
        plain = phrase.modifiers == NO_MODIFIERS == phrase.superlative
        first = phrase.words.lower().split()[:1]
        # "Put one apple in the bowl and two in the box" is of the three apples that are there.
        of_each = any(piece.phrase is not None and piece.phrase.each for piece in self._chunks)
        some = self.asked and first and first[0] in lexicon.NUMBERS and (not of_each or phrase.count == 1)
        plain = plain and bool(some or first in (["a"], ["an"]))
        if not plain or phrase.definite or phrase.cycle or phrase.part:
            return None
        count = phrase.count or 1
        if not some and (phrase.plural or count != 1):
            return None
        named = self._world.groups[: self._world.settled]
        likes = [group for group in named if group.noun == phrase.noun and group.said == phrase.said]
        least = count + (count == 1)
        likes = [group for group in likes if len(group.items) >= least and not group.replaced and group.height == 1]
        child = any(at in one for one, _ in self.related)
        parent = any(at in other for _, other in self.related)
        if not likes or not (self.asked or (parent and not child)):
            return None
        among = {head for one, other in self.related if at in other for head in one}
        if any(self._chunks[head].named.each for head in among):
            # "Each ball is in a box": every one in its own.
            several = {len(self.known.get(head, ())) for head in among}
            return list(likes[-1].items) if several == {len(likes[-1].items)} else None
        carried = {
            below: item for item in reversed(likes[-1].items) if (below := self._world.support(item)) is not None
        }
        if of_each:
            # "Take one cookie from each plate": of those that are on it.
            return list(carried.values())[::-1] if len(carried) > 1 else None
        if some:
            self._world.telling = likes[-1].items[count:]
        return likes[-1].items[:count]

    def _free(self, items: list[Item], count: int) -> list[Item]:
        """Those of `items` of which nothing was said or asked yet, where they are `count` at least; all otherwise."""
        taken = {item for head in self.known for item in self.known[head] if len(self.known[head]) < len(items)}
        taken |= {item for step in self._world.steps if self.asked for item in step.items}
        free = [item for item in items if item not in taken]
        return free if len(free) >= count else items

    def _elsewhere(self, at: int, group: Group) -> bool:
        """Whether `group` was told by another place than chunk `at`: "the cup on the tray, the cup on the mat"."""
        told, item = self._place_of(at), group.items[0]
        edge = self._world.supports.get(item)
        if told is not None and told[0][0] in SUPPORT_KINDS and edge is not None and len(group.items) == 1:
            # "The mug on the table is red. The mug on the shelf is blue."
            above = self._world.ancestors(item)
            carriers = {word for one in above for word in (self._world.noun(one), one.group.said)}
            return not edge.weak and told[1] not in carriers and not self._is_pronoun(at + 2)
        if told is not None and told[0][0] in LATERAL_KINDS and len(group.items) == 1 and not self._is_there(at, item):
            # "A cup behind the plate and a cup behind the jar": "the cup behind the plate" is not the second.
            likes = [one for one in self._world.items() if one.group.noun == group.noun]
            if any(self._is_there(at, one) for one in likes):
                return True
        heads = [head for head, items in self.known.items() if items and items[0].group is group]
        before = next((place for head in heads if (place := self._place_of(head)) is not None), None)
        if told is not None and before is not None and told[0] == before[0] and before[1] in lexicon.PRONOUNS:
            # "A plate with a bun on it, and a fork next to the bun on the plate"
            return False
        return told is not None and before is not None and told != before

    def _place_of(self, at: int) -> tuple[tuple[str | None, str], str] | None:
        """The relation word right behind chunk `at`, and what follows that, where no verb comes between."""
        if (behind := self._behind(at)) is None:
            return None
        link, phrase = behind
        return (link.kind, link.manner), phrase.noun or phrase.head

    def _behind(self, at: int) -> tuple[Link, Phrase] | None:
        """The relation that tells which one chunk `at` is, and of what it is told."""
        behind = self._chunks[at + 1 : at + 3]
        if self.asked and [piece.kind for piece in behind] == ["which", "verb"]:
            # "Take the cup that is on the book"
            behind = self._chunks[at + 3 : at + 5]
        if at + 1 in self.goals:
            return None
        if [piece.kind for piece in behind] != ["rel", "noun"] or behind[0].relation.manner in ("goal", "source"):
            return None
        return behind[0].relation, behind[1].named

    def _is_there(self, at: int, item: Item, *, held: bool = False) -> bool:
        """Whether `item` was told to stand where the relation right behind chunk `at` says."""
        behind, edge = self._behind(at), self._world.supports.get(item)
        if behind is not None and (self.asked or held) and edge is not None and edge.kind == behind[0].kind:
            # "Grab the one on the napkin": of two spoons the one that is there already.
            return (behind[1].noun or behind[1].head) in (edge.parent.group.noun, edge.parent.group.said)
        if behind is None or behind[0].kind not in LATERAL_KINDS:
            return False
        link, phrase = behind
        kind, name, colours = cast(LateralKind, link.kind), phrase.noun or phrase.head, phrase.modifiers.colours
        near = [edge.parent for edge in self._world.laterals if edge.child is item and edge.kind == kind]
        near += [edge.child for edge in self._world.laterals if edge.parent is item and edge.kind == OPPOSITE[kind]]
        return any(name in (one.group.noun, one.group.said) and {*colours} <= {*colours_of(one)} for one in near)

    def _told_by_side(self, at: int) -> list[Item]:
        """The one of several alike of which it was told that it stands where chunk `at` is said to stand."""
        there = [item for item in self._world.items() if self._is_there(at, item)]
        alike = [one for one in self._world.items() if there and one.group.noun == there[0].group.noun]
        return there if len(there) == 1 < len(alike) else []

    def _tells_place(self, at: int) -> bool:
        """Whether a relation to the side right behind chunk `at` tells which one of several it is."""
        told = self._place_of(at)
        return told is not None and told[0][0] in LATERAL_KINDS and not self._chunks[at + 1].relation.finite

    def _subject_before(self, at: int) -> list[Item]:
        """The one object that the sentence before chunk `at` tells the place of, as it does of chunk `at`."""
        told = [head for one, _ in self.related for head in sorted(one)]
        phrases = [self._chunks[head].phrase for head in told if head < at]
        held = {head for _, other in self.related for head in other}
        first = min((head for head in told if head < at), default=at)
        several = [
            head for head, items in self.known.items() if first < head < at and head not in held and len(items) > 1
        ]
        named = {head for pair in self.related for side in pair for head in side}
        if at not in named or not phrases or phrases[0] is None or several:
            return []
        items = self.ref(min(head for head in told if head < at))
        wanted = self._chunks[at].named.count or 1
        whole = bool(items) and len(items) == wanted == len(items[0].group.items)
        return items if phrases[0].kind == "object" and whole else []

    def _partner(self, at: int, phrase: Phrase) -> list[Item] | None:
        """The one object that "an empty one" at chunk `at` is related to, and so is of the kind of."""
        if phrase.opening not in ("a", "an") or phrase.modifiers == NO_MODIFIERS:
            return None
        pairs = [one | other for one, other in self.related if at in one | other]
        heads = sorted(head for pair in pairs for head in pair if head < at)
        named = self.known.get(heads[0], []) if heads else []
        if (like := coloured_like(self._world, self._chunks, at, named)) is not None:
            return None if len(like.group.items) > 1 else [like]
        return named if len(named) == 1 == len(named[0].group.items) else None

    def _one_like(self, items: list[Item], phrase: Phrase) -> list[Item]:
        like = replace(items[0].group.phrase, words=phrase.words, modifiers=phrase.modifiers, definite=False,
                       count=phrase.count or 1)  # fmt: skip
        items = list(self._maker.make(self._world, like).items)
        items[0].place, items[0].placed_by = position(phrase), phrase.words
        line_up(self._world, items[0])
        return items

    def _further(self, at: int, phrase: Phrase) -> list[Item]:
        """More of what the clause before has put elsewhere: "five pens are in a cup and two on the table"."""
        number = phrase.words.lower() in lexicon.NUMBERS or phrase.words.isdecimal()
        place = self._carrying(at)
        before = [head for head in range(at) if self._chunks[head].kind == "noun"]
        if not number or phrase.definite or place is None or any(self._chunks[n].text == ":" for n in range(at)):
            return []
        whole = next((head for head in before if self._counted(head)), None)
        pieces = any(phrase.kind == "pieces" and not is_numbered(phrase)
                     for phrase in (self._chunks[head].named for head in before))  # fmt: skip
        first = self._carrying(whole) if whole is not None else None
        there = self.ref(place)
        upon = self._world.support(self._world.subject[0]) if self._world.subject and before == [place] else None
        if upon is not None and upon not in there and any(upon in item.group.items for item in there):
            # "On the first are three cups; on the second, two"
            items = self._world.subject
        elif whole is None or first is None or pieces or self._carrying(first) is not None or place == first:
            return []
        else:
            items = self.known[whole]
        group = items[0].group
        more = self._one_like(items, replace(phrase, modifiers=group.modifiers))
        total = len(items) + len(more)
        told = "are read as further ones" if len(more) > 1 else "is read as a further one"
        self._world.note(f'"{phrase.words}" behind "{group.words}" {told}, {total} in all.')
        return more

    def _counted(self, at: int) -> bool:
        """Whether chunk `at` names all of several things by their number."""
        items = self.known.get(at, [])
        group = items[0].group if items else None
        return group is not None and 1 < len(items) == len(group.items) and group.exact and not group.phrase.definite

    def _carrying(self, at: int) -> int | None:
        """The chunk that names what carries chunk `at`, or what it is beside where that is a pronoun."""
        for one, other in self.related:
            parent = min(other, default=0)
            link = self._chunks[parent - 1].link if at in one and parent else None
            if link is not None and not link.inverse and (link.kind in SUPPORT_KINDS or self._is_pronoun(parent)):
                return parent
        return None

    def _all_of(self, at: int, phrase: Phrase) -> bool:
        """Whether `phrase`, at chunk `at`, names all there are of its noun: "the mugs", or "mugs" by itself."""
        plain = phrase.modifiers == NO_MODIFIERS == phrase.superlative and not phrase.cycle
        return plain and phrase.plural and phrase.count is None and not phrase.part and self._place_of(at) is None

    def _plural_before(self, at: int) -> list[Group]:
        refs = [self.known[before] for before in sorted(self.known, reverse=True) if before < at and self.known[before]]
        groups = [items[0].group for items in refs if len(items[0].group.items) > 1]
        return list(dict.fromkeys(groups))

    def _enumerated(self, at: int) -> list[Item]:
        """The single things that the sentence before chunk `at`, or the one before it, begins with in a list."""
        heads: list[int] = []
        for n, piece in enumerate(self._chunks[:at]):
            if piece.kind not in ("noun", "joint", "there"):
                break
            heads += [n] * (piece.kind == "noun")
        told = [head for head in self.known if head < at]
        numbered = any(is_numbered(self._chunks[head].named) for head in told)
        if not numbered and any(len(self.known[head]) > 1 for head in told):
            # "A cup and a jar are on a shelf. Four cans stand in a row, the second one red.": of the cans.
            return []
        named = [self.known.get(head, []) for head in heads]
        if len(named) > 1 and all(len(items) == 1 for items in named):
            return [items[0] for items in named]
        return list(self._world.together) if len(named) < 2 else []

    def _before(self, at: int) -> list[Item]:
        """What the clause that chunk `at` belongs to begins with."""
        plural = self._plural_before(at)
        listed = [head for heads in self.clauses.values() for head in heads if head < at and self.known.get(head)]
        if len(listed) > 1:
            return [item for head in listed for item in self.known[head]]
        together = list(self._world.together)
        both = self._chunks[at].named.head == "both"
        if plural or not together or (len(together) > 1 and not (both and len(together) != 2)):
            return list(plural[0].items) if plural else together
        # "A shelf carries three cups. All hold a pen.", "A table and two lamps. Both are green."
        borne = self.carried_by(together) if len(together) == 1 else []
        several = [group for group in reversed(self._earlier) if len(group.items) > 1 and not group.replaced]
        if len(borne) > 1 and not (both and len(borne) != 2):
            return borne
        return list(several[0].items) if several and not (both and len(several[0].items) != 2) else together


def _looks(phrase: Phrase) -> set[str]:
    """What is said of what `phrase` names, and its name."""
    said = phrase.modifiers
    sizes = {each for each in (said.size_word, said.material_word, said.material or "") if each}
    return {*said.adjectives, *said.colours, *said.postures, phrase.said or phrase.head} | sizes
