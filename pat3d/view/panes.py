"""What is seen through: the surfaces of see-through items before the first solid one, and what they add to a pixel.

Surfaces that face the eye have the opacity of their item; those that are seen from behind only show where they are
seen from the side, as the edges of glass do. Nothing is refracted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.view.geometry import Geometry, Hits
from pat3d.view.light import Studio

Array = NDArray[np.float32]

SHADE = 0.35
"""How dark the shadow of a see-through item is, against that of a solid one."""
_MOST = 24
"""Surfaces that a ray passes, at most."""
_STEP = 5e-5
"""How far behind a surface a ray goes on, over the radius of the picture's contents."""
_EDGE = 0.6
"""Opacity of a surface that is seen from the side."""
_TINT = 0.25
"""Share of its own colour that a surface gives to what is behind it."""


@dataclass(frozen=True, eq=False)
class Pane:
    """One see-through surface on each of k rays."""

    which: NDArray[np.int64]
    """Indices of the rays, shape (k,)."""
    ray: Array
    """View directions, shape (k, 3)."""
    normal: Array
    """Shading normals on the viewer's side, shape (k, 3)."""
    colour: Array
    """Linear RGB, shape (k, 3)."""
    opacity: Array
    """Seen straight on [-], 0 from behind, shape (k,)."""

    def over(self, behind: Array, studio: Studio) -> None:
        """Put this before `behind`, the light of every ray of the picture, linear RGB, shape (n, 3)."""
        facing = np.clip(-np.einsum("ij,ij->i", self.normal, self.ray), 0.0, 1.0)
        opacity = (self.opacity + (1.0 - self.opacity) * _EDGE * (1.0 - facing) ** 3)[:, None]
        key = np.maximum(self.normal @ studio.key_direction, 0.0)[:, None] * studio.key
        fill = np.maximum(0.25 + 0.75 * (self.normal @ studio.fill_direction), 0.0)[:, None] * studio.fill
        half = studio.key_direction - self.ray
        half /= np.linalg.norm(half, axis=1)[:, None]
        glint = 0.5 * np.maximum(np.einsum("ij,ij->i", self.normal, half), 0.0) ** 160
        mirror = 0.02 + 0.25 * (1.0 - facing) ** 5
        own = self.colour * (studio.open_sky + key + fill)
        through = (1.0 - opacity) * (1.0 - _TINT + _TINT * self.colour)
        gloss = mirror[:, None] * studio.open_sky + glint[:, None] * studio.key
        behind[self.which] = behind[self.which] * through + own * opacity + gloss


def peeled(geometry: Geometry, eye: Array, rays: Array, pixel: float) -> tuple[Hits, tuple[Pane, ...]]:
    """The first solid hits of rays from `eye`, and the see-through surfaces before them, the nearest first.

    Args:
        geometry: what is drawn.
        eye: [m], shape (3,).
        rays: unit vectors, shape (n, 3).
        pixel: angle between neighbouring rays [rad].
    """
    hits = geometry.trace(eye, rays, pixel)
    if not geometry.see_through:
        return hits, ()
    solid, panes = [], []
    step = np.float32(_STEP * geometry.radius)
    for _ in range(_MOST):
        clear = geometry.opacity[hits.item] < 1.0
        solid.append(hits.only(~clear))
        if not clear.any():
            break
        front = hits.only(clear)
        onward = rays[front.which]
        opacity = np.where(front.outer, geometry.opacity[front.item], np.float32(0.0))
        panes.append(Pane(front.which, onward, front.normal, front.colour, opacity))
        start = (front.point + step * onward).astype(np.float32, copy=False)
        hits = geometry.trace(start, onward, pixel).behind(front, step)
    return Hits.together(solid), tuple(panes)
