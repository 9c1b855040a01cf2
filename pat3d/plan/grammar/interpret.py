"""What one reading of a sentence adds to the scene: references are resolved, relations recorded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.chart import Node
from pat3d.plan.grammar.chunks import Chunk
from pat3d.plan.grammar.instructions import Clause
from pat3d.plan.grammar.lexing import singulars
from pat3d.plan.grammar.links import Link
from pat3d.plan.grammar.modifiers import Modifiers
from pat3d.plan.grammar.objects import Maker, describe, forget_count, multiply, recount, tell, tell_colours
from pat3d.plan.grammar.phrases import Phrase
from pat3d.plan.grammar.plausible import LARGE
from pat3d.plan.grammar.world import Edge, Group, Item, Sided, Step, World
from pat3d.scene.model import LATERAL_KINDS, SUPPORT_KINDS, LateralKind

_SAME = {"leftmost": "left", "rightmost": "right"}
_OPPOSITE = {"left": "right", "right": "left", "front": "back", "back": "front"}
_REST = frozenset({"other", "others", "rest", "remaining", "remainder"})
_LARGER = frozenset({"largest", "biggest", "larger", "bigger", "tallest", "taller", "large", "big", "tall"})
_SMALLER = frozenset({"smallest", "smaller", "littlest", "shortest", "shorter", "tiniest", "small", "little"})
_SIDES: dict[str, LateralKind] = {"left": "left_of", "right": "right_of", "front": "in_front_of", "back": "behind"}


class Interpreter:
    """Adds one reading of a sentence to a world."""

    def __init__(self, world: World, chunks: Sequence[Chunk], maker: Maker, clause: Clause) -> None:
        self._world = world
        self._chunks = chunks
        self._maker = maker
        self._clause = clause
        self._refs: dict[int, list[Item]] = {}
        self._bound: dict[int, tuple[int, ...]] = {}
        self._each: set[int] = set()
        self._handled: set[int] = set()
        """Phrases for everything that were put somewhere."""
        self._earlier = list(world.groups)
        self._subjects: list[tuple[int, list[Item]]] = []
        """What the clauses are about, by where they begin."""
        self._landmark: tuple[list[Item], bool] = ([], False)
        self.cost = 0.0

    def add(self, reading: Node) -> float:
        """Add `reading`; what its references cost.

        Raises:
            PromptError: it cannot be a scene.
        """
        facts = reading.facts
        for fact in facts:
            if fact[0] == "extra":
                where = " ".join(self._chunks[at].text for at in (fact[1], *fact[2]))
                self._world.note(f'not modelled: "{where}"')
                self._clause = replace(self._clause, manner="other")
        self._bound = {fact[1]: fact[2] for fact in facts if fact[0] == "bind"}
        clauses = {fact[2]: fact[1] for fact in facts if fact[0] == "subject"}
        self._clauses = {**clauses} or {0: reading.heads}
        fillings, kinds = self._fillings(facts)
        self._sides = {head: self._chunks[fact[1]].text for fact in facts if fact[0] == "side" for head in fact[2]}
        self._related_heads = [(set(fact[2]), set(fact[3])) for fact in facts
                               if fact[0] in ("rel", "have", "list", "goal")]  # fmt: skip
        for at, chunk in enumerate(self._chunks):
            if chunk.phrase is not None:
                self._create(at, chunk.phrase, filling=at in fillings, kind=kinds.get(at))
        for fact in facts:
            if fact[0] == "form" and self._chunks[fact[1]].text in ("rows", "stacks", "stack", "tower"):
                self._formed(fact[1], fact[2])
        for fact in facts:
            handler = {"rel": self._related, "have": self._had, "list": self._listed}.get(fact[0])
            if handler is not None:
                handler(fact[1], fact[2], fact[3])
        for fact in facts:
            if fact[0] == "place":
                self._placed(fact[1], fact[2], fact[3])
            elif fact[0] == "form" and self._chunks[fact[1]].text not in ("rows", "stacks", "stack", "tower"):
                self._formed(fact[1], fact[2])
            elif fact[0] == "quality":
                self._qualified(fact[2], self._chunks[fact[1]].modifiers)
            elif fact[0] == "goal":
                self._aimed(fact[1], fact[2], fact[3])
        if self._clause.manner is not None and not any(fact[0] == "goal" for fact in facts):
            self._done(reading.heads)
        told = {at for fact in facts if fact[0] in ("have", "list", "include") for at in fact[3]}
        for at, chunk in enumerate(self._chunks):
            kind = chunk.phrase.kind if chunk.phrase is not None else ""
            if kind in ("items", "pieces") and at not in self._bound and at not in self._handled | told:
                self._not_understood([at])
        world = self._world
        subject = self._ref(reading.heads[0]) if reading.heads else []
        last = max(self._clauses)
        world.subject = self._ref(self._clauses[last][0]) or subject or world.subject
        if self._clause.manner is not None:
            world.subject = subject or world.subject
        world.landmark = self._landmark
        if self._clause.manner is None:
            self.cost += self._loose()
        return self.cost

    def _loose(self) -> float:
        """What it costs that small things are nowhere, where something is there to carry them."""
        world = self._world
        items = world.items()
        carried = any(world.support(item) is not None for item in items)
        if not carried or not any(world.is_table(item) for item in items):
            return 0.0
        related = {each for edge in world.laterals for each in (edge.child, edge.parent)}
        told = {item for each in world.sided for item in each.items}
        loose = [
            item for item in items
            if world.support(item) is None and not world.on_floor(item) and item not in related and item not in told
            and not world.is_a(item, lexicon.BY_A_SEAT, LARGE)
            and not (world.is_a(item, lexicon.THIN) and any(world.support(other) is item for other in items))
        ]  # fmt: skip
        return 0.5 * len({id(item.group) for item in loose})

    def _fillings(self, facts: Sequence[tuple]) -> tuple[set[int], dict[int, int]]:
        """Phrases of which a bare plural means many, and the generics that list others."""
        fillings: set[int] = set()
        kinds: dict[int, int] = {}
        for fact in facts:
            link = self._chunks[fact[1]].link if fact[0] == "have" else None
            if link is not None and link.filling and len(fact[3]) == 1:
                fillings |= set(fact[3])
            if fact[0] == "include":
                kinds |= dict.fromkeys(fact[3], fact[2][0])
        return fillings, kinds

    # Instructions

    def _aimed(self, at: int, child_heads: Sequence[int], parent_heads: Sequence[int]) -> None:
        """Read where something is to go: there it is, where the prompt makes it up; a task, where it speaks of it."""
        link = self._chunks[at].link
        assert link is not None
        before = self._world.subject
        parents = self._refs_of(parent_heads, link, child_heads)
        children = self._refs_of(child_heads, link, parent_heads, child=True)
        if not parent_heads:
            parents = [item for item in before if item not in children]
        phrases = [self._chunks[head].phrase for head in child_heads]
        made_up = self._clause.manner in ("make", "stack") and all(
            phrase is not None and phrase.determined and not phrase.definite and phrase.kind in ("object", "unknown")
            for phrase in phrases
        )
        if made_up:
            if self._clause.manner == "stack" and len(children) > 1:
                self._stacked(list(dict.fromkeys(item.group for item in children)), tall=True)
            if children and parents:
                several = any(head in self._each for head in parent_heads) or any(
                    each is not None and each.each for each in (self._chunks[head].phrase for head in parent_heads)
                )
                if several:
                    children = multiply(self._world, children, len(parents))
                if self._clause.verb == "hang" and link.kind == "on":
                    link = Link(kind="hangs_from")
                if self._clause.verb == "lean" and link.manner == "place" and link.kind in ("on", "next_to"):
                    link = Link(kind="next_to", says="leaning_against")
                self.relate(children, link, parents)
                self._world.note(
                    f'"{self._clause.said}" is read as the scene to make; with "the" before what is moved it is a task.'
                )
            return
        for head in parent_heads:
            self._note_part(head)
        self._not_understood((*child_heads, *parent_heads))
        self._step(children, link, parents)

    def _done(self, heads: Sequence[int]) -> None:
        children = self._refs_of(heads)
        self._not_understood(heads)
        phrases = [self._chunks[head].phrase for head in heads]
        made_up = all(phrase is not None and phrase.determined and not phrase.definite for phrase in phrases)
        if self._clause.manner == "stack" and made_up:
            self._stacked(list(dict.fromkeys(item.group for item in children)), tall=True)
        elif self._clause.manner != "make" or not made_up:
            self._step(children, None, [])

    def _step(self, children: list[Item], link: Link | None, parents: list[Item]) -> None:
        manner = self._clause.manner
        assert manner is not None
        self._world.steps.append(
            Step(manner=manner, said=self._clause.said, items=tuple(children), link=link, goal=tuple(parents))
        )

    def _qualified(self, heads: Sequence[int], told: Modifiers) -> None:
        items = [item for head in heads for item in self._ref(head)]
        for group in dict.fromkeys(item.group for item in items):
            if all(item in items for item in group.items):
                describe(group, told)
            else:
                for item in items:
                    tell(item, told)

    # What a phrase speaks of

    def _create(self, at: int, phrase: Phrase, *, filling: bool, kind: int | None) -> None:
        world = self._world
        if phrase.kind in ("object", "unknown"):
            if (found := self._refer(at, phrase)) is not None:
                self._refs[at] = found
                return
            generic = self._refs.get(kind) if kind is not None else None
            owner = generic[0].group if generic and generic[0].group.cycle else None
            group = self._maker.make(world, phrase, filling=filling, kind=owner)
            if owner is not None:
                owner.replaced = True
                forget_count(world, owner)
            group.items[0].place = _position(phrase)
            self._refs[at] = list(group.items)
            if _position(phrase) in ("left", "right") and len(group.items) == 1:
                self._line_up(group.items[0])
        elif phrase.kind == "pronoun" and phrase.head == "another":
            self._refs[at] = self._another(at, phrase)
        elif phrase.kind == "pieces":
            self._refs[at] = self._members(at, phrase)
        elif phrase.kind == "items":
            self._refs[at] = []
        elif phrase.kind == "background":
            self._refs[at] = []
            if phrase.substance:
                if phrase.words not in lexicon.PRONOUNS:
                    world.note(f'not modelled: "{phrase.words}"')
            elif phrase.words not in world.aside:
                world.aside.append(phrase.words)

    def _refer(self, at: int, phrase: Phrase) -> list[Item] | None:
        """The objects already read that `phrase` speaks of, or None."""
        if phrase.head == "another" or phrase.kind not in ("object", "unknown") or phrase.other:
            return None
        bare = not (phrase.determined or phrase.plural or phrase.height or phrase.cycle)
        world = self._world
        again = self._earlier if bare else []
        again = again or [
            group for group in world.groups if bare and not group.phrase.determined and not group.phrase.plural
        ]
        if not phrase.definite and not any(group.noun == phrase.noun for group in again):
            return None
        partners = {head for one, other in self._related_heads for head in (*one, *other) if at in (*one, *other)} - {
            at
        }
        besides = {item.group for head in partners if head < at for item in self._refs.get(head, ())}
        for same in (_same_noun, _same_head):
            for group in reversed([group for group in world.groups if not group.replaced]):
                own = group.modifiers.colours or (group.items[0].colours or ())
                if group in besides and (same is _same_head or phrase.modifiers.colours != own):
                    continue
                if same is _same_head and set(phrase.modifiers.adjectives) - set(group.modifiers.adjectives):
                    continue
                if same(group, phrase) and (found := self._chosen(group, phrase)):
                    return found
        if phrase.head in lexicon.STORAGE_PARTS and phrase.count in (None, 1) and not _position(phrase):
            storage = [
                item for item in world.items() if world.is_a(item, lexicon.STORAGE) and item.group not in besides
            ]
            storage = [
                item for item in storage if phrase.head not in ("shelf", "shelves") or not world.is_a(item, ("desk",))
            ]
            return storage[-1:] or None
        return None

    def _chosen(self, group: Group, phrase: Phrase) -> list[Item]:
        """The members of `group` that `phrase` speaks of; none where it cannot be meant."""
        items, where = group.items, _position(phrase)
        wanted = phrase.modifiers.colours
        if wanted:
            own = [item for item in items if _colours(item) and wanted[0] in _colours(item)]
            blank = [item for item in items if not _colours(item)]
            items = own or (blank if len(items) == len(blank) else [])
        if phrase.count is not None and phrase.count > len(items):
            return []
        placed = [item for item in items if item.place == where] if where else []
        if placed:
            return placed
        if where and any(item.place for item in items):
            if len(items) == 1:
                return []
            items = [item for item in items if not item.place]
        if where and len(items) > 1 and not phrase.plural and group.height == 1:
            return self._at(items, where, phrase)
        size = phrase.modifiers.size_word
        if size and group.modifiers.size_word and size != group.modifiers.size_word:
            return []
        if phrase.plural or len(items) == 1 or group.height > 1:
            return list(items)
        return items[: phrase.count or 1] if wanted else list(items)

    def _at(self, items: list[Item], where: str, phrase: Phrase) -> list[Item]:
        index = len(items) // 2 if where in ("middle", "center", "centre") else lexicon.POSITIONS[where]
        if not -len(items) <= index < len(items):
            self._world.note(f'"{phrase.words}": there are only {len(items)}.')
            return items[-1:]
        item = items[index]
        item.place = where
        tell(item, phrase.modifiers)
        if not item.group.rows:
            self._line_up(item)
        return [item]

    def _line_up(self, placed: Item) -> None:
        """Relate the left one and the right one of a kind to each other."""
        if placed.place not in ("left", "right"):
            return
        for other in self._world.items():
            same = other.group.noun == placed.group.noun and not other.group.cycle
            known = any({edge.child, edge.parent} == {placed, other} for edge in self._world.laterals)
            if known:
                continue
            if same and other is not placed and other.place in ("", _OPPOSITE[placed.place]):
                self._world.laterals.append(Edge(child=placed, kind=_SIDES[placed.place], parent=other))

    def _members(self, at: int, phrase: Phrase) -> list[Item]:
        """The members that a headless phrase ("one", "the red one", "the other two") speaks of."""
        world = self._world
        if phrase.said == "stack":
            towers = [group for group in world.groups if group.height > 1]
            return list(towers[-1].items) if towers and phrase.definite else []
        words, where = phrase.modifiers, _position(phrase)
        groups = [*self._plural_before(at), *([world.subject[0].group] if world.subject else [])]
        groups += [group for group in reversed(world.groups) if not group.replaced]
        rest = phrase.head in _REST
        if phrase.head == "each":
            self._each.add(at)
            plural = self._plural_before(at)
            subject = list(plural[0].items) if plural else self._before(at)
            return list(subject[0].group.items) if len(subject) == 1 else subject
        if rest and world.telling:
            told = world.telling[: phrase.count or len(world.telling)]
            world.telling = world.telling[len(told) :]
            return told
        count = phrase.count or 1
        if words.colours or words.palette or words.size_word:
            return self._described(phrase, groups, count)
        if world.telling and len(world.telling) >= count and not where:
            told, world.telling = world.telling[:count], world.telling[count:]
            return told
        whole = next((group for group in groups if len(group.items) > count and group.height == 1), None)
        if whole is None:
            whole = next((group for group in groups if len(group.items) >= count), None)
            return list(whole.items[:count]) if whole is not None else []
        if where:
            return self._at(whole.items, where, phrase)
        if rest:
            return list(whole.items[len(whole.items) - count :])
        world.telling = whole.items[count:]
        return list(whole.items[:count])

    def _another(self, at: int, phrase: Phrase) -> list[Item]:
        """One more of what was named first in the sentence, else last."""
        named = [self._refs[head] for heads in self._clauses.values() for head in heads if self._refs.get(head)]
        groups = [named[0][0].group] if named else self._world.groups[-1:]
        if not groups or groups[0].proxy:
            return []
        more = replace(groups[0].phrase, words=phrase.words, count=1, plural=False, height=None, definite=False)
        return list(self._maker.make(self._world, more).items)

    def _described(self, phrase: Phrase, groups: list[Group], count: int) -> list[Item]:
        """Members told by colour or size: "one red and one blue", "two of them yellow", "the larger one"."""
        words = phrase.modifiers
        if words.size_word and not words.colours:
            for item in self._world.items():
                size = item.told.size_word or item.group.modifiers.size_word
                if size and size in _LARGER | _SMALLER and (size in _LARGER) == (words.size_word in _LARGER):
                    return [item]
            groups = [group for group in groups if len(group.items) > 1]
        for group in groups:
            own = [item for item in group.items if words.colours and words.colours[0] in _colours(item)]
            if own and phrase.definite:
                return own[:count] if phrase.count is not None or not phrase.plural else own
        whole = next((group for group in groups if len(group.items) > 1), groups[0] if groups else None)
        if whole is None:
            return []
        if (
            words.palette
            or (not phrase.determined and phrase.count is None)
            or (phrase.plural and phrase.count is None)
        ):
            tell_colours(self._world, whole, words)
            return list(whole.items)
        free = [item for item in whole.items if not _colours(item) and not item.told.size_word]
        known = {colour for item in whole.items for colour in _colours(item)}
        if phrase.words.split()[-1] in ("one", "ones") and words.colours and known and not free:
            # "a blue cube and the yellow one": one more of the kind.
            more = replace(whole.phrase, words=phrase.words, count=phrase.count, plural=phrase.plural or count > 1,
                           modifiers=words, definite=phrase.definite)  # fmt: skip
            return list(self._maker.make(self._world, more).items)
        picked = free[:count]
        for item in picked:
            tell(item, words)
        self._world.telling = free[count:]
        return picked or list(whole.items[:count])

    def _plural_before(self, at: int) -> list[Group]:
        refs = [self._refs[before] for before in sorted(self._refs, reverse=True) if before < at and self._refs[before]]
        groups = [items[0].group for items in refs if len(items[0].group.items) > 1]
        return list(dict.fromkeys(groups))

    def _before(self, at: int) -> list[Item]:
        """What the clause that chunk `at` belongs to begins with."""
        plural = self._plural_before(at)
        listed = [head for heads in self._clauses.values() for head in heads if head < at and self._refs.get(head)]
        if len(listed) > 1:
            return [item for head in listed for item in self._refs[head]]
        return list(plural[0].items) if plural else list(self._world.subject)

    def _ref(self, at: int) -> list[Item]:
        if at in self._refs:
            return self._refs[at]
        if at in self._bound:
            return [item for head in self._bound[at] for item in self._ref(head)]
        return []

    def _refs_of(
        self, heads: Sequence[int], link: Link | None = None, other: Sequence[int] = (), *, child: bool = False
    ) -> list[Item]:
        """What `heads` speak of; of a pronoun, what makes `link` to or from (`child`) the `other` heads likely."""
        made: list[Item] = []
        for head in heads:
            phrase = self._chunks[head].phrase
            pronoun = phrase is not None and (phrase.kind == "pronoun" or (phrase.kind == "part" and phrase.possessive))
            if pronoun and head not in self._bound and head not in self._refs:
                others = [item for each in other for item in self._ref(each)]
                self._refs[head] = self._pronoun(head, link, others, child=child)
            made += [item for item in self._ref(head) if item not in made]
        return [item for item in made if not item.group.replaced]

    def _pronoun(self, at: int, link: Link | None, other: Sequence[Item], *, child: bool) -> list[Item]:
        """What "it" means: what makes the relation likely, the subject of the clause before, then what is nearest."""
        phrase = self._chunks[at].phrase
        assert phrase is not None
        plural = phrase.head in ("them", "they", "these", "those", "their")
        candidates: list[tuple[float, list[Item]]] = []
        starts = [start for start in sorted(self._clauses) if start < at]
        before = [list(self._ref(self._clauses[start][0])) for start in reversed(starts)]
        before += [self._world.subject]
        near = phrase.head == "which" or phrase.head in lexicon.DEMONSTRATIVES
        meant = [self._refs[key] for key in self._refs if key < at and self._is_pronoun(key) and self._refs[key]]
        if meant and not plural:
            # "behind it a mug, and in front of it a bowl" speaks twice of the same.
            candidates.append((-0.1, meant[-1]))
        if self._landmark[0] and not near:
            candidates.append((0.1, self._landmark[0]))
        for rank, items in enumerate([each for each in before if each]):
            candidates.append((0.2 * rank, items))
        nearest = [self._refs[key] for key in sorted(self._refs, reverse=True) if key < at and self._refs[key]]
        nearest = [items for items in nearest if not set(items) & set(other)]
        for rank, items in enumerate(nearest[:4]):
            candidates.append(
                ((-0.2 if near and phrase.head != "which" else -0.05 if near else 0.35) + 0.1 * rank, items)
            )
        for rank, group in enumerate(reversed(self._earlier[-3:])):
            candidates.append((0.6 + 0.2 * rank, group.items))
        best: tuple[float, list[Item]] | None = None
        for cost, items in candidates:
            if not items or set(items) & set(other) or items[0].group.replaced:
                continue
            if plural != (len(items) > 1) and not (plural and len(other) == 0):
                cost += 0.4
            if link is not None and other:
                world = self._world
                pair = (items[0], other[0]) if child else (other[0], items[0])
                cost += world.likely.relation(link, world.noun(pair[0]), world.noun(pair[1]))
            if best is None or cost < best[0]:
                best = (cost, list(items))
        if best is None:
            self._world.note(f'"{phrase.words}" (word {phrase.number}): nothing before it is meant.')
            self.cost += 2.0
            return []
        self.cost += min(best[0], 1.5)
        return best[1]

    def _open(self, at: int) -> bool:
        """Whether chunk `at` is a pronoun of which it is still to be found what it means."""
        return self._is_pronoun(at) and at not in self._bound and at not in self._refs

    def _is_pronoun(self, at: int) -> bool:
        phrase = self._chunks[at].phrase
        return phrase is not None and phrase.kind == "pronoun"

    # Relations

    def _related(self, at: int, child_heads: Sequence[int], parent_heads: Sequence[int]) -> None:
        link = self._chunks[at].link
        assert link is not None
        parents: list[Item] = []
        if not any(self._open(head) for head in child_heads):
            parents = self._refs_of(parent_heads, link, child_heads)
        children = self._refs_of(child_heads, link, parent_heads, child=True)
        parents = parents or self._refs_of(parent_heads, link, child_heads)
        places = [self._chunks[head].phrase for head in parent_heads]
        for head in parent_heads:
            self._note_part(head)
        if not children or not parents:
            if not (parents and not children and self._of_everything(child_heads, link, parents)):
                self._not_understood((*child_heads, *parent_heads))
            return
        first = self._chunks[child_heads[0]].phrase
        phrase = places[0]
        if first is not None and first.one_of:
            children = self._one_of(children, first)
        if phrase is not None and phrase.superlative.adjectives:
            parents = self._one_of(parents, phrase)
        group = children[0].group
        loose = group.phrase.plural and not group.counted and len(children) > 1 and len(parents) > 1
        if loose and link.kind in SUPPORT_KINDS:
            # "Two pots with plants in them": as many for each.
            recount(self._world, group, -(-len(children) // len(parents)) * len(parents))
            children = list(group.items)
        several = any(head in self._each for head in (*child_heads, *parent_heads)) or any(
            each is not None and each.each for each in places
        )
        if any(head in self._each for head in child_heads) and phrase is not None and len(parents) < len(children):
            parents = multiply(self._world, parents, len(children) // len(parents))
        elif several and len(children) < len(parents) and not set(children) & set(parents):
            children = multiply(self._world, children, len(parents))
        self.relate(children, link, parents, one_of=phrase is not None and phrase.one_of)

    @staticmethod
    def _one_of(items: list[Item], phrase: Phrase) -> list[Item]:
        """The one of `items` that "the smallest of", "the second of" means."""
        where = phrase.superlative.adjectives[:1]
        at = lexicon.POSITIONS.get(where[0], 0) if where else 0
        if where and where[0] == "middle":
            at = len(items) // 2
        item = items[at] if -len(items) <= at < len(items) else items[-1]
        tell(item, phrase.superlative)
        return [item]

    def _not_understood(self, heads: Sequence[int]) -> None:
        for head in heads:
            phrase = self._chunks[head].phrase
            if phrase is not None and not self._ref(head) and phrase.kind in ("items", "pieces", "part", "pronoun"):
                self._world.note(f'not understood: "{phrase.words}"')

    def _of_everything(self, heads: Sequence[int], link: Link, parents: list[Item]) -> bool:
        """Read "Everything is on a table": all that is not yet carried."""
        world = self._world
        kinds = {self._chunks[head].phrase.kind for head in heads if self._chunks[head].phrase}  # type: ignore[union-attr]
        if "items" not in kinds:
            return False
        free = [item for item in world.items() if world.support(item) is None and item not in parents]
        free = [item for item in free if not world.on_floor(item)]
        if free:
            self._handled |= set(heads)
            self.relate(free, link, parents)
        return bool(free)

    def _note_part(self, head: int) -> None:
        phrase = self._chunks[head].phrase
        if phrase is not None and phrase.part in lexicon.DRAWERS | lexicon.DETACHED and phrase.kind == "object":
            self._world.note(f'"{phrase.words}": "{phrase.said}" has no parts of its own and is meant.')

    def relate(self, children: list[Item], link: Link, parents: list[Item], *, one_of: bool = False) -> None:
        """Record that `children` stand in relation `link` to `parents`."""
        world = self._world
        said = f'"{children[0].group.words}" {{}} "{parents[0].group.words}"'
        if set(children) == set(parents):
            if link.kind in SUPPORT_KINDS:
                raise PromptError(f'"{children[0].group.words}" would rest on itself. Say which one is below.')
            return
        children = [child for child in children if child not in parents] or children
        if link.manner == "than":
            world.note(f"not modelled: {said.format(link.said)}")
        elif link.manner == "gaze":
            world.arrange("facing", children, parents, said.format("facing"))
        elif link.manner == "far":
            world.arrange("far_from", children, parents, said.format("far from"))
        elif link.manner == "under":
            self._under(children, parents, said)
        elif link.manner == "sides":
            self._landmark = (parents, False)
            self._both_sides(children, parents)
        elif link.manner == "between":
            self._between(children, parents)
        elif link.manner == "half":
            self._on_half(children, link.side or "centre", parents)
        elif link.manner == "edge" and link.says is not None:
            level = world.likely.level(world.noun(parents[0]))
            where = (
                link.says.replace("_", " ")
                .replace("at edge", "at the edge of")
                .replace("in corner", "in the corner of")
            )
            self.relate(children, Link(kind="on" if level else "next_to"), parents)
            world.arrange(
                link.says, children, parents, f"{said.format(where)}; it is placed {'on' if level else 'next to'} it"
            )
        elif link.manner in ("source", "goal") and link.kind != "next_to":
            self.relate(children, Link(kind=world.containment(parents[0])), parents)
        elif link.kind in SUPPORT_KINDS:
            self._carried(children, link, parents, said, one_of=one_of)
        elif link.kind in LATERAL_KINDS:
            if link.kind not in ("next_to", "around"):
                self._landmark = (parents, False)
            if link.says == "leaning_against":
                world.arrange(
                    "leaning_against", children, parents, f"{said.format('leaning against')}; it is placed next to it"
                )
            self._settle(children, parents)
            small = not world.on_floor(children[0]) and not world.is_a(children[0], lexicon.BY_A_SEAT, LARGE)
            table = world.is_table(parents[0]) and world.on_floor(parents[0])
            if link.kind == "next_to" and small and table and world.support(children[0]) is None:
                world.note(f'{said.format("beside")}: it stands on the ground there; say "on" to have it on top.')
            world.beside(children, link.kind, parents)  # type: ignore[arg-type]

    def _settle(self, children: list[Item], parents: list[Item]) -> None:
        """Let the counted mention win: "a basket of fruit" with "five fruits" in it holds five."""
        world = self._world
        cycle = children[0].group.cycle
        if not cycle:
            return
        for other in world.groups:
            same = other is not children[0].group and other.cycle == cycle and not other.replaced
            if same and other.items and world.support(other.items[0]) in parents and not other.counted:
                other.replaced = True
                forget_count(world, other)

    def _carried(self, children: list[Item], link: Link, parents: list[Item], said: str, *, one_of: bool) -> None:
        world, kind = self._world, link.kind
        parent = parents[0]
        if kind == "in" and not world.is_a(parent, lexicon.HOLLOW):
            if world.is_a(parent, tuple(lexicon.OPENED)):
                pass
            elif world.is_a(parent, lexicon.CLOSED):
                world.note(f"not arranged: {said.format('inside')}; it is placed on it")
                kind = "on"
            elif world.on_floor(parent):
                kind = "on"
        self._settle(children, parents)
        if link.says == "above":
            world.arrange("above", children, parents, f"{said.format('above')}; it is placed on it")
        tops = world.tops(parents)
        if len(world.bases(children)) < len(tops) and not one_of and parents[0].group.height == 1:
            exact = parents[0].group.exact or len({item.group for item in parents}) > 1
            if exact and kind == "in":
                raise PromptError(
                    f'"{children[0].group.words}" cannot be in {len(tops)} things at once. Say "in one of ...", or '
                    "name one."
                )
            if exact and len(world.bases(children)) == 1:
                names = " and ".join(dict.fromkeys(f'"{item.group.words}"' for item in parents))
                what = "across" if link.says == "across" else "on"
                note = f'"{children[0].group.words}" {what} {names} together; it is placed on the first'
                world.arrange("across", children, tops, note)
                self.cost += 0.3
        assert kind in SUPPORT_KINDS
        world.place(children, kind, parents)

    def _under(self, children: list[Item], parents: list[Item], said: str) -> None:
        world = self._world
        child, parent = children[0], parents[0]
        world.forget_guess(child, parent)
        table = world.is_a(child, ("table",)) and not world.on_floor(parent)
        rug = world.is_a(child, ("rug", "mat", "carpet", "blanket")) or not world.on_floor(parent)
        thin = world.is_a(child, lexicon.THIN) and not table and rug
        if thin or (world.is_a(child, lexicon.STACKABLE) and not world.on_floor(parent)):
            world.place(parents, "on", children)
            world.arrange("under", children, parents)
        else:
            world.arrange("under", children, parents, f"{said.format('under')}; it is placed next to it")
            world.beside(children, "next_to", parents)

    def _both_sides(self, children: list[Item], parents: list[Item]) -> None:
        world = self._world
        if len(children) == 1:
            group = children[0].group
            children = list(group.items) if len(group.items) == 2 else multiply(world, children, 2)
        self._flanked(children, parents)

    def _flanked(self, children: Sequence[Item], parents: list[Item], sides: Sequence[str] = ()) -> None:
        kinds: dict[str, LateralKind] = {"one": "left_of", "left": "left_of", "other": "right_of", "right": "right_of"}
        given = {kinds[side] for side in sides if side in kinds}
        for index, child in enumerate(self._world.bases(children)):
            kind: LateralKind = "right_of" if (index % 2 if not given else "left_of" in given) else "left_of"
            if index < len(sides) and sides[index] in kinds:
                kind = kinds[sides[index]]
            self._world.beside([child], kind, parents[:1])

    def _between(self, children: list[Item], parents: list[Item]) -> None:
        """Both neighbours are said of the one between them: "A left_of child", "B right_of child"."""
        world = self._world
        said = f'"{children[0].group.words}" between "{parents[0].group.words}"'
        groups = list(dict.fromkeys(item.group for item in parents))
        if len(parents) < 2 and len(groups) < 2:
            world.note(f"{said}: the other neighbour is not said.")
        sides = (
            list(parents) if len(groups) == 1 else [next(item for item in parents if item.group is g) for g in groups]
        )
        for child in children:
            world.forget_guess(child, parents[0])
        if len(sides) > 2:
            world.arrange("between", children, sides, f"{said}: between more than two")
            world.beside(children, "next_to", sides[:1])
            return
        world.arrange("between", children, sides)
        for index, neighbour in enumerate(sides):
            world.beside([neighbour], "right_of" if index % 2 else "left_of", children[:1])

    def _on_half(self, children: list[Item], side: str, parents: list[Item]) -> None:
        """Read "on the left side of the table": on it when it is a surface, else beside it."""
        world, parent = self._world, parents[0]
        level = world.is_a(parent, lexicon.LEVEL, lexicon.SEATS)
        self._landmark = (parents, True)
        if side == "centre" or (level and not world.on_floor(children[0])):
            kind = world.containment(parent)
            world.place(children, kind, parents)
            world.sided.append(Sided(items=children, side=side, owner=[], implied=[]))
        else:
            world.beside(children, "left_of" if side == "left" else "right_of", parents)

    # Having

    def _had(self, at: int, owner_heads: Sequence[int], child_heads: Sequence[int]) -> None:
        link = self._chunks[at].link
        assert link is not None
        self._have(link, owner_heads, child_heads)

    def _listed(self, at: int, owner_heads: Sequence[int], child_heads: Sequence[int]) -> None:
        self._have(Link(manner="with"), owner_heads, child_heads)

    def _have(self, link: Link, owner_heads: Sequence[int], child_heads: Sequence[int]) -> None:
        world = self._world
        owners = self._refs_of(owner_heads)
        each = any(head in self._each for head in owner_heads)
        ordered = [(head, self._chunks[head].phrase) for head in child_heads]
        things = [head for head, phrase in ordered if phrase and phrase.kind not in ("part", "pieces", "background")]
        for head, phrase in ordered:
            if phrase is not None and phrase.kind == "part":
                self._own_part(owners, phrase)
            elif phrase is not None and phrase.kind == "background" and phrase.substance:
                # What fills a vessel is named in a note when the phrase is made.
                continue
            elif phrase is not None and phrase.kind == "pieces" and link.manner not in ("include", "with") and owners:
                things.append(head)
        if not owners or link.manner == "include":
            return
        children = self._refs_of(sorted(things))
        if not children:
            return
        if link.manner == "flank":
            sides = [self._sides.get(head, "") for head in things for _ in self._ref(head)]
            self._flanked(children, owners, sides)
            return
        if each and len(children) < len(owners):
            multiply(world, children, len(owners))
            for head in things:
                self._refs[head] = [
                    item for group in dict.fromkeys(i.group for i in self._ref(head)) for item in group.items
                ]
        for head in things:
            items = [item for item in self._ref(head) if item not in owners]
            if items:
                self._hold(link, owners, items)

    def _own_part(self, owners: list[Item], phrase: Phrase) -> None:
        for group in dict.fromkeys(item.group for item in owners):
            words = phrase.modifiers
            if words.colours or words.palette or words.material:
                describe(group, words, part=phrase.said)
            elif phrase.said not in lexicon.SILENT_PARTS or words.adjectives:
                self._world.note(f'not modelled: "{phrase.words}" of "{group.words}"')
        if not owners and phrase.words not in self._world.aside:
            self._world.aside.append(phrase.words)

    def _hold(self, link: Link, owners: list[Item], children: list[Item]) -> None:
        world, owner = self._world, owners[0]
        self._settle(children, owners)
        weak = link.manner == "with" and link.kind is None
        if link.manner == "surround":
            world.beside(children, "around", owners)
        elif link.kind == "on":
            world.place(children, "on", owners)
        elif (
            weak
            and world.is_a(children[0], lexicon.ON_HEAD)
            and not world.flat(owner)
            and not world.is_a(owner, lexicon.HOLLOW)
        ):
            world.place(children, "on", owners, weak=True)
        elif weak and world.on_floor(children[0]):
            around = len(children) >= 3 and world.is_a(children[0], ("chair", "stool", "armchair"))
            world.beside(children, "around" if around else "next_to", owners, weak=True)
        elif (
            not weak
            or world.is_a(owner, lexicon.HOLLOW)
            or world.flat(owner)
            or world.likely.on(world.noun(children[0]), world.noun(owner)) < 0.6
        ):
            kind = world.containment(owner)
            world.place(children, kind, owners, weak=weak)
        else:
            world.beside(children, "next_to", owners, weak=True)

    # Places without a landmark

    def _placed(self, at: int, heads: Sequence[int], owner_heads: Sequence[int]) -> None:
        """Read "a plate with a fork on the left", "a mug, and a bowl nearby"."""
        world = self._world
        chunk = self._chunks[at]
        children = self._refs_of(heads)
        owners = self._refs_of(owner_heads)
        if not children:
            return
        begun = self._begun(at, heads)
        implied = begun or self._previous(at)
        if chunk.link is not None:
            depth = chunk.link.kind in ("in_front_of", "behind") and not set(self._landmark[0]) & set(children)
            parents = owners or (self._landmark[0] if depth else []) or implied
            lateral = chunk.link.kind in LATERAL_KINDS
            if owners and lateral and world.is_table(owners[0]) and not world.on_floor(children[0]):
                others = [item for item in self._on(owners[0]) if item not in children]
                world.place(children, "on", owners, weak=True)
                parents = others[:1] or owners
            if not parents and chunk.link.kind in ("in_front_of", "behind"):
                side = "front" if chunk.link.kind == "in_front_of" else "back"
                world.sided.append(Sided(items=children, side=side, owner=[], implied=[]))
            elif not parents:
                world.note(f'"{children[0].group.words}": what it is {chunk.text} is not said.')
            else:
                self.relate(children, chunk.link, parents)
            return
        side = chunk.text
        if side == "both":
            parents = owners or [item for item in implied if item not in children]
            if parents:
                self._both_sides(children, parents[:1])
            return
        if owners:
            world.sided.append(Sided(items=children, side=side, owner=owners, implied=[]))
            level = world.is_a(owners[0], lexicon.LEVEL, lexicon.SEATS)
            if level and world.support(children[0]) is None and not world.on_floor(children[0]):
                world.place(children, world.containment(owners[0]), owners, weak=True)
            return
        landmark, surface = self._landmark if self._landmark[0] else ([], False) if begun else world.landmark
        if landmark and side in ("left", "right", "centre") and not set(landmark) & set(children):
            half = surface or side == "centre"
            link = Link(manner="half", kind="on", side=side) if half else Link(kind=_SIDES[side])  # type: ignore[arg-type]
            self.relate(children, link, landmark)
            return
        world.sided.append(Sided(items=children, side=side, owner=[], implied=implied, begun=bool(begun)))

    def _on(self, parent: Item) -> list[Item]:
        return [item for item in self._world.items() if self._world.support(item) is parent]

    def _begun(self, at: int, heads: Sequence[int]) -> list[Item]:
        """What the clause begins with, besides what the place is said of."""
        start = max((start for start in self._clauses if start <= at), default=0)
        first = next((head for head in self._clauses[start] if head not in heads), None)
        if first is None or first > min(heads, default=at):
            return []
        return self._ref(first)

    def _previous(self, at: int) -> list[Item]:
        starts = [start for start in sorted(self._clauses) if start <= at]
        for start in reversed(starts[:-1]):
            if items := self._ref(self._clauses[start][0]):
                return items
        return self._world.subject

    # Forms

    def _formed(self, at: int, heads: Sequence[int]) -> None:
        chunk = self._chunks[at]
        world = self._world
        groups = list(dict.fromkeys(item.group for item in self._refs_of(heads)))
        if not groups:
            world.note(f'"{chunk.text}": of what is not said.')
            return
        whole = groups[0] if len(groups) == 1 and len(groups[0].items) > 1 else None
        items = [item for group in groups for item in group.items]
        if chunk.text in ("rows", "stacks"):
            plural = next((group for group in groups if len(group.items) > 1), None)
            if plural is None:
                world.note(f'"{chunk.size} {chunk.text}": of what is not said.')
                return
            before = set(plural.items)
            recount(world, plural, chunk.size * chunk.each)
            for head, items in self._refs.items():
                if set(items) == before:
                    self._refs[head] = list(plural.items)
            if chunk.text == "rows":
                plural.rows = chunk.size
            else:
                plural.height = -(-len(plural.items) // chunk.size)
        elif chunk.text in ("stack", "tower"):
            self._stacked(groups, tall=whole is not None or chunk.text == "tower")
        elif chunk.link is not None and chunk.text != "beside":
            kind = chunk.link.says or "far_from"
            world.arrange(kind, items, (), f'"{groups[0].words}" {chunk.text.replace("_", " ")} each other')
        elif chunk.text == "circle":
            world.arrange("circle", items, (), f'"{groups[0].words}" in a circle')
        elif whole is not None:
            whole.rows = 1
            world.arrange("row", items)
        else:
            ordered = items[::-1] if chunk.text == "reverse" else items
            world.arrange("row", ordered)
            for left, right in zip(ordered, ordered[1:], strict=False):
                if chunk.text == "beside":
                    world.beside([right], "next_to", [left])
                else:
                    world.beside([left], "left_of", [right])

    def _stacked(self, groups: list[Group], *, tall: bool) -> None:
        """Put each of `groups` on the one before, or where they are several objects each on one another."""
        for group in groups:
            if group.height == 1 and (tall or all(len(each.items) > 1 for each in groups)):
                group.height = len(group.items)
        if tall or any(len(each.items) == 1 for each in groups):
            for lower, upper in zip(groups, groups[1:], strict=False):
                self._world.place(upper.items, "on", lower.items)


def _colours(item: Item) -> tuple[str, ...]:
    return item.colours if item.colours is not None else item.group.modifiers.colours


def _position(phrase: Phrase) -> str:
    """The place by which `phrase` tells its object from others of the kind ("left"), or nothing."""
    found = next((word for word in phrase.modifiers.adjectives if word in lexicon.POSITIONS), "")
    return _SAME.get(found, found) if phrase.definite else ""


def _same_noun(group: Group, phrase: Phrase) -> bool:
    if phrase.kind == "unknown":
        return group.proxy and group.said == phrase.head
    return group.noun == phrase.noun if phrase.noun else bool(group.cycle) and group.cycle == phrase.cycle


def _same_head(group: Group, phrase: Phrase) -> bool:
    """Whether "the ..." may call `group` by its last word: "bowl" for a fruit bowl, "loaf" for a loaf of bread."""
    wanted = {phrase.said or phrase.head, *singulars(phrase.said or phrase.head)}
    names = (group.said, group.noun) if not group.proxy else (group.said,)
    heads = {word for name in names for words in [name.split(" of ")] for word in words[0].split()[-1:]}
    return not group.cycle and bool(wanted & heads)
