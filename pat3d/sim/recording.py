"""What a differentiated run keeps of itself, and how the steps in between are run again.

A step is a function of the state it starts from, of the state friction counts displacements from, and of a few
numbers; so any stretch of steps can be repeated from a kept state, on one CPU with the same bits.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.arrays import filled
from pat3d.sim.contact.barrier import Barrier
from pat3d.sim.model import Model
from pat3d.sim.run import Progress, Run, SettleOptions
from pat3d.sim.solvers.newton import NewtonResult
from pat3d.sim.tape import StepRecord, Tape
from pat3d.sim.worlds import copy_worlds

GRADIENT_RESIDUAL = 1.0e-9
"""Unbalanced force over weight to which every step of a differentiated run is converged: the gradient takes it for zero
at the end of a step, and rounding leaves a few 1e-10."""

Call = tuple[NDArray[np.float64], dict[str, Any]]
"""Weight of inertia per world and tolerances with which a step was run."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Recording:
    """A finished run but for its states."""

    model: Model
    options: SettleOptions
    friction: NDArray[np.float64]
    """Coefficient per world [-], shape (worlds,)."""
    kept: NDArray[np.int64]
    """Numbers of the states that were kept: multiples of `every`, and the last."""
    every: int
    steps: list[StepRecord]
    calls: list[Call]
    references: dict[int, wp.array]
    """Friction's reference at the start of kept steps that count from a state that was not kept, on the device."""


class RecordedRun(Run):
    """A run that keeps every so many of its states.

    Args:
        model: the worlds.
        options: settings.
        friction: coefficient per world [-], shape (worlds,).
        every: steps from one kept state to the next.
        q0: initial state, shape (bodies, 4, 3).
        progress: as in `settle`.
    """

    def __init__(
        self,
        model: Model,
        options: SettleOptions,
        friction: NDArray[np.float64],
        every: int,
        q0: NDArray[np.float64],
        progress: Progress = lambda *_: None,
    ):
        self.kept = [0]
        self.every = every
        self.calls: list[Call] = []
        self.references: dict[int, wp.array] = {}
        self.kept_states = Tape()
        super().__init__(model, options, progress, q0, self.kept_states)
        self.coefficient = friction
        self.potential.friction.coefficient.assign(friction)

    def step(self, active: NDArray[np.bool_], weight: NDArray[np.float64], **tolerances: Any) -> NewtonResult:
        """As `Run.step`, but tightly converged; forgets the state that it starts from unless that is to be kept."""
        tolerances["residual_tolerance"] = min(tolerances["residual_tolerance"], GRADIENT_RESIDUAL)
        number = self.steps
        reference = self.reference[active]
        if number % self.every == 0 and np.any((reference != number) & (reference % self.every != 0)):
            self.references[number] = wp.clone(self.potential.friction.reference)
        self.calls.append((weight.copy(), tolerances))
        result = super().step(active, weight, **tolerances)
        if number % self.every:
            del self.kept_states.states[-2], self.kept[-1]
        self.kept.append(number + 1)
        return result

    def recorded(self) -> tuple[Recording, list[wp.array]]:
        """The record so far, and the kept states, shape (bodies, 4), vec3d each."""
        record = Recording(
            model=self.model,
            options=self.options,
            friction=self.coefficient,
            kept=np.array(self.kept),
            every=self.every,
            steps=self.kept_states.steps,
            calls=self.calls,
            references=self.references,
        )
        return record, self.kept_states.states


class Replay:
    """Runs recorded steps again."""

    def __init__(self, record: Recording):
        self.record = record
        model = record.model
        self.run = Run(model, record.options, lambda *_: None, np.zeros((model.bodies, 4, 3)))
        self.run.potential.friction.coefficient.assign(record.friction)
        self.start = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        """State from which the step prepared last starts."""
        self._lag_d_hat = wp.zeros(1, dtype=wp.float64, device=model.device)
        self.lag_barrier = filled(Barrier, stiffness=self.run.potential.contact.stiffness, d_hat=self._lag_d_hat)
        """`Barrier` with which its friction was recorded."""
        self._sigma = np.zeros(0)
        self._reference = wp.zeros_like(self.start)
        self._members = wp.zeros(model.worlds, dtype=int, device=model.device)

    def prepare(self, k: int, start: wp.array, reference: wp.array) -> None:
        """Set everything that step k depends on, friction's record included; the candidates then cover its start.

        Args:
            k: number of the step.
            start: state it starts from, shape (bodies, 4), vec3d.
            reference: state friction displacements count from, shape (bodies, 4), vec3d.
        """
        step, run, potential = self.record.steps[k], self.run, self.run.potential
        potential.friction.epsilon = step.epsilon
        wp.copy(potential.friction.reference, reference)
        wp.copy(potential.inertia.start, start)
        wp.copy(self.start, start)
        if not np.array_equal(step.sigma, self._sigma):
            self._sigma = step.sigma
            potential.inertia.sigma.assign(step.sigma)
        run.set_d_hat(step.lag_d_hat)
        potential.record_friction(self.start)
        self._lag_d_hat.fill_(step.lag_d_hat)
        run.set_d_hat(step.d_hat)

    def stretch(self, first: int, last: int, states: wp.array) -> list[wp.array]:
        """States `first` to `last`, of which the first and the last are kept.

        Args:
            first: number of a kept state.
            last: number of the next one.
            states: all kept states, shape (kept, bodies, 4), vec3d.
        """
        index = first // self.record.every
        inner: list[Any] = [states[index]]
        for k in range(first, last - 1):
            self.prepare(k, inner[-1], self.reference(k, first, inner, states))
            wp.copy(self.run.q, self.start)
            weight, tolerances = self.record.calls[k]
            self.run.step(self.record.steps[k].active, weight, **tolerances)
            inner.append(wp.clone(self.run.q))
        inner.append(states[index + 1])
        return inner

    def reference(self, k: int, first: int, inner: list[wp.array], states: wp.array) -> wp.array:
        """State that the friction of step k counts displacements from, shape (bodies, 4), vec3d.

        Args:
            k: number of the step.
            first: number of the kept state at or before it.
            inner: states from that one on.
            states: all kept states, shape (kept, bodies, 4), vec3d.
        """
        numbers = self.record.steps[k].reference
        distinct = np.unique(numbers)
        for number in distinct:
            source: Any
            if number >= first:
                source = inner[number - first]
            elif number % self.record.every == 0:
                source = states[int(number) // self.record.every]
            elif first in self.record.references:
                source = self.record.references[first]
            else:
                # Only worlds that this step leaves alone.
                source = inner[0]
            if len(distinct) == 1:
                return source
            self._members.assign((numbers == number).astype(np.int32))
            copy_worlds(self.record.model, self._members, source, self._reference)
        return self._reference
