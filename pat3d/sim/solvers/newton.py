# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Projected Newton with a line search that never lets an accepted state intersect."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.arrays import filled
from pat3d.sim.contact.ccd import safe_step
from pat3d.sim.launch_graph import LaunchGraph, Mirror
from pat3d.sim.model import Model
from pat3d.sim.solvers import line_search
from pat3d.sim.solvers.line_search import COUNTS, OUTSIDE, PENDING, UNSOLVED
from pat3d.sim.solvers.linear import DenseSolver
from pat3d.sim.terms.potential import SKIN, Potential
from pat3d.sim.terms.term import Evaluation

BACKTRACKS = 60
UNRESOLVED = 1.0e-14
"""Decreases below the heaviest body's weight over this height [m] drown in the energy's rounding."""


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
        self._search_arrays = filled(
            line_search.Search,
            tolerances=self._tolerances,
            unresolved=self._unresolved,
            slope=self._slope,
            motion=self._motion,
            fraction=self._fraction,
            trial_energy=self._trial_energy,
            trial_residual=self._trial_residual,
            first=self._first,
            step=self._step,
            energy=self._energy,
            residual=self._residual,
            iterations=self._iterations,
            pending=self._pending,
            accepted=self._accepted,
            running=self._running,
        )
        self._graphs = {
            launches: LaunchGraph(device, launches, torch=self.solver.torch if launches == self._iterate else None)
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

    @property
    def fraction(self) -> wp.array:
        """Fraction of the last trial that collision detection allowed, shape (worlds,), float64."""
        return self._fraction

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
        self._graphs[launches].run((self.potential.candidates.capacity, self.potential.friction.capacity))

    def _search(self) -> NDArray[np.int32]:
        """Backtrack until every running world decreases; returns the status."""
        for _ in range(BACKTRACKS):
            status = self._mirror.read()
            if status[int(UNSOLVED)]:
                self.solver.solve_unsolved(self._hessian)
                self._run(self._first_try)
                continue
            if status[int(OUTSIDE)]:
                self.potential.candidates.rebuild(self._start, self._end, self.potential.contact.d_hat, SKIN)
            elif not status[int(PENDING)]:
                return status
            self._run(self._try)
        self._run(self._give_up)
        return self._mirror.read()

    def _present(self) -> Evaluation:
        """The present state in the worlds that run."""
        return Evaluation(q=self.q, position=self._start, active=self._running)

    def _begin(self) -> None:
        """Energy, gradient and residual at the first state."""
        potential = self.potential
        self._status.zero_()
        wp.copy(self._running, self._active)
        self._direction.zero_()
        potential.positions(self.q, self._start)
        potential.evaluate(self._present(), self._energy, self._gradient)
        potential.measure_residual(self._gradient, self._residual)
        self._mirror.fetch()

    def _assemble(self) -> None:
        """The Newton system of every running world."""
        wp.launch(
            line_search.choose_exact,
            dim=self.model.worlds,
            device=self.model.device,
            inputs=[self._tolerances, self._residual],
            outputs=[self._exact],
        )
        self.potential.assemble(self._present(), self._exact, self._hessian)
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
            line_search.start_search,
            dim=self.model.worlds,
            device=self.model.device,
            inputs=[self._running, self.solver.unsolved],
            outputs=[self._pending, self._first, self._motion, self._slope, self._status],
        )
        wp.launch(
            line_search.slope,
            dim=self.model.bodies,
            device=self.model.device,
            inputs=[self.model.body_arrays, self._gradient, self._direction],
            outputs=[self._slope],
        )
        wp.launch(
            line_search.linear_motion,
            dim=len(self.model.vertex_rest),
            device=self.model.device,
            inputs=[self.model.vertex_arrays, self.model.body_arrays, self._direction],
            outputs=[self._motion],
        )
        wp.launch(
            line_search.first_step,
            dim=self.model.worlds,
            device=self.model.device,
            inputs=[self._motion],
            outputs=[self._step],
        )
        self._try()

    def _try(self) -> None:
        """One trial of every pending world: accepted, shortened, or found to be converged."""
        model, potential = self.model, self.potential
        wp.launch(
            line_search.along_curve,
            dim=model.bodies,
            device=model.device,
            inputs=[model.body_arrays, self._pending, self.q, self._direction, self._step],
            outputs=[self._trial],
        )
        potential.positions(self._trial, self._end)
        potential.measure_motion(self._start, self._end, self._motion)
        wp.launch(
            line_search.clear_status,
            dim=model.worlds,
            device=model.device,
            inputs=[self._pending],
            outputs=[self._fraction, self._status],
        )
        potential.candidates.flag_outside(self._start, self._end, self._status)
        safe_step(model, potential.candidates, self._start, self._end, self._fraction)
        wp.launch(
            line_search.select_safe,
            dim=model.worlds,
            device=model.device,
            inputs=[self._fraction, self._status],
            outputs=[self._safe],
        )
        trial = Evaluation(q=self._trial, position=self._end, active=self._safe)
        potential.evaluate(trial, self._trial_energy, self._trial_gradient)
        potential.measure_residual(self._trial_gradient, self._trial_residual)
        wp.launch(
            line_search.decide,
            dim=model.worlds,
            device=model.device,
            inputs=[self._search_arrays],
            outputs=[self._status],
        )
        wp.launch(
            line_search.accept_bodies,
            dim=model.bodies,
            device=model.device,
            inputs=[model.body_arrays, self._accepted, self._trial, self._trial_gradient],
            outputs=[self.q, self._gradient],
        )
        wp.launch(
            line_search.accept_vertices,
            dim=len(model.vertex_rest),
            device=model.device,
            inputs=[model.vertex_arrays, model.body_arrays, self._accepted, self._end],
            outputs=[self._start],
        )
        self._mirror.fetch()

    def _give_up(self) -> None:
        """Worlds that still search have stalled."""
        wp.launch(
            line_search.stall,
            dim=self.model.worlds,
            device=self.model.device,
            inputs=[self._pending],
            outputs=[self._stalled, self._running],
        )
        self._mirror.fetch()
