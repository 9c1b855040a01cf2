"""What the planner asks of the catalogue: which words name something that can be made."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from pat3d.plan.grammar.words.lexing import singulars
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.stand_ins import STAND_INS
from pat3d.scene.naming import APART

_ALIASES = {
    "container": "storage box", "receptacle": "storage box", "rag": "towel", "computer": "laptop",
    "desktop computer": "monitor", "desk top computer": "monitor", "pc": "laptop", "computer screen": "monitor",
    "brush": "paintbrush", "shoebox": "storage box", "shoe box": "storage box", "soda pop": "soda can",
    "soap bottle": "soap dispenser", "bottle of soap": "soap dispenser",
    "green pepper": "bell pepper", "red pepper": "bell pepper", "yellow pepper": "bell pepper",
    "orange pepper": "bell pepper",
    **{f"{brand}{can}": "soda can" for can in ("", " can") for brand in
       ("red bull", "redbull", "pepsi", "sprite", "fanta", "7up", "coca cola", "coca-cola", "coke cola")},
    "coke": "soda can", "sushi mat": "placemat", "bamboo mat": "placemat", "pea": "marble",
    "sweets": "candies", "sweet pepper": "bell pepper", "candelabra": "candlestick", "platter": "plate",
}  # fmt: skip
"""Words for what the catalogue knows by another name."""
_NO_SLIPS = frozenset({"stair", "stock", "sconce", "breaker", "blinder", "tuner", "caster", "chord", "bowel", "maker",
    "saver", "pluck", "shove", "planet", "sprig", "thicket", "cartoon", "taster", "hover"})  # fmt: skip
"""Words of their own, each a letter away from a noun: stairs are no stars."""
_LONG_ENOUGH = 5
"""Letters of a word that is recognised though misspelled."""
_HEADS = frozenset({"bowl", "box", "tray", "cup", "jar", "pot", "basket", "rack", "table", "shelf", "board", "plate",
    "lamp", "bin", "bag", "bottle", "mat", "spoon", "knife", "brush"})  # fmt: skip
"""What a compound without a gap is a kind of."""


def _slipped(word: str, name: str) -> bool:
    """Whether a letter of `name` is left out, doubled or exchanged with the next in `word`."""
    if word[0] != name[0] or word == name or f"{word[:-1]}rs" == name:
        # "Staples" are no staplers.
        return False
    shorter, longer = sorted((word, name), key=len)
    if longer.startswith(shorter):
        # "Start" is no star; "glas" is a glass.
        return (name == f"{word}{word[-1]}" and len(word) > 3) or (name == f"{word}e" and len(word) > 4)
    if len(longer) - len(shorter) == 1:
        return any(longer[:at] + longer[at + 1 :] == shorter for at in range(len(longer)))
    return len(word) == len(name) and any(
        word[:at] + word[at + 1] + word[at] + word[at + 2 :] == name for at in range(len(word) - 1)
    )


class Known(Protocol):
    """One kind of object; the catalogue's Entry is one."""

    @property
    def noun(self) -> str:
        """Catalogue noun."""
        ...

    @property
    def plurals(self) -> tuple[str, ...]:
        """Irregular plurals."""
        ...


class Vocabulary(Protocol):
    """The nouns that can be made; the catalogue's registry is one."""

    def find(self, name: str, /) -> Known | None:
        """What is called `name`, or None."""
        ...

    def names(self) -> tuple[str, ...]:
        """All nouns and synonyms."""
        ...

    def nearest(self, name: str, count: int = 3) -> tuple[str, ...]:
        """The known names most like `name`."""
        ...


@dataclass(frozen=True, kw_only=True)
class Match:
    """A known noun found in the prompt."""

    noun: str
    """Catalogue noun."""
    said: str
    """The prompt's own name for it, in the singular."""
    plural: bool


