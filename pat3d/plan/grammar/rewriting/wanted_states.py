"""States that are wanted, as the deeds that bring them about: "make sure the lemon is in the bowl" puts it there.

"When you're done, the cubes must be in the box", "the book should be on the desk at the end" and "the mug should end up
in the sink" tell how the scene is to be left, not how it begins. What opens such a sentence, or an instruction, is only
that it comes later: "after all this, let's put the cup on the tray". Without a word of the end ("I want the mug on the
tray", "the mug should be on the tray") a wanted state is a deed where the mug was told of before, at another place, or
where the prompt tells of no scene: nothing but what is wanted and what is to be done.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon, postures
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_DONE = r"(?:done|finished|finish|ready|complete|completed|over|through)"
_WHAT = r"(?:all |everything )?(?:of )?(?:this|that|these|those|it|everything|all|you|we|i)"
_ARE = r"(?:are|is|have|has|am|was|were|'s|'ve|'re)(?: been)?(?: all)?"
_ENDS = (
    r"(?:after|once|when|as soon as|by the time)"
    rf"(?: (?:{_WHAT}(?: {_ARE})?|you're|we're|i'm|it's|you've|we've))? {_DONE}"
    r"(?: with (?:this|that|it|these|those|them|everything))?"
    r"|(?:at|in|by) the (?:very )?end|in the final (?:state|scene|setup)|eventually|finally|afterwards?"
)
"""When everything is done."""
_LATER = rf"{_ENDS}|(?:after|with) {_WHAT}(?: {_DONE})?|later(?: on)?|then|next|now|lastly"
_ENDING, _OPENING = re.compile(rf"(?:{_ENDS})(?: ,)? "), re.compile(rf"(?:and |so )?(?:{_LATER})(?: ,)? ")
_LAST = re.compile(rf" (?:, )?(?:{_ENDS}) $")
_ALSO_TOLD = frozenset({"at", "by", "finally", "afterward", "afterwards"})
"""What opens a description as well: "at the end, a globe is next to the lamp", "finally, the cup is on the tray"."""
_SURE = tuple(tuple(said.split()) for said in (
    "make sure that", "make sure", "making sure that", "making sure", "make certain that", "make certain",
    "be sure that", "see to it that", "ensure that", "ensure", "ensuring that", "ensuring", "the goal is that",
    "your goal is that", "the aim is that", "the task is that", "your task is that",
))  # fmt: skip
_GOALS = tuple((whose, what, "is", "to", verb) for whose in ("the", "your", "our", "my")
               for what in ("goal", "aim", "task", "objective") for verb in ("have", "get"))  # fmt: skip
_WISHES = (*_GOALS, *(tuple(said.split()) for said in (
    "i want", "we want", "i need", "we need", "i'd like", "i would like", "we'd like", "we would like",
    "i want to have", "i'd like to have", "i would like to have", "i want you to have",
)))  # fmt: skip
_FIRST = frozenset({"only", "just", "first", "second", "lastly"})
_DUTY = frozenset({"should", "must", "shall", "ought", "needs", "need"})
_GOES = frozenset({"goes", "go", "belongs", "belong"})
_PLACED = frozenset({"on", "in", "inside", "into", "onto", "atop", "holds", "hold", "contains", "contain", "has"})
_OUGHT = tuple(tuple(said.split()) for said in (
    "has to", "have to", "needs to", "need to", "is to", "are to", "ought to", "must", "should", "shall", "will",
))  # fmt: skip
_BEING = frozenset({"is", "are", "be", "lies", "lie", "stands", "stand", "sits", "sit", "rests", "rest"})
_ENDING_UP = (("end", "up"), ("ends", "up"))
_STATES = [[word] for word in (*_BEING, "end")]
_CONTAINING = frozenset({"contains", "contain", "holds", "hold"})
_VERBS = _BEING | _CONTAINING | lexicon.MODALS | {"ends", "end", "has", "have", "needs", "need", "ought"}
_PLACES = frozenset({"left", "right", "front", "back", "middle", "center", "centre", "corner", "edge", "side", "end"})
"""Places on what carries a thing."""
SWITCHED = {"open": "open", "closed": "close", "shut": "shut"}
_KEEPING = frozenset({"leave", "keep"})
_EMPTIED = frozenset({"unload", "empty", "clear", "unpack", "everything", "all"})
"""What the things are in that are left elsewhere."""
_LEADS = lexicon.DEFINITE | lexicon.POSSESSIVES | {"it", "they"}
_MADE_UP = (lexicon.NUMBERS.keys() - {"both"}) | {"a", "an", "some"}
_SCENES = frozenset({"scene", "scenario", "image", "picture", "setup", "create", "generate"})


def brought_about(told: list[list[Token]], nouns: Nouns) -> list[list[Token]]:
    """The sentences `told` with what is to be in the end as what is to be done."""
    describes = _makes_up(told)
    sure = _told_sure if describes else _made_sure
    made: list[list[Token]] = []
    asked = any(known_verb(each[0].text) for each in told)
    wanted = all(known_verb(each[0].text) or _wants(each, nouns) or (asked and _goes(each)) for each in told)
    for sentence in told:
        before = {token.text for each in made for token in each}
        if stays := _left_there(sentence, told):
            made.append(stays)
            continue
        done = _ends_up(_in_the_end(_later(_alone(sentence))))
        made.append(sure(done if describes else _moved(done, before, wanted=wanted)))
    return made


def _left_there(tokens: list[Token], told: Sequence[list[Token]]) -> list[Token]:
    """Read "leave the phone on the desk" as "the phone is on the desk" where another of `told` is to be done.

    What was spoken of before comes to be there: "wash the cup. Leave the cup on the tray."
    """
    words = [token.text for token in tokens]
    verb = int(words[0] == "please")
    at = next((n for n in range(verb + 3, len(words) - 2) if link_at(tokens, n) and words[n] != "of"), 0)
    other = any(known_verb(each[0].text) and each[0].text not in _KEEPING for each in told)
    if words[verb] not in _KEEPING or words[verb + 1] not in _LEADS or not at or not other:
        return []
    earlier = " ".join(_said(each) for each in told[: told.index(tokens)])
    known = f" {' '.join(words[verb + 2 : at])} " in f" {earlier}" or _EMPTIED & {*earlier.split()}
    moved = words[at] in ("to", "onto", "into") and link_at(tokens, at) == 1
    if known or moved or {"and", "then", ",", "it", "them"} & {*words}:
        return []
    is_ = replace(tokens[at], text="are" if singulars(words[at - 1]) else "is")
    return [*tokens[verb + 1 : at], is_, *tokens[at:]]


def _makes_up(told: Sequence[Sequence[Token]]) -> bool:
    """Whether a scene is to be made, of which "make sure the cup is on the tray" tells more."""
    words = [token.text for sentence in told for token in sentence]
    puts = any(known_verb(one) and two in _MADE_UP for one, two in zip(words, words[1:], strict=False))
    return puts or bool(_SCENES & {*words})


def _wants(tokens: list[Token], nouns: Nouns) -> bool:
    """Whether "I want the mug on the tray" is all that `tokens` say; where furniture is to stand is the scene."""
    wished = _wished(tokens)
    verb = next((at for at, token in enumerate(wished) if at and token.text in _VERBS), 0)
    found = nouns.match([wished[verb - 1].text])
    stands = not any(token.text in SWITCHED for token in wished[-2:])
    furniture = stands and found is not None and nouns.of_class(found.noun, lexicon.FLOOR)
    return bool(verb) and not furniture and (wished != tokens or _ought(tokens))


def _goes(tokens: Sequence[Token]) -> bool:
    """Whether `tokens` tell where something "goes", which behind an instruction is where it is to be put."""
    goes = next((at for at, token in enumerate(tokens) if token.text in _GOES), 0)
    return goes > 1 and tokens[0].text in _LEADS and link_at(tokens, goes + 1) > 0


def _later(tokens: list[Token]) -> list[Token]:
    """Read "after all this, let's put the cup on the tray" as "let's put it there", "then we put it" as "put it"."""
    opening = _OPENING.match(_said(tokens))
    start = len(opening.group().split()) if opening else 0
    words = [token.text for token in tokens[start : start + 4]]
    if not start or len(words) < 4:
        return tokens
    we = words[0] in ("we", "you") and known_verb(words[1]) and words[2] in _LEADS
    asked = we or (words[0] == "let" and words[1] in ("'s", "us")) or (known_verb(words[0]) and words[1] in _LEADS)
    if not asked or words[1] == "is":
        return tokens
    return [replace(tokens[start + we], start=tokens[0].start), *tokens[start + we + 1 :]]


def _in_the_end(tokens: list[Token]) -> list[Token]:
    """Read "when you're done, the cubes must be in the box" as "put the cubes in the box"; so at the end."""
    opening, last = _ENDING.match(_said(tokens)), _LAST.search(f"{_said(tokens[:-1])}")
    place = bool(opening) and tokens[0].text in _ALSO_TOLD and not _ought(tokens)
    if opening and not place:
        kept = tokens[len(opening.group().split()) :]
        if {"belong", "belongs"} & {token.text for token in kept}:
            return kept
    elif last and _ought(tokens):
        size = len(last.group().split())
        kept = [*tokens[: -1 - size], tokens[-1]]
    else:
        # "At the end, the globe is next to the lamp": at the end of the row.
        return tokens
    return _deeds(kept, tokens[0]) or tokens


def _ends_up(tokens: list[Token]) -> list[Token]:
    """Read "the mug should end up in the sink", "the goal is to have the mug in the sink" as "put it in the sink"."""
    words = [token.text for token in tokens]
    ends = any(tuple(words[at : at + 2]) in _ENDING_UP for at in range(2, len(words) - 2))
    return (_deeds(_wished(tokens), tokens[0]) or tokens) if ends or tuple(words[:5]) in _GOALS else tokens


def _alone(tokens: list[Token]) -> list[Token]:
    """Read "only the egg should go in the box", "first, the egg should" as "the egg should"."""
    words = [token.text for token in tokens]
    first = 1 + (words[0] in _FIRST and words[1] == ",")
    asked = words[0] in _FIRST and words[first] in _LEADS and bool((_DUTY | _GOES) & {*words})
    return tokens[first:] if asked else tokens


def _moved(tokens: list[Token], before: Collection[str], *, wanted: bool) -> list[Token]:
    """Read "the pen should be in the mug" as "put the pen in the mug" where `before` tells that it is elsewhere.

    So is it where nothing but what is `wanted` is told.
    """
    wished = _wished(tokens)
    words = [token.text for token in wished]
    verb = next((at for at, word in enumerate(words) if word in _GOES or word in _VERBS), 0)
    told = {"it", "they", *before} & {words[verb - 1], *singulars(words[verb - 1])} and _PLACED & {*before}
    where = {*words[verb + 1 :]}
    if wanted and wished != tokens:
        # "I want the mug, the pen and the cup on the tray" is one state.
        done = _deeds(wished, tokens[0]) or _deed(wished[:-1], tokens[0])
        return [*done, *wished[-1:] * (done[-1:] != wished[-1:])] if done else tokens
    if not (told or wanted) or not verb or not _PLACED & where or _PLACES & where:
        return tokens
    if words[verb] in _GOES:
        wished[verb] = replace(wished[verb], text="is")
    elif not _ought(wished):
        return tokens
    return _deeds(wished, tokens[0]) or tokens


def _wished(tokens: list[Token]) -> list[Token]:
    """Read "I want the pen to be in the mug", "I'd like the pen in the mug" as "the pen is to be in the mug"."""
    words = [token.text for token in tokens]
    size = max((len(said) for said in _WISHES if tuple(words[: len(said)]) == said), default=0)
    if not size or words[size] not in _LEADS:
        return tokens
    made: list[Token] = []
    for at in range(size, len(tokens)):
        goes = words[at] == "go" and words[at - 1] == "to"
        if words[at : at + 2] in (["to", "be"], ["to", "end"], ["to", "go"]):
            made.append(replace(tokens[at], text="is"))
        made.append(replace(tokens[at], text="be") if goes else tokens[at])
    if len(made) > len(tokens) - size:
        return made
    ends = len(tokens) - 2
    at = next((at for at in range(size + 2, ends) if link_at(tokens, at) and words[at] != "of"), 0)
    at = at or ends * (words[ends] in SWITCHED)
    # "I want the bottle placed on the shelf"
    at -= bool(at) and (base_verb(words[at - 1]) or words[at - 1]) != words[at - 1] and words[at - 1].endswith("ed")
    said = [replace(tokens[at], text=word) for word in ("is", "to", "be")]
    return [*tokens[size:at], *said, *tokens[at:]] if at else tokens


def _made_sure(tokens: list[Token]) -> list[Token]:
    """Read "make sure the lemon is in the bowl, then ..." as "put the lemon in the bowl, then ..."."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 4):
        # "Could you make sure"
        opens = not at or tokens[at - 1].mark or words[at - 1] in ("and", "then", "please", "you")
        size = next((len(said) for said in _SURE if tuple(words[at : at + len(said)]) == said), 0) if opens else 0
        last = _LAST.search(_said(tokens[:-1])) if size else None
        # "See to it that the pen is in the mug in the end"
        stop = -1 - len(last.group().split()) if last else -1
        rest = [*tokens[at + size : stop], tokens[-1]]
        if size and (done := _put_there(rest, tokens[at]) or _deeds(rest, tokens[at])):
            return [*tokens[:at], *done]
    return tokens


