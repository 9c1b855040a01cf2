"""What only tells how things look or are sorted: "in the style of Van Gogh", "by height". Each is named in a note."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting import ways
from pat3d.plan.grammar.rewriting.denials import Told
from pat3d.plan.grammar.rewriting.in_turn import in_turn
from pat3d.plan.grammar.rewriting.numbered import LABELLED, labels_end
from pat3d.plan.grammar.rewriting.of_material import one_of_stuff
from pat3d.plan.grammar.rewriting.open_questions import choice
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import JOINERS, link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.shapes import PLACES, RINGS, UNPLANNED
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_STYLES = (
    ("with", "the", "style", "of"),
    ("in", "the", "style", "of"),
    ("in", "the", "manner", "of"),
    ("in", "style", "of"),
)
_NUMBER = rf"(?:{'|'.join(lexicon.NUMBERS)}|\d+)"
_MEASURE = "(?:height|size|length|width|weight|age|brightness|volume)"
_DIRECTION = "(?:decreasing|increasing|ascending|descending)"
_EXTREME = (
    r"(?:the )?(?:largest|smallest|biggest|tallest|shortest|longest|heaviest|lightest|thickest|thinnest|widest"
    r"|narrowest|big|small|large|tall|short)(?: one)?(?: (?:on|at) the (?:far )?(?:left|right|front|back))?"
)
_NO_NAMES = (r"\.", ",", "can", "could", "what", "that", "as", "if", "and", "after", "before", "once", "when", "where",
             "until", "while")  # fmt: skip
"""Words before "you" and "I" that are not what those have or use."""
_ASIDE = tuple(re.compile(rf"(?<!\S){said} ") for said in (
    r"(?:, )?in (?:the (?:dark|light|rain|sun)|(?:bright|dim) light|parallel|random (?:order|positions|places))",
    # "insert the pen tip first"
    rf"(?<!the )(?<!its )(?:{'|'.join(sorted(lexicon.PARTS))})(?:[ -](?:side|end))?[ -]first",
    r"(?:, )?(?:inside out|if (?:possible|needed|necessary)|where possible|as needed|back and forth|(?:at )?random"
    r"|straight (?:up|down))",
    # "socks in it, mostly grey", "a drawer, half open, with a pen in it", "four forks around a cake, one on each side"
    r"[,-] (?:mostly|mainly|largely|predominantly) (?!\S+s )\S+(?= [.] )",
    r", (?:half|partly|partially|slightly|fully|nearly|almost) (?:open|closed|shut|full|empty) ,(?= with )",
    r", one (?:on|at|to) each (?:side|end|corner)(?: of it)?(?= [,.] )",
    # "insert the peg into the square hole of the board"
    r"(?<=into )the (?:[a-z-]+ )?(?:hole|notch|groove|recess|socket) (?:of|in|on)(?= the )",
    # "fill the cup three quarters with water", "the cup half full with milk", "the books on the shelf, tallest left"
    r"(?<=\S )(?:(?:a|one|two|three) (?:quarters?|thirds?|half)|half ?way|to the (?:brim|rim|top))(?= (?:full|with) )",
    r", (?:larg|small|bigg|tall|short|long)est (?:first|(?:on|at) the (?:left|right|front|back))(?= [,.] )",
    # "the sponge you're holding", "the cup I used", "the second and the third cup are not"
    rf"(?<=\S ){''.join(f'(?<!{word} )' for word in _NO_NAMES)}(?:you|i|we)"
    r"(?:'re|'ve|'m| are| have| had| am| were)? (?:just |already |now )?"
    r"(?:\S+(?:ing|ed)|got|made|bought|put|took|left|chose|drank|gave|saw|lost|found|broke|brought|sent|wore|built|hid)"
    r"(?: (?:with|up|before|earlier|now|from(?= (?!the |a |my ))))?",
    r"(?:, |but )(?:the (?:first|second|third|fourth|fifth) \S+ (?:and )?)+(?:is|are) not(?= [.] )",
    # "a lamp taller than either", "three candles, one lit", "place six blocks in two groups of three"
    r"\S+ than (?:either|both|all)",
    rf", {_NUMBER} (?:{'|'.join(lexicon.STATES)})(?= [,.:-] )",
    rf"in(?:to)? {_NUMBER} (?:groups|clusters)(?: of {_NUMBER})?(?: each)?",
    # "the flat dish often used for serving food", "the basket meant for carrying groceries"
    r"(?:(?:, )?(?:which|that) (?:is|are) |(?<!is )(?<!are )(?<!be ))(?:(?:often|typically|usually|commonly) )?"
    r"(?:used|designed|meant|intended) (?:for|to|on|when)(?: (?!(?:then|which|in|on|onto|into|inside|within|next|from"
    r"|is|are|stands?|lies?|sits?|holds?) |and (?:it|place|put|set|deposit|insert|add|shut|close|then|the|a) "
    r"|[.,:;-] )\S+)+",
    # "press the button twice", "push the box until it reaches the edge", "a sofa facing south-west"
    rf"(?<!than )(?<!and )(?<!as )(?<!or )(?:twice|thrice|(?:{_NUMBER}|{'|'.join(lexicon.VAGUE)}) times)(?! as )",
    r"(?:, )?(?:until|till) (?!then |now )(?:(?![.,:-] )\S+ )*(?![.,:-] )\S+",
    r"(?:and |to |parked )*(?:facing|faces?|point(?:ing|ed)|turned|oriented|looking)(?: (?:out|towards?|to|the|due))*"
    r" (?:(?:north|south)-?(?:east|west)?|east|west)",
    # "line up the cups by height", "from the largest to the smallest", "in order of decreasing height"
    rf"by {_MEASURE}(?! and )", rf"(?:, )?from {_EXTREME} to {_EXTREME}",
    rf"in (?:{_DIRECTION} order(?: of (?:{_DIRECTION} )?{_MEASURE})?|order of (?:{_DIRECTION} )?{_MEASURE})",
))  # fmt: skip
"""What is said of how something looks, is turned or is done, wherever it stands."""
_KINDS = frozenset({"appliance", "furniture", "device", "item", "object", "tool", "utensil"})
_ACCENTS = frozenset({"accents", "accent", "details", "touches", "hues", "tones", "finishes", "decor"})

_OUTLINES = UNPLANNED - PLACES - RINGS - {"pyramid", "grid", "matrix", "staircase", "stairway", "cantilever"}
"""Shapes that things standing beside each other have; what is built so has to be told otherwise."""
_FORMING = frozenset({"form", "forms", "forming", "make", "makes", "making"})
_SQUARES = ("square", "rectangle")
"""What four alike have in two rows of two."""
_INSIDE = frozenset({"around", "middle", "center", "centre", "each"})
_UNSEEN = frozenset({"can't", "cannot", "won't", "isn't", "aren't", "not", "doesn't", "don't", "never", "couldn't"})
_SEEMING = frozenset({"smell", "feel", "taste", "sound", "seem", "look", "become", "get", "go", "turn", "grow", "stay",
                      "remain", "keep"})  # fmt: skip
"""Verbs of what something is like, or comes to be."""
_NO_ADJECTIVES = frozenset({"like", "as", "to", "if", "that", "up", "down", "away", "out", "off", "over", "around"})
_BUNCHES = frozenset({"cluster", "bundle", "bunch", "clump", "huddle", "queue", "heap", "group", "knot", "jumble"})


def without_manners(tokens: Sequence[Token], nouns: Nouns) -> Told:
    """`tokens` of one sentence, which ends in a stop, without what tells only of looks and order."""
    words = [token.text for token in tokens]
    for told in (choice, one_of_stuff, _style, _same, _stuffs, _aside, _ready, _if, _outlined, _labels, in_turn,
                 _in_that_order, _such_that, _trait, _seeming, _in_a_bunch, ways.begun, ways.parallel):  # fmt: skip
        if (found := told(tokens, words, nouns)) is not None:
            kept, left_out = found
            rest, more = without_manners(kept, nouns)
            return rest, [*left_out, *more]
    return list(tokens), []


def _seeming(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "the soup smells delicious" and "the bread that has gone stale" as "the soup", "the bread".

    Behind such a verb stands an adjective, known or not, wherever no article or relation does: a thing is never named.
    """
    for at in range(1, len(words) - 1):
        start = at - (words[at - 1] in ("has", "have", "had"))
        subject = words[start - 1] in ("it", "they", "that", "which") or nouns.match([words[start - 1]]) is not None
        subject = subject or words[max(start - 2, 0)] in lexicon.DETERMINERS
        seems = (base_verb(words[at]) or words[at][:4]) in _SEEMING and not words[at].endswith("ing")
        if not seems or not start or not subject or words[start - 1] == "the":
            continue
        joined = ("and", "but") if words[at] not in ("get", "go", "keep") else ()
        end = next(n for n in range(at + 1, len(words)) if tokens[n].mark or _tells(tokens, n, nouns)
                   or (words[n] in joined and (tokens[n + 1].mark or _tells(tokens, n + 1, nouns))))  # fmt: skip
        said = [word for word in words[at + 1 : end] if word not in joined]
        plain = said and len(said) < 5 and not {*said} & _NO_ADJECTIVES
        plain = plain and (words[at] not in lexicon.COPULAS or not all(map(is_modifier, said)))
        if plain and (tokens[end].mark or words[end] in FINITE | {"and", "but"} or link_at(tokens, end)):
            start -= words[start - 1] in ("that", "which")
            goes_on = words[end] in ("and", "but") and words[end + 1] in FINITE
            return [*tokens[:start], *tokens[end + goes_on :]], [(tokens[start], tokens[end - 1])]
    return None


