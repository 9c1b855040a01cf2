"""Other ways to write what is read: "lap top", "all of the cups", "near by", "a cut in half orange", "you can see"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

from pat3d.assets.materials import find_material
from pat3d.plan.grammar.rewriting.named_like_colours import with_their_amount
from pat3d.plan.grammar.rewriting.of_material import made_of
from pat3d.plan.grammar.rewriting.respectively import respectively
from pat3d.plan.grammar.rewriting.wordings import reworded, wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.unmade import base_verb, is_no_noun
from pat3d.plan.grammar.words.vocabulary import Nouns

_COLOUR = ("color", "colour", "hue")
_USUAL = """
all of the/these/those/my/your/our/his/her = all 1
they are both/all = 1 are
all of it = it
near by = nearby
has been = is
have/had been = are
off center/centre on/in/at = 2
in the side of = at the side of
a group/cluster/set/combination containing/comprising =
a group/cluster/set/combination consisting/composed of =
a group/cluster/set/combination made up of =
in side the = inside the
get rid of = discard
top up/off the/a/an/my/your = fill 2
get/take a grip on = grasp
get/take a firm/good/tight/secure grip on = grasp
you find/see in/on/under/behind/inside/beside/near = 2
piece/scrap/slip of paper = sheet of paper
pieces/scraps/slips of paper = sheets of paper
not far from = near
not far away from = near
the near left/right/corner/edge/side/end = the front 1
in/on there = 1 it
compose a/an = create 1
with missing = without
hang next/beside/above/over/under/below/behind/near = hangs 1
all stand on/in/near/next = all are 1
there appears/appear/seems/seem/happens to be = there is
the same size/height/length/width as = as big as
in/with different colors/colours = of different 2
each in/of/with a different color/colour = of different colors
that/which include/includes = including
a bit/little closer/nearer/further/away = 2
all set together = together
is/are laid/spread/set/stretched out = 1
laid/spread/stretched out = placed
lies/lie/lying/lay flat = 1
full with = full of
flat on/onto/in = 1
what contains/has/holds/is/stands/lies = that 1
midway/halfway/exactly between = between
between neighbours/neighbors = apart
whichever is = the one
that stands/is/lies farthest/furthest left/right = that is 3most
look/search for the/a/an = find 2
toss/throw/chuck in a/an/some/one/two/three/four/five/six = create 2
take it/them out again = take 1 out
serves/acts/doubles as a table/stand/base/pedestal/shelf/tray/plate/support/seat/platform/holder for = carries
serving/acting/used as a table/stand/base/pedestal/shelf/tray/plate/support/seat/platform/holder for = carrying
the outer ones/two/pair are/have/hold/stand = the first and last 2
the two outer ones are/have/hold/stand = the first and last 1
atleast = at least
atmost = at most
with no = without
with not a single = without a
pan/panning shot = shot
the one below holds/contains/has/is = the lower one 1
at/on its left/right end/half = on the 2 side of it
alone on/in/at = 1
compete/vie for attention/space = stand
flush to the floor/ground = on the 1
flush to/with/against the wall = against the wall
over there/here =
bridges/bridge the gap between = bridges
bridging the gap between = bridging
you/i/we/one can/could see = there are
you/i/we see = there are
you find = there are
there isn't/aren't/wasn't/weren't a/an/any = there is no
there is/are not a/an/any = there is no
propped open on/against/in/at = placed 1
take/get/grab/catch/lay hold of = grasp
i'd/id/we'd/would appreciate if you = you
i'd/id/we'd/would appreciate it if you = you
you/one can/could/will find/notice/spot = there are
you'll/we find/notice/spot = there are
you notice/spot = there are
you'll see = there are
you will see = there are
one finds/sees/notices = there are
"""
"""What is said = what is read; "a/b" is either word, and "1" the word that was said of the first such choice."""


def _written_out(line: str) -> Iterator[tuple[tuple[str, ...], tuple[str, ...]]]:
    said, _, plain = line.partition(" =")
    choices = [word.split("/") for word in said.split()]
    for words in product(*choices):
        chosen = [word for word, choice in zip(words, choices, strict=True) if len(choice) > 1]
        yield words, tuple(re.sub(r"\d", lambda at, of=chosen: of[int(at[0]) - 1], word) for word in plain.split())


_PLAINER = dict(pair for line in _USUAL.strip().splitlines() for pair in _written_out(line))
"""What is said, and the words instead."""
_VARIED = frozenset({"different", "various", "varying", "assorted", "mixed"})
_PAPER, _SHEETS = "stack of paper", frozenset({"paper", "parchment", "paperwork", "manuscripts", "sheets"})
_OPENINGS = (("one", "after", "the", "other", ":"), ("one", "by", "one", ":"), ("in", "two", "steps", ":"))
_ASKING = r"(?:(?:could|can|would|will|you|please|kindly) )*"
_BEGINNINGS = wordings((
    (rf"(?<!. )({_ASKING})(?:set up|put together) (?!(?:{'|'.join(lexicon.DEFINITE)}) )", r"\1 create"),
    # "Don't use a tray": there is none.
    (r"(?<!. )(?:do not|don't|never) (?:use|add) (?:a|an|any) ((?:(?!to )[^ ,]+ )+)(?=\. )", r"there is no \1"),
    (r"([^ ]+ [^ ]+ [^ ]+ )after (?:that|this) (?=\. )", r"\1"),
))  # fmt: skip
_PARTICLES = frozenset({"on", "off", "up", "down", "out", "open", "over", "in", "away"})
_CUT = frozenset({"cut", "split", "torn", "broken", "blown", "worn", "shut", "spread", "swept"})
_SIDES = frozenset({"on", "at", "to", "by", "from"})


def varied(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence in the usual words."""
    usual = _papers(_many_coloured(_plain(_alike(_hued(_begun(tokens)), nouns)), nouns), nouns)
    tokens = respectively(_compared(usual, nouns))
    return with_their_amount(made_of(_seasoned(_one_adjective(_one_word(tokens, nouns), nouns)), nouns), nouns)


