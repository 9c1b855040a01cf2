"""Sentences in the words and the order that are read, by patterns: "let there be a cup" as "there are a cup"."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.vocabulary import Nouns

NUMBER = rf"(?:{'|'.join(word for word, value in lexicon.NUMBERS.items() if 1 < value < 100)}|[2-9]|\d\d)"
NAME = r"(?:(?!(?:and|then|from|with|to|of|in|on|into|onto|is|are) )[^ .,:;]+ )+?"
"""Words without a mark or a place among them."""

LEAD = rf"(?:{'|'.join(lexicon.DETERMINERS)}) "
_TIMES = 3
"""How often one wording may stand in what is said."""

Wording = tuple[re.Pattern[str], tuple[str, ...]]
"""What is said, word by word with a blank behind each, and what is read: words, and numbers of groups."""


def wordings(said: Iterable[tuple[str, str]]) -> tuple[Wording, ...]:
    r"""What `said` has as patterns, each with what is read in its place: "\2 and \1"."""
    return tuple((re.compile(rf"(?<!\S){pattern}"), tuple(told.split())) for pattern, told in said)


def reworded(tokens: Sequence[Token], known: Iterable[Wording]) -> list[Token]:
    """`tokens` with what each of the wordings that are `known` finds as that has it."""
    made = list(tokens)
    for pattern, told in (each for each in known for _ in range(_TIMES)):
        said = "".join(f"{token.text.replace(' ', '_')} " for token in made)
        if (found := pattern.search(said)) is None:
            continue
        spans = [(said.count(" ", 0, start), len(said[: max(end, 0)].split())) for start, end in found.regs]
        start, end = spans[0]
        groups = [made[slice(*spans[int(part[1:])])] if part.startswith("\\") else [] for part in told]
        rest: list[Token] = []
        for at, part in enumerate(told):
            # What is put in stands before what comes next, and what opens it is all that it was said with.
            near = next((group[0] for group in groups[at:] if group), made[end - 1])
            near = replace(near, end=near.start) if any(groups[:at]) else replace(made[start], end=made[end - 1].end)
            rest += groups[at] if part.startswith("\\") else [replace(near, text=part, mark=part in ".,:")]
        made[start:end] = rest
    return made


_BEGIN = r"(?<![^.,;:] )"
_COUNTS = [(rf"(?:{word}|{number})", number) for word, number in lexicon.NUMBERS.items() if 2 < number < 9]
_PUT = r"(?:put|move|bring|place|push|slide|arrange|set|lay)"
_INTO = r"(?:in|into|inside|to|onto|on)"
_MUST = r"(?:should|must|has to|needs to|ought to) (?:go|be (?:put|moved|placed)|end up) "
_ALL = r"(?:whatever|what|everything|all that) (?:that )?is "
_LISTED = r"(?:an? |the )?([^ .,]+ )"
_AND_SO_ON = r"(?:(?:, )?(?:and )?(?:etc|so on) (?:\. )?)?(?:, )?"
_OF_BOTH = [("goes", "go"), ("belongs", "belong"), ("is", "are"), ("stands", "stand"), ("lies", "lie"), ("sits", "sit"),
            ("should", "should"), ("must", "must")]  # fmt: skip
_MEMBERS = {2: rf"{_LISTED}(?:, )?(?:and |, ){_LISTED}", 3: rf"{_LISTED}, {_LISTED}(?:, )?(?:and |, ){_LISTED}"}
_USUAL = wordings((
    (r"let there be ", "there are"),
    # The audit names what is only warned of.
    (r"(?:, )?(?:and|,|but) (?:be|being) careful (?:[^ .:;]+ )*?(?=[.:;-] )", ""),
    (r"((?:closer|nearer) )together ", r"\1 to each other"),
    (rf"((?:{'|'.join(lexicon.LEVEL)}) )(?:scene|setup) (?=[,.:] |with )", r"\1"),
    # "The figs go in the box and so does the pear"
    *((rf"{_BEGIN}((?:but |and )?)(the {NAME})(?:{one}|{several}) ([^.,:]*?)(?:, )?and so"
       rf" (?:does|do|is|are|{one}) ({NAME})(?=[.,])", rf"\1 \2 and \4 {several} \3") for one, several in _OF_BOTH),
    (rf"{_BEGIN}({_PUT} )the (?!{NUMBER} )([^.:]*?), ({NUMBER} )(?:altogether|in (?:all|total)) (?=[.,])",
     r"\1 the \3 \2"),
    (rf"{_BEGIN}({_PUT} )({NUMBER} {NAME})((?:closer|nearer) )", r"\1 the \2 \3"),
    # What is in the box of which a prompt speaks first is not said: the box is emptied.
    (rf"(?<!. ){_ALL}(?:in|inside) (the {NAME}){_MUST}{_INTO} (?=the )", r"empty \1 into"),
    (rf"(?<!. )((?:please )?){_PUT} everything (?:that is |that's )?(?:in|inside|out of) (the {NAME}){_INTO} "
     r"(?=the )(?![^.]*(?:except|but|save) )", r"\1 empty \2 into"),
    (rf"{_ALL}((?:in|on|inside) the {NAME}){_MUST}(?:in|into|inside) (?=the )", r"move everything \1 into"),
    # "Throw away the two empty cans, keep the full one on the desk"
    (rf"{_BEGIN}([^.,]* )the ({NUMBER} {NAME})(?:, )?(?:and |but )?(?:keep|leave) the ([^ .,]+ one )"
     rf"((?:on|in) the {NAME})(?=\.)", r"there are \2 and another \3 \4 . \1 the \2"),
    # "Collect four fruits such as an apple, a banana, etc in the bowl"
    *((rf"{word} ([^ .,]+s )(?:, )?(?:such as|like) {listed}{_AND_SO_ON}(?={_INTO} )",
       " , ".join(rf"the \{n}" for n in range(2, count + 2)) + rf" and {number - count} other \1")
      for word, number in _COUNTS for count, listed in _MEMBERS.items() if number > count),
))  # fmt: skip


def in_usual_words(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt in the usual words and in their order."""
    return reworded(tokens, _USUAL)
