"""Instructions in plainer words: what is asked for someone, wished for, forbidden, or said before its verb.

"Hand me the cup" becomes "fetch the cup", "push left the cup" "push the cup to the left", "don't touch it" "avoid it".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.rewriting.errands import left_alone
from pat3d.plan.grammar.rewriting.outcomes import TAKING, closed, put_back
from pat3d.plan.grammar.rewriting.wordings import LEAD, reworded, wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.number_words import ORDINALS, numeral
from pat3d.plan.grammar.words.unmade import base_verb

_FORBIDDING = (("make", "sure", "not", "to"), ("be", "sure", "not", "to"), ("take", "care", "not", "to"), ("do", "not"),
               ("don't",), ("never",))  # fmt: skip
_FINDING = frozenset({"find", "locate", "choose", "select", "get", "retrieve", "identify", "collect"})
_DOING = frozenset({"put", "place", "stack", "move", "pick", "take", "set", "pour", "open", "close", "grasp", "push"})
_IDIOMS = {("throw", "away"): "discard", ("throw", "out"): "discard", ("toss", "out"): "discard",
           ("toss", "away"): "discard", ("dispose", "of"): "discard", ("get", "rid", "of"): "discard",
           ("let", "go", "of"): "release"}  # fmt: skip
_GERUNDS = frozenset({"taking", "putting", "placing", "picking", "removing", "getting", "grabbing", "bringing",
                      "inserting", "opening", "closing", "washing", "pouring"})  # fmt: skip
"""Deeds that open a prompt before a bare noun, and describe none: "taking apples out of the bag"."""
_SETTING = frozenset({"put", "place", "set", "lay", "arrange", "position", "stand", "add"})
_THEN = frozenset({"then", "next", "now", "and", "finally", ",", "please", "also"})
"""What opens the next of several instructions."""
_STOWING = frozenset({"put", "stow", "store", "tidy", "pack", "clear", "place", "file", "tuck", "set"})
_PLACING = frozenset({"in", "into", "inside", "on", "onto", "under", "behind", "next"})
SORTS = frozenset({"color", "colour", "size", "shape", "type", "kind", "colors", "colours"})
_BUILDING = frozenset({"make", "build", "create", "form", "construct", "erect", "assemble"})
_UNTOLD = frozenset({"pyramid", "wall", "bridge", "arch", "staircase", "house", "castle", "fort"})
"""What is built in no task."""
_FORMS = frozenset({"tower", "stack", "pile", "column", "row", "line", "circle", "ring"}) | _UNTOLD
_MADE_OF = (("of",), ("out", "of"), ("from",), ("with",), ("using",), ("by", "stacking"))
_THERE = lexicon.DEFINITE | lexicon.POSSESSIVES | {"them", "all", "both"}
"""What speaks of things that are there."""
_RECEIVERS = lexicon.VIEWERS | {"person", "human", "user", "man", "woman", "operator"}
_SWAP = r"(?:swap|trade|switch|exchange|interchange) "
_PLACES = r"(?:[^ ]+ ){0,2}(?:place|position|location|spot)s? "
_WORDINGS = wordings((
    (r"(?<!a )(?<!the )(line )((?:(?!(?:up|on|in|to|of|with|from|next|at|by) )[^ .,:;]+ )+)up ", r"\1 up \2"),
    (rf"(?<![^.,;:dn] )((?:lay|set|spread) )out (?={LEAD})", r"\1"),
    (r"(?<![^.,;:dn] )lay down ", "put down"),
    # "Swap the positions of the cup and the can", "have the cup and the can trade places"
    (rf"({_SWAP}){_PLACES}(?:of|between) ", r"\1"),
    (rf"(?<!. )(?:have |let |make )?([^.,]* and [^.,]*?){_SWAP}{_PLACES}(?=[.,])", r"swap \1"),
    # Of two that are parted neither is on the other.
    (rf"(?<!. )((?:separate|part|distinguish) {LEAD}[^.,:;]*?)from (?={LEAD})", r"\1 and"),
    (rf"(?:give|hand|pass) the (?:{'|'.join(_RECEIVERS)}) (?={LEAD})", "fetch"),
    (r"((?:build|make|create|construct) )(?:me|us) ", r"\1"),
    (r"((?:build|make|create|construct) [^.,]*)for (?:me|us) (?=[.,])", r"\1"),
    (r"(?:hand|give|bring|pass|fetch|get) (?:me|us) ", "fetch"),
    (r"give ((?:[^ ]+ )*?)to (?:me|us) ", r"fetch \1"),
))  # fmt: skip


def commanded(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` of one sentence with its instructions in plainer words."""
    told = reworded(put_back(closed(_in_full(_idioms(tokens)))), _WORDINGS)
    return _handed(_fronted(_place_first(_ordered(_told_once(_lined_up(_built(told)))))))