def _begun(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "one after the other: put the cup away" as "put the cup away", "set up a desk" as "create ..."."""
    tokens = reworded(tokens, _BEGINNINGS)
    words = [token.text for token in tokens]
    opening = next((said for said in _OPENINGS if tuple(words[: len(said)]) == said), ())
    told = len(words) > 6 and "and" in words and base_verb(words[0]) == words[0]
    if told and words[-2] == "that" and link_at(tokens, len(words) - 3):
        # "Put the mat on the desk and the cup on that": on what is put there.
        return [*tokens[:-2], replace(tokens[-2], text="it"), tokens[-1]]
    return tokens[len(opening) :] if opening and base_verb(words[len(opening)]) == words[len(opening)] else tokens


def _hued(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "is red in color", "has a red color" as "is red", "of a red color" as "that is red"."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 4]]
        if words[:1] == ["in"] and words[1:2] and words[1] in _COLOUR and made and is_colour_word(made[-1].text):
            at += 2
            continue
        led = at + (words[0] in ("a", "an"))
        stops = (n for n in range(led, len(tokens)) if not (is_modifier(tokens[n].text) or tokens[n].text == "and"))
        end = next(stops, led)
        end -= led < end and tokens[end - 1].text == "and"
        before, behind = [token.text for token in made[-2:]], [token.text for token in tokens[end : end + 2]]
        coloured = led < end and is_colour_word(tokens[end - 1].text) and not find_material(tokens[end - 1].text)
        if coloured and before[1:] == [","] and singulars(before[0]) and behind[:1] == [","] and {*behind} & FINITE:
            # "The pears, a deep green, are ripe": no pear is one of them.
            name = made[-2]
            look = (each for each in tokens[led:end] if each.text != "and")
            made[-2:] = [*(replace(each, start=name.start, end=name.start) for each in look), name]
            at = end + 1
            continue
        ended = behind[:1] in (["and"], ["but"], ["while"]) or tokens[min(end, len(tokens) - 1)].mark
        if coloured and at < led < end - 1 and {*before[-1:]} & lexicon.COPULAS and ended:
            at = led  # "It is a bright yellow."
            continue
        whole = len(words) == 4 and words[1] == "a" and is_colour_word(words[2]) and words[3] in _COLOUR
        if whole and words[0] in ("has", "have", "of", "with"):
            joint = () if words[0] in ("has", "have") else (replace(tokens[at], text="that"),)
            made += [*joint, replace(tokens[at], text="is"), replace(tokens[at + 2], end=tokens[at + 3].end)]
            at += 4
            continue
        made.append(tokens[at])
        at += 1
    return made


def _many_coloured(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "pens of different colours" as "different coloured pens"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 3):
        listed = words[at + 2] not in ("colors", "colours") or words[at + 3] in ("(", ":")
        # "Four cups, each of a different colour, stand on a tray"
        end = at - (words[at - 1] == ",")
        sizes = (n for n in (3, 2, 1) if n <= end and (found := nouns.match(words[end - n : end])) and found.plural)
        if words[at] != "of" or words[at + 1] not in _VARIED or listed or not (name := next(sizes, 0)):
            continue
        first, rest = tokens[end - name], at + 3 + (end < at and words[at + 3] == ",")
        look = [replace(first, text=word, end=first.start) for word in ("different", "colored")]
        named = [*tokens[end - name : end - 1], replace(tokens[end - 1], end=tokens[at + 2].end)]
        return [*tokens[: end - name], *look, *named, *tokens[rest:]]
    return tokens


def _alike(tokens: Sequence[Token], nouns: Nouns) -> Sequence[Token]:
    """`tokens` with "the plate is a blue plate" and "the plate is a blue one" as "the plate is blue"."""
    words = [token.text for token in tokens]
    verb = words.index("is") if "is" in words else 0
    said = tokens[verb + 2 : -2]
    one_colour = len(said) == 1 and is_colour_word(said[0].text)
    if verb < 2 or words[0] != "the" or words[verb + 1] not in ("a", "an") or not one_colour:
        return tokens
    head = next(n for n in range(1, verb + 1) if n == verb or link_at(tokens, n)) - 1
    same = nouns.match([words[head]]) is not None and words[-2] in (words[head], "one")
    return [*tokens[: verb + 1], replace(said[0], end=tokens[-2].end), tokens[-1]] if same else tokens


def _papers(tokens: Sequence[Token], nouns: Nouns) -> Sequence[Token]:
    """`tokens` with "a stack of parchment", "a pile of white sheets" as "a stack of paper", "a white pile of paper"."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 4, -1, -1):
        stack = {words[at], *singulars(words[at])} & lexicon.STACK_NOUNS and words[at + 1] == "of"
        head = next((n for n in range(at + 2, min(at + 7, len(words))) if stack and _is_paper(words, n, nouns)), 0)
        if head and not {*words[at + 2 : head]} & {*lexicon.LEADING, *FINITE, "and", ","}:
            said = [token for token in tokens[at + 2 : head] if token.text not in _SHEETS | {"of"}]
            looks = [token for token in said if is_modifier(token.text) or not nouns.match([token.text])]
            pile = words[at] if nouns.match([words[at], "of", "paper"]) else "pile"
            paper = replace(tokens[head], text="paper", start=tokens[at + 2].start)
            tokens = [*tokens[:at], *looks, replace(tokens[at], text=pile), tokens[at + 1], paper, *tokens[head + 1 :]]
    return tokens


def _is_paper(words: Sequence[str], at: int, nouns: Nouns) -> bool:
    """Whether the name at `at` ends there and is of sheets: "documents", but no "paper plates", no "toilet paper"."""
    spans = (words[at : at + 1], words[at - 1 : at + 1], words[at : at + 2])
    own, before, after = ((found := nouns.match(each)) and found.noun for each in spans)
    whole = before in (None, _PAPER) or words[at - 1] == "parchment"
    return (own == _PAPER or words[at] in _SHEETS) and whole and not after and words[at + 1] != "of"


def _compared(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a box taller than the jar next to it" as "a box that is taller than the jar next to it"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        higher = token.text in lexicon.SUPERLATIVES and not token.text.endswith("est") and tokens[at + 1].text == "than"
        set_off = bool(made) and made[-1].text == ","
        before = made[-1 - set_off].text if len(made) > set_off else ""
        if higher and nouns.match([before]) and tokens[at + 2].text in lexicon.DETERMINERS:
            made = [*made[: len(made) - set_off], replace(token, text="that"), replace(token, text="is")]
        made.append(token)
    return made


def _seasoned(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "salt and pepper" as "a salt shaker and a pepper shaker"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 2) if words[n] == "salt" and "pepper" in words[n + 1 : n + 4]), -1)
    pepper = words.index("pepper", at) if at >= 0 else 0
    between = set(words[at + 1 : pepper]) <= {",", "and", "the"}
    if at < 0 or not between or words[pepper + 1].startswith(("shaker", "mill", "pot", "cellar", "grinder")):
        return list(tokens)
    if at and words[at - 1] in ("of", "with", "some"):
        return list(tokens)
    made: list[Token] = []
    for n, token in enumerate(tokens):
        named = n in (at, pepper)
        if named and (not n or words[n - 1] not in lexicon.DETERMINERS):
            made.append(replace(token, text="a"))
        made += [token, replace(token, text="shaker")] if named else [token]
    return made


