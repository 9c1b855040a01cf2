"""Instructions whose verb, thing or goal stands elsewhere, as "move THING FROM TO", one clause each.

"Take the cup to the table", "lift the egg out of the pot and onto the plate", "put the cup on the tray, then the bowl",
"the lemon belongs in the bowl" and "leave the mug on the desk" say where things are to be without saying it so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.plausible import Plausible
from pat3d.plan.grammar.rewriting.outcomes import put_back
from pat3d.plan.grammar.rewriting.wordings import NAME, reworded, wordings
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.left_out import without_phrases
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_TAKING = frozenset({"take", "get", "grab", "lift", "pick", "fetch", "pull", "remove", "raise", "hoist", "heave",
                     "retrieve", "extract", "scoop", "snatch", "unhook", "gather", "seize"})  # fmt: skip
_UNLOADING = frozenset({"unload", "empty"})
_PUTTING = frozenset({"put", "place", "set", "move", "lay", "drop", "insert", "stack"})
_GOALS = frozenset({("to",), ("onto",), ("into",), ("over", "to"), ("back", "to"), ("back", "onto"),
                    ("back", "into"), ("to", "the", "front", "of")})  # fmt: skip
_PLACES = frozenset({"in", "on", "inside", "into", "onto", "under", "beside", "next", "behind", "near"})
_HOLDING = frozenset({"in", "on", "inside", "within"})
_AFTER = tuple(tuple(said.split()) for said in (
    "and then", ", then", ", and then", "and also", ", and also", "then", "as well as",
))  # fmt: skip
_NO_PHRASES = (("one", "by", "one"), ("one", "at", "a", "time"), ("one", "after", "another"),
               ("one", "after", "the", "other"), ("piece", "by", "piece"),
               *(("from", its, current, place) for its in ("its", "their") for current in ("current", "present")
                 for place in ("location", "position", "place", "spot")))  # fmt: skip
"""What changes nothing of what is to be done, or no task asks for."""
_REST = frozenset({"rest", "others"})
_ALSO = rf"and ((?:{'|'.join(lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys())}) {NAME})"
_TOO = wordings(((rf"{_ALSO}(?:too|as well) (?=[.,:;-] )", r"and also \1"),))
FILLING = frozenset({"fill", "load", "stock", "pack"})
"""Verbs of what something is put in or on."""
_HAVING_TO = tuple(tuple(said.split()) for said in (
    "should be", "must be", "needs to be", "need to be", "has to be", "have to be", "is to be", "are to be", "shall be",
    "ought to be", "be",
))  # fmt: skip
_WHERE_IT_IS = tuple(tuple(said.split()) for said in (
    "where it is", "where it lies", "where it stands", "where they are", "where they lie", "where they stand",
    "as it is", "as they are",
))  # fmt: skip


def errands(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with what is to be moved, and where to, behind its verb."""
    made = _filled_with(_filled_from(_belonging(_owed(without_phrases(tokens, _NO_PHRASES)))))
    if not any(_commands(made, at) for at in range(len(made))):
        return made
    made = _goals_alike(_where_another_is(_holder_first(made)), nouns)
    return _the_rest(_once_again(reworded(_carried(_emptied(put_back(made))), _TOO), nouns))


def _holder_first(tokens: list[Token]) -> list[Token]:
    """`tokens` with "put the pen between the cup and the jar, on the tray" as "... on the tray, between ..."."""
    words = [token.text for token in tokens]
    for at in (n for n in range(len(words)) if words[n] in _PUTTING and _commands(tokens, n)):
        aside = next((n for n in range(at + 2, len(words)) if tokens[n].mark or link_at(tokens, n)), at)
        link = LINKS.get(tuple(words[aside : aside + link_at(tokens, aside)]))
        between = link is not None and link.manner == "between"
        if link is None or not (between or link.kind in LATERAL_KINDS):
            continue
        mark = aside + link_at(tokens, aside)
        then = next((n for n in range(mark, len(words)) if words[n] == "and"), mark) if between else mark
        comma = next((n for n in range(then + 1, len(words) - 1)
                      if tokens[n].mark or link_at(tokens, n) or words[n] in ("and", "then")), then)  # fmt: skip
        on = comma + (words[comma] == ",")
        holds = words[on] in _HOLDING and _leads(tokens, on + 1) and (on > comma or between)
        end = next((n for n in range(on + 1, len(words)) if tokens[n].mark or words[n] in ("and", "then")), on)
        if holds and comma > then + 1 and not any(link_at(tokens, n) for n in range(on + 2, end)):
            stop = replace(tokens[aside], text=",", mark=True)
            return [*tokens[:aside], *tokens[on:end], stop, *tokens[aside:comma], *tokens[end:]]
    return tokens


