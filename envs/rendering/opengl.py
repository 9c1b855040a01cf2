"""MuJoCo's own renderer in a context without a window."""

from __future__ import annotations

import atexit
import functools
import weakref
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.rendering.picture import Picture
from pat3d.errors import EnvironmentSetupError

VARIABLE = "PAT3D_RENDERER"
"""Environment variable that names the renderer."""


class OpenGL:
    """Draws one model through EGL or OSMesa."""

    def __init__(self, model: Any, kind: str) -> None:
        """Make a context of `kind`, one of pat3d.view.gl.KINDS."""
        import mujoco

        self._mujoco, self._model = mujoco, model
        self._see_through = bool((model.mat_rgba[:, 3] < 1.0).any() or (model.geom_rgba[:, 3] < 1.0).any())
        try:
            if kind == "osmesa":
                from mujoco.osmesa import GLContext
            else:
                from mujoco.egl import GLContext
            self._context = GLContext(model.vis.global_.offwidth, model.vis.global_.offheight)
            self._context.make_current()
            self._buffers = {False: self._buffer(fine=False)}
            _open.add(self)
            _close_at_exit()
        except (ImportError, AttributeError, RuntimeError, self._mujoco.FatalError) as error:
            raise EnvironmentSetupError(
                f"no picture can be drawn through {kind.upper()} ({error}). Install its library (Debian: libegl1 or "
                f"libosmesa6), or set {VARIABLE}=cpu; pat3d doctor says what works here."
            ) from error
        self._scene = self._mujoco.MjvScene(model=model, maxgeom=max(10000, 2 * model.ngeom))
        self._option = self._mujoco.MjvOption()
        self._camera = self._mujoco.MjvCamera()
        self._camera.type = self._mujoco.mjtCamera.mjCAMERA_FIXED

    def _buffer(self, *, fine: bool) -> Any:
        """What pictures are drawn into; smooth edges cost twice the time where there is no graphics card."""
        mujoco, quality = self._mujoco, self._model.vis.quality
        samples = quality.offsamples
        quality.offsamples = samples if fine else 0
        try:
            made = mujoco.MjrContext(self._model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
        finally:
            quality.offsamples = samples
        made.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
        return made

    def draw(
        self,
        data: Any,
        camera: int,
        height: int,
        width: int,
        *,
        depth: bool,
        segmentation: bool,
        fine: bool = False,
        shadows: bool = False,
    ) -> Picture:
        """See Renderer."""
        mujoco, scene = self._mujoco, self._scene
        limits = self._model.vis.global_
        if height > limits.offheight or width > limits.offwidth:
            raise EnvironmentSetupError(
                f"pictures of this scene are at most {limits.offheight} x {limits.offwidth} pixels, "
                f"not {height} x {width}."
            )
        self._context.make_current()
        if fine not in self._buffers:
            self._buffers[fine] = self._buffer(fine=fine)
        mjr = self._buffers[fine]
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, mjr)
        self._camera.fixedcamid = camera
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, self._camera, mujoco.mjtCatBit.mjCAT_ALL.value, scene
        )
        scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = fine or shadows
        scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        scene.flags[mujoco.mjtRndFlag.mjRND_FOG] = True
        window = mujoco.MjrRect(0, 0, width, height)
        image = np.empty((height, width, 3), dtype=np.uint8)
        far = np.empty((height, width), dtype=np.float32) if depth else None
        mujoco.mjr_render(window, scene, mjr)
        mujoco.mjr_readPixels(image, far, window, mjr)
        geoms = self._geoms(mjr, window, height, width) if segmentation or (depth and self._see_through) else None
        if self._see_through and depth:
            # What is see-through leaves no depth where it is drawn, but where it is told apart.
            mujoco.mjr_readPixels(None, far, window, mjr)
        return Picture(
            image=np.ascontiguousarray(image[::-1]),
            depth=None if far is None else self._metres(far[::-1]),
            geoms=geoms if segmentation else None,
        )

    def close(self) -> None:
        """Free the context."""
        if self in _open:
            _open.discard(self)
            self._context.make_current()
            for one in self._buffers.values():
                one.free()
            self._context.free()

    def _metres(self, buffer: NDArray[np.float32]) -> NDArray[np.float32]:
        """Distances from a depth buffer that is 1 at the near plane and 0 at the far one."""
        extent, planes = self._model.stat.extent, self._model.vis.map
        near, far = planes.znear * extent, planes.zfar * extent
        return (far * near / (buffer.astype(np.float64) * (far - near) + near)).astype(np.float32)

    def _geoms(self, mjr: Any, window: Any, height: int, width: int) -> NDArray[np.int32]:
        mujoco, scene = self._mujoco, self._scene
        flags = scene.flags.copy()
        scene.flags[mujoco.mjtRndFlag.mjRND_SEGMENT] = scene.flags[mujoco.mjtRndFlag.mjRND_IDCOLOR] = True
        scene.flags[mujoco.mjtRndFlag.mjRND_FOG] = False
        mujoco.mjr_render(window, scene, mjr)
        colours = np.empty((height, width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(colours, None, window, mjr)
        scene.flags[:] = flags
        number = colours.astype(np.int32) @ np.array([1, 2**8, 2**16], dtype=np.int32)
        geoms = np.full(scene.ngeom + 1, -1, dtype=np.int32)
        for one in scene.geoms[: scene.ngeom]:
            if one.segid >= 0 and one.objtype == mujoco.mjtObj.mjOBJ_GEOM:
                geoms[one.segid + 1] = one.objid
        return geoms[np.clip(number, 0, scene.ngeom)][::-1]


_open: weakref.WeakSet[OpenGL] = weakref.WeakSet()


@functools.cache
def _close_at_exit() -> None:
    """Free what a process leaves open; registered after MuJoCo's own function that ends EGL, so done before that."""
    atexit.register(lambda: [one.close() for one in list(_open)])
