"""What a policy's actions mean, found by comparing them with actions that are known to be right in the same states.

Each part of an action is explained by readings of the right action: as it is, with the gripper flipped, the rotation
as Euler angles or in degrees, in the frame of the hand, of the world or of the camera, in other units; of joints, as
their positions, in degrees, or the other way round. A reading other
than "as it is" that explains a policy much better is what is connected wrongly. Where no reading explains it, nothing
is said about it: an untrained policy has no wrong convention.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EXPLAINED = 0.5
"""Least share of a part's values that a reading has to explain before it is believed."""

CERTAIN = 10.0
"""By so much a reading has to be more likely than the right one (logarithm of the ratio of likelihoods)."""

FLOOR = 1e-4
"""Residuals below this are rounding [action]."""

FAR_OUT = 1.5
"""Values beyond this are no slip of a regression [action]."""

OFTEN = 0.1
"""Share of actions."""

SMALL = 1e-3
"""Actions below this say nothing about their meaning."""


@dataclass(frozen=True, kw_only=True)
class Compared:
    """Actions of one arm, of a policy and right ones, in the same states."""

    given: Array
    """The policy's, before anything is clipped, shape (n, size): position, rotation, gripper; or joints, gripper."""
    right: Array
    """The right ones, in [-1, 1], of the same shape."""
    frames: dict[str, Array]
    """Orientation of other frames in that of the base, shape (n, 3, 3) each; of no use for joints."""
    scale: tuple[float, ...]
    """What an action of 1 asks for [m], [rad]; of joints [rad] or [rad/s]."""
    joints: Array | None = None
    """Positions of joints that the right actions lead to [rad], shape (n, size - 1); None for control of the hand."""
    velocity: bool = False
    """Whether the right actions are velocities of joints."""
    rate: float = 20.0
    """Actions a second."""

    @property
    def parts(self) -> dict[str, slice]:
        """Where the parts of an action are."""
        last = self.right.shape[1] - 1
        if self.joints is not None:
            return {"joints": slice(0, last), "gripper": slice(last, last + 1)}
        return {"position": slice(0, 3), "rotation": slice(3, 6), "gripper": slice(6, 7)}


@dataclass(frozen=True, kw_only=True)
class Finding:
    """Something that looks wrong."""

    part: str
    """"position", "rotation", "joints" or "gripper"."""
    fault: str
    """What it looks like: "flipped", "euler", "degrees", "hand frame", ..."""
    text: str
    """For people, with what would be right."""


Reading = tuple[str, str, Array]
"""Fault, how to tell of it, and the actions that the right ones would then be."""


def examine(compared: Compared) -> list[Finding]:
    """What looks wrong with a policy's actions; nothing where they are as they should be, or like nothing known."""
    found = [
        finding
        for name, part in compared.parts.items()
        for finding in _part(name, compared.given[:, part], compared.right[:, part], _READINGS[name](compared))
    ]
    parts = {one.part for one in found}
    for part, place in compared.parts.items():
        given = np.abs(compared.given[:, place])
        own = (given > FAR_OUT).any(axis=1)
        if part not in parts and own.mean() > OFTEN:
            found.append(
                Finding(
                    part=part,
                    fault="range",
                    text=f"{part}: {100 * own.mean():.0f} % of the actions are beyond {FAR_OUT:g}, up to "
                    f"{given.max():.3g}; actions are in [-1, 1]. Is the policy's "
                    "output still to be normalised by this suite's scales?",
                )
            )
    return found


def resemblance(compared: Compared) -> dict[str, float]:
    """Share of each part's values that the right actions explain as they are; 1 for the right actions themselves."""
    return {name: _explained(compared.given[:, part], compared.right[:, part]) for name, part in compared.parts.items()}


def _part(name: str, given: Array, right: Array, readings: Sequence[Reading]) -> list[Finding]:
    """The reading that explains `given` far better than `right` does, where one does."""
    telling = np.abs(right).max(axis=1) > SMALL
    if not telling.any():
        return []
    plain = _residual(given[telling], right[telling])
    best, most = None, CERTAIN
    for reading in readings:
        meant = reading[2][telling]
        if _explained(given[telling], meant) < EXPLAINED:
            continue
        gain = 0.5 * given[telling].size * math.log(plain / _residual(given[telling], meant))
        if gain > most:
            best, most = reading, gain
    return [] if best is None else [Finding(part=name, fault=best[0], text=f"{name}: {best[1]}")]


