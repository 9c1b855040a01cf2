"""What is to be done, against the tasks and the scene before them: what is moved, where it is already, what is lost."""

from __future__ import annotations

from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.words import DEEDS
from pat3d.scene.task_spec import steps_of

_MOVING = frozenset({"take", "bring", "carry", "move", "deliver", "transfer", "return", "push", "slide", "get"})
_PUTTING = frozenset({"put", "place", "move", "set", "lay", "insert", "drop", "stack", "pick"})
_REACH = 12
"""Words from what is taken to where it is taken."""
_SHUT = frozenset({"bag", "backpack", "handbag", "suitcase", "briefcase", "fridge", "microwave", "toaster", "dryer",
                   "fryer", "cooker"})  # fmt: skip
_DEPTHS = frozenset({"bottom", "back", "rear", "front", "far"})
_GOALS = frozenset({"of", "to", "into", "onto", "in", "on"})
_FURTHER = frozenset({"another", "more", "further", "third", "fourth", "extra", "second", "other", "new", "else"})


def requests(it: Compared) -> Iterator[tuple[int, str]]:
    """What a request wants otherwise than the plan has it."""
    yield from _taken_to(it)
    yield from _there_already(it)
    yield from _forgotten(it)
    yield from _nothing_inside(it)
    yield from _one_more(it)
    yield from _posed_already(it)
    yield from _below(it)
    yield from _handed(it)
    yield from _out_of(it)
    yield from _emptied_into(it)