def _put_there(tokens: Sequence[Token], first: Token) -> list[Token]:
    """`tokens` with "there is a cup and two forks on the tray" as "put the cup and the two forks on the tray"."""
    tokens = [token for token in tokens if token.text not in ("exactly", "precisely")]
    words = [token.text for token in tokens]
    place = next((n for n in range(3, len(words) - 2) if link_at(tokens, n) and words[n] not in ("of", "with")), 0)
    counted = [n for n in range(2, place) if words[n - 1] in (",", "and", *lexicon.COPULAS)]
    told = all(words[n] in _MADE_UP or words[n].isdecimal() for n in counted if words[n] != "and")
    if words[0] != "there" or words[1] not in lexicon.COPULAS or not place or not told:
        return []
    made = [replace(first, text="put")]
    for n in range(2, place):
        single = n in counted and (words[n] in ("a", "an", "one", "some", "1"))
        made += [replace(tokens[n], text="the")] if n in counted and words[n] != "and" else []
        made += [] if single else [tokens[n]]
    return [*made, *tokens[place:]]


def _told_sure(tokens: list[Token]) -> list[Token]:
    """Read "make sure the cup is on the tray", of a scene that is to be made, as "the cup is on the tray"."""
    words = tuple(token.text for token in tokens[:5])
    size = next((len(said) for said in _SURE if words[: len(said)] == said), 0)
    return tokens[size:] if size and words[size : size + 1] and _tells(tokens, size) else tokens


