"""Torques of the operational-space controller in one compiled function (Khatib 1987).

    w = kp (x* - x, e(R*, R)) - kd J q'                 what the hand should do: accelerations along and about x, y, z
    p = k (q0 - q) - 2 sqrt(k) q'                       what the joints should do beside that
    torque = J^T (J M^-1 J^T)^-1 (w - J p) + M p + bias

The inverse puts the position first: of the turn it takes what is left, so that arms of fewer than six joints and
stretched ones bring their hand to its place and turn it as far as they can. With blocks A, B, C of J M^-1 J^T:

    S = C - B^T A^-1 B                                  mobility about x, y, z when the place is held
    t = S^-1 (w_r - B^T A^-1 w_x),   f = A^-1 (w_x - B t)

robosuite's controller ("uncoupled") takes A and C as if the other did not exist. Its hand then hardly answers to some
mixtures of errors where the wrist is light: 40 times slower on an IIWA with its 2F-85. It is kept for robosuite's arms,
with which it agrees to rounding (`tests/envs/test_controllers.py`); where an arm is so stretched that a matrix has no
inverse, robosuite's own code is asked instead.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.compiled import compiled

Array = NDArray[np.float64]

POSTURE_STIFFNESS = 10.0
"""k above [1/s^2], robosuite's: draws the arm to its first posture as far as that does not move the hand."""

SINGULAR = 1e-13
"""Pivots below this share of the largest entry on the diagonal: no inverse."""

STRETCHED = 1e-3
"""Directions in which the hand moves this much less easily than in others [-] are left to themselves by and by."""


class OperationalSpace:
    """The torques for one arm of one simulation; reads MuJoCo's arrays where they are.

    Args:
        model: a MuJoCo model.
        data: its data; positions and velocities must be up to date when torques are asked for.
        joints: of the arm, hinges one after the other, from the base to the hand.
        site: that is controlled.
        actuators: of the joints, in the same order.
        limits: least and largest torque of every actuator [N m], shape (2, joints).
        bias: torques that are added, shape (degrees of freedom,), read at every call; MuJoCo's where None.
        uncoupled: as robosuite does it.
    """

    def __init__(
        self,
        model: Any,
        data: Any,
        joints: list[int],
        site: int,
        actuators: NDArray[np.int64],
        limits: Array,
        bias: Array | None = None,
        uncoupled: bool = True,
    ) -> None:
        numbers = np.array(joints, dtype=np.int64)
        self._fixed = (
            data.site_xpos[site],
            data.site_xmat[site],
            data.xanchor,
            data.xaxis,
            numbers,
            data.qpos,
            model.jnt_qposadr[numbers].astype(np.int64),
            data.qvel,
            model.jnt_dofadr[numbers].astype(np.int64),
            data.qfrc_bias if bias is None else bias,
            data.M,
            model.M_rowadr.astype(np.int64),
            model.M_rownnz.astype(np.int64),
            model.M_colind.astype(np.int64),
            data.ctrl,
            np.asarray(actuators, dtype=np.int64),
            np.ascontiguousarray(limits),
            uncoupled,
        )
        # Compiled here, so that no step waits for it.
        before, nothing = data.ctrl.copy(), np.zeros(6)
        self.apply(np.zeros(3), np.eye(3), nothing, nothing, np.zeros(len(joints)))
        data.ctrl[:] = before

    def apply(self, position: Array, rotation: Array, kp: Array, kd: Array, posture: Array) -> bool:
        """Write the torques that draw the site to a pose into the controls.

        Args:
            position: of the goal [m] in the world, shape (3,).
            rotation: of the goal, shape (3, 3).
            kp: stiffness along and about x, y, z [1/s^2], shape (6,).
            kd: damping [1/s], shape (6,).
            posture: joint positions [rad] that the arm is drawn to, shape (joints,).

        Returns:
            False where an uncoupled controller's arm is in a singular posture; nothing was written then.
        """
        return _apply(position, rotation, kp, kd, posture, *self._fixed)


@compiled
def _cholesky(a: Array) -> bool:
    """The lower triangle of `a`, shape (n, n), becomes its factor; False where it has none."""
    n = a.shape[0]
    largest = 0.0
    for i in range(n):
        largest = max(largest, a[i, i])
    for j in range(n):
        for k in range(j):
            a[j, j] -= a[j, k] * a[j, k]
        if not a[j, j] > SINGULAR * largest:
            return False
        a[j, j] = math.sqrt(a[j, j])
        for i in range(j + 1, n):
            for k in range(j):
                a[i, j] -= a[i, k] * a[j, k]
            a[i, j] /= a[j, j]
    return True


