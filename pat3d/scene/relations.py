"""How the objects of a scene relate: the scene tree and what stands beside what, in names alone.

The viewer stands at -y and looks along +y, so left is -x, right is +x, in front is -y and behind is +y.
"""

from __future__ import annotations

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
    """Parent of object `name` in the scene tree; the ground where no relation says otherwise."""
    return next((rel.parent for rel in relations if rel.supports and rel.child == name), GROUND)


def check_tree(names: list[str], relations: tuple[Relation, ...]) -> None:
    """Raise SpecError unless the support relations form a tree over `names` rooted at the ground."""
    known = {*names, GROUND}
    for relation in relations:
        for end in (relation.child, relation.parent):
            if end not in known:
                raise SpecError(
                    f'relation "{relation}" names "{end}", which is not in the scene. Objects: {", ".join(names)}.'
                )
    parents: dict[str, str] = {}
    for relation in relations:
        if not relation.supports:
            continue
        if relation.child in parents:
            raise SpecError(
                f'"{relation.child}" has two supports, "{parents[relation.child]}" and "{relation.parent}".'
            )
        parents[relation.child] = relation.parent
    for name in names:
        path = [name]
        while (above := parents.get(path[-1], GROUND)) != GROUND:
            path.append(above)
            if above == name:
                raise SpecError(f"the support relations form a cycle: {' -> '.join(path)}.")
            if len(path) > len(names):
                break


_ORDERS = {"left_of": ("x", 1), "right_of": ("x", -1), "in_front_of": ("y", 1), "behind": ("y", -1)}
"""Axis along which a relation puts the child before (1) or after (-1) the parent."""


def check_sides(relations: tuple[Relation, ...]) -> None:
    """Raise SpecError for the first lateral relation that no arrangement can meet.

    Beside one another is nothing that rests on, or lies in, the other; and nothing is on the left of what is on the
    left of it.
    """
    carriers = {rel.child: rel.parent for rel in relations if rel.supports and rel.kind != "hangs_from"}
    before: dict[str, dict[str, set[str]]] = {"x": {}, "y": {}}
    for relation in relations:
        ends = (relation.child, relation.parent)
        if relation.supports or GROUND in ends:
            continue
        for one, other in (ends, ends[::-1]):
            if other in _reached(one, {name: {carrier} for name, carrier in carriers.items()}):
                raise SpecError(f'"{relation}" cannot be: "{other}" carries "{one}".')
        if relation.kind in _ORDERS:
            axis, sign = _ORDERS[relation.kind]
            first, second = ends[::sign]
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
