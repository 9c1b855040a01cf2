"""Cuts a sentence into chunks. No word is dropped unsaid."""

from __future__ import annotations

import re
from dataclasses import replace

from pat3d.assets.materials import find_material
from pat3d.errors import PromptError
from pat3d.plan.grammar.chunking.asides import ABOUT
from pat3d.plan.grammar.chunking.chunks import MAX_CHUNKS, Chunk, Sentence
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.chunking.qualities import Qualities
from pat3d.plan.grammar.chunking.turned import turned
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import LINKS, LONGEST_LINK
from pat3d.plan.grammar.words.measures import Measure, is_measure
from pat3d.plan.grammar.words.modifiers import (
    NO_MODIFIERS,
    Modifiers,
    is_marked,
    is_modifier,
    read_modifiers,
)
from pat3d.plan.grammar.words.postures import token_text
from pat3d.plan.grammar.words.senses import SENSES, sense
from pat3d.plan.grammar.words.stand_ins import STAND_INS

_JOINED = (
    ("along", "with"), ("together", "with"), ("as", "well", "as"), ("accompanied", "by"), ("next", "comes"),
    ("coupled", "with"), ("in", "addition", "to"), ("and", "also"), ("and", "then"),
)  # fmt: skip
_AWAY = frozenset({"apart", "away", "from", "off"})
"""Words after a length that make it a distance."""
_ON_ITS = (token_text("on its"), token_text("on their"))
"""What begins the words for where a part is: "a label on its side"."""
_HOW_FAR = frozenset({"by", "forward", "forwards", "back", "backward", "backwards", "upward", "upwards", "up", "down"})
_MOVING = frozenset({"push", "pull", "slide", "drag", "shift", "lift", "raise", "lower", "nudge", "open", "close",
    "shut"})  # fmt: skip
"""Words before a length that make it a distance, and verbs of which it is one."""
_EMPTY = frozenset({
    "so", "who", "which", "that", "'s", "both", "of", "a", "an", "the", "some", "them", "to", "it", "its", "do", "does",
    "did", "about", "all", "at", "there", "here", "too", "well", "as", "is", "are",
})  # fmt: skip
"""Words that mean nothing by themselves."""
"""Words of which something is left where they are not part of a relation."""
_JOINTS = frozenset({"and", "plus", "while", "but"})
_STANDING = (*lexicon.FLOOR, *vessels.NOT_IN_VESSEL, "plant", "bin", "toolbox")


