"""What URDF and SDF share beyond XML: links gathered into one rigid object."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Body, Inertial, Piece, Points, merged
from pat3d.assets.library.readers.collision import hulls_of
from pat3d.assets.library.readers.inertials import together
from pat3d.assets.library.readers.xml import inertia_of, numbers
from pat3d.errors import AssetError

Frame = tuple[Points, Points]
"""Rotation, shape (3, 3), and position [m], shape (3,)."""


@dataclass(kw_only=True)
class Links:
    """What was found at the links so far."""

    seen: list[Piece] = field(default_factory=list)
    touched: list[Piece] = field(default_factory=list)
    """Of the collision shapes."""
    inertials: list[Inertial] = field(default_factory=list)
    frictions: list[float] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    alike: bool = True
    """Whether the collision shapes are what is seen."""

    def weigh(self, mass: str | None, frame: Frame, tensor: ET.Element | None, get: Callable) -> None:
        """Add the mass of a link, whose own frame is `frame`; one of nothing is none."""
        if mass is None or (value := float(numbers(mass, 1)[0])) <= 0:
            return
        rotation, position = frame
        found = inertia_of(tensor, get)
        inertia = None if found is None else rotation @ found @ rotation.T
        self.inertials.append(Inertial(mass=value, centre=position, inertia=inertia))

    def body(self, name: str, path: Path, declared: str, *, convex: bool) -> Body:
        """The object: metres, z up.

        Args:
            name: of it.
            path: of the description.
            declared: the format, in words.
            convex: whether the collision shapes may be taken for convex parts, not what is seen.
        """
        hulls: tuple[Points, ...] = ()
        if self.touched and convex:
            hulls, note = hulls_of(self.touched)
            self.notes += [note] if note else []
        mesh = merged(self.seen or self.touched, self.notes)
        return Body(
            name=name,
            mesh=mesh,
            hulls=hulls,
            touched=tuple(self.touched),
            metres=1.0,
            up="z",
            declared=declared,
            inertial=together(self.inertials),
            friction=self.frictions[0] if self.frictions else None,
            files=(path, *mesh.files, *(file for piece in self.touched for file in piece.files)),
            notes=tuple(self.notes),
        )


def within(frame: Frame, pose: Frame) -> Frame:
    """`pose`, which is relative to `frame`, in the frame's own frame."""
    return frame[0] @ pose[0], frame[0] @ pose[1] + frame[1]


def refuse_moving(joints: Iterable[ET.Element], rigid: tuple[str, ...]) -> None:
    """Raise AssetError where a joint is of no type of `rigid`."""
    moving = [joint.get("name", "?") for joint in joints if joint.get("type") not in rigid]
    if moving:
        raise AssetError(
            f"it has joints that move ({', '.join(moving[:4])}); libraries hold rigid objects, so fix or remove them."
        )


def shape_of(one: ET.Element) -> ET.Element:
    """The shape of a visual or a collision.

    Raises:
        AssetError: it has none.
    """
    geometry = one.find("geometry")
    shape = None if geometry is None else next(iter(geometry), None)
    if shape is None:
        raise AssetError(f"a <{one.tag}> has no geometry.")
    return shape


REST: Frame = (np.eye(3), np.zeros(3))
"""No pose at all."""
