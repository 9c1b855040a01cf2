"""Whether a sentence that somebody else wrote means a task: the same objects, the same goal, nothing else.

It decides on the side of refusing, for where it refuses there are wordings of ours. What it looks at are the names of
the scene's objects as `spoken` has them, words of moving and where they stand, and what our own reader of sentences
makes of it, where it makes a task of it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from pat3d.assets.catalogue import find
from pat3d.assets.colours import find_colour
from pat3d.envs.tasks.beside import Beside
from pat3d.envs.tasks.naming import spoken
from pat3d.envs.tasks.task import Task
from pat3d.errors import Pat3dError
from pat3d.scene.model import Scene
from pat3d.scene.relations import RELATION_WORDS

MAX_LETTERS = 200
"""Of a sentence."""

_LETTERS = re.compile(r"[A-Za-z0-9 ,.;:'\-?!]+")
_WORD = re.compile(r"[a-z0-9']+")

_TAKE = {"pick", "grab", "lift", "take", "hold", "raise", "get", "grasp", "fetch", "retrieve", "bring", "collect"}
_PUT = {"put", "place", "set", "leave", "lay", "move", "drop", "deposit", "stack", "rest", "transfer", "pile", "goes"}
_GOAL = {
    "place": ("in", "into", "inside", "on", "onto", "upon", "to"),
    "stack": ("on", "onto", "upon", "atop"),
}
_SIDE = {
    "left_of": r"left (?:side )?of",
    "right_of": r"right (?:side )?of",
    "in_front_of": r"front of",
    "behind": r"behind",
    "next_to": r"next to|beside",
}
"""What stands before the thing beside which another is put, by relation."""

_SOURCE = {"from", "off", "out of", "on", "in", "inside"}
"""Before what something is taken from."""

_TAKEN = ("pick", "unload", "retrieve", "carry", "handover")
"""Kinds of task that put nothing anywhere, but for the words of ours."""

_READ_AS = {
    "place": "put", "stack": "put", "pick": "take", "retrieve": "take", "carry": "take", "handover": "take",
    "lift": "take", "push": "beside",
}  # fmt: skip
"""Kinds of task between which our reader of sentences does not tell."""

_ALSO = {
    "sort": (("colour", "color", "colours", "colors"),),
    "unload": (("everything", "all", "empty", "nothing", "clear", "unload"),),
    "retrieve": (
        ("knocking", "knock", "topple", "topples", "toppling", "fall", "falling", "upright", "tip", "tipping"),
    ),
    "rearrange": (("picture", "image", "photo"),),
    "carry": (("both", "two", "each"),),
    "handover": (("left",), ("right",)),
    "lift": (("back", "down", "return", "again", "leave"),),
    "push": (("push", "slide", "shove", "nudge", "without", "not"),),
}
"""Of each group, one word has to be there."""

_TURNING = {
    "not", "never", "no", "none", "nothing", "except", "instead", "without", "unless", "dont", "avoid", "before",
    "after", "then", "left", "right", "top", "bottom", "first", "second", "third", "last", "middle", "behind", "front",
    "beside", "under", "below", "above", "near", "next", "between", "both", "two", "three", "all", "every",
    "everything", "other", "another", "open", "close", "pour", "push", "throw",
}  # fmt: skip
"""Words that change what is meant: they may stand only where a wording of ours has them."""

_MEASURES = {
    "left", "right", "front", "behind", "away", "towards", "ahead", "forward", "backward", "near", "far", "middle",
    "edge", "corner", "cm",
}  # fmt: skip
"""Words that no wording may leave out where the instruction has them, like numbers."""

_EVERYWHERE = {"table", "desk", "surface", "robot", "hand", "arm", "object", "item", "thing", "please"}
"""Nouns that may stand in any instruction, as they single out nothing."""


def fault(sentence: str, task: Task, scene: Scene) -> str | None:
    """Why `sentence` does not mean `task` in `scene`; None where nothing speaks against it."""
    if len(sentence) > MAX_LETTERS or not _LETTERS.fullmatch(sentence):
        return f"longer than {MAX_LETTERS} characters, or with others than letters, digits and marks"
    ours = task.wordings(scene)
    said, meant = _named(sentence, scene), _named(ours[0], scene)
    if sorted(set(said.names)) != sorted(set(meant.names)):
        return f"it names {_told(said.names)}, not {_told(meant.names)}"
    known = {word for text in ours for word in _named(text, scene).rest}
    measures = [word for word in meant.rest if word in _MEASURES or word.isdigit()]
    if unsaid := set(measures) - set(said.rest):
        return f"it does not say {_told(sorted(unsaid))}"
    for word in said.rest:
        if word not in known and (word in _TURNING or word.isdigit() or word.endswith("n't")):
            return f'"{word}" changes what is meant'
        if word not in known and word not in _EVERYWHERE and _means_a_thing(word):
            return f'"{word}" is another thing, or another colour'
    return _misdirected(sentence, task, scene, said) or _read_otherwise(sentence, task, scene)


def alike(sentence: str) -> tuple[str, ...]:
    """Equal for sentences that differ in marks, capitals and the order of words alone."""
    return tuple(sorted(_WORD.findall(sentence.lower())))


class _Said:
    """A sentence as names of objects and other words."""

    def __init__(self, names: Sequence[str], rest: Sequence[str], marked: str) -> None:
        self.names, self.rest, self.marked = tuple(names), tuple(rest), marked


def _named(sentence: str, scene: Scene) -> _Said:
    """Which objects a sentence names, in their order; `marked` has "@k" for the k-th."""
    known = sorted({spoken(scene, obj.name).lower() for obj in scene.objects}, key=len, reverse=True)
    if not known:
        return _Said((), (), sentence.lower())
    names: list[str] = []

    def mark(match: re.Match[str]) -> str:
        names.append(match[0])
        return f"@{len(names) - 1}"

    either = "|".join(re.escape(one) for one in known)
    marked = re.sub(rf"(?<![\w-])(?:{either})(?![\w-])", mark, sentence.lower())
    marked = re.sub(r"\bon(?:to)? top of\b", "upon", marked)
    return _Said(names, _WORD.findall(re.sub(r"@\d+", " ", marked)), marked)


def _told(names: Sequence[str]) -> str:
    return ", ".join(f'"{one}"' for one in dict.fromkeys(names)) or "nothing"


@cache
def _means_a_thing(word: str) -> bool:
    """Whether a word is a colour or a noun of the catalogue."""
    return any(one is not None for one in (find_colour(word), find(word), find(word.removesuffix("s"))))


def _misdirected(sentence: str, task: Task, scene: Scene, said: _Said) -> str | None:
    """What speaks against the goal, by words and where they stand."""
    words = set(said.rest)
    ours = {word for text in task.wordings(scene) for word in _named(text, scene).rest}
    if task.kind in _TAKEN and (wrong := words & _PUT - ours):
        return f'"{sorted(wrong)[0]}" puts it somewhere'
    for group in _ALSO.get(task.kind, ()):
        if words.isdisjoint(group):
            return f"it says none of {_told(group)}"
    if task.kind == "handover" and said.rest.index("left") > said.rest.index("right"):
        return "the hands are the other way round"
    if task.kind == "pick":
        if words.isdisjoint(_TAKE):
            return "it does not say that something is taken"
        target = spoken(scene, task.names[0]).lower()
        for name in dict.fromkeys(said.names):
            before = set(_before(said, name))
            if (before != {""}) if name == target else not before <= _SOURCE:
                return f"it does not say that {_told([target])} is taken"
    if task.kind in _GOAL:
        if words.isdisjoint(_PUT):
            return "it does not say that something is put somewhere"
        moved, goal = (spoken(scene, one).lower() for one in task.names)
        before = {name: set(_before(said, name)) for name in (moved, goal)}
        goals = set(_GOAL[task.kind])
        if not before[goal] <= goals or before[moved] & {*goals, "from", "off", "out of"}:
            return f"it does not say that {_told([moved])} goes to {_told([goal])}"
    if isinstance(task, Beside):
        if words.isdisjoint(_PUT):
            return "it does not say that something is put somewhere"
        sides = rf"\b(?:{_SIDE[task.relation]})\s+(?:the\s+)?@(\d+)\b"
        beside = {said.names[int(number)] for number in re.findall(sides, said.marked)}
        if beside != {spoken(scene, task.landmark).lower()}:
            where = f"{RELATION_WORDS[task.relation]} {_told([spoken(scene, task.landmark)])}"
            return f"it does not say that {_told([spoken(scene, task.target)])} goes {where}"
    if task.kind == "chain" and said.names != _named(task.instruction(scene), scene).names:
        return "it names things in another order"
    return None


def _before(said: _Said, name: str) -> list[str]:
    """The preposition before every mention of an object, "" for none."""
    found = []
    for number, one in enumerate(said.names):
        if one == name:
            match = re.search(
                rf"\b(out of|from|off|into|inside|onto|upon|atop|in|on|to)\s+(?:the\s+)?@{number}\b",
                said.marked,
            )
            found.append(match[1] if match else "")
    return found


def _read_otherwise(sentence: str, task: Task, scene: Scene) -> str | None:
    """What our own reader makes of the sentence, where it makes another task of it."""
    theirs, ours = _reading(sentence), _reading(task.instruction(scene))
    if theirs is None:
        return None
    another = theirs[0] != _READ_AS.get(task.kind, task.kind)
    return f"it reads as {':'.join(theirs)}" if another or ours not in (None, theirs) else None


@cache
def _reading(sentence: str) -> tuple[str, ...] | None:
    """The kind and the objects of the task that a sentence says, what is moved first, or None."""
    from pat3d.plan.grammar.planner import GrammarPlanner

    try:
        task = GrammarPlanner().plan(sentence).task
    except Pat3dError:
        return None
    if task is None:
        return None
    kind, *names = task.split(":")
    return _READ_AS.get(kind, kind), *names