class Cutter(Qualities):
    """Cuts the tokens of one sentence, which end in a stop, into chunks."""

    def cut(self) -> Sentence:
        """The sentence in chunks."""
        while self._at < self._end:
            before, told = self._at, (len(self._made.unread), len(self._made.aside))
            self._step()
            self._at += self._at == before
            if told == (len(self._made.unread), len(self._made.aside)):
                passed = (self._tokens[at] for at in range(before, self._at) if at not in self._read)
                held = self._word(-2) in ("holding", "holds", "hold", "held")
                words = [
                    token.text for token in passed if self._means_something(token) or (held and token.text == "up")
                ]
                self._made.unread += [self._in_context(word) for word in words]
        if len(self._made.chunks) > MAX_CHUNKS:
            raise PromptError(
                f"a sentence of {len(self._made.chunks)} phrases and relations is too long; at most {MAX_CHUNKS} are "
                "read. Say it in several sentences."
            )
        return self._made

    def _in_context(self, word: str) -> str:
        """A verb that is left out with what it is said of, since it may have related that to something."""
        last = self._last
        verb = word.endswith(("ing", "ed")) or word in lexicon.HANGING
        return f'{word}" after "{last.text}' if verb and last is not None and last.kind == "noun" else word

    def _step(self) -> None:
        token = self._tokens[self._at]
        word, follower = token.text, self._word(1)
        if word in (",", ":", "-", "and", "or", "plus"):
            return self._joint()
        if token.mark:
            self._at += 1
            return None
        if self._unsaid(word, follower):
            return None
        if is_marked(word):
            return self._mark()
        if word in lexicon.MOOD_VERBS and self._made.chunks and not (word == "lit" and follower != "by"):
            return self._remark()
        if word in ("there", "there's", "here") and not (word == "here" and follower not in lexicon.COPULAS | {"'s"}):
            return self._there()
        if word in ("without", "no", "zero", "nothing") and self._nouns.match([word]) is None:
            return self._absence()
        if word in ("while", "whereas", "meanwhile", "but"):
            return self._add("clause")
        if word == "then" and self._last is not None and self._last.kind == "noun":
            # "the cube then the ball"
            return self._add("joint", text="and")
        for key in _JOINED:
            if self._words(len(key)) == key:
                return self._joined(key)
        if self._relation():
            return None
        of_each = follower == "of" and self._last is not None and self._last.kind == "rel"
        alone = (
            follower in (*lexicon.COPULAS, "of", "and", "or")
            or link_at(self._tokens, self._at + 1) > 0
            or self._tokens[self._at + 1].mark
            or is_marked(follower)
        )
        of_them = follower == "of" and self._word(2) in (*lexicon.PRONOUNS, "these", "those")
        if word in ("each", "both", "all") and of_them:
            # "Two baskets, both of which hold a pear": as "both hold a pear".
            told = word == "each" or self._finite_at(self._at + 3)
            head = word if told else "them"
            phrase = Phrase(kind="pieces" if told else "pronoun", head=head, words=head, number=token.number)
            return self._add("noun", 3, phrase=phrase)
        if word == "so" and self._opens and follower in lexicon.COPULAS | lexicon.VERBS | {"do", "does"}:
            return self._so()
        finite = self._finite_at(self._at + 1)
        last = self._last
        inverse = (follower,) in LINKS and LINKS[follower,].inverse and follower != "of"
        if (
            word == "each"
            and (finite or inverse)
            and last is not None
            and last.kind == "noun"
            and last.named.kind == "object"
        ):
            # "Two trays each hold a glass": each of them does.
            self._made.chunks[-1] = replace(last, phrase=replace(last.named, each=True))
            self._read.add(self._at)
            self._at += 1
            return None
        if word == "each" and self._of_owner():
            return None
        if (
            word in ("each", "both", "all")
            and not of_each
            and (finite or (alone and self._last is not None))
            and not (word != "each" and (follower == "of" or self._tokens[self._at + 1].mark))
        ):
            return self._add("noun", phrase=Phrase(kind="pieces", head=word, words=word, number=token.number))
        if word in ("too", "also") or self._words(2) == ("as", "well"):
            return self._too(1 if word != "as" else 2)
        relative = word in ("which", "that", "who") and self._made.chunks and self._last.kind != "rel"  # type: ignore[union-attr]
        if relative and (follower in lexicon.COPULAS | lexicon.VERBS or self._finite_at(self._at + 1)):
            return self._add("which")
        if word == "'s" and is_modifier(follower) and self._tokens[self._at + 2].mark:
            # "The mug's blue."
            self._add("verb")
            return self._quality()
        owned = word == "'s" and not link_at(self._tokens, self._at + 1)
        if owned and follower not in lexicon.DETERMINERS:
            return self._owned_part()
        if word in lexicon.COPULAS:
            self._add("verb")
            return self._quality()
        if word in lexicon.VERBS and not (self._opens and follower == "of") and not self._names(word, follower):
            if word in lexicon.HANGING:
                self._made.unread.append(self._in_context(word))
            return self._add("verb")
        if self._meaningless(word, follower):
            return self._drop()
        if word == "both" and follower in ("a", "an", "the") and self._correlative():
            self._at += 1
            return None
        if word == "both" and (follower in ("a", "an") or self._tokens[self._at + 1].mark):
            return self._pronoun("them")
        read = self._phrases.read(self._at)
        if read is None:
            return self._pronoun(word) if word in lexicon.PRONOUNS else self._drop()
        phrase, after = read
        if phrase.kind == "background" and phrase.head in lexicon.PICTURES and self._tokens[after].text == "of":
            if self._last is not None and self._last.kind == "have":
                return self._depicted(after)
            return self._aside(after + 1 - self._at)
        if phrase.kind == "object":
            phrase = self._sense(phrase)
        wide = self._nouns.of_class(phrase.noun, lexicon.FLOOR) or phrase.head in lexicon.DETACHED
        if phrase.possessive and word in ("its", "their") and wide and phrase.head not in ("lid", "lids"):
            # "a truck with a block in its bed", "a bottle with its cap"
            phrase = replace(phrase, kind="part", said=phrase.head, noun="", cycle=())
        last, cloth = self._last, find_material(phrase.head) is not None
        if phrase.kind == "pieces" and cloth and not phrase.determined and last is not None and last.text == "on":
            # "A cup on white linen": what it lies on is no thing of its own.
            phrase = replace(phrase, kind="background")
        if self._is_had(phrase, after):
            phrase = replace(phrase, kind="part", said=phrase.head, noun="", cycle=())
        if phrase.kind in ("object", "unknown"):
            phrase, self._ahead = replace(phrase, modifiers=phrase.modifiers.marked_as(self._ahead)), NO_MODIFIERS
        shown = phrase.kind == "part" and self._last is not None and self._last.kind == "have"
        self._add("noun", after - self._at, phrase=phrase)
        if shown and (size := self._on_a_part(self._at)):
            # "a box with a label on its lid"
            self._leave(size)
        while phrase.substance and self._word(0) in ("and", ",") and self._word(1) in lexicon.SUBSTANCES:
            # "a bowl of cereal and milk"
            self._made.unread.append(self._word(1))
            self._at += 2

    def _joined(self, key: tuple[str, ...]) -> None:
        """Read "along with two plates"; of "(is) in the sink along with two plates" these are in the sink too."""
        last = self._made.chunks[-2:]
        rel = last[0].link if [piece.kind for piece in last] == ["rel", "noun"] else None
        placed = rel is not None and rel.kind in ("on", "in") and rel.manner == "place"
        self._add("joint", len(key), text="and")
        read = self._phrases.read(self._at) if placed and key[-1] == "with" else None
        if read is not None and self._tokens[read[1]].mark:
            self._add("noun", read[1] - self._at, phrase=read[0])
            self._made.chunks.append(Chunk(kind="place", text="too"))

    def _correlative(self) -> bool:
        """Whether "both the soup and the sauce" begins here, and not "both the mugs"."""
        for ahead in range(2, 8):
            word = self._word(ahead)
            if word == "and":
                follower = self._word(ahead + 1)
                return follower in (*lexicon.DETERMINERS, *lexicon.NUMBERS) or self._nouns.match([follower]) is not None
            if self._tokens[self._at + ahead].mark or link_at(self._tokens, self._at + ahead):
                return False
        return False

    def _sense(self, phrase: Phrase) -> Phrase:
        """`phrase` as what its company tells it to be, where its word alone has several meanings."""
        bare = phrase.said == phrase.head or phrase.said in singulars(phrase.head)
        # "Two glasses": those on a nose are a pair.
        bare = bare and not (phrase.head == "glasses" and (phrase.count or 0) > 1 and "pair" not in phrase.words)
        meanings = SENSES.get(phrase.head) or SENSES.get(phrase.said)
        if not bare or meanings is None:
            return phrase
        senses = [(found.noun, about) for name, about in meanings if (found := self._nouns.match(name.split()))]
        # "A mouse next to a computer mouse": the other is called so to tell it from this one.
        others = set(re.findall(rf"(\w+)(?=\W{re.escape(phrase.head)}\b)", self._text.lower()))
        noun = sense(phrase.noun, set(self._company) - others, senses)
        said = phrase.head if noun == "sunglasses" else noun if noun not in (phrase.noun, "pillow") else phrase.said
        if said == noun:
            # "Drumsticks on a drum" are what stands in for drum sticks, in their size.
            said = next((name for name, _ in meanings if name in STAND_INS and self._nouns.resolve(name) == noun), said)
        return replace(
            phrase, noun=noun, said=said, count=1 if noun == "sunglasses" and phrase.count is None else phrase.count
        )

    def _pronoun(self, head: str) -> None:
        number = self._tokens[self._at].number
        self._add("noun", phrase=Phrase(kind="pronoun", head=head, words=self._word(0), number=number))

    def _joint(self) -> None:
        word = self._word(0)
        if word == "or" and self._other_place():
            return
        if word == "or":
            self._made.unread.append("or")
        text = {"-": ":", "or": "and", "plus": "and"}.get(word, word)
        last = self._last
        if last is not None and last.kind == "joint":
            self._made.chunks[-1] = replace(last, text="and" if "and" in (text, last.text) else last.text)
            if text == "and" and last.text == ",":
                self._made.chunks[-1] = replace(last, text=", and")
            self._at += 1
        elif last is None:
            self._at += 1
        else:
            self._add("joint", text=text)

    def _there(self) -> None:
        skip = 1
        while self._word(skip) in lexicon.COPULAS | lexicon.VERBS | {"also", "stand", "sit"}:
            skip += 1
        self._add("there", skip)

    def _finite_at(self, at: int) -> bool:
        keys = (tuple(token.text for token in self._tokens[at : at + size]) for size in range(1, LONGEST_LINK + 1))
        return any(key in LINKS and LINKS[key].finite for key in keys)

    def _mark(self) -> None:
        """Read a measure or a posture outside a noun phrase: "a vase 20 cm tall", "is upside down"."""
        word, after = self._word(0), self._at + 1
        said = read_modifiers([word])
        verb = {*self._text[: self._tokens[0].start].lower().split()[-1:]}
        far = self._word(-1) in _HOW_FAR or (self._word(-1) != "," and bool(verb & _MOVING))
        away = self._tokens[after].text in _AWAY or link_at(self._tokens, after) > 0 or far
        if away and is_measure(word) and said.measures[0].axis is None:
            # A distance is no size.
            said = Modifiers(measures=(Measure(said=said.measures[0].said, distance=True),))
        elif self._last is not None and self._last.kind == "verb":
            return self._add("quality", modifiers=said)
        last, had = self._last, [piece.link.manner for piece in self._made.chunks[-2:-1] if piece.link is not None]
        stands = last is not None and last.phrase is not None and self._nouns.of_class(last.phrase.noun, _STANDING)
        if word == token_text("on its side") and had == ["with"] and stands:
            # "A chair has a plant on its side"
            self._made.chunks.append(Chunk(kind="rel", text="beside", words=("beside",), link=LINKS["beside",]))
            return self._pronoun("it")
        self._at += 2 if self._tokens[after].text == "apart" else 1
        named = last.phrase if last is not None else None
        part = named is not None and named.kind == "part" and word.startswith(_ON_ITS)
        if part or (named is not None and named.head in ("it", "them") and not is_measure(word)):
            # "Place it upside down in the box" is not said of the box, nor "a handle on its side" of the mug.
            token = self._tokens[after - 1]
            self._made.unread.append(self._text[token.start : token.end])
            return None
        if (told := turned(self._made.chunks, said, self._nouns)) is not None:
            self._made.chunks = told
            return None
        self._ahead = self._ahead.marked_as(said)
        return None

    def _drop(self) -> None:
        """Leave out the next word, of which a note speaks where it means something."""
        self._at += 1

    @staticmethod
    def _means_something(token: Token) -> bool:
        """Whether a word that is in no chunk changes what the sentence says."""
        word = token.text
        empty = lexicon.PARTICIPLES | lexicon.COMMANDS | lexicon.ADVERBS | lexicon.DETERMINERS | _EMPTY
        if word in lexicon.HANGING:
            return True
        return not (token.mark or word in empty or is_marked(word) or word in lexicon.MODALS | _JOINTS | ABOUT)

    def _meaningless(self, word: str, follower: str) -> bool:
        """Whether the word may be dropped: a posture before its preposition, an adverb, a command."""
        if follower == "of" or self._nouns.match([word]) or self._names(word, follower):
            return False
        if self._opens and word in lexicon.COMMANDS:
            return word not in lexicon.DEMONSTRATIVES or follower != "one"
        after_phrase = self._last is not None and self._last.kind not in ("joint", "rel", "have")
        moving = bool(
            link_at(self._tokens, self._at + 1)
            or self._tokens[self._at + 1].mark
            or follower in lexicon.ADVERBS
            or follower in ("out", "off", "away")
            or follower.endswith("ly")
        )
        if word in lexicon.PARTICIPLES or (word in lexicon.COMMANDS and after_phrase and moving):
            return moving or after_phrase
        if word in lexicon.ADVERBS or (word.endswith("ly") and moving):
            return True
        participle = word.endswith(("ing", "ed")) and word not in lexicon.NOT_VERBS and not is_modifier(word)
        return after_phrase and participle and moving

    def _too(self, size: int) -> None:
        """Read "(a mug is on the tray) and a bowl (is) too": it stands as what was named before."""
        before = [piece.kind for piece in self._made.chunks if piece.kind != "verb"]
        joined = before[-1:] == ["noun"] and before[-2:-1] in (["joint"], ["clause"])
        alone = [piece.kind for piece in self._made.chunks] in (["noun"], ["noun", "joint"])
        if (joined or alone) and self._tokens[self._at + size].mark:
            self._made.chunks = [piece for piece in self._made.chunks if not (alone and piece.kind == "joint")]
            self._add("place", size, text="too")
        else:
            last = next(
                (n for n in range(len(self._made.chunks), 0, -1) if self._made.chunks[n - 1].kind != "joint"), 0
            )
            if last:
                self._made.chunks[last - 1] = replace(self._made.chunks[last - 1], also=True)
            self._at += size

    def _so(self) -> None:
        """Read "(a laptop is on a desk) and so is a mug"."""
        read = self._phrases.read(self._at + 2)
        self._at += 2
        if read is not None:
            self._add("noun", read[1] - self._at, phrase=read[0])
            self._made.chunks.append(Chunk(kind="place", text="too"))

    def _owned_part(self) -> None:
        """Read "the dog's head": the part places nothing, its owner has been read."""
        read = self._phrases.read(self._at + 1)
        self._at += 1
        part = read is not None and (read[0].kind in ("part", "unknown") or read[0].head in vessels.ON_RIMS)
        if read is not None and part and not read[0].determined:
            if read[0].said in ("side", "corner", "edge", "end"):
                self._made.unread.append(read[0].words or read[0].said)
            self._at = read[1]
