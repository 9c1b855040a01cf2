"""What all of some are or have but one: as what the one is, and what the others are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Span, Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_EXCEPT = (("except", "for"), ("apart", "from"), ("but", "for"), ("save", "for"), ("except",), ("but",), ("save",))
_LISTING = frozenset({",", "and", "a", "an", "the", "some", "several"})
_SAVE = frozenset({"except", "save", "excepting", "only"})


def exceptions(told: list[list[Token]]) -> list[list[Token]]:
    """The sentences `told` with what is excepted in a sentence of its own."""
    plain = [each for at, sentence in enumerate(told) for each in _of_others(_but(sentence), told[:at])]
    return [each for sentence in plain for each in (_described(sentence) or _asked(sentence))]


def coloured_alike(sentence: list[Token], nouns: Nouns) -> list[Token]:
    """Tell "a shelf of jars, all red" as "a shelf of red jars", ", all red except one blue" with a blue one beside."""
    words, stop = [token.text for token in sentence], len(sentence) - 1
    for at in (n for n in range(2, stop - 1) if words[n] == "," and words[n + 1] in ("all", "both", "each")):
        start = next((n for n in range(at + 2, stop) if words[n] not in ("of", "them", "which", "are")), stop)
        end = next((n for n in range(start, stop) if not (is_colour_word(words[n]) or words[n] == "and")), stop)
        size = next((len(said) for said in _EXCEPT if tuple(words[end : end + len(said)]) == said), 0)
        one = end + size if size and words[end + size] == "one" else 0
        after = one + 1 + is_colour_word(words[one + 1]) if one else end
        names = _spoken_of(sentence[:at], nouns)
        single = len(names) == 1 and singulars(words[names[0][1] - 1])
        if end == start or not (sentence[after].mark and names) or (one and not single):
            continue
        (first, last), made = names[0], sentence[:at]
        if one:
            # The blue one of "a crate of jars" is in the crate as well, and of five jars that are not four are red.
            inside = words[first - 1] == "of" and nouns.match(words[first - 2 : first - 1])
            fewer = str(numeral(words[first - 1]) - 1) if numeral(words[first - 1]) > 1 else words[first - 1]
            made[first - 1] = replace(made[first - 1], text="with" if inside else fewer)
            ends = sentence[after].start
            name = [*sentence[first : last - 1], replace(sentence[last - 1], text=singulars(words[last - 1])[0])]
            made[last:last] = [replace(sentence[end], text="and"), *sentence[one:after],
                               *(replace(each, start=ends, end=ends) for each in name)]  # fmt: skip
        for begin, _ in reversed(names):
            made[begin:begin] = [replace(hue, start=made[begin].start, end=made[begin].start)
                                 for hue in sentence[start:end]]  # fmt: skip
        return [*made, *sentence[after:]]
    return sentence


def _spoken_of(sentence: Sequence[Token], nouns: Nouns) -> list[Span]:
    """The names in `sentence` of what "all" means: the first list of several, what is had before what has it."""
    words, at = [token.text for token in sentence], 0
    lists: list[list[Span]] = []
    told: list[Span] = []
    joined = had = False
    while at < len(words):
        sizes = (n for n in (3, 2, 1) if at + n <= len(words) and nouns.match(words[at : at + n]))
        size = 0 if is_colour_word(words[at]) else next(sizes, 0)
        if size and (joined or had or not told):
            lists += [] if joined else [[]]
            lists[-1].append((at, at + size))
            several = len(lists[-1]) > 1 or nouns.match(words[at : at + size]).plural  # type: ignore[union-attr]
            told = lists[-1] if several else told
        elif not (size or words[at] in _LISTING or numeral(words[at]) or is_modifier(words[at])):
            had = words[at] in ("with", "of") or words[at] in lexicon.HAVING
        joined = bool(size) or (joined and (words[at] in _LISTING or numeral(words[at]) > 0 or is_modifier(words[at])))
        at += size or 1
    return told


def _but(sentence: list[Token]) -> list[Token]:
    """Tell "except that the red one is on the floor" as "but the red one is on the floor", and "one is" of "them"."""
    words = [token.text for token in sentence]
    for at in range(3, len(words) - 4):
        size = 2 if words[at] in _SAVE and words[at + 1] == "that" else 1 if words[at] == "but" else 0
        start = at + size
        stop = next(n for n in range(at, len(words)) if sentence[n].mark)
        some = numeral(words[start]) > 0 and words[start + 1] in FINITE
        holds = some and words[start + 1] not in lexicon.COPULAS
        if not size or holds or not {*words[start:stop]} & FINITE or not (some or size == 2):
            continue
        one = replace(sentence[start], start=sentence[at].start)
        of_them = [replace(one, text=word) for word in (words[start], "of", "them")]
        rest = [*of_them, *sentence[start + 1 :]] if some else sentence[start:]
        return [*sentence[:at], replace(sentence[at], text="but"), *rest]
    return sentence


def _of_others(sentence: list[Token], before: Sequence[Sequence[Token]]) -> list[list[Token]]:
    """Tell "lift the pen that is not in the cup" as "there is a pen in the cup" and "lift the other pen".

    So is "the cube that is neither red nor blue" where no sentence `before` has told of cubes.
    """
    words = [token.text for token in sentence]
    at = next((n for n in range(2, len(words) - 2) if words[n] in ("that", "which")), 0)
    first = at + 2 + (words[min(at + 1, len(words) - 1)] in ("is", "'s", "are"))
    the = next((n for n in range(at - 1, -1, -1) if words[n] == "the"), -1) if at else -1
    name = [token for token in sentence[the + 1 : at] if token.text != "one"]
    known = {words[at - 1], *singulars(words[at - 1])} & {token.text for each in before for token in each}
    denies = the >= 0 and first < len(words) - 1 and words[first - 1] in ("not", "neither", "isn't")
    if not denies or not 0 < len(name) < 4 or known:
        return [sentence]
    put = words[0] in ("put", "place", "set", "lay")
    end = next(n for n in range(first + 1, len(words)) if sentence[n].mark or words[n] in FINITE | lexicon.MODALS
               or words[n] in ("and", "into", "onto", "to") or (put and link_at(sentence, n)))  # fmt: skip
    nor = next((n for n in range(first + 1, end) if words[n] == "nor"), 0)
    looks = [sentence[n] for n in (first, nor + 1 if nor else 0) if n and is_colour_word(words[n])]
    placed = link_at(sentence, first)
    there = [replace(sentence[at], text=word) for word in ("there", "is", "a")]
    if looks and len(looks) == 1 + bool(nor) and end == first + 1 + 2 * bool(nor):
        those = [[*there, look, *name, replace(sentence[-1])] for look in looks]
    elif placed and words[first + placed] in lexicon.DETERMINERS and not nor:
        those = [[*there, *name, *sentence[first:end], replace(sentence[-1])]]
    else:
        return [sentence]
    other = [replace(sentence[the], text=word) for word in ("the", "other")]
    return [*those, [*sentence[:the], *other, *name, *sentence[end:]]]


def _asked(sentence: list[Token]) -> list[list[Token]]:
    """Tell "put all pens except the red one in the cup" as "there is a red pen" and "put all other pens in the cup"."""
    words = [token.text for token in sentence]
    at = next((n for n in range(3, len(words) - 4) if words[n] in ("except", "but") or
               words[n : n + 2] in (["apart", "from"], ["except", "for"])), 0)  # fmt: skip
    the = at + 1 + (words[at + 1] in ("from", "for")) if at else 0
    one = next((n for n in range(the + 2, min(the + 4, len(words))) if words[n] == "one"), 0) if the else 0
    every = words.index("all") if "all" in words[:at] else 0
    asked = base_verb(words[0]) == words[0] and every == 1 and one and words[the] == "the"
    if not asked or not singulars(words[at - 1]) or any(link_at(sentence, n) for n in range(2, at)):
        return [sentence]
    there = [replace(sentence[the], text=word) for word in ("there", "is", "a")]
    noun = replace(sentence[one], text=singulars(words[at - 1])[0])
    led = 2 + (words[2] in lexicon.DETERMINERS)
    other = replace(sentence[led - 1], text="other")
    return [
        [*there, *sentence[the + 1 : one], noun, replace(sentence[-1])],
        [*sentence[:led], other, *sentence[led:at], *sentence[one + 1 :]],
    ]


def _described(sentence: list[Token]) -> list[list[Token]]:
    """Tell "every mug is upside down apart from the green one" as "there is a green mug, all other mugs are ..."."""
    words = [token.text for token in sentence]
    if words[0] not in ("every", "each", "all"):
        return []
    start = 1 + (words[1] == "the")
    verb = next((n for n in range(start + 1, len(words)) if words[n] in lexicon.COPULAS), 0)
    for at in range(verb + 2, len(words) - 4) if verb else ():
        size = next((len(said) for said in _EXCEPT if tuple(words[at : at + len(said)]) == said), 0)
        one = at + size + 2
        if not size or words[at + size] != "the" or not is_colour_word(words[one - 1]) or words[one] != "one":
            continue
        link = next((n for n in range(start + 1, verb) if link_at(sentence, n)), verb)
        if sentence[one + 1].text != "." or any(token.mark or token.text == "and" for token in sentence[:at]):
            return []
        name = words[link - 1] if words[0] == "all" else f"{words[link - 1]}s"
        single = (singulars(name) or (words[link - 1],))[0]
        there = [replace(sentence[at], text=word) for word in ("there", "is", "a")]
        several = [replace(sentence[0], text=word) for word in ("all", "other")]
        noun, nouns = (replace(sentence[link - 1], text=word) for word in (single, name))
        place = sentence[link:verb]
        are = replace(sentence[verb], text="are")
        stop = sentence[-1]
        return [
            [*there, sentence[one - 1], *sentence[start : link - 1], noun, *place, replace(stop)],
            [*several, *sentence[start : link - 1], nouns, *place, are, *sentence[verb + 1 : at], stop],
        ]
    return []
