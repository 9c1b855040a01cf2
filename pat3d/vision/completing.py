"""Objects that others hide in part, made whole: what hides them is painted away, and they are looked for again.

The paper takes relative sizes from the boxes of inpainted objects. Here the whole mask counts in the fit: hidden pixels
in it speak for a candidate that is there, and hidden pixels outside of it against one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pat3d.progress import Event, Progress, silent
from pat3d.vision.detection import Finder
from pat3d.vision.finding import sought_of
from pat3d.vision.observation import Observation
from pat3d.vision.painting import Painter

AROUND = 1.0
"""How far around a mask it is painted, over the larger side of its rectangle."""
COVERED = 0.1
"""Share of a mask's border that something nearer has to take for the object to be hidden in part."""
KNOWN = 0.7
"""Share of the visible mask that the whole one has to hold."""


def completed(
    seen: Observation, painter: Painter, finder: Finder, *, progress: Progress = silent
) -> tuple[Observation, list[str]]:
    """`seen` with the whole masks of the objects that others hide in part, and notes of those that stay as they are.

    Raises:
        ModelError: a model gives no valid answer.
    """
    if seen.picture is None:
        return seen, []
    wholes: dict[str, NDArray[np.bool_]] = {}
    notes: list[str] = []
    for name in seen.names:
        crop, hidden = _hidden(seen, name)
        if hidden is None:
            continue
        progress(Event(stage="painting what is hidden", detail=name))
        phrase = sought_of([name])[0].phrase
        own = seen.mask(name)[crop]
        painted = painter.completed(np.ascontiguousarray(seen.picture[crop]), hidden, phrase)
        offers = [one.mask for one in finder.find(painted, phrase)]
        offers = [one for one in offers if np.count_nonzero(one & own) >= KNOWN * np.count_nonzero(own)]
        if not offers:
            notes.append(f'"{name}" is hidden in part, and is not found in what was painted of it.')
            continue
        # Of several, the one that says least beside what is seen: no table with the cup on it.
        best = min(offers, key=lambda one: np.count_nonzero(one & ~own))
        whole = np.zeros(seen.instances.shape, dtype=bool)
        whole[crop] = own | (best & hidden)
        wholes[name] = whole
    return replace(seen, whole=wholes), notes


def _hidden(seen: Observation, name: str) -> tuple[tuple[slice, slice], NDArray[np.bool_] | None]:
    """The part of the picture around an object, and in it the pixels of nearer ones; None where these hide little."""
    from scipy.ndimage import binary_dilation

    mask = seen.mask(name)
    rows, columns = np.nonzero(mask)
    margin = 4 + int(AROUND * max(np.ptp(rows), np.ptp(columns)))
    crop = (
        slice(max(int(rows.min()) - margin, 0), int(rows.max()) + 1 + margin),
        slice(max(int(columns.min()) - margin, 0), int(columns.max()) + 1 + margin),
    )
    own = mask[crop]
    nearer = seen.smooth_depth[crop] < np.nanmedian(seen.depth[mask & seen.known])
    hidden = (seen.instances[crop] > 0) & ~own & nearer
    border = np.asarray(binary_dilation(own, iterations=2), dtype=np.bool_) & ~own
    if np.count_nonzero(hidden & border) < COVERED * np.count_nonzero(border):
        return crop, None
    return crop, hidden
