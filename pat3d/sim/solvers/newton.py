# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Projected Newton with a line search that never lets an accepted state intersect.

A straight step of an affine map stretches the body at second order of its rotation, which the stiff
orthogonality energy punishes: steps would be limited to about a hundredth of a radian. The search therefore follows a
curve with the same tangent, A(t) = exp(t [w]) (I + t S) A, where [w] and S are the skew and
symmetric parts of dA A^-1. Safety is checked on the straight segment to each point tried.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.contact.ccd import safe_step
from pat3d.sim.model import Model
from pat3d.sim.potential import SKIN, Potential
from pat3d.sim.program import Mirror, Program
from pat3d.sim.solvers.linear import DenseSolver

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

BACKTRACKS = 60
SUFFICIENT_DECREASE = wp.constant(wp.float64(1.0e-4))
"""Armijo constant."""

UNRESOLVED = 1.0e-14
"""Decreases below the heaviest body's weight over this height [m] drown in the energy's rounding."""

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


@dataclass(frozen=True, kw_only=True, eq=False)
class NewtonResult:
    """How the minimisation of every world ended."""

    converged: NDArray[np.bool_]
    """shape (worlds,)."""
    stalled: NDArray[np.bool_]
    """Worlds in which no step along the direction was both safe and downhill, shape (worlds,)."""
    iterations: NDArray[np.int64]
    """shape (worlds,)."""