def allowed(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "don't touch the cup" as "avoid the cup", and "without moving the cup" the same."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 6]]
        opens = not made or made[-1].text in (".", ",", "and", "but", "please")
        size = next((len(no) for no in _FORBIDDING if tuple(words[: len(no)]) == no), 0) if opens else 0
        if size and base_verb(words[size]) == words[size] and len(words) > size + 1:
            made.append(replace(tokens[at], text="avoid", end=tokens[at + size].end))
            at += size + 1
            continue
        made.append(tokens[at])
        at += 1
    return made


def _idioms(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "get rid of the cans" as "discard the cans", "let go of the cup" as "release the cup"."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3):
        led = not at or tokens[at - 1].mark or words[at - 1] in ("and", "then", "please", "to")
        size = next((len(said) for said in _IDIOMS if tuple(words[at : at + len(said)]) == said), 0) if led else 0
        if size and not tokens[at + size].mark and not link_at(tokens, at + size):
            deed = replace(tokens[at], text=_IDIOMS[tuple(words[at : at + size])], end=tokens[at + size - 1].end)
            return _idioms([*tokens[:at], deed, *tokens[at + size :]])
    return tokens


def _in_full(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "putting a cup on a tray" as "put a cup on a tray", "then drop in a box" as "then drop it ..."."""
    words = [token.text for token in tokens]
    base = base_verb(words[0]) if words[0].endswith("ing") else None
    leads = lexicon.DETERMINERS | lexicon.NUMBERS.keys()
    finite = any(word in lexicon.COPULAS and words[at - 1] not in ("that", "which") for at, word in enumerate(words))
    plain = words[0] in _GERUNDS and not tokens[1].mark and words[:2] not in (["washing", "machine"], ["washing", "up"])
    if base and ((base in _DOING and words[1] in leads and "," not in words) or plain) and not finite:
        return [replace(tokens[0], text=base), *tokens[1:]]
    tokens = _by_doing(tokens)
    words = [token.text for token in tokens]
    made: list[Token] = []
    for at, token in enumerate(tokens):
        follower = words[min(at + 1, len(words) - 1)]
        made.append(token)
        goes_on = at > 2 and words[at - 1] in ("then", ",", "and") and base_verb(words[0]) == words[0]
        deed = base_verb(token.text) if goes_on and follower in ("it", "them") else None
        if deed in _DOING:
            # "Pick up the pot and placed it on the mat"
            made[-1] = replace(token, text=deed)
        joined = goes_on and words[0] in TAKING | _FINDING
        if joined and token.text in ("pass", "drop", "place", "put", "move") and follower in ("to", *_PLACING):
            made.append(replace(token, text="it"))
        if token.text == "reach" and follower == "for" and (not at or words[at - 1] in ("and", "then", ",")):
            made[-1] = replace(token, text="grasp", end=tokens[at + 1].end)
    return [token for at, token in enumerate(made) if not (token.text == "for" and at and made[at - 1].text == "grasp")]


def _by_doing(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "open the pot by lifting the lid and turning it" as "open the pot, lift the lid and turn it"."""
    words = [token.text for token in tokens]
    by = words.index("by") if "by" in words else 0
    if by < 3:
        return tokens
    verb = by + 1 + (words[by + 1].endswith("ly"))
    gerund = words[verb].endswith("ing") and base_verb(words[verb])
    asked = base_verb(words[0]) == words[0] and words[1] in lexicon.DETERMINERS and words[0] not in ("build", "make")
    if not gerund or not asked or link_at(tokens, verb):
        return tokens
    made = [*tokens[:by], replace(tokens[by], text=",", mark=True)]
    for at in range(verb, len(tokens)):
        base = base_verb(words[at]) if at == verb or words[at - 1] in ("and", ",", "then") else None
        made.append(replace(tokens[at], text=base) if base and words[at].endswith("ing") else tokens[at])
    return made


def _lined_up(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "line up the jars on the shelf" as "arrange the jars in a row on the shelf"."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3):
        led = not at or tokens[at - 1].mark or words[at - 1] in ("and", "then", "please")
        follower = words[at + 2] in lexicon.DETERMINERS | lexicon.NUMBERS.keys() | lexicon.POSSESSIVES
        if not (led and follower and words[at : at + 2] == ["line", "up"]):
            continue
        end = next(n for n in range(at + 2, len(words)) if tokens[n].mark or link_at(tokens, n))
        row = [replace(tokens[at + n // 2], text=word) for n, word in enumerate(("in", "a", "row"))]
        return [*tokens[:at], replace(tokens[at], text="arrange"), *tokens[at + 2 : end], *row, *tokens[end:]]
    return tokens


def _built(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "build a tower of three cubes" as "stack the three cubes", and a row of the cubes as "arrange ...".

    "Build a row of three cubes" makes them up, and of "build a pyramid from these six cups" none is built before.
    """
    words = [token.text for token in tokens]
    for at in range(len(words) - 5):
        led = not at or tokens[at - 1].mark or words[at - 1] in ("and", "then", "please", "to", "you")
        form = at + 2 + (words[at + 1] == "a" and words[at + 2] not in _FORMS)
        if not led or words[at] not in _BUILDING or words[at + 1] != "a" or words[form] not in _FORMS:
            continue
        size = next((len(said) for said in _MADE_OF if tuple(words[form + 1 : form + 1 + len(said)]) == said), 0)
        things = form + 1 + size
        piled, untold = words[form] in lexicon.TOWERS, words[form] in _UNTOLD
        later = (n for n in range(things, len(words) - 1) if words[n] == "then" or (
            words[n] == "and" and base_verb(words[n + 1]) == words[n + 1]))  # fmt: skip
        goes_on = next(later, len(words))
        goes_on = goes_on < len(words) and (not piled or bool({"it", "them", "top", "one"} & {*words[goes_on:]}))
        end = next(n for n in range(things, len(words)) if words[n] == "." or (tokens[n].mark and words[n] != ","))
        first = next((n for n in range(things, end) if link_at(tokens, n) and words[n] != "of"), end)
        if size and piled and (turns := _by_turns(tokens[:at], tokens[at], tokens[things:end])):
            return [*turns, *tokens[end:]]
        stop = next((n for n in range(things, first) if words[n] in (",", "and", "then", "with", "each")), first)
        placed = words[stop] in (".", ",", "and", "then") or words[stop + link_at(tokens, stop)] in _THERE
        placed = placed and piled and not _FORMS & {*words[stop:]}
        if size and placed and not goes_on and singulars(words[stop - 1]) and words[things] not in _THERE:
            tokens = [*tokens[:things], replace(tokens[things], text="the"), *tokens[things:]]
            return _built(tokens)
        if not size or words[things] not in _THERE or goes_on:
            # "Make a tower of the red and the blue brick and place the green one on it": that one is to be placed.
            continue
        verb = "assemble" if untold else "stack" if piled else "arrange"
        deed = replace(tokens[at], text=verb, end=tokens[form].end)
        how = [] if piled or untold else [replace(tokens[form], text=word) for word in ("in", "a", words[form])]
        return [*tokens[:at], deed, *tokens[things:first], *how, *tokens[first:]]
    return tokens


def _by_turns(before: Sequence[Token], verb: Token, things: Sequence[Token]) -> list[Token]:
    """The deeds by which "4 alternating red and white cubes, red at the bottom" come to be a tower, behind `before`."""
    words = [token.text for token in things]
    at = words.index("alternating") if "alternating" in words else len(words)
    if at > 1 or words[at + 2 : at + 3] != ["and"] or not singulars("".join(words[at + 4 : at + 5])):
        return []
    colours, rest = [things[at + 1], things[at + 3]], words[at + 5 :]
    count = next((numeral(word) for word in words[:at]), 0) or 4
    if count > 2 * len(ORDINALS):
        return []
    highest = {"top", "above"} & {*rest}
    lowest = next((n for n, colour in enumerate(colours) if colour.text in rest), 0)
    lowest = (lowest + count - 1) % 2 if highest else lowest
    name = replace(things[at + 4], text=next(iter(singulars(words[at + 4]))))
    made = list[list[Token]]()
    for n in range(count):
        rank = [replace(name, text=ORDINALS[n // 2])] if n // 2 or count > n + 2 else []
        made.append([replace(name, text="the"), *rank, colours[(n + lowest) % 2], name])
    stack, on, joint = (replace(verb, text=word) for word in ("stack", "on", "and"))
    deeds = [[joint, stack, *upper, on, *lower] for lower, upper in pairwise(made)]
    return [*before, *[token for deed in deeds for token in deed][1:]]


def _told_once(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "push and close the drawer" as "close the drawer", of which both are said."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 4):
        led = not at or tokens[at - 1].mark or words[at - 1] in ("and", "then", "please")
        both = all(base_verb(word) == word for word in (words[at], words[at + 2])) and words[at + 1] in ("and", "or")
        taken = words[at + 3] in ("up", "out")
        follower = words[at + 3 + taken] if at + 3 + taken < len(words) else "."
        if led and both and (follower in lexicon.DETERMINERS | lexicon.POSSESSIVES):
            return [*tokens[:at], replace(tokens[at + 2], start=tokens[at].start), *tokens[at + 3 :]]
    return tokens


def _ordered(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "the lemon should go into the bowl" as "put the lemon into the bowl"."""
    words = [token.text for token in tokens]
    belongs = next((at for at in range(2, len(words) - 3) if words[at] in ("belongs", "belong")), 0)
    if belongs and words[0] in ("that", "this", "these", "those") and link_at(tokens, belongs + 1):
        # "That cup belongs on the shelf."
        return [replace(tokens[0], text="put"), *tokens[:belongs], *tokens[belongs + 1 :]]
    for at in range(1, len(words) - 3):
        goes = words[at] == "go" or (words[at] == "goes" and words[at + 1] in ("into", "onto"))
        if goes and words[0] in ("the", "all", "both") and words[at + 1] in _PLACING and not tokens[at - 1].mark:
            # "The plates go into the sink and the cups go on the shelf."
            again = {n for n in range(at + 4, len(words) - 2) if words[n] in ("go", "goes") and link_at(tokens, n + 1)}
            kept = [token for n, token in enumerate(tokens) if n not in again | {at}]
            return [replace(tokens[0], text="put"), *kept]
        if words[at] in lexicon.MODALS and words[at + 1] in ("stay", "remain") and words[0] in lexicon.DEFINITE:
            # "The cups can stay on the shelf", "the cups can stay where they are"
            if link_at(tokens, at + 2):
                return [*tokens[:at], replace(tokens[at], text="are", end=tokens[at + 1].end), *tokens[at + 2 :]]
            there = [replace(tokens[0], text=word, end=tokens[at + 1].end) for word in ("there", "are")]
            return [*there, *tokens[:at], *left_alone(tokens[at + 2 :])]
        asks = words[at] in ("should", "must", "shall")
        asks = asks or (words[at] in ("needs", "need", "has", "have") and words[at + 1] == "to")
        verb = at + 1 + (words[at + 1] == "to")
        if not asks or words[verb] != "go" or not link_at(tokens, verb + 1) or words[0] not in lexicon.DETERMINERS:
            continue
        return [replace(tokens[0], text="put"), *tokens[:at], *tokens[verb + 1 :]]
    return tokens


def _place_first(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "on the board, place a lemon" as "on the board is a lemon", "the lemon" as "place the lemon on"."""
    words = [token.text for token in tokens]
    start = next(n for n in range(len(words)) if words[n] not in _THEN or words[n + 1 : n + 2] == ["to"])
    size = link_at(tokens, start)
    verb = next((n for n in range(start + size + 1, len(words) - 2) if words[n] in _SETTING), 0)
    comma = verb - 1 if words[verb - 1] == "," else verb
    place = tokens[start:comma]
    plain = not any(token.mark or token.text in FINITE | lexicon.COPULAS | {"and"} for token in place)
    first = words[verb + 1] if verb else ""
    if not size or not verb or not plain or (words[start + size] not in lexicon.DETERMINERS | lexicon.PRONOUNS):
        return tokens
    if first in lexicon.DEFINITE:
        end = _end_of_deed(words, verb)
        return [*tokens[verb:end], *place, *tokens[end:]]
    if first in lexicon.DETERMINERS | lexicon.NUMBERS.keys() or first.isdecimal():
        several = first not in ("a", "an", "one") or "," in words[verb:] or "and" in words[verb:]
        return [*place, replace(tokens[verb], text="are" if several else "is"), *tokens[verb + 1 :]]
    return tokens


def _end_of_deed(words: Sequence[str], verb: int) -> int:
    """Where the deed of `verb` ends: at a mark, or before the next deed."""
    ends = (n for n in range(verb + 2, len(words)) if words[n] in (".", ";", ":") or
            (words[n] in ("and", ",", "then") and {*words[n + 1 : n + 3]} & _DOING))  # fmt: skip
    return next(ends)


def _fronted(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "in the box grasp the cup" as "grasp the cup in the box"."""
    words = [token.text for token in tokens]
    if words[0] not in ("in", "on", "from", "inside", "at") or words[1] not in lexicon.DETERMINERS:
        return tokens
    mark = next(n for n in range(len(tokens)) if tokens[n].mark)
    if words[mark] == "," and words[mark + 1] in TAKING and words[mark + 2] in lexicon.DETERMINERS | {"up"}:
        # "From the bowl, take a pear."
        end = _end_of_deed(words, mark + 1)
        return [*tokens[mark + 1 : end], *tokens[:mark], *tokens[end:]]
    verb = next((n for n in range(3, mark - 1) if words[n] in TAKING), 0)
    if not verb or words[verb + 1] not in lexicon.DETERMINERS or lexicon.COPULAS & set(words[:verb]):
        return tokens
    return [*tokens[verb:mark], *tokens[:verb], *tokens[mark:]]


def _handed(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "hand over the cup" as "fetch the cup"."""
    made: list[Token] = []
    told = {token.text for token in tokens}
    for at, token in enumerate(tokens):
        before, follower = (made[-1].text if made else ""), tokens[min(at + 1, len(tokens) - 1)].text
        if token.text == "first" and before == ":" and follower in lexicon.DETERMINERS:
            # "First the bottles, then the tins."
            continue
        stowed = token.text in ("away", "back") and told & _STOWING and follower in _PLACING and before != "the"
        if stowed and tokens[at + 2].text in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"to"}:
            continue
        sorted_by = "sort" in told and ("into" in [each.text for each in made] or ":" in told)
        if sorted_by and (
            (token.text == "by" and follower in SORTS) or (token.text in SORTS and tokens[at - 1].text == "by")
        ):
            continue
        led = follower in lexicon.DEFINITE | lexicon.POSSESSIVES
        if token.text == "over" and before in ("hand", "pass") and led and not _leads_on(tokens, at):
            # "Hand over the hammer."
            made[-1] = replace(made[-1], text="fetch")
            continue
        gathers = token.text == "collect" and (not at or tokens[at - 1].mark or before in _THEN)
        if gathers and led and not {"in", "into", "on", "onto", "to"} & told:
            # "Collect the coins from under the bench": nothing is said of where they go.
            token = replace(token, text="gather")
        leads = token.text in ("pass", "hand") and (not at or tokens[at - 1].mark or before in _THEN)
        if leads and follower in lexicon.DEFINITE | lexicon.POSSESSIVES and not _leads_on(tokens, at):
            # "Pass the hammer."
            token = replace(token, text="fetch")
        made.append(token)
    return made


def _leads_on(tokens: Sequence[Token], at: int) -> bool:
    """Whether more than the name of a thing stands behind the verb at token `at`, up to a mark or the next deed."""
    end = next(n for n in range(at + 1, len(tokens)) if tokens[n].mark or tokens[n].text in ("and", "then"))
    links = [n for n in range(at + 1, end) if link_at(tokens, n)]
    # "Pass the hammer lying beside the box."
    return bool(links) and not tokens[links[0] - 1].text.endswith("ing")
