"""Words and punctuation of a prompt."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass

from pat3d.plan.english import MISSPELLED, set_apart
from pat3d.plan.grammar.words import measures, postures

_TOKEN = re.compile(
    rf"(?P<measure>\b(?:{measures.LENGTH}|{measures.AMOUNT}))|(?P<posture>\b(?:{postures.POSTURE})(?![\w-]))"
    r"|(?P<number>\d+[.]\d+)|(?P<word>[^\W_]+(?:[-'][^\W_]+)*)|(?P<dash>\u2014|\u2013|--+|(?<=\s)-(?=\s))"
    r"|(?P<stop>[.!?;\n]+)|(?P<comma>[,()\[\]])|(?P<colon>:)",
    re.IGNORECASE,
)
_IRREGULAR = {
    "mice": "mouse", "knives": "knife", "loaves": "loaf", "leaves": "leaf", "shelves": "shelf", "halves": "half",
    "scarves": "scarf", "wolves": "wolf", "geese": "goose", "feet": "foot", "teeth": "tooth", "children": "child",
    "men": "man", "women": "woman", "people": "person", "dice": "die", "cacti": "cactus", "wives": "wife",
    "calves": "calf", "elves": "elf", "oxen": "ox", "bookshelves": "bookshelf", "snowmen": "snowman", "tvs": "tv",
    "cds": "cd",
}  # fmt: skip
_SPELLED = {
    word: str(number) for number, word in enumerate(
        ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"), 1)
}  # fmt: skip
"""Numbers that stand in brackets behind their digits."""
_NUMBER = "(" + "|".join(list(_SPELLED)[1:10]) + ")"
_GRID = re.compile(rf"\b{_NUMBER}[ -]by[ -]{_NUMBER} grid\b", re.IGNORECASE)
_GRID_OF = re.compile(rf"\bgrid of {_NUMBER} by {_NUMBER}(?= [a-z])", re.IGNORECASE)
_LETTERS = re.compile(r"\b((?:labelled|labeled|numbered) )([A-H])(?: to |-|\u2013)([A-H])\b")
_NAMED = re.compile(r"\b([A-Za-z]{2,20}s) ((?:[A-H], )*[A-H],? and [A-H])\b(?! [a-z]+s? [A-H]\b)")


def _in_between(found: re.Match[str]) -> str:
    """Tell "A to C" as "A, B and C"."""
    letters = [chr(code) for code in range(ord(found[2]), ord(found[3]) + 1)]
    return f"{found[1]}{', '.join(letters[:-1])} and {letters[-1]}" if len(letters) > 1 else found[0]


def _labelled(found: re.Match[str]) -> str:
    """Tell "boxes A and B" as "two boxes labelled A and B"; as "box A and box B" where "box C" is told of as well."""
    known = (one for one in singulars(found[1].lower()) if re.search(rf"\b(?i:{one}) [A-H]\b", found.string))
    if one := next(known, ""):
        return re.sub("[A-H]", lambda letter: f"{one} {letter[0]}", found[2])
    number = len(re.findall("[A-H]", found[2]))
    return f"{list(_SPELLED)[number - 1]} {found[1].lower()} labelled {found[2]}"


Span = tuple[int, int]
"""The first of some tokens, and the one behind the last."""


@dataclass(frozen=True, kw_only=True)
class Token:
    """One word or mark."""

    text: str
    """Lower case; ",", ".", ":", "-" (a dash) or "'s" for marks; a measure or a posture begins with "_"."""
    start: int
    end: int
    """Span in the normalised prompt [characters]."""
    number: int
    """1 for the first word of the prompt; a mark has the number of the word before it."""
    mark: bool = False


def normalise(prompt: str) -> str:
    """`prompt` with one kind of quote, one kind of blank, decimal fractions and compatibility characters resolved."""
    prompt = re.sub(r"(\d{0,6})([\u00bc-\u00be\u2150-\u215e])", _decimal, set_apart(prompt))
    # "Arts & Crafts" is one name; a title has no word that begins small.
    prompt = re.sub(r"(?<=[a-z] )([A-Z][a-z]+) & ([A-Z][a-z]+)\b", r"\1-and-\2", prompt)
    prompt = re.sub(r"\bw/(o?)(?=\s)", lambda found: "without" if found[1] else "with", prompt)
    text = re.sub(r"(?<=\s)[&+](?=\s)", "and", unicodedata.normalize("NFKC", prompt))
    text = re.sub(r"(?<![\d/.])(\d{1,3})/([1-9]\d?)(?=[ -]?(?:mm|cm|m|in|inch|inches|feet|foot|ft)\b)", _quotient, text)
    text = re.sub(r"(?<=[^\W\d_])\((e?s)\)", r"\1", text, flags=re.IGNORECASE)
    text = re.sub(r"\bspaced (?:about )?(?=\d)", "", text)
    # "Forks on display" are shown, and stand on no screen.
    text = re.sub(r" (?:(?:are|is) )?on (?:display|show)\b", "", text)
    text = re.sub(r"\b(?:outer two|two outer) (?!ones)[a-z]+s(?= (?:are|have|hold|stand)\b)", "outer two", text)
    text = re.sub(r"\b3/4(?= view| angle)", "three-quarter", text)
    text = re.sub(r"\b([^\W\d_]+) (\d{1,2})[x\u00d7](?=[,.;]| and\b|$)", r"\2 \1", text)
    text = re.sub(_LETTERS, _in_between, text)
    text = re.sub(_NAMED, _labelled, text)
    text = re.sub(_GRID, lambda found: f"{_SPELLED[found[1].lower()]}x{_SPELLED[found[2].lower()]} grid", text)
    text = re.sub(_GRID_OF, lambda found: f"{_SPELLED[found[1].lower()]}x{_SPELLED[found[2].lower()]} grid of", text)
    text = re.sub(r"\b(\d{1,3}) ?[x\u00d7] (?=[^\W\d_])", r"\1 ", text)
    text = re.sub(r"\b(\d{1,3}) ?(?:pcs|pc)[.]? of (?=[^\W\d_])", r"\1 ", text)
    # "Three (3) plates"; in "plates (3)" the number is said there alone.
    text = re.sub(
        r"\b([^\W\d_]+) ?\((\d{1,3})\)",
        lambda found: found[1 if _SPELLED.get(found[1].lower()) == found[2] else 0],
        text,
    )
    text = re.sub(
        r"\b(\d{1,2}) \(([a-z]+)\)", lambda found: found[1 if _SPELLED.get(found[2]) == found[1] else 0], text
    )
    return re.sub(r"[^\S\n]+", " ", text.translate({0x2018: "'", 0x2019: "'", 0x201C: '"', 0x201D: '"'}))


def _decimal(found: re.Match[str]) -> str:
    return f"{int(found[1] or 0) + unicodedata.numeric(found[2]):.4g}"


def _quotient(found: re.Match[str]) -> str:
    return f"{int(found[1]) / int(found[2]):.4g}"


def tokenise(text: str) -> list[Token]:
    """The words and marks of normalised `text`, ending in a full stop."""
    tokens: list[Token] = []
    words = 0
    for found in _TOKEN.finditer(text):
        start, end = found.span()
        if found.lastgroup in ("word", "number"):
            words += 1
            # "Café" is read as "cafe".
            plain = unicodedata.normalize("NFKD", found.group().lower()).encode("ascii", "ignore").decode()
            word = plain or found.group().lower()
            word = MISSPELLED.get(word, word)
            if word.endswith("'s") and len(word) > 2:
                tokens.append(Token(text=word[:-2], start=start, end=end - 2, number=words))
                tokens.append(Token(text="'s", start=end - 2, end=end, number=words))
            else:
                tokens.append(Token(text=word, start=start, end=end, number=words))
        elif found.lastgroup in ("measure", "posture"):
            words += len(found.group().split())
            name = (measures if found.lastgroup == "measure" else postures).token_text(found.group())
            tokens.append(Token(text=name, start=start, end=end, number=words))
        else:
            mark = {"dash": "-", "stop": ".", "comma": ",", "colon": ":"}[str(found.lastgroup)]
            tokens.append(Token(text=mark, start=start, end=end, number=words, mark=True))
    tokens.append(Token(text=".", start=len(text), end=len(text), number=words, mark=True))
    return tokens


def items_of(tokens: Sequence[Token]) -> list[list[Token]]:
    """What `tokens` list, parted at commas and "and"."""
    items: list[list[Token]] = [[]]
    for token in tokens:
        if token.text in (",", "and"):
            items.append([])
        else:
            items[-1].append(token)
    return [item for item in items if item]


def singulars(word: str) -> tuple[str, ...]:
    """What `word` may be the plural of, likeliest first; empty where it does not look like a plural."""
    if word in _IRREGULAR:
        return (_IRREGULAR[word],)
    if len(word) < 4 or not word.endswith("s") or word.endswith("ss"):
        return ()
    guesses = [word[:-1]]
    if word.endswith("ies"):
        guesses.insert(0, word[:-3] + "y")
    elif word.endswith("ves"):
        guesses += [word[:-3] + "f", word[:-3] + "fe"]
    elif word.endswith("es"):
        guesses.append(word[:-2])
    return tuple(guesses)
