"""Instructions: which clause tells a robot what to do, the scene before it is done, and the task that it is.

"Put the soup in the basket" makes a soup and a basket and the task place:soup:basket. What is told of indefinite things
with a verb of placing ("put two mugs on a shelf") describes the scene to make.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token
from pat3d.plan.grammar.modifiers import is_modifier
from pat3d.plan.grammar.vocabulary import Nouns
from pat3d.plan.grammar.world import Item, Manner, Step, World
from pat3d.scene.relations import SUPPORT_KINDS

_VERBS: dict[str, Manner] = {
    **dict.fromkeys(("put", "place", "set", "lay", "arrange", "hang", "lean", "position", "stand", "pile", "leave",
                     "balance", "scatter", "spread", "stick", "keep", "distribute", "rest", "center", "centre",
                     "line", "sit", "fill"), "make"),
    **dict.fromkeys(("move", "bring", "transport", "transfer", "carry", "drop", "insert", "throw", "toss", "pack",
                     "store", "return", "deliver", "relocate", "hand", "pass", "organize", "organise", "push", "slide",
                     "drag", "add", "collect", "clean", "plate", "load", "deposit", "sweep", "nudge", "shove",
                     "shift", "reposition", "stow", "stash", "dump", "cluster"), "move"),
    "stack": "stack",
    **dict.fromkeys(("pick", "grasp", "grab", "lift", "take", "fetch", "get", "hold", "retrieve", "choose", "select",
                     "remove", "gather", "identify", "find"), "pick"),
    **dict.fromkeys(("empty", "unload"), "unload"),
    "sort": "sort",
    **dict.fromkeys(("open", "close", "shut", "turn", "switch", "press", "rotate", "flip", "pull", "wipe", "wash",
                     "pour", "fold", "unfold", "cut", "slice", "cook", "heat", "serve", "shake", "stir", "plug",
                     "unplug", "unstack", "align", "assemble", "navigate", "walk", "reach", "swap", "scoop", "touch",
                     "tidy",
                     "release", "unpack", "separate", "start", "compare", "randomize", "stamp", "go", "avoid",
                     "turning", "disassemble", "rinse", "scrub", "dry", "discard", "secure", "squeeze",
                     "peel", "tie", "untie", "wrap", "mix", "twist", "screw", "unscrew", "tilt", "spin", "roll",
                     "inspect", "measure", "weigh", "check", "ignore", "recycle", "ensure", "ensuring", "dispose",
                     "crush", "bend", "break"), "other"),
}  # fmt: skip
_CERTAIN = frozenset({"put", "pick", "move", "grasp", "grab", "bring", "take", "lift", "rotate", "transfer", "place",
                      "remove", "fetch"})  # fmt: skip
"""Verbs that are never nouns or adjectives, so that a bare noun may follow."""
_FILLERS = frozenset({
    "please", "kindly", "then", "now", "next", "finally", "first", "firstly", "second", "secondly", "third", "lastly",
    "also", "afterwards", "afterward", "just", "carefully", "gently", "and", ",", "but", "sequentially",
})  # fmt: skip
_ASKING = (
    ("could", "you"), ("can", "you"), ("would", "you"), ("will", "you"), ("you", "should"), ("you", "must"),
    ("you", "need", "to"), ("i", "want", "you", "to"), ("help", "me"), ("help", "me", "to"), ("let's",), ("let", "us"),
    ("your", "task", "is", "to"), ("the", "task", "is", "to"), ("make", "sure", "to"), ("go", "and"), ("you", "have",
    "to"),
    ("please", "help", "me"), ("go",),
)  # fmt: skip
_ACTORS = frozenset({"robot", "arm", "arms", "gripper", "agent", "manipulator", "hand", "hands", "robotic"})
_PARTICLES = frozenset({"up", "down", "away", "back", "out", "over", "off", "on", "close"})
_MODALS = frozenset({"should", "must", "shall", "will", "can", "could", "may", "might", "would"})
_GIVING = frozenset({"hand", "give", "bring", "pass", "fetch", "get"})
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
    aside: str = ""
    """What was left out of the sentence before it was read."""


def clauses(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Clause]:
    """The clauses of one sentence, which ends in a stop."""
    tokens = _handed(_ordered(tokens))
    starts: list[tuple[int, int]] = []
    """Where an instruction begins, and its verb."""
    verb = _verb_at(tokens, 0, nouns, opening=True)
    if verb is not None:
        starts.append((0, verb))
    for at in range(1 if verb is None else verb + 1, len(tokens) - 1):
        joint = tokens[at].text in (",", "and", "then", "-")
        doubled = tokens[at + 1].text in ("and", "then", ",")
        told = verb is not None or tokens[at + 1].text in _CERTAIN
        if joint and told and not doubled and (found := _verb_at(tokens, at + 1, nouns, opening=False)) is not None:
            starts.append((at, found))
    if not starts:
        return [Clause(tokens=tuple(tokens))]
    made: list[Clause] = []
    if verb is None:
        made.append(Clause(tokens=(*tokens[: starts[0][0]], tokens[-1])))
    ends = [start for start, _ in starts[1:]] + [len(tokens) - 1]
    for (start, verb), end in zip(starts, ends, strict=True):
        word = _base(tokens[verb].text)
        first = verb + 1
        while tokens[first].text in _PARTICLES and not (tokens[first].text == "on" and tokens[verb].text in _CERTAIN):
            first += 1
        body = list(tokens[first:end])
        for at, token in enumerate(body[:-1]):
            purpose = body[at + 1].text in _PURPOSES or _VERBS.get(body[at + 1].text) == "other"
            named = any(nouns.match([each.text]) for each in body[at + 2 :])
            if token.text == "to" and purpose and at and (not named or body[at + 1].text in _PURPOSES):
                body = body[:at]
                break
        while body and (body[-1].text in (",", "and", "then") or body[-1].text in _PARTICLES - {"on", "off"}):
            body.pop()
        stop = tokens[-1]
        begun = max(start, 0)
        said = text[tokens[begun].start : tokens[end - 1].end].lstrip(", ").removeprefix("and ").removeprefix("then ")
        made.append(Clause(tokens=(*body, stop), verb=word, manner=_VERBS[word], said=said))
    return made


def _ordered(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "the lemon should go into the bowl" as "put the lemon into the bowl"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 3):
        asks = words[at] in ("should", "must", "shall")
        asks = asks or (words[at] in ("needs", "need", "has", "have") and words[at + 1] == "to")
        verb = at + 1 + (words[at + 1] == "to")
        if not asks or words[verb] != "go" or not link_at(tokens, verb + 1) or words[0] not in lexicon.DETERMINERS:
            continue
        return [replace(tokens[0], text="put"), *tokens[:at], *tokens[verb + 1 :]]
    return tokens


def _handed(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "hand me the cup" as "fetch the cup", and "make sure" as "ensure"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        before, follower = (made[-1].text if made else ""), tokens[min(at + 1, len(tokens) - 1)].text
        if token.text in ("me", "us") and before in _GIVING:
            made[-1] = replace(made[-1], text="fetch")
            continue
        if token.text == "sure" and before in ("make", "making") and follower != "to":
            made[-1] = replace(made[-1], text="ensure", end=token.end)
            continue
        made.append(token)
    return made


def _base(word: str) -> str:
    for guess in (word, word.removesuffix("s"), word.removesuffix("es")):
        if guess in _VERBS:
            return guess
    return word


def known_verb(word: str) -> bool:
    """Whether `word` tells a robot what to do."""
    return word in _VERBS


def _verb_at(tokens: Sequence[Token], at: int, nouns: Nouns, *, opening: bool) -> int | None:
    """The verb of an instruction that begins at token `at`, or None."""
    actor = False
    while at < len(tokens) - 1:
        words = [token.text for token in tokens[at : at + 4]]
        asking = next(
            (each for each in sorted(_ASKING, key=len, reverse=True) if tuple(words[: len(each)]) == each), None
        )
        if asking:
            at += len(asking)
        elif words[0] in _FILLERS and (opening or words[0] != ","):
            at += 1
        elif opening and (after := _after_actor(tokens, at)):
            at, actor = after, True
        else:
            break
    word = tokens[at].text
    base = _base(word) if actor else word
    if base not in _VERBS or at + 1 >= len(tokens):
        return None
    follower = tokens[at + 1].text
    if follower in ("of", "full", "with", "filled"):
        # "Stack of books", "plate full of carrots"
        return None
    leads = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.PRONOUNS | {"both", "either"}
    if follower in leads or follower.isdecimal():
        return at
    if nouns.match([word, follower]):
        return None
    if follower in _PARTICLES and base in (
        "pick",
        "turn",
        "clean",
        "lift",
        "hand",
        "take",
        "switch",
        "set",
        "put",
        "push",
    ):
        return at
    noun = not tokens[at + 1].mark and (is_modifier(follower) or nouns.match([follower]) is not None)
    known = noun or follower in lexicon.GENERICS or nouns.match([*follower.split("-")]) is not None
    if base in _CERTAIN and not tokens[at + 1].mark:
        return at
    bare = base in ("stack", "open", "close", "sort", "pack", "push", "pull", "drop", "empty", "plate", "align", "add")
    goal = any(token.text in ("into", "in", "on", "onto", "to") for token in tokens[at + 2 : at + 6])
    if bare and (known or (goal and base not in ("open", "close"))) and opening and tokens[at].number == 1:
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
                if _base(after) in _VERBS:
                    return at + ahead + 1
            if word in (".", ","):
                break
        return 0
    if words[0] == "the":
        ahead = 1
        while ahead < len(words) and words[ahead] in _ACTORS:
            ahead += 1
        if ahead > 1:
            while ahead < len(words) and words[ahead] in (*_MODALS, "needs", "has", "to", "go"):
                ahead += 1
            if ahead < len(words) and _base(words[ahead]) in _VERBS:
                return at + ahead
    return 0


def task_of(world: World, names: Mapping[Item, str]) -> tuple[str | None, list[str]]:
    """The one task that the steps of `world` are, None where no kind of task is, and notes on what is not in it.

    Args:
        world: with what is to be done, in order.
        names: of the objects of the plan.
    """
    steps = world.steps
    notes = [f'not modelled: "{step.said}": no task does that.' for step in steps if step.manner == "other"]
    blocked = {item for step in steps if step.manner == "other" for item in step.items}
    wanted = [step for step in steps if step.manner != "other" and step.items]
    # To pick what is placed afterwards is the beginning of placing it.
    begun = [{item for later in wanted[at + 1 :] for item in later.items} | blocked for at in range(len(wanted))]
    wanted = [
        step
        for step, later in zip(wanted, begun, strict=True)
        if not (step.manner == "pick" and set(step.items) & later)
    ]
    specs: list[str] = []
    for step in wanted:
        made = _specs(step, world, names)
        if not made:
            notes.append(f'not modelled: "{step.said}": no task does that.')
        specs += made
    if len(specs) > 1:
        listed = ", ".join(specs)
        notes.append(f"the instruction is several tasks, of which the environment has one at a time: {listed}.")
        return None, notes
    return (specs[0] if specs else None), notes


def _specs(step: Step, world: World, names: Mapping[Item, str]) -> list[str]:
    if step.manner == "unload":
        edges = [(item, world.supports.get(item)) for item in step.items[:1]]
        # "unload the cups from the crate" is about the crate.
        holders = [edge.parent if edge is not None and edge.kind == "in" else item for item, edge in edges]
        likely = world.likely
        holders = [item for item in holders if likely.hollow(world.noun(item)) or likely.closet(world.noun(item))]
        return [f"unload:{names[item]}" for item in holders if item in names]
    if step.manner == "sort":
        return ["sort"] if len(step.goal) > 1 else []
    # No robot moves furniture.
    items = [item for item in step.items if item in names and not world.on_floor(item)]
    if step.manner == "pick":
        return [f"pick:{names[items[0]]}"] if len(items) == 1 else []
    goal = next((item for item in step.goal if item in names), None)
    if goal is not None and goal.group.height > 1:
        goal = world.tops(step.goal)[-1]
    if step.manner == "stack" and goal is None and len(items) == 2:
        return [f"stack:{names[items[0]]}:{names[items[1]]}"]
    if goal is None or step.link is None:
        return []
    support = step.link.kind in SUPPORT_KINDS or step.link.manner in ("goal", "half")
    fits = step.link.manner in ("place", "goal", "half") and support and step.link.says != "above"
    if not fits or step.link.kind == "hangs_from":
        return []
    noun = world.noun(goal)
    if step.link.manner == "half" and step.link.side != "centre" and not world.likely.level(noun):
        # "To the left side of the lamp" is beside it.
        return []
    stacked = step.manner == "stack" and not world.likely.hollow(noun) and not world.likely.level(noun)
    kind = "stack" if stacked else "place"
    moved = [item for item in items if item is not goal and world.support(item) is not goal]
    return [f"{kind}:{names[item]}:{names[goal]}" for item in moved]
