"""One settling run: worlds, their state, and the phases that bring them to rest; all decisions are per world."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.errors import SimulationError
from pat3d.scene.physics import SETTLING_FRICTION
from pat3d.sim.contact.intersection import intersecting_bodies
from pat3d.sim.failure import Status, diagnose, dump, explain
from pat3d.sim.measures import StepMeasures
from pat3d.sim.model import Model
from pat3d.sim.solvers.newton import Newton, NewtonResult
from pat3d.sim.tape import StepRecord, Tape
from pat3d.sim.terms.potential import Potential
from pat3d.sim.worlds import copy_worlds

STILL_FRAMES = 3
"""Consecutive steps without motion that end the drop."""

EXACT_BELOW = 1e-2
"""Residual over weight under which the polish uses exact Hessians."""

COARSE_RESIDUAL, COARSE_MOVE = 1e-3, 1e-5
"""Unbalanced force over weight, and motion of a step [m], that end the search for equilibrium at the wide barrier."""

SLOW, FAST = 5e-4, 1e-3
"""Motions per step of the polish under which inertia fades and over which it is restored [m]."""

COARSE_SLOW, COARSE_FAST = 4e-3, 1e-2
"""The same at the wide barrier, through which bodies slide centimetres cheaply [m]."""

MOST_INERTIA = 1e8
"""Bound on the inertia that ends an oscillation of the polish, over that of a time step."""


@dataclass(frozen=True, kw_only=True)
class SettleOptions:
    """Settings of a settling run; the defaults suit household scenes."""

    friction: float = SETTLING_FRICTION
    """Coefficient of every contact [-], well below what exports carry."""
    time_step: float = 0.03
    """[s]"""
    max_frames: int = 300
    """Artificial time steps of the drop."""
    max_polish_steps: int = 400
    """Steps of the polish before giving up."""
    d_hat: float = 1.0e-3
    """Barrier activation distance while dropping [m]."""
    final_d_hat: float = 1.5e-5
    """Barrier activation distance at rest [m]; gaps end between a third of it and it."""
    friction_speed: float = 1.0e-3
    """Speed below which friction is not fully mobilised [m/s]."""
    drop_residual: float = 1.0e-3
    """Unbalanced force over weight that ends a step of the drop; gradients need about 1e-9."""
    residual: float = 1.0e-6
    """Unbalanced force of any body at rest over its weight."""
    move: float = 1.0e-8
    """Motion of any vertex in the last step at rest [m]."""


Progress = Callable[[str, int, float], None]
"""Called with the phase, its step number and the largest vertex motion of the step [m]."""


def barrier_stiffness(model: Model) -> NDArray[np.float64]:
    """Barrier stiffness of every world [N], shape (worlds,).

    At 100 times the heaviest body's weight, loads close gaps by a few per cent of d_hat.
    """
    return np.maximum(100.0 * model.weight, 1.0)


class Run:
    """The state of one settling run; every quantity that decides something is kept per world."""

    def __init__(
        self,
        model: Model,
        options: SettleOptions,
        progress: Progress,
        q0: NDArray[np.float64] | None = None,
        tape: Tape | None = None,
    ):
        self.model, self.options, self.progress, self.tape = model, options, progress, tape
        self.potential = Potential(model)
        self.newton = Newton(self.potential)
        self.q = self.newton.q
        self.q.assign(np.ascontiguousarray(model.q0 if q0 is None else q0, dtype=np.float64))
        self.reference = np.zeros(model.worlds, dtype=np.int64)
        self.lag_d_hat = options.d_hat
        if tape is not None:
            tape.states.append(wp.clone(self.q))
        self.frames = self.polish_steps = self.iterations = self.steps = 0
        self.throw = True
        """Whether a world that can never move on raises, or stays where it is."""
        self.halted: dict[int, Status] = {}
        """Worlds that can never move on."""
        self.unconverged = np.zeros(model.worlds, dtype=np.int64)
        """Steps that ended before they met their tolerances, shape (worlds,)."""
        self._frames = [wp.clone(self.q)]
        self.potential.contact.stiffness.assign(barrier_stiffness(model))
        self.potential.friction.coefficient.fill_(options.friction)
        self._sigma: NDArray[np.float64] | None = None
        self._to_anchor = wp.zeros(model.worlds, dtype=int, device=model.device)
        self._last_anchored: NDArray[np.bool_] | None = None
        self._measures = StepMeasures(self.potential, self.q)

    @property
    def trajectory(self) -> NDArray[np.float32]:
        """The states kept so far, shape (frames, bodies, 4, 3)."""
        return np.stack([frame.numpy().astype(np.float32) for frame in self._frames])

    def refuse_intersections(self) -> None:
        """Raise SimulationError unless the present state is finite and free of intersections."""
        wrong = ~np.all(np.isfinite(self.state()), axis=(1, 2))
        if wrong.any():
            raise SimulationError(f'the state of "{self.model.labels[int(np.argmax(wrong))]}" is not finite.')
        pairs = intersecting_bodies(self.model, self.potential.positions(self.q, self.potential._start))
        if len(pairs):
            names = [*self.model.labels, "the ground"]
            listed = "; ".join(
                f'"{names[a]}" and {names[b] if b < 0 else chr(34) + names[b] + chr(34)}' for a, b in pairs[:5]
            )
            raise SimulationError(
                f"{len(pairs)} pairs intersect at the start, where no simulation can begin: {listed}."
            )

    def state(self) -> NDArray[np.float64]:
        """A copy of the present state, shape (bodies, 4, 3)."""
        return self.q.numpy().reshape(-1, 4, 3).copy()

    def set_d_hat(self, d_hat: float) -> None:
        """Change the barrier activation distance [m]."""
        self.potential.contact.d_hat = d_hat
        self.potential.candidates.require(d_hat)

    def step(self, active: NDArray[np.bool_], weight: NDArray[np.float64], **tolerances: Any) -> NewtonResult:
        """One time step with inertia scaled by `weight`, shape (worlds,), from a state whose friction is recorded."""
        potential = self.potential
        wp.copy(potential.inertia.start, self.q)
        sigma = weight / self.options.time_step**2
        if self._sigma is None or not np.array_equal(sigma, self._sigma):
            self._sigma = sigma
            potential.inertia.sigma.assign(sigma)
        result = self.newton.minimise(self.q, active, covered=potential.candidates.built, **tolerances)
        self.iterations += int(result.iterations.max(initial=0))
        self.steps += 1
        self.unconverged += active & ~result.converged
        self._halt(diagnose(self.newton, active, result))
        if self.tape is not None:
            self.tape.states.append(wp.clone(self.q))
            self.tape.steps.append(
                StepRecord(
                    active=active.copy(),
                    sigma=sigma,
                    d_hat=potential.contact.d_hat,
                    lag_d_hat=self.lag_d_hat,
                    epsilon=potential.friction.epsilon,
                    reference=self.reference.copy(),
                )
            )
        return result

    def _halt(self, found: dict[int, Status]) -> None:
        """Stop worlds that can never move on, or raise SimulationError."""
        self.halted |= found
        if not found or not self.throw:
            return
        world, status = next(iter(found.items()))
        step = self.options.time_step
        raise SimulationError(
            f"world {world} cannot go on at step {self.steps} ({self.steps * step:.3f} s): "
            f"{explain(self.newton, world, status)}. "
            f"The last safe state is in {dump(self.model, self.state(), self.steps, step)}."
        )

    def running(self) -> NDArray[np.bool_]:
        """Worlds that can move on, shape (worlds,)."""
        running = np.ones(self.model.worlds, dtype=bool)
        running[list(self.halted)] = False
        return running

    def anchor_friction(self, worlds: NDArray[np.bool_]) -> None:
        """Let the friction displacements of `worlds`, shape (worlds,), count from the present state."""
        self.reference[worlds] = self.steps
        if self._last_anchored is None or not np.array_equal(worlds, self._last_anchored):
            self._last_anchored = worlds.copy()
            self._to_anchor.assign(worlds.astype(np.int32))
        copy_worlds(self.model, self._to_anchor, self.q, self.potential.friction.reference)

    def record_friction(self) -> None:
        """Lag friction at the present state."""
        self.potential.record_friction(self.q)
        self.lag_d_hat = self.potential.contact.d_hat

    def drop(self, frames: int | None = None) -> None:
        """Artificial time steps until nothing moves but slowly, or exactly `frames` of them."""
        options, potential = self.options, self.potential
        potential.friction.epsilon = options.friction_speed * options.time_step
        still, one = np.zeros(self.model.worlds, dtype=np.int64), np.ones(self.model.worlds)
        while self.frames < (options.max_frames if frames is None else frames):
            active = (still < STILL_FRAMES) & self.running() if frames is None else self.running()
            if not active.any():
                return
            self.anchor_friction(active)
            self.record_friction()
            self.step(
                active,
                one,
                move_tolerance=0.1 * options.d_hat,
                residual_tolerance=options.drop_residual,
                exact_below=EXACT_BELOW,
                max_iterations=100,
            )
            move = self._measures.motion()
            self.frames += 1
            self._frames.append(wp.clone(self.q))
            # What still slides goes on with longer steps in the search for equilibrium.
            still = np.where(move < 0.3 * options.d_hat, still + 1, 0)
            self.progress("settling", self.frames, float(move.max()))

    def relax(
        self,
        d_hat: float,
        residual_tolerance: float,
        move_tolerance: float,
        slow: float,
        fast: float,
        among: NDArray[np.bool_] | None = None,
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Converge to static equilibrium at a barrier of d_hat [m]; returns which worlds did, and residuals.

        Worlds that are not `among` those to relax, shape (worlds,), stay where they are and count as if they did not.

        Inertia fades where a step moves less than `slow` [m], and is restored where it moves more than `fast` [m].
        """
        options, potential, worlds = self.options, self.potential, self.model.worlds
        # The first step closes gaps at the new d_hat, held by the friction of the old one.
        self.record_friction()
        self.set_d_hat(d_hat)
        potential.friction.epsilon = epsilon = min(options.friction_speed * options.time_step, d_hat)
        weight = np.ones(worlds)
        moving = self.running() if among is None else self.running() & among
        active, anchored = moving.copy(), np.zeros(worlds, dtype=bool)
        residual = np.full(worlds, np.inf)
        self._measures.forget_last()
        limit = self.polish_steps + options.max_polish_steps
        while self.polish_steps < limit and active.any():
            self.anchor_friction(active & ~anchored)
            self.step(
                active,
                weight,
                move_tolerance=np.inf,
                residual_tolerance=0.1 * residual_tolerance,
                exact_below=EXACT_BELOW,
                max_iterations=60,
            )
            self.polish_steps += 1
            active &= self.running()
            # The next step's friction acts with the normal forces of this state, so rest is judged with them.
            self.record_friction()
            move, now, slip, reverses = self._measures.all()
            residual = np.where(active, now, residual)
            active &= ~(anchored & (residual < residual_tolerance) & (move < move_tolerance))
            # Once motion is as slow as friction's creep, its reference stays put; it follows while real slip goes on.
            anchored = (move < 4.0 * epsilon) & (slip < 20.0 * epsilon)
            # Slow sliding gets longer steps.
            weight = np.where(move < slow, np.maximum(0.5 * weight, 1e-6), np.where(move > fast, 1.0, weight))
            # Friction recorded at either of two states can lead to the other for ever; inertia damps the leap.
            weight = np.where(reverses, np.minimum(16.0 * weight, MOST_INERTIA), weight)
            if move.max() > options.d_hat:
                self._frames.append(wp.clone(self.q))
            self.progress("polishing", self.polish_steps, float(move.max()))
        return moving & ~active & self.running(), residual

    def polish(self) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Find equilibrium at the wide barrier, where sliding is cheap, then at the final one."""
        options = self.options
        self.relax(options.d_hat, COARSE_RESIDUAL, COARSE_MOVE, COARSE_SLOW, COARSE_FAST)
        return self.finish()

    def finish(self, among: NDArray[np.bool_] | None = None) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """The end of the polish, of all worlds or those `among` them, shape (worlds,)."""
        options = self.options
        return self.relax(options.final_d_hat, options.residual, options.move, SLOW, FAST, among)