class Nouns:
    """Looks words up in a vocabulary, plural or singular."""

    def __init__(self, vocabulary: Vocabulary, *, standing_in: bool = True) -> None:
        """With `standing_in`, what is like a thing that has no noun stands in for it."""
        self._vocabulary = vocabulary
        self._stand_ins = STAND_INS if standing_in else {}
        self._aliases = {**self._stand_ins, **_ALIASES}
        self._classes: dict[Any, frozenset[str]] = {}
        # What a library calls "ycb/mug" is judged as a mug is.
        self._kin: dict[str, str] = dict(getattr(vocabulary, "kin", {}))
        self._adjectives: dict[str, list[str]] = dict(getattr(vocabulary, "adjectives", {}))
        self.joined = frozenset(
            tuple(name.split()) for name in vocabulary.names() if {"of", "and", "in", "on", "with"} & set(name.split())
        )
        """Names with a function word inside ("slice of cake"), as tuples of words."""

    def takes(self, noun: str, adjective: str) -> bool:
        """Whether an adjective makes a difference to `noun`, or says what it is anyway; all do where nobody knows."""
        return not self._adjectives or adjective in self._adjectives.get(noun, ())

    def match(self, words: Sequence[str]) -> Match | None:
        """The known noun that `words` are exactly, or None."""
        if not words:
            return None
        spelled = " ".join(words)
        known = self._vocabulary.find(spelled)
        for name in (spelled, *self._singular(words)):
            single = self._vocabulary.find(name)
            if single is not None and name != spelled and (known is None or known.noun == single.noun):
                # A plural that is itself a synonym ("shelves" for a shelving unit) names one object.
                whole = known is not None and spelled not in known.plurals
                # "A pile of papers" is one pile.
                one = "of" in words and name.split()[0] == words[0]
                return Match(noun=single.noun, said=spelled if whole else name, plural=not (whole or one))
            # Of the guesses the likelier first: capes are no caps.
            if known is None and name in self._aliases and (found := self.match(self._aliases[name].split())):
                several = found.plural and name == spelled
                return Match(noun=found.noun, said=found.said if several else name, plural=several or name != spelled)
        if known is None and "-" in spelled:
            return self.match(spelled.replace("-", " ").split())
        return None if known is None else Match(noun=known.noun, said=spelled, plural=spelled in known.plurals)

    def _singular(self, words: Sequence[str]) -> Iterable[str]:
        for guess in singulars(words[-1]):
            yield " ".join([*words[:-1], guess])
        if "of" in words:
            for guess in singulars(words[0]):
                # "Piles of paper", "piles of papers"
                for last in (words[-1], *singulars(words[-1])):
                    yield " ".join([guess, *words[1:-1], last])

    def longest(self, words: Sequence[str]) -> tuple[Match, frozenset[int]] | None:
        """The known noun at the end of `words` and the positions of its words.

        The longest ending wins; a modifier and the head with other words between them ("potted green plants") beat the
        head alone.
        """
        last = len(words) - 1
        for size in range(min(4, len(words)), 1, -1):
            if found := self.match(words[-size:]):
                # "small dog" is a dog that is small even where the catalogue lists it as a name; a library's "small
                # dog" is as small as it is.
                while (
                    size > 1
                    and self.own(found.noun)
                    and is_modifier(words[-size])
                    and words[-size] not in found.noun.split()
                    and found.said not in STAND_INS
                    and (plain := self.match(words[1 - size :]))
                ):
                    if plain.noun != found.noun:
                        break
                    found, size = plain, size - 1
                return found, frozenset(range(len(words) - size, len(words)))
        plain = self.match(words[-1:])
        for position in range(last - 1):
            if found := self.match([words[position], words[-1]]):
                described = self.own(found.noun) and is_modifier(words[position])
                if not (described and plain is not None and plain.noun == found.noun):
                    # "A small white dog" is a dog that is small as well.
                    return found, frozenset({position, last})
        return None if plain is None else (plain, frozenset({last}))

    def learn(self, noun: str, like: str) -> None:
        """`noun`, which a server is to make, is judged as the catalogue's `like` is (empty for none)."""
        if like:
            self._kin[noun] = like

    def of_class(self, noun: str, table: tuple[str, ...]) -> bool:
        """Whether catalogue noun `noun` is what one of the names in `table` means."""
        if table not in self._classes:
            found = (self._vocabulary.find(name) for name in table)
            self._classes[table] = frozenset(known.noun for known in found if known) | frozenset(table)
        return noun in self._classes[table] or self._kin.get(noun) in self._classes[table]

    def resolve(self, name: str) -> str | None:
        """Catalogue noun that `name` means, or None."""
        known = self._vocabulary.find(name) or self._vocabulary.find(self._stand_ins.get(name, ""))
        return None if known is None else known.noun

    def own(self, noun: str) -> bool:
        """Whether `noun` is the catalogue's, and so may give way to another of its nouns."""
        return APART not in noun

    def nearest(self, word: str) -> tuple[str, ...]:
        """Known names most like `word`."""
        return tuple(self._vocabulary.nearest(word))

    def kinds(self, head: str) -> tuple[str, ...]:
        """Some known names of different things that end in `head`: "cake stand" for "stand"."""
        names = (name for name in self._vocabulary.names() if name.endswith(f" {head}") and "/" not in name)
        named = {self.resolve(name): name for name in sorted(names, key=lambda name: self.resolve(name) == name)}
        return tuple(sorted(named.values(), key=lambda name: (self.resolve(name) != name, name))[:5])

    def respelled(self, word: str) -> tuple[str, ...]:
        """The known name that `word` is with one letter too many, too few or two exchanged; or the two run together."""
        doubled = f"{word}{word[-1:]}"
        if len(word) < _LONG_ENOUGH and self.match([doubled]) and not self.match([word]):
            return (doubled,)
        if word.endswith("ve") and (single := next((one for one in singulars(f"{word}s") if self.match([one])), None)):
            # "A knive"
            return (single,)
        if len(word) < _LONG_ENOUGH or not word.isalpha() or {word, *singulars(word)} & _NO_SLIPS:
            return ()
        long = len(word) > _LONG_ENOUGH
        near = difflib.get_close_matches(word, self._stand_ins, n=3, cutoff=0.8) if long else ()
        for name in (*self.nearest(word), *near):
            if any(_slipped(word, spelled) for spelled in (name, f"{name}s")):
                return (name if word[-1] != "s" or name[-1] == "s" else f"{name}s",)
        for at in range(3, len(word) - 2):
            if is_modifier(word[:at]) and self.match([word[at:]]):
                return word[:at], word[at:]
        # "A dishbowl" is a bowl, "a bagpipe" is no pipe.
        parts = ((word[:at], word[at:]) for at in range(3, len(word) - 2) if word[at:] in _HEADS)
        return next(((head,) for first, head in parts if self.match([first])), ())

    def resembles_noun(self, word: str) -> bool:
        """Whether `word` is probably a misspelled noun."""
        near = self.nearest(word)
        return bool(near) and difflib.SequenceMatcher(None, word, near[0]).ratio() >= 0.8
