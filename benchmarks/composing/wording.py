"""Groups of things and the ways in which English says where they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from random import Random

from benchmarks.composing.meaning import Meaning, Thing
from benchmarks.composing.nouns import FITS, LAID, NOUNS, Noun, of_kind

NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight")
ORDINALS = ("first", "second", "third", "fourth", "fifth")
SIDES = {
    "left_of": ("to the left of", "left of", "on the left of"),
    "right_of": ("to the right of", "right of", "on the right of"),
    "in_front_of": ("in front of",),
    "behind": ("behind",),
    "next_to": ("next to", "beside", "near"),
}  # fmt: skip
ON = ("on", "on", "on", "on top of", "atop")
IN = ("in", "in", "in", "inside")


@dataclass(frozen=True, eq=False)
class Group:
    """Things that are alike and spoken of together."""

    things: tuple[Thing, ...]

    @property
    def one(self) -> Thing:
        """The first of them."""
        return self.things[0]

    @property
    def many(self) -> bool:
        """Whether they are several."""
        return len(self.things) > 1

    def head(self) -> str:
        """Noun with adjectives: "red mugs"."""
        thing = self.one
        words = (thing.size, thing.colour, thing.material, thing.noun.plural if self.many else thing.noun.word)
        return " ".join(word for word in words if word)

    def new(self, number: str = "") -> str:
        """As it is first spoken of: "two red mugs"."""
        return f"{number or NUMBERS[len(self.things)]} {self.head()}" if self.many else a(self.head())

    def the(self) -> str:
        """As it is spoken of again."""
        return f"the {self.head()}"

    def the_noun(self) -> str:
        """As it is spoken of again, by its noun alone."""
        return f"the {self.one.noun.plural if self.many else self.one.noun.word}"

    def verb(self, random: Random) -> str:
        """How they are: "is", "lies"."""
        verb = random.choice(("be", "be", self.one.noun.verb, self.one.noun.verb, "sit", "rest"))
        if verb == "be":
            return "are" if self.many else "is"
        return verb if self.many else f"{verb}s"

    def be(self) -> str:
        """The copula."""
        return "are" if self.many else "is"

    def has(self, verb: str) -> str:
        """A verb in its number: "holds"."""
        return ("have" if self.many else "has") if verb == "have" else verb if self.many else f"{verb}s"

    def it(self, *, subject: bool = False) -> str:
        """The pronoun."""
        return ("they" if subject else "them") if self.many else "it"

    def going(self, random: Random) -> str:
        """The participle: "lying"."""
        return random.choice(({"stand": "standing", "lie": "lying"}[self.one.noun.verb], "resting", "sitting"))


def a(words: str) -> str:
    """With the indefinite article."""
    return f"{'an' if words[0] in 'aeio' or words.startswith(('hour', 'umbrella')) else 'a'} {words}"


def listed(parts: Sequence[str], word: str = "and") -> str:
    """A list: "a, b and c"."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} {word} {parts[-1]}"


def sentence(words: str, stop: str = ".") -> str:
    """With a capital and a full stop."""
    return f"{words[0].upper()}{words[1:]}{stop}"


def within(holder: Group) -> str:
    """The preposition for what `holder` carries."""
    return "in" if holder.one.noun.word in FITS else "on"


