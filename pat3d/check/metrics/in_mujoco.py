"""Objects that may intersect, moved by MuJoCo: what an intersection-free simulator cannot start with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.decompose import decompose
from pat3d.check.foreign.shapes import add_body, add_geom, add_hull, new_spec, set_mass
from pat3d.check.metrics.subject import Body, Subject
from pat3d.errors import AssetError, CheckError
from pat3d.geometry.pose import Pose

SOLREF, SOLIMP = (0.004, 1.0), (0.99, 0.999, 1e-4)
"""Contacts as stiff as two time steps allow, those of our exports."""
STEPS = 15
"""Of the engine for every frame: 2 ms each."""
STILL_FRAMES = 3


def frames_in_mujoco(
    subject: Subject,
    *,
    frames: int,
    time_step: float,
    friction: float,
    still: float,
    tell: Callable[[int], None] = lambda frame: None,
) -> tuple[list[tuple[NDArray[np.float64], NDArray[np.float64]]], bool]:
    """Simulate until three frames in a row move no vertex by `still` [m], or for `frames` frames.

    Args:
        subject: the objects; surfaces that are not convex are cut into convex parts first.
        frames: most frames.
        time_step: of a frame [s].
        friction: of every contact [-].
        still: motion of a frame that counts as rest [m].
        tell: called with the number of every frame.

    Returns:
        For every frame, the start among them, centres of mass [m], shape (bodies, 3), and the axes of the bodies as
        rows, shape (bodies, 3, 3); infinite centres after an explosion. And whether the scene rested.

    Raises:
        CheckError: MuJoCo refuses the objects.
    """
    import mujoco

    spec = new_spec()
    spec.option.timestep = time_step / STEPS
    spec.memory = 1 << 28
    add_geom(spec.worldbody, "plane", (0.0, 0.0, 1.0), Pose(), friction)
    for number, body in enumerate(subject.bodies):
        made = add_body(spec, f"body {number}", body.pose, fixed=body.fixed)
        for part, points in enumerate(_hulls(body)):
            add_hull(spec, made, f"part {number}.{part}", points, Pose(), friction)
        centre = Pose(position=body.mass.centre_of_mass)
        set_mass(made, body.mass.mass, centre, np.array(body.mass.inertia))
    for joint in subject.joints:
        held = spec.add_equality(type=mujoco.mjtEq.mjEQ_CONNECT, objtype=mujoco.mjtObj.mjOBJ_BODY)
        held.name1, held.name2 = (f"body {number}" for number in joint.bodies)
        held.data[:3] = joint.points[0]
    # MuJoCo's own contacts are so soft that what falls sinks in by millimetres and trembles for ever.
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.impratio = 10.0
    for geom in spec.geoms:
        geom.solref[:2], geom.solimp[:3] = SOLREF, SOLIMP
    try:
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise CheckError(f"MuJoCo {mujoco.__version__} refuses the objects: {error}") from error
    numbers = [model.body(f"body {number}").id for number in range(len(subject.bodies))]
    local = [body.visual.vertices - np.array(body.mass.centre_of_mass) for body in subject.bodies]
    before = mujoco.get_mju_user_warning()
    # Without a handler MuJoCo appends its warnings to a log file in the working directory.
    mujoco.set_mju_user_warning(lambda text: None)
    try:
        return _run(mujoco, model, numbers, local, frames, still, tell)
    finally:
        mujoco.set_mju_user_warning(before)


def _run(
    mujoco: Any,
    model: Any,
    numbers: list[int],
    local: list[NDArray[np.float64]],
    frames: int,
    still: float,
    tell: Callable[[int], None],
) -> tuple[list[tuple[NDArray[np.float64], NDArray[np.float64]]], bool]:
    data = mujoco.MjData(model)

    def state() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        rotations = data.xmat[numbers].reshape(-1, 3, 3)
        return data.xipos[numbers].copy(), np.swapaxes(rotations, 1, 2).copy()

    found, rested = [state()], 0
    for frame in range(1, frames + 1):
        try:
            mujoco.mj_step(model, data, nstep=STEPS)
        except mujoco.FatalError:
            found.append((np.full_like(found[0][0], np.inf), found[-1][1]))
            return found, False
        if data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number or not np.isfinite(data.qpos).all():
            found.append((np.full_like(found[0][0], np.inf), found[-1][1]))
            return found, False
        found.append(state())
        tell(frame)
        shift, turn = (now - before for now, before in zip(found[-1], found[-2], strict=True))
        moved = max(float(np.linalg.norm(shift[b] + points @ turn[b], axis=1).max()) for b, points in enumerate(local))
        rested = rested + 1 if moved < still else 0
        if rested == STILL_FRAMES:
            return found, True
    return found, False


def _hulls(body: Body) -> list[NDArray[np.float64]]:
    """Points of convex pieces of what collides; the convex hull where it cannot be cut."""
    if body.convex:
        return [part.vertices for part in body.parts]
    try:
        return [points for part in body.parts for points in decompose(part.vertices, part.faces, threshold=0.1).parts]
    except AssetError:
        return [part.vertices for part in body.parts]