def _said(tokens: Sequence[Token]) -> str:
    return f"{' '.join(token.text for token in tokens)} "


def _ought(tokens: Sequence[Token]) -> bool:
    words = [token.text for token in tokens]
    return any(tuple(words[at : at + len(said)]) == said for at in range(1, len(words)) for said in _OUGHT)


def _deeds(tokens: Sequence[Token], first: Token) -> list[Token]:
    """`tokens` with each "the lemon is in the bowl" as "put the lemon in the bowl"; none where one is no such state.

    The deed is written from `first` on. What is to be done behind a comma stays.
    """
    made: list[Token] = []
    at, end = 0, 0
    while end < len(tokens):
        end = _end_of_state(tokens, at)
        done = _deed(tokens[at:end], first if not made else tokens[at])
        if not done:
            return []
        made += done
        if end >= len(tokens) - 1 or not _tells(tokens, end + 1):
            break
        made.append(tokens[end])
        at = end + 1
    return [*made, *tokens[end:]]


def _end_of_state(tokens: Sequence[Token], at: int) -> int:
    """Where the state that is told from token `at` on ends: at a mark, or before the next state or deed."""
    for n in range(at + 1, len(tokens) - 1):
        joint = tokens[n].text in ("and", "then", "but")
        deed = known_verb(tokens[n + 1].text) or tokens[n + 1].text == "then"
        if tokens[n].mark or (joint and (deed or _tells(tokens, n + 1))):
            return n
    return len(tokens) - 1


