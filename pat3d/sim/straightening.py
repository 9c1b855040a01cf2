"""Bodies that are bent at rest are made stiffer, so that their rigid poses keep the gaps of their affine ones.

A scene takes the rigid pose nearest to each affine state. The two differ by microns where a body is wedged and
presses with many times its weight, and gaps at rest are not much more.
"""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.run import Run
from pat3d.sim.worlds import copy_worlds

BENT = 1.0 / 15.0
"""Distance between a body's affine and rigid surface, over the final d_hat, that asks for more stiffness; gaps end
above a third of it."""

STIFFER, TIMES = 16.0, 3
"""Factor on the stiffness of a world whose bodies are bent, and how often it is applied."""


def bend(run: Run) -> NDArray[np.float64]:
    """Bound on the distance between the affine and the rigid surface of any body [m], shape (worlds,)."""
    model = run.model
    stretch = np.linalg.svd(run.state()[:, 1:], compute_uv=False)
    bound = np.abs(stretch - 1.0).max(axis=1) * model.body_radius
    largest = np.zeros(model.worlds)
    np.maximum.at(largest, model.world_of, np.where(model.is_free, bound, 0.0))
    return largest


def straighten(
    run: Run, at_rest: NDArray[np.bool_], residual: NDArray[np.float64]
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Relax worlds with bent bodies again with stiffer ones; where that finds no rest, the world stays as it was.

    Args:
        run: after its polish.
        at_rest: which worlds are, shape (worlds,).
        residual: of every world, shape (worlds,).

    Returns:
        `at_rest` and `residual` of the states in the end.
    """
    limit = BENT * run.options.final_d_hat
    stiffness = run.potential.orthogonality.stiffness
    worlds = at_rest & (bend(run) > limit)
    # Every world that comes here has a state to fall back on.
    run.throw = False
    for _ in range(TIMES):
        if not worlds.any():
            break
        before = wp.clone(run.q)
        stiffness.assign(np.where(worlds, STIFFER, 1.0) * stiffness.numpy())
        found, now = run.finish(worlds)
        residual = np.where(found, now, residual)
        failed = wp.array((worlds & ~found).astype(np.int32), dtype=int, device=run.model.device)
        copy_worlds(run.model, failed, before, run.q)
        worlds = found & (bend(run) > limit)
    return at_rest, residual
