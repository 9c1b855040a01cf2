"""The state of one world that MuJoCo steps: its own arrays, and the contacts, of sleeping objects too."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.compiled import compiled
from pat3d.envs.physics.predicates import OWNERS
from pat3d.envs.physics.snapshot import Mask, Snapshot
from pat3d.envs.physics.state import TOUCH, States
from pat3d.envs.physics.world import FLOOR, SUPPORT, World

PRESSING = math.cos(math.radians(45.0))
"""Least cosine between a contact's normal and the direction in which the fingers close, for a finger that presses on
what it touches: fingertips that come down on a rim are no grasp."""


class MujocoState(States):
    """One world; poses are MuJoCo's own arrays, contacts are read by `refresh`.

    Args:
        world: with the model.
        data: MuJoCo's.
    """

    def __init__(self, world: World, data: Any) -> None:
        super().__init__(world, 1)
        import mujoco

        self._mujoco = mujoco
        self._data = data
        self.qpos, self.xquat = data.qpos[None], data.xquat[None]
        model = world.model
        self._row = world.owner + OWNERS
        self._finger = fingers(world)
        self._hands, self._closing = closing(world)
        self._collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
        count = OWNERS + len(self.bodies)
        self._never_moves = np.zeros(count, dtype=np.bool_)
        self._never_moves[[OWNERS + SUPPORT, OWNERS + FLOOR]] = True
        self._never_moves[OWNERS:] = [obj.fixed for obj in world.scene.objects]
        self.snapshot = Snapshot(
            xpos=data.xpos[None],
            xmat=data.xmat[None],
            xipos=data.xipos[None],
            qvel=data.qvel[None],
            sites=data.site_xpos[None],
            site_xmat=data.site_xmat[None],
            touching=np.zeros((1, count, count), dtype=np.bool_),
            pinched=np.zeros((1, 2 * len(world.arms), count), dtype=np.bool_),
            **self._about,
        )
        self._wake()

    def _wake(self) -> None:
        self._asleep = np.zeros(len(self.bodies), dtype=np.bool_)
        self._lasting = np.zeros_like(self.snapshot.touching[0])
        """Contacts that MuJoCo no longer lists: pairs of which one sleeps and the other does not move either."""

    def begin(self) -> None:
        """Take the present poses as the start of the episode."""
        self.snapshot.touching[:] = False
        self._wake()
        self.refresh()
        self.take_start(self.everyone)

    def refresh(self) -> None:
        """Read the contacts of the present state."""
        contact, now = self._data.contact, self.snapshot.touching[0]
        before = now.copy()
        now[:], self.snapshot.pinched[:] = False, False
        distances = contact.dist
        if len(distances):
            _list_contacts(
                contact.geom,
                distances,
                contact.efc_address,
                TOUCH,
                self._row,
                self._finger,
                contact.frame,
                np.einsum("aij,aj->ai", self.snapshot.site_xmat[0, self._hands].reshape(-1, 3, 3), self._closing),
                now,
                self.snapshot.pinched[0],
            )
        asleep = self._data.body_awake.take(self.bodies) == 0
        if (asleep != self._asleep).any():
            self._fall_asleep(asleep, before, now)
        else:
            now |= before & self._lasting

    def show(self, touching: Mask, pinched: Mask) -> None:
        """Take contacts that another engine found, with at least as many rows and columns as these tables have."""
        count = self.snapshot.touching.shape[1]
        self.snapshot.touching[0] = touching[:count, :count]
        self.snapshot.pinched[0] = pinched[:, :count]

    def _fall_asleep(self, asleep: Mask, before: Mask, now: Mask) -> None:
        """Take note of which objects sleep.

        Args:
            asleep: shape (objects,).
            before: who touched whom after the last control step.
            now: the contacts that MuJoCo lists, shape as `before`; those that last are added.
        """
        fresh, self._asleep = asleep & ~self._asleep, asleep
        unmoving = self._never_moves.copy()
        unmoving[OWNERS:] |= asleep
        self._lasting[:] = unmoving & unmoving[:, None]
        self._lasting[np.ix_(self._never_moves, self._never_moves)] = False
        now |= before & self._lasting
        for number in (fresh & ~now[OWNERS:].any(axis=1)).nonzero()[0].tolist():
            # It landed and fell asleep within one control step.
            others = self._near(OWNERS + number, unmoving)
            now[OWNERS + number, others] = now[others, OWNERS + number] = True

    def _near(self, row: int, others: Mask) -> list[int]:
        """Those of `others` that are as close to the object of `row` as things that touch."""
        model, data = self.world.model, self._data
        own = ((self._row == row) & self._collides).nonzero()[0]
        theirs = (others[self._row] & (self._row != row) & self._collides).nonzero()[0]
        apart = np.linalg.norm(data.geom_xpos[theirs, None] - data.geom_xpos[own], axis=2)
        reach = model.geom_rbound[theirs, None] + model.geom_rbound[own] + TOUCH
        # A plane or a box as large as the ground has no useful bound.
        possible = (apart < reach) | (model.geom_rbound[theirs, None] == 0)
        found: set[int] = set()
        for their, mine in np.argwhere(possible).tolist():
            owner, pair = int(self._row[theirs[their]]), (int(own[mine]), int(theirs[their]))
            if owner not in found and self._mujoco.mj_geomDistance(model, data, *pair, TOUCH, None) < TOUCH:
                found.add(owner)
        return sorted(found)


@compiled
def _list_contacts(geoms, distances, addresses, nearest, row, finger, frames, closing, touching, pinched):
    """Enter contacts nearer than `nearest` [m] that push into the tables of one world."""
    for contact in range(len(distances)):
        if distances[contact] < nearest and addresses[contact] >= 0:
            first, second = geoms[contact]
            a, b = row[first], row[second]
            if a != b:
                touching[a, b] = touching[b, a] = True
            if finger[first] >= 0 and _presses(frames[contact], closing[finger[first] // 2]):
                pinched[finger[first], b] = True
            if finger[second] >= 0 and _presses(frames[contact], closing[finger[second] // 2]):
                pinched[finger[second], a] = True


@compiled
def _presses(frame, closing):
    """Whether the normal, which a contact's frame begins with, is along the direction `closing`."""
    return abs(frame[0] * closing[0] + frame[1] * closing[1] + frame[2] * closing[2]) >= PRESSING


def closing(world: World) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Grip site of every arm, and the direction from one finger to the other in its frame, shape (arms, 3)."""
    import mujoco

    model, data = world.model, mujoco.MjData(world.model)
    mujoco.mj_kinematics(model, data)
    sites, directions = [], []
    for arm in world.arms:
        site = int(model.site(arm.prefix + arm.robot.grip_site).id)
        middles = [
            np.mean([data.geom_xpos[model.geom(arm.prefix + name).id] for name in names], axis=0)
            for names in arm.robot.fingers
        ]
        local = (middles[1] - middles[0]) @ data.site_xmat[site].reshape(3, 3)
        sites.append(site)
        directions.append(local / np.linalg.norm(local))
    return np.array(sites), np.array(directions)


def fingers(world: World) -> NDArray[np.int32]:
    """Which finger every geom belongs to, two for each arm in their order, -1 for none."""
    found = np.full(world.model.ngeom, -1, dtype=np.int32)
    for number, arm in enumerate(world.arms):
        for side, names in enumerate(arm.robot.fingers):
            found[[world.model.geom(arm.prefix + name).id for name in names]] = 2 * number + side
    return found