def _tells(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether something else is named or said at token `at` than what a thing is like."""
    word = tokens[at].text
    named = word in lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.PRONOUNS | FINITE or bool(link_at(tokens, at))
    return named or nouns.match([word]) is not None or base_verb(word) == word


def _in_a_bunch(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "five cups in a tight cluster on a tray" as "five cups on a tray"; of "a cluster of figs" nothing is in."""
    for at in range(1, len(words) - 2):
        end = next((n for n in range(at + 2, min(at + 5, len(words) - 1)) if words[n] in _BUNCHES), 0)
        plain = end and words[at] in ("in", "into") and words[at + 1] in ("a", "one") and words[end + 1] != "of"
        if plain and not any(nouns.match([word]) or link_at(tokens, at + 2) for word in words[at + 2 : end]):
            return [*tokens[:at], *tokens[end + 1 :]], [(tokens[at], tokens[end])]
    return None


def _trait(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a bottle on a table, its green glass catching the light" as "a bottle on a table"."""
    for at in range(2, len(words) - 3):
        if words[at] != "," or words[at + 1] not in ("its", "their"):
            continue
        end = next(n for n in range(at + 1, len(words)) if tokens[n].mark)
        doing = next((n for n in range(at + 3, min(at + 6, end)) if words[n].endswith("ing")), 0)
        plain = doing and words[doing] not in lexicon.PARTICIPLES and words[doing] not in lexicon.NOT_VERBS
        plain = plain and not link_at(tokens, doing) and nouns.match([words[doing]]) is None
        counted = {"a", "an", *lexicon.NUMBERS} & {*words[doing:end]} - {"one"}
        if plain and not counted and words[doing - 1] not in vessels.ON_RIMS:
            return [*tokens[:at], *tokens[end:]], [(tokens[at + 1], tokens[end - 1])]
    return None


def _style(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a chair in the style of Van Gogh stands" as "a chair stands", "in the style of art, a cup" as "a cup"."""
    for at in range(len(words) - 2):
        size = next((len(said) for said in _STYLES if tuple(words[at : at + len(said)]) == said), 0)
        if not size:
            continue
        begun = range(at + size + 1, len(words))
        end = next(n for n in begun if tokens[n].mark or words[n] in FINITE or _goes_on(tokens, n, nouns))
        return [*tokens[:at], *tokens[end + (not at and words[end] == ",") :]], [(tokens[at], tokens[end - 1])]
    return None


def _same(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "the armchair is the corner chair" as "the armchair"; which of several it is told by, a rank or a colour."""
    verb = next((n for n in range(2, len(words) - 3) if words[n : n + 2] == ["is", "the"]), 0)
    if (
        not verb
        or words[0] not in ("the", "this", "my")
        or any(link_at(tokens, n) or tokens[n].mark for n in range(len(words) - 1))
    ):
        return None
    which = {*lexicon.TELLING, *lexicon.NUMBERS, *lexicon.PRONOUNS, "one", "other", "and"}
    told = which & {*words} or any(is_colour_word(word) for word in words)
    named = nouns.longest(words[1:verb]) and nouns.longest(words[verb + 2 : -1])
    return ([*tokens[:verb], tokens[-1]], [(tokens[verb], tokens[-2])]) if named and not told else None


def _stuffs(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a bedroom in charcoal, leather and oak", "with oak accents" as "a bedroom": nobody says where that is."""
    at = next((n for n in range(1, min(len(words) - 2, 8)) if words[n - 1] in lexicon.BACKGROUND
               and (words[n] == "in" or (words[n] == "with" and words[-2] in _ACCENTS))), 0)  # fmt: skip
    said = " ".join("," if word == "and" else word for word in words[at + 1 : -1])
    told = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | FINITE
    plain = at and (words[at] == "with" or "," in said) and not told & {*said.split()}
    plain = plain and not any(link_at(tokens, n) for n in range(at + 1, len(words)))
    few = all(len(run.split()) < 3 for run in said.split(","))
    return ([*tokens[:at], tokens[-1]], [(tokens[at], tokens[-2])]) if plain and few else None


def _aside(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "two cups in random places on a tray" as "two cups on a tray"."""
    said = "".join(f"{word.replace(' ', '_')} " for word in words)
    for found in (found for pattern in _ASIDE for found in pattern.finditer(said)):
        at, end = (said.count(" ", 0, place) for place in found.span())
        ends = end < len(tokens) and (
            tokens[end].mark or words[end] in JOINERS | FINITE | {"the"} or link_at(tokens, end)
        )
        # "The appliance used for heating food": which one is told by it.
        told = words[at - 1] in _KINDS and "for" in words[at + 1 : at + 4]
        # "A radio and two mugs, one on each side": told of a scene, it is where they are.
        told = told or ("each" in words[at + 3 : end] and base_verb(words[0]) != words[0])
        if at and ends and not told:
            return [*tokens[:at], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None


def _ready(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a bowl full of soup, ready to eat" as "a bowl full of soup"."""
    at = next((n for n in range(2, len(words) - 2) if words[n] == "ready" and words[n + 1] in ("to", "for")), 0)
    end = next(n for n in range(at, len(words)) if tokens[n].mark)
    named = any(nouns.match([word]) is not None for word in words[at + 2 : end])
    if not at or named or words[at - 1] in lexicon.COPULAS or any(link_at(tokens, n) for n in range(at + 2, end)):
        return None
    return [*tokens[: at - (words[at - 1] == ",")], *tokens[end:]], [(tokens[at], tokens[end - 1])]


def _if(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "leave it if it is upright" as "leave it", and "if any are full, empty them" as "empty them"."""
    for at in range(2, len(words) - 2):
        if words[at] not in ("if", "unless"):
            continue
        end = next(n for n in range(at, len(words)) if tokens[n].mark)
        named = {word for word in words[at:end] if nouns.match([word]) is not None}
        before = {*words[:at], *(one for word in words[:at] for one in singulars(word))}
        if named - before or words[end] == ":" or (words[end] == "," and words[at - 1] not in ("and", ",", "then")):
            return None
        start = at - (words[at - 1] == ",")
        rest = end + (words[end] == "," and words[at - 1] != ",")
        return [*tokens[:start], *tokens[rest:]], [(tokens[at], tokens[end - 1])]
    return None


def _outlined(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "three cans in a triangle on a tray", "three cans form a triangle", as "three cans on a tray".

    "Four cans in a square" stand in two rows of two.
    """
    for at in range(1, len(words) - 2):
        forming = words[at] in _FORMING
        forming = forming and (words[at][-1] == "g" or words[at - 1] not in ("to", ",", "and", "please"))
        if not (forming or words[at] in ("in", "into")) or words[at + 1] not in ("a", "an"):
            continue
        head = next((n for n in (at + 2, at + 3) if n < len(words) and words[n] in _OUTLINES), 0)
        after = tokens[min(head + 1, len(tokens) - 1)]
        ends = after.mark or after.text in JOINERS | FINITE | lexicon.STANDING or link_at(tokens, head + 1) > 0
        several = any(lexicon.NUMBERS.get(word, 0) > 2 or singulars(word) for word in words)
        if not head or not ends or after.text == "of" or not (several or {"and", "them", "they"} & {*words}):
            continue
        four = next((n for n in range(at - 1) if words[n] in ("four", "4")), -1)
        alone = not any(token.mark or token.text == "and" for token in tokens[four + 1 : at])
        numbers = sum(word in lexicon.NUMBERS and word not in ("a", "an", "one") for word in words[:at])
        plain = alone and numbers < 2 and not _INSIDE & {*words[head:]}
        if words[head] in _SQUARES and four >= 0 and plain:
            verb = ("are",) if forming and words[at][-1] != "g" else ()
            said = [replace(tokens[at], text=word) for word in (*verb, "in", "a", "2x2", "grid")]
            return [*tokens[:at], *said, *tokens[head + 1 :]], []
        start = at - (words[at - 1] in lexicon.RELATIVES)
        start -= words[start - 1] in ("arranged", "placed", "set") and not link_at(tokens, head + 1)
        start -= words[start - 1] in lexicon.COPULAS and after.mark
        start -= words[start - 1] == "," == after.text
        begun = next((n + 1 for n in range(at - 1, -1, -1) if tokens[n].mark), 0)
        # "Three cans in a triangle": what stands so is named as well.
        said = tokens[begun if begun < start else at]
        return [*tokens[:start], *tokens[head + 1 :]], [(said, tokens[head])]
    return None


def _goes_on(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether something else is told of from token `at` on: "with a cushion", "and a table", not "and the Greeks"."""
    if tokens[at].text == "and":
        end = next(n for n in range(at, len(tokens)) if tokens[n].mark)
        return any(nouns.match([token.text]) is not None for token in tokens[at + 1 : end])
    return link_at(tokens, at) > 0 or tokens[at].text in lexicon.RELATIVES | {"with", "holding", "holds"}


def _labels(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "three bins labelled A, B and C in a row" as "three bins in a row"."""
    for at in range(2, len(words) - 3):
        if words[at] in LABELLED and nouns.match([words[at - 1]]) and (end := labels_end(tokens, at)):
            return [*tokens[:at], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None


def _in_that_order(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "on the shelf, in that order, are a vase and a cup" as "... from left to right": from where is not said."""
    for at in range(2, len(words) - 3):
        if words[at] != "in" or words[at + 1] not in ("this", "that") or words[at + 2] != "order":
            continue
        told = {"from", "left", "right", ":", "first", "top", "bottom", "row", "line", "stack", "stacked"} & {*words}
        kept = [*tokens[: at - (words[at - 1] == "," and words[at + 3] == ".")], *tokens[at + 3 :]]
        if base_verb(words[0]) == words[0]:
            # "Put the cup and the plate on the tray, in that order": in time.
            return kept, [(tokens[at], tokens[at + 2])]
        row = [] if told else [replace(tokens[at + 2], text=word) for word in ("from", "left", "to", "right")]
        return [*tokens[:at], *row, *tokens[at + 3 :]] if row else kept, [(tokens[at], tokens[at + 2])]
    return None


def _such_that(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "put three cans in a box such that the red one is on the left" without the second clause.

    So are "so that the camera cannot see it" and "so its handle points left". It may name nothing new: of "such that a
    fork lies beside it" the fork is there.
    """
    at = next((n for n in range(3, len(words) - 3) if words[n] in ("so", "such")
               and (words[n + 1] == "that" or words[n] == "so")), 0)  # fmt: skip
    if not at:
        return None
    first = at + 1 + (words[at + 1] == "that")
    its = words[first] in ("its", "their")
    turned = its or (words[first] == "the" and lexicon.PARTS & {words[first + 1], *singulars(words[first + 1])})
    hidden = words[at + 1] == "that" and (words[0] == "stack" or _UNSEEN & {*words})
    if not (words[at] == "such" or hidden or (turned and base_verb(words[0]) == words[0])):
        return None
    ends = (n for n in range(first, len(words)) if tokens[n].mark or
            (words[n] in ("and", "then") and base_verb(words[n + 1]) == words[n + 1]))  # fmt: skip
    end = next(ends) if turned else len(words) - 1
    named = {*words[:at], *lexicon.VIEWERS}
    for n in range(first + 2 * bool(turned), end):
        again = named & {words[n], words[n] + "s", *singulars(words[n])}
        again |= lexicon.PARTS & {words[n]} if turned else set()
        if words[n] in ("a", "an", "another") or (nouns.match([words[n]]) is not None and not again):
            return None
    start = at - (words[at - 1] == ",")
    return [*tokens[:start], *tokens[end:]], [(tokens[at], tokens[end - 1])]
