"""Relation words against the edges of a plan: what is said of which object, and whether it stands so."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from pat3d.plan.audit.compared import KINDS, Compared
from pat3d.plan.audit.text import Claim, Mention
from pat3d.plan.audit.words import (
    BACKWARD,
    CLOSED,
    EACH,
    FARTHEST,
    FINITE,
    HOLLOW,
    NUMBERS,
    OPENING,
    PRECISELY,
    REACHING,
    SPREAD,
)


def broken(it: Compared, claim: Claim) -> str | None:
    """What the plan does not have of `claim`, as a note; None where it has it, or a note says so already."""
    of = [obj.name for obj in it.which(claim.of)] if claim.of is not None else []
    if claim.of is not None and not of:
        return None
    asked = claim.of is None and (it.tasks.strip() or it.undone)
    if it.excused(claim) or claim.said in it.undone or asked or any(name in it.tasks for name in of):
        return None
    if (it.plan.task or "").startswith("sort") and claim.place in ("in", "on"):
        # "Sort the blocks into the boxes"
        return None
    if {*it.said.words[claim.at - 1 : claim.at]} & FARTHEST and it.beside_row(of):
        return None
    if claim.place == "far" and it.tasks.strip() and any(b in of and kind in ("on", "in") for _, kind, b in it.edges):
        # "Take the cup away from the table": before the task it is there.
        return None
    turned = {each.object for each in it.plan.postures if each.kind == "upside_down"}
    upset = any(a in turned and b in of and kind == "on" for a, kind, b in it.edges)
    if (claim.place == "above" and upset) or not _holds(it, claim, _here(it, claim), of):
        return f'not as said: "{claim.said}"'
    whose = set() if fronted(it, claim) else whose_of(it, claim)
    if whose and not all(
        _holds(it, claim, some, of) for some in ([{one} for one in whose] if claim.whole else [whose])
    ):
        of_what = '" or "'.join(dict.fromkeys(mention.text for mention in claim.whose))
        return f'"{claim.said}" is not read as said of {"all " * claim.whole}"{of_what}"'
    return None


def whose_of(it: Compared, claim: Claim) -> set[str]:
    """The objects that `claim` can only be said of: of several names, those of which there are several objects."""
    named = [[obj.name for obj in it.which(mention)] for mention in claim.whose]
    several = [names for names in named if len(names) > 1]
    below = {below for names in named for name in names for below in it.above(name)}
    if claim.whole and not several and len(named) > 1:
        # "A box and a can are on a desk. Each holds a nut.": the box and the can.
        return {name for names in named for name in names} - below
    several = several or named
    return set(several[-1] if claim.whole and several else (name for names in several for name in names))


def _here(it: Compared, claim: Claim) -> set[str]:
    """The objects that `claim` may be said of: those named with it, and where it is a pronoun's, before it."""
    words = set(it.said.words)
    alone = any(one in NUMBERS and two in FINITE for one, two in pairwise(it.said.words))
    reach = bool(words & REACHING) or ":" in words or alone
    named = {obj.name for mention in it.said.mentions for obj in it.of(mention)}
    return {obj.name for obj in it.plan.objects if obj.name not in named} | {
        obj.name
        for mention in it.said.mentions
        if mention is not claim.of and (mention.part == claim.part or reach)
        for obj in it.of(mention)
    }


def _before(it: Compared, at: int) -> list[Mention]:
    return [mention for mention in it.said.mentions if mention.end <= at]


def _just_before(it: Compared, claim: Claim, names: Sequence[str]) -> bool:
    """Whether `names` are what is named right before `claim`, one after the other or by one plural."""
    near = {obj.name for mention in _before(it, claim.at)[-3:] for obj in it.of(mention)}
    child = {obj.name for mention in it.said.mentions if mention.start > claim.at for obj in it.of(mention)}
    child |= {obj.name for mention in _before(it, claim.at)[-1:] if mention.end == claim.at for obj in it.of(mention)}
    # "A cup and a bowl are on a table. A spoon is between them."
    near |= {obj.name for mention in _before(it, claim.at) if mention.part < claim.part for obj in it.of(mention)}
    return set(names) <= near and not set(names) & child


def _opens(it: Compared, claim: Claim) -> bool:
    """Whether a clause may begin with `claim`, so that what it is said of stands behind it."""
    words, at = it.said.words, claim.at
    while at and words[at - 1] in PRECISELY:
        at -= 1
    if at == 0 or words[at - 1] in OPENING or not words[at - 1][0].isalnum():
        return True
    # "On the desk next to the laptop is a mug"
    ahead = [each for each in it.said.claims if each.of is not None and each.of.end == claim.at]
    return words[claim.end - 1] not in BACKWARD and any(_opens(it, each) for each in ahead)


def fronted(it: Compared, claim: Claim) -> bool:
    """Whether `claim` is the second that a sentence opens with: "on the table next to the plate lies a fork"."""
    floor = it.furniture | {"rug", "mat", "carpet"}
    return any(
        one.of is not None
        and one.of.end == claim.at
        and (one.at == 0 or it.said.words[one.at - 1] in (".", ";"))
        # "On the rug beside the bed stands a lamp": the rug is beside the bed too.
        and not (claim.of is not None and {one.of.noun, claim.of.noun} <= floor)
        for one in it.said.claims
    )


