"""The light of a world, which every renderer takes from MuJoCo's model: a sun, a sky and a lamp at the camera.

Colour of a surface = its own * (ambient + sum over lights of diffuse * max(normal . towards the light, 0)), as OpenGL
has it without highlights. A perturbation of the model's lights is seen by every renderer.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]
Numbers = tuple[float, float, float]

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


HARMONICS = "environment"
"""MuJoCo's custom numbers that hold the harmonics of a world's light, and the red, green and blue of the lamps in their
stead."""

FILL = "environment_"
"""Lamps whose names begin so stand for the harmonics where a renderer has none."""


@dataclass(frozen=True, kw_only=True)
class Lamp:
    """A light that is far away."""

    name: str
    towards: Numbers
    diffuse: Numbers
    casts: bool = False
    """Whether what it does not reach lies in the shadow."""


@dataclass(frozen=True, kw_only=True)
class Rig:
    """All light but the lamp at the camera."""

    ambient: Numbers
    lamps: tuple[Lamp, ...]
    horizon: Numbers
    """Colour that a floor without end turns into."""
    fades: tuple[float, float] = FADES
    """Distances [m] from which on everything is seen through fog, and nothing but fog."""
    pictured: bool = False
    """Whether pictures are drawn around everything, see `pat3d.envs.surroundings.skies`."""
    harmonics: tuple[float, ...] = ()
    """Of the light from everywhere and of the fills, see `pat3d.envs.surroundings.harmonics.polynomial`; 27 or none."""


OUTDOORS = Rig(
    ambient=(AMBIENT, AMBIENT, AMBIENT),
    lamps=(
        Lamp(
            name="sun",
            towards=(float(SUN[0]), float(SUN[1]), float(SUN[2])),
            diffuse=(SUNLIGHT, SUNLIGHT, SUNLIGHT),
            casts=True,
        ),
        Lamp(name="sky", towards=(0.0, 0.0, 1.0), diffuse=(SKYLIGHT, SKYLIGHT, SKYLIGHT)),
    ),
    horizon=(float(SKY[0]), float(SKY[1]), float(SKY[2])),
)
"""A sun and a sky of one colour."""


def light_up(spec: Any, rig: Rig = OUTDOORS) -> None:
    """Give a world (an MjSpec) this light alone, the floor's colours and the sky's; highlights there are none."""
    import mujoco

    for light in list(spec.lights):
        spec.delete(light)
    lamp = spec.visual.headlight
    lamp.ambient, lamp.diffuse, lamp.specular = rig.ambient, [LAMP] * 3, [0.0] * 3
    for one in rig.lamps:
        towards = np.array(one.towards)
        spec.worldbody.add_light(
            name=one.name,
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            # MuJoCo draws the shadows around the point that a light shines at.
            pos=3.0 * towards / np.linalg.norm(towards),
            dir=-towards,
            diffuse=one.diffuse,
            ambient=[0.0] * 3,
            specular=[0.0] * 3,
            castshadow=one.casts,
        )
    if rig.harmonics:
        fills = sum((np.array(one.diffuse) for one in rig.lamps if one.name.startswith(FILL)), np.zeros(3))
        spec.add_numeric(name=HARMONICS, data=[*rig.harmonics, *fills.tolist()])
    near, far = rig.fades
    spec.visual.map.fogstart, spec.visual.map.fogend = near / spec.stat.extent, far / spec.stat.extent
    spec.visual.rgba.fog = [*rig.horizon, 1.0]
    for texture in spec.textures:
        if texture.type == mujoco.mjtTexture.mjTEXTURE_SKYBOX and not rig.pictured:
            texture.rgb1 = texture.rgb2 = rig.horizon
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

    def paint(self, colour: NDArray[Any], share: float) -> None:
        """Mix it with another colour, shape (3,), by this share."""
        self._model.vis.rgba.fog[:3] = (1.0 - share) * self.colour + share * np.asarray(colour)
        for texels, own in zip(self._texels, self._own, strict=True):
            mixed = (1.0 - share) * own[:, :3] + 255.0 * share * np.asarray(colour)
            texels[:, :3] = np.round(mixed).astype(np.uint8)

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
        self.harmonics = _harmonics(model)
        """As a polynomial of the normal, shape (9, 3); None where the light from everywhere is the same."""
        if self.harmonics is not None:
            on = on[[not model.light(int(number)).name.startswith(FILL) for number in on]]
        self.ambient = (np.array(lamp.ambient) + model.light_ambient[on].sum(axis=0)).astype(np.float32)
        if self.harmonics is not None:
            self.ambient = np.zeros(3, dtype=np.float32)
        self.lamp = np.array(lamp.diffuse, dtype=np.float32)
        self.diffuse = model.light_diffuse[on].astype(np.float32)
        towards = -data.light_xdir[on]
        self.towards = (towards / np.linalg.norm(towards, axis=1, keepdims=True)).astype(np.float32)
        self.casts = model.light_castshadow[on].astype(np.bool_)

    @property
    def sun(self) -> Array | None:
        """Direction of the first light that casts shadows, shape (3,); None where none does."""
        return self.towards[np.argmax(self.casts)] if self.casts.any() else None

    def on(self, normal: Array, facing: Array, shaded: NDArray[np.bool_]) -> Array:
        """Brightness of surfaces with unit `normal`, seen at a slope of `facing`; shape (n, 3).

        Args:
            normal: towards the viewer, shape (n, 3).
            facing: the cosine of the angle between it and the view, shape (n,).
            shaded: from the lights that cast shadows, shape (n,).
        """
        found: Any = self.ambient + facing[:, None] * self.lamp
        if self.harmonics is not None:
            x, y, z = normal.T
            one = np.ones_like(x)
            terms = np.stack([one, y, z, x, x * y, y * z, 3.0 * z * z - one, x * z, x * x - y * y], axis=1)
            found += np.maximum(terms @ self.harmonics, np.float32(0.0))
        for towards, diffuse, casts in zip(self.towards, self.diffuse, self.casts, strict=True):
            falls = np.maximum(normal @ towards, np.float32(0.0))
            found += (falls * ~shaded if casts else falls)[:, None] * diffuse
        return found


def _harmonics(model: Any) -> Array | None:
    """The harmonics of a world's light, in the colour and as bright as the lamps in their stead are now; or None."""
    for number in range(model.nnumeric):
        if model.numeric(number).name == HARMONICS:
            values, made = np.split(np.array(model.numeric(number).data), [27])
            fills = [i for i in range(model.nlight) if model.light(i).name.startswith(FILL) and model.light_active[i]]
            now = model.light_diffuse[fills].sum(axis=0)
            scale = np.divide(now, made, out=np.ones(3), where=made > 0.0)
            return (scale * values.reshape(9, 3)).astype(np.float32)
    return None