class Newton:
    """Minimises a potential in place, all active worlds at once.

    Every world has its own step, convergence and kind of Hessian. All of it is decided on the device; the host reads
    one array of counts a trial step.
    """

    def __init__(self, potential: Potential):
        self.potential = potential
        self.model: Model = potential.model
        model, device = self.model, self.model.device
        self.solver = DenseSolver(model)
        self.q = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=device)
        """Present state, shape (bodies, 4), vec3d."""
        self._trial = wp.zeros_like(self.q)
        self._direction = wp.zeros_like(self.q)
        self._gradient, self._trial_gradient = wp.zeros_like(self.q), wp.zeros_like(self.q)
        self._start = wp.zeros(len(model.vertex_rest), dtype=wp.vec3d, device=device)
        self._end = wp.zeros_like(self._start)
        self._hessian = potential._hessian

        def number() -> wp.array:
            return wp.zeros(model.worlds, dtype=wp.float64, device=device)

        def flag() -> wp.array:
            return wp.zeros(model.worlds, dtype=int, device=device)

        self._energy, self._trial_energy = number(), number()
        self._residual, self._trial_residual = number(), number()
        self._slope, self._step, self._motion, self._fraction = number(), number(), number(), number()
        self._exact, self._pending, self._safe, self._accepted, self._first = flag(), flag(), flag(), flag(), flag()
        self._status = wp.zeros(COUNTS + 3 * model.worlds, dtype=int, device=device)
        self._running, self._iterations, self._stalled = (
            self._status[COUNTS + k * model.worlds : COUNTS + (k + 1) * model.worlds] for k in range(3)
        )
        self._mirror = Mirror(self._status)
        self._active = flag()
        self._tolerances = wp.zeros(3, dtype=wp.float64, device=device)
        self._unresolved = wp.array(UNRESOLVED * model.weight, dtype=wp.float64, device=device)
        self._settings: tuple | None = None
        self._programs = {
            launches: Program(device, launches, torch=self.solver.torch if launches == self._iterate else None)
            for launches in (self._begin, self._assemble, self._first_try, self._iterate, self._try, self._give_up)
        }

    @property
    def direction(self) -> wp.array:
        """Direction searched last, shape (bodies, 4), vec3d."""
        return self._direction

    @property
    def step(self) -> wp.array:
        """Multiple of the direction tried last, shape (worlds,), float64."""
        return self._step

    def minimise(
        self,
        q: wp.array,
        active: NDArray[np.bool_],
        *,
        move_tolerance: float,
        residual_tolerance: float = np.inf,
        exact_below: float = 0.0,
        max_iterations: int = 200,
        covered: bool = False,
    ) -> NewtonResult:
        """Minimise the potential of the active worlds.

        Args:
            q: state, shape (bodies, 4), vec3d; on return the minimisers.
            active: worlds to minimise, shape (worlds,).
            move_tolerance: converged when a full step moves no vertex further than this [m] ...
            residual_tolerance: ... and no body's unbalanced force exceeds this fraction of its weight.
            exact_below: residual under which the Hessian is exact and progress is judged by the residual, because
                energy differences vanish in rounding there.
            max_iterations: per world.
            covered: whether the candidates of the potential are known to cover q.
        """
        if q is not self.q:
            wp.copy(self.q, q)
        settings = (move_tolerance, residual_tolerance, exact_below, active.tobytes())
        if settings != self._settings:
            self._settings = settings
            self._tolerances.assign(np.array(settings[:3]))
            self._active.assign(active.astype(np.int32))
        if not covered:
            self.potential.cover(self.q)
        self._run(self._begin)
        status, running = self._mirror.read(), active
        for _ in range(max_iterations):
            if not running.any():
                break
            if self.solver.on_gpu and self.model.worlds == 1:
                self._run(self._iterate)
            else:
                self._run(self._assemble)
                self.solver.factorise_and_solve(self._hessian, running)
                self._run(self._first_try)
            status = self._search()
            running = self._worlds(status, 0) != 0
        if q is not self.q:
            wp.copy(q, self.q)
        stalled = self._worlds(status, 2) != 0
        return NewtonResult(
            converged=active & ~running & ~stalled,
            stalled=stalled,
            iterations=self._worlds(status, 1).astype(np.int64),
        )

    def _worlds(self, status: NDArray[np.int32], row: int) -> NDArray[np.int32]:
        first = COUNTS + row * self.model.worlds
        return status[first : first + self.model.worlds]

    def _run(self, launches: Callable[[], None]) -> None:
        self._programs[launches].run((self.potential.candidates.capacity, self.potential.friction.capacity))

    def _search(self) -> NDArray[np.int32]:
        """Backtrack until every running world decreases; returns the status."""
        for _ in range(BACKTRACKS):
            status = self._mirror.read()
            if status[int(UNSOLVED)]:
                self.solver.turn_eigenvalues(self._hessian)
                self._run(self._first_try)
                continue
            if status[int(OUTSIDE)]:
                self.potential.candidates.rebuild(self._start, self._end, self.potential.contact.d_hat, SKIN)
            elif not status[int(PENDING)]:
                return status
            self._run(self._try)
        self._run(self._give_up)
        return self._mirror.read()

    def _begin(self) -> None:
        """Energy, gradient and residual at the first state."""
        potential = self.potential
        self._status.zero_()
        wp.copy(self._running, self._active)
        self._direction.zero_()
        potential.positions(self.q, self._start)
        potential.evaluate(self.q, self._start, self._running, self._energy, self._gradient)
        potential.measure_residual(self._gradient, self._residual)
        self._mirror.fetch()

    def _assemble(self) -> None:
        """The Newton system of every running world."""
        wp.launch(
            _choose_exact, dim=self.model.worlds, device=self.model.device,
            inputs=[self._tolerances, self._residual], outputs=[self._exact],
        )  # fmt: skip
        self.potential.assemble(self.q, self._start, self._exact, self._running, self._hessian)
        self.solver.set_right_side(self._hessian, self._gradient)

    def _iterate(self) -> None:
        """A whole iteration up to its first trial, of a single world: torch records no batched solves."""
        self._assemble()
        self.solver.launch_solve(self._hessian)
        self._first_try()

    def _first_try(self) -> None:
        """Start the search of every running world with the full step."""
        self._status[int(UNSOLVED) : int(UNSOLVED) + 1].zero_()
        self.solver.get_solution(self._direction)
        wp.launch(
            _start_search, dim=self.model.worlds, device=self.model.device,
            inputs=[self._running, self.solver.unsolved],
            outputs=[self._pending, self._first, self._motion, self._slope, self._status],
        )  # fmt: skip
        wp.launch(
            _slope, dim=self.model.bodies, device=self.model.device,
            inputs=[self.model.body_world, self._gradient, self._direction], outputs=[self._slope],
        )  # fmt: skip
        wp.launch(
            _linear_motion, dim=len(self.model.vertex_rest), device=self.model.device,
            inputs=[self.model.vertex_rest, self.model.vertex_body, self.model.body_world, self._direction],
            outputs=[self._motion],
        )  # fmt: skip
        wp.launch(
            _first_step, dim=self.model.worlds, device=self.model.device, inputs=[self._motion], outputs=[self._step]
        )  # fmt: skip
        self._try()

    def _try(self) -> None:
        """One trial of every pending world: accepted, shortened, or found to be converged."""
        model, potential = self.model, self.potential
        wp.launch(
            _along_curve, dim=model.bodies, device=model.device,
            inputs=[model.body_world, self._pending, self.q, self._direction, self._step], outputs=[self._trial],
        )  # fmt: skip
        potential.positions(self._trial, self._end)
        potential.measure_motion(self._start, self._end, self._motion)
        wp.launch(
            _clear_status, dim=model.worlds, device=model.device,
            inputs=[self._pending], outputs=[self._fraction, self._status],
        )  # fmt: skip
        potential.candidates.flag_outside(self._start, self._end, self._status)
        safe_step(model, potential.candidates, self._start, self._end, self._fraction)
        wp.launch(
            _select_safe, dim=model.worlds, device=model.device,
            inputs=[self._fraction, self._status], outputs=[self._safe],
        )  # fmt: skip
        potential.evaluate(self._trial, self._end, self._safe, self._trial_energy, self._trial_gradient)
        potential.measure_residual(self._trial_gradient, self._trial_residual)
        wp.launch(
            _decide, dim=model.worlds, device=model.device,
            inputs=[
                self._tolerances, self._unresolved, self._slope, self._motion, self._fraction, self._trial_energy,
                self._trial_residual, self._first, self._step, self._energy, self._residual, self._iterations,
                self._pending, self._accepted, self._running, self._status,
            ],
        )  # fmt: skip
        wp.launch(
            _accept_bodies, dim=model.bodies, device=model.device,
            inputs=[model.body_world, self._accepted, self._trial, self._trial_gradient],
            outputs=[self.q, self._gradient],
        )  # fmt: skip
        wp.launch(
            _accept_vertices, dim=len(model.vertex_rest), device=model.device,
            inputs=[model.vertex_body, model.body_world, self._accepted, self._end], outputs=[self._start],
        )  # fmt: skip
        self._mirror.fetch()

    def _give_up(self) -> None:
        """Worlds that still search have stalled."""
        wp.launch(
            _stall, dim=self.model.worlds, device=self.model.device,
            inputs=[self._pending], outputs=[self._stalled, self._running],
        )  # fmt: skip
        self._mirror.fetch()