@compiled
def _solve(factor: Array, b: Array) -> None:
    """`b`, shape (n,), becomes the solution of factor factor^T x = b."""
    n = b.shape[0]
    for i in range(n):
        for k in range(i):
            b[i] -= factor[i, k] * b[k]
        b[i] /= factor[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= factor[k, i] * b[k]
        b[i] /= factor[i, i]


@compiled
def _place_first(mobility: Array, wrench: Array) -> None:
    """Accelerations `wrench` of the hand, shape (6,), become the forces and torques that cause them (see above)."""
    along, about, across = mobility[:3, :3].copy(), mobility[3:, 3:].copy(), np.zeros((3, 3))
    _factor_stretched(along)
    # A^-1 B, column by column; then the Schur complement.
    for c in range(3):
        column = mobility[:3, 3 + c].copy()
        _solve(along, column)
        across[:, c] = column
    for c in range(3):
        for d in range(3):
            for k in range(3):
                about[c, d] -= mobility[3 + c, k] * across[k, d]
    _factor_stretched(about)
    for c in range(3):
        for k in range(3):
            wrench[3 + c] -= across[k, c] * wrench[k]
    _solve(about, wrench[3:])
    _solve(along, wrench[:3])
    for c in range(3):
        for k in range(3):
            wrench[c] -= across[c, k] * wrench[3 + k]


@compiled
def _factor_stretched(a: Array) -> None:
    """The lower triangle of `a`, shape (3, 3), becomes the factor of a + STRETCHED trace(a) / 3."""
    more = STRETCHED * (a[0, 0] + a[1, 1] + a[2, 2]) / 3.0
    for c in range(3):
        a[c, c] += more
    _cholesky(a)


@compiled
def _apply(
    # Goal
    position, rotation, kp, kd, posture,
    # State
    x, r, anchors, axes, joints, qpos, positions, qvel, dofs, bias, mass, mass_row, mass_count, mass_column,
    # Out
    ctrl, actuators, limits, uncoupled,
):  # fmt: skip
    n = joints.shape[0]
    first = dofs[0]
    inertia, jacobian = np.zeros((n, n)), np.zeros((6, n))
    for i in range(n):
        row = mass_row[dofs[i]]
        for k in range(row, row + mass_count[dofs[i]]):
            j = mass_column[k] - first
            if 0 <= j < n:
                inertia[i, j] = inertia[j, i] = mass[k]
        axis, arm = axes[joints[i]], x - anchors[joints[i]]
        for c in range(3):
            d, e = (c + 1) % 3, (c + 2) % 3
            jacobian[c, i] = axis[d] * arm[e] - axis[e] * arm[d]
            jacobian[3 + c, i] = axis[c]

    # What the hand should do: half the sum of the cross products of its axes with those of the goal is its turn.
    velocity, wrench = np.zeros(6), np.zeros(6)
    for c in range(6):
        for i in range(n):
            velocity[c] += jacobian[c, i] * qvel[dofs[i]]
    for c in range(3):
        d, e = (c + 1) % 3, (c + 2) % 3
        turn = 0.0
        for column in range(3):
            turn += 0.5 * (r[3 * d + column] * rotation[e, column] - r[3 * e + column] * rotation[d, column])
        wrench[c] = kp[c] * (position[c] - x[c]) - kd[c] * velocity[c]
        wrench[3 + c] = kp[3 + c] * turn - kd[3 + c] * velocity[3 + c]

    # Mobility of the hand: J M^-1 J^T.
    factor = inertia.copy()
    if not _cholesky(factor):
        return False
    mobility = np.zeros((6, 6))
    for c in range(6):
        column = jacobian[c].copy()
        _solve(factor, column)
        for d in range(6):
            for i in range(n):
                mobility[d, c] += jacobian[d, i] * column[i]
    wanted, moving = np.zeros(n), np.zeros(6)
    for i in range(n):
        off = posture[i] - qpos[positions[i]]
        wanted[i] = POSTURE_STIFFNESS * off - 2.0 * math.sqrt(POSTURE_STIFFNESS) * qvel[dofs[i]]
    for c in range(6):
        for i in range(n):
            moving[c] += jacobian[c, i] * wanted[i]
    if uncoupled:
        along, about = mobility[:3, :3].copy(), mobility[3:, 3:].copy()
        if not (_cholesky(along) and _cholesky(about) and _cholesky(mobility)):
            return False
        _solve(along, wrench[:3])
        _solve(about, wrench[3:])
        _solve(mobility, moving)
        for c in range(6):
            wrench[c] -= moving[c]
    else:
        for c in range(6):
            wrench[c] -= moving[c]
        _place_first(mobility, wrench)

    for i in range(n):
        torque = bias[dofs[i]]
        for c in range(6):
            torque += jacobian[c, i] * wrench[c]
        for j in range(n):
            torque += inertia[i, j] * wanted[j]
        ctrl[actuators[i]] = min(max(torque, limits[0, i]), limits[1, i])
    return True
