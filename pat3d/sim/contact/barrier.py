# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""The clamped-log barrier of IPC, normalised so that its stiffness is a force.

With s = d / d_hat in (0, 1):

    b(d)   = -kappa d_hat (s - 1)^2 ln s                      [J]
    b'(d)  = -kappa (2 (s - 1) ln s + (s - 1)^2 / s)          [N], negative: pushes apart
    b''(d) = -kappa / d_hat (2 ln s + 4 (s - 1) / s - (s - 1)^2 / s^2)   [N/m]

(Li et al. 2020, IPC, Eq. 6, in distance rather than squared distance.) The force depends on s alone,
so shrinking d_hat shrinks every gap by the same factor and keeps all forces.
"""

from __future__ import annotations

import warp as wp


@wp.struct
class Barrier:
    """The barrier's constants on the device."""

    stiffness: wp.array(dtype=wp.float64)
    """kappa [N], shape (worlds,)."""
    d_hat: wp.array(dtype=wp.float64)
    """Activation distance [m], shape (1,)."""


@wp.func
def barrier_value(distance: wp.float64, d_hat: wp.float64, stiffness: wp.float64) -> wp.float64:
    """b(d) [J]; 0 at and beyond d_hat."""
    if distance >= d_hat:
        return wp.float64(0.0)
    s = distance / d_hat
    gap = s - wp.float64(1.0)
    return -stiffness * d_hat * gap * gap * wp.log(s)


@wp.func
def barrier_slope(distance: wp.float64, d_hat: wp.float64, stiffness: wp.float64) -> wp.float64:
    """b'(d) [N]; minus the normal force."""
    if distance >= d_hat:
        return wp.float64(0.0)
    s = distance / d_hat
    gap = s - wp.float64(1.0)
    return -stiffness * (wp.float64(2.0) * gap * wp.log(s) + gap * gap / s)


@wp.func
def barrier_curvature(distance: wp.float64, d_hat: wp.float64, stiffness: wp.float64) -> wp.float64:
    """b''(d) [N/m]; positive."""
    if distance >= d_hat:
        return wp.float64(0.0)
    s = distance / d_hat
    ratio = (s - wp.float64(1.0)) / s
    return -stiffness / d_hat * (wp.float64(2.0) * wp.log(s) + wp.float64(4.0) * ratio - ratio * ratio)
