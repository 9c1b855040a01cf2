"""Mass properties that descriptions give: put together, and looked at."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pat3d.assets.library.body import Inertial, Points


def together(parts: Sequence[Inertial]) -> Inertial | None:
    """Of one rigid body made of `parts`; only the mass where one of them has no tensor."""
    if not parts:
        return None
    mass = sum(part.mass for part in parts)
    if any(part.centre is None or part.inertia is None for part in parts):
        return Inertial(mass=mass, centre=parts[0].centre if len(parts) == 1 else None)
    centre = sum((part.mass * part.centre for part in parts if part.centre is not None), np.zeros(3)) / mass
    tensor = np.zeros((3, 3))
    for part in parts:
        if part.centre is not None and part.inertia is not None:
            tensor += part.inertia + part.mass * offset_inertia(part.centre - centre)
    return Inertial(mass=mass, centre=centre, inertia=tensor)


def offset_inertia(offset: Points) -> Points:
    """What a unit mass at `offset` [m] from an axis point adds: |d|^2 E - d d^T."""
    return float(offset @ offset) * np.eye(3) - np.outer(offset, offset)


def fault(given: Inertial, low: Points, high: Points) -> str:
    """Why no matter inside the box from `low` to `high` [m] has these properties; empty where some has."""
    if given.centre is not None:
        room = 0.02 * (high - low).max()
        if (given.centre < low - room).any() or (given.centre > high + room).any():
            return "its centre of mass lies outside the object"
    if given.inertia is None:
        return ""
    moments = np.linalg.eigvalsh((given.inertia + given.inertia.T) / 2)
    if np.abs(given.inertia - given.inertia.T).max() > 1e-6 * np.abs(given.inertia).max() or moments[0] <= 0:
        return "its inertia is not symmetric and positive"
    if moments[2] > (moments[0] + moments[1]) * (1 + 1e-6):
        return "its largest moment of inertia exceeds the sum of the others"
    centre = given.centre if given.centre is not None else (low + high) / 2
    reach = np.maximum(np.abs(high - centre), np.abs(centre - low))
    if moments[2] > given.mass * float(reach @ reach) * (1 + 1e-6):
        return "its inertia is larger than any matter inside its own bounds can have"
    return ""
