"""MuJoCo's own renderer in a context without a window."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.rendering.picture import Picture
from pat3d.errors import EnvironmentSetupError

VARIABLE = "PAT3D_RENDERER"
"""Environment variable that names the renderer."""


class OpenGL:
    """Draws one model through EGL or OSMesa."""

    def __init__(self, model: Any) -> None:
        import mujoco

        self._mujoco = mujoco
        kind = "osmesa" if os.environ.get("MUJOCO_GL", "").lower() == "osmesa" else "egl"
        try:
            if kind == "osmesa":
                from mujoco.osmesa import GLContext
            else:
                from mujoco.egl import GLContext
            self._context = GLContext(model.vis.global_.offwidth, model.vis.global_.offheight)
            self._context.make_current()
            self._mjr = self._mujoco.MjrContext(model, self._mujoco.mjtFontScale.mjFONTSCALE_100.value)
        except (ImportError, AttributeError, RuntimeError, self._mujoco.FatalError) as error:
            raise EnvironmentSetupError(
                f"no picture can be drawn through {kind.upper()} ({error}). Install its library (Debian: libegl1 or "
                f"libosmesa6), or set {VARIABLE}=cpu; pat3d doctor says what works here."
            ) from error
        self._mujoco.mjr_setBuffer(self._mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._mjr)
        self._mjr.readDepthMap = self._mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        self._model = model
        self._scene = self._mujoco.MjvScene(model=model, maxgeom=max(10000, 2 * model.ngeom))
        self._option = self._mujoco.MjvOption()
        self._camera = self._mujoco.MjvCamera()
        self._camera.type = self._mujoco.mjtCamera.mjCAMERA_FIXED

    def draw(
        self, data: Any, camera: int, height: int, width: int, *, depth: bool, segmentation: bool, fine: bool = False
    ) -> Picture:
        """See Renderer; shadows and smooth edges are in every picture."""
        mujoco, scene = self._mujoco, self._scene
        limits = self._model.vis.global_
        if height > limits.offheight or width > limits.offwidth:
            raise EnvironmentSetupError(
                f"pictures of this scene are at most {limits.offheight} x {limits.offwidth} pixels, "
                f"not {height} x {width}."
            )
        self._context.make_current()
        self._camera.fixedcamid = camera
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, self._camera, mujoco.mjtCatBit.mjCAT_ALL.value, scene
        )
        window = mujoco.MjrRect(0, 0, width, height)
        image = np.empty((height, width, 3), dtype=np.uint8)
        far = np.empty((height, width), dtype=np.float32) if depth else None
        mujoco.mjr_render(window, scene, self._mjr)
        mujoco.mjr_readPixels(image, far, window, self._mjr)
        geoms = self._geoms(window, height, width) if segmentation else None
        return Picture(
            image=np.ascontiguousarray(image[::-1]),
            depth=None if far is None else self._metres(far[::-1]),
            geoms=geoms,
        )

    def close(self) -> None:
        """Free the context."""
        self._context.make_current()
        self._mjr.free()
        self._context.free()

    def _metres(self, buffer: NDArray[np.float32]) -> NDArray[np.float32]:
        """Distances from a depth buffer that is 1 at the near plane and 0 at the far one."""
        extent, planes = self._model.stat.extent, self._model.vis.map
        near, far = planes.znear * extent, planes.zfar * extent
        return (far * near / (buffer.astype(np.float64) * (far - near) + near)).astype(np.float32)

    def _geoms(self, window: Any, height: int, width: int) -> NDArray[np.int32]:
        mujoco, scene = self._mujoco, self._scene
        flags = scene.flags.copy()
        scene.flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = scene.flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = True
        mujoco.mjr_render(window, scene, self._mjr)
        colours = np.empty((height, width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(colours, None, window, self._mjr)
        scene.flags[:] = flags
        number = colours.astype(np.int32) @ np.array([1, 2**8, 2**16], dtype=np.int32)
        geoms = np.full(scene.ngeom + 1, -1, dtype=np.int32)
        for one in scene.geoms[: scene.ngeom]:
            if one.segid >= 0 and one.objtype == mujoco.mjtObj.mjOBJ_GEOM:
                geoms[one.segid + 1] = one.objid
        return geoms[np.clip(number, 0, scene.ngeom)][::-1]
