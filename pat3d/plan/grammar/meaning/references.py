"""What phrases speak of: new objects, objects named before, members of a group, pronouns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.counting import forget_count
from pat3d.plan.grammar.meaning.distribution import says_all
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.kinds import called, of_kind
from pat3d.plan.grammar.meaning.matching import ALONG, colours_of, line_up, position, same_head, same_noun, same_word
from pat3d.plan.grammar.meaning.members import Members
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS

_BUILT_ON = frozenset({"screen", "keyboard", "lid"})
"""Parts that never come off, though there are things of that name too."""

_THINGS_TOO = frozenset({"palette", "light", "window", "curtain", "shed", "barn", "garage", "house"})
"""Words of places and moods that name things as well."""


class References(Members):
    """Resolves the phrases of one sentence."""

    def _put_on_itself(self, at: int, phrase: Phrase, found: Sequence[Item]) -> bool:
        """Whether chunk `at` would be what is put there: "put the cup on the upside-down cup" is of two cups."""
        new = self.asked and at - 1 in self.goals and all(item.group not in self.before for item in found)
        moved = {head for one, other in self.related if at in other for head in one}
        told = {item for head in moved for item in self.known.get(head, [])}
        return new and {*found} <= told and all(item.group.words.lower() != phrase.words.lower() for item in found)

    def create(self, at: int, phrase: Phrase, *, filling: bool, kind: int | None) -> None:
        """Make, or find, what chunk `at` speaks of."""
        world = self._world
        if phrase.each:
            self.each.add(at)
        elif says_all(phrase):
            self.all.add(at)
        if phrase.kind in ("object", "unknown"):
            if at in self.bound:
                # "Tools: a hammer and a saw": the two are the tools.
                return
            found = self._refer(at, phrase)
            if found is not None and not self._put_on_itself(at, phrase, found):
                # "Put all the cups but the blue cup in the box"
                found = [item for item in found if item not in self.left] or found
                self.known[at] = self._the_one(self._some_of(found, phrase), phrase)
                if set(phrase.modifiers.adjectives) - set(found[0].group.modifiers.adjectives):
                    self._note_adjectives(phrase)
                for item in self.known[at] if phrase.modifiers.postures else ():
                    # "A white cup and two black cups, the black ones upside down"
                    item.told = item.told.marked_as(phrase.modifiers)
                level = position(phrase)
                if level in (*lexicon.LEVELS, "middle") and phrase.head in lexicon.STORAGE_PARTS and len(found) == 1:
                    # "A shelf with a vase on the top shelf": it is made with one place to put things.
                    world.note(f'not modelled: "{level}" of "{phrase.words}"')
                return
            generic = self.known.get(kind, []) if kind is not None else []
            owner = next((item.group for item in generic if item.group.cycle), None)
            group = self._maker.make(world, phrase, filling=filling, kind=owner)
            if owner is not None:
                owner.replaced = True
                forget_count(world, owner)
                # What is said of the kind is said of its members.
                generic += group.items
            if phrase.each and phrase.count is None:
                world.note(f'"{phrase.words}": of how many is not said; {len(group.items)} assumed.')
            self._note_more(group)
            group.items[0].place, group.items[0].placed_by = position(phrase), phrase.words
            self.known[at] = self._the_one(group.items, phrase)
            if position(phrase) in ALONG and len(group.items) == 1:
                line_up(self._world, group.items[0])
        elif phrase.kind == "pronoun" and phrase.head == "another":
            self.known[at] = self._another(at, phrase)
        elif phrase.kind == "pieces":
            self.known[at] = self._members(at, phrase)
            self._note_adjectives(replace(phrase, noun=next((i.group.noun for i in self.known[at]), "")))
            shape = tuple(word for word in phrase.modifiers.adjectives if word in lexicon.HONOURED)
            for item in self.known[at]:
                told = item.told.marked_as(phrase.modifiers)
                item.told = replace(told, adjectives=tuple(dict.fromkeys((*told.adjectives, *shape))))
            self.cost += 0.0 if self.known[at] or at in self.bound else 0.5
        elif phrase.kind == "items":
            self.known[at] = []
        elif phrase.kind == "background":
            self.known[at] = []
            if phrase.substance:
                if phrase.words not in lexicon.PRONOUNS:
                    world.note(f'not modelled: "{phrase.words}"')
            elif phrase.words not in world.aside:
                world.aside.append(phrase.words)
                joined = any(piece.kind == "joint" for piece in self._chunks[max(at - 1, 0) : at + 2])
                if joined and phrase.head in _THINGS_TOO and not phrase.definite:
                    # "A vase and a palette are on the table"
                    world.note(f'not modelled: "{phrase.words}"')

    def _goes_on(self, at: int) -> bool:
        """Whether something is told of the phrase at chunk `at` behind a comma: ", mug on a book"."""
        around = self._chunks[at - 1 : at + 2] if at else []
        kinds = [piece.kind for piece in around]
        return kinds[:1] == ["joint"] and around[0].text == "," and kinds[2:] in (["rel"], ["verb"], ["have"])

    def _some_of(self, items: list[Item], phrase: Phrase) -> list[Item]:
        """As many of `items` as "three of the apples" says; those that were not told of before."""
        count, words = phrase.count or 0, phrase.words.lower().split()
        if phrase.some or not 0 < count < len(items) or "of" not in words[:-2] or not phrase.plural:
            return items
        if not self.asked and items[0].group not in self._world.groups[: self._world.settled]:
            # "There are three cups and two of the cups are red": whether all are is not told apart.
            return items
        items = self._free(items, count)
        self._world.telling = items[count:]
        return items[:count]

    def _refer(self, at: int, phrase: Phrase) -> list[Item] | None:
        """The objects already read that `phrase` speaks of, or None."""
        if phrase.head == "another" or phrase.kind not in ("object", "unknown") or phrase.other:
            return (self._rest_of(phrase) or None) if phrase.definite else self._another_of(at, phrase)
        bare = not (phrase.determined or phrase.plural or phrase.height or phrase.cycle)
        world = self._world
        if (
            one := self._of_contents(at, phrase)
            or self._any_of(at, phrase)
            or self._of_those(at, phrase)
            or self._counted_late(at, phrase)
            or self._told_by_looks(at, phrase)
            or self._again(at, phrase)
            or of_kind(phrase, world.groups[: world.settled], self.left)
        ) is not None and one:
            return one
        again = self._earlier if bare else []
        again = again or [
            # "Pens in a mug, mug on a book"
            group for group in world.groups if bare and not group.phrase.plural
            and (not group.phrase.determined
                 or (self._goes_on(at) and phrase.modifiers == NO_MODIFIERS == group.modifiers))
        ]  # fmt: skip
        short = [group for group in world.groups if group.said.split()[1:][-1:] == [phrase.head]]
        if short and bare and self._goes_on(at) and phrase.modifiers == NO_MODIFIERS:
            # "Pens in a pen holder, holder on a desk"
            return list(short[-1].items)
        again = again or [
            # "Sort the coins: coins in the jar"
            group for group in world.groups
            if self._all_of(at, phrase) and group.phrase.definite and group.phrase.plural and not group.counted
            and group.modifiers == NO_MODIFIERS and all(world.support(item) is None for item in group.items)
        ]  # fmt: skip
        if not phrase.definite and not any(group.noun == phrase.noun for group in again):
            return None
        besides = self._besides(at)
        likes = [group for group in world.groups if group.noun == phrase.noun and not group.replaced]
        likes = [group for group in likes if not self._told_otherwise(group, phrase)]
        if (
            len(likes) > 1
            and self._all_of(at, phrase)
            and not any(group in besides or group.cycle or self._elsewhere(at, group) for group in likes)
        ):
            return [item for group in likes for item in group.items]
        if one := self._by_place([group for group in likes if group not in besides], phrase):
            return one
        groups = [group for group in world.groups if group not in besides and not group.replaced]
        named, alike = ([item for group in groups if any(same(group, phrase) for same in names)
                         for item in self._chosen(group, replace(phrase, count=None))]
                        for names in ((same_noun,), (same_noun, same_head)))  # fmt: skip
        every = self._all_of(at, phrase) or (phrase.plural and phrase.count == len(alike))
        if every and len(named) < 2 <= len(alike):
            # "A plate and a small plate. A can is behind both plates": a small plate has a noun of its own.
            return alike
        for same in (same_noun, same_head):
            for group in reversed([group for group in world.groups if not group.replaced]):
                own = group.modifiers.colours or (group.items[0].colours or ())
                coloured = {own, *(item.colours for item in group.items if item.colours)}
                if group in besides and (same is same_head or phrase.modifiers.colours not in coloured):
                    continue
                if group in besides and group.noun == phrase.noun and group.said != phrase.said:
                    # "A couch faces the sofa": two.
                    continue
                if same is same_head and set(phrase.modifiers.adjectives) - set(group.modifiers.adjectives):
                    continue
                if same is same_head and group not in world.groups[: world.settled] and not same_word(group, phrase):
                    # "The shirts in the hamper and the socks in the basket": two.
                    continue
                if self._told_by_noun(phrase, group.phrase) or self._elsewhere(at, group):
                    continue
                if self._listed_apart(at, group, phrase) or self._holds_others(at, group):
                    continue
                if same(group, phrase) and (
                    found := self._chosen(group, phrase, at if self._tells_place(at) else None)
                ):
                    return found
        if phrase.plural and len(named) > 1 and phrase.count in (None, len(named)):
            # "Both burners" of which one was named after the other.
            return named
        for part in lexicon.BUILT_IN & {phrase.head, *singulars(phrase.head)} if phrase.definite else ():
            # "A pan is on the stove and a kettle is on the burner"
            whole = [item for item in world.items() if world.is_a(item, lexicon.PARTS_OF[part])]
            if whole:
                world.note(f'"{phrase.words}" is read as "{whole[-1].group.words}".')
                return whole[-1:]
        placed = any(at in one and self._chunks[min(other) - 1].kind != "have" for one, other in self.related if other)
        like = called(phrase, groups) if self.asked or not placed else None
        if like is not None and not self._elsewhere(at, like) and (found := self._chosen(like, phrase)):
            # "A mug is on a tray. A spoon is next to the cup"; but "the cup is on a mat" may tell of another.
            world.note(f'"{phrase.words}" is read as "{like.words}".')
            return found
        if phrase.head in lexicon.STORAGE_PARTS and phrase.count in (None, 1) and not position(phrase):
            others = ("desk",) if phrase.head in ("shelf", "shelves") else ("shelf", "bookshelf", "bookcase")
            storage = [item for item in world.items() if world.is_a(item, lexicon.STORAGE)]
            storage = [item for item in storage if item.group not in besides and not world.is_a(item, others)]
            storage = [item for item in storage if item.group.said not in lexicon.DRAWERS]
            return storage[-1:] or None
        return None

    def _note_more(self, group: Group) -> None:
        """Say that "the other two cups" are further ones where none of the three before was told from the rest."""
        likes = [one for one in self._world.groups if one.noun == group.noun and one.exact and one is not group]
        alike = [one for one in likes if len(one.items) > len(group.items) and not any(map(colours_of, one.items))]
        if group.phrase.other and group.phrase.definite and alike:
            total = len(alike[-1].items) + len(group.items)
            self._world.note(f'"{group.words}" are read as further ones, {total} in all.')

    def _note_adjectives(self, phrase: Phrase) -> None:
        """Name what describes `phrase` and makes no difference to it; "top" tells which one."""
        words = phrase.modifiers
        kept = tuple(word for word in words.adjectives if word not in lexicon.LEVELS)
        self._maker.note_adjectives(self._world, phrase, replace(words, adjectives=kept))

    def with_parts(self, facts: Sequence[tuple]) -> Sequence[Chunk]:
        """The chunks of the sentence, with the drawers that a desk "has", and "its screen", as parts of it."""
        made = [self._own_part(at) for at in range(len(self._chunks))]
        for fact in facts:
            if fact[0] != "have" or self._chunks[fact[1]].link.manner != "with":  # type: ignore[union-attr]
                continue
            owners = [self._chunks[head].phrase for head in fact[2]]
            storage = any(owner and self._world.likely.is_a(owner.noun, lexicon.STORAGE) for owner in owners)
            for head in fact[3]:
                phrase = made[head].phrase
                words = {phrase.head, *singulars(phrase.head)} if phrase is not None else set()
                own = phrase is not None and self._part_of(phrase, [owner.noun for owner in owners if owner])
                stored = storage and bool(words & lexicon.STORAGE_PARTS)
                if phrase is not None and phrase.kind == "object" and (stored or own):
                    made[head] = replace(made[head], phrase=_as_part(phrase))
        self._chunks = made
        return made

    def _own_part(self, at: int) -> Chunk:
        """Chunk `at`, as a part where it is "its screen" behind a laptop, or "the lid" and no vessel is there."""
        chunk, phrase = self._chunks[at], self._chunks[at].phrase
        if phrase is None or phrase.kind != "object" or phrase.head not in _BUILT_ON:
            return chunk
        before = [piece.phrase.noun for piece in self._chunks[:at] if piece.phrase is not None]
        before += [group.noun for group in self._world.groups]
        lid = phrase.head == "lid" and (phrase.definite or not phrase.determined)
        own = phrase.opening == "its" or (lid and all(self._world.likely.on("lid", noun) for noun in before if noun))
        return replace(chunk, phrase=_as_part(phrase)) if own and self._part_of(phrase, before) else chunk

    def _part_of(self, phrase: Phrase, owners: Sequence[str]) -> bool:
        """Whether what has one of the nouns `owners` has a part that `phrase` names."""
        names = (phrase.said, phrase.head, *singulars(phrase.head))
        whole = [lexicon.PARTS_OF[word] for word in names if word in lexicon.PARTS_OF]
        return any(self._world.likely.is_a(owner, *whole) for owner in owners if owner and whole)

    def refs_of(
        self, heads: Sequence[int], link: Link | None = None, other: Sequence[int] = (), *, child: bool = False
    ) -> list[Item]:
        """What `heads` speak of; of a pronoun, what makes `link` to or from (`child`) the `other` heads likely."""
        made: list[Item] = []
        for head in (inner for each in heads for inner in self._meant(each)):
            phrase = self._chunks[head].phrase
            pronoun = phrase is not None and (phrase.kind == "pronoun" or (phrase.kind == "part" and phrase.possessive))
            if pronoun and head not in self.bound and head not in self.known:
                others = [item for each in other for item in self.ref(each)]
                self.known[head] = self._pronoun(head, link, others, child=child)
            made += [item for item in self.ref(head) if item not in made]
        return [item for item in made if not item.group.replaced]

    def is_open(self, at: int) -> bool:
        """Whether chunk `at` is a pronoun of which it is still to be found what it means."""
        return self._is_pronoun(at) and at not in self.bound and at not in self.known

    def not_understood(self, heads: Sequence[int], where: str = "") -> None:
        """Name those of `heads` that speak of nothing, and `where` they are said to be."""
        for head in heads:
            phrase = self._chunks[head].phrase
            if phrase is not None and not self.ref(head) and phrase.kind in ("items", "pieces", "part", "pronoun"):
                self._world.note(f'not understood: "{phrase.words}"{where}')


def _as_part(phrase: Phrase) -> Phrase:
    return replace(phrase, kind="part", said=phrase.head, noun="")
