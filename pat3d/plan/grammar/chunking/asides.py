"""What no scene has: purposes, pictures of things, states, absences, remarks on light and mood. Each is named."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.denied_lists import Denied, denied
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.chunking.relation_words import RelationWords
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.left_out import quoted
from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.measures import is_measure
from pat3d.plan.grammar.words.modifiers import Modifiers, telling
from pat3d.plan.grammar.words.parts import FIXED, HAD
from pat3d.plan.grammar.words.shapes import refuse, shape_said

ABOUT = frozenset({"exactly", "precisely", "approximately", "roughly", "nearly", "almost", "about", "only"})


_FACES = frozenset({"screen", "display", "lid", "cover", "cap"})
"""Parts that show something, and are things of their own elsewhere."""

_FRAMED = [("the", word) for word in ("picture", "image", "photo", "photograph", "frame", "shot")]
"""What has a middle and sides, and is none of the things: "in the centre of the picture"."""


class Asides(RelationWords):
    """Reads what is left out of the scene."""

    def _unsaid(self, word: str, follower: str) -> bool:
        """Name what no scene has and go on behind it: purposes, directions, the viewer."""
        number = self._word(2) in lexicon.NUMBERS or self._word(2).isdecimal()
        number = number or is_measure(self._word(2))
        if word == "at" and follower in ("least", "most") and (number or self._word(2) in ("a", "an")):
            return self._leave(2)
        if word in ABOUT and (follower in lexicon.NUMBERS or follower.isdecimal()):
            self._at += 1
            return True
        if word == "for" and self._made.chunks and (read := self._phrases.read(self._at + 1)) is not None:
            return self._leave(read[1] - self._at)
        after_noun = self._last is not None and self._last.kind == "noun"
        if word == "whose" or (word == "where" and follower in lexicon.DETERMINERS | lexicon.PRONOUNS):
            return self._leave(self._to_mark())
        if self._words(3) == ("of", "the", "same") and self._last is not None and after_noun:
            self._made.unread.append(" ".join((self._last.text, *self._words(4))))
            self._at += 4
            return True
        if word in ("all", "both") and follower in lexicon.STATES and self._tokens[self._at + 2].mark:
            return self._leave(2)
        if word in lexicon.STATES and (after_noun or self._opens) and self._ends_state():
            size = self._to_mark()
            off = self._word(1) in ("off", "up", "out", "open", "down")
            return self._leave(size if self._word(1) in ("into", "from", "by", "in") else 1 + off)
        if word in ("in", "into") and follower in lexicon.CUT_INTO and self._word(-1) in lexicon.STATES:
            # "A loaf that is cut into pieces"
            size = next(n for n in range(1, len(self._tokens)) if self._word(n) not in lexicon.CUT_INTO)
            if self._tokens[self._at + size].mark or self._word(size) == "and":
                return self._leave(size)
        if word in ("show", "shows", "showing", "with") and follower in ("sign", "signs", "traces"):
            # "The keys show signs of use"
            return self._leave(self._to_mark())
        size = link_at(self._tokens, self._at)
        if size and self._word(size - 1) == "of" and self._words(size + 2)[size:] in _FRAMED:
            # "In the centre of the picture": of none that is there.
            return self._leave(size + 2)
        telling = follower in ("means", "ensures", "makes") or follower in lexicon.MOOD_VERBS
        if word in ("which", "that") and telling and self._made.chunks:
            self._remark()
            return True
        if word in lexicon.DIRECTIONS:
            the = self._word(2) == "the"
            to = follower in ("to", "from") and self._word(2 + the) in lexicon.VIEWERS
            return self._leave(3 + the if to else 1)
        size = link_at(self._tokens, self._at)
        if (
            size
            and self._word(size) in lexicon.VIEWERS
            and (self._tokens[self._at + size + 1].mark or self._word(size + 1) in ("and", "or"))
        ):
            return self._leave(size + 1)
        return False

    def _other_place(self) -> bool:
        """Name the "or on the plate" of "in the bowl or on the plate", and go on behind it."""
        kinds = [chunk.kind for chunk in self._made.chunks if chunk.kind != "joint"][-1:]
        size = link_at(self._tokens, self._at + 1) if kinds == ["noun"] else 0
        if size and self._word(1 + size) in lexicon.PRONOUNS:
            return self._leave(2 + size)
        read = self._phrases.read(self._at + 1 + size) if size else None
        return read is not None and self._leave(read[1] - self._at)

    def _is_had(self, phrase: Phrase, after: int) -> bool:
        """Whether `phrase` is a part of what is said to have it: "a belt with a strap and a polished buckle"."""
        *before, last = [Chunk(kind="joint"), *self._made.chunks]
        listed = last.kind == "joint" and bool(before) and before[-1].phrase is not None
        if phrase.kind == "object" and phrase.head in FIXED:
            had = (last.kind == "have" and "of" not in last.words) or (listed and before[-1].named.kind == "part")
            owner = next((c.phrase for c in reversed(before) if c.phrase and c.phrase.kind != "part"), None)
            fixed = owner is not None and self._nouns.of_class(owner.noun, FIXED[phrase.head])
            apart = self._tokens[after + link_at(self._tokens, after)].text in lexicon.PRONOUNS
            return (
                had
                and fixed
                and last.words[0] in ("with", "has", "have", "and")
                and (not apart or self._on_a_part(after) > 0)
            )
        behind = [chunk for chunk in self._made.chunks if chunk.kind not in ("noun", "joint")][-1:]
        # "A bed with two pillows and white sheets" has both; "a jar of feathers" holds them.
        had = bool(behind) and behind[0].kind == "have" and "of" not in behind[0].words
        return phrase.kind == "unknown" and had and bool({phrase.head, *singulars(phrase.head)} & HAD)

    def _to_mark(self) -> int:
        """Tokens up to the next mark."""
        return next(size for size in range(1, len(self._tokens)) if self._tokens[self._at + size].mark)

    def _ends_state(self) -> bool:
        """Whether what became of an object ends here or goes on: "cut into slices,", "hidden from view."."""
        follower = self._tokens[self._at + 1]
        if follower.text in ("off", "up", "out", "open", "down"):
            return True
        bare = follower.text in ("into", "from", "by", "in") and self._word(2) not in lexicon.DETERMINERS
        return follower.mark or follower.text == "and" or (bare and any(
            self._tokens[self._at + size].mark for size in (3, 4)
        ))  # fmt: skip

    def _superlative(self) -> Modifiers | None:
        """What "the largest" tells where it ends a clause; None where the next words are none."""
        ends = self._word(0) == "the" and self._tokens[self._at + 2].mark
        told = telling([self._tokens[self._at + 1]]) if ends else None
        return told if told is not None and told.size_word else None

    def _depicted(self, of: int) -> None:
        """Name "a picture of a cat on it", which is no object."""
        shown = self._phrases.read(of + 1)
        end = shown[1] if shown is not None else of + 1
        end += self._on_a_part(end)
        self._made.chunks.pop()
        self._leave(end - self._at)

    def _on_a_part(self, at: int) -> int:
        """Tokens from token `at` on that say where on a thing something is: "on it", "on the screen", "on its lid"."""
        size = link_at(self._tokens, at)
        if not size or self._tokens[at].text not in ("on", "at", "in", "across", "around"):
            return 0
        if self._tokens[at + size].text in lexicon.PRONOUNS:
            return size + 1
        read = self._phrases.read(at + size)
        part = (
            read is not None
            and read[0].definite
            and (read[0].kind == "part" or read[0].head in lexicon.DETACHED | _FACES)
        )
        return read[1] - at if read is not None and part and not read[0].part else 0

    def _remark(self) -> None:
        """Set aside the rest of the sentence, which tells of light or mood, up to what it names besides."""
        size = 0
        while self._at + size < self._end and not (size and self._names_more(self._at + size)):
            token, after = self._tokens[self._at + size], self._tokens[self._at + size + 1]
            if shape_said(token.text) and self._word(size - 1) in ("a", "an") and after.mark:
                raise refuse(token.text, token.number)
            size += 1
        self._aside(size)

    def _names_more(self, at: int) -> bool:
        """Whether a thing is named behind the ", and" at token `at`: "a lamp giving a warm light, and two chairs"."""
        words = [token.text for token in self._tokens[at : at + 3]]
        if words[:2] != [",", "and"] or not (words[2] in ("a", "an") or words[2] in lexicon.NUMBERS):
            return False
        read = self._phrases.read(at + 2)
        return read is not None and read[0].kind in ("object", "unknown") and not read[0].definite

    def _absence(self) -> None:
        """Read "without a lid", "no people": set aside with the phrase."""
        named = self._word(0) != "nothing" and self._word(1) not in lexicon.VERBS
        found = denied(self._tokens, self._at, self._phrases.read) if named else Denied(end=self._at + 1)
        end = found.end
        told = self._last is not None and self._last.kind == "there" and self._more_follows(end)
        # "A mug without a handle on a plate", "which has no handle on a plate": the mug is on the plate.
        own = self._word(0) == "without" or (self._last is not None and self._last.kind == "have")
        pronoun = False
        while not told and not pronoun and (size := link_at(self._tokens, end)):
            more = self._phrases.read(end + size)
            pronoun = self._tokens[end + size].text in lexicon.PRONOUNS
            if pronoun and self._word(0) == "without" and self._tokens[end].text not in ("on", "in", "inside", "with"):
                # "A glass without juice next to it": the glass is.
                break
            if (more is None or own) and not pronoun:
                break
            end = more[1] if more is not None else end + size + 1
        denying = (self._nouns.match([token.text]) for token in self._tokens[self._at + 1 : end])
        none = {one.noun for one in denying if one is not None}
        for n, chunk in enumerate(self._made.chunks if none else ()):
            # "A bowl of fruit without bananas": of what stands for fruit no banana does.
            kinds = chunk.phrase.cycle if chunk.phrase is not None else ()
            if left := tuple(kind for kind in kinds if self._nouns.resolve(kind) not in none):
                self._made.chunks[n] = replace(chunk, phrase=replace(chunk.named, cycle=left))
        if self._last is not None and self._last.kind in ("have", "there"):
            self._made.chunks.pop()
            if self._last is not None and self._last.kind == "which":
                self._made.chunks.pop()
        elif self._last is not None and self._word(0) == "without":
            self._tell_apart()
        if found.doubtful is not None:
            told = "not there, like" if found.end == found.doubtful[1] else "there, unlike"
            first = quoted(self._text, self._tokens[self._at + 1 : found.doubtful[0] - 1])
            rest = quoted(self._text, self._tokens[slice(*found.doubtful)])
            self._made.doubts.append(f'"{rest}" is read as {told} "{first}".')
        self._aside(end - self._at)

    def _tell_apart(self) -> None:
        """Let "the cup without a spoon", "one without" be another than the cup named before."""
        last = self._made.chunks[-1]
        if last.phrase is None:
            return
        named = [chunk.phrase for chunk in self._made.chunks[:-1] if chunk.phrase is not None]
        again = any(last.phrase.noun and phrase.noun == last.phrase.noun for phrase in named)
        if last.phrase.kind == "object" and again:
            self._made.chunks[-1] = replace(last, phrase=replace(last.phrase, other=True, definite=False))
        elif last.words == ("one",) and named:
            self._made.chunks[-1] = replace(last, phrase=replace(last.phrase, kind="pronoun", head="another"))
        elif last.phrase.words.lower() in ("the one", "the ones"):
            self._made.chunks[-1] = replace(last, phrase=replace(last.phrase, head="without"))

    def _more_follows(self, at: int) -> bool:
        """Whether something is named after the next comma or "but": "there is no lamp on the desk, only a book"."""
        while not self._tokens[at].mark or self._tokens[at].text == ",":
            if self._tokens[at].text in (",", "but"):
                return True
            at += 1
        return False
