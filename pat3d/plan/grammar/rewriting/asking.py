"""Requests in the words of an instruction, one sentence after another.

"Would you mind putting the cup on the tray" becomes "put the cup on the tray", "take the top cup from the stack of
cups" becomes "there is a stack of cups, take the top cup", and "put everything but the cup in the box" "the cup, put
everything else in the box".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.rewriting.own_colours import in_one_way
from pat3d.plan.grammar.rewriting.taken_from import from_where, stack_of
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import LINKS
from pat3d.plan.grammar.words.measures import is_measure
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_LEADS = lexicon.DETERMINERS | lexicon.POSSESSIVES
_GREETING = lexicon.GREETINGS | {"there", "good", "morning"}
_POLITE = tuple(sorted((tuple(said.split()) for said in (
    "would you mind", "do you mind", "would it be possible to", "would it be possible for you to", "is it possible to",
    "i'd like you to", "i would like you to", "i'd love you to", "i need you to", "we need you to", "i ask you to",
    "do you think you could", "do you think you can", "could i ask you to", "may i ask you to", "can i ask you to",
    "be so kind as to", "please be so kind as to", "would you be so kind as to", "i was wondering if you could",
    "it would be great if you could", "it would be nice if you could", "it would be helpful if you could",
    "i would appreciate it if you could", "i'd appreciate it if you could", "i'd be grateful if you could",
    "would you be able to", "are you able to", "please assist me by", "assist me by", "help me by", "please help me by",
    "don't forget to", "remember to", "go ahead and", "feel free to", "try to", "you may", "you can", "you could",
    "your job is to", "you are to", "you will", "i'd like to have you", "how to", "show me how to", "tell me how to",
    "what is the best way to", "what's the best way to", "can you show me how to", "how about",
    *(f"how {do} {who}" for do in ("do", "would", "can", "could", "should") for who in ("you", "i", "we", "one")),
)), key=len, reverse=True))  # fmt: skip
"""What an instruction begins with and is none of it."""
_ABLE = frozenset({"can", "could", "may", "might"})
_TAKING = frozenset(
    {"take", "remove", "pick", "grab", "get", "lift", "grasp", "fetch", "move", "bring", "put", "place"}
)
_SAVING = frozenset({"except", "excluding", "but", "save", "apart"})
_INTO = frozenset({"lower", "tidy", "clear", "scoop"})
"""Deeds by which something is put in or on what is said behind."""
_PILES = frozenset({"stack", "pile", "tower", "column"})
_RANKS = lexicon.LEVELS.keys() | {"middle", "second", "third"}
_FROM = (("from", "the", "top", "of"), ("off", "the", "top", "of"), ("off", "of"), ("out", "of"), ("from",), ("off",),
         ("of",), ("in",))  # fmt: skip
_STANDS = frozenset({"on", "in", "next", "behind", "beside", "near", "under", "at", "inside"})
_ENDING = frozenset({"and", "then", "to", "onto", "into"})
_EVERY = (("all", "of", "them"), ("all", "of", "these"), ("everything",), ("anything",), ("all",))
_BUT = (("except", "for"), ("apart", "from"), ("other", "than"), ("but", "for"), ("save", "for"), ("but", "not"),
        ("except",), ("but",), ("save",), ("excluding",))  # fmt: skip
_LEAVING = frozenset({"from", "off", "out", "of", "with"})
"""Words from where something is, or with what."""
_HELD = frozenset({"lean", "hang"})
_NEAR = frozenset({"nearest", "closest", "nearer", "closer", "furthest", "farthest", "next", "close"})
_VIEWED = frozenset({"you", "me", "yourself", "us"})


def plainly_asked(told: list[list[Token]], nouns: Nouns) -> list[list[Token]]:
    """The sentences `told` with what is asked as an instruction, and what that takes for granted before it."""
    made: list[list[Token]] = []
    for sentence in told:
        told_before = [token.text for each in made for token in each]
        there = _another(sentence, told_before, nouns)
        whole = _before_that(_stripped(_that_is(there, told_before)))
        made += _plainly(from_where(_by_the_robot(stack_of(whole)), nouns), told_before)
    return made


def _plainly(sentence: list[Token], before: Sequence[str]) -> list[list[Token]]:
    """What is asked with `sentence`, behind sentences with the words `before`."""
    plain = in_one_way(sentence) if base_verb(sentence[0].text) == sentence[0].text else sentence
    plain = _inside(_so_that(_let(_got(_lowered(_cleared(_emptied(_politely(plain))))))))
    return [one for each in _from_stack(plain, piled=bool(_PILES & {*before})) for one in _all_but(each)]


def _by_the_robot(sentence: list[Token]) -> list[Token]:
    """Read "put the jar nearest to you on the shelf" as "... nearest to the robot": it is told what to do."""
    words = [token.text for token in sentence]
    asked = known_verb(words[int(words[0] == "please")])
    at = next((n for n in range(2, len(words) - 2) if words[n] == "to" and words[n - 1] in _NEAR
               and words[n + 1] in _VIEWED), 0)  # fmt: skip
    if not asked or not at:
        return sentence
    robot = [replace(sentence[at + 1], text=word) for word in ("the", "robot")]
    return [*sentence[: at + 1], *robot, *sentence[at + 2 :]]


def _politely(sentence: list[Token]) -> list[Token]:
    """Read "hey, would you mind putting it back" as "put it back", "put it back please" without the last word."""
    words = [token.text for token in sentence]
    if len(words) > 3 and words[-2] == "please" and not sentence[-3].mark:
        sentence = [*sentence[:-2], sentence[-1]]
        words = [token.text for token in sentence]
    at = next((n + 1 for n in range(min(4, len(words))) if words[n] == "," and {*words[:n]} <= _GREETING), 0)
    at = at if at and words[0] != "there" else 0
    at += words[at : at + 1] == ["please"]
    size = next((len(said) for said in _POLITE if tuple(words[at : at + len(said)]) == said), 0)
    verb = at + size + (words[at + size : at + size + 1] == ["please"])
    base = base_verb(words[verb]) if verb < len(words) - 2 else None
    if size and base is not None and (words[verb] == base or words[verb].endswith("ing")):
        return [replace(sentence[verb], text=base, start=sentence[0].start), *sentence[verb + 1 :]]
    asks = at and not size and (base is not None or words[at] in _ABLE | {"would", "will", "let", "i", "we"})
    if not asks or at > len(words) - 3:
        return sentence
    return [replace(sentence[at], start=sentence[0].start), *sentence[at + 1 :]]


def _inside(sentence: list[Token]) -> list[Token]:
    """Read "put both of them in" as "put both of them inside"."""
    words = [token.text for token in sentence]
    last = len(words) - 2
    if words[0] not in _TAKING or last < 2 or words[last] != "in":
        return sentence
    return [*sentence[:last], replace(sentence[last], text="inside"), sentence[-1]]


def _emptied(sentence: list[Token]) -> list[Token]:
    """Read "take everything out of the box and lay it on the desk" as "empty the box onto the desk"."""
    words = [token.text for token in sentence]
    if words[0] not in _TAKING - {"put", "place"} or words[1] not in ("everything", "all"):
        return sentence
    size = 2 if words[2:4] in (["out", "of"], ["off", "of"]) else 1 if words[2] in ("from", "off") else 0
    end = next(
        (n for n in range(2 + size, len(words)) if sentence[n].mark or words[n] in ("and", "then", "to", "onto")), 0
    )
    if not size or words[2 + size] not in _LEADS or not end or {"except", "but"} & {*words}:
        return sentence
    if words[end] in ("to", "onto"):
        # "Move everything from the desk to the box": each of it goes there.
        return sentence
    empty, rest = replace(sentence[0], text="empty", end=sentence[1 + size].end), list(sentence[end:])
    put = [token.text for token in rest[:4]]
    laid = put[0] in ("and", "then") and base_verb(put[1]) == put[1] and put[2] in ("it", "them", "everything")
    if laid and link_at(rest, 3):
        onto = {"on": "onto", "in": "into"}.get(put[3], put[3])
        rest = [replace(rest[3], text=onto), *rest[3 + 1 :]]
    return [empty, *sentence[2 + size : end], *rest]


def _lowered(sentence: list[Token]) -> list[Token]:
    """Read "lower the lid onto the pot" as "put the lid onto the pot", "scoop up the dice" as "pick up the dice"."""
    words = [token.text for token in sentence]
    if words[:2] == ["scoop", "up"]:
        return [replace(sentence[0], text="pick"), *sentence[1:]]
    for at in range(len(words) - 4):
        opens = not at or sentence[at - 1].mark or words[at - 1] in ("and", "then", "please")
        opens = opens or words[at - 1].endswith("ly")
        if words[at] in _INTO and opens and words[at + 1] in _LEADS | {"it", "them"}:
            ends = (n for n in range(at + 2, len(words)) if link_at(sentence, n) or words[n] in (".", ":"))
            if words[next(ends)] in ("in", "into", "on", "onto"):
                return [*sentence[:at], replace(sentence[at], text="put"), *sentence[at + 1 :]]
    return sentence


def _cleared(sentence: list[Token]) -> list[Token]:
    """Read "clear the table by putting the cups on the tray" as "put the cups from the table on the tray"."""
    words = [token.text for token in sentence]
    by = words.index("by") if words[0] in ("clear", "empty") and "by" in words[2:6] else 0
    verb = base_verb(words[by + 1]) if by and words[by + 1].endswith("ing") else None
    ends = (n for n in range(by + 3, len(words) - 2) if words[n] in (".", ":") or link_at(sentence, n))
    to = next(ends, 0)
    if verb not in _TAKING or words[1] not in _LEADS or not to or sentence[to].mark:
        return sentence
    put, source = replace(sentence[0], text=verb), replace(sentence[0], text="from")
    return [put, *sentence[by + 2 : to], source, *sentence[1:by], *sentence[to:]]


def _got(sentence: list[Token]) -> list[Token]:
    """Read "get it next to the bowl" as "move it next to the bowl": by no place it is told what "it" is."""
    words = [token.text for token in sentence]
    for at in range(len(words) - 4):
        opens = not at or sentence[at - 1].mark or words[at - 1] in ("and", "then", "please")
        if words[at] != "get" or not opens or words[at + 1] not in ("it", "them"):
            continue
        there = link_at(sentence, at + 2) and words[at + 2] not in _LEAVING
        if there or is_measure(words[at + 2]) or words[at + 2].isdecimal():
            return [*sentence[:at], replace(sentence[at], text="move"), *sentence[at + 1 :]]
    return sentence


def _another(sentence: list[Token], before: Sequence[str], nouns: Nouns) -> list[Token]:
    """Read "put the one on the plate in the box" as "... the egg that is ...", where `before` tell of another egg."""
    words = [token.text for token in sentence]
    names = [before[n + 1 : n + 3] for n, word in enumerate(before[:-1]) if word == "another"]
    names = [name if nouns.match(name) else name[:1] for name in names]
    if len(names) != 1 or nouns.match(names[0]) is None or base_verb(words[0]) != words[0]:
        return sentence
    for at in range(1, len(words) - 4):
        that = at + 2
        that += 2 * (words[that : that + 2] in (["that", "is"], ["which", "is"]))
        if words[at : at + 2] == ["the", "one"] and words[that] in ("on", "in") and words[that + 1] == "the":
            said = [replace(sentence[at + 1], text=word) for word in (*names[0], "that", "is")]
            return [*sentence[: at + 1], *said, *sentence[that:]]
    return sentence


def _that_is(sentence: list[Token], before: Sequence[str]) -> list[Token]:
    """Read "pick up the one that is next to the hat" as "pick up the one next to the hat".

    So is "the cup that is next to the hat", where the words `before` tell of several cups.
    """
    words = [token.text for token in sentence]
    for at in range(2, len(words) - 3):
        if words[at] not in ("that", "which") or words[at + 1] not in ("is", "are") or not link_at(sentence, at + 2):
            continue
        link = LINKS.get(tuple(words[at + 2 : at + 2 + link_at(sentence, at + 2)]))
        beside = link is not None and link.kind in LATERAL_KINDS
        told = words[at - 1] in ("one", "ones") and words[at - 2] == "the"
        # "Put the potato on the napkin in the box" would put it on the napkin.
        several = beside and before.count(words[at - 1]) > 1 and base_verb(words[0]) == words[0]
        if told or several:
            return _that_is([*sentence[:at], *sentence[at + 2 :]], before)
    return sentence


def _stripped(sentence: list[Token]) -> list[Token]:
    """Read "strip the bed of its pillows" as "remove the pillows from the bed"."""
    words = [token.text for token in sentence]
    of = words.index("of") if words[0] in ("strip", "clear", "rid") and "of" in words[2:] else 0
    end = next((n for n in range(of, len(words)) if sentence[n].mark or words[n] in _SAVING), len(words))
    if not of or words[1] not in _LEADS or words[of + 1] not in _LEADS | lexicon.POSSESSIVES:
        return sentence
    remove, source = replace(sentence[0], text="remove"), replace(sentence[of], text="from")
    the = replace(sentence[of + 1], text="the")
    return [remove, the, *sentence[of + 2 : end], source, *sentence[1:of], *sentence[end:]]


def _before_that(sentence: list[Token]) -> list[Token]:
    """Read "before you put the fig in the box, ..." as "before putting the fig in the box, ...": not there yet."""
    words = [token.text for token in sentence]
    deed = words[:2] == ["before", "you"] and len(words) > 4 and base_verb(words[2]) == words[2]
    return [sentence[0], *sentence[2:]] if deed and words[3] in _LEADS else sentence


def _let(sentence: list[Token]) -> list[Token]:
    """Read "let the ball roll into the bucket" as "roll the ball into the bucket"."""
    words = [token.text for token in sentence]
    if words[0] != "let" or words[1] not in _LEADS or words[2] in ("robot", "arm", "gripper"):
        return sentence
    verb = next((n for n in range(3, min(6, len(words) - 2)) if base_verb(words[n]) == words[n]), 0)
    if not verb or any(token.mark or link_at(sentence, n) for n, token in enumerate(sentence[:verb])):
        return sentence
    if not link_at(sentence, verb + 1):
        return sentence
    return [replace(sentence[verb], start=sentence[0].start), *sentence[1:verb], *sentence[verb + 1 :]]


def _so_that(sentence: list[Token]) -> list[Token]:
    """Read "place the book so that it leans against the vase" as "lean it against the vase", "lies" as "place"."""
    words = [token.text for token in sentence]
    at = next((n for n in range(3, len(words) - 4) if words[n] in ("so", "such")), 0)
    it = at + 1 + (words[at + 1] == "that") if at else 0
    if not at or base_verb(words[0]) != words[0] or words[1] not in _LEADS or words[it] not in ("it", "they"):
        return sentence
    base = base_verb(words[it + 1])
    plain = not any(token.mark or link_at(sentence, n) for n, token in enumerate(sentence[:at]))
    if not link_at(sentence, it + 2) or not ((base in _HELD and plain) or words[it + 1] in lexicon.STANDING):
        return sentence
    verb = replace(sentence[0], text=base) if base in _HELD else sentence[0]
    comma = [] if plain else [replace(sentence[at], text=",", mark=True)]
    return [verb, *sentence[1:at], *comma, *sentence[it + 2 :]]


def _from_stack(sentence: list[Token], *, piled: bool) -> list[list[Token]]:
    """Tell "take the top cup from the stack of cups" as "there is a stack of cups", "take the top cup".

    Args:
        sentence: ends in a stop.
        piled: whether a stack was told of before, so that it is that.
    """
    words = [token.text for token in sentence]
    verb = 1 if words[0] == "please" else 0
    for at in range(verb + 1, len(words) - 4) if words[verb] in _TAKING else ():
        ranked = words[at] == "the" and words[at + 1] in _RANKS
        link = at + 3
        size = next((len(said) for said in _FROM if ranked and tuple(words[link : link + len(said)]) == said), 0)
        pile = link + size + 1
        if not size or pile >= len(words) or words[pile] not in _PILES or words[pile - 1] not in _LEADS:
            continue
        end = pile + 1
        of = words[end] == "of"
        while of and end < len(words) and not sentence[end].mark and words[end] not in ("and", "then"):
            if end > pile + 1 and link_at(sentence, end):
                break
            end += 1
        place = end
        if words[verb] not in ("move", "bring", "put", "place") and link_at(sentence, end) and words[end] in _STANDS:
            # "Take the top book from the stack on the shelf": the stack is there.
            place = next(
                n for n in range(end + link_at(sentence, end), len(words)) if sentence[n].mark or words[n] in _ENDING
            )
            if piled:
                return [sentence]
        rest = [*sentence[: at + 3], *sentence[place:]]
        name = words[at + 2]
        if piled or (not of and name == "one"):
            return [rest]
        there = [replace(sentence[pile], text=word) for word in ("there", "is", "a")]
        plural = f"{name}es" if name.endswith(("s", "x", "ch", "sh")) else f"{name}s"
        ones = [replace(sentence[pile], text=word) for word in ("of", plural)]
        whole = [*(sentence[pile + 1 : end] if of else ones), *sentence[end:place]]
        return [[*there, sentence[pile], *whole, replace(sentence[-1])], rest]
    return [sentence]


def _all_but(sentence: list[Token]) -> list[list[Token]]:
    """Tell "put everything but the cup in the box" as "the cup", "put everything else in the box"."""
    words = [token.text for token in sentence]
    verb = 1 if words[0] == "please" else 0
    if base_verb(words[verb]) != words[verb]:
        return [sentence]
    for at in range(verb + 1, len(words) - 3):
        every = next((len(said) for said in _EVERY if tuple(words[at : at + len(said)]) == said), 0)
        source = words[at + every] in ("off", "from")
        if not every or (source and not {"except", "excluding"} & {*words}):
            continue
        # "all the toys but the robot", "everything on the tray but the cup"
        for but in range(at + every, len(words) - 2):
            size = next((len(said) for said in _BUT if tuple(words[but : but + len(said)]) == said), 0)
            if not size or words[but + size] not in lexicon.DEFINITE | lexicon.POSSESSIVES:
                continue
            end = next(n for n in range(but + size + 1, len(words)) if sentence[n].mark or link_at(sentence, n)
                       or (words[n] in ("and", "then") and words[n + 1] not in _LEADS))  # fmt: skip
            ones = {"one", "ones", *lexicon.NUMBERS} & {*words[but + size : end]}
            if ones or (words[at] == "all" and every == 1 == but - at):
                return [sentence]
            out = but > at + every + 2 and words[at + every : at + every + 2] == ["out", "of"]
            where = [replace(sentence[but], text=word) for word in ("is", "in")] if out else []
            left = [*sentence[but + size : end], *where, *sentence[at + every + 2 : but if out else 0], sentence[-1]]
            if source or (words[at] == "all" and every == 1):
                left = [*left[: end - but - size], sentence[-1]]
                # "Put all the fruit in the bowl except the lemon" is quoted whole.
                last = replace(sentence[but - 1], end=sentence[end - 1].end)
                return [left, [*sentence[: but - 1], last, *sentence[end:]]]
            everything = replace(sentence[at], text="everything", end=sentence[end - 1].end)
            return [left, [*sentence[:at], everything, *sentence[at + every : but], *sentence[end:]]]
    return [sentence]
