# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""What a settling run is steered by: how far a step moved and slipped, and how unbalanced it left the bodies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.arrays import Bodies
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.launch_graph import LaunchGraph, Mirror
from pat3d.sim.terms.potential import Potential

declare_kernels(__name__, most_records=1)


class StepMeasures:
    """Measures of the last step of every world, read at once."""

    def __init__(self, potential: Potential, q: wp.array):
        """Of steps from the start that the potential's inertia pulls to, to state q, shape (bodies, 4), vec3d."""
        self.potential, self.q, self.model = potential, q, potential.model
        model = self.model
        self._values = Mirror(wp.zeros((5, model.worlds), dtype=wp.float64, device=model.device))
        self._gradient = wp.zeros_like(q)
        self._energy = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)
        self._radius = wp.array(model.body_radius, dtype=wp.float64, device=model.device)
        self._last = wp.zeros_like(q)
        """Change of the state in the step before, shape (bodies, 4), vec3d."""
        self._motion = LaunchGraph(model.device, self._launch_motion)
        self._all = LaunchGraph(model.device, self._launch_all)

    def motion(self) -> NDArray[np.float64]:
        """Largest motion of any vertex in the last step [m], shape (worlds,)."""
        self._motion.run()
        return self._values.read()[0]

    def all(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
        """Motion [m], residual without inertia, friction displacement [m], and whether the last two steps undo most of
        one another; shape (worlds,) each.
        """  # noqa: D205
        potential = self.potential
        self._all.run((potential.candidates.capacity, potential.friction.capacity))
        move, residual, slip, both, before = self._values.read().copy()
        return move, residual, slip, both < -0.5 * before

    def forget_last(self) -> None:
        """Compare the next step with none."""
        self._last.zero_()

    def _launch_motion(self) -> None:
        potential = self.potential
        potential.positions(potential.inertia.start, potential._start)
        potential.positions(self.q, potential._end)
        potential.measure_motion(potential._start, potential._end, self._values.array[0])
        self._values.fetch()

    def _launch_all(self) -> None:
        model, potential, values = self.model, self.potential, self._values.array
        values.zero_()
        # Of the state, as friction was recorded there.
        at = replace(potential.everywhere(self.q, potential.vertex_positions), at_rest=True)
        potential.evaluate(at, self._energy, self._gradient)
        potential.measure_residual(self._gradient, values[1])
        potential.friction.launch_largest_slip(self.q, values[2])
        wp.launch(
            _compare_steps,
            dim=model.bodies,
            device=model.device,
            inputs=[model.body_arrays, self._radius, potential.inertia.start, self.q, self._last],
            outputs=[values[3], values[4]],
        )
        self._launch_motion()


@wp.kernel
def _compare_steps(
    bodies: Bodies,
    body_radius: wp.array(dtype=wp.float64),
    start: wp.array2d(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
    # In and out
    last: wp.array2d(dtype=wp.vec3d),
    # Out
    both: wp.array(dtype=wp.float64),
    before: wp.array(dtype=wp.float64),
):
    body = wp.tid()
    along = wp.float64(0.0)
    square = wp.float64(0.0)
    for i in range(4):
        scale = wp.float64(1.0)
        if i > 0:
            scale = body_radius[body] * body_radius[body]
        change = q[body, i] - start[body, i]
        along += scale * wp.dot(change, last[body, i])
        square += scale * wp.dot(last[body, i], last[body, i])
        last[body, i] = change
    wp.atomic_add(both, bodies.world[body], along)
    wp.atomic_add(before, bodies.world[body], square)
