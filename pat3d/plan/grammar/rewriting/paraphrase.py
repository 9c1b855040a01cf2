"""Constructions in plainer words, token by token, before a sentence is cut into phrases.

"The box that the ball is in" becomes "the box with the ball in it", "a cup (red)" "a red cup", "has been put" "is put".
Every rewriting keeps the tokens' places in the prompt, so that notes and errors still quote it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.errors import PromptError
from pat3d.plan.grammar.rewriting.amounts import counted
from pat3d.plan.grammar.rewriting.commands import allowed
from pat3d.plan.grammar.rewriting.displaced import (
    by_which,
    fronted,
    in_place,
    stateless,
    which_bears,
    which_carries,
    which_last,
)
from pat3d.plan.grammar.rewriting.enumerated import alternating, enumerated
from pat3d.plan.grammar.rewriting.gapping import ungapped
from pat3d.plan.grammar.rewriting.in_colours import in_colours
from pat3d.plan.grammar.rewriting.joined_ranks import with_own_nouns
from pat3d.plan.grammar.rewriting.levels import at_levels
from pat3d.plan.grammar.rewriting.lids import lid_of, lid_on
from pat3d.plan.grammar.rewriting.open_questions import refuse_inserted, refuse_negations
from pat3d.plan.grammar.rewriting.openings import formed, opened
from pat3d.plan.grammar.rewriting.outcomes import with_articles
from pat3d.plan.grammar.rewriting.parentheses import from_parentheses
from pat3d.plan.grammar.rewriting.ranges import ranged
from pat3d.plan.grammar.rewriting.restated import EMPTIED, bare, become, covering, on_top, one_of_two, upon_it
from pat3d.plan.grammar.rewriting.several_places import in_several_places
from pat3d.plan.grammar.rewriting.shorthand import sides
from pat3d.plan.grammar.rewriting.stated import stated
from pat3d.plan.grammar.rewriting.surface_places import across_the_top, on_the_surface, stood_where
from pat3d.plan.grammar.rewriting.towers import from_below, of_things
from pat3d.plan.grammar.rewriting.wordings import reworded
from pat3d.plan.grammar.words import lexicon, postures
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.left_out import without_phrases
from pat3d.plan.grammar.words.lexicon import STANDING
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import EACH_OTHER, LINKS, SIDES, WHICH_EDGE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.shapes import of_what
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_MIDDLES = ("centre", "center", "middle")
_ITS: dict[tuple[str, str], tuple[str, ...]] = {
    **{(near, part): ("in", "the", "middle", "of") for near in ("at", "in", "on") for part in _MIDDLES},
    **{(near, part): ("at", "the", "edge", "of") for near in ("at", "on", "along", "near") for part in ("edge", "rim")},
    **{(near, "side"): ("next", "to") for near in ("at", "by")},
    ("in", "midst"): ("next", "to"),
}
"""Places of what a pronoun names, in the words of a relation."""
_STANDING = frozenset({"stand", "sit", "lie", "hang", "rest", "lean"})
_OUGHT = frozenset({"should", "must", "shall"})
_HAVING = {"contain": "contains", "hold": "holds", "have": "has", "carry": "carries"}
_WHO_HOLD = frozenset({"robot", "arm", "gripper", "hand", "agent", "you", "i", "we", "it", "they"})
"""Words before "should hold" that tell who does it."""
_SILENT = tuple(tuple(said.split()) for said in (
    "in turn", "of course", "nothing but", "nothing except for", "nothing apart from", "nothing other than",
    "nothing except", "nothing besides", "as usual", "somewhere", "anywhere", "what about", "how about",
    "and nothing else", "in that order", "any more", "so that it is", "so that it stands", "so that they are",
    "so that they stand", "seen from above", "viewed from above", "seen from the side", "seen from the front",
    "as seen from above", "nothing on it but", "nothing in it but", "nothing on it except", "nothing in it except",
))  # fmt: skip
"""Words that change nothing where they stand."""


def plainer(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence of `text` in plainer words.

    Raises:
        PromptError: the prompt says what is not there, or how many by a fraction.
    """
    tokens = sides(one_of_two(in_colours(tokens, nouns), nouns), nouns)
    tokens = at_levels(alternating(with_own_nouns(ranged(tokens, nouns), nouns), nouns), nouns)
    tokens = enumerated(text, in_several_places(of_things(from_below(tokens, nouns), nouns)), nouns)
    tokens = with_articles(allowed(without_phrases(bare(tokens, nouns), _SILENT)), nouns)
    tokens = stood_where(covering(opened(stated(on_top(upon_it(tokens), nouns)), nouns), nouns), nouns)
    tokens = counted(fronted(stateless(formed(reworded(tokens, EMPTIED)), nouns)), nouns)
    refuse_negations(tokens)
    tokens = on_the_surface(across_the_top(in_place(ungapped(tokens, nouns), nouns), nouns), nouns)
    tokens = _sides_of(_its_places(become(from_parentheses(text, tokens, nouns))), nouns)
    tokens = _beside_the_first(tokens, nouns)
    refuse_inserted(text, tokens)
    tokens = _set_off(text, _inserted(tokens))
    tokens = lid_of(lid_on(tokens), nouns)
    borne = which_last(which_carries(which_bears(_plain_words(tokens, nouns), nouns), nouns))
    return of_what(_relatives(by_which(borne, nouns), nouns))