def _plain(tokens: Sequence[Token]) -> list[Token]:
    wherever = tokens[0].text == "wherever" and not any(token.text == ":" for token in tokens)
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = tuple(token.text for token in tokens[at : at + 5])
        if words[:2] == ("there", "is") and made and wherever:
            # "Wherever there is a plate there is also a fork on it."
            made.append(replace(tokens[at], text="has"))
            at += 2 + (words[2] == "also")
            continue
        size = (
            0
            if words[:1] == ("wherever",) and not wherever
            else next((n for n in (5, 4, 3, 2, 1) if words[:n] in _PLAINER), 0)
        )
        told = _PLAINER[words[:size]] if size else ()
        follower = tokens[min(at + size, len(tokens) - 1)].text
        leads = follower in lexicon.DETERMINERS | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
        if size and told == ("there", "are") and not (made and leads and made[-1].text not in ("that", "which", "as")):
            size = 0
        if size:
            whole = replace(tokens[at], end=tokens[at + size - 1].end)
            made += [replace(whole, text=word) for word in told]
            at += size
            continue
        before = made[-1].text if made else ""
        if words[:3] in (("either", "side", "of"), ("each", "side", "of")) and before not in _SIDES:
            # "A lamp stands either side of the bed."
            made.append(replace(tokens[at], text="on"))
        if words[:4] == ("left", "and", "right", "of") and before != "the":
            made += [replace(tokens[at], text="to"), replace(tokens[at], text="the")]
        made.append(tokens[at])
        if (
            words[0] == "next"
            and words[1] in ("the", "a", "an")
            and before
            and before not in lexicon.DETERMINERS | {","}
        ):
            # "next the lamp"
            made.append(replace(tokens[at], text="to"))
        at += 1
    return made