@dataclass
class Draw:
    """What one sentence draws from: random numbers, and the nouns that it has already."""

    random: Random
    meaning: Meaning = field(default_factory=Meaning)
    used: set[str] = field(default_factory=set)

    def chance(self, share: float) -> bool:
        """True in this share of draws."""
        return self.random.random() < share

    def noun(self, nouns: Sequence[Noun]) -> Noun:
        """One of `nouns` that the sentence has not yet."""
        taken = {name for noun in NOUNS if noun.word in self.used for name in noun.catalogue}
        heads = {word.split()[-1] for word in self.used}
        free = [
            noun
            for noun in nouns
            if not noun.catalogue & taken and noun.word.split()[-1] not in heads and noun.word not in self.used
        ]
        noun = self.random.choice(free or list(nouns))
        self.used.add(noun.word)
        return noun

    def group(self, noun: Noun, count: int = 1, *, plain: float = 0.5, colour: str | None = None) -> Group:
        """A group of `count` that is added to the meaning; `plain` is the share of those without adjectives."""
        if colour is None and noun.colours and not self.chance(plain):
            colour = self.random.choice(noun.colours)
        material = self.random.choice(noun.materials) if noun.materials and self.chance(0.15) else None
        size = self.random.choice(("small", "large", "big", "little")) if self.chance(0.08) else None
        if material and noun.word in ("glass", "wine glass"):
            material = None
        things = tuple(Thing(noun, colour, material, size) for _ in range(count))
        self.meaning.things += things
        return Group(things)

    def small(self, count: int = 1, *kinds: str, plain: float = 0.5) -> Group:
        """A group of small things."""
        return self.group(self.noun(of_kind(*(kinds or ("small",)))), count, plain=plain)

    def two_colours(self, *kinds: str) -> tuple[Group, Group]:
        """Two groups of one noun in two colours."""
        noun = self.noun([noun for noun in of_kind(*(kinds or ("small",))) if len(noun.colours) > 4])
        counts = self.random.choice(((1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (1, 3), (2, 3)))
        first, second = (
            Group(tuple(Thing(noun, colour) for _ in range(count)))
            for colour, count in zip(self.random.sample(noun.colours, 2), counts, strict=True)
        )
        self.meaning.things += [*first.things, *second.things]
        return first, second

    def count(self) -> int:
        """How many: one more often than several."""
        return self.random.choice((1, 1, 1, 2, 2, 3, 4))

    def furniture(self) -> Group:
        """A thing to stand things on."""
        return self.group(self.noun(of_kind("furniture")), plain=0.7)

    def holder(self, count: int = 1) -> Group:
        """What things are put in."""
        return self.group(self.noun([noun for noun in NOUNS if noun.word in FITS]), count)

    def carrier(self, count: int = 1) -> Group:
        """What things are put on, itself on furniture."""
        return self.group(self.noun([noun for noun in NOUNS if noun.word in LAID]), count)

    def filling(self, holder: Group, count: int | None = None, plain: float = 0.5) -> Group:
        """Things that go in or on `holder`."""
        kinds = {**FITS, **LAID}[holder.one.noun.word]
        return self.small(self.count() if count is None else count, *kinds, plain=plain)

    def put(self, child: Group, parent: Group) -> str:
        """Say that `child` is in or on `parent`; the preposition."""
        inside = parent.one.noun.word in FITS
        both = parent.one.noun.word in ("tray",)
        self.meaning.add("in" if inside else "on|in" if both else "on", child.things, parent.one)
        return self.random.choice(IN if inside else ON)

    def beside(self, child: Group, landmark: Group) -> str:
        """Say that `child` is at a side of `landmark`, and carried by what carries that; the words."""
        kind = self.random.choice(tuple(SIDES))
        self.meaning.add(kind, child.things, landmark.one)
        kinds, parent = self.meaning.support(landmark.one)
        if isinstance(parent, Thing):
            self.meaning.add("|".join(kinds), child.things, parent)
        return self.random.choice(SIDES[kind])

    def located(self, child: Group, where: str, parent: Group, *, known: bool = False, carries: bool = True) -> str:
        """A clause that says that `child`, not spoken of yet, is there; `known` of the parent; `where` its words."""
        random, c, p = self.random, child.new(), parent.the() if known else parent.new()
        inside = parent.one.noun.word in FITS
        ways = [
            f"{c} {child.verb(random)} {where} {p}", f"{c} {child.be()} {where} {p}",
            f"there {child.be()} {c} {where} {p}", f"{where} {p} {child.verb(random)} {c}",
            f"{where} {p} there {child.be()} {c}",
        ]  # fmt: skip
        if carries:
            on = "in" if inside else "on"
            ways += [f"{p} has {c} {on} it", f"{p} holds {c}", f"{c} {child.be()} placed {where} {p}"]
            ways += [f"{p} contains {c}"] if inside else [f"{p} carries {c}"]
        return random.choice(ways)
