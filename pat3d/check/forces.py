"""Contact forces that hold a scene still, of all that do those of least sum: what a certificate finds, to be drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.check.balance import Balance
from pat3d.check.certificate import ACTIVATION, TOLERANCE
from pat3d.geometry.contacts import find_contacts
from pat3d.scene.model import Scene


@dataclass(frozen=True, kw_only=True, eq=False)
class ContactForces:
    """Forces at contact points."""

    points: NDArray[np.float64]
    """[m], shape (contacts, 3)."""
    forces: NDArray[np.float64]
    """[N], on the first body of each contact; on the second the opposite; shape (contacts, 3)."""
    bodies: NDArray[np.int64]
    """Indices of both bodies in the scene, -1 for the ground; shape (contacts, 2)."""


def contact_forces(scene: Scene, activation: float = ACTIVATION) -> ContactForces:
    """Forces that balance gravity on every object of `scene`, inside the friction cones of the settling friction.

    Objects that no forces hold have none, and so have contacts that the others make superfluous.

    Args:
        scene: at rest.
        activation: surfaces closer than this touch [m].
    """
    contacts = find_contacts(scene.objects, activation)
    index, forces = [np.zeros(0, dtype=np.int64)], [np.zeros((0, 3))]
    for group in Balance(scene, contacts).groups:
        found = group.contact_forces(np.full(group.contacts, scene.settling_friction), TOLERANCE)
        if found is not None:
            index.append(group.source)
            forces.append(found)
    chosen = contacts.pick(np.concatenate(index))
    return ContactForces(points=chosen.points, forces=np.concatenate(forces), bodies=chosen.bodies)
