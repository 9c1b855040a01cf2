"""Instructions: which clause tells a robot what to do, and the scene before it is done.

"Put the soup in the basket" makes a soup and a basket and the task place:soup:basket. What is told of indefinite things
with a verb of placing ("put two mugs on a shelf") describes the scene to make.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from pat3d.errors import PromptError
from pat3d.plan.grammar.rewriting.commands import commanded
from pat3d.plan.grammar.rewriting.deeds import FASTENING, fastens, made_by, runs_on
from pat3d.plan.grammar.rewriting.errands import errands, left_alone
from pat3d.plan.grammar.rewriting.fronted import forbidden, in_order
from pat3d.plan.grammar.rewriting.outcomes import end_state
from pat3d.plan.grammar.rewriting.wielded import done_with, wielded
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import JOINERS, link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.unmade import base_verb, is_quality, makes_nothing
from pat3d.plan.grammar.words.vocabulary import Nouns

Manner = Literal["make", "move", "stack", "pick", "unload", "sort", "other"]

VERBS: dict[str, Manner] = {
    **dict.fromkeys(("put", "place", "set", "lay", "arrange", "hang", "lean", "position", "stand", "pile", "leave",
                     "balance", "scatter", "spread", "stick", "keep", "distribute", "rest", "center", "centre",
                     "line", "sit", "fill", "slap", "plop", "pop", "prop", "tuck", "slot", "wedge", "nestle", "mount",
                     "drape", "wrap", "tie", "fit", "nest", "fasten", "strap", "hook", "dip", "submerge",
                     "serve"), "make"),
    **dict.fromkeys(("move", "bring", "transport", "transfer", "carry", "drop", "insert", "throw", "toss", "pack",
                     "store", "return", "deliver", "relocate", "hand", "pass", "organize", "organise", "push", "slide",
                     "drag", "add", "collect", "clean", "plate", "load", "deposit", "sweep", "nudge", "shove",
                     "shift", "reposition", "stow", "stash", "dump", "cluster", "chuck", "lob", "fling", "hurl", "slip",
                     "ease", "park", "stuff", "cram", "kick", "guide", "haul", "release"), "move"),
    "stack": "stack",
    **dict.fromkeys(("pick", "grasp", "grab", "lift", "raise", "take", "fetch", "get", "hold", "retrieve", "choose",
                     "select", "remove", "gather", "identify", "find", "locate", "seize", "extract",
                     "unhook", "hoist", "heave", "snatch"), "pick"),
    **dict.fromkeys(("empty", "unload"), "unload"),
    "sort": "sort",
    **dict.fromkeys(("open", "close", "shut", "turn", "switch", "press", "rotate", "flip", "pull", "wipe", "wash",
                     "pour", "fold", "unfold", "cut", "slice", "cook", "heat", "shake", "stir", "plug",
                     "unplug", "unstack", "align", "assemble", "navigate", "walk", "cross", "reach", "swap", "scoop",
                     "touch", "tidy", "use", "click", "give", "clear", "scrub", "trade", "exchange",
                     "unpack", "separate", "start", "compare", "randomize", "stamp", "go", "avoid",
                     "turning", "disassemble", "rinse", "scrub", "dry", "discard", "secure", "squeeze",
                     "peel", "untie", "mix", "twist", "screw", "unscrew", "tilt", "spin", "roll",
                     "inspect", "measure", "weigh", "check", "ignore", "recycle", "ensure", "ensuring", "dispose",
                     "crush", "restore", "straighten", "bend", "break", "pair", "look", "point", "knock", "examine",
                     "tip", "destack", "restock", "refill"), "other"),
}  # fmt: skip
_CERTAIN = frozenset({"put", "pick", "move", "grasp", "grab", "bring", "take", "lift", "rotate", "transfer", "place",
                      "remove", "fetch"})  # fmt: skip
"""Verbs that are never nouns or adjectives, so that a bare noun may follow."""
_WORKING = frozenset({"wipe", "wash", "scrub", "rinse", "stir", "shake", "dump", "pour", "fold", "unfold", "squeeze",
                      "peel", "twist", "unscrew", "unplug", "hang", "insert", "sweep", "toss", "throw", "drag",
                      "slide", "carry", "retrieve", "get", "hold", "deliver", "relocate", "turn", "rotate", "flip",
                      "load", "unload", "deposit", "stow", "shift", "separate", "swap", "discard", "tilt", "align",
                      "arrange", "release", "wrap", "tie", "untie", "unstack", "lay", "transport", "return", "lean",
                      "slice", "heat", "cook", "mix", "scoop", "store", "distribute", "restock", "refill"})  # fmt: skip
"""Verbs that open a prompt before a bare noun, and describe none: "wipe plate with towel"."""
_WITH_ANOTHER = frozenset({"wipe", "scrub", "rinse", "stir", "squeeze", "unfold", "pour", "unscrew", "unplug", "shake"})
"""Those that are never nouns, so that they follow another instruction: "pick up sponge and wipe shoe"."""
FILLERS = frozenset({
    "please", "kindly", "then", "now", "next", "finally", "first", "firstly", "second", "secondly", "third", "lastly",
    "also", "afterwards", "afterward", "just", "carefully", "gently", "and", ",", "but", "sequentially",
})  # fmt: skip
_ASKING = tuple(tuple(said.split()) for said in (
    "could you", "can you", "would you", "will you", "you should", "you could", "you would", "you must", "you need to",
    "i want you to", "help me", "help me to", "let's", "let us", "your task is to", "the task is to", "make sure to",
    "go and", "you have to", "please help me", "go", "remember to", "after that", "after that ,", "after this",
    "after this ,", "once done ,", "in the end ,", "from there ,", "once that is done ,", "to begin with ,",
    "to start ,", "to finish ,",
))  # fmt: skip
SHUTTING = frozenset({"open", "close", "shut"})
"""Verbs of doors, drawers and lids."""
_ACTORS = frozenset({"robot", "arm", "arms", "gripper", "agent", "manipulator", "hand", "hands", "robotic"})
_LEADING = frozenset({"unlike", "despite", "besides", "versus", "per", "via", "plus", "minus", "notwithstanding"})
_ALSO_NOUNS = frozenset({"light", "dust", "water", "butter", "salt", "sugar", "oil", "paint", "ice", "frost", "season",
    "iron", "label", "cork", "cover", "mop", "nail"})  # fmt: skip
"""Names of things and stuff that are verbs before "the": "water the plant"."""
_DUTIES = lexicon.MODALS | {"needs", "need", "has", "is", "to", "go", "have"}
_CARRYING = ("make", "move", "stack", "pick")
_PARTICLES = frozenset({"up", "down", "away", "back", "out", "over", "off", "on", "close"})
_SEPARABLE = frozenset({"pick", "turn", "clean", "lift", "hand", "take", "switch", "set", "put", "push", "tidy",
    "clear", "wash", "wipe", "gather", "pack", "stack", "line", "knock", "stand", "tip", "press"})  # fmt: skip
"""Verbs that a particle follows: "stand up the bottle"."""
_WHILE = frozenset({"while", "by", "after", "before", "when", ",", "without"})
_OWING = frozenset({"has", "have", "needs", "need", "is", "are", "was", "were", "want", "wants", "able", "used"})
"""Words before "to" that tell of a duty or a fact."""
_NO_DEEDS = frozenset({"like", "mean", "seem", "need", "want", "have", "be", "do", "free", "clear", "lower", "lean",
                       "warm", "dry", "cool", "level", "light", "open", "close"})  # fmt: skip
"""Verbs that describe as often."""
_PURPOSES = frozenset({"make", "begin", "create", "start", "prepare", "access", "complete"})


@dataclass(frozen=True, kw_only=True)
class Clause:
    """One clause: an instruction with its verb, or a description."""

    tokens: tuple[Token, ...]
    """Without the verb; ends in a stop."""
    verb: str = ""
    manner: Manner | None = None
    """None for a description."""
    said: str = ""
    first: bool = True
    """Whether the sentence begins with it."""
    aside: tuple[str, ...] = ()
    """What was left out of the sentence before it was read, piece by piece."""
    how: bool = False
    """Whether a colon stands behind it, and then how it is to be done."""
    heading: bool = False
    """Whether that names all that it is about: "tidy up: put the pens in the cup"."""
    then: bool = False
    """Whether the sentence goes on with what is to be done then, so that this is a deed and no scene."""
    unread: PromptError | None = None
    """Why a sentence cannot be told in clauses, which is read in part then."""


def clauses(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Clause]:
    """The clauses of one sentence, which ends in a stop."""
    said = tokens

    def opens(at: int) -> bool:
        return bool(asked(said, nouns, at))

    if by := made_by(tokens):
        deed = replace(tokens[by + 1], text=base_verb(tokens[by + 1].text) or "")
        told = [replace(each, then=True) for each in clauses(text, [deed, *tokens[by + 2 :]], nouns)]
        return [replace(told[0], aside=(text[tokens[0].start : tokens[by - 1].end], *told[0].aside)), *told[1:]]
    comma, named = forbidden(tokens, opens)
    if comma:
        there = [Clause(tokens=(*named, tokens[-1]))] if named else []
        rest = clauses(text, tokens[comma + 1 :], nouns)
        told = [*there, *(replace(each, first=False) if there else each for each in rest)]
        return [replace(told[0], aside=(text[tokens[0].start : tokens[comma - 1].end], *told[0].aside)), *told[1:]]
    tokens = commanded(errands(in_order(tokens, opens), nouns))
    starts: list[tuple[int, int]] = []
    """Where an instruction begins, and its verb."""
    verb = _verb_at(tokens, 0, nouns, opening=True)
    if verb is not None:
        starts.append((0, verb))
    for at in range(1 if verb is None else verb + 1, len(tokens) - 1):
        how = tokens[at].text == ":" and verb is not None and VERBS.get(tokens[at + 1].text) in _CARRYING
        but = tokens[at].text == "but" and tokens[at + 1].text in _CERTAIN
        joint = tokens[at].text in (",", "and", "then", "-") or how or but
        doubled = tokens[at + 1].text in ("and", "then", ",")
        told = verb is not None or tokens[at + 1].text in _CERTAIN
        told = told or (tokens[at].text == "then" and tokens[min(at + 2, len(tokens) - 1)].text in lexicon.DETERMINERS)
        if joint and told and not doubled and (found := _verb_at(tokens, at + 1, nouns, opening=False)) is not None:
            starts.append((at, found))
        elif verb is not None and runs_on(tokens, at, nouns):
            starts.append((at + 1, at + 1))
        elif verb is not None and _begins_purpose(tokens, at, nouns):
            starts.append((at, at + 1))
    if not starts:
        return [Clause(tokens=tuple(tokens))]
    made: list[Clause] = []
    tools: list[Clause] = []
    if verb is None:
        made.append(Clause(tokens=(*tokens[: starts[0][0]], tokens[-1])))
    ends = [start for start, _ in starts[1:]] + [len(tokens) - 1]
    for (start, verb), end in zip(starts, ends, strict=True):
        word = base_of(tokens[verb].text)
        first = verb + 1
        while tokens[first].text in _PARTICLES and not (tokens[first].text == "on" and tokens[verb].text in _CERTAIN):
            first += 1
        body, aside = list(tokens[first:end]), ()
        for at, token in enumerate(body[:-1]):
            purpose = _is_deed(body[at + 1].text, nouns) and VERBS.get(body[at + 1].text, "other") == "other"
            purpose = purpose or body[at + 1].text in _PURPOSES
            named = any(nouns.match([each.text]) for each in body[at + 2 :])
            if token.text == "to" and purpose and at and (not named or body[at + 1].text in _PURPOSES):
                aside = (text[token.start : body[-1].end].strip(" ,"),)
                body = body[:at]
                break
        while body and (body[-1].text in (",", "and", "then", ":") or body[-1].text in _PARTICLES - {"on", "off"}):
            body.pop()
        stop = tokens[-1]
        stays = len(starts) > 1 or len(left_alone(body)) < len(body)
        if word in ("leave", "keep") and stays and body and body[0].text in lexicon.DEFINITE:
            # "Leave the mug on the table and move the plate": the mug is there.
            made.append(Clause(tokens=(*left_alone(body), stop)))
            continue
        manner = VERBS.get(word, "other")
        body, turned = end_state(body, word, manner)
        aside = (*aside, *((text[turned.start : turned.end],) if turned is not None else ()))
        begun = max(start, 0)
        whole = text[tokens[begun].start : max(token.end for token in tokens[begun:end])].lstrip(",: ")
        whole = whole.removeprefix("and ").removeprefix("then ")
        with_it, after = wielded(body, word, tokens[: max(start, 0)], nouns)
        if after:
            # "Push the ball with the bat": the bat lies by itself.
            tool = Clause(tokens=(*body[with_it + 1 : after], stop), first=not made)
            # "Get it out with the stick and drop it in the box": what is dropped was named before.
            # "Slide tomato pieces into the pan using a knife": no pieces of the knife.
            led = lexicon.DETERMINERS | lexicon.POSSESSIVES
            (made if body[0].text in led and body[with_it + 1].text in led else tools).append(tool)
            aside = (*aside, text[body[with_it].start : body[after - 1].end])
            body = [*body[: with_it - (body[with_it - 1].text in _PARTICLES)], *body[after:]]
        later = next((at for begin, at in starts if begin == end), 0)
        then = bool(later) and "then" in {token.text for token in tokens[end:later]}
        then = then and tokens[later + 1].text in lexicon.DEFINITE | {"it", "them"}
        how = tokens[end].text == ":"
        about = _names(tokens[verb + 1 : end], nouns) - _names(tokens[end:], nouns)
        heading = how and (manner == "sort" or (manner in ("other", "pick", "move", "make") and not about))
        made.append(Clause(tokens=(*body, stop), verb=word, manner=manner, said=whole, first=not made, aside=aside,
                           how=how, heading=heading, then=then))  # fmt: skip
    return [*made, *(replace(tool, first=False) for tool in tools)]


def asked(tokens: Sequence[Token], nouns: Nouns, at: int = 0) -> str:
    """The verb of the instruction that begins at token `at`, as a sentence of its own would; none without."""
    told = [replace(each, number=n + 1) for n, each in enumerate(tokens[at:])]
    verb = _verb_at(told, 0, nouns, opening=True)
    return "" if verb is None else base_of(told[verb].text)


def _is_nameless(tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether only a verb may open `tokens`, whatever it means: "shelve the atlas", "microwave a mug"."""
    word, the = tokens[0].text, tokens[1].text in lexicon.DEFINITE | lexicon.POSSESSIVES | {"it", "them"}
    if word in lexicon.COMMANDS | lexicon.VERBS | JOINERS | FINITE or link_at(tokens, 0) or not word.isalpha():
        return False
    if the and (word in _ALSO_NOUNS or base_verb(word) == word):
        return True
    known = makes_nothing(word) or is_modifier(word) or is_quality(word) or word in lexicon.NUMBERS.keys() | _LEADING
    named = the or tokens[1].text in ("a", "an") or nouns.match([word]) is None
    return not known and not singulars(word) and named


