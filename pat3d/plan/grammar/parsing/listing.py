"""Rules for lists: "a mug, a plate and a fork", "two mugs, one on a plate", "tools: a hammer and a saw"."""

from __future__ import annotations

from pat3d.plan.grammar.parsing.chart import Node
from pat3d.plan.grammar.parsing.goals import NO_DETERMINER, Goals
from pat3d.plan.grammar.parsing.judging import HEADLESS
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.links import Link
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_HAD_TOGETHER = 0.3
"""Cost of parting what is "on it" from what stands before it behind the same "with"."""
_DANGLES = 0.4
"""Cost of what stands at the end of a clause, behind a landmark, and is not beside anything."""


_FILLS_TOO = 0.6
"""Cost of parting what fills a vessel from what may fill it too."""


def _list_cost(joints: str) -> float:
    """How unusual it is to list with these joints: "," and "&" for "and", ";" for ", and"."""
    closers = len(joints) - joints.count(",")
    if not closers:
        return 0.3 if joints else 0.0
    early = sum(joint != "," for joint in joints[:-1])
    cost = early * (0.35 if "," in joints else 0.05) + (0.3 if joints.endswith(",") else 0.0)
    return cost + (0.15 if joints == ";" else 0.0)


class Listing(Goals):
    """Rules for what stands behind a comma, a colon or "and"."""

    def _rest(self, joint: Node, named: Node) -> Node:
        text = self._chunks[joint.start].text
        mark = ":" if ":" in text else ";" if text == ", and" else "&" if text == "and" else ","
        return Node("CL", joint.start, named.cost, named.heads, named.facts, mark + named.joints, named.flags)

    def _lowest_of(self, head: int, facts: tuple[tuple, ...]) -> int:
        """What of "desk: a laptop, a pencil in a cup" stands on the desk: the cup, of the pencil."""
        while (carrier := self._carrier(head, facts)) != head:
            if self._phrase(carrier).definite or self._likely.floor(self._noun(carrier)):
                break
            head = carrier
        return head

    def _named_in_full(self, head: int) -> bool:
        """Whether "one of the balls" at chunk `head` stands behind the balls themselves."""
        noun = self._noun(head) if self._phrase(head).some else ""
        before = (at for at in range(head) if (phrase := self._chunks[at].phrase) is not None and not phrase.some)
        return bool(noun) and any(self._noun(at) == noun for at in before)

    def _list(self, first: Node, rest: Node) -> Node | None:
        """Read "a mug" + ", a plate and a fork"."""
        mark, later = rest.joints[0], rest.joints[1:]
        facts = (*first.facts, *rest.facts)
        cost = first.cost + rest.cost
        if mark == ":":
            if any(self._phrase(head).kind == "items" for head in first.heads):
                facts = (*facts, *(("bind", head, rest.heads) for head in first.heads))
                return Node("L", first.start, cost, rest.heads, facts, "", first.flags | rest.flags)
            if all(self._phrase(head).kind in HEADLESS for head in rest.heads):
                mute = any(self._says_nothing(head, rest.facts) for head in rest.heads)
                flags = first.flags | {"colon"} | ({"mute"} if mute else set())
                return Node("L", first.start, cost, first.heads, facts, "", flags)
            if (kind := self._kind_named(first.start, rest.start)) is not None:
                # "Tools on a bench: a hammer and a saw": the two are the tools.
                heads = tuple(each for head in first.heads for each in (rest.heads if head == kind else (head,)))
                return Node("L", first.start, cost - 0.3, heads, (*facts, ("bind", kind, rest.heads)), "", first.flags)
            listed = tuple(dict.fromkeys(self._lowest_of(head, rest.facts) for head in rest.heads))
            said = ("list", rest.start, first.heads, listed)
            extra = sum(
                self._likely.having(Link(manner="with"), self._noun(first.heads[0]), self._noun(head))
                for head in listed
            ) / len(listed)
            return Node("L", first.start, cost + extra, first.heads, (*facts, said), "", first.flags | {"colon"})
        if first.joints and "modified" not in first.flags:
            return None
        cost += _list_cost(rest.joints) - _list_cost(later) + 0.3 * ("included" in first.flags)
        coloured = any(self._phrase(head).modifiers.colours for head in first.heads)
        headless = [
            self._phrase(head).kind in HEADLESS and not (coloured and self._one_more(head)) for head in rest.heads
        ]
        if "finite" not in rest.flags and any(map(self._named_in_full, rest.heads)):
            # "A box holds three balls and one of the balls is red": no fourth.
            cost += 1.2
        # "Put the red cup and the one on the chair in the sink": both.
        both = all(map(self._the_one, rest.heads)) and "finite" not in first.flags | rest.flags
        both = both and mark == "&" and "placed" in rest.flags and not any(map(self._several, first.heads))
        if all(headless) and not both and not all(self._phrase(head).kind in HEADLESS for head in first.heads):
            # "two mugs, one on a plate": said of the mugs, nothing more is named.
            mute = sum(self._says_nothing(head, rest.facts) for head in rest.heads)
            flags = first.flags | (rest.flags & {"finite"}) | {"told"} | ({"mute"} if mute else set())
            cost += 0.8 * mute * (1 + all(map(self._the_one, rest.heads)))
            return Node("L", first.start, cost, first.heads, facts, "", flags)
        aside = any(headless) and headless[0] and ";" in rest.joints
        alone = all(self._phrase(head).words.lower().startswith("one of ") for head in first.heads) and not any(
            headless
        )
        if (aside and not all(headless)) or (alone and mark == ";" and "finite" not in first.flags):
            # "Three cups, one of them red, and a jug is beside them": the red one is not beside them.
            cost += 1.2
        elif any(headless) and not all(headless):
            cost += 0.4
        if self._formed_alone(rest) and all(map(self._counted, (*first.heads, *rest.heads))):
            # "Two figs and three plums in a row": all five.
            cost += 0.3
        if "formed" in rest.flags - first.flags and len(rest.heads) > 1:
            # "a red cube, a blue cube and a green cube in a row": all three.
            cost += 0.3
        if "placed" in rest.flags and "placed" not in first.flags:
            # "a mug and a plate on a table": what stands behind a list is said of all of it, or of its last.
            cost += 0.3 if len(rest.heads) == 1 else 0.6
        taken = [fact[2] for fact in rest.facts if fact[0] == "rel" and self._link(fact[1]).manner == "source"]
        if rest.heads in taken and "placed" not in first.flags:
            # "Put a bun and a sausage from the bowl onto a plate": both are taken out of it.
            cost += 0.5
        if "modified" in first.flags:
            cost += 0.15 if "finite" not in first.flags else 0.3
        if "finite" in rest.flags and "finite" not in first.flags:
            cost += 0.4
        # "The red cups are on a tray and the blue ones on a plate": the place is theirs.
        again = "placed" in rest.flags and {*map(self._noun, rest.heads[:1])} <= {*map(self._noun, first.heads)}
        if rest.joints == "&" and "finite" in first.flags - rest.flags and self._definite(rest.heads) and not again:
            # "A ball is near the lamp and the clock": near both.
            cost += 1.2
        elif rest.joints == "&" and not {"finite", "placed"} & rest.flags:
            # "A book (is on a sofa) next to a pillow and a blanket": next to both.
            told = "finite" in first.flags or not self._moving
            cost += _DANGLES * (told and self._ends_beside(first.start, rest.start))
        if mark in "&," and self._ends_what_is_had(first, rest):
            # "A board lies on a bench with a knife and a lemon on it (and a cup beside it)": both are on the board.
            cost += _HAD_TOGETHER
        # "A board with a bowl of plums and figs on it": the figs are in the bowl as well.
        cost += _FILLS_TOO * self._fills_too(first, rest)
        if rest.joints[-1] in "&;" and self._shares_determiner(first, rest):
            # "A drill lies next to its battery and charger", "next to the saw, drill and charger": next to them all.
            cost += NO_DETERMINER
        flags = (first.flags | (rest.flags - {"placed"})) - {"comma", "modified"}
        return Node("L", first.start, cost, (*first.heads, *rest.heads), facts, rest.joints, flags)

    def _fills_too(self, first: Node, rest: Node) -> bool:
        """Whether `rest` begins with what may fill the vessel that `first` ends in, named as what does: "of plums"."""
        full = [fact for fact in first.facts if fact[0] == "have" and fact[3] == (rest.start - 1,)]
        if not full or rest.joints[0] != "&" or self._link(full[0][1]).manner != "of":
            return False
        owner, (filling, more) = self._noun(full[0][2][0]), map(self._phrase, (rest.start - 1, rest.heads[0]))
        bare = not any(one.determined or one.count or one.kind != "object" for one in (filling, more))
        return bare and self._likely.hollow(owner) and self._may_hold(owner, [self._likely.fits(more)])

    def _goes_on(self, first: Node, second: Node) -> float:
        """The cost of `second`, a list, being told apart from `first`: of what that lists it may be more."""
        cost = 0.3 + NO_DETERMINER * (second.joints == "&" and self._shares_determiner(first, second))
        # "On the desk: a pen behind a mug, a tray with a cup on it"
        cost += 0.5 * any(self._chunks[at].text == ":" for at in range(first.start, second.start))
        # "On the desk there are two red pens and a blue one, a cup and a jar"
        fronted = any(fact[0] == "front" for fact in first.facts)
        # "There is a ball next to the box and the cube"
        cost += _DANGLES * (second.joints == "&" and not {"finite", "placed"} & second.flags
                            and self._ends_beside(first.start, second.start))  # fmt: skip
        cost += _FILLS_TOO * self._fills_too(first, second)
        return cost + 0.2 * (fronted and not {"placed", "finite"} & second.flags)

    def _two_landmarks(self, objects: Node) -> bool:
        things = all(self._phrase(head).kind in ("object", "unknown") for head in objects.heads)
        return things and objects.joints == "&" and not self._moving

    def _ends_in_neighbours(self, at: int, objects: Node) -> bool:
        """Whether all the sentence lists is what something is beside: "a knife on a board next to jam, ham and a pear".

        In "a jar, a cup next to a jug, a pot and a pan" the list is of more than the jug's neighbours.
        """
        beside = self._link(at).kind in LATERAL_KINDS and self._link(at).manner == "place"
        listed = len(objects.heads) > 2 and objects.joints.strip(",") in ("&", ";") and not objects.facts
        first = not any(chunk.kind in ("joint", "clause") for chunk in self._chunks[:at])
        return beside and listed and first and max(objects.heads) == len(self._chunks) - 1 and not self._moving

    def _ends_beside(self, start: int, end: int) -> bool:
        """Whether the chunks from `start` to `end` end with a landmark: "next to a bowl (of nuts)"."""
        at = end - 2
        while at > start and self._chunks[at].kind == "have" and self._link(at).manner == "of":
            at -= 2
        return at > start and self._chunks[at].kind == "rel" and self._link(at).kind in LATERAL_KINDS

    def _formed_alone(self, rest: Node) -> bool:
        """Whether `rest` is one phrase that is said to stand in a row or a ring."""
        forms = (fact for fact in rest.facts if fact[0] == "form" and fact[2] == rest.heads)
        return len(rest.heads) == 1 and any(self._chunks[fact[1]].text in ("row", "circle") for fact in forms)

    def _counted(self, head: int) -> bool:
        """Whether chunk `head` names a number of things: "three plums"."""
        return (self._phrase(head).count or 1) > 1

    def _placed_apart(self, named: Node) -> bool:
        """Whether the first of `named` is said to stand somewhere with a verb, and the last is not."""
        carried = [fact[2] for fact in named.facts if fact[0] == "rel" and self._link(fact[1]).kind in SUPPORT_KINDS]
        there = {head for heads in carried for head in heads}
        return "finite" in named.flags and named.heads[0] in there and named.heads[-1] not in there

    def _formed_of(self, named: Node, modifier: Node) -> float:
        """The cost of "in a row" said of `named`: of one thing, of what carries the others, of more than the last."""
        if len(named.heads) == 1:
            return 0.85 * (not self._several(named.heads[0]))
        *others, last = map(self._phrase, named.heads)
        carries = any(fact[0] == "have" and fact[2] == named.heads[:1] for fact in named.facts)
        cost = 0.9 * (carries and self._likely.is_a(self._noun(named.heads[0]), lexicon.LEVEL))
        # "A monitor and three pens in a row": the pens are, or all.
        several = (last.count or 1) > 2 and "finite" not in modifier.flags
        return cost + 0.75 * (several and any(one.count in (None, 1) and not one.plural for one in others))

    def _ends_what_is_had(self, first: Node, rest: Node) -> bool:
        """Whether what `rest` begins with is placed on or in "it", behind what something in `first` is said to have."""
        had = any(fact[0] == "have" and max(fact[3]) == rest.start - 1 for fact in first.facts)
        placed = [fact for fact in rest.facts if fact[0] == "rel" and fact[2] == rest.heads[: len(fact[2])]]
        return had and any(self._link(fact[1]).kind in SUPPORT_KINDS and self._is_pronoun(fact[3]) for fact in placed)