def _tells(tokens: Sequence[Token], at: int) -> bool:
    """Whether "the cup is" stands at token `at`."""
    if tokens[at].text not in _LEADS:
        return False
    end = next(n for n in range(at, len(tokens)) if tokens[n].mark or tokens[n].text in ("and", "then"))
    return any(tokens[n].text in FINITE for n in range(at + 1, end))


def _deed(tokens: Sequence[Token], first: Token) -> list[Token]:
    """The deed by which "the lemon is in the bowl", which is `tokens`, comes about; none where it is no such state."""
    words = [token.text for token in tokens]
    at = _main_verb(tokens)
    if not at or words[0] not in _LEADS or words[0] == "that" or "no" in words[:at]:
        return []
    end = at + next((len(said) for said in _OUGHT if tuple(words[at : at + len(said)]) == said
                     and words[at + len(said) : at + len(said) + 1] in _STATES), 0)  # fmt: skip
    end += 2 if tuple(words[end : end + 2]) in _ENDING_UP else 1
    rest = list(tokens[end:])
    done = _verb(rest) if rest and (words[end - 1] == "up" or words[end - 1] in _BEING) else None
    if words[at] in _CONTAINING and rest and end == at + 1:
        # "The basket contains the can": the can is put in it.
        return [replace(first, text="put"), *rest, replace(tokens[at], text="in"), *tokens[:at]]
    if done is None:
        return []
    verb, size = done
    subject = [replace(each, text="them" if each.text == "they" else each.text) for each in tokens[:at]]
    if size and len(rest) == size:
        # The words of a note end where the state does.
        subject[-1] = replace(subject[-1], end=rest[size - 1].end)
    return [replace(first, text=verb), *subject, *rest[size:]]


def _main_verb(tokens: Sequence[Token]) -> int:
    """Where the verb of "the cup that is on the tray is in the box" stands; 0 where there is none."""
    open_clauses = 0
    for at, token in enumerate(tokens):
        open_clauses += at > 0 and token.text in lexicon.RELATIVES
        if at and token.text in _VERBS:
            if not open_clauses:
                return at
            open_clauses -= 1
        elif at and token.text in FINITE:
            open_clauses -= 1
    return 0


def _verb(rest: Sequence[Token]) -> tuple[str, int] | None:
    """The verb that brings about what `rest` tells of something, and how many words of `rest` it stands for."""
    word, alone = rest[0].text, len(rest) == 1
    base = base_verb(word) if word.endswith(("ed", "put", "hung", "set")) else None
    if base is not None and known_verb(base):
        return base, 1
    if (word in ("on", "off") and alone) or (postures.is_posture(word) and alone):
        return "turn", 0
    size = link_at(rest, int(postures.is_posture(word)))
    return ("put", 0) if size and len(rest) > size and word != "not" else None