def _is_deed(word: str, nouns: Nouns) -> bool:
    """Whether `word` is a verb without an ending, and names nothing."""
    return (word in VERBS or base_verb(word) == word) and nouns.match([word]) is None


def _begins_purpose(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether "to scrub the bowl" or "while placing the pear" at token `at` names what was not named before it."""
    word, verb = tokens[at].text, tokens[at + 1].text
    linked = word != "without" and link_at(tokens, at + 1)
    doing = word in _WHILE and verb.endswith("ing") and not linked and nouns.match([verb]) is None
    deed = word == "to" and _is_deed(verb, nouns) and verb not in _PURPOSES and tokens[at - 1].text not in _OWING
    if not deed and not (doing and base_verb(verb) is not None):
        return False
    end = next(n for n in range(at + 1, len(tokens)) if tokens[n].mark)
    pronoun = tokens[at + 2].text in ("it", "them") and VERBS.get(base_verb(verb) or verb) in ("make", "move", "stack")
    return pronoun or bool(_names(tokens[at + 2 : end], nouns) - _names(tokens[:at], nouns))


def _names(tokens: Sequence[Token], nouns: Nouns) -> set[str]:
    """Catalogue nouns that `tokens` name, but parts, kinds and what is no body."""
    made: set[str] = set()
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 3]]
        size = next((n for n in (3, 2, 1) if n <= len(words) and nouns.match(words[:n])), 0)
        found = nouns.match(words[:size]) if size else None
        plain = size == 1 and bool({words[0], *singulars(words[0])} & (lexicon.PARTS | lexicon.SUBSTANCES))
        kind = size == 1 and bool({words[0], *singulars(words[0])} & lexicon.GENERICS.keys())
        if found is not None and not (plain or kind) and not (size == 1 and is_quality(words[0])):
            made.add(found.noun)
        at += size or 1
    return made


def base_of(word: str) -> str:
    """`word` without the ending of its person, as `VERBS` has it where it does."""
    for guess in (word, word.removesuffix("s"), word.removesuffix("es")):
        if guess in VERBS:
            return guess
    return base_verb(word) or word


def known_verb(word: str) -> bool:
    """Whether `word` tells a robot what to do."""
    return word in VERBS or base_verb(word) == word


def _verb_at(tokens: Sequence[Token], at: int, nouns: Nouns, *, opening: bool) -> int | None:
    """The verb of an instruction that begins at token `at`, or None."""
    actor = False
    while at < len(tokens) - 1:
        words = [token.text for token in tokens[at : at + 4]]
        longest = sorted(_ASKING, key=len, reverse=True)
        asking = next((each for each in longest if tuple(words[: len(each)]) == each), None)
        if asking and not (asking == ("go",) and base_of(words[1]) not in VERBS):
            at += len(asking)
        elif opening and words[0] == "to" and words[1] in VERBS and not at:
            at += 1
        elif words[0].endswith("ly") and words[1] in VERBS and words[0] not in lexicon.BACKGROUND:
            # "Firmly press the button"
            at += 1
        elif words[0] in FILLERS and (opening or words[0] != ","):
            at += 1
        elif opening and (after := _after_actor(tokens, at)):
            at, actor = after, True
        else:
            break
    word = tokens[at].text
    base = base_of(word) if actor else word
    if at + 1 >= len(tokens):
        return None
    follows = tokens[at + 1].text in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"it", "them"}
    if (word in FASTENING and fastens(tokens, at)) or (opening and done_with(tokens[at:], nouns)):
        return at
    if base not in VERBS:
        # A verb of which no task is known: "Trade the places of the cups".
        unknown = _is_deed(word, nouns) and word not in lexicon.COMMANDS | lexicon.VERBS | _NO_DEEDS
        goes_on = not opening and tokens[at - 1].text in ("and", "then")
        if (opening or goes_on) and (unknown or _is_nameless(tokens[at:], nouns)):
            return at if follows else None
        return at if unknown and follows and (not opening or tokens[at].number == 1) else None
    follower, going = tokens[at + 1].text, VERBS[base] == "other" and nouns.match([word]) is None
    if follower in ("of", "full", "with", "filled") and (opening or follower != "with" or not going):
        # "Stack of books", "plate full of carrots", and not "... and stir with the spoon"
        return None
    leads = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.PRONOUNS | {"both", "either"}
    if follower in leads or follower.isdecimal() or (word == "avoid" and follower in ("anything", "everything")):
        return at
    jotted = word == "plate" and link_at(tokens, at + 1) > 0
    if nouns.match([word, follower]) or jotted:
        return None
    if follower in _PARTICLES and base in _SEPARABLE:
        return at
    behind = tokens[min(at + 2, len(tokens) - 1)].text in lexicon.DETERMINERS
    if follower in _PARTICLES and base in ("open", "close", "pull", "fold", "roll") and behind:
        return at
    turns = base in ("turn", "walk", "go", "step") and follower in ("left", "right", "around", "straight", "forward")
    if turns and (not opening or tokens[at].number == 1):
        return at
    named = [[follower], [follower, tokens[min(at + 2, len(tokens) - 1)].text]]
    noun = not tokens[at + 1].mark and (is_modifier(follower) or any(map(nouns.match, named)))
    known = noun or follower in lexicon.GENERICS or nouns.match([*follower.split("-")]) is not None
    if base in _CERTAIN and not tokens[at + 1].mark:
        return at
    if going and (link_at(tokens, at + 1) or (tokens[at + 1].mark and not opening)) and (at or not tokens[at + 1].mark):
        # "Navigate to the table, ...", "reach into the box", "... and stir"
        return at if not opening or tokens[at].number == 1 or actor else None
    if going and follower in _PARTICLES and tokens[min(at + 2, len(tokens) - 1)].text in ("and", ",") and not at:
        # "Reach up and remove the cup"
        return at
    bare = base in ("stack", "open", "close", "sort", "pack", "push", "pull", "drop", "empty", "plate", "align", "add")
    working = word in _WORKING and nouns.match([word]) is None
    known = known or follower in lexicon.SUBSTANCES
    bare, known = bare or working, known or (working and bool(nouns.respelled(follower)))
    if not opening and word in _WITH_ANOTHER and known and not tokens[at + 1].mark:
        return at
    goal = any(token.text in ("into", "in", "on", "onto", "to") for token in tokens[at + 2 : at + 6])
    if (
        bare
        and not tokens[at + 1].mark
        and (known or (goal and base not in ("open", "close")))
        and opening
        and tokens[at].number == 1
    ):
        more = [token.text for token in tokens[at + 1 :]]
        # "Open box on a desk", "stack of books" describe.
        if base in ("open", "close", "empty") and nouns.match([follower]) and "the" not in more:
            return None
        return at
    return None


def _after_actor(tokens: Sequence[Token], at: int) -> int:
    """The token after "use the left arm to", "the robot should"; 0 where nobody acts."""
    words = [token.text for token in tokens[at : at + 12]]
    if words[0] in ("use", "using", "with"):
        for ahead, word in enumerate(words):
            if word in _ACTORS and ahead + 1 < len(words):
                after = words[ahead + 1]
                if after in ("to", ",", "and"):
                    return at + ahead + 2
                if base_of(after) in VERBS:
                    return at + ahead + 1
            if word in (".", ","):
                break
        return 0
    if words[0] in ("the", "a", "an", "your", "my", "our"):
        ahead = 1
        while ahead < len(words) and words[ahead] in _ACTORS:
            ahead += 1
        if ahead > 1:
            named = ahead
            while ahead < len(words) and words[ahead] in _DUTIES:
                ahead += 1
            # "A robot holding a cup stands" tells of a thing.
            acts = ahead > named or (words[0] not in ("a", "an") and not words[min(ahead, 11)].endswith("ing"))
            if acts and ahead < len(words) and base_of(words[ahead]) in VERBS:
                return at + ahead
    return 0
