"""Several places said of one thing: "behind the jug, and left of the pan", "on the desk beside the cup lies a pen"."""

from __future__ import annotations

from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.subjects import row_of, said_of
from pat3d.plan.audit.text import Claim, Mention
from pat3d.plan.audit.words import FINITE, OPENING, POSED
from pat3d.plan.scene_plan import PlannedObject

_CHECKED = frozenset({"on", "on top", "in", "beside", "left", "right", "front", "behind", "under", "above", "between"})
_CUTLERY = frozenset({"fork", "knife", "spoon", "napkin", "chopsticks", "glass", "saucer"})


def chained(it: Compared) -> Iterator[tuple[int, str]]:
    """Places that the plan has of a landmark, not of what they are said of."""
    if it.tasks.strip() or it.undone:
        return
    claims = [claim for claim in it.said.claims if claim.place in _CHECKED]
    for one, other in zip(claims, claims[1:], strict=False):
        subjects = _joined(it, one, other, claims) or _fronted(it, one, other)
        if other.of is not None and other.of.noun in it.furniture and subjects == _fronted(it, one, other):
            # "On the rug next to the bed stands a lamp": the rug may be next to the bed.
            continue
        if subjects and other.of is not None and one.of is not None and not it.excused(other):
            yield from _of_the_landmark(it, one.of, other, subjects)
    yield from _on_which(it)
    yield from _all_inside(it)
    yield from _in_the_last(it)
    yield from _either_side(it)
    yield from _beside_it(it)


def _of_the_landmark(
    it: Compared, landmark: Mention, claim: Claim, subjects: list[Mention]
) -> Iterator[tuple[int, str]]:
    if claim.of is None:
        return
    of, kinds = {obj.name for obj in it.which(claim.of)}, it.kinds(claim)
    names = {obj.name for one in subjects for obj in it.which(one)}
    wrong = {obj.name for obj in it.which(landmark)} - names
    if of and names and not any(a in names and b in of and kind in kinds for a, kind, b in it.edges):
        held = any(a in wrong and b in of and kind in kinds for a, kind, b in it.edges)
        what = f'is read as said of "{landmark.text}"' if held else f'is not read as said of "{subjects[-1].text}"'
        yield claim.at, f'"{claim.said}" {what}'


def _joined(it: Compared, one: Claim, other: Claim, claims: list[Claim]) -> list[Mention]:
    """What `other` is said of, where only a comma or "and" joins it to `one`; none where it is open."""
    words = it.said.words
    between = words[one.end : other.at]
    ends = words[other.end : other.end + 1] in ([], ["."], [","], ["and"], [";"])
    if one.of is None or not between or not {*between} <= {",", "and"} or not ends or one.part != other.part:
        return []
    before = [claim for claim in claims if claim.at < one.at and claim.part == one.part]
    if before and before[-1].of is not None and (chain := _joined(it, before[-1], one, claims)):
        return chain
    subjects, finite = said_of(it, one)
    behind = [claim for claim in it.said.claims if claim.at >= other.end and claim.part == other.part]
    opens = words[other.end : other.end + 1] == [","] and words[other.end + 1 : other.end + 2] and (
        words[other.end + 1] in POSED | {"a", "an", "there"} and not behind)  # fmt: skip
    return subjects if finite and not opens else []


def _fronted(it: Compared, one: Claim, other: Claim) -> list[Mention]:
    """What stands behind two places with which a sentence begins: "on the desk beside the cup lies a pen"."""
    words = it.said.words
    begins = one.at == 0 or words[one.at - 1] in (".", ";")
    between = words[one.end : other.at]
    at = other.end + (words[other.end : other.end + 1] == [","])
    if not begins or between not in ([], [","]) or not words[at : at + 1] or words[at] not in FINITE | {"there"}:
        return []
    floor = it.furniture | {"rug", "mat", "carpet"}
    if one.of is not None and other.of is not None and {one.of.noun, other.of.noun} <= floor:
        # "On the rug beside the bed stands a lamp": the rug is beside the bed too.
        return []
    while at < len(words) and words[at] in POSED | {"there", "'s"}:
        at += 1
    return [mention for mention in it.said.mentions if mention.first == at]


def _on_which(it: Compared) -> Iterator[tuple[int, str]]:
    """What is on what stands right before "on which"."""
    words = it.said.words
    for claim in it.said.claims:
        if claim.place not in ("on", "on top", "in") or words[claim.end - 1 : claim.end + 1][:1] != ["which"]:
            continue
        end = claim.at - (words[claim.at - 1] == ",")
        landmark = next((one for one in it.said.mentions if one.end == end), None)
        at = claim.end
        while at < len(words) and words[at] in POSED | {"there", "'s"}:
            at += 1
        thing = next((one for one in it.said.mentions if one.first == at), None)
        if landmark is None or thing is None or it.named(thing.text) or it.named(claim.said):
            continue
        names, of = ({obj.name for obj in it.which(one)} for one in (thing, landmark))
        kinds = it.kinds(claim)
        if names and of and not any(a in names and b in of and kind in kinds for a, kind, b in _direct(it)):
            yield claim.at, f'"{landmark.text} {claim.said}": "{thing.text}" is not read as there'


def _direct(it: Compared) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in it.plan.relations}