def _points_back(it: Compared, claim: Claim, here: set[str]) -> bool:
    """Whether what "it" or "its left" in `claim` may mean is named before it, and the plan has the relation to that."""
    before = _before(it, claim.at)
    child = before[-1:] if before and before[-1].end == claim.at else []
    named = {obj.name for mention in it.said.mentions for obj in it.of(mention)}
    landmarks = {obj.name for obj in it.plan.objects if obj.name not in named} | {
        obj.name for mention in before[: len(before) - len(child)] for obj in it.of(mention)
    }
    children = {obj.name for mention in child for obj in it.which(mention)}
    # What carries it, or is on it, stands there for it.
    children |= {name for child in children for name in it.above(child)} | {
        obj.name for obj in it.plan.objects if children & set(it.above(obj.name))
    }
    if claim.of is not None:
        # "To its left is a fork and to its right a knife": the knife is.
        children = children | {obj.name for obj in it.which(claim.of)}
    children = children or here
    kinds = KINDS[claim.place]
    tables = {obj.name for obj in it.plan.objects if obj.noun in it.furniture}
    said = {obj.name: (obj.phrase, obj.colours, obj.adjectives, obj.scale) for obj in it.plan.objects}
    return any(
        # "One of the shoes is under the bed, the other in front of it": of no shoe.
        kind in kinds
        and said[a] != said[b]
        and a in children
        and b in landmarks
        and not (claim.place == "across" != kind and b in tables)
        for a, kind, b in it.edges
    )


def _holds(it: Compared, claim: Claim, here: set[str], of: Sequence[str]) -> bool:
    if claim.place == "with":
        owner = next((mention for mention in it.said.mentions if mention.end == claim.at), None)
        if owner is not None and not claim.whose and claim.said.startswith("with "):
            # "a desk with a lamp", and "a mug on a desk with a spoon in it"
            own = {obj.name for obj in it.which(owner)}
            led = any(each.of is owner for each in it.said.claims)
            here = own | {a for a, _, b in it.edges if b in own and led} | (set() if own else here)
        behind = next((each.of for each in it.said.claims if each.at == claim.end and each.place == "on"), None)
        if owner is not None and behind is not None and owner.noun.split()[-1] not in HOLLOW:
            # "A laptop with a mouse on a desk": both are on it.
            desk = {obj.name for obj in it.which(behind)}
            if all(desk & {*it.above(name)[:1]} for name in (*here, *of)):
                return True
        return not (owner or claim.whose) or any({a, b} & set(of) and {a, b} & here for a, _, b in it.edges)
    if claim.place == "holding":
        before = {obj.name for mention in _before(it, claim.at) for obj in it.of(mention)}
        named = {obj.name for mention in it.said.mentions for obj in it.of(mention)}
        owners = (here & before) | (here - named)
        return claim.of is None or any(
            a in of and b in owners and kind in ("on", "in", "over", "hangs_from") for a, kind, b in it.edges
        )
    kinds = set(it.kinds(claim))
    single = claim.place == "between" and "on" not in kinds and claim.of is not None
    if single and claim.of is not None and (claim.of.number or 1) == len(of) > 1:
        # "between two dolls": between no other things.
        return any(one.kind == "between" and set(one.of) <= set(of) for one in it.plan.arrangements)
    if claim.of is None and claim.place == "between":
        between = [one for one in it.plan.arrangements if one.kind == "between"]
        each = len(between) > 1 and bool(EACH & {*it.said.words[claim.at : claim.end]})
        return any(each or _just_before(it, claim, one.of) for one in between)
    if claim.place in ("its left", "its right") or (claim.of is None and it.said.words[claim.end - 1] in BACKWARD):
        return _points_back(it, claim, here)
    if claim.of is None:
        near = {obj.name for mention in it.said.mentions if mention.end == claim.at for obj in it.which(mention)}
        here = near or here
        return any(kind in kinds and {a, b} & here for a, kind, b in it.edges)
    if claim.said.startswith(("on the left", "on the right")):
        kinds |= {"on"}
    if "middle of" in claim.said and len(of) > 1:
        kinds |= {"between"}
    if claim.said.startswith("off ") and not (it.tasks.strip() or it.undone or "is read as the scene" in it.quoted):
        kinds = {"next_to", "far_from", "hangs_from"}
    if claim.of.noun in CLOSED and claim.place in ("in", "from"):
        kinds -= {"on"}
    if claim.of.noun in it.furniture and claim.place == "across" and not it.led(claim, SPREAD):
        # "Two chairs across a table from each other" stand on none.
        kinds -= {"on"}
    stated = claim.at > 0 and it.said.words[claim.at - 1] in FINITE
    if len(of) > 1 and _opens(it, claim) and not stated:
        # "Next to a tall vase is a short one"
        here = here | set(of)
    if not _opens(it, claim) and not claim.whose:
        # "a mug on a tray": what is on the tray is named before it.
        earlier = {obj.name for mention in _before(it, claim.at) for obj in it.of(mention)}
        named = {obj.name for mention in it.said.mentions for obj in it.of(mention)}
        here = (here & earlier) | (here - named) or here
    return any(a in here and b in of and kind in kinds for a, kind, b in it.edges)
