"""Mass properties of a closed triangle mesh, exact for the polyhedron.

The integrals of 1, x and x x^T over the solid are sums over the signed tetrahedra that each
triangle spans with the origin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import AssetError


@dataclass(frozen=True, kw_only=True)
class MassProperties:
    """Mass and its first two moments, in the asset frame."""

    mass: float
    """[kg]"""
    volume: float
    """[m^3]"""
    centre_of_mass: tuple[float, float, float]
    """[m]"""
    inertia: tuple[tuple[float, float, float], ...]
    """Inertia tensor [kg m^2] about the centre of mass, 3 x 3."""

    @property
    def second_moment(self) -> NDArray[np.float64]:
        """Integral of rho x x^T about the centre of mass [kg m^2], shape (3, 3): tr(I)/2 E - I."""
        inertia = np.array(self.inertia)
        return 0.5 * np.trace(inertia) * np.eye(3) - inertia


def mass_properties(
    vertices: NDArray[np.float64], faces: NDArray[np.int32], *, density: float | None = None, mass: float | None = None
) -> MassProperties:
    """Mass properties of the solid bounded by a closed mesh, of uniform density.

    Args:
        vertices: [m], shape (vertices, 3).
        faces: counter-clockwise from outside, shape (faces, 3).
        density: [kg/m^3]; give this or `mass`.
        mass: [kg], spread uniformly over the enclosed volume; it wins over `density`.

    Raises:
        AssetError: the enclosed volume is not positive (open, flat or inside-out mesh).
    """
    # Integrate about a point of the mesh: far from the origin the signed volumes cancel badly.
    reference = vertices.mean(axis=0)
    corners = (vertices - reference)[faces]
    determinant = np.einsum("fi,fi->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    volume = determinant.sum() / 6.0
    if not np.isfinite(volume) or volume <= 0.0:
        raise AssetError(f"the mesh encloses a volume of {volume:.3g} m^3; it must be closed and face outwards.")
    total = corners.sum(axis=1)
    centre = (determinant[:, None] * total).sum(axis=0) / (24.0 * volume)
    # Integral of x x^T over a tetrahedron (0, a, b, c): det/120 (s s^T + aa^T + bb^T + cc^T).
    moment = np.einsum("f,fi,fj->ij", determinant, total, total)
    moment += np.einsum("f,fki,fkj->ij", determinant, corners, corners)
    moment = moment / 120.0 - volume * np.outer(centre, centre)
    if mass is None and density is None:
        raise AssetError("give the density or the mass.")
    total_mass = float(mass if mass is not None else (density or 0.0) * volume)
    moment *= total_mass / volume
    inertia = np.trace(moment) * np.eye(3) - moment
    return MassProperties(
        mass=total_mass,
        volume=float(volume),
        centre_of_mass=tuple(map(float, centre + reference)),  # type: ignore[arg-type]
        inertia=tuple(tuple(map(float, row)) for row in inertia),  # type: ignore[arg-type]
    )
