"""What one reading of a sentence adds to the scene: references are resolved, relations recorded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.plausible import USUAL
from pat3d.plan.grammar.meaning import apart
from pat3d.plan.grammar.meaning.account import miscounted, words_left
from pat3d.plan.grammar.meaning.contradictions import refuse_own
from pat3d.plan.grammar.meaning.counting import multiply, recount, tell_colours
from pat3d.plan.grammar.meaning.described import compared, describe, tell
from pat3d.plan.grammar.meaning.distribution import as_many, for_each, on_top_of_both, share
from pat3d.plan.grammar.meaning.entities import Item
from pat3d.plan.grammar.meaning.holding import Holding
from pat3d.plan.grammar.meaning.matching import LATERAL_SIDES, position, ranked
from pat3d.plan.grammar.parsing.chart import Node
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.links import ACROSS, Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS, Modifiers
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_UNHEARD = 0.8
"""What a reading costs in which nothing is said of so many of them."""
_TWICE = 1.5
"""What it costs where a list names one thing twice."""
_COUNTING = ("rows", "stacks", "stack", "tower")
"""Forms that may say how many there are, and so are read before all relations."""
_ROLLING = frozenset({"roll", "squeeze", "bounce", "drive", "steer", "wheel", "spin"})
"""Verbs by which a thing comes to be beside another."""


class Interpreter(Holding):
    """Adds one reading of a sentence to a world."""

    def add(self, reading: Node) -> float:
        """Add `reading`; what its references cost.

        Raises:
            PromptError: it cannot be a scene.
        """
        facts = reading.facts
        for fact in facts:
            if fact[0] == "extra" and not self._ends_on_something(facts):
                self._clause = replace(self._clause, manner="other")
        self._said.bound = {fact[1]: fact[2] for fact in facts if fact[0] == "bind"}
        clauses = {fact[2]: fact[1] for fact in facts if fact[0] == "subject"}
        self._said.clauses = {**clauses} or {0: reading.heads}
        fillings, kinds = self._fillings(facts)
        self._sides = {head: self._chunks[fact[1]].text for fact in facts if fact[0] == "side" for head in fact[2]}
        self._said.asked, self._said.stacking = self._clause.manner is not None, self._clause.manner == "stack"
        self._said.goals = {fact[1] for fact in facts if fact[0] == "goal"}
        self._said.related = [
            (set(fact[2]), set(fact[3])) for fact in facts if fact[0] in ("rel", "have", "list", "goal", "place")
        ]
        self._chunks = self._said.with_parts(facts)
        self._said.fronts = {head for fact in facts if fact[0] == "front" for head in fact[1]}
        # "A cup and a can, the can in a box": the can alone is.
        listed = [fact[3] if fact[0] == "have" else fact[2] for fact in facts if fact[0] in ("have", "rel")]
        # "A tray with two cups, the cups are red": the tray is not.
        nouns = [at for at, chunk in enumerate(self._chunks) if chunk.phrase is not None]
        listed += [[n for n in nouns if n <= max(fact[2])] for fact in facts if fact[0] == "quality" and fact[2][1:]]
        self._said.cost += _TWICE * any(map(self._listed_twice, listed))
        qualities = [fact for fact in facts if fact[0] == "quality"]
        for at, chunk in enumerate(self._chunks):
            if chunk.phrase is None:
                continue
            # "One of them is red, and a can is next to the red one": told before it is spoken of.
            for fact in [fact for fact in qualities if fact[1] < at and all(map(self._said.ref, fact[2]))]:
                self._qualified(fact[2], self._chunks[fact[1]].modifiers)
                qualities.remove(fact)
            self._said.create(at, chunk.phrase, filling=at in fillings, kind=kinds.get(at))
        for fact in facts:
            if fact[0] == "form" and self._chunks[fact[1]].text in _COUNTING:
                self._form(fact[1], fact[2])
        for fact in sorted(facts, key=lambda fact: self._of_some(fact) or self._beside_both(fact, facts)):
            handler = {"rel": self._related, "have": self._had, "list": self._listed}.get(fact[0])
            if handler is not None and not self._means(fact):
                self._effect(handler, fact[1], fact[2], fact[3])
        owners: Sequence[int] = ()
        moved = any(fact[0] == "goal" for fact in facts)
        for fact in facts:
            side = fact[0] == "place" and self._chunks[fact[1]].text in LATERAL_SIDES
            if side and moved and not fact[3]:
                # "put the fork left of the plate and the knife to the right": nothing stands there yet.
                self._world.note(f'not understood: "{" ".join(self._chunks[fact[1]].words)}"')
            elif fact[0] == "place":
                # "with a fork to its left and a knife to its right": of the same thing.
                owned = {"its", "their"} & set(self._chunks[fact[1]].words)
                owners = fact[3] or (owners if owned else ())
                self._effect(self._placed, fact[1], fact[2], owners)
            elif fact[0] == "form" and self._chunks[fact[1]].text not in _COUNTING:
                self._form(fact[1], fact[2])
            elif fact in qualities:
                self._qualified(fact[2], self._chunks[fact[1]].modifiers)
            elif fact[0] == "goal":
                self._aimed(fact[1], fact[2], fact[3])
        if self._clause.manner is not None:
            self._note_goal(facts)
            self._with_landmarks(facts)
        if self._clause.manner is not None and not (self._put_abreast() or any(fact[0] == "goal" for fact in facts)):
            self._done(reading.heads)
        told = {at for fact in facts if fact[0] in ("list", "include") for at in fact[3]}
        for at, chunk in enumerate(self._chunks):
            kind = chunk.phrase.kind if chunk.phrase is not None else ""
            if kind in ("items", "pieces") and at not in self._said.bound and at not in self._handled | told:
                self._said.not_understood([at])
        world = self._world
        subject = self._said.ref(reading.heads[0]) if reading.heads else []
        last, world.unread = max(self._said.clauses), None
        world.subject = self._said.ref(self._said.clauses[last][0]) or subject or world.subject
        if self._clause.manner is not None:
            # "Pick the sponge and the pan, place them in the sink": both.
            world.subject = list(dict.fromkeys(self._said.ref_all(reading.heads))) or subject or world.subject
        if len(world.subject) == 1 and world.subject[0].group.multiplied:
            # "A mug stands at each end of the shelf. Between them ..."
            world.subject = list(world.subject[0].group.items)
        world.together = self._told_of(reading.heads)
        world.landmark = self._relating.landmark
        world.front = self._said.ref_all(sorted(self._said.fronts))
        if self._clause.manner is None:
            self._with_carriers(facts)
            self._relating.cost += self._loose()
        self._account(facts)
        return self._relating.cost + self._said.cost

    def _listed_twice(self, heads: Sequence[int]) -> bool:
        """Whether a list names one thing twice: "a box holding a cup, and the cup" where "holds a pen" goes on."""
        named = [self._chunks[head].named for head in heads]
        pairs = [(one, other) for at, other in enumerate(named) for one in named[:at] if one.noun == other.noun]
        return any(
            one.kind == other.kind == "object" and other.definite and not (one.definite or other.other)
            and (other.plural or one.count in (None, 1)) and {*other.modifiers.colours} <= {*one.modifiers.colours}
            for one, other in pairs
        )  # fmt: skip

    def _of_some(self, fact: tuple) -> bool:
        """Whether `fact` says where some of several are, which is heard after where all of them are."""
        told = fact[0] == "rel" and all(self._chunks[head].named.kind == "pieces" for head in fact[2])
        items = self._said.ref_all(fact[2]) if told else []
        return bool(items) and apart.are_some(items)

    def _told_of(self, heads: Sequence[int]) -> list[Item]:
        """All that the sentence tells of; where that is one thing, also what the sentences before tell of."""
        world = self._world
        told = self._said.ref_all([*heads, *(head for each in self._said.clauses.values() for head in each)])
        told = list(dict.fromkeys(told)) or world.subject
        if len(told) != 1:
            return told
        below = {below for item in (*world.together, *told) for below in world.ancestors(item)}
        known = [item for item in world.together if item in told or item not in below]
        # "A cup, a jar and a can: the first is red, the second green": told of one, they keep their order.
        return known if told[0] in known else [*known, *told]

    def _account(self, facts: Sequence[tuple]) -> None:
        """Name every word of the sentence that had no effect."""
        heard = {fact[1] for fact in facts if isinstance(fact[1], int)}
        heard |= {head for fact in facts for part in fact[2:] if isinstance(part, tuple) for head in part}
        owned = {head for fact in facts if fact[0] in ("have", "list", "include", "rel") for head in fact[3]}
        # "with a label on each": of each.
        owned |= {head for fact in facts if fact[0] == "rel" and self._said.each & {*fact[3]} for head in fact[2]}
        for at, chunk in enumerate(self._chunks):
            if chunk.kind in ("rel", "have", "place", "form", "quality") and at not in heard:
                self._world.note(f'not understood: "{chunk.text}"')
            if chunk.kind != "noun":
                continue
            pieces = chunk.phrase if chunk.phrase is not None and chunk.phrase.kind == "pieces" else None
            counted = pieces is not None and pieces.count is not None and pieces.modifiers == NO_MODIFIERS
            # "the first and the last one red": of the first nothing is heard.
            counted = counted or (
                pieces is not None
                and bool(position(pieces))
                and pieces.modifiers == Modifiers(adjectives=pieces.modifiers.adjectives)
            )
            if counted and at not in heard and at not in self._said.bound and at not in self._handled:
                # "Five cans: two on a tray, three on a bench": that all five are on the bench leaves out the three.
                self._world.note(f'not understood: "{chunk.text}"')
                self._said.cost += _UNHEARD
            speaks = chunk.phrase is not None and chunk.phrase.kind == "pieces" and at in heard
            if speaks and not self._said.ref(at) and at not in self._said.bound and at not in self._handled:
                self._world.note(f'not understood: "{chunk.text}"')
            if at in heard or self._clause.manner is not None:
                self._note_part(at)
            if chunk.phrase is not None and chunk.phrase.kind == "part" and at not in owned:
                # "A dial on a table" is no part of anything.
                bare = chunk.phrase.determined and not chunk.phrase.definite
                if bare and not chunk.phrase.possessive and self._clause.manner is None:
                    raise self._maker.unknown(chunk.phrase)
            for word in words_left(chunk) if at not in self._on_tiers else ():
                self._world.note(f'not modelled: "{word}" of "{chunk.text}"')
            if (word := miscounted(chunk, self._said.ref(at))) is not None:
                self._world.note(f'not understood: "{word}" of "{chunk.text}"')

    def _qualified(self, heads: Sequence[int], told: Modifiers) -> None:
        items = [item for head in heads for item in self._said.ref(head)]
        if not items and all(self._said.is_open(head) for head in heads):
            # "A mug is on a table. It is red."
            items = self._said.refs_of(heads)
        if not items and told != NO_MODIFIERS:
            said = " ".join(self._chunks[head].text for head in heads)
            self._world.note(f'not understood: how "{said}" is described')
        for group in dict.fromkeys(item.group for item in items):
            self._maker.note_adjectives(self._world, group.phrase, told)
            shared = len(told.colours) > 2 or 1 < len(told.colours) == len(group.items)
            if shared and len(group.items) > 1 and all(item in items for item in group.items):
                tell_colours(self._world, group, told)
            elif all(item in items for item in group.items):
                describe(group, compared(self._world, group, told))
            else:
                for item in items:
                    tell(item, told)

    def _related(self, at: int, child_heads: Sequence[int], parent_heads: Sequence[int]) -> None:
        link = self._chunks[at].relation
        if len(parent_heads) > 1 and link.kind == "next_to" and self._chunks[parent_heads[0]].named.kind == "part":
            # "Stack the cups, the red one at the bottom, the blue one on top": by no cup.
            self._world.note(f'not understood: "{self._chunks[at].text} {self._chunks[parent_heads[0]].text}"')
            return
        owned = [self._chunks[head].named for head in child_heads]
        if all(one.kind == "part" and one.possessive for one in owned) and link.kind in LATERAL_KINDS:
            # "A bottle, its cap beside it": the cap is none of its own.
            said = " ".join(self._chunks[head].text for head in (*child_heads, at, *parent_heads))
            self._world.note(f'not modelled: "{said}"')
            return
        later = any(self._said.is_open(head) for head in child_heads)
        parents = [] if later else self._said.refs_of(parent_heads, link, child_heads)
        children = self._said.refs_of(child_heads, link, parent_heads, child=True)
        parents = parents or self._said.refs_of(parent_heads, link, child_heads)
        floor = {self._chunks[head].named.head for head in parent_heads} <= {"floor", "ground"}
        if floor and link.kind == "on" and self._clause.manner is None:
            self._world.floored |= {*children}
        if floor and link.kind == "on" and children and len(children) < len(children[0].group.items):
            self._world.grounded |= {*children}
        if self._chunks[at].words in ACROSS:
            self._world.note(f'"{self._chunks[at].text}" is read as "next to".')
        moved = self._clause.verb in _ROLLING and (link.kind in LATERAL_KINDS or link.manner in ("under", "between"))
        aimed = self._clause.verb == "point" and self._chunks[at].words == ("at",)
        later = link.manner == "goal" or aimed or (moved and at == 1) or self._world.was_taken(children)
        if self._clause.manner == "other" and link.manner == "edge" and self._chunks[at].words[:1] == ("along",):
            # "Align the cans along the edge of the shelf": before that they stand anywhere on it.
            link = Link(kind="on")
        if self._clause.manner in ("other", "unload") and later:
            # "Pour the milk into the glass", "point the camera at the vase": before that it is not so.
            self._said.not_understood((*child_heads, *parent_heads))
            return
        if self._chunks[at].words == ("to",) and self._clause.manner is None:
            # "connected to", "closer to": nothing rests there.
            said = " ".join(f'"{self._chunks[head].text}"' for head in parent_heads)
            self._world.note(f'not understood: "to" {said}')
            return
        if link.manner == "far" and self._clause.manner is not None and self._chunks[at].words[:1] != ("far",):
            # "Take the cup away from the table": before that it is there, not so "the cup far away from the table".
            link = Link(manner="source")
        standing = children and parents and all(self._world.on_floor(item) for item in (children[0], parents[0]))
        if link.manner == "source" and self._clause.manner is not None and standing:
            # "Pull the chair away from the table"
            link = Link(kind="next_to")
        if self._clause.manner is None:
            link = self._resting(at, link, children, parents)
        if link.kind in LATERAL_KINDS and parents:
            self._note_mate(child_heads, parent_heads, parents[0])
        places = [self._chunks[head].phrase for head in parent_heads]
        for head in parent_heads:
            self._note_part(head)
        if not children or not parents:
            if not (parents and not children and self._of_everything(child_heads, link, parents)):
                nothing = [head for head in child_heads if self._chunks[head].text == "both"]
                if parents and nothing and self._clause.manner is None:
                    # "both on a rug": the note names the rug.
                    said = " ".join(f'"{self._chunks[head].text}"' for head in parent_heads)
                    self._said.not_understood(nothing, f" {self._chunks[at].text} {said}")
                    self._handled |= set(nothing)
                self._said.not_understood([head for head in (*child_heads, *parent_heads) if head not in self._handled])
            return
        if link.manner == "than":
            # "A ball that is bigger than both boxes" is one ball.
            self._relating.relate(children, link, parents)
            return
        phrase = places[0]
        fresh = all(child.group.counted and child.group not in self._said.before for child in children)
        whole = link.kind in SUPPORT_KINDS or link.kind == "around" or (fresh and not link.inverse)
        if whole and not link.finite and list(child_heads) == [at - 1]:
            children = self._whole(child_heads[0], children)
        named = any(self._chunks[head].named.kind == "object" for head in child_heads)
        if link.kind in SUPPORT_KINDS and (named or self._said.speaks_of_each(child_heads, carrying=True)):
            refuse_own(children, parents)
        group = children[0].group
        loose = group.phrase.plural and not group.counted and len(children) > 1 and len(parents) > 1
        if loose and link.kind in SUPPORT_KINDS and all(child.group is group for child in children):
            # "Two pots with plants in them": as many for each; of what closes a pot one.
            most = len(parents) if self._world.is_a(children[0], vessels.ON_RIMS) else len(children)
            recount(self._world, group, -(-most // len(parents)) * len(parents))
            children = list(group.items)
        if link.kind == "on" and not link.finite and self._world.is_a(parents[0], lexicon.BENEATH_CUPS):
            # "A teapot and two cups on saucers": the cups are.
            children = [item for item in children if self._world.is_a(item, vessels.NARROW)] or children
        children = self._on_no_wall(children) if link.kind == "on" and self._world.is_table(parents[0]) else children
        parents = as_many(self._world, link, parents, children)
        having = self._is_had(at, parent_heads)
        # One thing is beside several at once: "a ball to the left of both boxes".
        beside = link.kind in LATERAL_KINDS and link.manner in ("place", "half")
        carrying = having or link.kind in SUPPORT_KINDS or link.manner == "under"
        of_all = self._said.speaks_of_each(parent_heads, carrying=carrying)
        spoken = [self._chunks[head].named for head in parent_heads]
        of_all = of_all or (link.kind in SUPPORT_KINDS and ranked(spoken))
        if of_all and on_top_of_both(self._world, self._chunks[at].words, spoken, children, parents):
            link = replace(link, says="across")
        had = share(self._world, link, parents, children, all_of=of_all, having=having)
        if had == "each" and (having or link.kind in SUPPORT_KINDS):
            self._relating.relate(for_each(self._world, parents, children), link, parents)
            return
        several = self._said.speaks_of_each(child_heads) or (of_all and had != "together")
        one_each = phrase is not None and (phrase.possessive or not phrase.definite) and phrase.kind != "pronoun"
        counted = [named for named in owned if named.each and named.count is not None and len(children) > 1]
        told = bool(counted) and not link.finite and list(child_heads) == [at - 1]
        # "Each of two bowls in a crate holds a plum": one crate, by which the bowls are told.
        uses = sum(child_heads[0] in {*one, *other} for one, other in self._said.related)
        uses += any(chunk.kind == "quality" for chunk in self._chunks[at:])
        shared = told and link.kind in SUPPORT_KINDS and uses > 1
        # "Three mugs, each with a spoon, on a tray": on one tray.
        shared = shared or any(chunk.kind == "have" for chunk in self._chunks[max(child_heads) : at])
        one_each = one_each and not shared and self._said.speaks_of_each(child_heads)
        if one_each and len(parents) < len(children):
            parents = multiply(self._world, parents, len(children) // len(parents))
        elif (had != "together" and self._said.for_each(parent_heads, children, parents)) or (
            several and len(children) < len(parents) and not set(children) & set(parents)
        ):
            whole_group = group.counted and len(group.items) == len(parents) and len(children) == 1
            # "Three bowls, one on each of three trays": the three.
            children = list(group.items) if whole_group else multiply(self._world, children, len(parents))
        if link.kind == "on" and phrase is not None and self._lies_on(phrase, children, parents):
            return
        if link.kind in LATERAL_KINDS or link.manner == "between":
            for place in places:
                if place is not None and place.part in lexicon.ENDS:
                    self._world.note(f'not modelled: "{place.part}" of "{place.words}"')
        below = self._world.is_table(parents[0]) and not self._world.on_floor(children[0])
        if link.says == "across" and self._chunks[at - 1].text == "facing" and len(children) == 2 and not below:
            # "Two cups facing each other across a plate": it is between them.
            self._relating.relate(parents[:1], Link(manner="between", kind="right_of"), children)
            return
        rest = phrase is not None and phrase.definite and (phrase.other or phrase.head in ("rest", "others"))
        both = beside and not of_all and self._said.speaks_of_each(parent_heads, carrying=True)
        one_by_one = (rest or both) and link.kind in LATERAL_KINDS and link.kind != "around" and len(children) == 1
        if link.manner in ("edge", "half") and parents and self._alone_there(child_heads):
            # "A bowl of plums, and a vase in the corner of the desk": the vase is in the corner.
            children, others = self._said.refs_of(child_heads[-1:]), children
            if self._world.is_table(parents[0]):
                free = [item for item in others if item not in children and not self._world.on_floor(item)]
                if free:
                    self._relating.relate(free, Link(kind="on"), parents)
        # "the red cup is behind the other two": behind each of them
        carried = link.kind in SUPPORT_KINDS and len(parent_heads) == 1
        if carried and not link.inverse and self._on_tier(children, parent_heads[0], parents):
            return
        for landmarks in [[parent] for parent in parents] if one_by_one else [parents]:
            self._relating.relate(children, link, landmarks, each=several)
        self._landmarks[at] = self._relating.landmark

    def _alone_there(self, heads: Sequence[int]) -> bool:
        """Whether only the last of `heads` is at an edge or a side: where more is said of those before it, or a comma.

        "A jug and a vase in the corner" are both there.
        """
        between = self._chunks[heads[0] + 1 : heads[-1]]
        told = any(chunk.kind not in ("noun", "joint") for chunk in between)
        first = next(iter(self._chunks[heads[0]].text.lower().split()), "")
        set_off = len(heads) == 2 and any(chunk.text == ", and" for chunk in between)
        return len(heads) > 1 and first != "both" and (told or set_off)

    def _note_mate(self, child_heads: Sequence[int], parent_heads: Sequence[int], carrier: Item) -> None:
        """Say that "beside it" of "a tray with a cup and a spoon beside it" may be beside the cup."""
        owners = {*self._said.bound.get(parent_heads[0], ())}
        had = [head for one, other in self._said.related if one == owners for head in sorted(other)]
        mates = [self._chunks[head] for head in had if max(owners) < head < min(child_heads)]
        mates = [mate for mate in mates if mate.phrase is not None and mate.phrase.kind == "object"
                 and not (mate.phrase.several or self._world.likely.floor(mate.phrase.noun))]  # fmt: skip
        dish = self._world.is_a(carrier, lexicon.DISHES) and not self._world.on_floor(carrier)
        nouns = [self._chunks[head].named.noun for head in child_heads]
        if mates and dish and all(self._world.likely.on(noun, self._world.noun(carrier)) < USUAL for noun in nouns):
            it, read = self._chunks[parent_heads[0]].named, carrier.group.words
            self._world.note(f'"{it.words}" (word {it.number}) is read as "{read}"; it may be "{mates[-1].text}".')

    def _whole(self, head: int, children: list[Item]) -> list[Item]:
        """All of which "one of the two spoons out of the jar" means one: the two are in the jar."""
        phrase = self._chunks[head].named
        told = phrase.some or bool(phrase.superlative != NO_MODIFIERS)
        return list(children[0].group.items) if told and len(children) == (phrase.some or 1) else children
