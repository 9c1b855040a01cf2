"""Where a noun phrase ends: at a relation, a verb, a mark that joins no modifiers."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.assets.materials import find_material
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import EACH_OTHER, LINKS, LONGEST_LINK, SIDES
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_marked, is_modifier, looks_like_adjective
from pat3d.plan.grammar.words.postures import is_posture
from pat3d.plan.grammar.words.vocabulary import Nouns

JOINERS = frozenset({
    "and", "or", "plus", "while", "whereas", "but", "there", "there's", "without", "no", "not", "than", "as", "which",
    "meanwhile", "where", "who", "whose", "for", "from", "through", "via", "per", "if", "because", "so", "that",
    "'s", "against", "then",
})  # fmt: skip
_ALWAYS_BREAK = (
    frozenset(key[0] for key in LINKS if len(key) == 1 and not key[0].endswith(("ing", "ed", "s")))
    - {"nearby", "hold", "contain", "feature", "carry", "support", "show", "have", "display"}
) | frozenset({"besides", "has", "is", "are", "was", "were"})  # fmt: skip

_OF_SEVERAL = frozenset({"lie", "sit", "hang"})
"""Verbs of several things that are no nouns."""


_STANDS = frozenset(f"{word}s" for word in lexicon.NOUNS_LIKE_VERBS)


class Boundaries:
    """The ends of the noun phrases of one prompt."""

    def __init__(self, tokens: Sequence[Token], nouns: Nouns) -> None:
        self._tokens = tokens
        self._nouns = nouns

    def run(self, at: int) -> tuple[list[Token], int]:
        """Modifiers and head from token `at`, and the token after them."""
        run: list[Token] = []
        start = at
        while True:
            token = self._tokens[at]
            if token.mark or token.text in ("and", "or", "but"):
                if self._opens_joined_name(run, at):
                    run.append(token)
                    at += 1
                    continue
                onward = self._coordination(run, at)
                if onward is None:
                    break
                at = onward
                continue
            if self._breaks(run, at):
                break
            run.append(token)
            at += 1
        # Words between the last noun and the break belong to no phrase ("mug gently" on ...).
        return run, at if run else start

    def _breaks(self, run: list[Token], at: int) -> bool:
        word = self._tokens[at].text
        if self._opens_joined_name(run, at):
            return False
        words = [token.text for token in run]
        if word in JOINERS or word in lexicon.PRONOUNS or word in lexicon.POSSESSIVES or word in _ALWAYS_BREAK:
            return True
        if (
            word in ("one", "ones")
            and words
            and all(is_modifier(each) or each in lexicon.PLACES or each in lexicon.TELLING for each in words)
        ):
            return False
        if words and words[-1] in ("one", "ones"):
            return True
        if word in lexicon.DETERMINERS or (
            (word in lexicon.NUMBERS or word.isdecimal()) and word not in ("set", "single")
        ):
            return not (word in ("couple", "dozen", "trio") and self._tokens[at + 1].text == "of" and not run)
        multi = link_at(self._tokens, at)
        if multi > 1 and not self._extends(words, word):
            return True
        if not words:
            # "one contains three pens", where nothing is called a contains.
            before = self._tokens[at - 1].text if at else ""
            more = before == "more" and not word.endswith("ing")
            headless = more or before in (*lexicon.NUMBERS, "other", "another")
            placed = word in lexicon.VERBS | lexicon.PARTICIPLES and link_at(self._tokens, at + 1) > 0
            # "Inside that one lies a coin"
            placed = placed or (
                word in lexicon.VERBS and (self._begins(at + 1) or is_posture(self._tokens[at + 1].text))
            )
            # "The other holds apples"
            link = LINKS.get((word,))
            holds = link is not None and (link.manner == "hold" or (link.inverse and link.finite))
            return headless and (placed or holds or (link is not None and self._begins(at + 1)))
        if is_marked(word) and (self._ends_in_noun(words) or self._tokens[at + 1].mark or not self.goes_on(at + 1)):
            return True
        if word in _STANDS and not singulars(words[-1]) and self._extends(words, word):
            before = self._tokens[at - len(run) - 1].text
            if before in lexicon.NUMBERS or before in ("a", "an", "each", "every", "another"):
                # "a table on which a plant stands"; "two plant stands on a rug"
                return lexicon.NUMBERS.get(before, 1) == 1
        adverb = self._tokens[at + 1].text.endswith("ly")
        if word in lexicon.VERBS and link_at(self._tokens, at + 1 + adverb):
            return not (self._extends(words, word) and self._names_a_stand(words, at))
        if word in lexicon.VERBS and (word.endswith("s") or word in _OF_SEVERAL) and self._begins(at + 1):
            # "By the camera stands a book": no camera stands. "By the stand lie two books."
            return True
        if not self._ends_in_noun(words):
            return self._breaks_unknown(words, at)
        if word in lexicon.DIRECTIONS or (
            word in lexicon.STATES and self._tokens[at + 1].text in ("into", "from", "by")
        ):
            return True
        posture = word in lexicon.VERBS and not self._names_a_stand(words, at)
        verb = is_marked(word) or multi or posture or word in lexicon.PARTICIPLES or word in lexicon.COPULAS
        verb = verb or word in lexicon.ADVERBS or word in lexicon.MOOD_VERBS
        if not verb and not self._nouns.match([word]) and word not in lexicon.NOT_VERBS and len(word) > 4:
            follower = self._tokens[at + 1]
            runs_on = not follower.mark and follower.text not in ("and", "or", "of")
            runs_on = runs_on or follower.text in ("out", "up", "down", "off", "away")
            verb = word.endswith("ly") or (word.endswith(("ing", "ed")) and runs_on and not self.goes_on(at + 1))
        return bool(verb) and not self._extends(words, word)

    def _names_a_stand(self, words: list[str], at: int) -> bool:
        """Whether "stand" at token `at` is a noun ("a TV stand") and no verb ("a lamp and a TV stand on a desk")."""
        follower = self._tokens[at + 1].text
        if self._tokens[at].text not in lexicon.NOUNS_LIKE_VERBS or singulars(words[-1]):
            return False
        if follower in lexicon.DETERMINERS or follower in lexicon.NUMBERS:
            return False
        sentence = [token.text for token in self._tokens[:at]]
        sentence = sentence[len(sentence) - sentence[::-1].index(".") :] if "." in sentence else sentence
        # "a desk, on which a cup and a candle stand"
        told = link_at(self._tokens, at + 1) or ("which" in sentence and self._tokens[at + 1].mark)
        return "and" not in sentence or not told

    def _breaks_unknown(self, words: list[str], at: int) -> bool:
        """Whether a posture or "holding" at token `at` ends a run without a known noun ("a knight standing")."""
        word = self._tokens[at].text
        verb = word in lexicon.PARTICIPLES or (word,) in LINKS
        if verb and (self._begins(at + 1) or words[-1] in ("former", "latter")):
            return True
        if not verb or not word.endswith(("ing", "ed")) or is_modifier(words[-1]) or looks_like_adjective(words[-1]):
            return False
        # "a free standing lamp": the participle belongs to the noun after it.
        return not self._extends(words, word) and self._nouns.match([word, self._tokens[at + 1].text]) is None

    def _begins(self, at: int) -> bool:
        """Whether a phrase with a determiner or a number begins at token `at`."""
        word = self._tokens[at].text
        return word in lexicon.DETERMINERS or word in lexicon.NUMBERS or word.isdecimal()

    def goes_on(self, at: int) -> bool:
        """Whether token `at` may be the noun that a participle before it describes."""
        word = self._tokens[at].text
        function = word in JOINERS or word in lexicon.DETERMINERS or word in lexicon.NUMBERS or word in _ALWAYS_BREAK
        return not (function or link_at(self._tokens, at) or word in lexicon.ADVERBS or word.endswith("ly")
                    or word in lexicon.POSSESSIVES or word in lexicon.PRONOUNS)  # fmt: skip

    def _extends(self, words: list[str], word: str) -> bool:
        """Whether `word` makes a longer known noun of the run ("teddy" + "bears")."""
        return any(self._nouns.match([*words[-size:], word]) for size in (1, 2, 3) if size <= len(words))

    def _opens_joined_name(self, run: list[Token], at: int) -> bool:
        if self._tokens[at].text not in ("of", "and", "in", "on", "with") or not run or not self._nouns.joined:
            return False
        tokens = self._tokens
        for back in (1, 2):
            for ahead in (1, 2):
                if back <= len(run) and at + ahead < len(tokens):
                    words = [token.text for token in (*run[-back:], *tokens[at : at + ahead + 1])]
                    if not lexicon.DETERMINERS & set(words) and self._nouns.match(words):
                        return True
        return False

    def _ends_in_noun(self, words: list[str]) -> bool:
        head = words[-1]
        singular = (head, *singulars(head))
        general = lexicon.BACKGROUND | lexicon.ITEMS | lexicon.PIECES | lexicon.STACK_NOUNS | lexicon.GENERICS.keys()
        return bool(self._nouns.match(words[-1:]) or self._nouns.longest(words)) or any(
            word in general or word in lexicon.PARTS for word in singular
        )

    def _coordination(self, run: list[Token], at: int) -> int | None:
        """The token to go on from when the mark or "and" at `at` joins two modifiers of one head; None otherwise."""
        if self._described_on(run, at):
            return at + 1
        if not run or any(
            self._nouns.match([token.text for token in run[-size:]]) for size in (2, 3) if size <= len(run)
        ):
            # "A wine glass and glass cup": the first is named.
            return None
        if not is_modifier(run[-1].text) and not looks_like_adjective(run[-1].text):
            # "a hefty, red-painted box": what is no noun and stands before a comma and a modifier describes.
            # "Red walls, white chairs": no walls are chairs, whether they are made or not.
            several = len(run) > 1 and bool(singulars(run[-1].text))
            known = several or self._ends_in_noun([each.text for each in run])
            known = known or self._nouns.resembles_noun(run[-1].text)
            after = self._tokens[at + 1].text
            if known or self._tokens[at].text != "," or not (is_modifier(after) or looks_like_adjective(after)):
                return None
        colours = is_colour_word(run[-1].text)
        described = all(is_modifier(token.text) for token in run)
        alike = not described and self._nouns.resembles_noun(run[-1].text)
        if not colours and (self._nouns.match([run[-1].text]) or alike):
            return None
        first = self._skip_joint(at)
        look = first
        if colours:
            # Every member of the list is a colour (or a material, of one thing: "a red and wooden stool"), and the
            # last stands directly before more of the phrase.
            one = self._tokens[at - len(run) - 1].text in ("a", "an") and not self._nouns.match([run[-1].text])
            while is_colour_word(word := self._tokens[look].text) or (
                one and find_material(word) and is_modifier(word)
            ):
                look += 1
                if (onward := self._skip_joint(look)) > look:
                    if not is_colour_word(self._tokens[onward].text):
                        return None
                    look = onward
                elif self.goes_on(look):
                    return first
            return None
        words: list[str] = []
        while not self._tokens[look].mark and self.goes_on(look) and len(words) < 5:
            words.append(self._tokens[look].text)
            look += 1
        if self._tokens[at - len(run) - 1].text in ("a", "an") and any(map(self._plural, words)):
            # "A cake on a stand, small plates around it"
            return None
        return first if words and self._ends_in_noun(words) else None

    def _plural(self, word: str) -> bool:
        return bool(singulars(word)) and self._nouns.match([word]) is not None

    def _described_on(self, run: Sequence[Token], at: int) -> bool:
        """Whether the comma at `at` stands between modifiers of one head: "a huge, white, heart-shaped table"."""
        words = [token.text for token in run]
        if self._tokens[at].text != "," or not words or not all(map(self._describes, words)):
            return False
        if all(map(is_colour_word, words)) and is_colour_word(self._tokens[at + 1].text):
            return False
        look = at + 1
        segment: list[str] = []
        while len(segment) < 5 and (self._tokens[look].text == "," or self.goes_on(look) or self._qualifies(look)):
            word = self._tokens[look].text
            if self._qualifies(look):
                look += 1
                continue
            if word == "," and len(segment) > 1:
                break
            if word == ",":
                if not segment or self._nouns.match(segment):
                    return False
                segment = []
            elif self._tokens[look].mark:
                break
            else:
                segment.append(word)
            look += 1
        named = any(self._ends_in_noun(segment[:size]) for size in range(2, len(segment) + 1))
        return named and not self._nouns.match(segment[:1])

    def _qualifies(self, at: int) -> bool:
        """Whether token `at` is an adverb of a describing word: "a white, delicately painted plate"."""
        word = self._tokens[at].text
        adverb = word.endswith("ly") and not is_modifier(word) and self._nouns.match([word]) is None
        return adverb and self._describes(self._tokens[at + 1].text)

    def _describes(self, word: str) -> bool:
        plain = is_modifier(word) or looks_like_adjective(word)
        return plain and self._nouns.match([word]) is None and not is_marked(word)

    def _skip_joint(self, at: int) -> int:
        if self._tokens[at].text == ",":
            at += 1
        if self._tokens[at].text in ("and", "or", "but", "yet"):
            at += 1
        return at


def link_at(tokens: Sequence[Token], at: int) -> int:
    """Number of tokens of the longest relation phrase that begins at token `at`; 0 where none does."""
    for size in range(LONGEST_LINK, 0, -1):
        key = tuple(token.text for token in tokens[at : at + size])
        if key in LINKS or key in SIDES or key in EACH_OTHER:
            return size
    return 0
