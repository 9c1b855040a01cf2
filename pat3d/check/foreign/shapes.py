"""What the translators of SDF and USD share: bodies, geoms and hulls added to a MuJoCo specification."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import convex_part
from pat3d.geometry.pose import Pose

DENSITY = 1000.0
"""[kg/m^3] of what has no mass, as SDF and UsdPhysics prescribe."""

MAX_GEOMS = 20_000


def new_spec() -> Any:
    """An empty mujoco.MjSpec."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.compiler.autolimits = True
    return spec


def add_body(spec: Any, name: str, pose: Pose, *, fixed: bool) -> Any:
    """A body of the world, free unless `fixed`."""
    body = spec.worldbody.add_body(name=name, pos=pose.position, quat=pose.quat_wxyz)
    if not fixed:
        body.add_freejoint(name=name)
    return body


def add_geom(body: Any, kind: str, size: tuple[float, ...], pose: Pose, friction: float | None) -> None:
    """A primitive: "box" (half sizes), "sphere", "cylinder" or "capsule" (radius, half length), "plane"."""
    import mujoco

    geom = body.add_geom(
        type=getattr(mujoco.mjtGeom, f"mjGEOM_{kind.upper()}"),
        size=[*size, *([0.0] * (3 - len(size)))],
        pos=pose.position,
        quat=pose.quat_wxyz,
        density=DENSITY,
    )
    if friction is not None:
        geom.friction[0] = friction


def add_hull(spec: Any, body: Any, name: str, points: NDArray[np.float64], pose: Pose, friction: float | None) -> None:
    """The convex hull of `points` [m], shape (n, 3), in the geom's frame."""
    import mujoco

    part = convex_part(points)
    spec.add_mesh(name=name, uservert=part.vertices.reshape(-1), userface=part.faces.reshape(-1))
    geom = body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, pos=pose.position, quat=pose.quat_wxyz, density=DENSITY
    )
    if friction is not None:
        geom.friction[0] = friction


def set_mass(body: Any, mass: float, centre: Pose, inertia: NDArray[np.float64]) -> None:
    """Mass [kg] and inertia tensor [kg m^2] of a body, shape (3, 3), in the axes of `centre`."""
    from pat3d.geometry.rotations import principal_frame

    moments, quat = principal_frame(np.asarray(inertia, dtype=np.float64))
    turned = Pose.from_matrix(centre.rotation @ Pose(quat_wxyz=quat).rotation, np.array(centre.position))  # type: ignore[arg-type]
    body.explicitinertial = True
    body.mass, body.ipos, body.iquat, body.inertia = mass, turned.position, turned.quat_wxyz, moments


def within(outer: Pose, inner: Pose) -> Pose:
    """`inner`, which is given in the frame of `outer`, in the frame that `outer` is given in."""
    return Pose.from_matrix(outer.rotation @ inner.rotation, outer.apply(np.array([inner.position]))[0])
