"""What tasks look at: the objects of running simulations, and what touches what.

`States` holds any number of worlds that are copies of one another: tasks judge all of them at once. `SimState` is one
of them by name, for those who follow a single world.
"""

from __future__ import annotations

import itertools
import math
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.compiled import as_written
from pat3d.envs.physics import predicates
from pat3d.envs.physics.snapshot import Array, Floors, Mask, Numbers, Snapshot, corners, floors, grips
from pat3d.envs.physics.world import World
from pat3d.scene.model import Scene

TOUCH = 1e-3
"""Surfaces nearer than this touch [m]."""


class States:
    """The present state of worlds that are copies of one another; the first axis of every array is the world.

    A subclass fills the arrays and reads the contacts.

    Args:
        world: that all of them are copies of.
        count: of worlds.
    """

    qpos: Array
    xquat: Array
    """Of body frames (wxyz), shape (worlds, bodies, 4)."""
    snapshot: Snapshot
    """All that the predicates read."""

    def __init__(self, world: World, count: int) -> None:
        self.world, self.count = world, count
        objects = world.scene.objects
        self.numbers = {obj.name: number for number, obj in enumerate(objects)}
        """Of every object of the scene: its place there."""
        self.bodies = np.array([world.bodies[obj.name] for obj in objects], dtype=np.int64)
        """MuJoCo's, of every object of the scene."""
        self.everyone = np.arange(count)
        """The numbers of the worlds."""
        self.hand = int(world.model.site(world.prefix + world.robot.grip_site).id)
        """MuJoCo's site of the grip."""
        dofs = np.full(len(objects), -1, dtype=np.int64)
        dofs[[self.numbers[name] for name in world.objects]] = world.velocities
        self._about = {
            "start_centre": np.zeros((count, len(objects), 3)),
            "start_up": np.zeros((count, len(objects), 3)),
            "bodies": self.bodies,
            "dofs": dofs,
            "hand": self.hand,
            "surface": float(world.placement.surface - predicates.EDGE),
            "grips": grips(world),
        }

    def take_start(self, worlds: Numbers) -> None:
        """Take the present poses of `worlds` as the start of their episodes."""
        now, chosen = self.snapshot, np.ix_(worlds, self.bodies)
        now.start_centre[worlds] = now.xipos[chosen]
        now.start_up[worlds] = now.xmat[chosen][..., 6:]

    def upsets(self) -> tuple[Mask, Mask]:
        """Which objects toppled, and which fell, shape (worlds, objects)."""
        return predicates.upsets(self.snapshot)

    def touched(self) -> Mask:
        """Which objects the robot touches, shape (worlds, objects)."""
        return self.snapshot.touching[:, predicates.ROBOT_ROW, predicates.OWNERS :]


# A single look into a table takes longer through what is compiled.
_touch, _touched, _held, _grounded = map(
    as_written, (predicates.touch, predicates.touched, predicates.held, predicates.grounded)
)


class SimState:
    """One world of several; poses are views that later steps change."""

    def __init__(self, states: States, number: int = 0) -> None:
        self.states, self.world, self._number = states, states.world, number
        self._numbers, self._bodies = states.numbers, states.world.bodies
        self._floors: dict[tuple[str, str, str], Floors] = {}

    @property
    def scene(self) -> Scene:
        """The scene at rest, as it was loaded."""
        return self.world.scene

    def position(self, name: str) -> Array:
        """Of the object's own frame [m], shape (3,)."""
        return self.states.snapshot.xpos[self._number, self._bodies[name]]

    def quat_wxyz(self, name: str) -> Array:
        """Of the object's own frame, shape (4,)."""
        return self.states.xquat[self._number, self._bodies[name]]

    def rotation(self, name: str) -> Array:
        """Of the object's own frame, shape (3, 3)."""
        return self.states.snapshot.xmat[self._number, self._bodies[name]].reshape(3, 3)

    def centre(self, name: str) -> Array:
        """Of mass [m], shape (3,)."""
        return self.states.snapshot.xipos[self._number, self._bodies[name]]

    def start_centre(self, name: str) -> Array:
        """Where the centre of mass was at the start [m], shape (3,)."""
        return self.states.snapshot.start_centre[self._number, self._numbers[name]]

    def points(self, name: str) -> Array:
        """Corners of the object's convex parts in the world [m], shape (n, 3)."""
        return corners(self.scene[name].asset) @ self.rotation(name).T + self.position(name)

    def local(self, points: Array, name: str) -> Array:
        """World points [m], shape (n, 3), in the frame of an object."""
        return (points - self.position(name)) @ self.rotation(name)

    def still(self, name: str) -> bool:
        """Whether the object is at rest."""
        return predicates.still(self.states.snapshot, self._number, self._numbers[name])

    def touch(self, first: str, second: str) -> bool:
        """Whether two objects are in contact."""
        return bool(_touch(self.states.snapshot, self._number, self._numbers[first], self._numbers[second]))

    def touched(self, name: str) -> bool:
        """Whether the robot touches the object."""
        return bool(_touched(self.states.snapshot, self._number, self._numbers[name]))

    def grounded(self, name: str) -> bool:
        """Whether the object touches the workbench or the floor."""
        return bool(_grounded(self.states.snapshot, self._number, self._numbers[name]))

    def held(self, name: str) -> bool:
        """Whether both fingers touch the object."""
        return bool(_held(self.states.snapshot, self._number, self._numbers[name]))

    def holding(self, name: str) -> tuple[bool, ...]:
        """Whether both fingers of an arm touch the object, the left one of two arms first."""
        fingers = self.states.snapshot.pinched[self._number, :, predicates.OWNERS + self._numbers[name]]
        return tuple(bool(one and other) for one, other in fingers.reshape(-1, 2))

    def inside(self, name: str, container: str) -> bool:
        """Whether an object lies in the cavity of another."""
        return self._stands(name, container, "in")

    def on_top(self, name: str, base: str) -> bool:
        """Whether an object stands on another."""
        return self._stands(name, base, "on")

    def _stands(self, name: str, where: str, kind: Literal["in", "on"]) -> bool:
        place = self._floors.get((name, where, kind))
        if place is None:
            place = self._floors[name, where, kind] = floors(self.world, [(name, where)], kind)
        return bool(predicates.pairs_that(self.states.snapshot, place, kind == "in")[self._number, 0])

    def tilt(self, name: str) -> float:
        """Angle [degrees] between the object's upright direction and that at the start."""
        cosine = predicates.uprightness(self.states.snapshot, self._number, self._numbers[name])
        return math.degrees(math.acos(min(1.0, max(-1.0, cosine))))

    def toppled(self) -> list[str]:
        """Objects that the robot does not hold and that turned over, or nearly."""
        return self.named(self.states.upsets()[0])

    def fell(self) -> list[str]:
        """Objects that dropped from the surface of the work."""
        return self.named(self.states.upsets()[1])

    def named(self, which: Mask) -> list[str]:
        """Names of the objects for which a predicate, shape (worlds, objects), holds in this world."""
        return list(itertools.compress(self._numbers, which[self._number].tolist()))

    @property
    def hand(self) -> Array:
        """Position of the grip site [m], shape (3,)."""
        return self.states.snapshot.sites[self._number, self.states.hand]

    @property
    def hand_rotation(self) -> NDArray[Any]:
        """Rotation of the grip site, shape (3, 3)."""
        return self.states.snapshot.site_xmat[self._number, self.states.hand].reshape(3, 3)
