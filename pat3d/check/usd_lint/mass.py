"""Rules on what bodies weigh: masses and inertias that a solid can have, where every reader looks for them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pat3d.check.usd_lint.file import SINGLE, Faults, LintFile
from pat3d.exporters.usd.openusd import Prim, UsdPhysics
from pat3d.exporters.usd.stage import Body, collider_points, matrix, transformed


def mass(file: LintFile) -> Faults:
    """Masses that are not authored or not positive, and centres of mass outside of what collides."""
    for body in file.moving():
        api = UsdPhysics.MassAPI(body.prim)
        attributes = {
            "mass": api.GetMassAttr(),
            "centerOfMass": api.GetCenterOfMassAttr(),
            "diagonalInertia": api.GetDiagonalInertiaAttr(),
            "principalAxes": api.GetPrincipalAxesAttr(),
        }
        absent = [name for name, attribute in attributes.items() if not attribute.HasAuthoredValue()]
        if absent:
            yield body.prim, f"without authored {', '.join(absent)} every engine makes up its own."
            continue
        weight = attributes["mass"].Get()
        if not (np.isfinite(weight) and weight > 0.0):
            yield body.prim, f"mass {weight:g} kg; it must be positive."
        points = [transformed(points, matrix(prim, file.cache, body.prim)) for prim, points in _shapes(body)]
        if points:
            centre = np.array(attributes["centerOfMass"].Get(), dtype=np.float64)
            spread = np.concatenate(points)
            low, high = spread.min(axis=0), spread.max(axis=0)
            if np.isfinite(spread).all() and not np.all((centre > low) & (centre < high)):
                yield body.prim, f"the centre of mass {tuple(centre.tolist())} is outside its colliders."


def mass_on_collider(file: LintFile) -> Faults:
    """Masses where they contradict the body's."""
    for prim in file.colliders:
        if prim.HasAPI(UsdPhysics.MassAPI) and not prim.HasAPI(UsdPhysics.RigidBodyAPI):
            yield prim, "mass on a collider contradicts that of its body; author it on the body alone."


def inertia(file: LintFile) -> Faults:
    """Moments of inertia that no solid has."""
    for body in file.moving():
        attribute = UsdPhysics.MassAPI(body.prim).GetDiagonalInertiaAttr()
        if not attribute.HasAuthoredValue():
            continue
        moments = np.sort(np.array(attribute.Get(), dtype=np.float64))
        if not (np.isfinite(moments).all() and moments[0] > 0.0):
            yield body.prim, f"principal moments {tuple(moments.tolist())}; all must be positive."
        elif moments[2] > (moments[0] + moments[1]) * (1.0 + SINGLE):
            yield body.prim, f"principal moment {moments[2]:.4g} exceeds the sum of the others, as no solid's can."


def _shapes(body: Body) -> Iterator[tuple[Prim, NDArray[np.float64]]]:
    for prim in body.colliders:
        points = collider_points(prim)
        if points is not None and len(points):
            yield prim, points
