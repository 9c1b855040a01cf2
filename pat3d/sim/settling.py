"""Settling: from an intersection-free layout to static equilibrium.

Three phases (DESIGN section 5a): bodies drop through artificial time steps until they stop; the barrier shrinks until
gaps are a few hundredths of a millimetre; and a polish holds friction's reference state fixed while the inertia term
fades, which ends at static equilibrium instead of creeping for ever. Worlds whose bodies are bent then are polished
again with stiffer ones (`pat3d.sim.straightening`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from pat3d.errors import SimulationError
from pat3d.sim.failure import Status, dump
from pat3d.sim.model import Model
from pat3d.sim.run import Progress, Run, SettleOptions
from pat3d.sim.straightening import straighten


@dataclass(frozen=True, kw_only=True, eq=False)
class Settled:
    """How settling ended."""

    q: NDArray[np.float64]
    """Final state, shape (bodies, 4, 3)."""
    trajectory: NDArray[np.float32]
    """State after every step of the drop, and of the polish where bodies still slid; shape (frames, bodies, 4, 3)."""
    at_rest: NDArray[np.bool_]
    """Whether every world met the tolerances, shape (worlds,)."""
    residual: NDArray[np.float64]
    """Equilibrium residual: largest unbalanced force over weight, shape (worlds,)."""
    frames: int
    """Steps of the drop."""
    polish_steps: int
    newton_iterations: int
    """Of all steps; of the slowest world in each."""
    status: tuple[Status, ...]
    """How every world ended."""
    unconverged: NDArray[np.int64]
    """Steps of every world that ended before they met their tolerances, shape (worlds,); each ends at a safe state from
    which the next goes on."""


class UnsettledError(SimulationError):
    """Not every world came to rest."""

    def __init__(self, message: str, settled: Settled, path: str):
        super().__init__(message)
        self.settled = settled
        """Its `q` is free of intersections."""
        self.path = path
        """An .npz archive of the state."""


def settle(
    model: Model,
    options: SettleOptions | None = None,
    progress: Progress = lambda *_: None,
    *,
    throw: bool = True,
    near_rest: bool = False,
    watch: Callable[[Run], None] = lambda _: None,
) -> Settled:
    """Let the bodies of every world of `model` come to rest from its initial state.

    Args:
        model: the worlds.
        options: settings.
        progress: called with the phase, step number and largest motion [m].
        throw: whether worlds that do not come to rest raise; else their `status` tells, and their state is safe.
        near_rest: the bodies touch as they did when they last settled; only the end of the polish is done, in which
            they move by micrometres where loads have not changed.
        watch: called once before the first step, with the run whose state can be read whenever `progress` is called.

    Raises:
        SimulationError: bodies intersect at the start, or a world can never move on.
        UnsettledError: a world is still moving in the end; it holds what was found.
    """
    options = options or SettleOptions()
    # Factorisations of a few hundred unknowns lose more to the threads of BLAS than they gain.
    with threadpool_limits(limits=1, user_api="blas"):
        run = Run(model, options, progress)
        run.throw = throw
        watch(run)
        run.refuse_intersections()
        run.set_d_hat(options.final_d_hat if near_rest else options.d_hat)
        if not near_rest:
            run.drop()
        at_rest, residual = straighten(run, *(run.finish() if near_rest else run.polish()))
    settled = Settled(
        q=run.state(),
        trajectory=run.trajectory,
        at_rest=at_rest,
        residual=residual,
        frames=run.frames,
        polish_steps=run.polish_steps,
        newton_iterations=run.iterations,
        status=tuple(
            Status.AT_REST if rests else run.halted.get(world, Status.STILL_MOVING)
            for world, rests in enumerate(at_rest)
        ),
        unconverged=run.unconverged,
    )
    if throw and not at_rest.all():
        world = int(np.argmin(at_rest))
        path = dump(model, settled.q, run.steps, options.time_step)
        raise UnsettledError(
            f"{np.sum(~at_rest)} of {model.worlds} worlds did not come to rest in {run.steps} steps; world {world} is "
            f"{settled.status[world]} with {residual[world]:.1e} of the weight out of balance, {options.residual:.1e} "
            f"is rest. The last safe state is in {path}. Valid: more max_frames or max_polish_steps, or throw=False.",
            settled,
            path,
        )
    return settled
