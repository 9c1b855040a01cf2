"""What tasks look at, of every world on a device: one download a control step, and a view of each world."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.batch.physics import OWNERS, BatchedPhysics
from pat3d.envs.state import TOPPLED_DEGREES, SimState
from pat3d.envs.world import ROBOT


class BatchState:
    """The present state of all worlds in the computer's own memory."""

    def __init__(self, physics: BatchedPhysics) -> None:
        self._physics = physics
        self.world = physics.world
        self.worlds = [WorldState(self, number) for number in range(physics.worlds)]
        """A view of each, as tasks take it."""
        self._moving = np.array([self.world.bodies[name] for name in self.world.objects], dtype=np.int64)
        names = [obj.name for obj in self.world.scene.objects]
        self._owners = np.array([OWNERS + names.index(name) for name in self.world.objects], dtype=np.int64)
        self._start_up = np.zeros((physics.worlds, len(self._moving), 3))
        self.refresh()

    def refresh(self) -> None:
        """Fetch the state after a control step."""
        data = self._physics.data
        self.qpos, self.qvel, self.time = data.qpos.numpy(), data.qvel.numpy(), data.time.numpy()
        self.xpos, self.xquat = data.xpos.numpy(), data.xquat.numpy()
        self.xmat = data.xmat.numpy().reshape(*self.xpos.shape[:2], 9)
        self.xipos, self.site_xpos = data.xipos.numpy(), data.site_xpos.numpy()
        self.site_xmat = data.site_xmat.numpy().reshape(*self.site_xpos.shape[:2], 9)
        self.touching, self.pinched = self._physics.touches()
        for world in self.worlds:
            world.refresh()

    def begin(self, worlds: NDArray[np.int64]) -> None:
        """Take the present poses of `worlds` as the start of their episodes."""
        for number in worlds.tolist():
            self.worlds[number].take_start()
        self._start_up[worlds] = self._up()[worlds]

    def touched(self) -> NDArray[np.bool_]:
        """Which objects the robot touches, shape (worlds, objects)."""
        return self.touching[:, ROBOT + OWNERS, self._owners]

    def toppled(self) -> NDArray[np.bool_]:
        """Which objects turned over and are not in the robot's hand, shape (worlds, objects)."""
        held = self.pinched[:, :, self._owners].all(axis=1)
        leans = np.sum(self._up() * self._start_up, axis=2) < math.cos(math.radians(TOPPLED_DEGREES))
        return leans & ~held

    def _up(self) -> NDArray[Any]:
        """The world's upright direction in the frame of every object, shape (worlds, objects, 3)."""
        return self.xmat[:, self._moving, 6:]


class WorldState(SimState):
    """One world of a batch."""

    def __init__(self, batch: BatchState, number: int) -> None:
        super().__init__(batch.world, _Row(batch, number))
        self._batch, self._row = batch, number

    def refresh(self) -> None:
        """Read the contacts of the present state."""
        pairs = np.argwhere(np.triu(self._batch.touching[self._row])) - OWNERS
        self._pairs = {(first, second) for first, second in pairs.tolist()}
        if any(first == ROBOT or second == ROBOT for first, second in self._pairs):
            self._pinched = [set((np.flatnonzero(side) - OWNERS).tolist()) for side in self._batch.pinched[self._row]]
        else:
            self._pinched = [set(), set()]


class _Row:
    """The arrays of one world under the names that MuJoCo's own data has them."""

    def __init__(self, batch: BatchState, number: int) -> None:
        self._batch, self._number = batch, number

    def __getattr__(self, name: str) -> Any:
        return getattr(self._batch, name)[self._number]