def _inserted(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a pear and, between them, a fig" as "a pear and a fig between them"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 6):
        comma = at + 2 + link_at(tokens, at + 1) if words[at] == "and" else at
        second = next((n for n in range(comma + 3, len(words) - 2) if tokens[n].mark), 0)
        on_it = words[comma : comma + 1] == [","] and words[comma - 1] in ("it", "them") and link_at(tokens, comma + 1)
        if on_it and second and words[second] == "," and words[second + 1] in ("a", "an", "the"):
            # "and on it, next to a lamp, a clock": on it a clock next to a lamp
            end = next(n for n in range(second + 1, len(words)) if tokens[n].mark)
            if not any(link_at(tokens, n) for n in range(second + 1, end)):
                return [*tokens[:comma], *tokens[second + 1 : end], *tokens[comma + 1 : second], *tokens[end:]]
    for at in range(1, len(words) - 4):
        if words[at : at + 2] != ["and", ","]:
            continue
        if postures.is_posture(words[at + 2]) and words[at + 3] == ",":
            # "and, upside down, a glass on a tray"
            end = next(n for n in range(at + 4, len(tokens)) if tokens[n].mark or link_at(tokens, n))
            return [*tokens[: at + 1], *tokens[at + 4 : end], tokens[at + 2], *tokens[end:]]
        size = link_at(tokens, at + 2)
        side = next((n for n in range(6, 1, -1) if tuple(words[at + 2 : at + 2 + n]) in SIDES), 0)
        side *= words[at + 2 + side] == ","
        # "a mug and, at the far right, a ball that is red"
        comma = at + 2 + side if side else at + 3 + size
        pronoun = size and words[comma - 1] in ("it", "them")
        if not (side or pronoun) or words[comma] != ",":
            continue
        ends = ("that", "which") if side else ()
        end = next(n for n in range(comma + 1, len(tokens)) if tokens[n].mark or words[n] in ends)
        # "and, inside it, a bowl tied with a ribbon": the place stands before what else is said of the bowl.
        more = (n for n in range(comma + 3, end) if pronoun and words[n] != "of" and link_at(tokens, n))
        end = next((n - words[n - 1].endswith("ed") for n in more), end)
        named = tokens[comma + 1 : end]
        plain = (each.text == "of" or not link_at(named, n) for n, each in enumerate(named))
        if all(plain) and not any(each.text in STANDING or each.text == "and" for each in named):
            return [*tokens[: at + 1], *named, *tokens[at + 2 : comma], *tokens[end:]]
    return list(tokens)


def _beside_the_first(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a tray holding eggs and, next to it, a jug" as "..., and next to the tray is a jug"."""
    words = [token.text for token in tokens]
    name = next((n for n in range(1, min(4, len(words))) if nouns.match(words[n : n + 1])), 0)
    at = next((n for n in range(name + 2, len(words) - 5) if words[n : n + 2] == ["and", ","]), 0)
    it = at + 2 + link_at(tokens, at + 2) if at else 0
    opens = name and words[0] in ("a", "an", "the") and words[name + 1] in lexicon.HAVING
    link = LINKS.get(tuple(words[at + 2 : it])) if at else None
    if not opens or link is None or link.kind not in LATERAL_KINDS or words[it : it + 2] != ["it", ","]:
        return list(tokens)
    the, comma = replace(tokens[it], text="the"), replace(tokens[at], text=",", end=tokens[at].start, mark=True)
    owner = [replace(tokens[it], text=words[name]), replace(tokens[it + 1], text="is", mark=False)]
    return [*tokens[:at], comma, tokens[at], *tokens[at + 2 : it], the, *owner, *tokens[it + 2 :]]


def _set_off(text: str, tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "bearing, from left to right, a cup and a mug" as "bearing a cup and a mug from left to right".

    Raises:
        PromptError: what is set off after a relation word is no order in which things stand.
    """
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 3):
        link = LINKS.get((words[at - 1],)) if words[at] == "," else None
        opens = link is not None and link.inverse and link.manner != "include"
        # A verb that is a noun too ("bears") ends a list as well.
        opens = opens and (not link.finite or words[at - 1] in lexicon.HAVING)  # type: ignore[union-attr]
        close = next((n for n in range(at + 2, min(at + 7, len(words) - 1)) if words[n] == ","), 0)
        if not opens or not close:
            continue
        inside = tuple(words[at + 1 : close])
        stop = next(n for n in range(close, len(words)) if tokens[n].mark and words[n] not in (",", ":"))
        if inside not in EACH_OTHER:
            said = text[tokens[at + 1].start : tokens[close - 1].end]
            raise PromptError(
                f'"{said}" (word {tokens[at + 1].number}) is set off where it cannot be told what it is said of. Say '
                "it at the end, or in a sentence of its own."
            )
        return [*tokens[:at], *tokens[close + 1 : stop], *tokens[at + 1 : close], *tokens[stop:]]
    return list(tokens)


def _its_places(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "at its centre" as "in the middle of it", and "to its left a cup" as "to the left of it a cup"."""
    made: list[Token] = []
    sides = sum(one.text == "its" and two.text in ("left", "right") for one, two in pairwise(tokens))
    at = 0
    while at < len(tokens):
        words = tuple(token.text for token in tokens[at : at + 3])
        told = _ITS.get((words[0], words[2])) if len(words) == 3 and words[1] in ("its", "their") else None
        follower = tokens[min(at + 3, len(tokens) - 1)].text
        asked = base_verb(tokens[0].text) == tokens[0].text and any(link_at(tokens, n) for n in range(at - 2))
        if (asked or sides > 1) and words[1:] in (("its", "left"), ("its", "right")) and words[0] in ("to", "on", "at"):
            # "to its left a mug, to its right a lamp": both beside the same.
            # "Put the cup on the tray and the fork to its left."
            fronted = (
                (asked and follower in (".", ",", "and"))
                or follower in lexicon.DETERMINERS | lexicon.NUMBERS.keys() | STANDING
                or follower.isdecimal()
            )
            told = (words[0], "the", words[2], "of") if fronted else None
        if words[1:] in (("their", "left"), ("their", "right")) and words[0] in ("to", "on", "at"):
            # "A cup and a plate, with a spoon to their left"
            told = ("to", "the", words[2], "of")
        if told is not None:
            pronoun = "it" if words[1] == "its" else "them"
            places = (0, *(1 for _ in told[1:-1]), 1, 2) if len(told) > 1 else (0, 2)
            said = (*told, pronoun)
            made += [replace(tokens[at + place], text=word) for place, word in zip(places, said, strict=True)]
            at += 4 if {"left", "right"} & {*told} and follower == "side" else 3
        else:
            made.append(tokens[at])
            at += 1
    return made


def _sides_of(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "to the globe's left" as "to the left of the globe"."""
    words = [token.text for token in tokens]
    for at, word in enumerate(words[:-1]):
        part = next(n for n in range(at + 1, len(words)) if words[n] not in WHICH_EDGE)
        place = next((n for n in range(at - 2, max(at - 6, -1), -1) if link_at(tokens, n) == 1), -1)
        own = nouns.match([words[at - 1]]) if word == "'s" and words[part] in ("corner", "edge", "end") else None
        if own is not None and place >= 0 and nouns.of_class(own.noun, lexicon.LEVEL):
            # "In the desk's left corner"
            the, of = (replace(tokens[at + 1], text=text) for text in ("the", "of"))
            owned = [the, *tokens[at + 1 : part + 1], of, *tokens[place + 1 : at]]
            return [*tokens[: place + 1], *owned, *_sides_of(tokens[part + 1 :], nouns)]
        if word != "'s" or words[at + 1] not in ("left", "right"):
            continue
        known = nouns.match([words[at - 1]]) is not None
        leads = lexicon.DETERMINERS | lexicon.POSSESSIVES
        near = (n for n in range(at - 1, max(at - 10, -1), -1) if words[n] in ("to", "on", "at"))
        start = next((n for n in near if (known and n > at - 5) or words[n + 1] in leads), None)
        after = at + 2 + (words[at + 2] == "side")
        if start is not None:
            # "On the bottle's left side" is beside it, "on the table's left side" on it.
            owner = tokens[start + 1 : at]
            found = next((one for each in owner if (one := nouns.match([each.text])) is not None), None)
            beside = words[start] != "on" or found is None or not nouns.of_class(found.noun, lexicon.LEVEL)
            the, of = replace(tokens[at + 1], text="the"), replace(tokens[after - 1], text="of")
            to = replace(tokens[start], text="to") if beside else tokens[start]
            side = tokens[at + 1 : at + 2] if beside else tokens[at + 1 : after]
            return [*tokens[:start], to, the, *side, of, *owner, *tokens[after:]]
    return list(tokens)


def _named_alone(before: Sequence[Token], behind: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `before`, which no verb opens, ends in one thing, and `behind` is a place: "two eggs out of a carton".

    So are "two out of the five eggs" no place, nor "an egg out of twelve".
    """
    start = max((n + 1 for n, each in enumerate(before) if each.mark or each.text in ("and", "with")), default=0)
    words = [token.text for token in before[start:]]
    words = words[words[:1] != [] and words[0] in lexicon.DETERMINERS | lexicon.NUMBERS.keys() :]
    found = nouns.longest(words) if words else None
    if found is None or any(n not in found[1] and not is_modifier(word) for n, word in enumerate(words)):
        return False
    led = behind[0].text in lexicon.DETERMINERS if behind else False
    return led and behind[1].text not in (*lexicon.NUMBERS, words[-1]) and not behind[1].text.isdecimal()


def _plain_words(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "should be on" as "is on" and a bare "beside table" as a bedside table.

    With a relation there would be a determiner. The owner in "a child's desk" is no object.
    """
    plain = ("there", "here", "that", *lexicon.PRONOUNS)
    kept: list[Token] = []
    for at, token in enumerate(tokens):
        follower = tokens[min(at + 1, len(tokens) - 1)].text
        before = kept[-1].text if kept else "."
        if token.text == "both" and follower in ("the", *lexicon.POSSESSIVES) and (end := _one(tokens, at + 2, nouns)):
            # "Both the can by the box and the red jar": one can, told by the box.
            link = LINKS.get(tuple(each.text for each in tokens[end : end + link_at(tokens, end)]))
            that = ("that", "is") if link is not None and link.kind and not link.inverse else ()
            rest = [*tokens[at + 1 : end], *(replace(tokens[end], text=word) for word in that), *tokens[end:]]
            return [*kept, *_plain_words(rest, nouns)]
        verb = before in ("is", "are", "was", "were")
        if token.text == "out" and follower == "of" and (verb or _named_alone(kept, tokens[at + 2 :], nouns)):
            # "The dog is out of the box", "an apple out of a bowl": not in it.
            kept.append(replace(token, text="outside"))
            continue
        if token.text == "present" and (verb or (nouns.match([before]) and not is_modifier(before))):
            behind = tokens[at + 1]
            if behind.mark or behind.text == "and" or link_at(tokens, at + 1):
                # "A cup is present on the table": no gift is there.
                token = replace(token, text="visible")
        found = nouns.match([before]) if token.text in ("fruit", "fruits") and not is_colour_word(before) else None
        if found is not None and found.noun in lexicon.GENERICS["fruit"]:
            # "A green apple fruit" is an apple.
            continue
        # "A can stand", "a soda can stand" is of a can.
        subject = before not in (".", ",") and before not in lexicon.DETERMINERS | lexicon.NUMBERS.keys()
        subject = subject and not is_modifier(before) and not nouns.match([before, token.text])
        if token.text in lexicon.MODALS and (follower == "be" or (follower in _STANDING and subject)):
            continue
        if token.text in _STANDING and at and tokens[at - 1].text in lexicon.MODALS and not singulars(before):
            # "A clock should stand on a shelf" is of no clock stand.
            token = replace(token, text=f"{token.text}s")
        if token.text in _OUGHT and follower in _HAVING and before not in _WHO_HOLD:
            # "The left bowl should contain an egg."
            continue
        if token.text in _HAVING and at > 1 and tokens[at - 1].text in _OUGHT and tokens[at - 2].text not in _WHO_HOLD:
            token = replace(token, text=_HAVING[token.text])
        if token.text == "'s" and before not in plain and not nouns.match([before]):
            kept.pop()
            continue
        beside = token.text == "beside" and follower in ("table", "tables", "lamp", "lamps")
        if beside and before in (",", "and", "a") and nouns.match(["bedside", "table"]):
            token = replace(token, text="bedside")
        kept.append(token)
    return kept


def _one(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """Where "can" or "red can" from token `at` on ends, which is one thing, told more of before an "and"; 0 without."""
    words = [token.text for token in tokens]
    spans = [(n, n + size) for n in range(at, min(at + 4, len(words) - 1)) for size in (3, 2, 1)]
    named = (words[start:end] for start, end in spans)
    known = (bool(nouns.match(each)) or (len(each) == 1 and each[0] in lexicon.SUBSTANCES) for each in named)
    start, end = next((span for span, one in zip(spans, known, strict=True) if one), (0, 0))
    found = nouns.match(words[start:end])
    told = "and" in words[end + 1 :] and words[end] != "and" and not tokens[end].mark
    return end * (told and not (found is not None and found.plural))


def _relatives(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the box that the ball is in" as "the box with the ball in it"."""
    made = list(tokens)
    at = 1
    while at < len(made) - 4:
        opener = made[at].text in ("that", "which")
        start = at + 1 if opener else at
        known = nouns.match([made[at - 1].text]) is not None
        if known and made[start].text in ("the", "a", "an") and (found := _gap(made, start, nouns)):
            verb, link, end = found
            told = [
                replace(made[at], text="with"),
                *made[start:verb],
                *made[link:end],
                replace(made[end - 1], text="it"),
            ]
            made[at:end] = told
            at += len(told)
        else:
            at += 1
    return made


def _gap(tokens: Sequence[Token], start: int, nouns: Nouns) -> tuple[int, int, int] | None:
    """Verb, relation and end of "the ball is in" at token `start`, behind which a clause goes on; or None."""
    verb = next((n for n in range(start + 2, min(start + 5, len(tokens) - 2)) if tokens[n].text in STANDING), None)
    if verb is None or any(each.mark or each.text in ("and", "with", "of") for each in tokens[start:verb]):
        return None
    if not nouns.match([tokens[verb - 1].text]) or any(link_at(tokens, n) for n in range(start, verb)):
        return None
    link = verb + 1 + (tokens[verb + 1].text in lexicon.PARTICIPLES)
    size = link_at(tokens, link)
    after = tokens[min(link + size, len(tokens) - 1)]
    goes_on = after.mark or after.text in STANDING or after.text in ("holds", "contains", "has", "into", "onto", "and")
    return (verb, link, link + size) if size and goes_on else None
