"""D, how far the vertices of a scene travel until it rests (Table 1 of the paper).

D = 1 / (V l) sum over frames t and vertices j of |v_j(t) - v_j(t-1)|

with V vertices, and l the diagonal of the scene's bounding box. The scene is scaled to l = 2 m and simulated until it
rests, or for 300 frames of 0.03 s. Objects that intersect each other or the ground cannot be started in a simulator
that never lets anything intersect; MuJoCo moves those.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from pat3d.check.metrics.in_mujoco import frames_in_mujoco
from pat3d.check.metrics.subject import Body, Subject, scaled
from pat3d.errors import SimulationError

DIAGONAL = 2.0
"""Of the scene while it is simulated [m]."""
FRAMES = 300
TIME_STEP = 0.03
"""[s]"""
FRICTION = 0.2
"""The paper's, of every contact [-]."""
D_HAT = 1.5e-5
"""Barrier activation distance over the scene's diagonal [-]: delivered scenes rest with gaps of this size, and a wider
barrier would push them apart, which is no fault of theirs."""

EXACT_BELOW = 1e-2
"""Residual over weight under which a step uses exact Hessians."""
STILL_IN_MUJOCO = 1.0e-4
"""Motion of a frame that counts as rest in MuJoCo, whose resting objects tremble by half of it [m]."""
STILL = 3
"""Frames in a row without motion that are rest."""

Trajectory = list[tuple[NDArray[np.float64], NDArray[np.float64]]]
"""Frame by frame, where body-fixed axes are: origins [m], shape (bodies, 3), and columns, shape (bodies, 3, 3), such
that a point of body b with coordinates x is at origin_b + sum_k x_k column_bk."""


@dataclass(frozen=True, kw_only=True)
class Displacement:
    """D of a scene, and how it was found."""

    value: float
    """D [-]; infinite where the simulation exploded."""
    engine: Literal["PAT3D", "MuJoCo"]
    why: str = ""
    """Why MuJoCo was taken."""
    frames: int
    at_rest: bool
    """Whether the scene rested within the 300 frames."""


def displacement(
    subject: Subject, *, device: str = "cpu", tell: Callable[[int], None] = lambda frame: None
) -> Displacement:
    """D of a scene.

    Args:
        subject: the objects where they are delivered.
        device: Warp's name of the device that simulates.
        tell: called with the number of every frame.
    """
    grown = scaled(subject, DIAGONAL / subject.diagonal)
    if all(body.fixed for body in grown.bodies):
        return Displacement(value=0.0, engine="PAT3D", frames=0, at_rest=True)
    try:
        frames, at_rest = _simulated(grown, device, tell)
        return Displacement(
            value=path_length(grown.bodies, frames), engine="PAT3D", frames=len(frames) - 1, at_rest=at_rest
        )
    except SimulationError as error:
        why = str(error)
    frames, at_rest = frames_in_mujoco(
        grown, frames=FRAMES, time_step=TIME_STEP, friction=FRICTION, still=STILL_IN_MUJOCO, tell=tell
    )
    finite = all(np.isfinite(origins).all() for origins, _ in frames)
    value = path_length(grown.bodies, frames) if finite else float("inf")
    return Displacement(value=value, engine="MuJoCo", why=why, frames=len(frames) - 1, at_rest=at_rest)


def path_length(bodies: tuple[Body, ...], frames: Trajectory) -> float:
    """Mean length of the vertices' paths over the diagonal of a scene scaled to DIAGONAL [-]."""
    origins = np.stack([origin for origin, _ in frames])
    columns = np.stack([column for _, column in frames])
    total, count = 0.0, 0
    for b, body in enumerate(bodies):
        local = body.visual.vertices - np.array(body.mass.centre_of_mass)
        count += len(local)
        for start, end in zip(range(len(frames) - 1), range(1, len(frames)), strict=True):
            moved = origins[end, b] - origins[start, b] + local @ (columns[end, b] - columns[start, b])
            total += float(np.linalg.norm(moved, axis=1).sum())
    return total / (count * DIAGONAL)


def _simulated(subject: Subject, device: str, tell: Callable[[int], None]) -> tuple[Trajectory, bool]:
    """Frames of our own simulator, the first of them the start.

    Raises:
        SimulationError: objects intersect at the start, or the simulation cannot go on.
    """
    from threadpoolctl import threadpool_limits

    from pat3d.sim.model import ModelBuilder
    from pat3d.sim.run import Run, SettleOptions

    builder = ModelBuilder()
    for body in subject.bodies:
        builder.add_body(
            body.parts,
            mass=body.mass.mass,
            volume=body.mass.volume,
            centre=np.array(body.mass.centre_of_mass),
            second_moment=body.mass.second_moment,
            pose=body.pose,
            fixed=body.fixed,
            label=body.name,
        )
    for joint in subject.joints:
        (first, second), (there, here) = joint.bodies, joint.points
        builder.add_attachment(first, np.array(there), second, np.array(here))
    d_hat = D_HAT * DIAGONAL
    options = SettleOptions(friction=FRICTION, time_step=TIME_STEP, d_hat=d_hat, final_d_hat=d_hat)
    with threadpool_limits(limits=1, user_api="blas"):
        run = Run(builder.finalize(device), options, lambda *_: None)
        run.refuse_intersections()
        run.set_d_hat(d_hat)
        run.potential.friction.epsilon = d_hat
        return _dropped(run, subject.bodies, d_hat, tell)


def _dropped(run: Any, bodies: tuple[Body, ...], d_hat: float, tell: Callable[[int], None]) -> tuple[Trajectory, bool]:
    """Time steps until three in a row move no body by much, or FRAMES of them.

    Friction counts displacements from the start of the step; held so, a body on a slope creeps by `d_hat` a step for
    ever. Of what moves no faster than that, friction counts from where it stopped.
    """
    local = [body.visual.vertices - np.array(body.mass.centre_of_mass) for body in bodies]
    every, one = np.ones(1, dtype=bool), np.ones(1)
    states, still, creeping = [run.state()], 0, False
    for frame in range(1, FRAMES + 1):
        if not creeping:
            run.anchor_friction(every)
        run.record_friction()
        run.step(
            every, one, move_tolerance=0.1 * d_hat, residual_tolerance=1e-3, exact_below=EXACT_BELOW, max_iterations=100
        )
        states.append(run.state())
        tell(frame)
        change = states[-1] - states[-2]
        moved = max(
            float(np.linalg.norm(one_body[0] + points @ one_body[1:], axis=1).max())
            for one_body, points in zip(change, local, strict=True)
        )
        creeping = moved < 4.0 * d_hat
        still = still + 1 if moved < 0.3 * d_hat else 0
        if still == STILL:
            break
    return [(state[:, 0], state[:, 1:]) for state in states], still == STILL
