"""What tasks look at, of every world on a device: one download a control step."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.batch.physics import BatchedPhysics
from pat3d.envs.physics.predicates import OWNERS
from pat3d.envs.physics.simulation import Seen
from pat3d.envs.physics.snapshot import Array, Mask, Snapshot
from pat3d.envs.physics.state import States


class Downloaded(NamedTuple):
    """The present state of all worlds in the computer's own memory, in the order of their common model."""

    qpos: Array
    qvel: Array
    xpos: Array
    xquat: Array
    xmat: Array
    xipos: Array
    sites: Array
    site_xmat: Array
    touching: Mask
    pinched: Mask


def download(physics: BatchedPhysics) -> Downloaded:
    """Fetch the state after a control step, in double precision, for which predicates are compiled."""
    data = physics.data
    arrays = (data.qpos, data.qvel, data.xpos, data.xquat, data.xmat, data.xipos, data.site_xpos, data.site_xmat)
    qpos, qvel, xpos, xquat, xmat, xipos, sites, site_xmat = (one.numpy().astype(np.float64) for one in arrays)
    worlds = physics.worlds
    return Downloaded(
        qpos, qvel, xpos, xquat, xmat.reshape(worlds, -1, 9), xipos, sites, site_xmat.reshape(worlds, -1, 9),
        *physics.touches(),
    )  # fmt: skip


def seen(physics: BatchedPhysics) -> list[Seen]:
    """The present state of every world by the numbers of its own model; its arrays are views of one download."""
    data, kinds = physics.data, physics.merged.kinds
    qpos, qvel = data.qpos.numpy(), data.qvel.numpy()
    touching, pinched = physics.touches()
    return [
        Seen(qpos[world].take(kind.positions), qvel[world].take(kind.dofs), touching[world], pinched[world], bool(lost))
        for world, lost in enumerate(physics.lost)
        for kind in (kinds[world % len(kinds)],)
    ]


class BatchState(States):
    """The present state of the worlds of one kind, by the numbers of that kind's own model."""

    def __init__(self, physics: BatchedPhysics, number: int, now: Downloaded) -> None:
        kinds = physics.merged.kinds
        self._kind = kinds[number]
        self._worlds = slice(number, physics.worlds, len(kinds))
        self.rows = np.arange(physics.worlds)[self._worlds]
        """Numbers of its worlds among all."""
        super().__init__(self._kind.world, len(self.rows))
        self.take(now)
        self.take_start(self.everyone)

    def take(self, now: Downloaded) -> None:
        """Take its part of what was fetched."""
        kind, count = self._kind, OWNERS + len(self.bodies)

        def own(values: NDArray[Any], numbers: NDArray[np.int64]) -> Array:
            return values[self._worlds].take(numbers, axis=1)

        self.qpos, self.xquat = own(now.qpos, kind.positions), own(now.xquat, kind.bodies)
        self.snapshot = Snapshot(
            xpos=own(now.xpos, kind.bodies),
            xmat=own(now.xmat, kind.bodies),
            xipos=own(now.xipos, kind.bodies),
            qvel=own(now.qvel, kind.dofs),
            sites=own(now.sites, kind.sites),
            site_xmat=own(now.site_xmat, kind.sites),
            touching=np.ascontiguousarray(now.touching[self._worlds, :count, :count]),
            pinched=np.ascontiguousarray(now.pinched[self._worlds, :, :count]),
            **self._about,
        )
