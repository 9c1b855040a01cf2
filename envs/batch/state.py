"""What tasks look at, of every world on a device: one download a control step."""

from __future__ import annotations

from typing import Any

import numpy as np

from pat3d.envs.batch.physics import BatchedPhysics
from pat3d.envs.physics.snapshot import Array, Snapshot
from pat3d.envs.physics.state import States


class BatchState(States):
    """The present state of all worlds in the computer's own memory."""

    def __init__(self, physics: BatchedPhysics) -> None:
        super().__init__(physics.world, physics.worlds)
        self._physics = physics
        self.refresh()
        self.take_start(np.arange(physics.worlds))

    def refresh(self) -> None:
        """Fetch the state after a control step."""
        data, worlds = self._physics.data, self.count
        touching, pinched = self._physics.touches()
        self.qpos, self.xquat = _double(data.qpos), _double(data.xquat)
        self.site_xmat = data.site_xmat.numpy().reshape(worlds, -1, 9)
        self.snapshot = Snapshot(
            xpos=_double(data.xpos),
            xmat=_double(data.xmat).reshape(worlds, -1, 9),
            xipos=_double(data.xipos),
            qvel=_double(data.qvel),
            sites=_double(data.site_xpos),
            touching=touching,
            pinched=pinched,
            **self._about,
        )


def _double(array: Any) -> Array:
    """A copy in double precision, for which predicates and observations are compiled."""
    return array.numpy().astype(np.float64)
