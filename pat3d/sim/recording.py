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

from pat3d.sim.model import Model
from pat3d.sim.settling import Progress, Run, SettleOptions, StepRecord, Tape

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
    references: dict[int, NDArray[np.float64]]
    """Friction's reference at the start of kept steps that count from a state that was not kept."""


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
        self.references: dict[int, NDArray[np.float64]] = {}
        super().__init__(model, options, progress, q0, Tape())
        self.coefficient = friction
        self.potential.friction.coefficient.assign(friction)

    def step(self, active: NDArray[np.bool_], weight: NDArray[np.float64], **tolerances: Any) -> NDArray[np.float64]:
        """As `Run.step`, but tightly converged; forgets the state that it starts from unless that is to be kept."""
        tolerances["residual_tolerance"] = min(tolerances["residual_tolerance"], GRADIENT_RESIDUAL)
        number, tape = self.steps, self.tape
        assert tape is not None
        reference = self.reference[active]
        if number % self.every == 0 and np.any((reference != number) & (reference % self.every != 0)):
            self.references[number] = self.potential.friction.reference.numpy().reshape(-1, 4, 3).copy()
        self.calls.append((weight.copy(), tolerances))
        motion = super().step(active, weight, **tolerances)
        if number % self.every:
            del tape.states[-2], self.kept[-1]
        self.kept.append(number + 1)
        return motion

    def recorded(self) -> tuple[Recording, NDArray[np.float64]]:
        """The record so far, and the kept states, shape (kept, bodies, 4, 3)."""
        assert self.tape is not None
        record = Recording(
            model=self.model, options=self.options, friction=self.coefficient, kept=np.array(self.kept),
            every=self.every, steps=self.tape.steps, calls=self.calls, references=self.references,
        )  # fmt: skip
        return record, np.stack(self.tape.states)


class Replay:
    """Runs recorded steps again."""

    def __init__(self, record: Recording):
        self.record = record
        self.world = record.model.world_of
        start = np.zeros((record.model.bodies, 4, 3))
        self.run = Run(record.model, record.options, lambda *_: None, start)
        self.run.potential.friction.coefficient.assign(record.friction)

    def prepare(self, k: int, start: NDArray[np.float64], reference: NDArray[np.float64]) -> wp.array:
        """Set everything that step k depends on, friction's record included; returns its start on the device.

        Args:
            k: number of the step.
            start: state it starts from, shape (bodies, 4, 3).
            reference: state friction displacements count from, shape (bodies, 4, 3).
        """
        step, run = self.record.steps[k], self.run
        state = wp.array(np.ascontiguousarray(start), dtype=wp.vec3d, device=run.model.device)
        run.potential.friction.epsilon = step.epsilon
        run.potential.friction.reference.assign(reference)
        run.potential.inertia.start.assign(state)
        run.potential.inertia.sigma.assign(step.sigma)
        run.set_reach(step.lag_d_hat)
        run.potential.record_friction(state)
        run.set_reach(step.d_hat)
        return state

    def stretch(self, first: int, last: int, states: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        """States `first` to `last`, of which the first and the last are kept.

        Args:
            first: number of a kept state.
            last: number of the next one.
            states: all kept states, shape (kept, bodies, 4, 3).
        """
        index = first // self.record.every
        inner = [states[index]]
        for k in range(first, last - 1):
            self.run.q.assign(self.prepare(k, inner[-1], self.reference(k, first, inner, states)))
            weight, tolerances = self.record.calls[k]
            self.run.step(self.record.steps[k].active, weight, **tolerances)
            inner.append(self.run.state())
        return [*inner, states[index + 1]]

    def reference(
        self, k: int, first: int, inner: list[NDArray[np.float64]], states: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """State that the friction of step k counts displacements from, shape (bodies, 4, 3).

        Args:
            k: number of the step.
            first: number of the kept state at or before it.
            inner: states from that one on.
            states: all kept states.
        """
        numbers = self.record.steps[k].reference
        result = np.empty_like(inner[0])
        for number in np.unique(numbers):
            if number >= first:
                source = inner[number - first]
            elif number % self.record.every == 0:
                source = states[number // self.record.every]
            elif first in self.record.references:
                source = self.record.references[first]
            else:
                # Only worlds that this step leaves alone.
                source = inner[0]
            members = numbers[self.world] == number
            result[members] = source[members]
        return result