def _where_another_is(tokens: list[Token]) -> list[Token]:
    """`tokens` with "put the cup where the can is, and the can in the box" as "..., put the can in the box"."""
    words = [token.text for token in tokens]
    where = words.index("where") if "where" in words else len(words)
    verb = next((n for n in range(where) if _commands(tokens, n) and words[n] in _PUTTING), where)
    stands = next((n for n in range(where + 2, len(words) - 3) if words[n] in lexicon.STANDING), 0)
    end = stands + 1
    while stands and words[end] in (",", "and", "then"):
        end += 1
    if verb < where and end > stands + 1 and _leads(tokens, end):
        comma = replace(tokens[stands + 1], text=",", mark=True)
        return [*tokens[: stands + 1], comma, replace(tokens[verb], number=tokens[end].number), *tokens[end:]]
    return tokens


def _filled_from(tokens: list[Token]) -> list[Token]:
    """`tokens` with "fill the bowl with figs from the box" as "move the figs from the box into the bowl".

    What is no body is poured: "fill the glass with water from the jug".
    """
    words = [token.text for token in tokens]
    from_at = words.index("from") if "from" in words else 0
    with_at = words.index("with") if "with" in words[:from_at] else from_at
    led = words[0] == "fill" and words[1] in lexicon.DETERMINERS and with_at > 2
    if not led or words[from_at + 1] not in lexicon.DETERMINERS or any(each.mark for each in tokens[:from_at]):
        return tokens
    end = next(n for n in range(from_at, len(words)) if tokens[n].mark)
    filling = tokens[with_at + 1 : from_at]
    liquid = not filling or {filling[-1].text, *singulars(filling[-1].text)} & lexicon.SUBSTANCES
    into = replace(tokens[with_at], text="into")
    if liquid:
        pour = replace(tokens[0], text="pour")
        return [pour, *tokens[from_at:end], into, *tokens[1:with_at], *tokens[end:]]
    known = filling[0].text in lexicon.DETERMINERS | lexicon.NUMBERS.keys()
    the = [] if known else [replace(filling[0], text="the")]
    move = replace(tokens[0], text="move")
    return [move, *the, *filling, *tokens[from_at:end], into, *tokens[1:with_at], *tokens[end:]]


def _filled_with(tokens: list[Token]) -> list[Token]:
    """`tokens` with "fill the bowl with the figs on the mat" as "move the figs on the mat into the bowl"."""
    words = [token.text for token in tokens]
    end = _end(tokens, 0) if words[0] in FILLING else 0
    with_at = words.index("with") if "with" in words[:end] else 0
    led = words[0] in FILLING and words[1] in lexicon.DETERMINERS and with_at > 2
    placed = any(link_at(tokens, n) for n in range(with_at + 2, end - 1) if words[n] not in ("of", "to"))
    known = led and words[with_at + 1] in ("the", "these", "those", "all", "both")
    if not led or not (known or placed) or "it" in words[end:]:
        return tokens
    if {*words[with_at + 1 : end], *singulars(words[with_at + 2])} & lexicon.SUBSTANCES:
        return tokens
    move, into = replace(tokens[0], text="move"), replace(tokens[with_at], text="into")
    moved = [one for each in tokens[with_at + 1 : end] for one in (tokens[1:with_at] if each.text == "it" else [each])]
    return [move, *moved, into, *tokens[1:with_at], *tokens[end:]]


def _commands(tokens: Sequence[Token], at: int) -> bool:
    """Whether an instruction of taking or putting begins at token `at`."""
    words = [token.text for token in tokens]
    opens = not at or tokens[at - 1].mark or words[at - 1] in ("and", "then", "please", "but")
    follower = words[at + 1] if at + 1 < len(words) else "."
    if words[at] == "pick" and follower == "up" and at + 2 < len(words):
        follower = words[at + 2]
    leads = follower in lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | {"it", "them"}
    return opens and leads and words[at] in _TAKING | _PUTTING | _UNLOADING


def _end(tokens: Sequence[Token], at: int) -> int:
    """Where the instruction that begins at token `at` ends: "take the cup, the pen and the jar to the desk" is one."""

    def goes_on(n: int) -> bool:
        """Whether a deed begins at token `n`."""
        return base_verb(tokens[n].text) == tokens[n].text or tokens[n].text in _PUTTING | {"then"}

    def lists(n: int) -> bool:
        """Whether the next of a list stands behind the comma at token `n`, with "and" before its last."""
        ends = (m for m in range(n + 1, len(tokens)) if tokens[m].mark or link_at(tokens, m) or goes_on(m))
        stop = next(ends, len(tokens) - 1)
        last = tokens[stop].text == "," and lists(stop)
        return tokens[n].text == "," and stop > n + 1 and (
            last or any(tokens[m].text == "and" for m in range(n + 1, stop)))  # fmt: skip

    return next(
        n for n in range(at + 1, len(tokens))
        if (tokens[n].mark and not lists(n)) or (tokens[n].text in ("and", "then") and goes_on(n + 1))
    )  # fmt: skip


