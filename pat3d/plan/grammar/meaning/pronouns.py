"""What pronouns speak of: what makes the relation likely, what the clause is about, what is nearest."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.failures import UnreadError
from pat3d.plan.grammar.meaning import apart
from pat3d.plan.grammar.meaning.entities import Group, Item
from pat3d.plan.grammar.meaning.matching import LATERAL_SIDES
from pat3d.plan.grammar.meaning.objects import Maker
from pat3d.plan.grammar.meaning.relating import Relating
from pat3d.plan.grammar.meaning.world import World
from pat3d.plan.grammar.rewriting.rooms import ROOMS
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import INSIDE, Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS
from pat3d.plan.grammar.words.number_words import ORDINALS
from pat3d.scene.relations import LATERAL_KINDS, OPPOSITE, SUPPORT_KINDS

_CLOSE = 0.1
"""Readings of a pronoun that differ by less in cost are both told."""
_BROAD = ("dog", "cat", "rabbit", "robot", "backpack", "barrel", "drum")
"""What may carry something, though few would put it there."""
_CARRIED = 0.6
"""Cost of being on something below which "it" is that sooner than what is named last."""
_PLURAL = frozenset({"them", "they", "these", "those", "their", "all", "each"})
_SHUT = 1.3
"""Cost of something being inside what nothing is inside of."""
_UPON = 1.2
"""Cost of being on something that may be "on top of it"."""
_STACKED = -0.1
"""Cost of being on a stack."""


class Pronouns:
    """What the phrases of one sentence speak of so far."""

    def __init__(self, world: World, chunks: Sequence[Chunk], maker: Maker, relating: Relating) -> None:
        self._world = world
        self._chunks = chunks
        self._maker = maker
        self._relating = relating
        self._earlier = list(world.groups)
        self.cost = 0.0
        """Of pronouns that are not sure."""
        self.known: dict[int, list[Item]] = {}
        """What the phrases speak of, by chunk."""
        self.bound: dict[int, tuple[int, ...]] = {}
        """Pronouns of which the grammar says what they mean."""
        self.each: set[int] = set()
        """Phrases that speak of every one of a group."""
        self.all: set[int] = set()
        """Phrases that speak of all of a group: "both"."""
        self.clauses: dict[int, tuple[int, ...]] = {}
        """What the clauses are about, by where they begin."""
        self.fronts: set[int] = set()
        """Phrases of the modifier that a clause opens with: "behind it there is"."""
        self.asked = False
        """Whether the clause tells what is to be done."""
        self.stacking = False
        """Whether that is to stack something."""
        self.left: list[Item] = []
        """What is excepted of all that is spoken of."""
        self.goals: set[int] = set()
        """Relation words that say where something is to go."""
        self.related: list[tuple[set[int], set[int]]] = []
        """Phrases that a relation joins, so that they are different objects."""

    @property
    def before(self) -> Sequence[Group]:
        """What the clauses before have named."""
        return self._earlier

    def ref(self, at: int) -> list[Item]:
        """What chunk `at` speaks of."""
        if at in self.known:
            items = self.known[at]
            if at in self.each and len(items) == 1 and items[0].group.multiplied:
                # "a cushion on each chair and a cat on each cushion": of all that there are by now.
                return list(items[0].group.items)
            return items
        if at in self.bound:
            return [item for head in self.bound[at] for item in self.ref(head)]
        return []

    def ref_all(self, heads: Sequence[int]) -> list[Item]:
        """What the chunks `heads` speak of together."""
        return [item for head in heads for item in self.ref(head) if item in item.group.items]

    def speaks_of_each(self, heads: Sequence[int], *, carrying: bool = False) -> bool:
        """Whether one of `heads` speaks of every one of a group; "both" does where they carry ("both with a lid")."""
        told = self.each | self.all if carrying else self.each
        return any(inner in told for head in heads for inner in self._meant(head))

    def for_each(self, heads: Sequence[int], children: Sequence[Item], parents: Sequence[Item]) -> bool:
        """Whether there are as many of `children` at each of `parents`: "three forks left of each plate"."""
        fresh = all(not (item.group.phrase.definite or item.group.multiplied) for item in children)
        whole = all(set(item.group.items) <= set(children) for item in children)
        return self.speaks_of_each(heads) and fresh and whole and len(parents) > 1 < len(children)

    def _meant(self, head: int) -> tuple[int, ...]:
        """What the grammar says that `head` means, itself where it says nothing."""
        return (
            tuple(inner for each in self.bound[head] for inner in self._meant(each)) if head in self.bound else (head,)
        )

    def _pronoun(self, at: int, link: Link | None, other: Sequence[Item], *, child: bool) -> list[Item]:
        """What "it" means: what makes the relation likely, the subject of the clause before, then what is nearest."""
        phrase = self._chunks[at].named
        plural = phrase.head in _PLURAL
        # "Under the lamp lies a map. A pen is on the map and next to it is a cup": not next to the lamp; "on the stool
        # lies a hat, under it a glove": of what was in front in the sentence before nothing is said.
        told = [item for key, items in self.known.items() if key < at for item in items]
        opens = at == min(self.fronts, default=-1) and {*told} <= {*self._world.front, *other}
        world_front = self._world.front if opens else []
        candidates: list[tuple[float, list[Item]]] = []
        starts = [start for start in sorted(self.clauses) if start < at]
        heads = [self.clauses[start] for start in reversed(starts)]
        before = [[i for head in each if head < at for i in self.ref(head) if i not in other] for each in heads]
        groups = {item.group for item in other}
        together = [item for item in self._world.together if item.group not in groups]
        before += [together if plural and len(together) > 1 else self._world.subject]
        if plural and len([each for each in before if each]) > 1:
            # "A lamp is on the left, a plant on the right, and between them a radio."
            together = [item for each in reversed(before) for item in each if item not in other]
            candidates.append((0.15, list(dict.fromkeys(together))))
        if plural and len(before[0]) == 1 and (upon := [i for i in self.carried_by(before[0]) if i not in other]):
            # "A bench holds a pen and a ruler. They are pink."
            candidates.append((0.25, upon))
        alone = next((each[0] for each in before if plural and len(each) == 1), None)
        partners = [edge.parent for edge in self._world.laterals if edge.child is alone]
        if alone is not None and partners:
            # "A lamp is left of a sofa, and a plant stands between them."
            candidates.append((0.1, [alone, *(item for item in partners if item not in other)]))
        which = phrase.head == "which"
        near = which or phrase.head in lexicon.DEMONSTRATIVES
        # "Next to it is a mug. Next to that is a pen.": next to the mug, and to no landmark of before.
        pointing = self._chunks[at].text.lower() in lexicon.DEMONSTRATIVES
        meant = [self.known[key] for key in self.known if key < at and self._is_pronoun(key) and self.known[key]]
        if meant and not (plural or pointing):
            # "behind it a mug, and in front of it a bowl" speaks twice of the same.
            # "A ball is by the box, one is in it, one on it, and one behind it": by none of the balls.
            again = meant[-2:] == [meant[-1]] * 2 and any(self._is_further(key) for key in self.known)
            candidates.append((-0.8 if again else -0.6 if which else -0.1, meant[-1]))
        if link is not None and link.kind in LATERAL_KINDS and not (child or plural):
            # "A laptop is on a desk; to its right is a mouse, and behind it a lamp": behind the laptop.
            candidates.append((-0.2, self._told_by_its_side(at)))
            candidates.append((-1.0, self._owner_of(other, at)))
            candidates.append((-1.7, self._world.below_told(next((each for each in before if each), []), other)))
        steps, unread = self._world.steps, self._world.unread
        if child and self.asked and unread is not None:
            if not unread or {*unread} & {*other}:
                raise UnreadError(f'"{phrase.words}" (word {phrase.number}): what that is was not read.', phrase.number)
            candidates.append((-2.4, unread))
        if child and not plural and steps and steps[-1].manner == "pick":
            # "Pick the bowl on the box and place it on the plate"
            if not steps[-1].items:
                raise PromptError(
                    f'"{steps[-1].said}" names no object of the scene, and so "{phrase.words}" (word '
                    f"{phrase.number}) is none. "
                    "Name the thing itself."
                )
            candidates.append((-1.2, list(steps[-1].items)))
        if child and not plural and steps and steps[-1].goal and self._world.is_a(steps[-1].goal[0], lexicon.THIN):
            # "Wrap the vase in newspaper and stand it in the crate": the vase, whatever goes into crates.
            candidates.append((-2.0, list(steps[-1].items)))
        if self.stacking and not child and not plural and steps and len(steps[-1].items) == 1:
            # "Put the red block on the mat and stack the other two on it": on the red block.
            candidates.append((-0.8, list(steps[-1].items)))
        if self.asked and link is not None and not (child or plural) and steps and (aimed := steps[-1].link):
            # "Put the fork left of the plate and the knife right of it"
            across = link.kind is not None and OPPOSITE.get(link.kind) == aimed.kind
            candidates += [(-0.6, list(steps[-1].goal))] if across else []
        if child and plural and steps and steps[-1].manner == "stack":
            # "Stack the bowl on the plate and place them in the tray"
            candidates.append((-1.2, [*steps[-1].items, *steps[-1].goal]))
        if world_front and not pointing:
            # "Behind the sofa: a lamp. In front of it: a rug."; "Left of the sofa is a lamp. In front of it is a rug."
            said = [edge.kind for edge in self._world.laterals if edge.parent in world_front]
            turned = link is None or link.kind not in LATERAL_KINDS or not said or OPPOSITE.get(said[-1]) == link.kind
            about = next((each for each in before if each), [])
            if link is not None and link.kind in SUPPORT_KINDS and about and not (child or self._is_also(at)):
                # "On the table is a plate. On it are two eggs": on the plate; but "is a laptop. On it is a mug".
                bears = self._world.is_a(about[0], lexicon.DISHES, vessels.HOLLOW)
                candidates.append((0.25 if bears else -0.4, world_front))
            else:
                candidates.append((-0.4 if turned else 0.05, world_front))
        landmark = [] if near or pointing else self._relating.landmark[0]
        if landmark and not self._comes_later(landmark, at):
            # "A fork is left of a plate and a knife right of it"
            aside = link is not None and link.kind in LATERAL_SIDES.values() and link.manner != "between"
            across = link is not None and any(
                edge.parent in landmark and OPPOSITE.get(edge.kind) == link.kind for edge in self._world.laterals
            )
            # "A lamp is left of the sofa and a plant right of it": across the sofa from the lamp.
            upon = [i for i in next((each for each in before if each), []) if self._world.support(i) in landmark]
            if aside and upon and self._relating.landmark[1] and not child:
                # "A king is in the middle of a board, a pawn in front of it": of the king.
                candidates.append((-0.3, upon))
                aside = False
            candidates.append((-0.6 if across and aside else 0.3 if child else -0.15 if aside else 0.1, landmark))
        for rank, items in enumerate([each for each in before if each]):
            candidates.append((0.2 * rank + 0.3 * which, items))
        told = next((each for each in before if each), [])
        below = self._world.support(told[0]) if told and not (child or plural) else None
        links = [piece.relation for piece in self._chunks[: at - 1] if piece.kind == "rel"]
        within = bool(links) and links[-1].kind == "in" and links[-1].manner == "place"
        figure = bool(other) and self._world.is_a(other[0], lexicon.FIGURES)
        if below is not None and within and figure and link is not None and link.kind in LATERAL_KINDS:
            # "A doll sits in a cart and a bear stands behind it": behind the cart.
            candidates.append((-1.5, [below]))
        if below is not None and link is not None and link.kind in SUPPORT_KINDS and self._is_also(at):
            # "A cube is on a bench. A bottle is on it, too."
            candidates.append((-0.8, [below]))
        opened = any(below in self.known.get(head, ()) for head in self.fronts if head < at)
        if below is not None and opened and link is not None and link.manner == "under":
            # "By a bench is a stool. On the stool lies a hat, under it a glove.": under the stool.
            candidates.append((0.1, [below]))
        silent = {key for key in self.known if pointing and self._is_pronoun(key) and not self._is_further(key)}
        named = [key for key in sorted(self.known, reverse=True) if key not in silent]
        nearest = [self.known[key] for key in named if key < at and self.known[key]]
        nearest = [items for items in nearest if not set(items) & set(other)]
        if plural and len(nearest) > 1 and len(nearest[0]) == 1:
            candidates.append((0.15, list(dict.fromkeys([*nearest[1], *nearest[0]]))))
        for rank, items in enumerate(nearest[:4]):
            # "That" is what is named last.
            nearer = (-0.5 if which else -0.3) + (0.6 if pointing else 0.3) * rank
            candidates.append((nearer if near else 0.35 + 0.1 * rank, items))
        for rank, group in enumerate(reversed(self._earlier[-3:])):
            candidates.append((0.6 + 0.2 * rank, group.items))
        further = any(self._is_further(key) for key, items in self.known.items() if set(items) & set(other))
        part = not plural and bool(other) and apart.are_some(other)
        best: tuple[float, list[Item]] | None = None
        rival: tuple[float, list[Item]] | None = None
        doubted: list[Item] = []
        for cost, items in candidates:
            if not items or set(items) & set(other) or items[0].group.replaced:
                continue
            if part and len(items) > 1 and items[0].group is other[0].group:
                # "Six pens in a cup, one of them beside it"
                continue
            # A stack is "it".
            if plural != (len(self._world.bases(items)) > 1):
                cost += 0.7 if plural else 0.4
            # "On the shelf is a thick book, and a thin one lies on it": on the book.
            told = bool(other) and link is not None and link.kind == "on"
            told = told and other[0].group.modifiers != NO_MODIFIERS
            if not plural and other and not told and items[0].group.noun == other[0].group.noun:
                # "a wrench in the box, another on it": on the box; "another beside it": beside the first wrench.
                unlike = items[0].group.modifiers.colours != other[0].group.modifiers.colours != ()
                aside = link is not None and link.kind in LATERAL_KINDS
                # "A cube on the table, another on top of it, a third on that": each on the one before.
                topped = link is not None and link.kind == "on" and ("top" in self._chunks[at - 1].words or pointing)
                noun = items[0].group.noun
                stacks = self._world.is_a(items[0], lexicon.STACKABLE) or self._world.likely.on(noun, noun) < _CARRIED
                piled = further and topped and stacks and not child
                cost += -0.6 if ((further or unlike) and aside) or piled else 0.6
                # "A gift is on the chair, another under it": under the chair.
                cost += 1.7 * (further and link is not None and link.manner == "under")
            if link is not None and other:
                world = self._world
                pair = (items[0], other[0]) if child else (other[0], items[0])
                likely = world.likely.relation(link, world.noun(pair[0]), world.noun(pair[1]))
                if (link.kind == "in" or link.said == INSIDE) and not child:
                    # "A desk has a bowl on it. It contains two plums."
                    likely = likely * (link.kind == "in") + _SHUT * (not world.likely.opens(world.noun(items[0])))
                thin = world.is_a(other[0], lexicon.THIN)
                borne = any(edge.parent is items[0] and edge.kind != "hangs_from" for edge in world.supports.values())
                bough = borne and world.is_a(items[0], lexicon.BOUGHS)
                if (
                    link.manner == "under"
                    and not (child or thin)
                    and (bough or world.is_a(items[0], lexicon.OVERHANGING))
                ):
                    # "A bear sits on a chair, and a ball is under it": under the chair.
                    cost -= 1.4 if bough else 0.6
                if items[0].group.height > 1 and link.kind == "on" and not child:
                    # "A stack of plates is on the desk. A cup is on top of it": what is stacked carries.
                    likely = min(likely, _STACKED)
                top = link.kind == "on" and not child and "top" in self._chunks[at - 1].words and items in before[:1]
                if top and likely < _UPON and items[0].group.noun != other[0].group.noun:
                    # "A coffee machine on the counter, a bag on top of it": few say it of a counter, but one may.
                    doubted, likely = (items if likely > _CARRIED else doubted), min(likely, _CARRIED / 2)
                # "A crate stands next to the bed, and a book lies on it": on what the clause before is about.
                carries = (
                    not (child or near) and link.kind in SUPPORT_KINDS and items in before[:1] and likely < _CARRIED
                )
                cost += max(0.0, likely - _CARRIED / 2) if carries else likely
                if (
                    not part
                    and link.kind in LATERAL_KINDS
                    and (world.support(pair[0]) is pair[1] or world.support(pair[1]) is pair[0])
                ):
                    # "A glass of juice and, next to it, a plate": nothing is beside what it carries.
                    cost += 1.0
            if best is None or cost < best[0]:
                if best is not None and set(best[1]) != set(items):
                    rival = best
                best = (cost, list(items))
            elif set(best[1]) != set(items) and (rival is None or cost < rival[0]):
                rival = (cost, list(items))
        if best is None:
            said = f'"{phrase.words}" (word {phrase.number}): nothing before it is meant. Name the thing itself.'
            raise UnreadError(said, phrase.number)
        pair = best[1][0].group
        one = len(best[1]) == 1 and pair.height == 1 and not (pair.phrase.plural or pair.phrase.each)
        if plural and one and pair.said not in lexicon.PLURAL_ONLY:
            self._world.note(f'"{phrase.words}" (word {phrase.number}) is read as "{pair.words}", which is one.')
        # "A tray holds two vases. They are purple."
        single = (
            plural and rival is not None and len(self._world.bases(rival[1])) == 1 < len(self._world.bases(best[1]))
        )
        if (
            not (which or single)
            and rival is not None
            and rival[0] - best[0] < _CLOSE
            and not set(rival[1]) & set(best[1])
        ):
            read, other_words = (each[1][0].group.words for each in (best, rival))
            self._world.note(f'"{phrase.words}" (word {phrase.number}) is read as "{read}"; it may be "{other_words}".')
        if (under := self._world.support(best[1][0])) is not None and doubted == best[1]:
            read = f'"{phrase.words}" (word {phrase.number}) is read as "{pair.words}"'
            self._world.note(f'{read}; it may be "{under.group.words}".')
        about = next((each for each in before if each), best[1])
        aside = not child and link is not None and link.kind in SUPPORT_KINDS and not set(about) & set(best[1])
        if aside and not plural and self._world.is_a(about[0], _BROAD, vessels.LARGE_VESSELS):
            # "A dog lies in front of a sofa, and a ball is on it": few things lie on a dog, but one may.
            read, other_words = (each[0].group.words for each in (best[1], about))
            self._world.note(f'"{phrase.words}" (word {phrase.number}) is read as "{read}"; it may be "{other_words}".')
        room = next((each for each in self._world.aside if ROOMS & {*each.lower().split()[-1:]}), "")
        if room and link is not None and link.kind == "in" and not child and self._world.on_floor(best[1][0]):
            # "A bathroom with a sink and a toilet. A cup is in it."
            self._world.note(f'"{phrase.words}" (word {phrase.number}) is read as "{pair.words}"; it may be "{room}".')
        if self.asked and not plural and not steps and (upon := self._carried(best[1])) is not None:
            # "The tray has a fork on it. Put it on the shelf."
            self._world.note(f'"{phrase.words}" (word {phrase.number}) is read as "{pair.words}"; it may be "{upon}".')
        self.cost += min(best[0], 1.5)
        if not (child or plural):
            # "On it is a towel. Behind it ..." goes on from the towel.
            self._world.spoken = [] if at in self.fronts else best[1]
        return best[1]

    def carried_by(self, items: Sequence[Item]) -> list[Item]:
        """What `items` are said to have on or in them, where that is several things."""
        upon = [item for item in self._world.items() if self._world.support(item) in items]
        return upon if len(upon) > 1 else []

    def _told_by_its_side(self, at: int) -> list[Item]:
        """What "its" means of the last "to its right" that opens a clause before chunk `at`."""
        openings = (
            n for n in range(at - 1, -1, -1) if self._chunks[n].kind == "place" and "its" in self._chunks[n].words
        )
        side = next((n for n in openings if n in self.clauses), None)
        if side is None:
            return []
        heads = next((self.clauses[start] for start in sorted(self.clauses, reverse=True) if start < side), ())
        return [item for head in heads for item in self.ref(head)] or list(self._world.subject)

    def _owner_of(self, items: Sequence[Item], at: int) -> list[Item]:
        """What is named last before chunk `at` of what the lids `items` close, or what has "its saucer"."""
        world, own = self._world, any(item.group.phrase.possessive for item in items)
        lids = bool(items) and all(world.is_a(item, vessels.ON_RIMS) for item in items)
        told = [each for key in sorted(self.known, reverse=True) if key < at for each in reversed(self.known[key])]
        told += [each for group in reversed(self._earlier) for each in reversed(group.items)]
        carriers = {*items, *(() if lids else (edge.parent for edge in world.supports.values()))}
        free = (each for each in told if each not in carriers and (lids or own))
        return next(([each] for each in free if not lids or world.closes(items, each)), [])

    def _carried(self, items: Sequence[Item]) -> str | None:
        """The words for the one thing that `items` are said to have on or in them, named behind them; None without."""
        upon = [item for item in self._world.items() if self._world.support(item) in items]
        named = [item.group for item in upon if len(item.group.items) == 1 and item.group not in (items[0].group,)]
        order = self._world.groups
        later = [group for group in named if order.index(group) > order.index(items[0].group)]
        return later[-1].words if later else None

    def _is_also(self, at: int) -> bool:
        """Whether what chunk `at` ends is told of one thing more: "is also on it", "is on it, too"."""
        return any(piece.also for piece in self._chunks[max(at - 3, 0) : at + 1])

    def _is_further(self, at: int) -> bool:
        """Whether chunk `at` speaks of one more of a kind: "another", "a second basket"."""
        phrase = self._chunks[at].phrase
        if phrase is None or phrase.definite:
            return False
        opening = phrase.words.lower().split()[:2]
        return phrase.head == "another" or phrase.other or (opening[:1] == ["a"] and opening[-1] in ORDINALS)

    def _comes_later(self, items: Sequence[Item], at: int) -> bool:
        """Whether `items` are named behind chunk `at` first: "It stands before a radio, which is behind a crate"."""
        named = [key for key, known in self.known.items() if set(known) & set(items)]
        return min(named, default=at) > at

    def _is_pronoun(self, at: int) -> bool:
        phrase = self._chunks[at].phrase
        return phrase is not None and phrase.kind == "pronoun"
