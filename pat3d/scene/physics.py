"""Constants of the physics that every stage and every export share."""

from __future__ import annotations

import math

GRAVITY = 9.81
"""Along -z [m/s^2]."""

SETTLING_FRICTION = 0.2
"""Coulomb coefficient [-] of every contact while settling, unless a scene says otherwise (paper, Section 5)."""

GROUND_FRICTION = 0.4
"""Coulomb coefficient [-] of the ground in exports, at least; with MuJoCo's rule, the least of anything on it."""

LIGHTEST, HEAVIEST = 1e-5, 1e5
"""Masses [kg] that can be settled and verified: lighter things never come to rest to the tolerances that a scene is
held to, heavier ones sink through what carries them."""

LEAST_PUSH = 0.01
"""Sideways push on every object, as a share of its weight, that a verified scene stands unless it is asked for more:
ten times what may be unbalanced. Tilting the ground by 0.57 degrees is such a push."""

LEAST_TILT = math.degrees(math.atan(LEAST_PUSH))
"""[degrees]"""

MAX_TILT = 8.0
"""Tilt of the ground [degrees] beyond which nobody asks."""

STILL_SECONDS = 5.0
"""Simulated time that a scene has to keep still in another engine [s]."""


def ground_friction(settling_friction: float) -> float:
    """Coulomb coefficient [-] of the ground under a scene that settled with `settling_friction`."""
    return max(GROUND_FRICTION, settling_friction)
