"""The grammar of a scene description: which chunks and phrases make larger ones, and what that says.

Categories: L what is named, with all that is said of it; M a modifier ("on a table", "with a lid", "in a row"), CM one
after a joint; CL the rest of a list; E "there is"; EL, VL what is there; S a clause; CS one after a joint. Facts are
tuples: ("rel", link, children, parents), ("have", link, parents, children), ("place", chunk, children, owners),
("form", chunk, members), ("quality", chunk, objects), ("bind", pronoun, what), ("subject", what, first chunk).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.parsing.chart import Node, Rule, parse, parts
from pat3d.plan.grammar.parsing.judging import HEADLESS
from pat3d.plan.grammar.parsing.listing import Listing
from pat3d.scene.relations import LATERAL_KINDS, SUPPORT_KINDS

_LEAVES = {
    "noun": "L", "rel": "R", "have": "H", "place": "A", "form": "F", "quality": "Q", "joint": "C", "clause": "X",
    "verb": "V", "there": "E", "which": "W",
}  # fmt: skip

_DISAGREES = 0.4
"""Cost of one thing of which a verb of several is said."""


class Grammar(Listing):
    """The rules over the chunks of one sentence."""

    def __init__(self, chunks: Sequence[Chunk], likely: Plausible) -> None:
        super().__init__(chunks, likely)
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
            ("M", "VL"): [self._fronted], ("M", "S"): [self._fronted_clause], ("M", "CS"): [self._fronted_clause],
            ("C", "S"): [self._clause], ("X", "S"): [self._clause],
            ("X", "L"): [self._clause], ("C", "W"): [lambda a, b: replace(b, start=a.start)],
            ("S", "CS"): [self._clauses], ("L", "CS"): [self._clauses], ("S", "CL"): [self._clauses],
            ("CM", "L"): [self._clause_front], ("CM", "VL"): [self._clause_front],
            ("CM", "CL"): [self._clause_front], ("S", "CM"): [self._late],
        }  # fmt: skip
        self._unary: dict[str, list[Callable[[Node], Node | None]]] = {
            "A": [self._place],
            "F": [self._place],
            "EL": [lambda node: replace(node, cat="S")],
        }

    def readings(self, *, moving: bool = False, putting: bool = False) -> list[Node]:
        """Readings of the whole sentence, likeliest first; of what is `moving`, those that say where to before all.

        With `putting` the verb is one of putting, behind which "on" says where to.
        """
        self._moving, self._putting = moving, putting
        leaves = self._leaves()
        if not moving:
            return parse(leaves, self._rules, self._unary, ("L", "S"))
        rules = {**self._rules, ("L", "M"): [self._modified, self._goal], ("L", "CM"): [self._modified, self._goal],
                 ("C", "IM"): [lambda a, b: replace(b, cat="CIM", start=a.start)], ("IM", "CIM"): [self._goals],
                 ("IM", "M"): [self._further], ("IM", "CM"): [self._further]}  # fmt: skip
        made = parse(leaves, rules, self._unary, ("IM", "L", "S"))
        return [node for node in made if node.cat == "IM"] or made

    def pieces(self) -> list[list[Node | None]]:
        """The likeliest reading of the chunks from one to before another as what is named or as a clause."""
        cells = parts(self._leaves(), self._rules, self._unary)
        return [[min((node for cat in ("L", "S") for node in cell.get(cat, ())), key=lambda node: node.cost,
                     default=None) for cell in row] for row in cells]  # fmt: skip

    def _leaves(self) -> list[Node]:
        leaves = [
            Node(cat=_LEAVES[chunk.kind], start=at, heads=(at,) if chunk.kind == "noun" else (), mod=(at,))
            for at, chunk in enumerate(self._chunks)
        ]
        return [replace(leaf, mod=None) if leaf.cat == "L" else leaf for leaf in leaves]

    # Modifiers

    def _relation(self, link: Node, objects: Node) -> Node:
        """Read "on" + "a table": a modifier that waits for what it is said of."""
        at = link.start
        set_off = 0.9 if link.start == 0 else 0.3
        cost = link.cost + objects.cost + set_off * ("comma" in objects.flags) + 0.8 * ("finite" in objects.flags)
        said = self._link(at)
        if said.manner == "between":
            plural = len(objects.heads) > 1 or any(self._several(head) for head in objects.heads)
            # "between a, b and c", but not "between a and b, and c".
            whole = len(objects.heads) <= 2 or not set(objects.joints[:-1]) - {","}
            cost += (0.0 if len(objects.heads) <= 2 else 0.2) if plural and whole else 1.5
            # "between two dolls, a ball at its feet": the two are the neighbours.
            cost += 0.8 * (len(objects.heads) > 1 and self._phrase(objects.heads[0]).count == 2)
        ring = said.says == "circle" and set(objects.joints) <= {"&", ","}
        # "next to a wall and a bench": beside the bench; but not "in front of a window and a rug on the floor".
        backed = said.kind in LATERAL_KINDS and any(self._only_background((head,)) for head in objects.heads)
        placed = any(chunk.kind in ("rel", "place") for chunk in self._chunks[max(objects.heads) + 1 :][:1])
        ring = (
            ring
            or (objects.joints == "&" and self._ranked(objects.heads))
            or (backed and objects.joints == "&" and not placed)
            or self._ends_in_neighbours(at, objects)
        )
        if not (said.inverse or ring) and len(objects.heads) > 1 and said.manner != "between" and said.says != "across":
            # One thing on several, or beside several.
            cost += 0.9 if said.kind in SUPPORT_KINDS else 0.35 if self._two_landmarks(objects) else 0.5
            # "A keyboard in front of it and a mouse": the mouse is one more thing.
            cost += 0.6 * (self._is_pronoun(objects.heads[:1]) and not self._definite(objects.heads[1:]))
        if said.kind in SUPPORT_KINDS and said.manner == "place" and len(objects.heads) == 1:
            # "A toolbox sits on a bench holding a hammer": the toolbox holds it, where it can.
            held = [fact for fact in objects.facts if fact[0] == "have" and fact[2] == objects.heads]
            doing = any(self._chunks[fact[1]].words[0].endswith("ing") for fact in held)
            cost += 0.55 * (doing and self._likely.floor(self._noun(objects.heads[0])))
        flags = frozenset({"finite"} if said.finite else ()) | (objects.flags & {"trailing"})
        return Node("M", link.start, cost, objects.heads, objects.facts, objects.joints, flags, ("link", at))

    def _place(self, node: Node) -> Node:
        kind = "form" if node.cat == "F" else "place"
        return Node("M", node.start, node.cost, mod=(kind, node.start))

    def _placed(self, verb: Node, place: Node) -> Node:
        made = self._place(place)
        return replace(made, start=verb.start, flags=made.flags | {"finite"})

    def _quality(self, verb: Node, quality: Node) -> Node:
        return Node("M", verb.start, verb.cost, flags=frozenset({"finite"}), mod=("quality", quality.start))

    def _predicate(self, verb: Node, modifier: Node) -> Node:
        return replace(modifier, start=verb.start, cost=verb.cost + modifier.cost, flags=modifier.flags | {"finite"})

    def _relative(self, which: Node, modifier: Node) -> Node:
        """Read "which is on a table": said of what stands before, like any modifier."""
        return replace(modifier, start=which.start, flags=(modifier.flags - {"finite"}) | {"which"})

    def _joined_modifier(self, joint: Node, modifier: Node) -> Node | None:
        text = self._chunks[joint.start].text
        cost = 0.3 if "and" in text and "finite" not in modifier.flags else 0.0
        return replace(modifier, cat="CM", start=joint.start, cost=modifier.cost + cost)

    def _modified(self, named: Node, modifier: Node) -> Node | None:
        """Say `modifier` of all that `named` names."""
        kind, at = modifier.mod  # type: ignore[misc]
        cost = (
            named.cost + modifier.cost + (0.12 if named.flags & {"modified"} and "finite" not in modifier.flags else 0)
        )
        facts = (*named.facts, *modifier.facts)
        flags = named.flags | {"modified"} | (modifier.flags & {"finite"})
        if modifier.cat == "CM":
            flags |= {"comma"}
            # "A dozen eggs, two of them brown, in a carton": said of the dozen.
            aside = "finite" not in modifier.flags and all(self._phrase(h).kind in HEADLESS for h in named.heads)
            cost += 0.1 + 0.7 * (aside and self._chunks[modifier.start].text == ",")
        if "finite" in named.flags and "finite" not in modifier.flags:
            cost += 0.1
        it = len(named.heads) == 1 and self._phrase(named.heads[0]).head in ("it", "them")
        if it and named.start and not modifier.flags & {"finite", "which", "comma"}:
            # "A jar in it filled with nuts": the jar is.
            cost += 0.5
        if (
            modifier.cat == "CM"
            and not modifier.flags & {"finite", "which"}
            and not named.flags & {"modified", "finite"}
        ):
            # "The box is bigger than the crate and on top of it": the box is.
            cost += 0.6 * (self._chunks[modifier.start].text == "and")
            # "The mug is to the left of the stove and to the right of the sink": the mug is both.
            cost += self._beside_too(named, modifier)
        if set(named.joints) == {","} and kind == "link" and "finite" not in modifier.flags:
            # "a candle, a rose in a vase and a cup": it goes on behind the rose; but "two figs, a pear, in a bowl".
            goes_on = any(chunk.kind == "joint" for chunk in self._chunks[max(modifier.heads) :])
            cost += 0.4 * (modifier.cat == "M" or goes_on)
        if "finite" in named.flags & modifier.flags and (len(named.heads) > 1 or modifier.cat == "M"):
            # "A mug stands on a tray, and a can stands beside it": the mug has its verb.
            cost += 0.5 if modifier.cat == "CM" else 1.5
        if "finite" in modifier.flags:
            alone = len(named.heads) == 1 and self._phrase(named.heads[0]).kind == "pieces"
            cost += (1.8 if alone else 0.5) * self._disagrees(named.heads, modifier.start)
        if "which" in modifier.flags:
            # "A doll and a box, which is under the chair": the box is.
            silent = ("joint", "clause", "which")
            verb = next(n for n in range(modifier.start, len(self._chunks)) if self._chunks[n].kind not in silent)
            cost += 0.9 * (len(named.heads) > 1 and self._disagrees(named.heads, verb))
        if "colon" in named.flags:
            cost += 0.3
        if "mute" in named.flags and "finite" in modifier.flags:
            # "Three crates: the first holds a ball": said of the first.
            cost += 0.5
        inner = kind == "place" or (kind == "link" and self._is_pronoun(modifier.heads) and not self._link(at).inverse)
        if "which" in modifier.flags and max(named.heads) < modifier.start - 2:
            # "A stool carries a radio which carries a cactus": said of the radio.
            cost += 0.4
        if "told" in named.flags and "finite" not in modifier.flags:
            cost += 0.4
        if "told" in named.flags and kind == "link" and self._link(at).inverse:
            # "Two vases, the left one holding a rose"
            cost += 0.5
        if kind == "link" and not self._link(at).inverse and self._only_background(named.heads):
            cost += 0.9
        if (
            kind == "link"
            and (self._link(at).manner == "of" or self._link(at).filling)
            and not modifier.flags & {"finite", "which"}
            and not (modifier.cat == "CM" and "finite" in named.flags)
            and named.heads != (at - 1 - 2 * self._behind_it(at),)
        ):
            # "a bowl of oranges": of what stands directly before, or before "in it".
            return None
        inner = inner and self._chunks[at].text not in ("one", "other")
        if inner and "having" in named.flags and modifier.cat == "M" and "finite" not in modifier.flags:
            # "a crate with a dog on top", "a sofa with two cats and a dog between them": said of the dog.
            # "A box has a ball on its left and a cup with a spoon on its right": the cup is.
            again = kind == "place" and self._owned_again(at, modifier.start)
            cost += 1.5 if kind == "link" and self._link(at).manner == "between" else 0.6 * (not again)
        if kind == "link" and self._link(at).inverse:
            # "a tray with a pot and a cup with a spoon": the cup has it.
            cost += 0.6 * self._has_again(named, modifier) + 0.3 * self._passes_over(named, modifier)
            flags |= {"having"}
        if kind != "link" or not self._link(at).inverse:
            flags |= {"placed"}
        if kind != "link":
            flags |= {"formed"} if kind == "form" else set()
            cost += self._formed_of(named, modifier) if kind == "form" else 0.0
            mutual = kind == "form" and {"other", "another"} & {*self._chunks[at].words}
            if mutual and "finite" not in modifier.flags and len(named.heads) > 1:
                # "A lamp and two books stacked on each other": the books are.
                cost += 0.6 * ((self._phrase(named.heads[-1]).count or 1) > 1)
            if kind == "form" and self._chunks[at].text == "tower" and len(named.heads) != self._chunks[at].size:
                return None
            if kind == "form" and self._some_of(modifier.start - 1) and named.heads != (modifier.start - 1,):
                # "Five books, three of them stacked": of those three.
                cost += 1.5
            if self._chunks[at].text in ("one", "other"):
                cost += 0.5
            if named.start == 0 and {"its", "their"} & set(self._chunks[at].words):
                # "three plates, each with a fork on its left": said of the fork.
                cost += 0.6
            if kind == "place" and len(named.heads) > 1 and self._chunks[at].text != "both":
                close = self._chunks[at].link is None and "," not in named.joints and named.start > 0
                cost += (0.2 if close else 0.45) + 0.6 * (len({*map(self._noun, named.heads)}) < len(named.heads))
                # "A table with four chairs and a vase in the middle": the vase is.
                cost += 0.4 * (close and self._chunks[at].text == "centre")
            said = (kind, at, named.heads, ()) if kind == "place" else (kind, at, named.heads)
            return Node("L", named.start, cost, named.heads, (*facts, said), named.joints, flags)
        link = self._link(at)
        if len(named.heads) > 1 and link.inverse:
            # "The left and the right tray hold an egg": both.
            cost += 0.1 if "finite" in modifier.flags and self._of_several(modifier.start) else 0.9
        if len(named.heads) > 1 and "placed" in named.flags and "finite" not in modifier.flags:
            # "A mug on a tray, a can behind a bowl"
            cost += 0.2 + 0.3 * self._placed_apart(named)
        if link.manner == "include":
            listed = ("include", at, named.heads, modifier.heads)
            cost += 0.0 if len(named.heads) == 1 and self._several(named.heads[0]) else 1.5
            told = all(self._phrase(head).kind in HEADLESS for head in modifier.heads)
            heads = named.heads if told else modifier.heads
            return Node("L", named.start, cost, heads, (*facts, listed), named.joints, flags | {"included"})
        if link.inverse:
            made, extra = self._having(at, link, named, modifier)
            return Node("L", named.start, cost + extra, named.heads, (*named.facts, *made), named.joints, flags)
        extra = self._arcs(link, named.heads, modifier.heads) + self._carries_it(link, named, modifier)
        if link.manner == "between" and len(named.heads) > 1 and self._is_pronoun(modifier.heads):
            # "two cushions and a cat between them": the cat is.
            cost += 0.9
        if link.kind in SUPPORT_KINDS and link.manner == "place":
            extra += self._holds_itself(named, modifier) + self._on_one(named.heads, modifier.heads[0])
            twice = sum(self._again(head, named.facts) for head in named.heads) / len(named.heads)
            # What is on a book that is on a table is on the book; nothing is on two small things.
            extra += twice * (1.0 if self._likely.level(self._noun(modifier.heads[0])) else 3.0)
            # "A mug on the desk and another one on the shelf"
            extra += 0.4 * (bool(twice) and len(named.heads) > 1)
            # "A mug is on the table, and two more are on the shelf": the first mug is not.
            extra += 0.5 * (bool(twice) and {"finite"} <= named.flags & modifier.flags)
        if link.kind in LATERAL_KINDS:
            extra += self._has_sides(named, modifier)
        if link.manner == "under" and self._stands(modifier):
            # "A book under a lamp on a table": the book is on the table; but "under a coat hanging on a hook".
            cost += 0.6
        if any(self._again_named(head, named.heads) for head in modifier.heads):
            # "Two trays: on the first, three cups": no trays are on one of them.
            cost += 3.0 if named.heads < modifier.heads and self._one_of(modifier.heads[:1], named.heads) else 1.0
        another = self._one_more(modifier.heads[0]) and not self._phrase(modifier.heads[0]).definite
        if another and not any(self._phrase(head).modifiers.colours for head in named.heads):
            # "A red cup stands on a desk next to a blue one": the blue one is no desk.
            cost += 0.5
        ones = [self._phrase(head).words.lower().endswith(" one") for head in named.heads]
        if len(ones) > 1 and ones[-1] and not any(ones[:-1]) and "finite" not in modifier.flags:
            # "two white, one black, and a red one on top of a white one"
            cost += 0.8 * all(self._phrase(head).kind in HEADLESS for head in named.heads)
        cost += 1.2 * any(self._said_of(named, head) for head in modifier.heads)
        said = ("rel", at, named.heads, modifier.heads)
        return Node("L", named.start, cost + extra, named.heads, (*facts, said), named.joints, flags)

    # What something is said to be

    def _predicated(self, verb: Node, named: Node) -> Node:
        cost = _DISAGREES * self._said_of_several(named.heads, verb.start)
        return replace(named, cat="VL", start=verb.start, cost=named.cost + cost)

    def _equation(self, named: Node, what: Node) -> Node | None:
        """Read "The items are a lamp and a mug"; in "around them are a cup and a mug" they are something else."""
        kinds = {self._phrase(head).kind for head in named.heads}
        if not kinds & {"items", "pieces", "pronoun", "background"} or "them" in self._chunks[named.start].words:
            return None
        facts = (*named.facts, *what.facts, *(("bind", head, what.heads) for head in named.heads))
        return Node("L", named.start, named.cost + what.cost, what.heads, facts, "", frozenset({"finite"}))

    # Clauses

    def _existing(self, there: Node, named: Node) -> Node:
        cost = _DISAGREES * self._said_of_several(named.heads, there.start)
        return replace(named, cat="EL", start=there.start, cost=named.cost + cost)

    def _joined(self, joint: Node, node: Node) -> Node:
        return replace(node, cat="CEL", start=joint.start)

    def _fronted(self, modifier: Node, named: Node) -> Node | None:
        """Read "On the table there is" + "a mug"."""
        if modifier.mod[0] == "quality" or ("finite" in modifier.flags and named.cat != "CL"):  # type: ignore[index]
            return None
        link = self._link(modifier.mod[1]) if modifier.mod[0] == "link" else None  # type: ignore[index]
        if link is not None and link.inverse and link.manner != "surround":
            return None
        cost = 0.6 if named.cat == "L" else 0.2 if named.cat == "CL" else 0.0
        whole = self._modified(replace(named, cat="L", flags=named.flags - {"modified"}), replace(modifier, cat="M"))
        if whole is None:
            return None
        first = modifier.heads[:1] if link is not None else ()
        if link is not None and link.kind in SUPPORT_KINDS and len(named.heads) > 1:
            # "On the bench are a vise, a drill and six screws in a dish": the bench carries the vise.
            inner = (f for f in named.facts if f[0] == "rel" and f[2] == named.heads)
            cost += 0.25 * any(self._link(f[1]).kind in SUPPORT_KINDS for f in inner)
        facts = (*whole.facts, ("subject", named.heads, modifier.start), *((("front", first),) if first else ()))
        if named.cat == "CL" and not named.joints.startswith(":"):
            facts = (*facts, ("comma front", modifier.start))
        if len(named.heads) > 1:
            bare = link is None and self._chunks[modifier.mod[1]].link is not None  # type: ignore[index]
            cost -= 0.4 if bare else 0.1
        return Node("S", modifier.start, whole.cost + cost, named.heads, facts, "", whole.flags)

    def _fronted_clause(self, modifier: Node, clause: Node) -> Node | None:
        """Read "On a table," + "from left to right: a mug and a bowl"."""
        if not any(fact[0] == "front" for fact in clause.facts):
            return self._fronted(modifier, replace(clause, cat="CL"))
        # "On the desk next to the laptop is a mug": both places are the mug's.
        comma = self._chunks[clause.start].kind == "joint"
        inner = self._chunks[clause.start + comma].link
        link = self._chunks[modifier.mod[1]].link if modifier.mod[0] == "link" else None  # type: ignore[index]
        if link is None or inner is None or {"twice"} & clause.flags or {"finite"} & modifier.flags:
            return None
        if link.inverse or inner.inverse or (inner.kind in SUPPORT_KINDS and inner.manner == "place"):
            return None
        nearer = next(fact[1] for fact in clause.facts if fact[0] == "front")
        there = link.kind in SUPPORT_KINDS and all(
            self._phrase(head).kind == "object" and not self._likely.floor(self._noun(head)) for head in nearer
        )
        placed = (*nearer, *clause.heads) if there else clause.heads
        facts = (*modifier.facts, ("rel", modifier.mod[1], placed, modifier.heads), *clause.facts)  # type: ignore[index]
        cost = clause.cost + modifier.cost + self._arcs(link, clause.heads, modifier.heads)
        cost += 0.0 if comma else self._both_places(modifier.heads, nearer)
        return Node("S", modifier.start, cost, clause.heads, facts, "", clause.flags | {"twice"})

    def _clause(self, joint: Node, clause: Node) -> Node:
        comma = 0.9 * any(fact[0] == "comma front" for fact in clause.facts)
        return replace(clause, cat="CS", start=joint.start, cost=clause.cost + 0.2 + comma)

    def _clause_front(self, modifier: Node, named: Node) -> Node | None:
        made = self._fronted(replace(modifier, cat="M"), named)
        comma = 0.9 * (named.cat == "CL")
        return None if made is None else replace(made, cat="CS", cost=made.cost + 0.2 + comma)

    def _clauses(self, first: Node, second: Node) -> Node:
        subject, later = self._subject(first), self._subject(second)
        cost = first.cost + second.cost + (self._goes_on(first, second) if second.cat == "CL" else 0.0)
        heads = (*first.heads, *second.heads) if second.cat == "CL" else first.heads
        return Node("S", first.start, cost, heads, (*first.facts, *subject, *second.facts, *later), "", first.flags)

    @staticmethod
    def _subject(clause: Node) -> tuple[tuple, ...]:
        """What `clause` is about, where it does not say so yet."""
        known = any(fact[0] == "subject" and fact[1] == clause.heads for fact in clause.facts)
        return () if known else (("subject", clause.heads, clause.start),)

    def _late(self, clause: Node, modifier: Node) -> Node | None:
        """Read "On a desk there is a lamp, with a mug beside it"."""
        made = self._modified(replace(clause, cat="L"), modifier)
        return None if made is None else replace(made, cat="S", cost=made.cost + 0.1)
