"""An object together with everything that it carries, moved as one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pat3d.layout.bodies import Array, Placed


@dataclass(frozen=True, eq=False)
class Group:
    """Placed bodies; the first is the root, whose origin is the group's origin."""

    members: tuple[Placed, ...]

    @property
    def root(self) -> Placed:
        """The object that carries the others."""
        return self.members[0]

    @property
    def name(self) -> str:
        """Name of the root."""
        return self.root.body.name

    @property
    def low(self) -> Array:
        """Lower corner of the bounding box [m], shape (3,)."""
        return np.min([member.low for member in self.members], axis=0)

    @property
    def high(self) -> Array:
        """Upper corner of the bounding box [m], shape (3,)."""
        return np.max([member.high for member in self.members], axis=0)

    @property
    def size(self) -> Array:
        """Extents of the bounding box [m], shape (3,)."""
        return self.high - self.low

    @property
    def centre_of_mass(self) -> Array:
        """Common centre of mass [m], shape (3,)."""
        mass = np.array([member.body.asset.mass_properties.mass for member in self.members])
        centres = np.stack([member.centre_of_mass for member in self.members])
        return mass @ centres / mass.sum()

    def shifted(self, offset: Array) -> Group:
        """The group moved by `offset` [m], shape (3,)."""
        return Group(tuple(member.shifted(offset) for member in self.members))

    def turned(self, rotation: Array) -> Group:
        """The group rotated about its root's origin, which must be at zero; `rotation` has shape (3, 3)."""
        return Group(tuple(member.turned(rotation, np.zeros(3)) for member in self.members))