def _residual(given: Array, meant: Array) -> float:
    """Mean of squares, with what was cut off at 1 compared with what was cut off."""
    cut = np.where(np.abs(given) <= 1.0, np.clip(meant, -1.0, 1.0), meant)
    return float(np.mean((given - cut) ** 2)) + FLOOR**2


def _explained(given: Array, meant: Array) -> float:
    spread = float(np.mean(given**2))
    return 0.0 if spread < SMALL**2 else 1.0 - _residual(given, meant) / spread


def _turned(frames: Array, vectors: Array) -> Array:
    """Vectors of the base in other frames, shape (n, 3)."""
    return np.einsum("nji,nj->ni", frames, vectors)


def _framed(compared: Compared, part: slice, base: str) -> list[Reading]:
    right = compared.right[:, part]
    return [
        (f"{name} frame", f"in the frame of the {name}; {base}", _turned(frames, right))
        for name, frames in compared.frames.items()
    ]


def _positions(compared: Compared) -> list[Reading]:
    right, largest = compared.right[:, :3], compared.scale[0]
    told = f"an action of 1 is {100 * largest:g} cm in the frame of the robot's base"
    units: Sequence[tuple[str, float]] = (("metres", 1.0), ("centimetres", 100.0), ("millimetres", 1000.0))
    return [
        *_framed(compared, slice(0, 3), told),
        *((unit, f"in {unit}; {told}", right * largest * factor) for unit, factor in units),
        ("opposite", f"the other way round; {told}", -right),
        ("x and y", f"x and y look exchanged; {told}", right[:, [1, 0, 2]]),
    ]


def _rotations(compared: Compared) -> list[Reading]:
    from scipy.spatial.transform import Rotation

    right, largest = compared.right[:, 3:6], compared.scale[1]
    told = f"a rotation vector in the frame of the robot's base, of which 1 is {largest:g} rad"
    turns = Rotation.from_rotvec(right * largest)
    readings = [
        *_framed(compared, slice(3, 6), told),
        ("radians", f"in radians, not divided by the scale; right is {told}", right * largest),
        ("degrees", f"in degrees; right is {told}", np.degrees(right * largest)),
        ("opposite", f"the other way round; right is {told}", -right),
    ]
    for order in ("xyz", "XYZ", "zyx"):
        readings.append(("euler", f"Euler angles ({order}); right is {told}", turns.as_euler(order) / largest))
    return readings


def _grippers(compared: Compared) -> list[Reading]:
    right = compared.right[:, -1:]
    told = "positive closes, negative opens"
    return [
        ("flipped", f"flipped; {told}", -right),
        ("0 to 1, closed", f"from 0 (open) to 1 (closed); here {told}, and 0 holds still", (right + 1.0) / 2.0),
        ("0 to 1, open", f"from 0 (closed) to 1 (open); here {told}, and 0 holds still", (1.0 - right) / 2.0),
    ]


def _joints(compared: Compared) -> list[Reading]:
    right, largest, reached = compared.right[:, :-1], compared.scale[0], compared.joints
    if reached is None:
        return []
    told = f"a change of every joint's position, of which 1 is {largest:g} rad"
    other, way = ("velocities in rad/s", right * largest * compared.rate), "velocities"
    if compared.velocity:
        told = f"a velocity of every joint, of which 1 is {largest:g} rad/s"
        other, way = ("changes of position in rad", right * largest / compared.rate), "changes"
    return [
        ("positions", f"positions of the joints in rad; right is {told}", reached),
        ("positions in degrees", f"positions of the joints in degrees; right is {told}", np.degrees(reached)),
        ("radians", f"not divided by the scale; right is {told}", right * largest),
        ("degrees", f"in degrees; right is {told}", np.degrees(right * largest)),
        (way, f"{other[0]}; right is {told}", other[1]),
        ("opposite", f"the other way round; right is {told}", -right),
        ("order", f"in the opposite order of the joints; right is {told}", right[:, ::-1]),
    ]


_READINGS: dict[str, Callable[[Compared], list[Reading]]] = {
    "position": _positions,
    "rotation": _rotations,
    "gripper": _grippers,
    "joints": _joints,
}