def _taken_to(it: Compared) -> Iterator[tuple[int, str]]:
    """What is to be taken somewhere and is there already: "take the plate to the table"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word in _MOVING):
        moved = next((one for one in it.said.mentions if at < one.start), None)
        if moved is None or moved.first > at + 1:
            continue
        goal = next((one for one in it.said.mentions if words[one.first - 1] == "to" and one.start > moved.end), None)
        if goal is None or goal.first > moved.end + _REACH or DEEDS & {*words[moved.end : goal.first - 1]}:
            continue
        names, places = ({obj.name for obj in it.which(one)} for one in (moved, goal))
        there = any(rel.supports and rel.child in names and rel.parent in places for rel in it.plan.relations)
        told = any(claim.of is not None and claim.of.noun == goal.noun and claim.place in ("on", "in", "from")
                   and claim.of is not goal for claim in it.said.claims)  # fmt: skip
        said = " ".join(words[at : goal.end])
        if there and not told and not it.named(said):
            yield at, f'not as said: "{said}"; it is there already'


def _there_already(it: Compared) -> Iterator[tuple[int, str]]:
    """Where something is to be put, and where the scene before the task has it: "... and the blue one on the shelf"."""
    if "is read as the scene" in it.quoted or not (it.tasks.strip() or it.undone):
        return
    words = it.said.words
    phrases = {obj.name: obj.phrase.lower().split() for obj in it.plan.objects}
    landmarks = {claim.of.end for claim in it.said.claims if claim.of is not None}
    for claim in it.said.claims:
        start = max((at + 1 for at in range(claim.at) if words[at] in (".", ";", "!", "then")), default=0)
        goal = claim.place in ("on", "on top", "in") and claim.of is not None
        ends = words[claim.end : claim.end + 1] in ([], ["."], [","], ["and"], [";"], ["then"])
        if not goal or not ends or claim.of is None or words[start] not in _PUTTING - {"pick"} or claim.at in landmarks:
            continue
        places = {obj.name for obj in it.which(claim.of)}
        for rel in it.plan.relations:
            phrase = phrases[rel.child]
            behind = (
                words[claim.at - len(phrase) : claim.at] == phrase and words[claim.at - len(phrase) - 1] not in _GOALS
            )
            kept = {"leave", "keep", "leaving"} & {*words[start : claim.at]}
            if (
                rel.supports
                and rel.parent in places
                and phrase
                and behind
                and not kept
                and not it.named(" ".join(phrase))
            ):
                yield claim.at, f'"{" ".join(phrase)} {claim.said}" is read as where it is before the task'


def _forgotten(it: Compared) -> Iterator[tuple[int, str]]:
    """What is added to what is to be moved, and is in no task: "put the cup on the tray and then the bowl"."""
    words = it.said.words
    if not it.tasks.strip() or "unload" in it.tasks:
        return
    subjects = [claim.of for claim in it.said.claims]
    for mention in it.said.mentions:
        start = max((at + 1 for at in range(mention.first) if words[at] in (".", ";", "!")), default=0)
        before, behind = words[mention.first - 1 : mention.first], words[mention.end : mention.end + 1]
        added = before in (["then"], ["also"]) or (before == [","] and words[mention.first - 2] != ",")
        free = words[mention.first] == "the" and behind in ([], ["."], [","], ["and"])
        if words[start] not in _PUTTING or not added or not free or mention in subjects:
            continue
        names = {obj.name for obj in it.which(mention)}
        landmark = any(b in names for _, _, b in it.edges if not b.isdigit()) and before == [","]
        tasked = any(name in it.tasks for name in names)
        if names and not tasked and not landmark and mention.text not in it.quoted:
            yield mention.start, f'"the {mention.text}" is in no task'


def _nothing_inside(it: Compared) -> Iterator[tuple[int, str]]:
    """What is to be emptied, and holds nothing."""
    kind, _, name = (it.plan.task or "").partition(":")
    if kind == "unload" and not any(rel.supports and rel.parent == name for rel in it.plan.relations):
        yield 0, f'"{name}" is to be emptied; what is in it is not said'


def _one_more(it: Compared) -> Iterator[tuple[int, str]]:
    """What "a box" is one more of, though several were told of before: "there are two boxes. A ball is in a box"."""
    words = it.said.words
    if _FURTHER & {*words}:
        return
    for mention in it.said.mentions:
        phrase = words[mention.first : mention.end]
        own = [obj for obj in it.plan.objects if obj.phrase.lower().split() == phrase]
        before = [one for one in it.said.mentions
                  if one.noun == mention.noun and one.part < mention.part and (one.number or 0) > 1
                  and {*one.colours} <= {*mention.colours}]  # fmt: skip
        if phrase[0] not in ("a", "an") or not own or not before or mention.text in it.told:
            continue
        several = before[-1]
        if len(it.of(several)) > (several.number or 0):
            said = " ".join(words[several.first : several.end])
            yield mention.start, f'"{" ".join(phrase)}" is read as one more than "{said}"'


def _posed_already(it: Compared) -> Iterator[tuple[int, str]]:
    """How something is to be turned, where it stands so before the task: "put the mug upside down on the tray"."""
    words = it.said.words
    if not it.tasks.strip() or words[0] not in _PUTTING | {"turn", "flip"}:
        return
    turned = {one.object for one in it.plan.postures if one.arranged and one.kind == "upside_down"}
    for at in (at for at in range(2, len(words)) if words[at - 1 : at + 1] == ["upside", "down"]):
        before = next((one for one in it.said.mentions if one.end == at - 1), None)
        if before is not None and turned & {obj.name for obj in it.which(before)} and "upside" not in it.quoted:
            yield at, f'"upside down" of "{before.text}" is read as how it stands before the task'


def _below(it: Compared) -> Iterator[tuple[int, str]]:
    """What is to go "to the bottom of the cube" or "to the back of the stove": no task says where on it."""
    words = it.said.words
    for at in range(1, len(words) - 3):
        side = words[at + 2]
        deep = words[at : at + 2] == ["to", "the"] and side in _DEPTHS and words[at + 3] == "of"
        if deep and it.tasks.strip() and f'"to the {side} of' not in it.quoted:
            yield at, f'"to the {side} of {" ".join(words[at + 4 : at + 6])}" is read as where the task puts it'


def _handed(it: Compared) -> Iterator[tuple[int, str]]:
    """Whom "hand me the pen" is said by: nobody is there to take it."""
    words = it.said.words
    handed = words[:2] in (["hand", "me"], ["bring", "me"], ["pass", "me"], ["hand", "us"]) and "pick:" in it.tasks
    if handed and f'"{words[0]}' not in it.quoted:
        yield 0, f'"{words[0]} {words[1]}" is read as picking it up'


def _out_of(it: Compared) -> Iterator[tuple[int, str]]:
    """What is to be taken "from the bag", and lies on it before."""
    for claim in it.said.claims:
        if claim.place != "from" or claim.of is None or not {*claim.of.noun.split()} & _SHUT or it.named(claim.of.text):
            continue
        vessels = {obj.name for obj in it.which(claim.of)}
        upon = [rel for rel in it.plan.relations if rel.kind == "on" and rel.parent in vessels]
        for rel in upon[:1]:
            yield claim.at, f'not arranged: "{rel.child}" inside "{claim.of.text}"; it is placed on it'


def _emptied_into(it: Compared) -> Iterator[tuple[int, str]]:
    """Where what is in a box is to go, of which a task that empties the box tells nothing."""
    emptied = {names[0] for kind, *names in steps_of(it.plan.task or "") if kind == "unload"}
    for claim in it.said.claims if emptied else ():
        goals = (
            {obj.name for obj in it.which(claim.of)}
            if claim.of is not None and claim.said[:3] in ("in ", "on ")
            else set()
        )
        if goals and not goals & (emptied | {b for _, _, b in it.edges}) and not it.named(claim.said):
            yield claim.at, f'not as said: "{claim.said}"; the task is to empty'
