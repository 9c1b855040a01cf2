"""The grammar of a scene description: which chunks and phrases make larger ones, and what that says.

Categories: L what is named, with all that is said of it; M a modifier ("on a table", "with a lid", "in a row"), CM one
after a joint; CL the rest of a list; E "there is"; EL, VL what is there; S a clause; CS one after a joint. Facts are
tuples: ("rel", link, children, parents), ("have", link, parents, children), ("place", chunk, children, owners),
("form", chunk, members), ("quality", chunk, objects), ("bind", pronoun, what), ("subject", what, first chunk).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from pat3d.plan.grammar.chart import Node, Rule, parse
from pat3d.plan.grammar.chunks import Chunk
from pat3d.plan.grammar.links import Link
from pat3d.plan.grammar.phrases import Phrase
from pat3d.plan.grammar.plausible import Plausible
from pat3d.scene.model import SUPPORT_KINDS

_LEAVES = {
    "noun": "L", "rel": "R", "have": "H", "place": "A", "form": "F", "quality": "Q", "joint": "C", "clause": "X",
    "verb": "V", "there": "E", "which": "W",
}  # fmt: skip
_HEADLESS = ("pieces", "part")


class Grammar:
    """The rules over the chunks of one sentence."""

    def __init__(self, chunks: Sequence[Chunk], likely: Plausible) -> None:
        self._chunks = chunks
        self._likely = likely
        self._rules: dict[tuple[str, str], list[Rule]] = {
            # Modifiers
            ("R", "L"): [self._relation], ("H", "L"): [self._relation], ("V", "M"): [self._predicate],
            ("V", "Q"): [self._quality], ("W", "M"): [self._relative], ("C", "M"): [self._joined_modifier],
            ("X", "M"): [self._joined_modifier], ("V", "V"): [lambda a, b: replace(a, cost=a.cost + b.cost)],
            ("V", "A"): [self._placed], ("V", "F"): [self._placed],
            ("L", "M"): [self._modified], ("L", "CM"): [self._modified],
            # Lists
            ("C", "L"): [self._rest], ("L", "CL"): [self._list], ("V", "L"): [self._predicated],
            ("L", "VL"): [self._equation],
            # Clauses
            ("E", "L"): [self._existing], ("C", "EL"): [self._joined], ("M", "EL"): [self._fronted],
            ("M", "CEL"): [self._fronted], ("M", "CL"): [self._fronted], ("M", "L"): [self._fronted],
            ("M", "VL"): [self._fronted], ("C", "S"): [self._clause], ("X", "S"): [self._clause],
            ("X", "L"): [self._clause], ("C", "W"): [lambda a, b: replace(b, start=a.start)],
            ("S", "CS"): [self._clauses], ("L", "CS"): [self._clauses], ("S", "CL"): [self._clauses],
            ("CM", "L"): [self._clause_front], ("CM", "VL"): [self._clause_front], ("S", "CM"): [self._late],
        }  # fmt: skip
        self._unary: dict[str, list[Callable[[Node], Node | None]]] = {
            "A": [self._place], "F": [self._place], "EL": [lambda node: replace(node, cat="S")],
        }

    def readings(self) -> list[Node]:
        """Readings of the whole sentence, likeliest first."""
        leaves = [
            Node(cat=_LEAVES[chunk.kind], start=at, heads=(at,) if chunk.kind == "noun" else (), mod=(at,))
            for at, chunk in enumerate(self._chunks)
        ]
        leaves = [replace(leaf, mod=None) if leaf.cat == "L" else leaf for leaf in leaves]
        return parse(leaves, self._rules, self._unary, ("L", "S"))

    def _phrase(self, at: int) -> Phrase:
        phrase = self._chunks[at].phrase
        assert phrase is not None
        return phrase

    def _link(self, at: int) -> Link:
        link = self._chunks[at].link
        assert link is not None
        return link

    def _noun(self, at: int) -> str:
        return self._likely.fits(self._phrase(at))

    # Modifiers

    def _relation(self, link: Node, objects: Node) -> Node:
        """"on" + "a table": a modifier that waits for what it is said of."""
        assert link.mod
        at = link.mod[0]
        cost = link.cost + objects.cost + 0.3 * ("comma" in objects.flags) + 0.8 * ("finite" in objects.flags)
        said = self._link(at)
        if said.manner == "between":
            plural = len(objects.heads) > 1 or any(self._several(head) for head in objects.heads)
            cost += 0.0 if plural and len(objects.heads) <= 2 else 1.5
        if not said.inverse and len(objects.heads) > 1 and said.manner != "between" and said.says != "across":
            # One thing on several, or beside several.
            cost += 0.9 if said.kind in SUPPORT_KINDS else 0.5
        flags = frozenset({"finite"} if said.finite else ()) | (objects.flags & {"trailing"})
        return Node("M", link.start, cost, objects.heads, objects.facts, objects.joints, flags, ("link", at))

    def _place(self, node: Node) -> Node:
        assert node.mod
        kind = "form" if node.cat == "F" else "place"
        return Node("M", node.start, node.cost, mod=(kind, node.mod[0]))

    def _placed(self, verb: Node, place: Node) -> Node:
        made = self._place(place)
        return replace(made, start=verb.start, flags=made.flags | {"finite"})

    def _quality(self, verb: Node, quality: Node) -> Node:
        assert quality.mod
        return Node("M", verb.start, verb.cost, flags=frozenset({"finite"}), mod=("quality", quality.mod[0]))

    def _predicate(self, verb: Node, modifier: Node) -> Node:
        return replace(modifier, start=verb.start, cost=verb.cost + modifier.cost, flags=modifier.flags | {"finite"})

    def _relative(self, which: Node, modifier: Node) -> Node:
        """"which is on a table": said of what stands before, like any modifier."""
        return replace(modifier, start=which.start, flags=(modifier.flags - {"finite"}) | {"which"})

    def _joined_modifier(self, joint: Node, modifier: Node) -> Node | None:
        text = self._chunks[joint.start].text
        cost = 0.3 if "and" in text and "finite" not in modifier.flags else 0.0
        return replace(modifier, cat="CM", start=joint.start, cost=modifier.cost + cost)

    def _modified(self, named: Node, modifier: Node) -> Node | None:
        """Say `modifier` of all that `named` names."""
        kind, at = modifier.mod  # type: ignore[misc]
        cost = named.cost + modifier.cost + (0.12 if named.flags & {"modified"} and "finite" not in modifier.flags else 0)
        facts = (*named.facts, *modifier.facts)
        flags = named.flags | {"modified"} | (modifier.flags & {"finite"})
        if modifier.cat == "CM":
            flags |= {"comma"}
            cost += 0.1
        if "finite" in named.flags and "finite" not in modifier.flags:
            cost += 0.1
        if "colon" in named.flags:
            cost += 0.3
        if kind != "link":
            if kind == "form" and len(named.heads) == 1 and not self._several(named.heads[0]):
                cost += 0.6
            if kind == "place" and len(named.heads) > 1 and self._chunks[at].text != "both":
                cost += 0.25
            said = (kind, at, named.heads, ()) if kind == "place" else (kind, at, named.heads)
            return Node("L", named.start, cost, named.heads, (*facts, said), named.joints, flags)
        link = self._link(at)
        if len(named.heads) > 1 and link.inverse:
            cost += 0.9
        if link.inverse:
            made, extra = self._having(at, link, named.heads, modifier)
            return Node("L", named.start, cost + extra, named.heads, (*named.facts, *made), named.joints, flags)
        extra = self._arcs(link, named.heads, modifier.heads)
        if link.kind in SUPPORT_KINDS and link.manner == "place":
            extra += sum(self._again(head, named.facts) for head in named.heads) / len(named.heads)
        if self._is_pronoun(modifier.heads) and self._holder(named, modifier.heads[0]):
            cost += 0.0
        said = ("rel", at, named.heads, modifier.heads)
        return Node("L", named.start, cost + extra, named.heads, (*facts, said), named.joints, flags)

    def _again(self, head: int, facts: tuple[tuple, ...]) -> float:
        """The cost of a second support for what has one."""
        told = (fact for fact in facts if fact[0] == "rel" and head in fact[2] and len(fact[2]) == 1)
        return 0.25 if any(self._link(fact[1]).kind in SUPPORT_KINDS for fact in told) else 0.0

    def _holder(self, named: Node, pronoun: int) -> bool:
        return bool(named.heads) and pronoun > named.start

    def _having(self, at: int, link: Link, owners: tuple[int, ...], modifier: Node) -> tuple[list[tuple], float]:
        """Facts of `owners` with what `modifier` names: in or on them, or where it says ("a pen inside")."""
        facts: list[tuple] = []
        placed: set[int] = set()
        cost = 0.0
        for fact in modifier.facts:
            if fact[0] == "place" and set(fact[2]) <= set(modifier.heads) and not fact[3] and not placed & set(fact[2]):
                facts.append(("place", fact[1], fact[2], owners))
                placed |= set(fact[2])
                said = self._chunks[fact[1]].link
                if said is not None:
                    cost += self._arcs(said, fact[2], owners)
                continue
            if fact[0] == "rel" and set(fact[2]) <= set(modifier.heads) and self._is_pronoun(fact[3]):
                facts.append(("bind", fact[3][0], owners))
                cost += self._arcs(self._link(fact[1]), fact[2], owners)
                placed |= set(fact[2])
            facts.append(fact)
        left = tuple(head for head in modifier.heads if head not in placed)
        if left:
            facts.append(("have", at, owners, left))
            parts = [head for head in left if self._phrase(head).kind in _HEADLESS]
            things = [head for head in left if head not in parts]
            if things and link.manner not in ("include", "of"):
                cost += sum(
                    self._likely.having(link, self._noun(owner), self._noun(head)) for head in things for owner in owners
                ) / (len(things) * len(owners)) + 0.25 * sum(
                    self._likely.having(link, self._noun(owners[0]), self._noun(head)) > 1.0 for head in things
                )
        if link.manner == "of" and left:
            cost += 0.0 if self._likely.hollow(self._noun(owners[0])) or self._likely.level(self._noun(owners[0])) else 0.5
        return facts, cost

    def _arcs(self, link: Link, children: tuple[int, ...], parents: tuple[int, ...]) -> float:
        costs = [self._likely.relation(link, self._noun(c), self._noun(p)) for c in children for p in parents]
        return sum(costs) / max(len(costs), 1)

    def _is_pronoun(self, heads: tuple[int, ...]) -> bool:
        return len(heads) == 1 and (
            self._phrase(heads[0]).kind == "pronoun"
            or (self._phrase(heads[0]).kind == "part" and self._phrase(heads[0]).possessive)
        )

    def _several(self, at: int) -> bool:
        phrase = self._phrase(at)
        return phrase.plural or (phrase.count or 1) > 1 or phrase.kind in ("pronoun", "pieces", "items")

    # Lists

    def _rest(self, joint: Node, named: Node) -> Node:
        text = self._chunks[joint.start].text
        mark = ":" if ":" in text else ";" if text == ", and" else "&" if text == "and" else ","
        return Node("CL", joint.start, named.cost, named.heads, named.facts, mark + named.joints, named.flags)

    def _list(self, first: Node, rest: Node) -> Node | None:
        """"a mug" + ", a plate and a fork"."""
        mark, later = rest.joints[0], rest.joints[1:]
        facts = (*first.facts, *rest.facts)
        cost = first.cost + rest.cost
        if mark == ":":
            if any(self._phrase(head).kind == "items" for head in first.heads):
                facts = (*facts, *(("bind", head, rest.heads) for head in first.heads))
                return Node("L", first.start, cost, rest.heads, facts, "", first.flags | rest.flags)
            if all(self._phrase(head).kind in _HEADLESS for head in rest.heads):
                return Node("L", first.start, cost, first.heads, facts, "", first.flags | {"colon"})
            said = ("list", rest.start, first.heads, rest.heads)
            extra = sum(
                self._likely.having(Link(manner="with"), self._noun(first.heads[0]), self._noun(head)) for head in rest.heads
            ) / len(rest.heads)
            return Node("L", first.start, cost + extra, first.heads, (*facts, said), "", first.flags | {"colon"})
        if "&" == mark and set(later) & {",", ";"}:
            cost += 0.5
        if mark in "&;" and "&" in later:
            cost += 0.1 if "," not in later else 0.6
        if mark == "," and not set(later) & {"&", ";"}:
            cost += 0.3
        if mark == ";" and not later and not first.joints:
            cost += 0.15
        headless = [self._phrase(head).kind in _HEADLESS for head in rest.heads]
        if all(headless) and not all(self._phrase(head).kind in _HEADLESS for head in first.heads):
            # "two mugs, one on a plate": said of the mugs, nothing more is named.
            flags = first.flags | (rest.flags & {"finite"}) | {"told"}
            return Node("L", first.start, cost, first.heads, facts, "", flags)
        if any(headless) and not all(headless):
            cost += 0.4
        if "modified" in rest.flags and "modified" not in first.flags and len(rest.heads) == 1:
            cost += 0.15
        if "modified" in first.flags:
            cost += 0.15 if "finite" not in first.flags else 0.3
        if "finite" in rest.flags and "finite" not in first.flags:
            cost += 0.4
        flags = (first.flags | rest.flags) - {"comma", "modified"}
        return Node("L", first.start, cost, (*first.heads, *rest.heads), facts, rest.joints + first.joints, flags)

    def _predicated(self, verb: Node, named: Node) -> Node:
        return replace(named, cat="VL", start=verb.start)

    def _equation(self, named: Node, what: Node) -> Node | None:
        """"The items are a lamp and a mug"."""
        kinds = {self._phrase(head).kind for head in named.heads}
        if not kinds & {"items", "pieces", "pronoun", "background"}:
            return None
        facts = (*named.facts, *what.facts, *(("bind", head, what.heads) for head in named.heads))
        return Node("L", named.start, named.cost + what.cost, what.heads, facts, "", frozenset({"finite"}))

    # Clauses

    def _existing(self, there: Node, named: Node) -> Node:
        return replace(named, cat="EL", start=there.start)

    def _joined(self, joint: Node, node: Node) -> Node:
        return replace(node, cat="CEL", start=joint.start)

    def _fronted(self, modifier: Node, named: Node) -> Node | None:
        """"On the table there is" + "a mug"."""
        if modifier.mod[0] == "quality" or "finite" in modifier.flags and named.cat != "CL":  # type: ignore[index]
            return None
        link = self._link(modifier.mod[1]) if modifier.mod[0] == "link" else None  # type: ignore[index]
        if link is not None and link.inverse and link.manner != "surround":
            return None
        cost = 0.6 if named.cat == "L" else 0.2 if named.cat == "CL" else 0.0
        whole = self._modified(replace(named, cat="L", flags=named.flags - {"modified"}), replace(modifier, cat="M"))
        if whole is None:
            return None
        first = modifier.heads[:1] if link is not None else ()
        facts = (*whole.facts, ("subject", named.heads, modifier.start), *((("front", first),) if first else ()))
        if len(named.heads) > 1:
            cost -= 0.1
        return Node("S", modifier.start, whole.cost + cost, named.heads, facts, "", whole.flags)

    def _clause(self, joint: Node, clause: Node) -> Node:
        return replace(clause, cat="CS", start=joint.start, cost=clause.cost + 0.2)

    def _clause_front(self, modifier: Node, named: Node) -> Node | None:
        made = self._fronted(replace(modifier, cat="M"), named)
        return None if made is None else replace(made, cat="CS", cost=made.cost + 0.2)

    def _clauses(self, first: Node, second: Node) -> Node:
        subject = () if any(fact[0] == "subject" and fact[1] == first.heads for fact in first.facts) else (
            ("subject", first.heads, first.start),)  # fmt: skip
        later = () if second.cat == "CS" and any(f[0] == "subject" and f[1] == second.heads for f in second.facts) else (
            ("subject", second.heads, second.start),)  # fmt: skip
        cost = first.cost + second.cost + (0.3 if second.cat == "CL" else 0.0)
        heads = (*first.heads, *second.heads) if second.cat == "CL" else first.heads
        return Node("S", first.start, cost, heads, (*first.facts, *subject, *second.facts, *later), "", first.flags)

    def _late(self, clause: Node, modifier: Node) -> Node | None:
        """"On a desk there is a lamp, with a mug beside it"."""
        made = self._modified(replace(clause, cat="L"), modifier)
        return None if made is None else replace(made, cat="S", cost=made.cost + 0.1)
