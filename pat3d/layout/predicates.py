"""Does a relation hold at given poses? Yes or no, as a person looking at the scene would answer.

With the bounding box, the footprint (hull of the parts seen from above) and the centre of mass of the
exported parts, and the viewer at -y:

- carried: the child touches the parent (parts at most `touch` apart), or touches something that is itself
  carried by the parent and whose centre of mass is over the parent's footprint.
- on: carried, the child's centre of mass over the parent's footprint, and the child's lowest point above the
  parent's lowest point (a ball leaning on a table leg is not on the table).
- on, with several carriers: the child touches each of them, its lowest point is above their lowest, and its centre of
  mass is over the hull of all their footprints. That each carries weight is measured in MuJoCo (pat3d.check.loads).
- in: carried, the lowest point below the rim, or, on a heap, above the rim by at most half the child's own
  height; and the centre of mass in the column over the cavity's floor, or, for what stands or leans on that
  floor (lowest point in the column and below the rim: a pen in a mug), over the parent's footprint. Without a
  cavity: the centre of mass and the lowest point inside the bounding box. Of a door: its pins in the sockets.
- left_of, right_of, in_front_of, behind: along the axis the centres are in that order and the boxes overlap
  by at most half of the smaller one; and the offset is mostly along that axis (within 60 degrees of it), or
  the boxes overlap across it.
- next_to: the gap between the footprints is at most the larger of 0.25 m and the longer horizontal side of
  both objects (never more than 1 m), neither centre is over the other's footprint, and the heights that they
  span overlap or are at most 0.1 m apart.
- around: as next_to with twice the gap; of three or more that stand around one thing, neighbours are at most
  200 degrees apart as seen from it.
- hangs_from, attached: the two ends of every anchor are at most `touch` apart, the child's centre of mass is below
  them, and the child touches neither the ground nor anything that it does not itself carry.
- hangs_from, by contact (a handle on a hook): the child's top is not above the parent's, its centre of mass is
  below what it touches, and it is off the ground.

What is beside what is measured in pat3d.layout.lateral. Arrangements are judged in pat3d.layout.arranged; a posture by
the angle of the asset's own vertical (pat3d.scene.arrangements).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from pat3d.errors import SpecError
from pat3d.geometry.polygons import contains, outline
from pat3d.geometry.pose import Pose
from pat3d.layout.arranged import arrangement_holds, in_grid
from pat3d.layout.bodies import Array, Placed, distance, place_all
from pat3d.layout.doors import in_sockets, turns
from pat3d.layout.frames import column_at
from pat3d.layout.lateral import APART, Box, Seen, next_to, on_side
from pat3d.scene.arrangements import LINES, Arrangement, Posture, crossing
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Attachment, Relation
from pat3d.scene.relations import SIDES, carriers_of

TOUCH = 1.0e-3
"""Parts at most this far apart [m] touch."""
_AT_ANCHOR = 0.03
"""Where a thing that hangs may be near its carrier: this far from an anchor [m]."""


@dataclass(frozen=True, kw_only=True)
class RelationResult:
    """Whether a relation, an arrangement or a posture holds, and what was measured."""

    relation: Relation | Arrangement | Posture
    holds: bool
    detail: str
    """For example "gap 0.02 mm, centre inside the footprint"."""


def relation_holds(
    relation: Relation,
    assets: Mapping[str, Asset],
    poses: Mapping[str, Pose],
    *,
    touch: float = TOUCH,
    attachments: tuple[Attachment, ...] = (),
) -> bool:
    """Whether `relation` holds at `poses`; see the module for what each kind means."""
    return check_relations((relation,), assets, poses, touch=touch, attachments=attachments)[0].holds


def check_relations(
    relations: tuple[Relation, ...],
    assets: Mapping[str, Asset],
    poses: Mapping[str, Pose],
    *,
    touch: float = TOUCH,
    attachments: tuple[Attachment, ...] = (),
) -> tuple[RelationResult, ...]:
    """Every relation with its verdict and what was measured.

    Args:
        relations: support and lateral relations.
        assets: by object name.
        poses: of every object.
        touch: parts at most this far apart touch [m].
        attachments: of the scene.

    Raises:
        SpecError: a relation names an object without a pose.
    """
    for relation in relations:
        for name in (relation.child, relation.parent):
            if name != GROUND and name not in poses:
                raise SpecError(f'relation "{relation}" names "{name}", which has no pose.')
    view = _View(place_all(assets, poses), relations, touch)
    view.attachments = {(one.child, one.parent): one.ends(poses[one.child], poses[one.parent]) for one in attachments}
    return tuple(view.judge(relation) for relation in relations)


def check_arranged(
    arrangements: tuple[Arrangement, ...],
    postures: tuple[Posture, ...],
    assets: Mapping[str, Asset],
    poses: Mapping[str, Pose],
    *,
    touch: float = TOUCH,
) -> tuple[RelationResult, ...]:
    """Every arrangement and every posture with its verdict and what was measured; arguments as of `check_relations`."""
    if not arrangements and not postures:
        return ()
    bodies = place_all(assets, poses)
    found = []
    grids = crossing([one.objects for one in arrangements if one.kind in LINES])
    for one in arrangements:
        holds, detail = arrangement_holds(one, bodies, touch)
        grid = next((cells for cells in grids if one.kind in LINES and set(one.objects) <= set(cells)), None)
        if grid is not None:
            # Rows that cross are a grid only together.
            squared, how = in_grid(grid, bodies)
            holds, detail = holds and squared, f"{detail}; {how}"
        found.append(RelationResult(relation=one, holds=holds, detail=detail))
    for one in postures:
        holds, tilt = one.holds(bodies[one.object].rotation[:, 2].tolist())
        found.append(RelationResult(relation=one, holds=holds, detail=f"its vertical is {tilt:.0f} degrees from up"))
    return tuple(found)


class _View:
    """The posed objects, with distances and footprints computed once."""

    def __init__(self, bodies: dict[str, Placed], relations: tuple[Relation, ...], touch: float) -> None:
        self.bodies, self.relations, self.touch = bodies, relations, touch
        self.attachments: dict[tuple[str, str], tuple[Array, Array]] = {}
        """World positions of the anchors of child and parent [m], shape (anchors, 3) each."""
        self._footprints: dict[str, Array] = {}
        self._gaps: dict[tuple[str, str], float] = {}

    def judge(self, relation: Relation) -> RelationResult:
        if relation.parent == GROUND:
            holds, detail = self._on_ground(relation)
        elif relation.kind == "on":
            holds, detail = self._on(relation.child, relation.parent)
        elif relation.kind == "in":
            holds, detail = self._in(relation.child, relation.parent)
        elif relation.kind == "hangs_from":
            holds, detail = self._hangs(relation.child, relation.parent)
        elif relation.kind in SIDES:
            holds, detail = self._side(relation.child, relation.kind, relation.parent)
        else:
            holds, detail = self._beside(relation)
        return RelationResult(relation=relation, holds=holds, detail=detail)

    def _on_ground(self, relation: Relation) -> tuple[bool, str]:
        height = float(self.bodies[relation.child].low[2])
        if not relation.supports:
            return True, "everything stands over the ground"
        return relation.kind == "on" and height <= self.touch, f"{height * 1e3:.2f} mm above the ground"

    def _on(self, child: str, parent: str) -> tuple[bool, str]:
        body, under = self.bodies[child], self.bodies[parent]
        carriers = carriers_of(child, self.relations)
        if len(carriers) > 1:
            return self._on_several(child, parent, carriers)
        carried, how = self._carried(child, parent)
        over = self._over(child, parent)
        # Of a playing card on another, the lowest point is no further up than a card is thick.
        thickness = float(under.high[2] - under.low[2])
        above = bool(body.low[2] > under.low[2] + min(self.touch, thickness / 2))
        where = f"centre {'inside' if over else 'outside'} the footprint"
        return carried and over and above, how + ", " + where + ("" if above else ", not above its base")

    def _on_several(self, child: str, parent: str, carriers: tuple[str, ...]) -> tuple[bool, str]:
        body, gap = self.bodies[child], self._gap(child, parent)
        together = outline(np.concatenate([self._footprint(name) for name in carriers]))
        over = contains(together, body.centre_of_mass[:2])
        above = bool(body.low[2] > self.bodies[parent].low[2] + self.touch)
        how = f"gap {max(gap, 0.0) * 1e3:.2f} mm" if math.isfinite(gap) else "far apart"
        where = f"centre {'inside' if over else 'outside'} the footprint of all {len(carriers)} carriers"
        return gap <= self.touch and over and above, f"{how}, {where}"

    def _in(self, child: str, parent: str) -> tuple[bool, str]:
        body, holder = self.bodies[child], self.bodies[parent]
        carried, how = self._carried(child, parent)
        if turns(body.body.asset, holder.body.asset):
            hung, where = in_sockets(body, holder)
            return carried and hung, f"{how}, {where}"
        column = column_at(holder, float(body.low[2]) + self.touch)
        if column is None:
            points = np.stack([body.centre_of_mass, [*body.centre_of_mass[:2], body.low[2]]])
            inside = bool(np.all((points >= holder.low - self.touch) & (points <= holder.high + self.touch)))
            return carried and inside, f"{how}, centre {'inside' if inside else 'outside'} the bounding box"
        within = bool(column.holds(body.centre_of_mass[:2]))
        if not within and body.low[2] < column.rim:
            foot = body.vertices[int(np.argmin(body.vertices[:, 2])), :2]
            within = bool(column.holds(foot)) and self._over(child, parent)
        depth = column.rim - float(body.low[2])
        tall = float(body.high[2] - body.low[2])
        deep = depth > 0.0 or (depth > -0.5 * tall and not column.capped)
        deep = deep and bool(body.high[2] > column.centre[2])
        # The column is the widest upright one; bowls and baskets flare, and what leans on their walls is inside too.
        within = within or (depth > 0.0 and not column.capped and self._over(child, parent))
        side = "below" if depth > 0 else "above"
        return (
            carried and within and deep,
            f"{how}, centre {'inside' if within else 'outside'} the cavity, lowest point {abs(depth) * 1e3:.1f} mm "
            f"{side} the rim",
        )

    def _hangs(self, child: str, parent: str) -> tuple[bool, str]:
        if (child, parent) in self.attachments:
            return self._attached(child, parent)
        body, holder = self.bodies[child], self.bodies[parent]
        closest = distance(body, holder, self.touch + 1e-9)
        below = bool(body.high[2] <= holder.high[2] + self.touch)
        free = bool(body.low[2] > self.touch)
        if closest is None:
            return False, f"gap over {self.touch * 1e3:.1f} mm"
        point = closest.first if closest.distance > 0.0 else body.high
        pendant = bool(body.centre_of_mass[2] < point[2])
        detail = f"gap {closest.distance * 1e3:.2f} mm, top {'below' if below else 'above'} the carrier's top"
        return below and free and pendant, detail + ("" if pendant else ", not below its attachment")

    def _attached(self, child: str, parent: str) -> tuple[bool, str]:
        body = self.bodies[child]
        on_child, on_parent = self.attachments[child, parent]
        apart = float(np.linalg.norm(on_child - on_parent, axis=1).max())
        pendant = bool(body.centre_of_mass[2] < on_child[:, 2].min())
        carries = {child}
        while grown := {rel.child for rel in self.relations if rel.supports and rel.parent in carries} - carries:
            carries |= grown
        touched = [
            other for other in self.bodies if other not in (*carries, parent) and self._gap(child, other) <= self.touch
        ]
        closest = distance(body, self.bodies[parent], self.touch + 1e-9)
        # Where the two are near at an anchor it is the anchor that carries.
        if closest is not None and np.linalg.norm(on_child - closest.first, axis=1).min() > _AT_ANCHOR:
            touched.append(parent)
        if body.low[2] <= self.touch:
            touched.append(GROUND)
        detail = f"anchors {apart * 1e3:.2f} mm apart, {len(on_child)} in all"
        detail += "" if pendant else ", not below them"
        detail += f', touching "{touched[0]}"' if touched else ""
        return apart <= self.touch and pendant and not touched, detail

    def _side(self, child: str, kind: str, parent: str) -> tuple[bool, str]:
        found = on_side(kind, self._box(child), self._box(parent))
        detail = f"centre {float(found.along) * 1e3:.0f} mm to that side"
        if found.overlap > 0.0:
            detail += f", overlapping by {float(found.overlap):.0%}"
        return bool(found.holds), detail + ("" if found.aligned else f", but {float(found.aside) * 1e3:.0f} mm across")

    def _beside(self, relation: Relation) -> tuple[bool, str]:
        around = relation.kind == "around"
        child, parent = (
            Seen(self._footprint(name), self.bodies[name].centre_of_mass[:2], self._box(name))
            for name in (relation.child, relation.parent)
        )
        found = next_to(child, parent, farther=2.0 if around else 1.0)
        holds, detail = found.holds, f"{found.gap * 1e3:.0f} mm apart (at most {found.limit * 1e3:.0f})"
        if found.stacked:
            detail += ", one above the other"
        if found.apart > APART:
            detail += f", {found.apart:.2f} m between their heights"
        if around:
            widest = self._widest_gap(relation.parent)
            if widest is not None:
                holds = holds and widest <= 200.0
                detail += f", neighbours at most {widest:.0f} degrees apart"
        return bool(holds), detail

    def _box(self, name: str) -> Box:
        return Box(self.bodies[name].low, self.bodies[name].high)

    def _widest_gap(self, centre: str) -> float | None:
        """Widest angle [degrees] between neighbours around `centre`; None for fewer than three."""
        names = [rel.child for rel in self.relations if rel.kind == "around" and rel.parent == centre]
        if len(names) < 3:
            return None
        middle = (self.bodies[centre].low + self.bodies[centre].high) / 2
        offsets = [(self.bodies[name].low + self.bodies[name].high) / 2 - middle for name in names]
        angles = np.sort([math.degrees(math.atan2(offset[1], offset[0])) for offset in offsets])
        return float(np.max(np.diff([*angles, angles[0] + 360.0])))

    def _carried(self, child: str, parent: str) -> tuple[bool, str]:
        """Whether contacts lead from the child down to the parent, and how."""
        direct = self._gap(child, parent)
        if direct <= self.touch:
            return True, f"gap {max(direct, 0.0) * 1e3:.2f} mm"
        reached, frontier = {child}, [child]
        while frontier:
            name = frontier.pop()
            for other in self.bodies:
                if other in reached or other == parent or self._gap(name, other) > self.touch:
                    continue
                reached.add(other)
                if not self._over(other, parent):
                    continue
                if self._gap(other, parent) <= self.touch:
                    return True, f'carried through "{other}"'
                frontier.append(other)
        return False, f"gap {direct * 1e3:.2f} mm" if math.isfinite(direct) else "far apart"

    def _gap(self, first: str, second: str) -> float:
        """Distance [m] between two objects, infinite beyond 0.1 m."""
        key = (first, second) if first < second else (second, first)
        if key not in self._gaps:
            closest = distance(self.bodies[key[0]], self.bodies[key[1]], 0.1)
            self._gaps[key] = math.inf if closest is None else closest.distance
        return self._gaps[key]

    def _over(self, name: str, parent: str) -> bool:
        """Whether the centre of mass is over the parent's footprint."""
        return contains(self._footprint(parent), self.bodies[name].centre_of_mass[:2])

    def _footprint(self, name: str) -> Array:
        if name not in self._footprints:
            self._footprints[name] = outline(self.bodies[name].vertices[:, :2])
        return self._footprints[name]
