"""What an object's mask and the depth around it say of a candidate that is drawn over them.

Each pixel around the mask judges it in units of log likelihood:

- in the mask, where the candidate is: (range drawn - range measured)^2 / (2 sigma^2), at most CAP;
- in the mask, where the candidate is not: CAP;
- outside, where the candidate is: CAP, unless something that is nearer hides it; less beside the mask's border and
  where depth cannot tell it from what is behind, since masks end a little early or late;
- where something hides the object: HIDDEN CAP for what the whole mask contradicts, if that is known;
- elsewhere: nothing.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from pat3d.vision.camera import Array, PlacedCamera
from pat3d.vision.observation import Observation

Ranges = NDArray[np.float32]
"""What is drawn: how far it is along the rays of a window [m], infinite where there is nothing; shape (pixels,)."""

CAP = 4.0
"""Cost of a pixel that contradicts the candidate: 2.8 standard deviations."""
MOST = 5
"""By how much more, where the mask fills little of its rectangle."""
LEAST_SIGMA = 0.002
"""Errors of the depth that are always reckoned with, over the depth [-]."""
BORDER = 2.5
"""Pixels beside a mask that may still be the object's."""
EXPLAINED = 0.02, 0.1
"""Cost beyond that of the noise up to which a candidate explains what is seen: without noise, and with it."""
HIDDEN = 0.5
"""Weight of pixels of which only a painted picture says whether the object is behind them."""
NOISY = 0.01
"""Noise of the depth over the depth, from which on the pixels between those of a window are averaged."""
UNSURE = 0.4
"""Weight of pixels outside the mask whose depth cannot tell what is drawn from what is there."""


