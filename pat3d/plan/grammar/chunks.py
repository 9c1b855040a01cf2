"""A prompt as a row of noun phrases and the relation words between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.arrangements import PLACES, RINGS, refuse, shape_said
from pat3d.plan.grammar.boundaries import Boundaries, link_at
from pat3d.plan.grammar.lexing import Token, normalise, singulars, tokenise
from pat3d.plan.grammar.links import EACH_OTHER, LINKS, LONGEST_LINK, SIDES, Link
from pat3d.plan.grammar.measures import Measure, is_measure
from pat3d.plan.grammar.modifiers import NO_MODIFIERS, Modifiers, is_marked, is_modifier, read_modifiers
from pat3d.plan.grammar.phrases import Phrase, PhraseReader
from pat3d.plan.grammar.vocabulary import Nouns
from pat3d.plan.grammar.wording import plainer

ChunkKind = Literal[
    "phrase", "link", "verb", "there", "comma", "and", "dash", "stop", "clause", "side", "arrange", "each", "quality",
    "aside",
]  # fmt: skip

_AWAY = frozenset({"apart", "away", "from", "off"})
"""Words after a length that make it a distance."""
_FORMED = frozenset({"arranged", "laid", "organized", "organised", "stacked", "built", "assembled"})
"""Words before "in a cross" that make it a shape and no place."""
_EMPTY = frozenset(
    {"for", "as", "so", "if", "because", "where", "who", "which", "that", "'s", "via", "from", "per", "than"}
)
"""Words that mean nothing by themselves."""


@dataclass(frozen=True, kw_only=True)
class Chunk:
    """One piece of the prompt."""

    kind: ChunkKind
    text: str = ""
    phrase: Phrase | None = None
    link: Link | None = None
    modifiers: Modifiers = NO_MODIFIERS
    """For kind "quality": what "is red" says."""
    size: int = 0
    """For kind "arrange": how many stacks or rows, or how many phrases are one tower."""
    each: int = 0
    """For kind "arrange": objects in each stack or row; 0 where that is not said."""


def chunk(prompt: str, nouns: Nouns, unread: list[str]) -> list[Chunk]:
    """The chunks of `prompt`, ending in a stop; words that are in none and mean something are added to `unread`."""
    return _Chunker(normalise(prompt), nouns, unread).run()


class _Chunker:
    def __init__(self, text: str, nouns: Nouns, unread: list[str]) -> None:
        self._unread = unread
        self._text = text
        self._tokens = self._repaired(tokenise(text), nouns)
        self._phrases = PhraseReader(text, self._tokens, nouns)
        self._nouns = nouns
        self._bounds = Boundaries(self._tokens, nouns)
        self._chunks: list[Chunk] = []
        self._at = 0
        self._ahead = NO_MODIFIERS
        """Measures and postures that wait for the phrase they are said of."""

    @staticmethod
    def _repaired(tokens: list[Token], nouns: Nouns) -> list[Token]:
        """The tokens without misleading ones.

        A bare "beside table" is a bedside table: with a relation there would be a determiner. The owner in "a child's
        desk" is no object.
        """
        plain = ("there", "here", "that", *lexicon.PRONOUNS)
        tokens = [
            token
            for owner, token in zip([tokens[0], *tokens], tokens, strict=False)
            if token.text != "'s" or owner.text in plain or nouns.match([owner.text])
        ]
        tokens = plainer(tokens, nouns)
        if nouns.match(["bedside", "table"]) is None:
            return tokens
        return [
            Token(text="bedside", start=token.start, end=token.end, number=token.number)
            if token.text == "beside"
            and follower.text in ("table", "tables", "lamp", "lamps")
            and before in (",", "and", "a")
            else token
            for before, token, follower in zip(
                [".", *(t.text for t in tokens)], tokens, [*tokens[1:], tokens[-1]], strict=False
            )
        ]

    def run(self) -> list[Chunk]:
        while self._at < len(self._tokens):
            before = self._at
            self._step()
            if self._at == before:
                self._at += 1
        return self._chunks

    def _add(self, kind: ChunkKind, size: int = 1, **fields: object) -> None:
        tokens = self._tokens[self._at : self._at + size]
        text = self._text[tokens[0].start : tokens[-1].end] if tokens else ""
        self._chunks.append(Chunk(kind=kind, text=text, **fields))  # type: ignore[arg-type]
        self._at += size

    def _words(self, count: int) -> tuple[str, ...]:
        return tuple(token.text for token in self._tokens[self._at : self._at + count])

    @property
    def _opens_clause(self) -> bool:
        return not self._chunks or self._chunks[-1].kind in ("stop", "clause", "comma", "and", "dash")

    @property
    def _opens_sentence(self) -> bool:
        return not self._chunks or self._chunks[-1].kind in ("stop", "clause")

    def _finite_at(self, at: int) -> bool:
        keys = (tuple(token.text for token in self._tokens[at : at + size]) for size in range(1, LONGEST_LINK + 1))
        return any(key in LINKS and LINKS[key].finite for key in keys)

    def _step(self) -> None:
        token = self._tokens[self._at]
        word, follower = token.text, self._words(2)[-1]
        if word == ":":
            return self._add("link", link=LINKS[("with",)])
        if token.mark:
            return self._add({",": "comma", ".": "stop", "-": "dash"}[word])  # type: ignore[arg-type]
        if is_marked(word):
            return self._mark()
        if word in lexicon.MOOD_VERBS and self._chunks and self._chunks[-1].kind != "stop":
            return self._remark()
        if word in ("there", "there's", "here") or (word == "'s" and self._previous_word() in ("there", "here")):
            skip = 1
            while (verb := self._tokens[self._at + skip].text) in lexicon.COPULAS | lexicon.VERBS | {
                "also",
                "stand",
                "sit",
            }:
                skip += 1
                if verb == ".":
                    break
            return self._add("there", skip)
        if word in ("without", "no"):
            return self._absence()
        if word in ("while", "whereas", "meanwhile", "but"):
            return self._add("clause")
        for key in (
            ("along", "with"),
            ("together", "with"),
            ("as", "well", "as"),
            ("accompanied", "by"),
            ("next", "comes"),
        ):
            if self._words(len(key)) == key:
                return self._add("and", len(key))
        if word in ("and", "plus", "or"):
            if word == "or":
                self._unread.append("or")
            return self._add("and")
        if self._relation():
            return None
        of_each = follower == "of" and bool(self._chunks) and self._chunks[-1].kind == "link"
        alone = follower in (*lexicon.COPULAS, "of") or link_at(self._tokens, self._at + 1) > 0
        if word == "each" and not of_each and (alone or self._tokens[self._at + 1].mark):
            return self._add("each")
        relative = word in ("which", "that", "who") and not self._opens_sentence
        if relative and (follower in lexicon.COPULAS | lexicon.VERBS or self._finite_at(self._at + 1)):
            return self._add("phrase", phrase=Phrase(kind="pronoun", head="which", words=word, number=token.number))
        owned = word == "'s" and not (self._previous_word() in lexicon.PRONOUNS or link_at(self._tokens, self._at + 1))
        if owned and follower not in lexicon.DETERMINERS:
            return self._owned_part()
        if word in lexicon.COPULAS:
            self._add("verb")
            return self._quality()
        if word in lexicon.VERBS and not (self._opens_clause and follower == "of"):
            return self._add("verb")
        if self._meaningless(word, follower):
            return self._drop()
        if word == "both" and (follower in ("a", "an") or self._tokens[self._at + 1].mark):
            return self._add("phrase", phrase=Phrase(kind="pronoun", head="them", words=word, number=token.number))
        read = self._phrases.read(self._at)
        if read is None:
            if word in lexicon.PRONOUNS:
                return self._add("phrase", phrase=Phrase(kind="pronoun", head=word, words=word, number=token.number))
            return self._drop()
        phrase, after = read
        if phrase.kind in ("object", "unknown"):
            phrase, self._ahead = replace(phrase, modifiers=phrase.modifiers.marked_as(self._ahead)), NO_MODIFIERS
        return self._add("phrase", after - self._at, phrase=phrase)

    def _mark(self) -> None:
        """Read a measure or a posture that stands outside a noun phrase: "a vase 20 cm tall", "is upside down"."""
        word, after = self._tokens[self._at].text, self._at + 1
        said = read_modifiers([word])
        away = self._tokens[after].text in _AWAY or link_at(self._tokens, after) > 0
        if away and is_measure(word) and said.measures[0].axis is None:
            # A distance is no size.
            said = Modifiers(measures=(Measure(said=said.measures[0].said, distance=True),))
        elif self._chunks and self._chunks[-1].kind == "verb":
            return self._add("quality", modifiers=said)
        self._at += 2 if self._tokens[after].text == "apart" else 1
        for index in range(len(self._chunks) - 1, -1, -1):
            piece = self._chunks[index]
            if piece.kind in ("stop", "clause"):
                break
            nearest = index == len(self._chunks) - 1
            told = nearest and piece.phrase is not None and piece.phrase.kind == "pieces"
            if piece.phrase is not None and (piece.phrase.kind in ("object", "unknown") or told):
                whole = replace(piece.phrase, modifiers=piece.phrase.modifiers.marked_as(said))
                self._chunks[index] = replace(piece, phrase=whole)
                return None
        self._ahead = self._ahead.marked_as(said)
        return None

    def _drop(self) -> None:
        """Leave out the next word."""
        word = self._tokens[self._at].text
        empty = lexicon.PARTICIPLES | lexicon.COMMANDS | lexicon.ADVERBS | lexicon.DETERMINERS | _EMPTY
        if word not in empty and not word.endswith("ly"):
            self._unread.append(word)
        self._at += 1

    def _previous_word(self) -> str:
        return self._tokens[self._at - 1].text if self._at else ""

    def _meaningless(self, word: str, follower: str) -> bool:
        """Whether the word may be dropped: a posture before its preposition, an adverb, a command."""
        if follower == "of" or self._nouns.match([word]) or self._nouns.match([word, follower]):
            return False
        if self._opens_clause and word in lexicon.COMMANDS:
            return True
        after_phrase = bool(self._chunks) and self._chunks[-1].kind not in ("stop", "and", "link")
        moving = self._at + 1 < len(self._tokens) and bool(
            link_at(self._tokens, self._at + 1)
            or self._tokens[self._at + 1].mark
            or follower in lexicon.ADVERBS
            or follower.endswith("ly")
        )
        if word in lexicon.PARTICIPLES or (word in lexicon.COMMANDS and after_phrase and moving):
            return moving or after_phrase
        if word in lexicon.ADVERBS or (word.endswith("ly") and moving):
            return True
        participle = word.endswith(("ing", "ed")) and word not in lexicon.NOT_VERBS and not is_modifier(word)
        return after_phrase and participle and moving

    def _relation(self) -> bool:
        """Read the longest relation, side or arrangement that begins here, if one does."""
        if self._shape() or self._several():
            return True
        for size in range(LONGEST_LINK, 0, -1):
            key = self._words(size)
            if key in EACH_OTHER:
                last = self._chunks[-1] if self._chunks else None
                fronted = EACH_OTHER[key] in ("order", "reverse")
                after = last is not None and last.kind in ("phrase", "comma", "link", "verb", "arrange")
                if fronted or (after and not self._stacked_noun(size)):
                    self._add("arrange", size)
                    self._chunks[-1] = Chunk(kind="arrange", text=EACH_OTHER[key])
                    return True
            if key in LINKS:
                link = LINKS[key]
                if self._words(size + 2)[size:] in (("each", "other"), ("one", "another")):
                    # No plan relates the members of a group in another way than by what EACH_OTHER lists.
                    self._unread.append(" ".join(self._words(size + 2)))
                    self._add("arrange", size + 2)
                    self._chunks[-1] = Chunk(kind="arrange", text="beside")
                    return True
                if key == ("on",) and self._words(2) == ("on", "each") and self._tokens[self._at + 2].text == "other":
                    continue
                # Verbs that are also nouns ("bears", "houses") open no clause.
                if (
                    link.finite
                    and len(key) == 1
                    and (self._opens_clause and key[0] not in ("has", "have", "contains", "holds"))
                ):
                    continue
                self._add("link", size, link=link)
                return True
            follower = self._tokens[min(self._at + size, len(self._tokens) - 1)]
            whole = key[-1] == "side" or follower.mark or not self._bounds.goes_on(self._at + size)
            if key in SIDES and whole and follower.text != "of":
                side = SIDES[key]
                self._add("side", size)
                self._chunks[-1] = Chunk(kind="side", text=side)
                return True
        return False

    def _shape(self) -> bool:
        """Read "in a circle" before "around" or after "surrounded by", where it says nothing more.

        Raises:
            PromptError: objects stand in a shape that no plan expresses.
        """
        words = self._words(3)
        shape = shape_said(words[-1])
        if words[0] not in ("in", "into", "as") or words[1:2] not in (("a",), ("an",)) or shape is None:
            return False
        if shape in PLACES and self._previous_word() not in _FORMED:
            return False
        after = self._at + 3
        if self._bounds.goes_on(after) and not self._tokens[after].mark:
            return False
        related = [piece.link for piece in self._chunks if piece.link is not None][-1:]
        around = self._tokens[after].text in ("around", "surrounding") or any(
            link.manner == "surround" for link in related
        )
        if words[-1] not in RINGS or not around:
            raise refuse(words[-1], self._tokens[after - 1].number)
        self._at = after
        return True

    def _several(self) -> bool:
        """Read "in two rows", "in three stacks of four"."""
        preposition, number, what = (*self._words(3), "", "")[:3]
        count = lexicon.NUMBERS.get(number, int(number[:3]) if number.isdecimal() else 0)
        kinds = {"rows": lexicon.ROWS, "stacks": lexicon.STACK_NOUNS}
        kind = next((kind for kind, nouns in kinds.items() if nouns & {what, *singulars(what)}), None)
        if preposition not in ("in", "into") or count < 1 or kind is None:
            return False
        tail = self._tokens[self._at + 3 : self._at + 5]
        of_each = (
            len(tail) == 2 and tail[0].text == "of" and (tail[1].text in lexicon.NUMBERS or tail[1].text.isdecimal())
        )
        self._add("arrange", 5 if of_each else 3)
        each = lexicon.NUMBERS.get(tail[1].text) or int(tail[1].text[:3]) if of_each else 0
        self._chunks[-1] = Chunk(kind="arrange", text=kind, size=count, each=each)
        return True

    def _stacked_noun(self, size: int) -> bool:
        """Whether "stacked" describes the noun after it ("and stacked cups")."""
        return size == 1 and self._chunks[-1].kind in ("comma", "link") and not (
            link_at(self._tokens, self._at + 1) or self._tokens[self._at + 1].mark
        )  # fmt: skip

    def _remark(self) -> None:
        size = 0
        while not (token := self._tokens[self._at + size]).mark or token.text != ".":
            size += 1
            after = self._tokens[self._at + size]
            if shape_said(token.text) and self._tokens[self._at + size - 2].text in ("a", "an") and after.mark:
                raise refuse(token.text, token.number)
        self._add("aside", size)

    def _absence(self) -> None:
        """Read "without a lid", "no people": set aside with the phrase."""
        start = self._at
        read = self._phrases.read(self._at + 1)
        self._add("aside", (read[1] if read else self._at + 1) - start)

    def _owned_part(self) -> None:
        """Read "the dog's head": the part places nothing, its owner has been read."""
        read = self._phrases.read(self._at + 1)
        self._at += 1
        if read is not None and read[0].kind in ("part", "unknown") and not read[0].determined:
            if read[0].said in ("side", "corner", "edge", "end"):
                self._unread.append(read[0].words)
            self._at = read[1]

    def _quality(self) -> None:
        """Read "(is) plain white": modifiers without a noun."""
        start = self._at
        while self._tokens[self._at].text in lexicon.ADVERBS:
            self._at += 1
        word = self._tokens[self._at].text
        if (
            word in lexicon.DETERMINERS
            or word in lexicon.NUMBERS
            or link_at(self._tokens, self._at)
            or word in lexicon.PARTICIPLES
        ):
            self._at = start
            return
        if word in lexicon.VERBS or self._tokens[self._at].mark:
            return
        words: list[str] = []
        size = 0
        while not (token := self._tokens[self._at + size]).mark and not link_at(self._tokens, self._at + size):
            if token.text in ("and", "or"):
                if not is_modifier(self._tokens[self._at + size + 1].text):
                    break
            elif token.text in ("while", "but", "whereas") or token.text in lexicon.DETERMINERS:
                break
            else:
                words.append(token.text)
            size += 1
        if {"as", "than", "like"} & set(words):
            self._unread.append(" ".join(words))
            self._at += size
        elif words and (is_modifier(words[-1]) or not self._nouns.longest(words)):
            self._add("quality", size, modifiers=read_modifiers(words))


def summary(chunks: Sequence[Chunk]) -> str:
    """The chunks on one line, for a look at how a prompt was cut."""
    return " | ".join(f"{piece.kind}:{piece.text}" for piece in chunks)
