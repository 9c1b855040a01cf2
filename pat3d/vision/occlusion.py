"""Which object of a picture is hidden least: its size tells more of the scene's than any other's (paper, Sec. 3).

A vision-language model says so, and its answer counts while the drawn fits do not contradict it; where nobody says,
they decide.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.vision.camera import PlacedCamera
from pat3d.vision.drawing import draw
from pat3d.vision.fitting import Fit
from pat3d.vision.observation import Observation

BELIEVED = 0.7
"""Of the share that is visible of the most visible object, what has to be visible of the one that is said."""
DOUBTFUL = 1.6
"""Factor between the size that is said and the one that the depth makes, from which on a note says so."""


class Fitted(Protocol):
    """Objects that were fitted to a picture, see `pat3d.vision.recover.Recovered`."""

    @property
    def camera(self) -> PlacedCamera:
        """In the scene's frame."""
        ...

    @property
    def fits(self) -> Mapping[str, Fit]:
        """Of every object."""
        ...

    def sized(self, name: str) -> Asset:
        """The asset of an object at its fitted size."""
        ...


def visible_share(found: Fitted, seen: Observation, name: str) -> float:
    """Share of the drawn object's pixels that its mask shows, less what the picture's border cuts off [-]."""
    placed, visual = found.fits[name].placed, found.sized(name).visual
    pose = Pose.from_matrix(placed.rotation, placed.position)
    drawn = draw([(visual, pose)], found.camera)[1] > 0
    shown = np.count_nonzero(drawn & seen.mask(name)) / max(np.count_nonzero(drawn), 1)
    at, depth = found.camera.project(pose.apply(visual.vertices))
    size = np.array([seen.camera.width, seen.camera.height])
    inside = (depth > 0.0) & np.all((at >= 0.0) & (at <= size), axis=1)
    return float(shown * inside.mean())


def least_occluded(
    found: Fitted, seen: Observation, among: Mapping[str, float], said: str | None
) -> tuple[str, str]:
    """Name of the least occluded object of `among`, and who decides it: "said" or "measured".

    Args:
        found: the fitted objects.
        seen: the picture.
        among: at least one object; the values do not matter.
        said: what somebody says it is; None where nobody does.
    """
    shares = {name: visible_share(found, seen, name) for name in among}
    if said in shares and shares[said] >= BELIEVED * max(shares.values()):
        return said, "said"
    # Of what is fully seen, that which is seen large.
    return max(shares, key=lambda one: shares[one] * float(seen.mask(one).sum()) ** 0.5), "measured"


def doubt_of_size(found: Fitted, name: str, size: float) -> str | None:
    """A note where the fitted length of object `name` and its `size` [m], as said, differ much; else None."""
    own = float(found.sized(name).size.max())
    if 1.0 / DOUBTFUL < own / size < DOUBTFUL:
        return None
    return (
        f'the depth makes "{name}", the least occluded object, {own:.2g} m long, the labels say {size:.2g} m; is the '
        "depth metric, and the camera's angle right?"
    )
