"""The light of a perturbed episode: how bright every lamp is, where the sun stands, and how warm the light is.

Warm and cold are the colours of black bodies at a temperature T, by the chromaticity of M. Krystek, "An algorithm to
calculate correlated colour temperature", Color Research and Application 10 (1985), pp. 38-40 (1,000 to 15,000 K).
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DAYLIGHT = 6500.0
"""Temperature of the light of a world as it is [K]."""

WARMEST = 2.3
"""Temperatures are at most so many times lower or higher at full strength: 2,800 K, a filament, to 15,000 K, a sky."""

HALF_TURN = math.pi
"""By which the sun goes round at full strength [rad]."""

RISE = math.radians(40.0)
"""By which it stands higher or lower at full strength [rad]."""

LOWEST, HIGHEST = math.radians(20.0), math.radians(85.0)
"""Above the horizon it stays between these [rad]: a lower one leaves the table in the dark."""

GAMMA = 2.2
"""By which colours of pictures are encoded, roughly."""

_TO_RGB = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
"""CIE XYZ to linear sRGB (IEC 61966-2-1)."""


@dataclass(frozen=True, kw_only=True)
class Lighting:
    """What is different about the light of an episode."""

    brightness: tuple[float, ...]
    """Factor of every light of the model."""
    kelvin: float
    """Colour temperature of all light [K]; DAYLIGHT for as it is."""
    turn: float
    """By which the sun goes round [rad]."""
    rise: float
    """By which it stands higher [rad]."""

    @staticmethod
    def draw(strength: float, lights: int, random: np.random.Generator) -> Lighting:
        """Anything up to a strength in [0, 1], for a model with so many lights."""
        brightness = tuple(float(random.uniform(1.0 - strength, 1.0 + strength)) for _ in range(lights))
        warmer, turn, rise = random.uniform(-strength, strength, 3).tolist()
        return Lighting(
            brightness=brightness, kelvin=DAYLIGHT * WARMEST**warmer, turn=HALF_TURN * turn, rise=RISE * rise
        )

    def shine(self, model: Any) -> None:
        """Light a MuJoCo model so; its lights, its lamp at the camera and where its suns stand are changed."""
        import mujoco

        tint = colour_of(self.kelvin)
        lamp = model.vis.headlight
        for part in (lamp.ambient, lamp.diffuse):
            part[...] = tint * part
        for number, factor in enumerate(self.brightness):
            for part in (model.light_diffuse, model.light_ambient):
                part[number] = factor * tint * part[number]
            if model.light_type[number] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL and model.light_castshadow[number]:
                towards = turned(-model.light_dir[number], self.turn, self.rise)
                model.light_dir[number] = -towards
                # Around which the shadows are drawn.
                model.light_pos[number] = np.linalg.norm(model.light_pos[number]) * towards

    def to_json(self) -> dict[str, Any]:
        """As plain JSON data."""
        return {**asdict(self), "brightness": list(self.brightness)}


def turned(towards: Array, turn: float, rise: float) -> Array:
    """Where the sun is that stood in the direction `towards`, shape (3,); a unit vector.

    Args:
        towards: it, of any length.
        turn: counter-clockwise about the vertical [rad].
        rise: higher by this, between LOWEST and HIGHEST [rad]; one that stood outside of them goes no further.
    """
    x, y, z = towards / np.linalg.norm(towards)
    height, round_ = math.asin(min(max(z, -1.0), 1.0)), math.atan2(y, x) + turn
    height = min(max(height + rise, min(LOWEST, height)), max(HIGHEST, height))
    return np.array([math.cos(height) * math.cos(round_), math.cos(height) * math.sin(round_), math.sin(height)])


def chromaticity(kelvin: float) -> tuple[float, float]:
    """CIE x and y of a black body at a temperature [K] from 1,000 to 15,000."""
    t = kelvin
    u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t**2) / (1.0 + 8.42420235e-4 * t + 7.08145163e-7 * t**2)
    v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t**2) / (1.0 - 2.89741816e-5 * t + 1.61456053e-7 * t**2)
    return 3.0 * u / (2.0 * u - 8.0 * v + 4.0), 2.0 * v / (2.0 * u - 8.0 * v + 4.0)


def colour_of(kelvin: float) -> Array:
    """What light of a temperature [K] multiplies a picture's red, green and blue by, next to DAYLIGHT; at most 1.

    Nothing is lit more than it was, since OpenGL cuts off what is lit more than fully. Renderers multiply colours as
    pictures hold them, so the ratio of the light is encoded as those are.
    """
    warm, plain = (_TO_RGB @ _bright(*chromaticity(one)) for one in (kelvin, DAYLIGHT))
    ratio = np.maximum(warm / plain, 0.0)
    return (ratio / ratio.max()) ** (1.0 / GAMMA)


def _bright(x: float, y: float) -> Array:
    """XYZ of a chromaticity whose Y is 1."""
    return np.array([x / y, 1.0, (1.0 - x - y) / y])
