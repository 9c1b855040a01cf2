"""The light of a world, which every renderer takes from MuJoCo's model: a sun, a sky and a lamp at the camera.

Colour of a surface = its own * (ambient + sum over lights of diffuse * max(normal . towards the light, 0)), as OpenGL
has it without highlights. A perturbation of the model's lights is seen by every renderer.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

SUN = np.array([0.35, -0.45, 0.82], dtype=np.float32)
"""Direction of the sun."""

SUNLIGHT, SKYLIGHT, LAMP, AMBIENT = 0.42, 0.15, 0.10, 0.40
"""Brightness of sun, sky (from straight above) and lamp on what faces them, and of everything without them.

Together hardly more than 1, where OpenGL cuts the light off before it multiplies it by a texture."""

SKY = np.array([0.83, 0.88, 0.93], dtype=np.float32)

FLOOR = ((0.80, 0.79, 0.77), (0.74, 0.73, 0.71))
"""Colours of the floor's tiles."""

FADES = (2.0, 12.0)
"""Between these distances [m] the floor turns into the sky."""


def light_up(spec: Any) -> None:
    """Give a world (an MjSpec) this light alone, the floor's colours and the sky's; highlights there are none."""
    import mujoco

    for light in list(spec.lights):
        spec.delete(light)
    lamp = spec.visual.headlight
    lamp.ambient, lamp.diffuse, lamp.specular = [AMBIENT] * 3, [LAMP] * 3, [0.0] * 3
    for name, towards, diffuse in (("sun", SUN.astype(np.float64), SUNLIGHT), ("sky", np.array([0, 0, 1.0]), SKYLIGHT)):
        spec.worldbody.add_light(
            name=name,
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            # MuJoCo draws the shadows around the point that a light shines at.
            pos=3.0 * towards / np.linalg.norm(towards),
            dir=-towards,
            diffuse=[diffuse] * 3,
            ambient=[0.0] * 3,
            specular=[0.0] * 3,
            castshadow=name == "sun",
        )
    near, far = FADES
    spec.visual.map.fogstart, spec.visual.map.fogend = near / spec.stat.extent, far / spec.stat.extent
    spec.visual.rgba.fog = [*SKY.tolist(), 1.0]
    for texture in spec.textures:
        if texture.type == mujoco.mjtTexture.mjTEXTURE_SKYBOX:
            texture.rgb1 = texture.rgb2 = SKY.tolist()
        elif texture.name == "ground":
            texture.rgb1, texture.rgb2 = FLOOR


def sky_of(model: Any) -> Array:
    """Colour of the sky in a world that was lit so, as it is now, shape (3,)."""
    return np.array(model.vis.rgba.fog[:3], dtype=np.float32)


def tint_of(model: Any, geom: int) -> Array:
    """What the tiles of a plane are multiplied by, as it is now, shape (3,)."""
    material = int(model.geom_matid[geom])
    return np.ones(3, dtype=np.float32) if material < 0 else model.mat_rgba[material][:3].astype(np.float32)


class Sky:
    """The sky of a world as it is made, which may be painted over; renderers have to be made anew then."""

    def __init__(self, model: Any) -> None:
        import mujoco

        self._model, self._texels = model, []
        for number in np.flatnonzero(model.tex_type == int(mujoco.mjtTexture.mjTEXTURE_SKYBOX)).tolist():
            first, channels = int(model.tex_adr[number]), int(model.tex_nchannel[number])
            count = int(model.tex_height[number]) * int(model.tex_width[number])
            self._texels.append(model.tex_data[first : first + count * channels].reshape(count, channels))
        self.colour = np.array(model.vis.rgba.fog[:3])
        """Shape (3,)."""
        self._own = [texels.copy() for texels in self._texels]

    def paint(self, colour: NDArray[Any]) -> None:
        """Give it another colour, shape (3,)."""
        self._model.vis.rgba.fog[:3] = colour
        for texels in self._texels:
            texels[:, :3] = np.round(255.0 * np.asarray(colour)).astype(np.uint8)

    def restore(self) -> None:
        """Give it its own colour back, to the bit."""
        self._model.vis.rgba.fog[:3] = self.colour
        for texels, own in zip(self._texels, self._own, strict=True):
            texels[:] = own


class Lights:
    """The light of a model as it is now."""

    def __init__(self, model: Any, data: Any) -> None:
        lamp = model.vis.headlight
        on = np.flatnonzero(model.light_active)
        self.ambient = (np.array(lamp.ambient) + model.light_ambient[on].sum(axis=0)).astype(np.float32)
        self.lamp = np.array(lamp.diffuse, dtype=np.float32)
        self.diffuse = model.light_diffuse[on].astype(np.float32)
        towards = -data.light_xdir[on]
        self.towards = (towards / np.linalg.norm(towards, axis=1, keepdims=True)).astype(np.float32)
        self._casts = model.light_castshadow[on].astype(np.bool_)

    @property
    def sun(self) -> Array | None:
        """Direction of the first light that casts shadows, shape (3,); None where none does."""
        return self.towards[np.argmax(self._casts)] if self._casts.any() else None

    def on(self, normal: Array, facing: Array, shaded: NDArray[np.bool_]) -> Array:
        """Brightness of surfaces with unit `normal`, seen at a slope of `facing`; shape (n, 3).

        Args:
            normal: towards the viewer, shape (n, 3).
            facing: the cosine of the angle between it and the view, shape (n,).
            shaded: from the lights that cast shadows, shape (n,).
        """
        found = self.ambient + facing[:, None] * self.lamp
        for towards, diffuse, casts in zip(self.towards, self.diffuse, self._casts, strict=True):
            falls = np.maximum(normal @ towards, np.float32(0.0))
            found += (falls * ~shaded if casts else falls)[:, None] * diffuse
        return found