class Window:
    """The pixels around a mask, with all that judges candidates."""

    def __init__(self, seen: Observation, camera: PlacedCamera, name: str, pixels: int) -> None:
        from scipy.ndimage import distance_transform_edt

        mask = seen.mask(name)
        rows, columns = np.nonzero(mask)
        whole = seen.whole.get(name)
        extent = np.nonzero(mask if whole is None else mask | whole)
        low, high = np.array([axis.min() for axis in extent]), np.array([axis.max() for axis in extent]) + 1
        margin = 4 + np.ceil(0.3 * (high - low)).astype(int)
        low, high = np.maximum(low - margin, 0), np.minimum(high + margin, mask.shape)
        area = float(np.prod(high - low))
        stride = max(1, round(math.sqrt(max(min(area / pixels, 2.0 * len(rows) / pixels), area / (MOST * pixels)))))
        # The first of the strided rows and columns lie half a stride inside, so that the grid is in the middle.
        grid = np.mgrid[low[0] + stride // 2 : high[0] : stride, low[1] + stride // 2 : high[1] : stride]
        row, column = grid.reshape(2, -1)
        self.own = mask[row, column]
        self.others = (seen.instances[row, column] > 0) & ~self.own
        self.whole = None if whole is None else whole[row, column]
        """Where the object would be seen if nothing hid it; None where nobody knows."""
        self.origin = camera.position
        self.rays, reach = camera.rays(column + 0.5, row + 0.5)
        known = seen.known[row, column]
        relative = max(seen.noise, LEAST_SIGMA)
        self.expected = 0.5 * (seen.noise / relative) ** 2
        """Cost of the true candidate, from the noise alone."""
        self.shift_free = False
        """Whether the depth of the object may be off by a common shift."""
        self.noisy = self.expected >= 0.05
        """Whether the noise may hide what tells candidates apart."""
        self.perfect = 0.0 if self.noisy else self.expected + 0.01
        """Cost from which on there is no need to look further; with noise, wrong candidates may seem as good."""
        self.explained = self.expected + EXPLAINED[self.noisy]
        """Cost from which on more candidates are looked at, and more closely."""
        self.range = np.where(known, seen.depth[row, column] * reach, np.nan)
        self.sigma = relative * np.where(known, self.range, 1.0)
        calm = self.sigma * (1.0 if seen.noise < NOISY else 0.35)
        self.calm = 2.0 * calm
        if stride > 1 and seen.noise >= NOISY:
            mean, count = _means(seen, mask, low, high, stride)
            self.range = np.where(known & self.own, mean[row - low[0], column - low[1]] * reach, self.range)
            less = np.sqrt(np.maximum(count[row - low[0], column - low[1]], 1.0))
            self.sigma = np.where(self.own, self.sigma * np.maximum(1.0 / less, LEAST_SIGMA / relative), self.sigma)
        self.smooth = np.where(known, seen.smooth_depth[row, column] * reach, np.nan)
        crop = tuple(slice(max(int(one) - 8, 0), int(other) + 8) for one, other in zip(low, high, strict=True))
        away = np.asarray(distance_transform_edt(~mask[crop]))[row - crop[0].start, column - crop[1].start]
        self.beside = np.where(away <= BORDER, 0.5, 1.0)
        self.count = max(int(self.own.sum()), 1)
        self.middle = camera.rays([columns.mean() + 0.5], [rows.mean() + 0.5])[0][0]
        right, down = camera.rotation[:, 0], camera.rotation[:, 1]
        self.right, self.down = right, down
        distances = self.range[self.own & known]
        self.distance = float(np.median(distances)) if len(distances) else float(np.nanmedian(self.range))
        self.angle = math.sqrt(len(rows)) / seen.camera.fx
        """About how wide the mask is [rad]."""

    def cost(self, drawn: Ranges, blur: float = 1.0) -> float:
        """Mean cost of what is drawn: ranges [m] of the window's pixels, infinite where there is nothing."""
        hit = np.isfinite(drawn)
        inside = self.own & hit
        error = drawn[inside] - self.range[inside]
        if self.shift_free and np.isfinite(error).any():
            error -= np.nanmedian(error)
        total = float(np.nansum(np.minimum(0.5 * (error / (blur * self.sigma[inside])) ** 2, CAP)))
        total += CAP * float(np.count_nonzero(self.own & ~hit))
        outside = ~self.own & hit
        contradicted = self.contradicted(drawn)
        total += CAP * float(np.sum((self.beside * contradicted)[outside]))
        if self.whole is not None:
            missing = self.whole & ~self.own & ~hit
            beyond = outside & ~self.whole & (contradicted == 0.0)
            total += HIDDEN * CAP * float(np.count_nonzero(missing) + np.count_nonzero(beyond))
        return total / self.count

    def contradicted(self, drawn: Ranges) -> Array:
        """How surely something would be seen at the range that is drawn [-], by pixel."""
        with np.errstate(invalid="ignore"):
            nearer = drawn - self.smooth
            free = np.where(nearer > self.calm, 0.0, np.where(nearer > -self.calm, UNSURE, 1.0))
            # Where another object is seen, what touches it from behind is where it should be.
            free = np.where(self.others, np.clip(-nearer / self.calm, 0.0, 1.0), free)
        return np.where(np.isfinite(self.smooth), free, UNSURE)

    def overlap(self, drawn: Ranges) -> float:
        """Intersection over union with the mask, of pixels in which nothing nearer hides what is drawn."""
        hit = np.isfinite(drawn)
        both = np.count_nonzero(self.own & hit)
        either = np.count_nonzero(self.own | (hit & (self.contradicted(drawn) > 0.0)))
        return both / max(either, 1)


def _means(seen: Observation, mask: NDArray[np.bool_], low: Array, high: Array, stride: int) -> tuple[Array, Array]:
    """Mean depth [m] of an object's pixels around each, and their number, from rows and columns `low` to `high`."""
    from scipy.ndimage import uniform_filter

    crop = (slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1])))
    own = mask[crop] & seen.known[crop]
    share = uniform_filter(own.astype(np.float64), size=stride, mode="constant")
    total = uniform_filter(np.where(own, seen.depth[crop], 0.0).astype(np.float64), size=stride, mode="constant")
    return total / np.maximum(share, 1e-9), np.round(share * stride**2)
