"""Pictures of a running simulation: MuJoCo's GL renderer on a graphics card, else rays traced on the CPU.

GL is tried once in a process of its own because broken drivers crash or hang. Where it would run on the CPU itself, the
rays are ten times faster. PAT3D_RENDERER=gl or cpu decides without trying, and so does MUJOCO_GL=egl or osmesa. Both
see the same cameras and agree on depth and segmentation; their light differs.
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

BACKENDS = ("gl", "cpu")


class Pictures:
    """Takes pictures of one simulation."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        model = simulation.model
        self._cameras = {model.camera(number).name: number for number in range(model.ncam)}
        owner = simulation.world.owner
        # The last entry is for pixels without any geom.
        labels = np.where(owner >= 0, owner + 2, np.where(owner == ROBOT, 1, 0))
        self._labels = np.append(labels, 0).astype(np.uint16)
        self._renderer: Renderer = OpenGL(model) if backend() == "gl" else RayTracer(model)

    def take(
        self,
        camera: str,
        height: int,
        width: int,
        *,
        depth: bool = False,
        segmentation: bool = False,
        fine: bool = False,
    ) -> Picture:
        """What `camera` sees now, `height` x `width` pixels; `fine`, as films are, with shadows and smooth edges."""
        data = self._simulation.data
        picture = self._renderer.draw(
            data, self._cameras[camera], height, width, depth=depth, segmentation=segmentation, fine=fine
        )
        labels = None if picture.geoms is None else self._labels[picture.geoms]
        return Picture(image=picture.image, depth=picture.depth, geoms=picture.geoms, segmentation=labels)

    def close(self) -> None:
        """Free the renderer."""
        self._renderer.close()


@functools.lru_cache(maxsize=1)
def backend() -> str:
    """What draws the pictures of this process: "gl" or "cpu".

    Raises:
        EnvironmentSetupError: $PAT3D_RENDERER is neither.
    """
    wanted = os.environ.get(VARIABLE, "").strip().lower()
    if wanted and wanted not in BACKENDS:
        raise EnvironmentSetupError(f'{VARIABLE}="{wanted}" is no renderer. Valid: {", ".join(BACKENDS)}, or unset.')
    if wanted:
        return wanted
    if os.environ.get("MUJOCO_GL", "").lower() in ("egl", "osmesa"):
        return "gl"
    from pat3d.view.gl import egl_renderer, is_software

    card = egl_renderer()
    return "gl" if card is not None and not is_software(card) else "cpu"
