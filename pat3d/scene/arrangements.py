"""Arrangements and postures: what is said of several objects at once, and how one object is turned.

`ARRANGEMENTS` and `POSTURES` declare the kinds: how many objects and landmarks each takes, the words for it, and what
has to be true of a scene at rest. How a kind is laid out stands in pat3d.layout.formations, pat3d.layout.places and
pat3d.layout.postures; its exact predicate in pat3d.layout.arranged.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from pat3d.errors import SpecError
from pat3d.scene.relations import GROUND, Relation, carriers_of

ArrangementKind = Literal[
    "between", "far_from", "at_edge", "in_corner", "in_corners", "at_ends", "in_middle", "row", "circle", "facing",
    "side_by_side", "leaning_against", "under", "across", "on_top_tier", "on_second_tier", "on_third_tier",
    "on_middle_tier", "on_bottom_tier",
]  # fmt: skip

PostureKind = Literal["upright", "upside_down", "on_its_side"]

LINES: tuple[ArrangementKind, ...] = ("row", "side_by_side")
"""Kinds in which the objects stand in a line; such lines that cross are a grid."""
TIERS = {
    "on_top_tier": slice(-1, None), "on_second_tier": slice(-2, -1), "on_third_tier": slice(-3, -2),
    "on_middle_tier": slice(1, -1), "on_bottom_tier": slice(0, 1),
}  # fmt: skip
"""Kinds that tell tiers of a shelf, and which of these, counted from below, they are: none where there are too few."""
MANY = 100


@dataclass(frozen=True, kw_only=True)
class ArrangementRule:
    """What one kind of arrangement takes and means."""

    words: str
    """Between the objects and their landmarks, as a person says it."""
    objects: tuple[int, int]
    """Least and most."""
    of: tuple[int, int]
    """Landmarks, least and most."""
    holds: str
    """What is true of a scene at rest where it holds."""
    alone: str = ""
    """The words where there is no landmark."""
    on_it: bool = False
    """Whether the landmark carries the objects."""

    def takes(self, objects: int, of: int) -> bool:
        """Whether the kind takes this many objects and landmarks."""
        return self.objects[0] <= objects <= self.objects[1] and self.of[0] <= of <= self.of[1]


ARRANGEMENTS: dict[str, ArrangementRule] = {
    "between": ArrangementRule(
        words="between",
        objects=(1, MANY),
        of=(2, MANY),
        holds="seen from it two landmarks are at least 135 degrees apart; it is inside the polygon of three or more",
    ),
    "far_from": ArrangementRule(
        words="far from",
        alone="far from each other",
        objects=(1, MANY),
        of=(0, MANY),
        holds="the gap is more than 1.5 times the largest that next_to allows",
    ),
    "at_edge": ArrangementRule(
        words="at the edge of",
        objects=(1, MANY),
        of=(1, 1),
        holds="it is at most 5 cm, or 15 % of half the surface, away from an edge",
        on_it=True,
    ),
    "in_corner": ArrangementRule(
        words="in the corner of",
        objects=(1, 4),
        of=(1, 1),
        holds="it, or several together, are at most 5 cm, or 15 % of half the surface, away from two edges that meet",
        on_it=True,
    ),
    "in_corners": ArrangementRule(
        words="in different corners of",
        objects=(2, 4),
        of=(1, 1),
        holds="each is in_corner, and no two are in the same one",
        on_it=True,
    ),
    "at_ends": ArrangementRule(
        words="at opposite ends of",
        objects=(2, 2),
        of=(1, 1),
        holds="each is at_edge where the longer side of the surface ends, and not at the same end",
        on_it=True,
    ),
    "in_middle": ArrangementRule(
        words="in the middle of",
        objects=(1, 1),
        of=(1, 1),
        holds="its middle is within 15 % of half the surface, or 2 cm, of the surface's",
        on_it=True,
    ),
    "row": ArrangementRule(
        words="in a row",
        alone="in a row",
        objects=(2, MANY),
        of=(0, 0),
        holds="middles on one line, in order, gaps or distances of the middles equal, and all turned alike",
    ),
    "circle": ArrangementRule(
        words="in a circle around",
        alone="in a circle",
        objects=(3, MANY),
        of=(0, MANY),
        holds="the middles are on one circle, in order, at equal angles; of what it goes around all is inside",
    ),
    "facing": ArrangementRule(
        words="facing",
        alone="facing each other",
        objects=(1, MANY),
        of=(0, 1),
        holds="the front points to the middle of what it faces, within 20 degrees",
    ),
    "side_by_side": ArrangementRule(
        words="side by side",
        alone="side by side",
        objects=(2, MANY),
        of=(0, 0),
        holds="they are a row, turned alike within 15 degrees, each next_to the next",
    ),
    "leaning_against": ArrangementRule(
        words="leaning against",
        objects=(1, 1),
        of=(1, MANY),
        holds="it touches what it leans on, or one of a stack, above its foot, and its centre of mass is not over that",
    ),
    "under": ArrangementRule(
        words="under",
        objects=(1, MANY),
        of=(1, 1),
        holds="its centre of mass is below the underside of the other, its top below that too",
    ),
    "across": ArrangementRule(
        words="across",
        objects=(1, 1),
        of=(1, 1),
        holds="seen from above both of its ends, along its length, reach beyond the rim of what carries it",
        on_it=True,
    ),
    **{
        kind: ArrangementRule(
            words=f"on the {kind.split('_')[1]} shelf of",
            objects=(1, MANY),
            of=(1, 1),
            holds=f"of the boards or compartments of what carries it, it is on {which}",
            on_it=True,
        )
        for kind, which in (
            ("on_top_tier", "the highest"), ("on_second_tier", "the second from above"),
            ("on_third_tier", "the third from above"), ("on_middle_tier", "one that is neither highest nor lowest"),
            ("on_bottom_tier", "the lowest"),
        )
    },
}  # fmt: skip

POSTURES: dict[str, tuple[float, float]] = {
    "upright": (0.0, 15.0),
    "upside_down": (165.0, 180.0),
    "on_its_side": (70.0, 110.0),
}
"""Angle between the asset's own vertical and the world's [degrees], least and most."""


@dataclass(frozen=True, kw_only=True)
class Arrangement:
    """`objects` stand in the arrangement `kind` among each other, or to the landmarks `of`."""

    kind: ArrangementKind
    objects: tuple[str, ...]
    """In order, for rows and circles."""
    of: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.kind not in ARRANGEMENTS:
            raise SpecError(f'unknown arrangement "{self.kind}". Valid: {", ".join(ARRANGEMENTS)}.')
        rule = ARRANGEMENTS[self.kind]
        for what, names, (least, most) in (("objects", self.objects, rule.objects), ("of", self.of, rule.of)):
            if not least <= len(names) <= most:
                wanted = f"{least}" if least == most else f"{least} to {most}" if most < MANY else f"at least {least}"
                raise SpecError(f'"{self.kind}" takes {wanted} in "{what}", got {len(names)}.')
        if len({*self.objects, *self.of}) < len(self.objects) + len(self.of):
            raise SpecError(f'"{self.kind}" names an object twice: {", ".join((*self.objects, *self.of))}.')
        if GROUND in (*self.objects, *self.of):
            raise SpecError(f'"{self.kind}": the {GROUND} is everywhere and takes part in no arrangement.')
        if self.kind == "facing" and not self.of and len(self.objects) != 2:
            raise SpecError(f'"facing" without "of" is two objects facing each other, got {len(self.objects)}.')
        if self.kind == "far_from" and not self.of and len(self.objects) < 2:
            raise SpecError('"far_from" without "of" takes at least 2 in "objects".')
        if self.kind == "between" and len(self.of) > 2 and len(self.objects) > 1:
            raise SpecError('"between" more than two landmarks takes one object.')

    supports = False
    """As of a lateral relation: no weight passes."""

    @property
    def names(self) -> tuple[str, ...]:
        """Everything that takes part."""
        return (*self.objects, *self.of)

    @property
    def rule(self) -> ArrangementRule:
        """What the kind takes and means."""
        return ARRANGEMENTS[self.kind]

    def __str__(self) -> str:
        words = f"{', '.join(self.objects)} {self.kind}"
        return f"{words} {', '.join(self.of)}" if self.of else words


@dataclass(frozen=True, kw_only=True)
class Posture:
    """How `object` is turned."""

    object: str
    kind: PostureKind

    supports = False

    def __post_init__(self) -> None:
        if self.kind not in POSTURES:
            raise SpecError(f'unknown posture "{self.kind}" of "{self.object}". Valid: {", ".join(POSTURES)}.')

    def holds(self, vertical: Sequence[float]) -> tuple[bool, float]:
        """Whether the asset's own `vertical` in the world, a unit vector, is as it should, and its tilt [degrees]."""
        tilt = math.degrees(math.acos(min(1.0, max(-1.0, float(vertical[2])))))
        least, most = POSTURES[self.kind]
        return least <= tilt <= most, tilt

    def __str__(self) -> str:
        return f"{self.object} {self.kind}"