@wp.kernel
def _choose_exact(
    tolerances: wp.array(dtype=wp.float64),
    residual: wp.array(dtype=wp.float64),
    # Out
    exact: wp.array(dtype=int),
):
    world = wp.tid()
    exact[world] = int(residual[world] < tolerances[2])


@wp.kernel
def _start_search(
    running: wp.array(dtype=int),
    unsolved: wp.array(dtype=int),
    # Out
    pending: wp.array(dtype=int),
    first: wp.array(dtype=int),
    motion: wp.array(dtype=wp.float64),
    slope: wp.array(dtype=wp.float64),
    status: wp.array(dtype=int),
):
    world = wp.tid()
    if running[world] != 0 and unsolved[world] != 0:
        wp.atomic_add(status, UNSOLVED, 1)
    pending[world] = running[world]
    first[world] = 1
    motion[world] = wp.float64(0.0)
    slope[world] = wp.float64(0.0)


@wp.kernel
def _slope(
    # Model
    body_world: wp.array(dtype=int),
    # State in
    gradient: wp.array2d(dtype=wp.vec3d),
    direction: wp.array2d(dtype=wp.vec3d),
    # Out
    slope: wp.array(dtype=wp.float64),
):
    body = wp.tid()
    total = wp.float64(0.0)
    for i in range(4):
        total += wp.dot(gradient[body, i], direction[body, i])
    wp.atomic_add(slope, body_world[body], total)


@wp.kernel
def _linear_motion(
    # Model
    vertex_rest: wp.array(dtype=wp.vec3d),
    vertex_body: wp.array(dtype=int),
    body_world: wp.array(dtype=int),
    # State in
    direction: wp.array2d(dtype=wp.vec3d),
    # Out
    motion: wp.array(dtype=wp.float64),
):
    v = wp.tid()
    body = vertex_body[v]
    move = direction[body, 0]
    for k in range(3):
        move += vertex_rest[v][k] * direction[body, 1 + k]
    wp.atomic_max(motion, body_world[body], wp.length(move))


@wp.kernel
def _first_step(
    motion: wp.array(dtype=wp.float64),
    # Out
    step: wp.array(dtype=wp.float64),
):
    world = wp.tid()
    step[world] = wp.min(wp.float64(1.0), LONGEST_STEP / wp.max(motion[world], wp.float64(1.0e-300)))


