"""What is seen: a picture with the depth of its pixels and, for each, the object that it shows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SpecError
from pat3d.vision.camera import Pinhole

NEAREST, FARTHEST = 0.02, 100.0
"""Depths that are believed [m]."""
LEAST_PIXELS = 40
"""A mask of fewer shows nothing that could be measured."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Observation:
    """A picture, measured."""

    camera: Pinhole
    depth: NDArray[np.float32]
    """Along the optical axis [m], NaN where it is not known, shape (height, width)."""
    instances: NDArray[np.int32]
    """1 + index of the object that a pixel shows, 0 for anything else, shape (height, width)."""
    names: tuple[str, ...]
    """Of the objects, in the order of their indices."""
    picture: NDArray[np.uint8] | None = None
    """RGB, shape (height, width, 3)."""
    whole: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)
    """Masks as they would be if nothing hid the object, of objects of which that is known; shape (height, width)."""

    def __post_init__(self) -> None:
        shape = (self.camera.height, self.camera.width)
        for what, array in (("depth", self.depth), ("masks", self.instances)):
            if array.shape != shape:
                raise SpecError(
                    f"the {what} have {array.shape[::-1]} pixels, the camera's picture {shape[::-1]}; give all of one "
                    "size."
                )
        if self.picture is not None and self.picture.shape != (*shape, 3):
            raise SpecError(f"the picture has shape {self.picture.shape}, where {(*shape, 3)} was expected.")
        if not self.names:
            raise SpecError("there is no object in the picture.")
        counts = np.bincount(np.clip(self.instances, 0, len(self.names) + 1).ravel(), minlength=len(self.names) + 2)
        if self.instances.min() < 0 or counts[-1]:
            raise SpecError(f"the masks name object {self.instances.max()}; there are {len(self.names)}.")
        known = self.known
        for number, name in enumerate(self.names, start=1):
            if counts[number] < LEAST_PIXELS:
                raise SpecError(
                    f'the mask of "{name}" has {counts[number]} pixels; at least {LEAST_PIXELS} are needed.'
                )
            share = float(known[self.instances == number].mean())
            if share < 0.1:
                raise SpecError(
                    f'{share:.0%} of the pixels of "{name}" have a depth between {NEAREST} and {FARTHEST:g} m; at '
                    "least 10 % are needed. Is the depth in metres?"
                )

    @cached_property
    def known(self) -> NDArray[np.bool_]:
        """Where the depth is known, shape (height, width)."""
        with np.errstate(invalid="ignore"):
            return np.isfinite(self.depth) & (self.depth > NEAREST) & (self.depth < FARTHEST)

    def mask(self, name: str) -> NDArray[np.bool_]:
        """The pixels that show object `name`, shape (height, width)."""
        return self.instances == 1 + self.names.index(name)

    @cached_property
    def noise(self) -> float:
        """Standard deviation of the depth over the depth, as neighbouring pixels of one object disagree [-]."""
        found = []
        for axis in (0, 1):
            first, middle, last = (_along(self.depth, axis, shift) for shift in range(3))
            same = _along(self.instances, axis, 0)
            inside = (same > 0) & (same == _along(self.instances, axis, 1)) & (same == _along(self.instances, axis, 2))
            inside &= np.logical_and.reduce([_along(self.known, axis, shift) for shift in range(3)])
            # A second difference of independent errors has the square root of 1 + 4 + 1 times their deviation.
            found.append(((first - 2.0 * middle + last)[inside] / middle[inside]) / np.sqrt(6.0))
        bends = np.abs(np.concatenate(found))
        return float(1.4826 * np.median(bends)) if len(bends) else 0.0

    @cached_property
    def smooth_depth(self) -> NDArray[np.float32]:
        """Depth without the noise of single pixels [m], NaN where it is not known, shape (height, width)."""
        if self.noise < 0.01:
            return np.where(self.known, self.depth, np.nan).astype(np.float32)
        from scipy.ndimage import median_filter

        filled = np.where(self.known, self.depth, FARTHEST).astype(np.float32)
        return np.where(self.known, median_filter(filled, size=5), np.nan).astype(np.float32)


def _along(array: NDArray, axis: int, shift: int) -> NDArray:
    """`array` from `shift` on along `axis`, two shorter."""
    length = array.shape[axis] - 2
    return np.take(array, range(shift, shift + length), axis=axis)
