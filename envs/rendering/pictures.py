"""Pictures of a running simulation: MuJoCo's GL renderer where EGL or OSMesa works, else rays traced on the CPU.

GL is tried once in a process of its own because broken drivers crash or hang. PAT3D_RENDERER=egl, osmesa or cpu decides
without trying, and so does MUJOCO_GL=egl or osmesa. All see the same cameras in the same light; see TOLERANCE.
"""

from __future__ import annotations

import functools
import os

import numpy as np

from pat3d.envs.physics.simulation import Simulation
from pat3d.envs.physics.world import ROBOT
from pat3d.envs.rendering.opengl import VARIABLE, OpenGL
from pat3d.envs.rendering.picture import Picture, Renderer
from pat3d.envs.rendering.raytrace import RayTracer
from pat3d.errors import EnvironmentSetupError
from pat3d.view.gl import KINDS, gl_renderer

BACKENDS = (*KINDS, "cpu")

TOLERANCE = 5.0
"""Mean over an observation's pixels by which the colours of two renderers differ [of 255]."""


class Pictures:
    """Takes pictures of one simulation."""

    def __init__(self, simulation: Simulation, drawn_by: str | None = None) -> None:
        """For `simulation`; drawn by one of BACKENDS, where it has to be that one."""
        self._simulation = simulation
        model = simulation.model
        self._cameras = {model.camera(number).name: number for number in range(model.ncam)}
        owner = simulation.world.owner
        # The last entry is for pixels without any geom.
        labels = np.where(owner >= 0, owner + 2, np.where(owner == ROBOT, 1, 0))
        self._labels = np.append(labels, 0).astype(np.uint16)
        kind = drawn_by or backend()
        self._renderer: Renderer = RayTracer(model) if kind == "cpu" else OpenGL(model, kind)

    def take(
        self,
        camera: str,
        height: int,
        width: int,
        *,
        depth: bool = False,
        segmentation: bool = False,
        fine: bool = False,
        shadows: bool = False,
    ) -> Picture:
        """What `camera` sees now, `height` x `width` pixels; `fine`, as films are, with shadows and smooth edges."""
        data = self._simulation.data
        picture = self._renderer.draw(
            data,
            self._cameras[camera],
            height,
            width,
            depth=depth,
            segmentation=segmentation,
            fine=fine,
            shadows=shadows,
        )
        labels = None if picture.geoms is None else self._labels[picture.geoms]
        return Picture(image=picture.image, depth=picture.depth, geoms=picture.geoms, segmentation=labels)

    def close(self) -> None:
        """Free the renderer."""
        self._renderer.close()


@functools.lru_cache(maxsize=1)
def backend() -> str:
    """What draws the pictures of this process, one of BACKENDS.

    Raises:
        EnvironmentSetupError: $PAT3D_RENDERER is none of them.
    """
    wanted = os.environ.get(VARIABLE, "").strip().lower()
    if wanted and wanted not in BACKENDS:
        raise EnvironmentSetupError(f'{VARIABLE}="{wanted}" is no renderer. Valid: {", ".join(BACKENDS)}, or unset.')
    asked = wanted or os.environ.get("MUJOCO_GL", "").strip().lower()
    if asked in BACKENDS:
        return asked
    # MuJoCo's contexts of one kind refuse a process whose PyOpenGL was set to the other.
    bound = os.environ.get("PYOPENGL_PLATFORM", "").strip().lower()
    return next((kind for kind in KINDS if bound in ("", kind) and gl_renderer(kind) is not None), "cpu")
