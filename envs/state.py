"""What tasks look at: the objects of a running simulation, and what touches what."""

from __future__ import annotations

import functools
import math
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.world import FLOOR, ROBOT, SUPPORT, World
from pat3d.scene import Scene

Array = NDArray[np.float64]

TOPPLED_DEGREES = 30.0
"""An object that turned its upright axis by more than this since the start has toppled."""

_TOPPLED_COSINE = math.cos(math.radians(TOPPLED_DEGREES))

STILL_SPEED = 0.05
"""Slower than this is at rest [m/s]."""

TOUCH = 1e-3
"""Surfaces nearer than this touch [m]."""

STILL_TURN = 0.5
"""Slower than this is at rest [rad/s]."""


class SimState:
    """A view of the simulation after a control step; contacts are read once for each step."""

    def __init__(self, world: World, data: Any) -> None:
        self.world, self._data = world, data
        self._mujoco: Any = import_module("mujoco")
        model = world.model
        self._number = {obj.name: number for number, obj in enumerate(world.scene.objects)}
        self._bodies = [world.bodies[obj.name] for obj in world.scene.objects]
        self._fixed = {number for number, obj in enumerate(world.scene.objects) if obj.fixed} | {SUPPORT, FLOOR}
        self._moving = {name: number for number, name in enumerate(world.objects)}
        self._moving_bodies = np.array([world.bodies[name] for name in world.objects], dtype=np.int64)
        self._fingers = np.zeros((2, model.ngeom), dtype=bool)
        for side, names in enumerate(world.robot.fingers):
            self._fingers[side, [model.geom(world.prefix + name).id for name in names]] = True
        self._site = model.site(world.prefix + world.robot.grip_site).id
        self._names = [obj.name for obj in world.scene.objects]
        self._pairs: set[tuple[int, int]] = set()
        self._pinched: list[set[int]] = [set(), set()]
        self._start_centre: dict[str, Array] = {}
        self._start_up: dict[str, Array] = {}
        self._start_ups = np.zeros((len(world.objects), 3))
        self._start_heights = np.zeros(len(world.objects))

    @property
    def scene(self) -> Scene:
        """The scene at rest, as it was loaded."""
        return self.world.scene

    def begin(self) -> None:
        """Take the present poses as the start of the episode."""
        self._pairs = set()
        self.refresh()
        self.take_start()

    def take_start(self) -> None:
        """Take the present poses as the start of the episode, the contacts as they were read last."""
        for name in self._number:
            self._start_centre[name] = self.centre(name).copy()
            self._start_up[name] = self.rotation(name)[2].copy()
        self._start_ups = self._data.xmat[self._moving_bodies, 6:9]
        self._start_heights = self._data.xipos[self._moving_bodies, 2]

    def refresh(self) -> None:
        """Read the contacts of the present state."""
        contact, owner = self._data.contact, self.world.owner
        geoms = contact.geom
        touching = (contact.dist < TOUCH) & (contact.efc_address >= 0)
        geoms = geoms[touching]
        owners = owner[geoms]
        pairs = {(min(pair), max(pair)) for pair in owners.tolist() if pair[0] != pair[1]}
        self._pairs = pairs | self._kept_while_asleep(pairs)
        self._pinched = [set(), set()]
        if (owners == ROBOT).any():
            for side in (0, 1):
                for end in (0, 1):
                    held = self._fingers[side][geoms[:, end]]
                    self._pinched[side].update(owners[held, 1 - end].tolist())

    def _kept_while_asleep(self, pairs: set[tuple[int, int]]) -> set[tuple[int, int]]:
        """What touched each object when it fell asleep: MuJoCo lists no contacts among what sleeps or never moves."""
        asleep = {number for number, body in enumerate(self._bodies) if not self._data.body_awake[body]}
        if not asleep:
            return set()
        unmoving = asleep | self._fixed
        kept = {pair for pair in self._pairs if pair[0] in unmoving and pair[1] in unmoving and asleep & set(pair)}
        for number in asleep:
            if not any(number in pair for pair in kept) and not any(number in pair for pair in pairs):
                # It landed and fell asleep within one control step.
                kept |= self._near(number, unmoving - {number})
        return kept

    def _near(self, number: int, others: set[int]) -> set[tuple[int, int]]:
        """Pairs of object `number` and those of `others` that are as close as things that touch."""
        model, data, owner = self.world.model, self._data, self.world.owner
        collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
        own = np.flatnonzero((owner == number) & collides)
        found = set()
        for geom in np.flatnonzero(np.isin(owner, list(others)) & collides).tolist():
            reach = model.geom_rbound[geom] + model.geom_rbound[own] + TOUCH
            apart = np.linalg.norm(data.geom_xpos[own] - data.geom_xpos[geom], axis=1)
            # A plane or a box as large as the ground has no useful bound.
            for mine in own[(apart < reach) | (model.geom_rbound[geom] == 0)].tolist():
                if self._mujoco.mj_geomDistance(model, data, mine, geom, TOUCH, None) < TOUCH:
                    found.add((min(number, int(owner[geom])), max(number, int(owner[geom]))))
                    break
        return found

    def position(self, name: str) -> Array:
        """Of the object's own frame [m], shape (3,)."""
        return self._data.xpos[self.world.bodies[name]]

    def quat_wxyz(self, name: str) -> Array:
        """Of the object's own frame, shape (4,)."""
        return self._data.xquat[self.world.bodies[name]]

    def rotation(self, name: str) -> Array:
        """Of the object's own frame, shape (3, 3)."""
        return self._data.xmat[self.world.bodies[name]].reshape(3, 3)

    def centre(self, name: str) -> Array:
        """Of mass [m], shape (3,)."""
        return self._data.xipos[self.world.bodies[name]]

    def start_centre(self, name: str) -> Array:
        """Where the centre of mass was at the start [m], shape (3,)."""
        return self._start_centre[name]

    def local(self, points: Array, name: str) -> Array:
        """World points [m], shape (n, 3), in the frame of object `name`."""
        return (points - self.position(name)) @ self.rotation(name)

    def points(self, name: str) -> Array:
        """Corners of the object's convex parts in the world [m], shape (n, 3)."""
        return _corners(self.scene[name].asset) @ self.rotation(name).T + self.position(name)

    def still(self, name: str) -> bool:
        """Whether the object is at rest."""
        if name not in self._moving:
            return True
        first = self.world.velocities[self._moving[name]]
        velocity = self._data.qvel[first : first + 6]
        return bool(np.linalg.norm(velocity[:3]) < STILL_SPEED and np.linalg.norm(velocity[3:]) < STILL_TURN)

    def touch(self, first: str, second: str) -> bool:
        """Whether two objects are in contact."""
        a, b = self._number[first], self._number[second]
        return (min(a, b), max(a, b)) in self._pairs

    def touched(self, name: str) -> bool:
        """Whether the robot touches the object."""
        return (ROBOT, self._number[name]) in self._pairs

    def held(self, name: str) -> bool:
        """Whether both fingers touch the object."""
        number = self._number[name]
        return number in self._pinched[0] and number in self._pinched[1]

    def tilt(self, name: str) -> float:
        """Angle [degrees] between the object's upright direction and that at the start."""
        cosine = float(self.rotation(name)[2] @ self._start_up[name])
        return math.degrees(math.acos(min(1.0, max(-1.0, cosine))))

    def toppled(self) -> list[str]:
        """Objects that the robot does not hold and that turned over, or nearly."""
        cosines = (self._data.xmat[self._moving_bodies, 6:9] * self._start_ups).sum(axis=1)
        leaning = np.flatnonzero(cosines < _TOPPLED_COSINE).tolist()
        return [name for name in map(self.world.objects.__getitem__, leaning) if not self.held(name)]

    def fell(self) -> list[str]:
        """Objects that dropped from the surface of the work."""
        surface = self.world.placement.surface - 0.01
        # Nothing falls that is no lower than at the start.
        heights = self._data.xipos[self._moving_bodies, 2]
        lower = np.flatnonzero(heights < self._start_heights).tolist()
        fallen = []
        for name in map(self.world.objects.__getitem__, lower):
            now, before = float(self.centre(name)[2]), float(self._start_centre[name][2])
            on_floor = (FLOOR, self._number[name]) in self._pairs and before > now + 0.05
            # What stood on the floor from the start, as a table does, never falls.
            if (now < surface <= before) or on_floor:
                fallen.append(name)
        return fallen

    def all_touched(self) -> list[str]:
        """Objects that the robot touches."""
        return [name for name in self._names if self.touched(name)]

    @property
    def hand(self) -> Array:
        """Position of the grip site [m], shape (3,)."""
        return self._data.site_xpos[self._site]

    @property
    def hand_rotation(self) -> Array:
        """Rotation of the grip site, shape (3, 3)."""
        return self._data.site_xmat[self._site].reshape(3, 3)

    @property
    def time(self) -> float:
        """Since the start of the episode [s]."""
        return float(self._data.time)


@functools.lru_cache(maxsize=1024)
def _corners(asset: Any) -> Array:
    return np.concatenate([part.vertices for part in asset.parts])
