"""What "with", "holding" and "of" say: of the owner, unless the objects' own places are told with them."""

from __future__ import annotations

from pat3d.plan.grammar.chunking.plausible import USUAL
from pat3d.plan.grammar.parsing.chart import Node
from pat3d.plan.grammar.parsing.judging import HEADLESS, Judging
from pat3d.plan.grammar.words.lexicon import DISHES, FIGURES, LEVEL, WORN
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.vessels import ON_RIMS, SLENDER
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_OF_BACKGROUND = 0.6
"""Cost of a place that is one of the wall's or the window's."""
_SAME_OWNER = 0.45
"""Gain where what stands "to its left" and "to its right" has one owner."""
_LANDMARKS = 0.7
"""Cost of what a clause says with a verb being said of the landmark before it and not of what it begins with."""
_BY_A_NAIL = 1.4
"""Cost of what is in or on something being had by the nail or hook before it, on which something hangs."""
_OF_LAST = 0.35
"""Gain where the last of what is had alone is beside what stands behind it."""
_ENDED = 0.35
"""Cost of having more behind what is said to be in or on the owner."""


class Having(Judging):
    """The rule for what an object has."""

    def _having(self, at: int, link: Link, named: Node, modifier: Node) -> tuple[list[tuple], float]:
        """Facts of `named` with what `modifier` names: in or on it, or where it says ("a pen inside")."""
        owners = named.heads
        facts: list[tuple] = [("heard", at)]
        placed: set[int] = set()
        inside: set[int] = set()
        # "A bun on a tray has a seed on it": the bun has.
        landmark = self._chunks[owners[0] - 1].kind == "rel" if owners[0] > 1 else False
        cost = _LANDMARKS * (landmark and link.finite and at == owners[-1] + 1)
        hung = landmark and self._link(owners[0] - 1).kind in SUPPORT_KINDS
        # "A clipboard hanging from a nail with a pen on it": the clipboard has.
        cost += _BY_A_NAIL * (
            hung and self._likely.is_a(self._noun(owners[0]), ("nail", "hook")) and self._set_down(at)
        )
        for fact in modifier.facts:
            ours = fact[0] == "place" and set(fact[2]) <= set(modifier.heads) and not fact[3]
            if ours and link.manner == "flank":
                facts.append(("side", fact[1], fact[2]))
                cost -= 0.5
                continue
            if ours and not placed & set(fact[2]):
                facts.append(("place", fact[1], fact[2], owners))
                placed |= set(fact[2])
                said = self._chunks[fact[1]].link
                inside |= set(fact[2]) if said is not None and said.kind in SUPPORT_KINDS else set()
                cost += 0.8 * self._owned_again(fact[1], at)
                # "A table stands by the window with a vase in the middle"
                cost += _OF_BACKGROUND * (owners[0] > 0 and self._only_background(owners))
                if self._chunks[fact[1]].text == "centre" and self._likely.level(self._noun(owners[0])):
                    # "A table with four chairs and a vase in the middle": no chair is.
                    cost += 0.9 * any(self._likely.on(self._noun(h), self._noun(owners[0])) > 1.0 for h in fact[2])
                if said is not None:
                    near = said.kind not in SUPPORT_KINDS and self._likely.level(self._noun(owners[0]))
                    # "one with a ball inside": the one is one of what can hold a ball.
                    one = all(self._phrase(owner).kind in HEADLESS for owner in owners)
                    cost += 0.1 if near or one else self._arcs(said, fact[2], owners)
                continue
            apart = fact[0] == "rel" and set(fact[2]) <= set(modifier.heads) and self._link(fact[1]).manner == "place"
            known = apart and (self._likely.floor(self._noun(fact[3][0])) or self._named_again(fact[3][0], named))
            if known and self._link(fact[1]).kind not in SUPPORT_KINDS:
                # "A pot on a stove with flour beside the stove"
                placed |= set(fact[2])
                cost += 0.2
            aside = apart and self._link(fact[1]).kind in LATERAL_KINDS
            halved = fact[0] == "rel" and set(fact[2]) <= set(modifier.heads) and self._link(fact[1]).side is not None
            if aside and all(self._again_named(head, tuple(placed)) for head in fact[3]):
                # "A monitor with a keyboard in front of it and a mouse beside the keyboard"
                placed |= set(fact[2])
            if (
                fact[0] == "rel"
                and set(fact[2]) <= set(modifier.heads)
                and (
                    self._one_of(fact[3], owners) or self._each_of(fact[3], owners) or self._each_else(fact[3], owners)
                )
            ):
                # "A row of cans, with an orange behind the last one"
                cost += self._likely.relation(self._link(fact[1]), self._noun(fact[2][0]), self._noun(owners[0]))
                placed |= set(fact[2])
            mate = self._mate(fact[2], modifier, owners) if aside and self._is_pronoun(fact[3]) else ()
            if mate:
                facts.append(("bind", fact[3][0], mate))
                cost += self._arcs(self._link(fact[1]), fact[2], mate)
            elif fact[0] == "rel" and set(fact[2]) <= set(modifier.heads) and self._means(fact[3], owners):
                facts.append(("bind", fact[3][0], owners))
                # "Two chairs across a table with a lamp on it": on the table.
                one = self._phrase(fact[3][0]).head == "it" and self._phrase(owners[0]).kind == "object"
                one = one and (self._phrase(owners[0]).count or 1) > 1 and self._chunks[max(owners) + 1].kind == "form"
                cost += self._arcs(self._link(fact[1]), fact[2], owners) + 0.8 * one
                placed |= set(fact[2])
                inside |= set(fact[2]) if self._link(fact[1]).kind in SUPPORT_KINDS else set()
                if len(fact[2]) > 1 and self._link(fact[1]).kind in LATERAL_KINDS:
                    # "A plate with a bun and a cup beside it": the bun is on the plate.
                    cost += 0.7 * self._usually_had(link, self._owner_noun(owners[0]), self._noun(fact[2][0]))
            elif (aside or halved) and self._is_pronoun(fact[3]):
                # "A cup on a box, with a ball next to them (on the left of them)"
                placed |= set(fact[2])
                cost += 0.2
            facts.append(fact)
        sides = {
            self._chunks[fact[1]].text: fact[2] for fact in facts
            if fact[0] == "place" and fact[2] == (fact[1] - 1,) and {"its", "their"} & {*self._chunks[fact[1]].words}
        }  # fmt: skip
        stands = landmark and self._chunks[owners[0] - 2].kind == "verb"
        if sides and stands and self._link(owners[0] - 1).kind in LATERAL_KINDS:
            # "A fork lies beside the plate with a spoon to its right": of the fork.
            cost += _LANDMARKS
        # "each with a fork to its left and a knife to its right": of the same plate.
        cost -= _SAME_OWNER * ({"left", "right"} <= sides.keys() and link.manner != "of")
        nearer = self._noun(at - 1) if at - 1 not in owners and self._chunks[at - 1].phrase is not None else ""
        dressed = self._likely.is_a(nearer, FIGURES) and self._likely.is_a(self._noun(modifier.heads[0]), WORN)
        topping = link.kind == "on" and not link.finite
        tops = [self._likely.tops(self._noun(head), nearer or self._noun(owners[0])) for head in modifier.heads]
        # "A shelf has a doll with a hat on top": on the doll. "A table with a pie topped with cherries": on the pie.
        cost += 0.8 * (dressed or (topping and bool(nearer) and tops[0]))
        # "A plate with a pie topped with cherries and a fork": no fork is on the pie.
        cost += 0.6 * (topping and not nearer and any(tops) and not all(tops))
        wears = self._chunks[at].words[0] == "wearing"
        # "A bear sits between two pillows, wearing a hat": the bear does.
        cost += 0.8 * (wears and not self._likely.is_a(self._noun(owners[0]), FIGURES))
        ends = modifier.joints == ";" or (modifier.joints.endswith(";") and placed == {*modifier.heads[:-1]})
        if ends and self._phrase(owners[0]).head == "each":
            # "two plates, each with a fork to its left, and two glasses": the glasses are on the table.
            cost += 0.8
        # "A basket with a towel and a bowl which holds two lemons": what a relative clause tells ends no list.
        told = [fact for fact in modifier.facts if fact[0] == "have" and self._chunks[fact[1] - 1].kind != "which"]
        having = {owner for fact in told for owner in fact[2]} | self._filled(modifier.facts)
        own = having & set(modifier.heads)
        if own and own == set(modifier.heads[1:]) and not self._likely.floor(self._noun(owners[0])):
            # "A basket with two apples, a bowl with an egg and a jar with a pen": each has its own.
            cost += 0.8 if self._likely.level(self._noun(owners[0])) else 1.6
        # What stands around something is around it whatever it is on.
        apart = link.manner in ("surround", "flank")
        carriers = {head: head if apart else self._carrier(head, modifier.facts) for head in modifier.heads}
        # What stands on something known already is told of by that alone.
        placed |= {head for head in modifier.heads if carriers[head] != head and self._phrase(carriers[head]).definite}
        if link.manner == "hold" and self._likely.hollow(self._noun(owners[0])):
            # "A jar that holds a nut and a clip on the desk": what it holds is in the jar.
            cost += 0.8 * any(carriers[head] != head for head in modifier.heads)
        left = tuple(dict.fromkeys(carriers[head] for head in modifier.heads if head not in placed))
        # "A bowl of nuts on a plate": the plate is none of what the bowl is full of.
        filled = link.manner == "of" and self._phrase(owners[0]).kind == "object"
        cost += (2.0 if filled else 0.15) * any(carriers[head] != head for head in modifier.heads)
        if inside and any(head > min(inside) for head in left):
            # "A crate with a nut in it and a jar": what is "in it" ends what the crate has.
            cost += _ENDED
        if len(modifier.heads) > 2 and not set(carriers.values()) & set(modifier.heads):
            # "A bench holds a vise, a drill and six screws in a dish": the bench carries the vise.
            cost += 0.35 if link.manner == "hold" else 0.2
        owner = self._noun(owners[0])
        if link.manner == "hold" and owner and not (self._likely.hollow(owner) or self._likely.level(owner)):
            # "A statue holding a book on a bench": it holds no bench.
            cost += 0.8 * any(carriers[head] != head for head in modifier.heads)
        lateral = [
            fact for fact in modifier.facts if fact[0] == "rel" and self._link(fact[1]).kind not in SUPPORT_KINDS
        ]
        level = self._likely.level(owner)
        aside = [fact for fact in lateral if not level or self._is_pronoun(fact[3])]
        if link.manner == "hold" and any(set(fact[2]) >= set(modifier.heads) for fact in aside):
            # What is held stands not beside: "a mug holds a pen, and a bowl beside it" has the bowl beside.
            cost += 0.8
        ended = [fact for fact in lateral if fact[2] == modifier.heads[-1:] and not self._is_pronoun(fact[3])]
        if level and len(modifier.heads) > 1 and ended:
            # "A desk with a lamp, a phone and a pen next to a notebook": the pen is.
            cost -= _OF_LAST
        first, last = min(left, default=0), max(left, default=0)
        amid = [fact for fact in lateral if fact[2] and fact[3]]
        amid = [fact for fact in amid if first <= fact[2][0] < fact[3][-1] < last and not self._definite(fact[3])]
        if self._likely.hollow(owner) and any(self._link(fact[1]).manner == "place" for fact in amid):
            # "A basket of lemons next to a jug and a glass": the glass is not in it.
            cost += 0.8
        if left:
            facts.append(("have", at, owners, left))
            parts = [head for head in left if self._phrase(head).kind in HEADLESS]
            things = [head for head in left if head not in parts]
            if things and link.manner not in ("include", "of"):
                cost += sum(
                    self._likely.having(link, self._noun(owner), self._noun(head))
                    for head in things
                    for owner in owners
                ) / (len(things) * len(owners)) + 0.25 * sum(
                    self._likely.having(link, self._noun(owners[0]), self._noun(head)) > 1.0 for head in things
                )
        cost += 0.5 * self._list_goes_on(link, owner, modifier)
        if any(self._phrase(head).definite and self._likely.is_a(self._noun(head), ON_RIMS) for head in left):
            # "Close the jar with the lid": it is not there yet.
            cost += 0.7
        if link.manner == "of" and placed and self._phrase(owners[0]).kind not in HEADLESS:
            # "a bowl of apples in the middle", "a cup of pens next to it": what is said last is said of the bowl.
            cost += 2.0
        sided = [fact for fact in modifier.facts if fact[0] == "rel" and self._link(fact[1]).manner in ("half", "edge")]
        if link.manner == "of" and any(set(fact[2]) <= set(modifier.heads) for fact in sided):
            # "a vase of roses in the middle": the vase is.
            cost += 1.0
        if link.manner == "of" and left:
            cost += 0.6 * any(self._phrase(head).determined for head in modifier.heads[1:])
            cost += (
                0.0 if self._likely.hollow(self._noun(owners[0])) or self._likely.level(self._noun(owners[0])) else 0.5
            )
        return facts, cost

    def _list_goes_on(self, link: Link, owner: str, had: Node) -> bool:
        """Whether a list goes on behind the first that `owner` is said to have: "a vase with roses, a lamp, a cup"."""
        vessel = self._likely.hollow(owner) and not self._likely.level(owner)
        if link.manner != "with" or had.joints[:1] != "," or not vessel:
            return False
        first, *others = had.heads
        costs = [self._likely.having(link, owner, self._noun(head)) for head in others]
        bare = self._phrase(first).plural and not any(self._phrase(head).plural for head in others)
        return (max(costs) >= USUAL) + bare + (not had.joints.strip(",")) > 1

    def _set_down(self, at: int) -> bool:
        """Whether what chunk `at` has stands in or on something: "with a pen on it"."""
        place = self._chunks[at + 2] if at + 2 < len(self._chunks) else None
        return place is not None and place.kind == "rel" and place.relation.kind in SUPPORT_KINDS

    def _mate(self, children: tuple[int, ...], had: Node, owners: tuple[int, ...]) -> tuple[int, ...]:
        """What one thing `children` stand beside that are "beside it" on the level `owners`; () where that is those.

        "A desk with a lamp, a mug beside it": the lamp; "a tray with a pot in the middle and a cup behind it": the pot.
        "A tray with a pot and a cup beside it" may be told of the tray.
        """
        own = [fact for fact in had.facts if {*fact[2:3]} and {*fact[2]} <= {*had.heads} and fact[1] < min(children)]
        aside = {head for fact in own if fact[0] == "rel" and self._is_pronoun(fact[3]) for head in fact[2]}
        before = [head for head in had.heads if head < min(children) and head not in aside]
        owner = self._noun(owners[0])
        if not before or len(owners) > 1 or self._several(before[-1]):
            return ()
        told = any(fact[0] == "place" and fact[2] == (before[-1],) for fact in own)
        bears = self._likely.is_a(owner, LEVEL, DISHES)
        natural = all(self._likely.on(self._noun(child), owner) < USUAL for child in children)
        goes_on = max(had.heads) > max(children)
        return (before[-1],) if bears and natural and (told or goes_on or self._likely.floor(owner)) else ()

    def _filled(self, facts: tuple[tuple, ...]) -> set[int]:
        """What `facts` have something in or on: "a crate with an apple in it"."""
        meant = {fact[1]: fact[2] for fact in facts if fact[0] == "bind"}
        inner = [fact for fact in facts if fact[0] == "rel" and self._link(fact[1]).kind in SUPPORT_KINDS]
        return {owner for fact in inner for head in fact[3] for owner in meant.get(head, ())}

    def _owner_noun(self, owner: int) -> str:
        """The noun of `owner`, of "each" that of what is named before it."""
        nouns = (self._noun(at) for at in range(owner, -1, -1) if self._chunks[at].phrase is not None)
        return next(filter(None, nouns), "")

    def _has_again(self, named: Node, modifier: Node) -> bool:
        """Whether `named` has things "with" it, and behind them more "with" it that is placed nowhere."""
        at = modifier.mod[1]  # type: ignore[index]
        manner = self._link(at).manner
        had = any(fact[0] == "have" and self._link(fact[1]).manner == manner for fact in named.facts)
        placed = any(fact[0] in ("rel", "place") for fact in modifier.facts)
        said = modifier.cat == "CM" or modifier.flags & {"finite", "which"}
        return had and not placed and not said and manner in ("with", "hold")

    def _passes_over(self, named: Node, modifier: Node) -> bool:
        """Whether `modifier` is said of `named` and stands directly behind a thing that `named` has: "and a jar with".

        "a basket with a nut in it and a plate with a cup on it": the plate has the cup; "a ball next to a box and a
        plate with a fork": the plate has it.
        """
        before = modifier.start - 1
        had = any(fact[0] == "have" and fact[2] == named.heads and before in fact[3] for fact in named.facts)
        placed = any(fact[0] == "rel" and self._link(fact[1]).kind in SUPPORT_KINDS for fact in modifier.facts)
        both = any(fact[0] == "rel" and len(fact[3]) > 1 and before == fact[3][-1] for fact in named.facts)
        return ((had and placed) or both) and modifier.cat == "M" and not modifier.flags & {"finite", "which"}

    def _usually_had(self, link: Link, owner: str, child: str) -> bool:
        """Whether one thinks of `child` as on or in `owner` rather than beside it: cake on a plate, but no fork."""
        likely = self._likely
        cutlery = likely.is_a(child, SLENDER) and likely.is_a(owner, DISHES)
        return likely.having(link, owner, child) < USUAL and not cutlery
