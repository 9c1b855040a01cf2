# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""The decisions of a line search in every world at once, a kernel each.

A straight step of an affine map stretches the body at second order of its rotation, which the stiff
orthogonality energy punishes: steps would be limited to about a hundredth of a radian. The search therefore follows a
curve with the same tangent, A(t) = exp(t [w]) (I + t S) A, where [w] and S are the skew and
symmetric parts of dA A^-1. Safety is checked on the straight segment to each point tried.
"""

from __future__ import annotations

import warp as wp

from pat3d.sim.arrays import Bodies, Vertices
from pat3d.sim.kernel_modules import declare_kernels

declare_kernels(__name__, most_records=2)

SUFFICIENT_DECREASE = wp.constant(wp.float64(1.0e-4))
"""Armijo constant."""

LONGEST_STEP = wp.constant(wp.float64(0.03))
"""Motion of a vertex that a first trial may make [m]; the pairs along longer ones are many, and contact shortens
them."""

OUTSIDE = wp.constant(0)
PENDING = wp.constant(1)
RUNNING = wp.constant(2)
UNSOLVED = wp.constant(3)
"""What the first numbers of the status count: whether candidates must be collected anew, worlds that search, worlds
that go on, and worlds whose Hessian was not positive definite. A trial decides nothing while the first or the last is
not zero."""

COUNTS = 4


@wp.kernel
def choose_exact(
    tolerances: wp.array(dtype=wp.float64),
    residual: wp.array(dtype=wp.float64),
    # Out
    exact: wp.array(dtype=int),
):
    """Worlds close to their minimum get the exact Hessian."""
    world = wp.tid()
    exact[world] = int(residual[world] < tolerances[2])


@wp.kernel
def start_search(
    running: wp.array(dtype=int),
    unsolved: wp.array(dtype=int),
    # Out
    pending: wp.array(dtype=int),
    first: wp.array(dtype=int),
    motion: wp.array(dtype=wp.float64),
    slope: wp.array(dtype=wp.float64),
    status: wp.array(dtype=int),
):
    """Every running world searches from the full step; those without a direction are counted."""
    world = wp.tid()
    if running[world] != 0 and unsolved[world] != 0:
        wp.atomic_add(status, UNSOLVED, 1)
    pending[world] = running[world]
    first[world] = 1
    motion[world] = wp.float64(0.0)
    slope[world] = wp.float64(0.0)


@wp.kernel
def slope(
    bodies: Bodies,
    gradient: wp.array2d(dtype=wp.vec3d),
    direction: wp.array2d(dtype=wp.vec3d),
    # Out
    slope: wp.array(dtype=wp.float64),
):
    """Derivative of the energy along the direction [J]."""
    body = wp.tid()
    total = wp.float64(0.0)
    for i in range(4):
        total += wp.dot(gradient[body, i], direction[body, i])
    wp.atomic_add(slope, bodies.world[body], total)


@wp.kernel
def linear_motion(
    vertices: Vertices,
    bodies: Bodies,
    direction: wp.array2d(dtype=wp.vec3d),
    # Out
    motion: wp.array(dtype=wp.float64),
):
    """Largest motion of a vertex along the whole direction, to first order [m]."""
    v = wp.tid()
    body = vertices.body[v]
    move = direction[body, 0]
    for k in range(3):
        move += vertices.rest[v][k] * direction[body, 1 + k]
    wp.atomic_max(motion, bodies.world[body], wp.length(move))


@wp.kernel
def first_step(
    motion: wp.array(dtype=wp.float64),
    # Out
    step: wp.array(dtype=wp.float64),
):
    """The full step, or as much of it as moves no vertex further than LONGEST_STEP."""
    world = wp.tid()
    step[world] = wp.min(wp.float64(1.0), LONGEST_STEP / wp.max(motion[world], wp.float64(1.0e-300)))


@wp.kernel
def clear_status(
    pending: wp.array(dtype=int),
    # Out
    fraction: wp.array(dtype=wp.float64),
    status: wp.array(dtype=int),
):
    """Set the counts to zero and let pending worlds take the whole trial."""
    world = wp.tid()
    fraction[world] = wp.float64(pending[world])
    if world == 0:
        status[OUTSIDE] = 0
        status[PENDING] = 0
        status[RUNNING] = 0


@wp.kernel
def select_safe(
    fraction: wp.array(dtype=wp.float64),
    status: wp.array(dtype=int),
    # Out
    safe: wp.array(dtype=int),
):
    """Worlds whose trial is safe as a whole."""
    world = wp.tid()
    safe[world] = int(status[OUTSIDE] + status[UNSOLVED] == 0 and fraction[world] >= wp.float64(1.0))


@wp.struct
class Search:
    """What a trial is judged by, and what becomes of the search; shape (worlds,) each but for the tolerances."""

    tolerances: wp.array(dtype=wp.float64)
    """Motion of a full step [m], residual, and residual under which progress is judged by it, shape (3,)."""
    unresolved: wp.array(dtype=wp.float64)
    """Decrease of the energy that drowns in its rounding [J]."""
    slope: wp.array(dtype=wp.float64)
    """Derivative of the energy along the direction [J]."""
    motion: wp.array(dtype=wp.float64)
    """Of the trial [m]."""
    fraction: wp.array(dtype=wp.float64)
    """Of the trial that is safe."""
    trial_energy: wp.array(dtype=wp.float64)
    trial_residual: wp.array(dtype=wp.float64)
    first: wp.array(dtype=int)
    """Whether the trial is the first along its direction."""
    step: wp.array(dtype=wp.float64)
    """Multiple of the direction."""
    energy: wp.array(dtype=wp.float64)
    residual: wp.array(dtype=wp.float64)
    iterations: wp.array(dtype=int)
    pending: wp.array(dtype=int)
    """Whether the world still searches."""
    accepted: wp.array(dtype=int)
    """Whether the trial becomes the state."""
    running: wp.array(dtype=int)
    """Whether the world goes on to another iteration."""


@wp.kernel
def decide(
    search: Search,
    # In and out
    status: wp.array(dtype=int),
):
    """Converged, too long, accepted, or halved: what becomes of the trial of every pending world."""
    world = wp.tid()
    search.accepted[world] = 0
    if search.pending[world] != 0 and status[OUTSIDE] + status[UNSOLVED] == 0:
        if (
            search.first[world] != 0
            and search.motion[world] < search.tolerances[0]
            and search.residual[world] < search.tolerances[1]
        ):
            search.running[world] = 0
            search.pending[world] = 0
        else:
            if search.first[world] != 0:
                search.iterations[world] = search.iterations[world] + 1
                search.first[world] = 0
            if search.fraction[world] < wp.float64(1.0):
                search.step[world] = wp.float64(0.95) * search.fraction[world] * search.step[world]
            else:
                limit = search.energy[world] + SUFFICIENT_DECREASE * search.step[world] * search.slope[world]
                downhill = search.trial_energy[world] <= limit
                if not downhill and (
                    search.residual[world] < search.tolerances[2] or -search.slope[world] < search.unresolved[world]
                ):
                    downhill = search.trial_residual[world] < search.residual[world]
                if downhill:
                    search.accepted[world] = 1
                    search.pending[world] = 0
                    search.energy[world] = search.trial_energy[world]
                    search.residual[world] = search.trial_residual[world]
                else:
                    search.step[world] = wp.float64(0.5) * search.step[world]
    if search.pending[world] != 0:
        wp.atomic_add(status, PENDING, 1)
    if search.running[world] != 0:
        wp.atomic_add(status, RUNNING, 1)


@wp.kernel
def accept_bodies(
    bodies: Bodies,
    accepted: wp.array(dtype=int),
    trial: wp.array2d(dtype=wp.vec3d),
    trial_gradient: wp.array2d(dtype=wp.vec3d),
    # Out
    q: wp.array2d(dtype=wp.vec3d),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    """Take over the accepted states and their gradients."""
    body = wp.tid()
    if accepted[bodies.world[body]] != 0:
        for i in range(4):
            q[body, i] = trial[body, i]
            gradient[body, i] = trial_gradient[body, i]


@wp.kernel
def accept_vertices(
    vertices: Vertices,
    bodies: Bodies,
    accepted: wp.array(dtype=int),
    end: wp.array(dtype=wp.vec3d),
    # Out
    start: wp.array(dtype=wp.vec3d),
):
    """Take over the positions of accepted states."""
    v = wp.tid()
    if accepted[bodies.world[vertices.body[v]]] != 0:
        start[v] = end[v]


@wp.kernel
def stall(
    pending: wp.array(dtype=int),
    # Out
    stalled: wp.array(dtype=int),
    running: wp.array(dtype=int),
):
    """Worlds that still search end as stalled."""
    world = wp.tid()
    if pending[world] != 0:
        stalled[world] = 1
        running[world] = 0


@wp.kernel
def along_curve(
    bodies: Bodies,
    pending: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    direction: wp.array2d(dtype=wp.vec3d),
    step: wp.array(dtype=wp.float64),
    # Out
    trial: wp.array2d(dtype=wp.vec3d),
):
    """The state at the present step along the search curve; that of worlds that do not search stays."""
    body = wp.tid()
    if pending[bodies.world[body]] == 0:
        for k in range(4):
            trial[body, k] = q[body, k]
        return
    t = step[bodies.world[body]]
    half = wp.float64(0.5)
    trial[body, 0] = q[body, 0] + t * direction[body, 0]
    a = wp.matrix_from_cols(q[body, 1], q[body, 2], q[body, 3])
    rate = wp.matrix_from_cols(direction[body, 1], direction[body, 2], direction[body, 3]) * wp.inverse(a)
    stretch = half * (rate + wp.transpose(rate))
    w = t * half * wp.vec3d(rate[2, 1] - rate[1, 2], rate[0, 2] - rate[2, 0], rate[1, 0] - rate[0, 1])
    for k in range(3):
        x = q[body, 1 + k]
        y = x + t * (stretch * x)
        # Rodrigues' formula, with the series of its coefficients near zero.
        angle2 = wp.dot(w, w)
        first = wp.float64(1.0) - angle2 / wp.float64(6.0) + angle2 * angle2 / wp.float64(120.0)
        second = half - angle2 / wp.float64(24.0) + angle2 * angle2 / wp.float64(720.0)
        if angle2 > wp.float64(1.0e-4):
            angle = wp.sqrt(angle2)
            first = wp.sin(angle) / angle
            second = (wp.float64(1.0) - wp.cos(angle)) / angle2
        turn = wp.cross(w, y)
        trial[body, 1 + k] = y + first * turn + second * wp.cross(w, turn)
