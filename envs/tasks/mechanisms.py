"""What opens and shuts: a drawer along its rails, a door about its hinge; both held by contact alone.

Poses are those of the moved body in the frame of the one that holds it, whose front looks along its -y.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from pat3d.envs.physics.snapshot import Array, Mask
from pat3d.errors import TaskError
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout import doors, drawers
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Scene

BEHIND, AWAY = 0.016, 0.03
"""Of the middle of fingers behind the bar that they pull at, and before a handle that they push [m]."""

ASTRAY = 0.02
"""How far it may be beside its way [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Mechanism(ABC):
    """One body that moves along a way of its own in another."""

    holder: str
    """What it moves in."""
    whole: float
    """By how much it is moved when it is open, in the unit of its way."""
    lever: float
    """By how much its handle moves for one unit of its way [m]."""
    bar: Array
    """The middle of the front of its handle's bar [m], in its own frame, shape (3,)."""
    thick: float
    """Of that bar [m]."""
    wanted: float
    """The share to which the scripted policy opens it."""
    opened: float
    """The share of the whole from which on it is open."""
    most: float
    """The share up to which it is not out of its way."""

    @abstractmethod
    def out(self, position: Array, rotation: Array) -> Array:
        """By how much it is open at poses, shapes (n, 3) and (n, 3, 3); shape (n,)."""

    @abstractmethod
    def astray(self, position: Array, rotation: Array) -> Mask:
        """Whether it is beside its way; as of `out`."""

    @abstractmethod
    def moved(self, position: Array, rotation: Array, by: float) -> tuple[Array, Array]:
        """The pose that it has after it was opened `by` so much from another, shapes (3,) and (3, 3)."""

    @abstractmethod
    def along(self, point: Array) -> float:
        """How far along the way a point of it is, from an origin that is the same for all points with one start."""

    def at_handle(self, kind: str) -> Array:
        """Where fingers begin to open or close it [m], in its frame, shape (3,): behind the bar, or before it."""
        return self.bar + [0.0, self.thick + BEHIND if kind == "open" else -AWAY, 0.0]

    def goal(self, kind: str) -> float:
        """To where the scripted policy moves it to open or close it, in the unit of its way."""
        return self.wanted * self.whole if kind == "open" else 0.0

    def out_in(self, scene: Scene, name: str) -> float:
        """By how much it is open in `scene`."""
        position, rotation = self.within(scene, name)
        return float(self.out(position[None], rotation[None])[0])

    def within(self, scene: Scene, name: str) -> tuple[Array, Array]:
        """Its pose in the frame of its holder, shapes (3,) and (3, 3)."""
        own, holder = scene[name].pose, scene[self.holder].pose
        turned = holder.rotation.T
        return turned @ (np.array(own.position) - np.array(holder.position)), turned @ own.rotation


@dataclass(frozen=True, kw_only=True, eq=False)
class Rail(Mechanism):
    """A drawer in its row; its way is measured in metres."""

    shut: float
    """Where its origin is along the depth of the cabinet when it is shut [m]."""
    row: Array
    """Where it is across and up [m], shape (2,)."""

    def out(self, position: Array, rotation: Array) -> Array:
        return self.shut - position[:, 1]

    def astray(self, position: Array, rotation: Array) -> Mask:
        return np.asarray(np.abs(position[:, [0, 2]] - self.row).max(axis=1) > ASTRAY)

    def moved(self, position: Array, rotation: Array, by: float) -> tuple[Array, Array]:
        return position - [0.0, by, 0.0], rotation

    def along(self, point: Array) -> float:
        return -float(point[1])


@dataclass(frozen=True, kw_only=True, eq=False)
class Turning(Mechanism):
    """A door about its hinge; its way is measured in radians."""

    hinge: doors.Hinge

    def out(self, position: Array, rotation: Array) -> Array:
        return -np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0])

    def astray(self, position: Array, rotation: Array) -> Mask:
        off = position + rotation @ self.hinge.pivot - self.hinge.axis
        return np.asarray(np.linalg.norm(off, axis=1) > ASTRAY)

    def moved(self, position: Array, rotation: Array, by: float) -> tuple[Array, Array]:
        axis, turned = position + rotation @ self.hinge.pivot, yaw_matrix(-by)
        return axis + turned @ (position - axis), turned @ rotation

    def along(self, point: Array) -> float:
        x, y = (point - self.hinge.axis)[:2]
        return -float(np.arctan2(y, x))


def mechanism_of(scene: Scene, name: str) -> Mechanism:
    """How `name` opens and shuts.

    Raises:
        TaskError: it does not.
    """
    holder = scene.parent(name)
    if holder != GROUND:
        moved, held = scene[name].asset, scene[holder].asset
        if drawers.slides(moved, held):
            return _rail(scene, name, holder)
        if doors.turns(moved, held):
            return _turning(moved, held, holder)
    raise TaskError(
        f'"{name}" is no drawer in a "drawer cabinet" and no door of a microwave, cabinet or fridge that turns, and '
        "nothing else opens or closes."
    )


def _rail(scene: Scene, name: str, cabinet: str) -> Rail:
    from pat3d.assets.catalogue.drawers import BAR, BOX, GRIP

    drawer, own = scene[name], scene[cabinet].pose
    low, high = drawer.asset.bounds
    scale = float(high[2] - low[2]) / BOX[2]
    return Rail(
        holder=cabinet,
        whole=drawers.pulled(drawer.asset),
        lever=1.0,
        bar=np.array([0.0, low[1], scale * GRIP * BOX[2]]),
        thick=scale * BAR,
        wanted=0.85,
        opened=0.6,
        most=1.5,
        shut=drawers.shut_at(drawer.asset, scene[cabinet].asset),
        row=(own.rotation.T @ (np.array(drawer.pose.position) - np.array(own.position)))[[0, 2]],
    )


def _turning(door: Asset, case: Asset, name: str) -> Turning:
    from pat3d.assets.catalogue.doors import BAR

    (way, scale), hinge = doors.doorway_of(door), doors.hinge_of(door, case)
    low = door.bounds[0]
    return Turning(
        holder=name,
        whole=math.radians(doors.OPEN),
        lever=scale * way.grip,
        bar=np.array([hinge.pivot[0] + scale * way.grip, low[1], low[2] + scale * way.bar]),
        thick=scale * BAR,
        # Further than it counts, and no further than a wrist turns.
        wanted=0.72,
        opened=0.6,
        most=2.0,
        hinge=hinge,
    )
