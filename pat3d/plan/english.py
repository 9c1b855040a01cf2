"""Numbers and nouns in English: "two bars of soap", "an umbrella", "the first and the third"."""

from __future__ import annotations

import re
from collections.abc import Sequence

_NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")
MISSPELLED = {
    "pls": "please",
    "plz": "please",
    "teh": "the",
    "hte": "the",
    "ontop": "atop",
    "watter": "water",
    "adn": "and",
    "nad": "and",
    "wich": "which",
    "thier": "their",
    "thats": "that's",
}
"""Slips in words that name nothing; of nouns the vocabulary knows more."""
NUMBERED_BARE = frozenset({"block", "box", "cube", "brick"})
NUMBERED = NUMBERED_BARE | {"tile", "ball", "card", "bin", "drawer", "tray", "cup", "crate", "container", "can", "peg"}
"""What bears a number as its name: "the 4 block" is one, where "the 2 sheep" are two."""
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth")
_PLURALS = {"mouse": "mice", "knife": "knives", "loaf": "loaves", "shelf": "shelves", "die": "dice", "goose": "geese",
            "leaf": "leaves", "bookshelf": "bookshelves", "cactus": "cacti", "snowman": "snowmen",
            "scarf": "scarves", "wolf": "wolves", "elf": "elves", "sheep": "sheep", "deer": "deer",
            "lens": "lenses", "fish": "fish", "bread": "loaves of bread"}  # fmt: skip
_PLURAL_ONLY = re.compile(r"dice|.*[^suioa]s")
"""Names that are plurals as they stand: scissors, tongs, but not glass, cactus, thermos."""
_MASSES = frozenset({
    "flour", "bread", "cheese", "butter", "toothpaste", "soap", "ketchup", "mustard", "sugar", "rice", "tofu", "salmon",
    "broccoli", "lettuce", "celery", "garlic", "chocolate", "popcorn", "ham", "meat", "pasta", "cereal", "milk", "wine",
    "tomato soup", "salt", "honey", "jam", "yogurt", "salad", "cauliflower", "spinach", "bacon", "tuna", "sushi",
    "jewelry", "sandpaper", "tape", "cream cheese", "ginger",
})  # fmt: skip
"""What is told of as "some flour" where there is one of it."""


def set_apart(text: str) -> str:
    """`text` with "AlarmClock" as two words, and a stop where the next sentence begins: "in the box We need it"."""
    text = re.sub(r"(?<!\bMac)(?<=[a-z]{2})(?=[A-Z][a-z]{2})", " ", text)
    text = re.sub(r"\b([Ss]emi|[Hh]alf)[- ]circle\b", "semicircle", text)
    text = re.sub(r", after that,?(?= )", ", then", text)
    text = re.sub(r"\bdrawer compartment\b", "drawer", text)
    return re.sub(r"(?<=[a-z]) (?=(?:We|Its?|It's|Id|I'd|Thanks?|This|There|Dont|Were|Please)\b)", ". ", text)


def is_plural(base: str) -> bool:
    """Whether the name `base` is a plural as it stands: "scissors"."""
    word = base.partition(" of ")[0].split()[-1]
    return word not in _PLURALS and _PLURAL_ONLY.fullmatch(word) is not None


def plural(name: str) -> str:
    """The plural of a noun phrase: "bars of soap", "boxes", "mice"."""
    head, of, rest = name.partition(" of ")
    *before, word = head.split(" ")
    if word in _PLURALS:
        word = _PLURALS[word]
    elif is_plural(word):
        pass
    elif re.search(r"(s|x|z|ch|sh|tomato|potato|domino)$", word):
        word += "es"
    elif re.search(r"[^aeiou]y$", word):
        word = f"{word[:-1]}ies"
    else:
        word += "s"
    return " ".join([*before, word]) + of + rest


def some(base: str, count: int) -> str:
    """Read "a mug", "two mugs", "some flour"."""
    if count > 1:
        return f"{counted(count)} {plural(base)}"
    if is_plural(base):
        return base
    if base.split()[-1] in _MASSES and " of " not in base:
        return f"some {base}"
    return f"{'an' if re.match(r'[aeio]|hour|u(?!ni|s|k|t)', base) else 'a'} {base}"


def counted(count: int) -> str:
    """`count` in words up to twelve."""
    return _NUMBERS[count] if count < len(_NUMBERS) else str(count)


def ordinal(at: int) -> str:
    """Read "first" for 0."""
    return _ORDINALS[at] if at < len(_ORDINALS) else f"{at + 1}th"


def joined(parts: Sequence[str]) -> str:
    """Read "a, b and c"."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}" if parts else "nothing"