def _all_inside(it: Compared) -> Iterator[tuple[int, str]]:
    """All that "inside" at the end is said of: "a crate with a saw, two files and a roll of tape inside"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "inside" and at):
        if words[at + 1 : at + 2] not in ([], ["."], [","]) or words[at - 1] in OPENING:
            continue
        last = next((one for one in it.said.mentions if one.end == at), None)
        if last is None:
            continue
        whole = [one for one in it.said.mentions if words[last.first - 1] == "of" and one.end == last.first - 1]
        things = row_of(it, (*whole, last)[0])
        claim = next((one for one in it.said.claims if one.place in ("with", "holding") and one.of in things), None)
        owner = next((one for one in it.said.mentions if claim is not None and one.end <= claim.at), None)
        if claim is None or owner is None:
            continue
        before = [one for one in it.said.mentions if one.end <= claim.at]
        of = {obj.name for one in before for obj in it.which(one)}
        inside = {a for a, kind, b in it.edges if kind == "in" and b in of}
        lacking = [one for one in things if one not in before and it.which(one)
                   and not {obj.name for obj in it.which(one)} <= inside]  # fmt: skip
        if inside and lacking and not it.named(lacking[0].text):
            yield at, f'not as said: "inside" of "{lacking[0].text}"'


def _in_the_last(it: Compared) -> Iterator[tuple[int, str]]:
    """What a place at the end of a list is said of: "the bench holds a saw, a drill and six nails in a jar"."""
    for claim in it.said.claims:
        last = next((one for one in it.said.mentions if one.end == claim.at), None)
        if claim.place not in ("in", "on") or claim.of is None or last is None:
            continue
        things = row_of(it, last)
        leading = next((one for one in it.said.claims if one.of is things[0] and one.at < claim.at), None)
        verb = leading is not None and leading.place in ("holding", "on")
        held = verb and leading is not None and it.said.words[leading.at] not in ("holding", "containing")
        if len(things) < 2 or not held or it.said.words[claim.end : claim.end + 1] not in ([], ["."]):
            continue
        of = {obj.name for obj in it.which(claim.of)}
        first = {obj.name for obj in it.which(things[0])}
        own = {obj.name for obj in it.which(last)}
        if not first & own and any(a in first and b in of and kind in ("in", "on") for a, kind, b in _direct(it)):
            yield claim.at, f'"{claim.said}" is read as said of "{things[0].text}" too'


def _either_side(it: Compared) -> Iterator[tuple[int, str]]:
    """The landmark of "a lamp to the left of the sofa and a plant to the right of it": the same for both."""
    for claim in it.said.claims:
        before = [one for one in it.said.claims if one.end <= claim.at and one.part == claim.part][-1:]
        opposite = before and {before[0].place, claim.place} in ({"left", "right"}, {"front", "behind"})
        thing = next((one for one in it.said.mentions if one.end == claim.at), None)
        if not opposite or claim.of is not None or it.said.words[claim.end - 1] != "it" or thing is None:
            continue
        landmark = before[0].of
        if landmark is None or it.said.words[before[0].end : thing.first] not in (["and"], [","], [",", "and"]):
            continue
        names, of = ({obj.name for obj in it.which(one)} for one in (thing, landmark))
        kinds = it.kinds(claim)
        if names and of and not any(a in names and b in of and kind in kinds for a, kind, b in it.edges):
            yield claim.at, f'"{claim.said}": "{it.said.words[claim.end - 1]}" is not read as "{landmark.text}"'


def _beside_it(it: Compared) -> Iterator[tuple[int, str]]:
    """What is on a plate or in a vase, and is read as beside it: "a plate with a bun and a fork next to it"."""
    for claim in it.said.claims:
        if claim.place not in ("beside", "behind", "front", "left", "right") or it.said.words[claim.end - 1] != "it":
            continue
        last = next((one for one in it.said.mentions if one.end in (claim.at, claim.at - 1)), None)
        things = row_of(it, last) if last is not None else []
        words, before = it.said.words, [one for one in it.said.mentions if last is not None and one.end < last.first]
        if (
            last is not None
            and len(before) > 2
            and words[last.first - 1] == "and"
            and words[before[-1].first - 1] == "of"
        ):
            # "A blender, and a cup of figs and two pears next to it": the cup is next to the blender as well.
            of, own = ({obj.name for obj in it.which(one)} for one in (before[-2], last))
            again = words[before[-2].first - 1] == "and" and before[-2].end == before[-1].first - 1
            if again and any({a, b} & of and {a, b} & own for a, _, b in it.edges):
                yield claim.at, f'"{claim.said}" is read as next to "{before[-2].text}"'
        having = next((one for one in it.said.claims if things and one.of is things[0]), None)
        owner = next((one for one in it.said.mentions if having is not None and one.end == having.at), None)
        if having is None or owner is None or having.place != "with" or len(things) < 2:
            continue
        alike = {one.noun.split()[-1] for one in things} <= _CUTLERY
        names, of = ({obj.name for obj in it.which(one)} for one in (things[0], owner))
        held = any(a in names and b in of and kind in ("on", "in") for a, kind, b in _direct(it))
        if names and of and not held and not alike and not it.named(things[0].text):
            yield claim.at, f'"{claim.said}" is read as said of "{things[0].text}" too'


def listed_place(it: Compared, obj: PlannedObject) -> str:
    """What is said of `obj` in one list with another of which it is read: "beside a clock and a globe"."""
    words, joints = it.said.words, (["and"], [","], [",", "and"])
    mention = next((one for one in it.said.mentions if obj in it.which(one)), None)
    if mention is None:
        return ""
    for claim in it.said.claims:
        landmark = claim.of is not None and words[claim.of.end : mention.first] in joints
        if claim.place not in _CHECKED or (words[mention.end : mention.end + 1] and words[mention.end] in FINITE):
            continue
        mate = next((one for one in it.said.mentions if one.end == claim.at), None)
        subject = mate is not None and words[mention.end : mate.first] in joints
        if (landmark or subject) and claim.of is not None and it.which(claim.of):
            return f'"{claim.said}" is not read as said of it'
    return ""