@wp.kernel
def _clear_status(
    pending: wp.array(dtype=int),
    # Out
    fraction: wp.array(dtype=wp.float64),
    status: wp.array(dtype=int),
):
    world = wp.tid()
    fraction[world] = wp.float64(pending[world])
    if world == 0:
        status[OUTSIDE] = 0
        status[PENDING] = 0
        status[RUNNING] = 0


@wp.kernel
def _select_safe(
    fraction: wp.array(dtype=wp.float64),
    status: wp.array(dtype=int),
    # Out
    safe: wp.array(dtype=int),
):
    world = wp.tid()
    safe[world] = int(status[OUTSIDE] + status[UNSOLVED] == 0 and fraction[world] >= wp.float64(1.0))


@wp.kernel
def _decide(
    tolerances: wp.array(dtype=wp.float64),
    unresolved: wp.array(dtype=wp.float64),
    # Trial
    slope: wp.array(dtype=wp.float64),
    motion: wp.array(dtype=wp.float64),
    fraction: wp.array(dtype=wp.float64),
    trial_energy: wp.array(dtype=wp.float64),
    trial_residual: wp.array(dtype=wp.float64),
    # In and out
    first: wp.array(dtype=int),
    step: wp.array(dtype=wp.float64),
    energy: wp.array(dtype=wp.float64),
    residual: wp.array(dtype=wp.float64),
    iterations: wp.array(dtype=int),
    pending: wp.array(dtype=int),
    accepted: wp.array(dtype=int),
    running: wp.array(dtype=int),
    status: wp.array(dtype=int),
):
    world = wp.tid()
    accepted[world] = 0
    if pending[world] != 0 and status[OUTSIDE] + status[UNSOLVED] == 0:
        if first[world] != 0 and motion[world] < tolerances[0] and residual[world] < tolerances[1]:
            running[world] = 0
            pending[world] = 0
        else:
            if first[world] != 0:
                iterations[world] = iterations[world] + 1
                first[world] = 0
            if fraction[world] < wp.float64(1.0):
                step[world] = wp.float64(0.95) * fraction[world] * step[world]
            else:
                limit = energy[world] + SUFFICIENT_DECREASE * step[world] * slope[world]
                downhill = trial_energy[world] <= limit
                if not downhill and (residual[world] < tolerances[2] or -slope[world] < unresolved[world]):
                    downhill = trial_residual[world] < residual[world]
                if downhill:
                    accepted[world] = 1
                    pending[world] = 0
                    energy[world] = trial_energy[world]
                    residual[world] = trial_residual[world]
                else:
                    step[world] = wp.float64(0.5) * step[world]
    if pending[world] != 0:
        wp.atomic_add(status, PENDING, 1)
    if running[world] != 0:
        wp.atomic_add(status, RUNNING, 1)


@wp.kernel
def _accept_bodies(
    # Model
    body_world: wp.array(dtype=int),
    # State in
    accepted: wp.array(dtype=int),
    trial: wp.array2d(dtype=wp.vec3d),
    trial_gradient: wp.array2d(dtype=wp.vec3d),
    # Out
    q: wp.array2d(dtype=wp.vec3d),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    if accepted[body_world[body]] != 0:
        for i in range(4):
            q[body, i] = trial[body, i]
            gradient[body, i] = trial_gradient[body, i]


@wp.kernel
def _accept_vertices(
    # Model
    vertex_body: wp.array(dtype=int),
    body_world: wp.array(dtype=int),
    # State in
    accepted: wp.array(dtype=int),
    end: wp.array(dtype=wp.vec3d),
    # Out
    start: wp.array(dtype=wp.vec3d),
):
    v = wp.tid()
    if accepted[body_world[vertex_body[v]]] != 0:
        start[v] = end[v]


@wp.kernel
def _stall(
    pending: wp.array(dtype=int),
    # Out
    stalled: wp.array(dtype=int),
    running: wp.array(dtype=int),
):
    world = wp.tid()
    if pending[world] != 0:
        stalled[world] = 1
        running[world] = 0


@wp.kernel
def _along_curve(
    # Model
    body_world: wp.array(dtype=int),
    # State in
    pending: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    direction: wp.array2d(dtype=wp.vec3d),
    step: wp.array(dtype=wp.float64),
    # Out
    trial: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    if pending[body_world[body]] == 0:
        for k in range(4):
            trial[body, k] = q[body, k]
        return
    t = step[body_world[body]]
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
