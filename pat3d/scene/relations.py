"""How the objects of a scene relate: the scene tree and what stands beside what, in names alone.

The viewer stands at -y and looks along +y, so left is -x, right is +x, in front is -y and behind is +y.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from pat3d.errors import SpecError

GROUND = "ground"
"""Name of the root of every scene tree: the plane z = 0."""

SupportKind = Literal["on", "in", "hangs_from"]
"""Edges of the scene tree: the parent carries the child's weight."""

LateralKind = Literal["left_of", "right_of", "in_front_of", "behind", "next_to", "around"]
"""Where the child stands relative to the parent, without weight passing between them."""

RelationKind = Literal[SupportKind, LateralKind]
SUPPORT_KINDS: frozenset[str] = frozenset(get_args(SupportKind))
LATERAL_KINDS: frozenset[str] = frozenset(get_args(LateralKind))

RELATION_WORDS: dict[str, str] = {
    "on": "on", "in": "in", "hangs_from": "hanging from", "left_of": "to the left of", "right_of": "to the right of",
    "in_front_of": "in front of", "behind": "behind", "next_to": "next to", "around": "around",
}  # fmt: skip
"""How a person says each kind, between child and parent."""

SIDES = {"left_of": (0, -1), "right_of": (0, 1), "in_front_of": (1, -1), "behind": (1, 1)}
"""Horizontal axis along which a relation puts the child on one side of the parent, and the sign of that side."""

OPPOSITE = {
    "left_of": "right_of",
    "right_of": "left_of",
    "in_front_of": "behind",
    "behind": "in_front_of",
    "next_to": "next_to",
    "around": "around",
}
"""The relation of the parent to the child."""

MAX_CARRIERS = 8


@dataclass(frozen=True, kw_only=True)
class Relation:
    """`child` stands in relation `kind` to `parent` (for "on": child rests on parent)."""

    child: str
    kind: RelationKind
    parent: str

    def __post_init__(self) -> None:
        kinds = sorted(SUPPORT_KINDS | LATERAL_KINDS)
        if self.kind not in kinds:
            raise SpecError(f'unknown relation "{self.kind}" of "{self.child}". Valid: {", ".join(kinds)}.')
        if self.child == self.parent:
            raise SpecError(f'"{self.child}" cannot stand in relation "{self.kind}" to itself.')
        if self.child == GROUND:
            raise SpecError("the ground is the root of the scene tree and is never a child.")

    @property
    def supports(self) -> bool:
        """Whether this relation is an edge of the scene tree."""
        return self.kind in SUPPORT_KINDS

    def __str__(self) -> str:
        return f"{self.child} {self.kind} {self.parent}"


def parent_of(name: str, relations: tuple[Relation, ...]) -> str:
    """Parent of object `name` in the scene tree (the first of several carriers); the ground where nothing is said."""
    return next((rel.parent for rel in relations if rel.supports and rel.child == name), GROUND)


def carriers_of(name: str, relations: tuple[Relation, ...]) -> tuple[str, ...]:
    """Everything that carries object `name`, in the order of the relations; the ground where nothing is said."""
    return tuple(rel.parent for rel in relations if rel.supports and rel.child == name) or (GROUND,)


def built_together(names: Sequence[str], relations: tuple[Relation, ...]) -> dict[str, str]:
    """The first of every structure of things with several carriers (a pyramid), by each object that is part of one."""
    first: dict[str, str] = {}
    for name in names:
        carriers = carriers_of(name, relations)
        if len(carriers) < 2:
            continue
        joined = {first.get(one, one) for one in (name, *carriers)}
        lead = min(joined, key=list(names).index)
        first |= dict.fromkeys((name, *carriers), lead)
        first |= {one: lead for one, old in first.items() if old in joined}
    return first


def check_tree(names: list[str], relations: tuple[Relation, ...]) -> None:
    """Raise SpecError unless the support relations form a directed acyclic graph over `names` rooted at the ground.

    What has several carriers lies on all of them; everything else has one, so that without such things it is a tree.
    """
    known = {*names, GROUND}
    for relation in relations:
        for end in (relation.child, relation.parent):
            if end not in known:
                raise SpecError(
                    f'relation "{relation}" names "{end}", which is not in the scene. Objects: {", ".join(names)}.'
                )
    parents: dict[str, list[Relation]] = {}
    for relation in relations:
        if not relation.supports:
            continue
        others = parents.setdefault(relation.child, [])
        for other in others:
            if {relation.kind, other.kind} != {"on"} or GROUND in (relation.parent, other.parent):
                raise SpecError(
                    f'"{relation.child}" has two supports, "{other.parent}" and "{relation.parent}": only what lies '
                    '"on" several objects can have more than one.'
                )
            if relation.parent == other.parent:
                raise SpecError(f'"{relation}" is said twice.')
        others.append(relation)
        if len(others) > MAX_CARRIERS:
            raise SpecError(f'"{relation.child}" has more than {MAX_CARRIERS} carriers.')
    _check_acyclic({name: [edge.parent for edge in parents[name]] for name in names if name in parents})


def _check_acyclic(parents: dict[str, list[str]]) -> None:
    """Raise SpecError where following `parents` from a child may come back to it."""
    waiting = {name: sum(above in parents for above in own) for name, own in parents.items()}
    children: dict[str, list[str]] = {}
    for name, own in parents.items():
        for above in own:
            children.setdefault(above, []).append(name)
    ready = [name for name, count in waiting.items() if count == 0]
    while ready:
        done = ready.pop()
        del waiting[done]
        for name in children.get(done, ()):
            waiting[name] -= 1
            if waiting[name] == 0:
                ready.append(name)
    if waiting:
        path = [next(iter(waiting))]
        while (above := next(name for name in parents[path[-1]] if name in waiting)) not in path:
            path.append(above)
        cycle = [*path[path.index(above) :], above]
        raise SpecError(f"the support relations form a cycle: {' -> '.join(cycle)}.")


def check_sides(relations: tuple[Relation, ...]) -> None:
    """Raise SpecError for the first lateral relation that no arrangement can meet.

    Beside one another is nothing that rests on, or lies in, the other; and nothing is on the left of what is on the
    left of it.
    """
    carriers: dict[str, set[str]] = {}
    for rel in relations:
        if rel.supports and rel.kind != "hangs_from":
            carriers.setdefault(rel.child, set()).add(rel.parent)
    before: tuple[dict[str, set[str]], dict[str, set[str]]] = ({}, {})
    for relation in relations:
        ends = (relation.child, relation.parent)
        if relation.supports or GROUND in ends:
            continue
        for one, other in (ends, ends[::-1]):
            if other in _reached(one, carriers):
                raise SpecError(f'"{relation}" cannot be: "{other}" carries "{one}".')
        if relation.kind in SIDES:
            axis, sign = SIDES[relation.kind]
            first, second = ends[::-sign]
            if first in _reached(second, before[axis]):
                raise SpecError(
                    f'"{relation}" cannot be: other relations put "{second}" on the other side of "{first}".'
                )
            before[axis].setdefault(first, set()).add(second)


def _reached(name: str, edges: dict[str, set[str]]) -> set[str]:
    """Everything that edges lead to from `name`."""
    found: set[str] = set()
    ahead = [name]
    while ahead:
        new = edges.get(ahead.pop(), set()) - found
        found |= new
        ahead += new
    return found
