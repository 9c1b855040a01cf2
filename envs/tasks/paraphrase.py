"""Instructions in other words: several wordings a task, all of which mean the same objects."""

from __future__ import annotations

from collections.abc import Sequence

POLITE = (
    "please {}",
    "could you {}?",
    "robot, {}",
    "your task: {}",
    "i need you to {}",
    "now {}, please",
)

_PICK = (
    "pick up {it}{source}",
    "grab {it}{source}",
    "lift {it}{source}",
    "take {it}{source} and hold it up",
    "get hold of {it}{source} and raise it",
)

_LIFT = (
    "lift {it} and put it back",
    "pick up {it}, then set it down where it was",
    "raise {it} a little and return it to its place",
    "take {it} off the table for a moment and leave it where it stood",
)

_PLACE = (
    "put {it} {how} {where}",
    "place {it} {how} {where}",
    "move {it} so that it ends up {how} {where}",
    "take {it} and leave it {how} {where}",
    "{it} belongs {how} {where}; put it there",
)

_BESIDE = (
    "put {it} {where}",
    "place {it} {where}",
    "move {it} so that it stands {where}",
    "take {it} and set it down {where}",
    "i want {it} {where}; put it there",
)

_STACK = (
    "stack {it} on {where}",
    "put {it} on top of {where}",
    "set {it} down on {where} so that it stays there",
    "make a stack of two: put {it} on {where}",
    "i want {it} on top of {where}; put it there",
)

_SORT = (
    "sort the objects by colour into {where}",
    "put every object into the container of its own colour: {where}",
    "tidy up: the objects go into {where}, each with its own colour",
    "match colours: every object goes into the container of the same colour, {where}",
)

_UNLOAD = (
    "take everything {how} {where}",
    "{verb} {where}",
    "remove everything that is {inside} {where}",
    "leave nothing {inside} {where}; set everything down beside it",
)

_RETRIEVE = (
    "take out {it}{source} without knocking anything over",
    "get {it}{source}, and let nothing fall over",
    "i want {it}{source}; whatever else is there has to stay upright",
    "carefully fetch {it}{source} so that nothing else topples",
)

_REARRANGE = (
    "move {them} to where the goal picture shows them",
    "make the table look like the goal picture: {them}",
    "rearrange {them} as in the goal picture",
    "put {them} as the picture of the goal has them",
)

_PUSH = (
    "push {it} {where}",
    "slide {it} {where} without lifting it",
    "move {it} {where}, but do not pick it up",
    "shove {it} along the table, {where}",
    "without lifting {it}, get it {where}",
)

_OPEN = (
    "open {it}",
    "pull {it} open",
    "get {it} open",
    "open {it} by its handle and leave it open",
)

_CLOSE = (
    "close {it}",
    "push {it} shut",
    "shut {it}",
    "push {it} back until it is closed",
)

_CARRY = (
    "lift {it}{source} with both hands and keep it level",
    "take {it}{source} with both arms and hold it up without tilting it",
    "with two hands, raise {it}{source}; it has to stay level",
    "carry {it}{source} together, one hand on each side",
)

_HANDOVER = (
    "pick up {it}{source} with the left hand and hand it over to the right hand",
    "take {it}{source} with your left hand, then hold it with the right one alone",
    "pass {it}{source} from the left arm to the right arm",
    "left hand, give {it}{source} to the right hand",
)

WORDINGS = {
    "pick": _PICK,
    "lift": _LIFT,
    "place": _PLACE,
    "beside": _BESIDE,
    "stack": _STACK,
    "sort": _SORT,
    "unload": _UNLOAD,
    "retrieve": _RETRIEVE,
    "rearrange": _REARRANGE,
    "push": _PUSH,
    "open": _OPEN,
    "close": _CLOSE,
    "carry": _CARRY,
    "handover": _HANDOVER,
}
"""By kind of task; the first is the instruction itself."""


_IN_TURN = (
    ("first ", ", then ", ", then "),
    ("", "; after that, ", "; and finally, "),
    ("", " and then ", " and then "),
    ("one after the other: ", ", ", ", and "),
)
"""Before the first of several things to do, between them, and before the last."""


def in_turn(steps: Sequence[str]) -> tuple[str, ...]:
    """All wordings of several things to do in this order."""
    if len(steps) == 1:
        return (steps[0],)
    return tuple(f"{before}{between.join(steps[:-1])}{last}{steps[-1]}" for before, between, last in _IN_TURN)


def listed(parts: Sequence[str]) -> str:
    """Several things in a sentence: "a", "a and b", "a, b and c"."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def worded(kind: str, **words: str) -> tuple[str, ...]:
    """All wordings of a task of this kind, the plain one first."""
    return tuple(template.format(**words) for template in WORDINGS[kind])


def politely(instruction: str) -> tuple[str, ...]:
    """The same as one asks a person for it."""
    return tuple(template.format(instruction) for template in POLITE)