def check_arrangements(
    names: Sequence[str], relations: tuple[Relation, ...], arrangements: tuple[Arrangement, ...]
) -> None:
    """Raise SpecError unless all are arrangements of objects among `names`, and what is said of a surface is on it."""
    for one in arrangements:
        unknown = next((name for name in one.names if name not in names), None)
        if unknown is not None:
            raise SpecError(f'"{one}" names "{unknown}", which is not in the scene. Objects: {", ".join(names)}.')
        astray = [name for name in one.objects if one.rule.on_it and one.of[0] not in carriers_of(name, relations)]
        if astray:
            raise SpecError(f'"{one}": say first that "{astray[0]}" is on "{one.of[0]}".')
        if one.kind == "under" and any(rel.supports and {rel.child, rel.parent} == {*one.names} for rel in relations):
            raise SpecError(f'"{one}": one carries the other; the relation "on" alone says so.')


def crossing(rows: Sequence[tuple[str, ...]]) -> list[dict[str, tuple[int, int]]]:
    """Column and row of everything in rows that cross each other, for every set of these; none for a row alone.

    Rows that would have a thing at two crossings, or two at one, cross nothing.
    """
    waiting, found = list(rows), []
    while waiting:
        crossed, cells = _crossed(waiting)
        if len(crossed) > 1 and cells and len(set(cells.values())) == len(cells):
            found.append(cells)
        waiting = [row for row in waiting[1:] if row not in crossed]
    return found


def _crossed(rows: Sequence[tuple[str, ...]]) -> tuple[list[tuple[str, ...]], dict[str, tuple[int, int]]]:
    """The first of `rows`, along x, with all that cross it and each other, and where everything in them is.

    Nowhere, where two places are asked of one thing.
    """
    axes = {rows[0]: 0}
    cells, sound = {name: (at, 0) for at, name in enumerate(rows[0])}, True
    while True:
        crossed = next(((row, name) for row in rows if row not in axes for name in row if name in cells), None)
        if crossed is None:
            return list(axes), cells if sound else {}
        row, name = crossed
        axes[row] = axis = 1 - next(axes[other] for other in axes if name in other)
        for at, member in enumerate(row):
            cell = list(cells[name])
            cell[axis] += at - row.index(name)
            sound &= cells.setdefault(member, (cell[0], cell[1])) == (cell[0], cell[1])
