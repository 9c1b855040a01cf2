# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Copies of the states of some worlds of a model, chosen by an active mask."""

from __future__ import annotations

import warp as wp

from pat3d.sim.arrays import Bodies
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model

declare_kernels(__name__)


def copy_worlds(model: Model, active: wp.array, source: wp.array, target: wp.array) -> None:
    """Copy the states of the bodies of active worlds, shape (bodies, 4), vec3d, on the device.

    Args:
        model: the worlds.
        active: active mask: nonzero for those to copy, shape (worlds,), int.
        source: copied from.
        target: copied to.
    """
    wp.launch(
        _copy_worlds,
        dim=model.bodies,
        device=model.device,
        inputs=[model.body_arrays, active, source],
        outputs=[target],
    )


@wp.kernel
def _copy_worlds(
    bodies: Bodies,
    active: wp.array(dtype=int),
    source: wp.array2d(dtype=wp.vec3d),
    # Out
    target: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    if active[bodies.world[body]] != 0:
        for i in range(4):
            target[body, i] = source[body, i]
