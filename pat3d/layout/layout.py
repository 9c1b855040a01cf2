"""From assets and relations to poses where nothing touches: every object just above what will carry it.

The scene tree is arranged from the leaves up: an object gathers what it contains and carries into a group
that moves as one, and groups are arranged on what carries them, the ground last. What has several carriers is put down
on them once all of these stand, on the last surface that they share. All frames are parallel
to the world's, so "left of" means the same everywhere. The result is checked before it is returned.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.bodies import Array, Body
from pat3d.layout.clearance import Clearance, require_clearance
from pat3d.layout.containers import pack
from pat3d.layout.doors import hang_in, turns
from pat3d.layout.drawers import slide_in, slides
from pat3d.layout.flat import Lateral, Surface
from pat3d.layout.formations import Wishes, ring_angles
from pat3d.layout.frames import column_of, flat_regions
from pat3d.layout.group import Group
from pat3d.layout.hanging import attachment, hang
from pat3d.layout.intents import Intents
from pat3d.layout.leaning import leaning_rotation
from pat3d.layout.loosening import loosen
from pat3d.layout.place_settings import place_settings, turned
from pat3d.layout.postures import posture_rotation
from pat3d.layout.seats import SEATS, around_tables, beside_tables, facing, seated
from pat3d.layout.shares import Top
from pat3d.layout.shelved import bookends
from pat3d.layout.slots import stand_in_slots
from pat3d.layout.spans import homes, put_across
from pat3d.layout.surfaces import arrange_flat
from pat3d.layout.tops import item_of, spread
from pat3d.layout.turning import turned_to_targets
from pat3d.layout.turns import abreast, free_turn
from pat3d.scene.arrangements import Arrangement, check_arrangements
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Attachment, Relation, check_tree

_FURNITURE = 0.6
"""Objects larger than this [m] stand parallel to the walls of an imagined room."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Initial poses, checked to be free of intersection."""

    poses: Mapping[str, Pose]
    """Pose of every object, in the order of the assets."""
    attachments: tuple[Attachment, ...] = ()
    """What holds the things that hang, in the order of the assets."""
    notes: tuple[str, ...] = ()
    """What was decided where the relations were silent or could not be honoured."""
    clearance: Clearance
    """Distances between neighbours."""


def arrange(
    assets: Mapping[str, Asset],
    relations: tuple[Relation, ...],
    *,
    seed: int,
    fixed_poses: Mapping[str, Pose] | None = None,
    arrangements: tuple[Arrangement, ...] = (),
    postures: Mapping[str, str] | None = None,
    gap: float = 0.002,
) -> Layout:
    """Place every asset by its relations; the same arguments give the same layout.

    Args:
        assets: by object name, in the order in which they matter.
        relations: the scene tree and the lateral relations.
        seed: of the small variations (yaw, jitter, order in containers).
        fixed_poses: objects that stay exactly where they are given.
        arrangements: rows, circles, places on surfaces and the like.
        postures: kind of the posture of objects that are turned.
        gap: distance that objects keep from what will carry them [m].

    Raises:
        SpecError: the relations name unknown objects or form no tree.
        LayoutError: something does not fit where it belongs, or given poses intersect.
    """
    fixed = dict(fixed_poses or {})
    check_tree(list(assets), relations)
    check_arrangements(list(assets), relations, arrangements)
    unknown = [name for name in fixed if name not in assets]
    if unknown:
        raise LayoutError(f'"{unknown[0]}" has a pose but is not in the scene. Objects: {", ".join(assets)}.')
    arranger = _Arranger(assets, relations, seed, fixed, gap, arrangements, postures or {})
    placed = {member.body.name: member for group in arranger.ground() for member in group.members}
    bodies = [placed[name] for name in assets]
    clearance = require_clearance(bodies)
    poses = {body.body.name: fixed.get(body.body.name) or body.pose for body in bodies}
    attachments = tuple(arranger.attachments[name] for name in assets if name in arranger.attachments)
    return Layout(poses=poses, attachments=attachments, notes=tuple(arranger.notes), clearance=clearance)


