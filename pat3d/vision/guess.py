"""A candidate for what a mask shows: where, how far, how large and how turned an asset is; and how it comes nearer.

Gauss and Newton's method needs few drawings to bring what is nearly right to the least squares of its ranges:

    r_k = (range drawn - range measured) / sigma      of the pixels k that candidate and mask share,
    x <- x - (J^T J + lambda diag(J^T J))^-1 J^T r,   J = dr/dx by differences.

Outlines have no part in r; so a step is taken only where it makes the whole cost less.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from pat3d.vision.camera import Array
from pat3d.vision.caster import Caster, Placement, orientation
from pat3d.vision.window import Window

ITERATIONS = 8
DIFFERENCE = 1e-3
"""Of the parameters, for J; a unit is what the simplex method begins with."""
DAMPING = 1e-4
"""lambda [-]."""
OUTLIERS = 4.0
"""Standard deviations beyond which a pixel shows something else."""
STEEP = 3.0
"""A pixel whose range changes by this factor more than that of nearly all is on an edge."""
SHORTEST, SHORTER = 0.1, 0.4
"""Steps are shortened by the second until the cost is less, down to the first."""
LEAST_GAIN = 1e-5, 1e-3
"""That another step has to bring: of cost, and over the cost."""


@dataclass(frozen=True, eq=False)
class Guess:
    """Direction and distance of the middle, the angle that is filled, and the turn."""

    across: float
    """Tangents of the direction, from the middle of the mask, to the right and down [-]."""
    down: float
    distance: float
    """Of the middle of the bounding box [m]."""
    fills: float
    """Radius over distance [-]."""
    yaw: float
    pitch: float = 0.0
    roll: float = 0.0
    first: Array | None = None
    """How the asset is turned before, shape (3, 3); None where it stands as it was made."""

    base: float | None = None
    """Height of the lowest point [m], from which the distance follows; None where it is free."""

    def placed(self, window: Window, caster: Caster) -> Placement:
        """Where the asset is."""
        ray = window.middle + self.across * window.right + self.down * window.down
        ray /= np.linalg.norm(ray)
        rotation = orientation(self.yaw, self.pitch, self.roll)
        rotation = rotation if self.first is None else rotation @ self.first
        distance = self.distance
        if self.base is not None:
            sinks = ray[2] - self.fills * caster.half_height(rotation)
            reached = (self.base - window.origin[2]) / sinks if sinks < -1e-3 else distance
            distance = min(max(reached, 0.5 * distance), 2.0 * distance)
        centre = window.origin + distance * ray
        scale = self.fills * distance / caster.radius
        return Placement(scale=scale, rotation=rotation, position=centre - scale * rotation @ caster.centre)

    def freedom(self, *, leans: bool) -> int:
        """How many parameters can be changed."""
        return 4 + (self.base is None) + 2 * leans

    def moved(self, values: Array, *, leans: bool) -> Guess:
        """The guess whose parameters differ by `values`, in units of what may be wrong with a first guess [-]."""
        free = iter(values)
        across, down, fills, yaw = (float(next(free)) for _ in range(4))
        distance = float(next(free)) if self.base is None else 0.0
        pitch, roll = (float(next(free)) for _ in range(2)) if leans else (0.0, 0.0)
        return replace(
            self,
            across=self.across + 0.08 * self.fills * across,
            down=self.down + 0.08 * self.fills * down,
            distance=self.distance * math.exp(min(max(0.1 * self.fills * distance, -1.0), 1.0)),
            fills=self.fills * math.exp(min(max(0.06 * fills, -1.0), 1.0)),
            yaw=self.yaw + 0.15 * yaw,
            pitch=self.pitch + 0.25 * pitch,
            roll=self.roll + 0.25 * roll,
        )

    def cost(self, window: Window, caster: Caster, blur: float = 1.0) -> float:
        """What `window` says of it."""
        return window.cost(caster.ranges(window.origin, window.rays, self.placed(window, caster)), blur)


def polished(
    window: Window, caster: Caster, guess: Guess, *, leans: bool = False, blur: float = 1.0
) -> tuple[Guess, float]:
    """`guess` at the least squares of its ranges, as far as that makes the cost less; and its cost."""

    def drawn(one: Guess) -> Array:
        return caster.ranges(window.origin, window.rays, one.placed(window, caster)).astype(np.float64)

    ranges = drawn(guess)
    cost = window.cost(ranges.astype(np.float32), blur)
    size = guess.freedom(leans=leans)
    sigma = blur * window.sigma
    for _ in range(ITERATIONS):
        aside = [drawn(guess.moved(DIFFERENCE * unit, leans=leans)) for unit in np.eye(size)]
        with np.errstate(invalid="ignore"):
            slopes = (np.stack(aside, axis=1) - ranges[:, None]) / DIFFERENCE
            error = ranges - window.range
            near = window.own & np.isfinite(slopes).all(axis=1) & (np.abs(error) < OUTLIERS * sigma)
        if np.count_nonzero(near) < size + 3:
            break
        usual = np.quantile(np.abs(slopes[near]), 0.98, axis=0)
        near[near] = (np.abs(slopes[near]) <= STEEP * usual + 1e-9).all(axis=1)
        weighted = slopes[near] / sigma[near, None]
        normal = weighted.T @ weighted
        damped = normal + np.diag(DAMPING * normal.diagonal() + 1e-9 * normal.max() + 1e-12)
        step = -np.asarray(np.linalg.solve(damped, weighted.T @ (error[near] / sigma[near])), dtype=np.float64)
        length, better = 1.0, False
        while length > SHORTEST and not better:
            other = guess.moved(length * step, leans=leans)
            there = drawn(other)
            less = window.cost(there.astype(np.float32), blur)
            better = less < cost - max(LEAST_GAIN[0], LEAST_GAIN[1] * cost)
            length *= SHORTER
        if not better:
            break
        guess, ranges, cost = other, there, less
    return guess, cost
