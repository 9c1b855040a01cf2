"""Many copies of one world on MuJoCo Warp, stepped together.

MuJoCo Warp computes in single precision and knows no contact margins beside multi-contact collision. The exported
contacts are stiffer than single precision can resolve: at rest, surfaces overlap by tenths of a micrometre, and
coordinates are known to hundredths of one. `in_single_precision` softens the contacts to overlaps of some ten
micrometres; that what stood still stands still then too is checked on the device before anything else.
"""

from __future__ import annotations

import copy
import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.envs.batch.controllers import BatchedController
from pat3d.envs.batch.kernels import note_peaks, note_touches
from pat3d.envs.physics.loading import store_record
from pat3d.envs.physics.mujoco_state import fingers
from pat3d.envs.physics.predicates import OWNERS
from pat3d.envs.physics.simulation import Simulation
from pat3d.envs.physics.world import World
from pat3d.errors import EnvironmentSetupError, UnsettledSceneError
from pat3d.scene.cache import cache_root
from pat3d.scene.physics import STILL_SECONDS

Array = NDArray[np.float32]

SOLREF, SOLIMP = (0.01, 1.0), (0.99, 0.99, 0.001, 0.5, 2.0)
"""Time constant [s], damping ratio and impedance of the scene's contacts.

A body at rest overlaps with what carries it by g (1 - d) t^2 = 10 um. A smaller impedance d overlaps as much with a
shorter time constant, but what leans creeps then: friction gives way in proportion to 1 - d.
"""

CCD_TOLERANCE = 1.0e-6
"""Of collision detection [m]: finer ones are below the rounding of single precision, and no contact is found."""

SPARE = 2.0
"""Room in the buffers over what the scene needs at rest."""

ROBOT_CONTACTS = 48
"""Room for contacts of the robot with the scene, a world."""

ROWS_PER_CONTACT = 6
"""Of the constraint matrix, for the widest contacts that scenes have (pyramids with torsional friction)."""

MAX_MM, MAX_DEGREES = 1.0, 1.0
"""What stands still moves less in that time."""


def in_single_precision(model: Any) -> Any:
    """A copy of `model` whose contacts single precision resolves; masses, shapes, friction and time step are the same.

    Contacts lose their margins; stiff ones get `SOLREF` and `SOLIMP`. Friction cones are pyramids: MuJoCo Warp steps
    them five times as fast as elliptic ones. A pyramid's friction is as soft as its normal force, where an elliptic
    cone's is stiffer by impratio; so the soft contacts, which are the robot's, get as much closer to impedance 1, or
    what a hand holds would creep out of it. Boxes collide by their own routine: the general one loses contacts of
    boxes that overlap by micrometres.
    """
    import mujoco

    fit = copy.copy(model)
    fit.geom_margin[:], fit.geom_gap[:] = 0.0, 0.0
    stiff = fit.geom_solref[:, 0] < SOLREF[0]
    fit.geom_solref[stiff], fit.geom_solimp[stiff] = SOLREF, SOLIMP
    fit.geom_solimp[~stiff, :2] = 1.0 - (1.0 - fit.geom_solimp[~stiff, :2]) / model.opt.impratio
    fit.opt.ccd_tolerance = CCD_TOLERANCE
    fit.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_NATIVECCD)
    fit.opt.cone, fit.opt.impratio = mujoco.mjtCone.mjCONE_PYRAMIDAL, 1.0
    fit.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
    fit.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    return fit


@dataclass(frozen=True)
class Capacity:
    """Capacity of the buffers, a world."""

    contacts: int
    rows: int
    """Of the constraint matrix."""


def capacity_for(world: World, control: str, control_freq: float) -> Capacity:
    """Buffers for a world, from the most that it needs within a second of standing still on the CPU."""
    fit = replace(world, model=in_single_precision(world.model))
    simulation = Simulation(fit, control, control_freq, sleep=False)
    simulation.reset()
    contacts = rows = 0
    for _ in range(round(control_freq)):
        simulation.step(np.zeros(simulation.controller.size))
        contacts, rows = max(contacts, simulation.data.ncon), max(rows, simulation.data.nefc)
    return Capacity(
        contacts=round(SPARE * contacts) + ROBOT_CONTACTS,
        rows=round(SPARE * rows) + ROBOT_CONTACTS * ROWS_PER_CONTACT,
    )


