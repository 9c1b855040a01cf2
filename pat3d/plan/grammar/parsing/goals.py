"""Rules for what is moved, and where to: "the mug on the plate" after "put"."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.parsing.chart import Node
from pat3d.plan.grammar.parsing.having import Having
from pat3d.plan.grammar.words import lexicon
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_ASKED = 0.3
"""What it costs at most that something is put on a plate."""
_CRAMPED = 0.6
"""Cost of being put beside a vessel that stands on a plate."""
_BOXES = ("box", "cookie box", "bottle", "can", "carton", "kettle", "cracker box", "cereal box", "storage box")
NO_DETERMINER = 0.9
"""Cost of one thing without "a" that does not share that of what stands directly before it."""


class Goals(Having):
    """Rules that only instructions have."""

    _moving = _putting = False
    """Whether "on" behind what is moved says where it is to go: "put the cup on the tray"."""

    def _goals(self, first: Node, second: Node) -> Node:
        """Read "the forks in the drawer" + ", the plates on the rack".

        "The lamp next to the fork and knife on the tray" has both on the tray.
        """
        cost = first.cost + second.cost + 0.1 + NO_DETERMINER * self._shares_determiner(first, second)
        return replace(first, cost=cost, facts=(*first.facts, *second.facts))

    def _further(self, goal: Node, modifier: Node) -> Node | None:
        """Read "it on the table" + "in front of the bowl": a second word on where it is to go."""
        if modifier.mod[0] != "link" or "which" in modifier.flags:  # type: ignore[index]
            return None
        at = modifier.mod[1]  # type: ignore[index]
        if self._link(at).manner == "source":
            # "the cups in the bin from the table": where they are before.
            said = ("rel", at, goal.heads, modifier.heads)
            return replace(goal, cost=goal.cost + modifier.cost + 0.1, facts=(*goal.facts, *modifier.facts, said))
        extra, cost = ("extra", at, modifier.heads), 0.6
        aims = [self._link(fact[1]) for fact in goal.facts if fact[0] == "goal"]
        if self._tells_where(at) and len(aims) == 1 and aims[0].kind in SUPPORT_KINDS:
            # "Put the cup on the tray, next to the jug": where on the tray.
            cost = 0.1 if modifier.cat == "CM" else 0.2 if self._putting else 0.6
        return replace(goal, cost=goal.cost + modifier.cost + cost, facts=(*goal.facts, *modifier.facts, extra))

    def _tells_where(self, at: int) -> bool:
        """Whether chunk `at` says beside what something is to stand."""
        link = self._link(at)
        return link.manner == "between" or (link.manner in ("place", "half") and link.kind in LATERAL_KINDS)

    def _goal(self, named: Node, modifier: Node) -> Node | None:
        """Read "the mug" + "on the plate", where it is to go."""
        kind, at = modifier.mod  # type: ignore[misc]
        if kind == "place" and self._chunks[at].link is not None:
            facts = (*named.facts, *modifier.facts, ("goal", at, named.heads, ()))
            return Node("IM", named.start, named.cost + modifier.cost, named.heads, facts, named.joints, named.flags)
        if kind != "link" or self._link(at).manner == "source":
            return None
        link = self._link(at)
        if "which" in modifier.flags:
            # "the bottle that is behind the oven": where it is, not where it is to go.
            return None
        if link.inverse and (link.manner != "with" or link.kind is not None):
            return None
        arcs = self._arcs(link, named.heads, modifier.heads)
        # "Put the bowl on the plate" is asked for, though few bowls stand on a plate.
        dish = "modified" in named.flags and link.kind in SUPPORT_KINDS and self._is_small(modifier.heads[0])
        cost = named.cost + modifier.cost + (min(arcs, _ASKED) if dish else arcs)
        # "Put the cup on the shelf above the sink": nothing is put above the sink.
        cost += 0.6 * ("placed" in named.flags and link.says == "above")
        cost += 0.5 * ("placed" in named.flags and bool(named.joints)) + 1.0 * (
            "modified" in named.flags and self._is_pronoun(named.heads)
        )
        # What an object "with" another is moved to stands behind both; "with the pears on the left" is no such place.
        aside = any(fact[0] == "place" and not fact[3] for fact in modifier.facts)
        there = any(fact[0] == "rel" and not self._is_pronoun(fact[3]) for fact in modifier.facts)
        # "Put the soup with noodles in the bowl": bare noodles tell which soup.
        bare = not any(self._phrase(head).determined or self._phrase(head).count for head in modifier.heads)
        bare = bare and not self._is_pronoun(modifier.heads)
        cost += (0.2 + 0.6 * (aside or bare) + 0.3 * there) * (link.manner == "with")
        cost += 0.6 * any(fact[0] == "rel" and self._link(fact[1]).manner == "source" for fact in modifier.facts)
        cost += _CRAMPED * (self._tells_where(at) and any(map(self._crowds, modifier.facts)))
        # "The cup on the tray and the one on the chair under the lamp": "on the chair" tells which one.
        placed = {head for fact in named.facts if fact[0] in ("rel", "have") for head in fact[2]}
        ones = {head for head in (*placed, *named.heads) if self._the_one(head)}
        cost += 0.9 * bool(ones - placed or (ones and placed - ones) or ones - {*named.heads})
        # What is told of with the object itself keeps near to it.
        cost += 0.15 * ("modified" in named.flags)
        # "The red cup on the tray and the blue one on the shelf": the blue one is moved too.
        cost += 0.9 * any(fact[0] == "rel" and self._told_from_its_like(fact[2]) for fact in modifier.facts)
        # "The pen in the cup next to the other pens": those are in the cup.
        cost += 0.9 * any(fact[0] == "rel" and self._is_like(fact[3], named.heads) for fact in modifier.facts)
        # "The jar with the nuts on the tray and the jar with the figs on the shelf": one on each.
        cost += 0.3 * (len({self._noun(head) for head in named.heads}) < len(named.heads))
        # "Apple right of tray and red cup on tray": the cup is put on the tray, and the apple is not told by it.
        rels = [fact for fact in named.facts if fact[0] == "rel" and len(fact[3]) > 1]
        cost += 0.6 * any(self._named_again(head, replace(named, heads=fact[3], facts=()))
                          for fact in rels for head in modifier.heads)  # fmt: skip
        cost += sum(
            self._link(fact[1]).manner == "goal" for fact in (*named.facts, *modifier.facts) if fact[0] == "rel"
        )
        facts = (*named.facts, *modifier.facts, ("goal", at, named.heads, modifier.heads))
        return Node("IM", named.start, cost, named.heads, facts, named.joints, named.flags)

    def _crowds(self, fact: tuple) -> bool:
        """Whether `fact` has a vessel on a plate, little room beside: "the bowl next to the box on the plate"."""
        if fact[0] != "rel" or self._link(fact[1]).kind not in SUPPORT_KINDS:
            return False
        likely, dish = self._likely, self._noun(fact[3][0])
        vessels = (noun for noun in map(self._noun, fact[2]) if likely.hollow(noun) or likely.is_a(noun, _BOXES))
        return self._is_small(fact[3][0]) and any(likely.on(noun, dish) > 0.0 for noun in vessels)

    def _is_small(self, head: int) -> bool:
        """Whether `head` is a plate, and no tray."""
        dish = self._noun(head)
        return self._likely.is_a(dish, lexicon.DISHES) and not self._likely.is_a(dish, lexicon.LEVEL)

    def _told_from_its_like(self, heads: tuple[int, ...]) -> bool:
        """Whether `heads` are "the blue one" or "the other": one more of what was named before."""
        return all(self._phrase(head).kind == "pieces" and self._phrase(head).determined for head in heads)

    def _the_one(self, head: int) -> bool:
        """Whether `head` is "the one" or "the ones", which something is to tell."""
        return self._phrase(head).words.lower() in ("the one", "the ones")

    def _is_like(self, heads: tuple[int, ...], moved: tuple[int, ...]) -> bool:
        """Whether `heads` are "the other cups" beside which a cup, `moved`, is to go."""
        return all(self._phrase(head).other and self._noun(head) == self._noun(moved[0]) for head in heads)

    def _shares_determiner(self, first: Node, rest: Node) -> bool:
        """Whether `rest` has no "a" of its own and stands directly behind what has one and is said of `first`."""
        before, behind = self._chunks[rest.start - 1].phrase, self._phrase(rest.heads[0])
        if before is None or rest.start - 1 in first.heads or behind.kind != "object":
            return False
        bare = not (behind.determined or behind.possessive or behind.plural or behind.count)
        bare = bare and not behind.modifiers.colours
        aside = any(fact[0] == "goal" and self._link(fact[1]).kind in LATERAL_KINDS for fact in first.facts)
        moved = self._phrase(first.heads[0]).determined or (aside and self._is_pronoun(first.heads))
        return bare and (before.determined or before.possessive) and moved