def _carried(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "take the egg out of the pot and onto the plate" as "move the egg out of ... onto"."""
    made = list(tokens)
    for at in range(len(tokens)):
        if not _commands(made, at) or made[at].text not in _TAKING | _UNLOADING:
            continue
        end = _end(made, at)
        # "Take the cup next to the plate": "to" is no goal there.
        inside = {n + k for n in range(at + 2, end) for k in range(1, link_at(made, n))}
        goals = (n for n in range(at + 2, end) if tuple(t.text for t in made[n : n + link_at(made, n)]) in _GOALS)
        goal = next((n for n in goals if n not in inside and _leads(made, n + link_at(made, n))), 0)
        verb, joined = made[at].text, made[goal - 1].text == "and"
        sources = {each.text for each in made[at:goal]} & {"from", "off", "out"}
        stays = verb == "empty" or (verb in _UNLOADING and "from" not in sources)
        there = any(made[n].text == "that" and link_at(made, n + 2) for n in range(at, goal - 2))
        if not goal or (verb == "pick" and not (joined or sources or there)) or stays:
            continue
        made[at] = replace(made[at], text="drag" if verb == "pull" and not sources else "move")
        # "Lift the cup up and into the box"
        up = next(n for n in range(goal - 1 - joined, at, -1) if made[n].text != "up")
        drop = {*range(up + 1, goal)} | ({at + 1} if made[at + 1].text == "up" else set())
        kept = [token for n, token in enumerate(made) if n not in drop]
        return _carried(kept) if any(_commands(kept, n) for n in range(at + 1, len(kept))) else kept
    return made


def _emptied(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "empty the mug of its pens by moving them to the box" as "move the pens from ..."."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 8):
        if words[at] not in _UNLOADING or not _commands(tokens, at):
            continue
        of = next((n for n in range(at + 2, len(words)) if tokens[n].mark or words[n] == "of"), at)
        by = next((n for n in range(of, len(words)) if tokens[n].mark or words[n] == "by"), of)
        if (words[of], words[by]) == ("of", "by") and words[by + 2] == "them" and link_at(tokens, by + 3):
            move, source = replace(tokens[at], text="move"), replace(tokens[of], text="from")
            the = replace(tokens[of + 1], text="the")
            return [*tokens[:at], move, the, *tokens[of + 2 : by], source, *tokens[at + 1 : of], *tokens[by + 3 :]]
    return list(tokens)


def _leads(tokens: Sequence[Token], at: int) -> bool:
    return tokens[at].text in lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys()


def _once_again(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "put the cup on the tray and then the bowl" as "..., and put the bowl on the tray".

    So is "put the egg in the bowl and then the basket" as "..., and put it in the basket": no basket is in a bowl.
    """
    for at in range(len(tokens)):
        if not _commands(tokens, at) or tokens[at].text not in _PUTTING:
            continue
        words = [token.text for token in tokens]
        link = next((n for n in range(at + 2, len(words)) if tokens[n].mark or link_at(tokens, n)), at)
        if tokens[link].mark:
            continue
        for joint in range(link + 2, len(words) - 2):
            if _commands(tokens, joint):
                break
            size = next((len(said) for said in _AFTER if tuple(words[joint : joint + len(said)]) == said), 0)
            if not size or not _leads(tokens, joint + size):
                continue
            stop = next(n for n in range(joint + size, len(words)) if tokens[n].mark or words[n] in ("and", "then"))
            named = tokens[joint + size : stop]
            if any(link_at(named, n) or each.text in FINITE for n, each in enumerate(named)):
                break
            again = replace(tokens[at], number=tokens[joint].number)
            goal, moved = tokens[joint - 1].text, tokens[link - 1].text
            then = "then" in words[joint : joint + size]
            further = _further_goal(moved, words[link], goal, named[-1].text, nouns) if then else ""
            comma = replace(tokens[joint], text="and", mark=False)
            if further or (named[-1].text == goal != moved and "to" not in words[at:link]):
                # "Put the fig on the red plate and then the blue plate": the fig goes there.
                many = moved == "them" or next(iter(singulars(moved)), moved) != moved
                it = replace(again, text="them" if many else "it")
                there = [replace(each, number=again.number) for each in tokens[link : link + link_at(tokens, link)]]
                there = [replace(there[0], text=further)] if further else there
                return _once_again([*tokens[:joint], comma, again, it, *there, *named, *tokens[stop:]], nouns)
            the = [replace(each, text="the") if each.text in ("a", "an") else each for each in tokens[link:joint]]
            return _once_again([*tokens[:joint], comma, again, *named, *the, *tokens[stop:]], nouns)
    return list(tokens)


def _further_goal(moved: str, link: str, goal: str, named: str, nouns: Nouns) -> str:
    """Whether what is put on `goal` goes "in" or "on" what is `named` then; "" where that is put on `goal` as well."""
    thing, below, then = (found.noun if (found := nouns.match([word])) else "" for word in (moved, goal, named))
    likely, kind = Plausible(nouns), "in" if link in ("in", "into", "inside") else "on"
    level = likely.level(then)
    opens = likely.opens(then) and (kind == "in" or not level)
    if not (below and then) or not (opens or level) or link not in ("in", "into", "inside", "on", "onto", "to"):
        return ""
    gain = likely.carried(then, kind, below) - (likely.carried(thing, "in" if opens else "on", then) if thing else 0)
    large = likely.is_a(then, vessels.LARGE_VESSELS, lexicon.FLOOR, tuple(vessels.OPENED))
    return "" if gain < (0.2 if large else 0.8) else "in" if opens else "on"


def _goals_alike(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "put two cups on the red tray and the rest on the blue one" as "... on the blue tray"."""
    words = [token.text for token in tokens]
    made = list(tokens)
    for at in range(4, len(words)):
        size = next((n for n in (1, 2) if link_at(tokens, at - 2 - n) == n), 0) if words[at] == "one" else 0
        link = at - 2 - size
        led = size and words[at - 2] in lexicon.DEFINITE and is_modifier(words[at - 1])
        before = (n for n in range(link - 1, 0, -1) if words[n : n + size] == words[link : link + size])
        first = next(before, 0) + size if led else 0
        name = next((n for n in (first + 2, first + 3) if first > size and nouns.match(words[n : n + 1])), 0)
        if name and words[first] in lexicon.DETERMINERS and all(map(is_modifier, words[first + 1 : name])):
            made[at] = replace(made[at], text=words[name])
    return made


def _the_rest(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "put two of the cups on the tray and the rest on the shelf" as "and put the rest"."""
    for at in range(len(tokens)):
        if not _commands(tokens, at) or tokens[at].text not in _PUTTING:
            continue
        end = _end(tokens, at)
        words = [token.text for token in tokens]
        first = next((n for n in range(at + 2, end) if link_at(tokens, n) and words[n] != "of"), 0)
        for joint in range(first + 2, end if first else 0):
            name = joint + 1
            if words[joint] != "and" or words[first] == "between" or not _leads(tokens, name):
                continue
            link = next((n for n in range(name, end) if link_at(tokens, n) and words[n] != "of"), 0)
            if link and words[link - 1] in _REST:
                return [*tokens[:name], replace(tokens[at], number=tokens[name].number), *_the_rest(tokens[name:])]
    return list(tokens)


def _owed(tokens: list[Token]) -> list[Token]:
    """`tokens` with "the knife should be returned to the block" as "return the knife to the block"."""
    words = [token.text for token in tokens]
    if words[0] not in lexicon.DEFINITE | lexicon.POSSESSIVES | {"both", "all"}:
        return tokens
    for at in range(2, len(words) - 3):
        size = next((len(said) for said in _HAVING_TO if tuple(words[at : at + len(said)]) == said), 0)
        verb = at + size
        base = "put" if words[verb] == "put" else base_verb(words[verb]) if size else None
        if not size or base is None or not (link_at(tokens, verb + 1) or words[verb + 1] == "back"):
            continue
        subject = tokens[words[0] in ("both", "all") : at]
        return [replace(tokens[verb], text=base, number=tokens[0].number), *subject, *tokens[verb + 1 :]]
    return tokens


def _belonging(tokens: list[Token]) -> list[Token]:
    """`tokens` with "both the lemon and the lime belong in the bowl" as "put the lemon and the lime in the bowl"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(2, len(words) - 3) if words[n] in ("belong", "belongs")
               and words[n - 1] not in lexicon.RELATIVES and words[n + 1] in _PLACES), 0)  # fmt: skip
    if not at or words[0] not in lexicon.DEFINITE | lexicon.POSSESSIVES | {"both", "all"}:
        return tokens
    if any(word in FINITE or tokens[n].mark for n, word in enumerate(words[:at])):
        return tokens
    return [replace(tokens[0], text="put"), *tokens[words[0] in ("both", "all") : at], *tokens[at + 1 :]]


def left_alone(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "where it lies" left out, of what is left there."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = tuple(token.text for token in tokens[at : at + 3])
        if words in _WHERE_IT_IS:
            at += 3 + (tokens[min(at + 3, len(tokens) - 1)].text == ",")
            continue
        if words == ("alone",):
            break
        made.append(tokens[at])
        at += 1
    return made
