"""How a scene came to rest, frame by frame, and how its layout was optimised."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.pose import Pose
from pat3d.scene.folder import read_json, read_trajectory
from pat3d.studio.session import Session

MAX_FRAMES = 2000
"""Of a recording that is shown; of a longer one, every second, third ... frame."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Timeline:
    """The motion of a scene while it settled."""

    names: tuple[str, ...]
    states: NDArray[np.float32]
    """Centre of mass [m] and columns of the linear map, the rest last, shape (frames, objects, 4, 3)."""
    centres: NDArray[np.float64]
    """Centres of mass in the frames of the assets [m], shape (objects, 3)."""

    def __len__(self) -> int:
        return len(self.states)

    def poses(self, frame: int) -> dict[str, Pose]:
        """Of every object in a frame, by name."""
        states = self.states[frame].astype(np.float64)
        return {
            name: Pose.from_affine(state[1:].T, state[0], centre)
            for name, state, centre in zip(self.names, states, self.centres, strict=True)
        }

    def farthest(self) -> NDArray[np.float64]:
        """Largest distance of any centre of mass from where it is at rest, of every frame [mm], shape (frames,)."""
        away = self.states[:, :, 0].astype(np.float64) - self.states[-1, :, 0]
        return 1e3 * np.linalg.norm(away, axis=2).max(axis=1)


def timeline_of(session: Session) -> Timeline | None:
    """How the session's scene settled last; None where edits wait or nothing was recorded."""
    if not session.at_rest:
        return None
    names = tuple(obj.name for obj in session.scene.objects)
    verified = session.current.verified
    if verified is not None:
        return _checked(names, verified.settled.states, verified.settled.centres)
    found = read_trajectory(session.current.folder / "trajectory.npz")
    if found is None or tuple(map(str, np.atleast_1d(found["names"]))) != names:
        return None
    return _checked(names, found["states"], found["centres"])


def losses(session: Session) -> Sequence[tuple[int, float]]:
    """Loss [m^2] of every gradient step of the layout's optimisation; empty where there was none."""
    record = read_json(session.current.folder / "report.json").get("optimisation")
    history = record.get("history") if isinstance(record, Mapping) else None
    found = [one.get("loss") if isinstance(one, Mapping) else None for one in history or ()]
    return [(step, float(loss)) for step, loss in enumerate(found) if isinstance(loss, int | float)]


def _checked(names: tuple[str, ...], states: Any, centres: Any) -> Timeline | None:
    """A timeline of arrays that may have been read from a damaged file."""
    shape = np.shape(states)
    if len(shape) != 4 or shape[0] < 2 or shape[1:] != (len(names), 4, 3) or np.shape(centres) != (len(names), 3):
        return None
    if not (np.isfinite(states).all() and np.isfinite(centres).all()):
        return None
    # The last frame is the rest, whatever is left out before it.
    step = -(-shape[0] // MAX_FRAMES)
    return Timeline(names=names, states=np.asarray(states)[::-1][::step][::-1], centres=np.asarray(centres))
