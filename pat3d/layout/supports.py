"""Which relations of support a scene has at its poses, where nobody said any."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pat3d.errors import SpecError
from pat3d.geometry.contacts import find_contacts
from pat3d.layout.predicates import relation_holds
from pat3d.scene.model import Scene
from pat3d.scene.relations import Relation, SupportKind

NEAR = 5e-4
"""Surfaces at most this far apart [m] touch."""

CARRIES = 0.3
"""A contact whose normal rises by more than this [-] carries weight."""


def with_supports(scene: Scene) -> Scene:
    """`scene` with what lies on, or in, what, as far as contacts at its poses tell and the predicates agree.

    What is near to nothing, and what leans or hangs, gets no relation.
    """
    contacts = find_contacts(scene.objects, NEAR)
    below: dict[int, set[int]] = {}
    for (first, second), normal in zip(contacts.bodies.tolist(), contacts.normals, strict=True):
        for child, parent, up in ((first, second, normal[2]), (second, first, -normal[2])):
            if child >= 0 and parent >= 0 and up > CARRIES and not scene.objects[child].fixed:
                below.setdefault(child, set()).add(parent)
    assets = {obj.name: obj.asset for obj in scene.objects}
    poses = {obj.name: obj.pose for obj in scene.objects}
    order = np.argsort([obj.pose.position[2] for obj in scene.objects])
    found: tuple[Relation, ...] = ()
    for child in order.tolist():
        carriers = sorted(below.get(child, ()))
        name = scene.objects[child].name
        kinds: tuple[SupportKind, ...] = ("in", "on")
        for kind in kinds:
            own = tuple(Relation(child=name, kind=kind, parent=scene.objects[one].name) for one in carriers)
            own = tuple(one for one in own if relation_holds(one, assets, poses))[: 1 if kind == "in" else 8]
            if own and _is_valid(scene, (*found, *own)):
                found = (*found, *own)
                break
    return replace(scene, relations=found)


def _is_valid(scene: Scene, relations: tuple[Relation, ...]) -> bool:
    try:
        replace(scene, relations=relations)
    except SpecError:
        return False
    return True
