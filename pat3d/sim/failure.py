"""What a run does where it cannot go on: it says which bodies hold each other, and keeps the last safe state.

Every accepted state is free of intersections, so the present state is always the best safe one.
"""

from __future__ import annotations

import os
import tempfile
from enum import StrEnum

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.ccd import fractions
from pat3d.sim.model import Model
from pat3d.sim.solvers.line_search import LONGEST_STEP
from pat3d.sim.solvers.newton import Newton, NewtonResult
from pat3d.sim.terms.potential import SKIN

NO_MOTION = 1.0e-12
"""A step that moves no vertex further is none [m]; it is four digits above the rounding of a position."""


class Status(StrEnum):
    """How a world ended."""

    AT_REST = "at rest"
    STILL_MOVING = "still moving"
    """The last step moved further, or left forces more out of balance, than is called rest."""
    BLOCKED = "blocked"
    """Bodies so close to each other that collision detection allows no motion."""
    DEGENERATE = "degenerate"
    """The direction of motion is not finite."""


def diagnose(newton: Newton, active: NDArray[np.bool_], result: NewtonResult) -> dict[int, Status]:
    """Worlds of `active` that can never move on, among those whose minimisation did not converge."""
    failing = np.flatnonzero(active & ~result.converged)
    if not len(failing):
        return {}
    model = newton.model
    direction, step = newton.direction.numpy().reshape(-1, 4, 3), newton.step.numpy()
    # A search that rounding ended was allowed its last trial.
    drowned = result.stalled & (newton.fraction.numpy() >= 1.0)
    found = {}
    for world in failing:
        members = model.world_of == world
        if not np.all(np.isfinite(direction[members])):
            found[int(world)] = Status.DEGENERATE
            continue
        wanted = motion_bound(direction[members], model.body_radius[members])
        if (
            not drowned[world]
            and step[world] * wanted < NO_MOTION <= wanted
            and blocking_pair(newton, int(world))[0] < NO_MOTION
        ):
            found[int(world)] = Status.BLOCKED
    return found


def motion_bound(direction: NDArray[np.float64], radius: NDArray[np.float64]) -> float:
    """Bound on the motion of any vertex along a change of states [m].

    Args:
        direction: changes of states, shape (bodies, 4, 3).
        radius: of the bodies [m], shape (bodies,).
    """
    turn = np.sqrt(np.sum(direction[:, 1:] ** 2, axis=(1, 2)))
    return float(np.max(np.linalg.norm(direction[:, 0], axis=1) + radius * turn, initial=0.0))


def blocking_pair(newton: Newton, world: int) -> tuple[float, tuple[int, int]]:
    """Motion that collision detection allows along the last direction of a world [m], and the bodies that limit it.

    The second body is -1 for the ground; both are -1 where nothing limits the motion.
    """
    model, potential = newton.model, newton.potential
    members = model.world_of == world
    q = newton.q.numpy().reshape(-1, 4, 3)
    direction = np.where(members[:, None, None], newton.direction.numpy().reshape(-1, 4, 3), 0.0)
    bound = motion_bound(direction[members], model.body_radius[members])
    direction *= min(1.0, float(LONGEST_STEP) / max(bound, 1e-300))
    start = potential.positions(newton.q, potential._start)
    trial = wp.array(q + direction, dtype=wp.vec3d, device=model.device)
    end = potential.positions(trial, potential._end)
    # Of its own, so that a run that goes on is not disturbed.
    candidates = Candidates(model)
    candidates.rebuild(start, end, potential.contact.d_hat, SKIN)
    allowed = fractions(model, candidates, start, end)
    body = np.asarray(model.vertex_body.numpy(), dtype=np.int64)
    pairs = np.asarray(candidates.primitives.numpy()[: candidates.count], dtype=np.int64)
    inside = model.world_of[body[pairs[:, 0]]] == world
    length = min(bound, float(LONGEST_STEP))
    if not inside.any():
        return length, (-1, -1)
    at = int(np.argmin(np.where(inside, np.nan_to_num(allowed, nan=0.0), np.inf)))
    vertices = pairs[at]
    others = [int(body[v]) for v in vertices if v >= 0]
    other = next((b for b in others if b != others[0]), -1)
    return float(allowed[at]) * length, (others[0], other)


def dump(model: Model, q: NDArray[np.float64], step: int, time_step: float) -> str:
    """Write a state to a temporary file; returns its path.

    The archive holds q, shape (bodies, 4, 3), labels and world of every body, the number of the step and the time [s].
    """
    descriptor, path = tempfile.mkstemp(prefix="pat3d-", suffix=".npz")
    with os.fdopen(descriptor, "wb") as file:
        np.savez_compressed(
            file, q=q, labels=np.array(model.labels), world=model.world_of, step=step, time=step * time_step
        )
    return path


def explain(newton: Newton, world: int, status: Status) -> str:
    """Why a world can never move on."""
    if status is Status.DEGENERATE:
        return "the direction of motion is not finite"
    motion, bodies = blocking_pair(newton, world)
    first, second = ("the ground" if body < 0 else f'"{newton.model.labels[body]}"' for body in bodies)
    return f"{first} and {second} are so close that only {motion:.1e} m of motion are safe"
