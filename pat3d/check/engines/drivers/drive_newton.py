"""Newton: the USD export, with its MuJoCo solver or its own position-based one, on the CPU."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import newton
import numpy as np
import recording
import warp as wp

MUJOCO_STEP = 0.001
"""[s], as the file asks; Newton gives MuJoCo's colliders no margin: what floats lands, harder the longer a step is."""

XPBD_STEP = 0.001
"""[s]"""

XPBD_ITERATIONS = 30
"""Stacks sink by what is left after them, as the square of the step divided by their number: 8 let a radio on three
books sink by 2 mm before it stops, and fruit that leans on fruit roll away. The more there are, the less still presses
on what leans when a step ends: a pen on two points turns by 0.1 degrees a second, with 40 by 0.2."""

XPBD_RELAXATION = 1.0
"""Of the mean of what a body's contacts ask for; the solver's default is 0.8. Sums of them instead of means, which sink
less, throw what has more than six contacts about."""

XPBD_CONTACTS = "sticky"
"""Contacts keep their points from step to step; found anew in each, what leans slips by 0.3 mm a second."""

XPBD_OVERLAP = 1e-6
"""[m], left between what touches. A contact that a step leaves open, be it by rounding, loses its points, and with them
the slip that friction would take back: the pen turned by 0.5 degrees a second. Single precision resolves 1e-7 m."""


@wp.kernel
def _shrink(margins: wp.array(dtype=wp.float32), by: wp.float32):  # pyright: ignore[reportInvalidTypeForm]
    margins[wp.tid()] = margins[wp.tid()] - by


def drive(export: Path, seconds: float, variant: str, lean: float) -> dict[str, Any]:
    """Load scene.usdc and run it with the solver "mujoco" or "xpbd"."""
    wp.config.quiet = True
    builder = newton.ModelBuilder()
    newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
    builder.add_usd(str(export / "scene.usdc"))
    model = builder.finalize(device="cpu")
    state = model.state()
    newton.eval_fk(model, model.joint_q, model.joint_qd, state)
    names = {label.split("/")[-1]: number for number, label in enumerate(builder.body_label)}
    solver, step_seconds, step = _with_mujoco(model, state) if variant == "mujoco" else _with_xpbd(model, state)
    strength = float(np.linalg.norm(model.gravity.numpy()[0]))

    def poses() -> dict[str, list[float]]:
        placed = state.body_q.numpy().astype(np.float64)
        return {name: [*placed[k, :3], placed[k, 6], *placed[k, 3:6]] for name, k in names.items()}

    def pull(down: tuple[float, float, float]) -> None:
        model.set_gravity(strength * np.array(down))
        solver.notify_model_changed(newton.ModelFlags.MODEL_PROPERTIES)

    found = recording.run(step, poses, step_seconds, seconds, pull, lean)
    settings: dict[str, Any] = {"timestep": step_seconds, "solver": variant}
    if variant != "mujoco":
        settings |= {
            "iterations": XPBD_ITERATIONS,
            "contact matching": XPBD_CONTACTS,
            "contact relaxation": XPBD_RELAXATION,
            "overlap left [m]": XPBD_OVERLAP,
        }
    return {
        "engine": f"Newton ({variant})",
        "version": newton.__version__,
        "settings": settings,
        "warnings": [],
        "recording": found,
    }


def _with_mujoco(model: Any, state: Any) -> tuple[Any, float, Callable[[int], None]]:
    """The solver, its time step [s], and what advances `state` by a number of them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        solver: Any = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
    after, control = model.state(), model.control()

    def step(count: int) -> None:
        for _ in range(count):
            state.clear_forces()
            solver.step(state, after, control, None, MUJOCO_STEP)
            state.assign(after)

    return solver, MUJOCO_STEP, step


def _with_xpbd(model: Any, state: Any) -> tuple[Any, float, Callable[[int], None]]:
    """The solver, its time step [s], and what advances `state` by a number of them."""
    solver = newton.solvers.SolverXPBD(model, iterations=XPBD_ITERATIONS, rigid_contact_relaxation=XPBD_RELAXATION)
    pipeline = newton.CollisionPipeline(model, contact_matching=XPBD_CONTACTS)
    after, control, contacts = model.state(), model.control(), pipeline.contacts()
    graph = None

    def advance() -> None:
        pipeline.collide(state, contacts)
        margins = contacts.rigid_contact_margin0
        wp.launch(_shrink, dim=margins.shape, inputs=[margins, XPBD_OVERLAP], device="cpu")
        state.clear_forces()
        solver.step(state, after, control, contacts, XPBD_STEP)
        state.assign(after)

    def step(count: int) -> None:
        # The launches of one step, recorded once the kernels are loaded, take a tenth of the time.
        nonlocal graph
        for _ in range(count):
            if graph is not None:
                wp.capture_launch(graph)
                continue
            advance()
            with wp.ScopedCapture(device="cpu") as capture:
                advance()
            graph = capture.graph

    return solver, XPBD_STEP, step


if __name__ == "__main__":
    recording.main(drive)