class BatchedPhysics:
    """Copies of a world under control; between calls positions, velocities and contacts are those of the present state.

    Args:
        world: what every copy starts as.
        worlds: number of copies.
        control: kind of controller.
        control_freq: actions a second [1/s].
        device: Warp's name of it.
        capacity: sizes of the buffers; measured where None.

    Raises:
        EnvironmentSetupError: MuJoCo Warp is not installed or lacks something that the world has; says what.
    """

    def __init__(
        self,
        world: World,
        worlds: int,
        control: str,
        control_freq: float,
        device: str,
        capacity: Capacity | None = None,
    ) -> None:
        self._engine = mujoco_warp()
        self.world = replace(world, model=in_single_precision(world.model))
        model = self.world.model
        self.capacity = capacity_for(world, control, control_freq) if capacity is None else capacity
        single = Simulation(self.world, control, control_freq, sleep=False)
        single.reset()
        home = single.data
        self.substeps, self.period = single.substeps, single.period
        self.worlds, self.device = worlds, device
        with wp.ScopedDevice(device):
            try:
                self._model = self._engine.put_model(model)
                self.data = self._engine.put_data(
                    model, home, nworld=worlds, naconmax=worlds * self.capacity.contacts, njmax=self.capacity.rows
                )
            except (NotImplementedError, ValueError) as error:
                raise EnvironmentSetupError(f"MuJoCo Warp cannot run {world.robot.name} here: {error}") from error
            self.controller = BatchedController(self.world, self.data, control)
            self._arm = np.array([int(model.joint(world.prefix + name).qposadr[0]) for name in world.robot.arm_joints])
            self._home = home.qpos.astype(np.float32)
            count = OWNERS + len(world.scene.objects)
            self._owner = wp.array(world.owner + OWNERS, dtype=int)
            self._finger = wp.array(fingers(world), dtype=int)
            self._touching = wp.zeros((worlds, count, count), dtype=wp.bool)
            self._pinched = wp.zeros((worlds, 2, count), dtype=wp.bool)
            self._peaks = wp.zeros(3, dtype=int)
            self._lost = wp.zeros(worlds, dtype=wp.bool)
            self._graph = self._captured()
        self.reset(np.arange(worlds), np.zeros((worlds, len(self._arm))))
        self.restart()

    def _captured(self) -> Any:
        """A graph of one physics step; None on a CPU."""
        self._substep()
        if not wp.get_device().is_cuda:
            return None
        with wp.ScopedCapture() as capture:
            self._substep()
        return capture.graph

    def _substep(self) -> None:
        self.controller.control()
        self._engine.step2(self._model, self.data)
        self._engine.step1(self._model, self.data)
        self._note_peaks()

    def _note_peaks(self) -> None:
        data = self.data
        wp.launch(
            note_peaks,
            dim=self.worlds,
            inputs=[data.nacon, data.ncollision, data.nefc, data.qpos, self._peaks, self._lost],
        )

    def reset(self, worlds: NDArray[np.int64], noise: NDArray[np.float64]) -> None:
        """Put `worlds` back to the start; `noise` [rad], shape (len(worlds), joints), is added to the arms' posture.

        Their positions are up to date after the next `restart`.
        """
        data = self.data
        position, velocity, warm = data.qpos.numpy(), data.qvel.numpy(), data.qacc_warmstart.numpy()
        time, control, lost = data.time.numpy(), data.ctrl.numpy(), self._lost.numpy()
        position[worlds] = self._home
        position[np.ix_(worlds, self._arm)] += noise
        for array in (velocity, warm, time, control, lost):
            array[worlds] = 0
        for target, values in (
            (data.qpos, position),
            (data.qvel, velocity),
            (data.qacc_warmstart, warm),
            (data.time, time),
            (data.ctrl, control),
            (self._lost, lost),
        ):
            target.assign(values)
        self.controller.reset(worlds, position[np.ix_(worlds, self._arm)].astype(np.float64))

    def restart(self) -> None:
        """Bring positions and contacts of all worlds up to date after `reset`."""
        with wp.ScopedDevice(self.device):
            self._engine.step1(self._model, self.data)
            self._note_peaks()

    def step(self, actions: NDArray[Any]) -> None:
        """One control step of all worlds, with actions of shape (worlds, controller.size).

        Raises:
            EnvironmentSetupError: the buffers were too small; says how large they have to be.
        """
        with wp.ScopedDevice(self.device):
            self.controller.set_action(actions)
            for _ in range(self.substeps):
                if self._graph is None:
                    self._substep()
                else:
                    wp.capture_launch(self._graph)
        self.require_capacity()

    def require_capacity(self) -> None:
        """Raise EnvironmentSetupError where the buffers did not hold all contacts since the start."""
        need = self.peaks
        if need.contacts > self.capacity.contacts or need.rows > self.capacity.rows:
            raise EnvironmentSetupError(
                f"the worlds need a capacity of {need.contacts} contacts and {need.rows} rows each, and have one of "
                f"{self.capacity.contacts} and {self.capacity.rows}; results from here on would be wrong. "
                f"Make the environment with capacity=({2 * need.contacts}, {2 * need.rows})."
            )

    @property
    def peaks(self) -> Capacity:
        """The most that the buffers had to hold so far."""
        contacts, pairs, rows = (int(peak) for peak in self._peaks.numpy())
        return Capacity(contacts=-(-max(contacts, pairs) // self.worlds), rows=rows)

    @property
    def lost(self) -> NDArray[np.bool_]:
        """Worlds whose state is no longer finite, shape (worlds,)."""
        return self._lost.numpy().astype(np.bool_)

    def touches(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Who touches whom, shape (worlds, owners, owners), and what each finger touches, shape (worlds, 2, owners)."""
        data, contact = self.data, self.data.contact
        with wp.ScopedDevice(self.device):
            self._touching.zero_()
            self._pinched.zero_()
            wp.launch(
                note_touches,
                dim=data.naconmax,
                inputs=[
                    data.nacon,
                    contact.geom,
                    contact.dist,
                    contact.efc_address,
                    contact.worldid,
                    self._owner,
                    self._finger,
                    self._touching,
                    self._pinched,
                ],
            )
        return self._touching.numpy().astype(np.bool_), self._pinched.numpy().astype(np.bool_)


def mujoco_warp() -> Any:
    """The engine.

    Raises:
        EnvironmentSetupError: it is not installed; says how to install it.
    """
    try:
        import mujoco_warp
    except ImportError as error:
        raise EnvironmentSetupError(f'{error}; the GPU environments need pip install "pat3d[gpu]".') from error
    return mujoco_warp


def require_still(
    world: World,
    checksum: str,
    control: str,
    control_freq: float,
    device: str,
    capacity: Capacity,
    seconds: float = STILL_SECONDS,
) -> None:
    """Refuse a scene that moves on this device while the robot stands still; known results are not tried again.

    Args:
        world: with the scene.
        checksum: of the scene's files.
        control: kind of controller.
        control_freq: actions a second [1/s].
        device: Warp's name of it.
        capacity: sizes of the buffers.
        seconds: simulated time [s].

    Raises:
        UnsettledSceneError: an object moves by 1 mm or 1 degree; names it and its drift.
    """
    engine = f"mujoco_warp {mujoco_warp().__version__} on {wp.get_device(device).name}"
    about = "\0".join((checksum, engine, f"{seconds:g}", repr((SOLREF, SOLIMP, CCD_TOLERANCE))))
    kept = cache_root() / "settled" / f"{hashlib.sha256(about.encode()).hexdigest()[:32]}-mujoco_warp.json"
    moved = _stored(kept)
    if moved is None:
        moved = drift(BatchedPhysics(world, 1, control, control_freq, device, capacity), seconds)
        store_record(kept, moved)
    wrong = {name: (mm, degrees) for name, (mm, degrees) in moved.items() if mm > MAX_MM or degrees > MAX_DEGREES}
    if wrong:
        what = ", ".join(f'"{name}" by {mm:.3g} mm and {degrees:.3g} degrees' for name, (mm, degrees) in wrong.items())
        raise UnsettledSceneError(
            f"the scene does not stay still in {engine}: within {seconds:g} s it moved {what}. "
            'In double precision it does: gymnasium.make_vec(..., vectorization_mode="async") runs on CPUs.'
        )


def drift(physics: BatchedPhysics, seconds: float) -> dict[str, tuple[float, float]]:
    """How far every object is from where it started after `seconds` of the robot standing still: [mm], [degrees].

    What is no longer finite is infinitely far.
    """
    world = physics.world
    bodies = [world.bodies[name] for name in world.objects]
    place, turn = physics.data.xpos.numpy()[:, bodies], physics.data.xquat.numpy()[:, bodies]
    for _ in range(round(seconds / physics.period)):
        physics.step(np.zeros((physics.worlds, physics.controller.size), dtype=np.float32))
    far = 1e3 * np.linalg.norm(physics.data.xpos.numpy()[:, bodies] - place, axis=2)
    cosine = np.abs(np.sum(physics.data.xquat.numpy()[:, bodies] * turn, axis=2))
    angle = np.degrees(2 * np.arccos(np.clip(cosine, 0.0, 1.0)))
    worst = np.nan_to_num(np.stack([far, angle]), nan=np.inf).max(axis=1)
    return {name: (float(mm), float(degrees)) for name, mm, degrees in zip(world.objects, *worst, strict=True)}


def _stored(path: Any) -> dict[str, Sequence[float]] | None:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    valid = isinstance(found, dict) and all(
        isinstance(value, list) and len(value) == 2 and all(isinstance(number, float) for number in value)
        for value in found.values()
    )
    return found if valid else None
