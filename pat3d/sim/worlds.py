# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""What is done to some worlds of a model and not to others."""

from __future__ import annotations

import warp as wp

from pat3d.sim.model import Model

wp.set_module_options({"enable_backward": False, "max_unroll": 0})


def copy_worlds(model: Model, worlds: wp.array, source: wp.array, target: wp.array) -> None:
    """Copy the states of the bodies of chosen worlds, shape (bodies, 4), vec3d, on the device.

    Args:
        model: the worlds.
        worlds: nonzero for those to copy, shape (worlds,), int.
        source: copied from.
        target: copied to.
    """
    wp.launch(
        _copy_worlds, dim=model.bodies, device=model.device, inputs=[model.body_world, worlds, source], outputs=[target]
    )


@wp.kernel
def _copy_worlds(
    # Model
    body_world: wp.array(dtype=int),
    # State in
    worlds: wp.array(dtype=int),
    source: wp.array2d(dtype=wp.vec3d),
    # Out
    target: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    if worlds[body_world[body]] != 0:
        for i in range(4):
            target[body, i] = source[body, i]