def _one_word(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "lap top" and "pan cakes" as one word, where that names a thing and the two words do not."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        one, two = tokens[at], tokens[min(at + 1, len(tokens) - 1)]
        long = min(len(one.text), len(two.text)) > 2 and one.text.isalpha() and two.text.isalpha()
        joined = long and not (is_modifier(one.text) or is_no_noun(one.text) or link_at(tokens, at + 1))
        joined = joined and not _stands(tokens, at + 1)
        if joined and nouns.match([one.text + two.text]) and not nouns.match([one.text, two.text]):
            made.append(replace(one, text=one.text + two.text, end=two.end))
            at += 1
        else:
            made.append(one)
        at += 1
    return made


def _stands(tokens: Sequence[Token], at: int) -> bool:
    """Whether "stands" at token `at` is a verb: "a hat stands on a desk", "a box and a hat stand on a desk"."""
    words = [token.text for token in tokens]
    if words[min(at, len(words) - 1)] not in ("stand", "stands"):
        return False
    told = link_at(tokens, at + 1) > 0 or ("which" in words[:at] and tokens[at + 1].mark)
    return told and (words[at] == "stands" or "and" in words[:at] or bool(singulars(words[at - 1])))


def _one_adjective(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a cut in half orange" as "a cut-in-half orange", "a turned off lamp" as "a turned-off lamp"."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        word, end = tokens[at].text, at + 1
        led = at and tokens[at - 1].text in lexicon.DETERMINERS | lexicon.NUMBERS.keys()
        after = tokens[min(at + 2, len(tokens) - 1)]
        whole = after.mark or is_modifier(after.text) or nouns.match([after.text])
        state = tokens[end].text if word == "half" and whole else ""
        if state.endswith(("ed", "en")) and state != "open" and base_verb(state):
            end += 1
            made.append(replace(tokens[at], text=f"half-{tokens[end - 1].text}", end=tokens[end - 1].end))
            at = end
            continue
        if led and (word in _CUT or (word.endswith("ed") and base_verb(word))) and not nouns.match([word]):
            words = [token.text for token in tokens[at + 1 : at + 3]]
            if words[:1] in (["in"], ["into"]) and words[1] in lexicon.CUT_INTO:
                end = at + 3
            elif words[0] in _PARTICLES:
                end = at + 2
        told = tokens[end].text if end < len(tokens) else "."
        if end > at + 1 and (is_modifier(told) or nouns.match([told])):
            made.append(
                replace(tokens[at], text="-".join(token.text for token in tokens[at:end]), end=tokens[end - 1].end)
            )
            at = end
        else:
            made.append(tokens[at])
            at += 1
    return made
