"""Chunks for the words between objects: relations, sides, forms such as "in a row"."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Cursor
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.links import ACROSS, EACH_OTHER, LINKS, LONGEST_LINK, SIDES, Link
from pat3d.plan.grammar.words.shapes import GRID, PLACES, RINGS, grid_size, refuse, shape_said
from pat3d.scene.relations import LATERAL_KINDS

_FORMED = frozenset({"arranged", "laid", "organized", "organised", "stacked", "built", "assembled"})
"""Words before "in a cross" that make it a shape and no place."""
_PRINTED = frozenset(
    {"printed", "engraved", "embroidered", "etched", "inscribed", "embossed", "patterned", "emblazoned"}
)
_ORNATE = frozenset({"decorated", "adorned"})
_GARNISHED = ("cake", "cupcake", "pie", "pizza", "pancake", "waffle", "tree", "bread", "salad", "ice cream")
"""What is decorated by what lies or hangs on it, besides furniture."""
_LINED = frozenset({"row", "rows", "line", "lined", "side"})
"""Words of what stands in a line."""
_EVEN = frozenset({"equal", "even", "neat", "tidy", "separate", "identical"})
"""Words of how rows and stacks are, as these are made."""
_BARE_PLACES = frozenset({"inside", "nearby", "beside", "behind", "in front", "on top", "near by", "close by",
    "beneath", "between", "in between",
                          "underneath", "below", "above", "next to", "under", "alongside"})  # fmt: skip
"""Relations that may stand without a landmark: "with two pens inside"."""


class RelationWords(Cursor):
    """Reads what relates objects."""

    def _relation(self) -> bool:
        """Read the longest relation, side or form that begins here, if one does."""
        if self._shape() or self._several() or self._chain():
            return True
        if self._word(0) in _PRINTED and self._word(1) in ("with", "by") and self._ornament(2):
            return True
        for size in range(LONGEST_LINK, 0, -1):
            key = self._words(size)
            if len(key) < size:
                continue
            if key in EACH_OTHER and self._forms(key, size):
                return True
            if key in LINKS and self._link(key, size):
                return True
            verb = self._word(size) in lexicon.VERBS | lexicon.COPULAS
            whole = (
                key[-1] == "side"
                or (self._last is not None and self._last.text.lower() in ("the one", "the ones"))
                or verb
                or self._tokens[self._at + size].mark
                or not self._bounds.goes_on(self._at + size)
            )
            # Ends are those of a row: "at the left end" of a shelf is a part of it.
            told = key in SIDES and (key[-1] != "end" or key[-2] not in ("left", "right") or self._in_line())
            # "On the left one a cup, on the right one a glass": on things told by their sides.
            member = key[-1] in ("left", "right") and self._word(size) in ("one", "ones")
            member = member and self._nouns.match([self._word(size + 1)]) is None
            member = member or self._words(size + 2)[size:] == ("one", "of")
            if told and whole and not member and self._word(size) != "of":
                self._add("place", size, text=SIDES[key])
                return True
        return False

    def _forms(self, key: tuple[str, ...], size: int) -> bool:
        fronted = EACH_OTHER[key] in ("order", "reverse")
        last = self._last
        after = last is not None and last.kind in ("noun", "joint", "rel", "verb", "form", "place")
        noun_follows = size == 1 and last is not None and last.kind in ("joint", "rel", "have") and not (
            link_at(self._tokens, self._at + 1) or self._tokens[self._at + 1].mark
        )  # fmt: skip
        if fronted or (after and not noun_follows):
            if key[0] == "nested":
                self._made.unread.append(" ".join(key))
            self._add("form", size, text=EACH_OTHER[key])
            return True
        return False

    def _in_line(self) -> bool:
        return bool(_LINED & {token.text for token in self._tokens})

    def _chain(self) -> bool:
        """Read "one behind the other"."""
        if self._word(0) != "one" or not (size := link_at(self._tokens, self._at + 1)):
            return False
        link = LINKS.get(self._words(size + 1)[1:])
        other = self._words(size + 3)[size + 1 :]
        chained = other in (("the", "other"), ("the", "next")) or other[:1] == ("another",)
        if link is None or link.kind not in LATERAL_KINDS or not chained:
            return False
        self._add("form", size + (2 if other[0] == "another" else 3), text="chain", link=link)
        return True

    def _link(self, key: tuple[str, ...], size: int) -> bool:
        link = LINKS[key]
        if key[0] in _ORNATE and self._ornament(size):
            return True
        if key == ("against",) and any(
            chunk.link and chunk.link.says == "leaning_against" for chunk in self._made.chunks
        ):
            # "A spoon leans against the first jar, a ladle against the last."
            link = Link(kind="next_to", says="leaning_against")
        if self._words(size + 2)[size:] in (("each", "other"), ("one", "another")):
            if key in ACROSS:
                # "Two chairs opposite each other" face each other.
                link = LINKS["facing",]
            apart = {"far": "far_from", "gaze": "facing"}.get(link.manner, link.says or "")
            if link.kind != "next_to" and not apart:
                self._made.unread.append(" ".join(self._words(size + 2)))
            # "Two bowls inside each other" are as good as stacked.
            self._add("form", size + 2, text="stack" if link.kind == "in" else apart or "beside", link=link)
            return True
        if link.manner == "of" and (self._last is None or self._last.kind != "noun"):
            return False
        # Verbs that are also nouns ("bears", "houses") open no clause.
        plain = ("has", "have", "contains", "holds", "carries", "supports")
        if link.finite and len(key) == 1 and self._opens and key[0] not in plain:
            return False
        if self._names(key[-1], self._word(size)) and size == 1 and link.finite:
            return False
        inverse = link.inverse
        follows = self._tokens[self._at + size]
        after_noun = self._last is not None and self._last.kind == "noun"
        bare = " ".join(key) in _BARE_PLACES and (
            follows.mark
            or follows.text in ("and", "while", "which", "there", "but", "or")
            # "A box with a ball inside that is red", but "and inside that one lies a coin"
            or (follows.text == "that" and after_noun)
            or follows.text in lexicon.COPULAS | lexicon.VERBS
            or (link_at(self._tokens, self._at + size) > 0 and after_noun)
        )
        if bare:
            self._add("place", size, text=" ".join(key), link=link)
        else:
            self._add("have" if inverse else "rel", size, link=link)
        return True

    def _ornament(self, size: int) -> bool:
        """Leave "decorated with birds", `size` words up to the birds: on a vase they are painted, on a table put."""
        last = self._last
        if last is None or last.phrase is None or last.phrase.kind != "object":
            return False
        stands = self._nouns.of_class(last.phrase.noun, (*lexicon.FLOOR, *lexicon.SEATS, *_GARNISHED))
        level = self._nouns.of_class(last.phrase.noun, lexicon.LEVEL)
        dish = self._nouns.of_class(last.phrase.noun, lexicon.DISHES)
        shown = self._phrases.read(self._at + size)
        if shown is None or ((stands or (level and not dish)) and self._word(0) not in _PRINTED):
            return False
        end = shown[1]
        while self._tokens[end].text == "and" and (more := self._phrases.read(end + 1)) and not more[0].determined:
            end = more[1]
        return self._leave(end - self._at)

    def _shape(self) -> bool:
        """Read "in a circle", "in a grid".

        Raises:
            PromptError: objects stand in a shape that no plan expresses.
        """
        words = self._words(3)
        if self._grid():
            return True
        shape = shape_said(words[-1])
        if words[0] not in ("in", "into", "as") or words[1:2] not in (("a",), ("an",)) or shape is None:
            return False
        previous = self._word(-1)
        if shape in PLACES and previous not in _FORMED:
            return False
        after = self._at + 3
        if self._bounds.goes_on(after) and not self._tokens[after].mark:
            return False
        if words[-1] == GRID:
            self._add("form", 3, text="rows")
            return True
        if words[-1] not in RINGS:
            raise refuse(words[-1], self._tokens[after - 1].number)
        if self._tokens[after].text in ("around", "surrounding"):
            return False
        self._add("form", 3, text="circle")
        return True

    def _grid(self) -> bool:
        """Read "in a 2x3 grid", "in a 2 by 3 grid"."""
        words = self._words(6)
        if words[0] not in ("in", "into", "as") or words[1] not in ("a", "an"):
            return False
        apart = words[3] == "by" and words[2].isdecimal() and words[4].isdecimal()
        size = 4 + 2 * apart
        sides = grid_size([f"{words[2]}x{words[4]}" if apart else words[2], words[size - 1]])
        if sides is None:
            return False
        self._add("form", size, text="rows", size=sides[0], each=sides[1])
        return True

    def _several(self) -> bool:
        """Read "in two rows", "in three equal stacks of four"."""
        preposition, number, what, behind = (*self._words(4), "", "", "")[:4]
        even = what in _EVEN
        what = behind if even else what
        count = lexicon.NUMBERS.get(number, int(number[:3]) if number.isdecimal() and number.isascii() else 0)
        kinds = {"rows": lexicon.ROWS, "stacks": lexicon.STACK_NOUNS}
        kind = next((kind for kind, nouns in kinds.items() if nouns & {what, *singulars(what)}), None)
        if preposition not in ("in", "into", "as") or count < 1 or kind is None:
            return False
        tail = [token.text for token in self._tokens[self._at + 3 + even : self._at + 5 + even]]
        of_each = len(tail) == 2 and tail[0] == "of" and (tail[1] in lexicon.NUMBERS or tail[1].isdecimal())
        each = (lexicon.NUMBERS.get(tail[1]) or int(tail[1][:3])) if of_each else 0
        self._add("form", 3 + even + 2 * of_each, text=kind, size=count, each=each)
        return True

    def _of_owner(self) -> bool:
        """Read the "each" behind "two plates hold a bun and a pear" and "two piles of three books": of every one."""
        chunks, at = self._made.chunks, len(self._made.chunks) - 1
        if not self._tokens[self._at + 1].mark or at < 0 or chunks[at].kind != "noun":
            return False
        formed = chunks[at].named.chains > 1
        while at > 0 and chunks[at].kind in ("noun", "joint"):
            at -= 1
        owner = chunks[at - 1].phrase if at and chunks[at].link is not None and chunks[at].relation.inverse else None
        holder = at
        while owner is not None and not owner.several and at > 2 and chunks[at - 2].kind == "rel":
            # "Four jars on a bench hold two nuts each": of the jars.
            at -= 2
            owner = chunks[at - 1].phrase
        several = owner is not None and owner.several
        if several and at < holder:
            chunks[holder] = replace(chunks[holder], each=1)
        elif several and owner is not None:
            chunks[at - 1] = replace(chunks[at - 1], phrase=replace(owner, each=True))
        if several or formed:
            self._read.add(self._at)
            self._at += 1
        return several or formed