class _Arranger:
    def __init__(
        self,
        assets: Mapping[str, Asset],
        relations: tuple[Relation, ...],
        seed: int,
        fixed: dict[str, Pose],
        gap: float,
        arrangements: tuple[Arrangement, ...],
        postures: Mapping[str, str],
    ) -> None:
        self.seed, self.fixed, self.gap = seed, fixed, gap
        self.notes: list[str] = []
        self.attachments: dict[str, Attachment] = {}
        self.bodies = {name: Body(name, asset) for name, asset in assets.items()}
        self.parents, self.spans = homes(list(assets), relations)
        self.spans = {one.objects[0]: one.of for one in arrangements if one.kind == "across"} | self.spans
        self.kinds = {rel.child: rel.kind for rel in relations if rel.supports}
        self.children: dict[str, list[str]] = {name: [] for name in (GROUND, *assets)}
        for name, parent in self.parents.items():
            if name not in self.spans:
                self.children[parent].append(name)
        self.laterals = self._sibling_laterals(relations)
        placed = [one for one in arrangements if one.kind != "across"]
        self.intents = Intents(placed, self._path, self.kinds, self.laterals, self.spans)
        self.notes.extend(self.intents.notes)
        self.intents.yaws |= bookends(placed, lambda name: self.bodies[name].asset.noun)
        free = [name for name in assets if not (name in postures or self.children[name] or self.intents.yaws.get(name))]
        carriers = {name: self.bodies.get(self.parents[name]) for name in free}
        self.intents.yaws |= abreast(placed, self.bodies, carriers)
        self.turned = {name: posture_rotation(self.bodies[name], kind) for name, kind in postures.items()}
        """How objects are turned before their yaw, shape (3, 3), where they do not stand as they are made."""
        self._around = self._around_tables()
        """Seats around tables, each with the side where it is and its place along that [m]."""
        self._seated = self._seats()
        """Yaw of seats that stand at a side of a table [rad]."""
        for name, way in self.intents.leaning.items():
            self.turned[name] = leaning_rotation(self.bodies[name], way)
        for name in fixed:
            parent = self.parents[name]
            if parent != GROUND and parent not in fixed:
                raise LayoutError(
                    f'"{name}" has a given pose but its support "{parent}" has none. Give "{parent}" a pose too, or '
                    f'leave "{name}" to the layout. Nothing was written.'
                )

    def ground(self) -> list[Group]:
        """Every object, in groups that stand on the ground."""
        names = self.children[GROUND]
        laterals = self.laterals.get(GROUND, [])
        groups = {name: self._build(name, self._yaw(name, GROUND, 0.0, laterals)) for name in names}
        items = [item_of(group, turnable=False) for group in groups.values()]
        pinned = {name: np.array(self.fixed[name].position[:2]) for name in names if name in self.fixed}
        wishes = self._wishes(GROUND, groups)
        spots = arrange_flat(items, laterals, Surface(), pinned=pinned, wishes=wishes)
        if spots is None:
            said = [f"{lat.child} {lat.kind} {lat.parent}" for lat in laterals]
            listed = ", ".join([*said, *(str(one.arrangement) for one in self.intents.by_surface.get(GROUND, []))])
            raise LayoutError(
                f"no arrangement on the {GROUND} satisfies all of: {listed}. Remove one, or give poses. "
                "Nothing was written."
            )
        turns = {name: turn for name in names if (turn := self._turn(name)) is not None}
        loose = loosen(
            items, spots, laterals, Surface(), wishes, turns=turns, rng=self._rng(GROUND, "loosening"), held=pinned
        )
        result = []
        for name, group in groups.items():
            if name in self.fixed:
                result.append(group.shifted(np.array(self.fixed[name].position)))
            else:
                height = self.gap - float(group.low[2])
                found = group.turned(yaw_matrix(loose[name].turn)) if loose[name].turn else group
                result.append(found.shifted(np.array([*loose[name].position, height])))
        return self._span(GROUND, self._turned(result))

    def _turned(self, groups: list[Group]) -> list[Group]:
        """`groups`, placed side by side, those turned that face something."""
        sights = [pair for pair in self.intents.targets if not {*pair} & set(self.fixed)]
        return turned_to_targets(groups, sights, gap=self.gap) if sights else groups

    def _span(self, home: str, placed: list[Group]) -> list[Group]:
        """`placed`, all that stands on `home` or is it, with what has several carriers there."""
        placed = list(placed)
        for name, carriers in self.spans.items():
            if self.parents[name] != home:
                continue
            if name not in self.fixed:
                placed.append(put_across(self._across(name), carriers, placed, gap=self.gap))
            elif home == GROUND:
                placed.append(self._across(name).shifted(np.array(self.fixed[name].position)))
            else:
                placed.append(self._pinned(name, home))
        return placed

    def _across(self, name: str) -> Group:
        """An object that has several carriers, with all that it carries."""
        return self._build(name, 0.0)

    def _build(self, name: str, yaw: float) -> Group:
        """The object at the origin with everything that it contains, carries and holds."""
        rotation = self.fixed[name].rotation if name in self.fixed else yaw_matrix(yaw)
        if name in self.turned and name not in self.fixed:
            rotation = rotation @ self.turned[name]
        root = self.bodies[name].at(rotation, np.zeros(3))
        group = Group((root,))
        kids = self.children[name]
        own = [(kid, self.bodies[kid].asset) for kid in kids if self.kinds[kid] == "in"]
        drawn, hung = ([kid for kid, asset in own if moves(asset, root.body.asset)] for moves in (slides, turns))
        kids = [kid for kid in kids if kid not in (*drawn, *hung)]
        column, within = column_of(root), [kid for kid in kids if self.kinds[kid] == "in"]
        inside = within if column is not None else []
        hanging = [kid for kid in kids if self.kinds[kid] == "hangs_from"]
        self.notes += [f'"{name}" has no cavity; "{kid}" stands on it.' for kid in within if kid not in inside]
        onto = [kid for kid in kids if kid not in inside and kid not in hanging]
        group = self._with(group, slide_in(root, [self._build(kid, 0.0) for kid in drawn], self.gap))
        group = self._with(group, hang_in(root, [self._build(kid, 0.0) for kid in hung], self.gap))
        # Under a ceiling things go in from the front.
        capped = column is not None and column.capped
        group = self._load(group, inside, yaw, "in") if capped else self._fill(group, inside)
        group = self._load(group, onto, yaw)
        group = self._with(group, self._span(name, [group])[1:])
        for kid in hanging:
            if kid in self.fixed:
                found = self._pinned(kid, name)
                held = attachment(found.root, root)
            else:
                found, held = hang(self._build(kid, 0.0), group, gap=self.gap, alone=len(hanging) == 1)
            if held is not None:
                self.attachments[kid] = held
            group = self._with(group, [found])
        return group

    def _fill(self, group: Group, names: list[str]) -> Group:
        root = group.root
        column = column_of(root)
        if not names or column is None:
            return group
        given = [self._pinned(kid, group.name) for kid in names if kid in self.fixed]
        groups = [self._build(kid, 0.0) for kid in names if kid not in self.fixed]
        if not groups:
            return self._with(group, given)
        obstacles = [member for other in given for member in other.members]
        turned = [one for one in groups if one.name in self.turned]
        stood, groups = stand_in_slots(root, [one for one in groups if one not in turned], obstacles, self.gap)
        groups = [*turned, *groups]
        if not groups:
            return self._with(group, [*given, *stood])
        obstacles += [one.root for one in stood]
        packed = pack(
            root,
            column,
            groups,
            obstacles=obstacles,
            rng=self._rng(group.name, "pack"),
            gap=self.gap,
            kept=set(self.turned),
        )
        return self._with(group, [*given, *stood, *packed])

    def _load(self, group: Group, names: list[str], yaw: float, kind: Literal["on", "in"] = "on") -> Group:
        """`group` with `names` on its tops, or on the floors of its compartments."""
        if not names:
            return group
        laterals = [lat for lat in self.laterals.get(group.name, []) if lat.child in names and lat.parent in names]
        given = [self._pinned(kid, group.name) for kid in names if kid in self.fixed]
        free = [kid for kid in names if kid not in self.fixed]
        groups = [self._build(kid, self._yaw(kid, group.name, yaw, laterals)) for kid in free]
        wishes = self._wishes(group.name, {one.name: one for one in groups})
        regions = flat_regions(group.root, kind)
        radius = float(regions[0].surface.half_size[0]) if regions[0].surface.disc else None
        settings = place_settings({one.name: one for one in groups}, laterals, wishes, radius=radius)
        angles = {name: angle for one in settings for name, angle in one.turns.items()}
        groups = [turned(one, angles[one.name]) if one.name in angles else one for one in groups]
        laid = {name for one in settings for name in one.formation.members}
        top = Top(
            supports=[*group.members, *(member for other in given for member in other.members)],
            root=group.root,
            regions=regions,
            given=given,
            turnable={kid for kid in free if not self.children[kid]},
            gap=self.gap,
            wishes=wishes,
            turns={kid: turn for kid in free if kid not in laid and (turn := self._turn(kid)) is not None},
            settings=settings,
            leaning=frozenset(self.intents.leaning),
        )
        placed, notes = spread(top, groups, laterals, self._rng(group.name, "on"))
        self.notes.extend(notes)
        return self._with(group, [*given, *self._turned(placed)])

    def _pinned(self, name: str, parent: str) -> Group:
        """A fixed child in its fixed parent's frame."""
        offset = np.array(self.fixed[name].position) - np.array(self.fixed[parent].position)
        return self._build(name, 0.0).shifted(offset)

    def _with(self, group: Group, others: Sequence[Group]) -> Group:
        return Group((*group.members, *(member for other in others for member in other.members)))

    def _yaw(self, name: str, parent: str, base: float, laterals: list[Lateral]) -> float:
        if name in self.intents.yaws:
            return self.intents.yaws[name]
        angle = ring_angles(laterals).get(name) if name not in self._seated else None
        if angle is not None and SEATS & set(self.bodies[name].asset.noun.split()):
            return float(np.arctan2(-np.cos(angle), np.sin(angle)))
        towards = self._seated.get(name)
        if towards is not None:
            return towards
        kids, size = self.children[name], float(self.bodies[name].asset.size.max())
        if size > _FURNITURE or len(kids) > 1:
            return 0.0
        alone = parent != GROUND and len(self.children[parent]) == 1
        spread_by = 0.06 if kids or alone else 0.14
        return (base if alone else 0.0) + float(self._rng(name, "yaw").uniform(-spread_by, spread_by))

    def _wishes(self, support: str, groups: Mapping[str, Group]) -> Wishes:
        """What is asked for on `support`, with seats at the sides of their tables."""
        wishes = self.intents.wishes(support, groups, self._across, self.gap)
        tables = [seated(table, ways, groups) for table, ways in self._around.items() if {table, *ways} <= set(groups)]
        return replace(wishes, formations=(*wishes.formations, *tables))

    def _around_tables(self) -> dict[str, dict[str, tuple[Array, float]]]:
        asked = {name for intents in self.intents.by_surface.values() for one in intents for name in one.stands_for}
        return around_tables(self.bodies, self.laterals, set(self.bodies) - asked - set(self.fixed))

    def _seats(self) -> dict[str, float]:
        found = {name: facing(way) for ways in self._around.values() for name, (way, _) in ways.items()}
        return found | beside_tables(self.bodies, self.laterals.get(GROUND, []))

    def _turn(self, name: str) -> float | None:
        """By how much a thing may be turned [rad] once it stands; None where something depends on its direction."""
        if name in self.fixed or name in self.intents.yaws or not self._one_piece(name):
            return None
        asset = self.bodies[name].asset
        if float(asset.size.max()) > _FURNITURE or name in self._seated:
            return None
        return free_turn(asset.noun, self._rng(name, "turn"), loaded=len(self.children[name]) > 1)

    def _one_piece(self, name: str) -> bool:
        """Whether a thing can be turned with all that it carries: nothing on it is at a side of another."""
        if name in self.spans or self.laterals.get(name) or self.intents.by_surface.get(name):
            return False
        return all(self.kinds[kid] != "hangs_from" and self._one_piece(kid) for kid in self.children[name])

    def _rng(self, name: str, purpose: str) -> np.random.Generator:
        return np.random.default_rng([self.seed, *name.encode(), *purpose.encode()])

    def _sibling_laterals(self, relations: tuple[Relation, ...]) -> dict[str, list[Lateral]]:
        """Lateral relations as relations between two children of one support, by support."""
        found: dict[str, list[Lateral]] = {}
        for relation in relations:
            if relation.supports:
                continue
            if relation.parent == GROUND:
                self.notes.append(f'"{relation}" places nothing: the ground is everywhere.')
                continue
            first, second = self._path(relation.child), self._path(relation.parent)
            shared = next(name for name in first if name in second)
            if shared in (relation.child, relation.parent):
                self.notes.append(f'"{relation}" is left aside: one carries the other.')
                continue
            child, parent = first[first.index(shared) - 1], second[second.index(shared) - 1]
            if shared != GROUND and "on" not in (self.kinds[child], self.kinds[parent]):
                self.notes.append(f'"{relation}" is left aside: things inside "{shared}" lie as they fit.')
                continue
            lateral = Lateral(child=child, kind=relation.kind, parent=parent)
            group = found.setdefault(shared, [])
            if lateral not in group:
                group.append(lateral)
        return found

    def _path(self, name: str) -> list[str]:
        path = [name]
        while path[-1] != GROUND:
            path.append(self.parents[path[-1]])
        return path
