"""Is a scene held by what is really there? Static equilibrium with forces on true surfaces only.

The certificate balances forces on convex parts, which contain the surfaces that people see and reach beyond them. Here
it is computed again with the contacts moved to where both visual meshes are (see `surfaces`), first within a tenth of a
millimetre, then within what is allowed. What is held only further out is held by the excess of a part, and falls where
the thing itself would be.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.check.balance import SHARPNESS, Balance
from pat3d.check.rolling import Rolling, curvature, rolling
from pat3d.check.surfaces import DISTANCES, Patch, beyond, contacts_of, patches
from pat3d.geometry.contacts import GROUND_INDEX, Contacts
from pat3d.scene.model import GROUND, Scene

CARRIES = 0.01
"""Share of the lighter object's weight from which a contact counts as carrying."""

UPRIGHT = 0.99
"""Cosine of the normal's angle with z up to which one object lies on top of another."""

FLAT_AROUND = 0.05
"""What is flat this far around a contact, as a share of the size of what lies there, is a floor."""

STRAIGHT = 0.01
"""Share of the largest curvature below which a surface is straight along one way."""

CAP = 1.3
"""A surface is flat, not round, where it is near to the plane for this much further than its curvature says."""

MENTIONED = 2
"""Contacts that a failure names at most."""


@dataclass(frozen=True, kw_only=True)
class Excess:
    """A contact of convex parts that true surfaces do not have."""

    first: str
    second: str
    """What the first touches: another object or the ground."""
    air: float
    """Distance of the surfaces from the contact [m]; infinite where they are more than a centimetre away."""
    beyond: float
    """How far the parts touch beyond the surfaces [m]; infinite where they do nowhere."""

    def __str__(self) -> str:
        where = f'"{self.first}" on "{self.second}" ' if self.second != GROUND else f'"{self.first}" on the ground '
        if np.isinf(self.air):
            return f"{where}(surfaces more than {1e3 * DISTANCES[-1]:g} mm away)"
        return f"{where}(surfaces within {1e3 * self.air:g} mm, and up to {1e3 * self.beyond:.1f} mm beside)"


@dataclass(frozen=True, kw_only=True)
class Support:
    """Whether true surfaces hold a scene, and how far they are from the contacts that do."""

    air: Mapping[str, float]
    """Of every free object, the largest distance of a true surface from a contact that carries weight [m]."""
    excess: Mapping[str, float]
    """Of every free object, how far its parts' contacts that carry weight reach beyond the true surfaces [m]."""
    unsupported: Mapping[str, tuple[Excess, ...]] = field(default_factory=dict)
    """Objects that only the excess of convex parts holds, and their contacts that are not really there."""

    rolling: Mapping[str, Rolling] = field(default_factory=dict)
    """What rests in one point of a smooth surface, on what is under it alone, and whether it rolls away from there. The
    flat sides of its convex part hold it still in engines."""

    @property
    def failures(self) -> tuple[str, ...]:
        """A line for every object that true surfaces do not hold, or that rolls off what it lies on."""
        lines = [
            f'"{name}" is held only by convex parts that stick out: the surfaces themselves do not carry it'
            + (f", {'; '.join(map(str, worst[:MENTIONED]))}." if worst else ".")
            for name, worst in self.unsupported.items()
        ]
        lines += [
            f'"{name}" rests in one point, from where its round surface rolls off; only flat sides of convex parts '
            "hold it."
            for name, rolls in self.rolling.items()
            if rolls == "unstable"
        ]
        return tuple(lines)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        return {
            "air": dict(self.air),
            "excess": dict(self.excess),
            "unsupported": {name: [asdict(one) for one in worst] for name, worst in self.unsupported.items()},
            "rolling": dict(self.rolling),
            "failures": list(self.failures),
        }


@dataclass(frozen=True, kw_only=True, eq=False)
class Found:
    """What `true_support` finds."""

    support: Support
    contacts: Contacts
    """Contact points on true surfaces; those of the parts for objects that only the parts hold."""


def true_support(scene: Scene, contacts: Contacts, balance: Balance, friction: float, tolerance: float) -> Found:
    """Hold `scene` by its true surfaces.

    Args:
        scene: at rest.
        contacts: of its convex parts.
        balance: of these contacts.
        friction: coefficient [-] of every contact.
        tolerance: largest residual.
    """
    every = patches(scene, contacts)
    names = [obj.name for obj in scene.objects]
    air: dict[str, float] = {}
    excess: dict[str, float] = {}
    unsupported: dict[str, tuple[Excess, ...]] = {}
    rolls: dict[str, Rolling] = {}
    kept: list[Contacts] = []
    for group in balance.groups:
        members = set(group.members)
        own = [patch for patch in every if members.intersection(patch.bodies)]
        if group.residuals(np.full(group.contacts, friction)).max() > tolerance:
            continue
        placed, fell = _held(scene, own, members, friction, tolerance)
        if fell:
            for body in fell:
                unsupported[names[body]] = _worst(names, own, body)
            kept.append(contacts.pick(np.flatnonzero(np.isin(contacts.bodies, group.members).any(axis=1))))
            continue
        true = contacts_of(placed)
        kept.append(true)
        carrying = _carrying(scene, true, members, friction, tolerance)
        pressed = [one for one, carries in zip(placed, carrying, strict=True) if carries]
        for body in group.members:
            touching = [one for one in pressed if body in one[0].bodies]
            if len(touching) == 1 and (found := _rolling(scene, *touching[0], body)):
                rolls[names[body]] = found
        for number, (patch, corners) in enumerate(placed):
            if not carrying[number]:
                continue
            for body in members.intersection(patch.bodies):
                air[names[body]] = max(air.get(names[body], 0.0), patch.air)
                excess[names[body]] = max(excess.get(names[body], 0.0), beyond(patch.points, corners))
    return Found(
        support=Support(air=air, excess=excess, unsupported=unsupported, rolling=rolls), contacts=_joined(kept)
    )


def _held(
    scene: Scene, own: list[Patch], members: set[int], friction: float, tolerance: float
) -> tuple[list[tuple[Patch, NDArray[np.float64]]], list[int]]:
    """The nearest true surfaces that hold bodies `members`, or the bodies that fall if all that is allowed holds.

    What only just holds them, by what a residual may leave unbalanced, stands no tilt; so surfaces that hold them
    without that are looked for first, a little further out.
    """
    placed: list[tuple[Patch, NDArray[np.float64]]] = []
    limit = max((min(distance, max(patch.allowed)) for patch in own for distance in DISTANCES), default=0.0)
    fell: list[int] = sorted(members)
    for share in (SHARPNESS, 1.0):
        for distance in DISTANCES:
            corners = [(patch, patch.corners(distance, limited=True)) for patch in own]
            placed = [(patch, found) for patch, found in corners if len(found)]
            fell = _falling(scene, contacts_of(placed), members, friction, share * tolerance)
            if not fell:
                return placed, fell
            if distance >= limit:
                break
    return placed, fell


def _falling(scene: Scene, true: Contacts, members: set[int], friction: float, tolerance: float) -> list[int]:
    """Those of `members` that contacts `true` do not hold, of each group that is not held the ones that go first."""
    fell = []
    for group in Balance(scene, true).groups:
        if not members.intersection(group.members):
            continue
        if group.residuals(np.full(group.contacts, friction)).max() > tolerance:
            fell += group.first_to_fall(np.full(group.contacts, friction))
    return fell


def _carrying(scene: Scene, true: Contacts, members: set[int], friction: float, tolerance: float) -> list[bool]:
    """Whether each patch of `true`, contacts in the order of their patches, carries weight."""
    starts = np.concatenate([[True], np.any(np.diff(true.bodies, axis=0) != 0, axis=1)]) if len(true) else np.zeros(0)
    starts = starts | np.concatenate([[True], np.any(np.diff(true.normals, axis=0) != 0, axis=1)])[: len(true)]
    number = np.cumsum(starts) - 1
    force = np.zeros(int(number[-1]) + 1 if len(number) else 0)
    for group in Balance(scene, true).groups:
        if members.intersection(group.members):
            found = group.least_forces(np.full(group.contacts, friction), tolerance)
            if found is not None:
                np.maximum.at(force, number[group.source], found)
    return (force >= CARRIES).tolist()


def _rolling(scene: Scene, patch: Patch, corners: NDArray[np.float64], body: int) -> Rolling | None:
    """Whether `body` rolls away from its only contact; None where either surface is flat or has an edge there."""
    own = patch.bodies.index(body)
    sign, other = (1.0, -1.0)[own], patch.bodies[1 - own]
    if sign * patch.plane.axes[2, 2] < UPRIGHT:
        return None
    at = corners.mean(axis=0)
    asset, pose = scene.objects[body].asset, scene.objects[body].pose
    upper = curvature(
        pose.apply(asset.visual.vertices), asset.visual.faces, patch.plane, at, sign, float(asset.size.max())
    )
    if upper is None:
        return None
    # A foot is flat for further than so round a thing would be near to the plane.
    turns, axes = np.linalg.eigh(upper)
    if np.any(np.ptp(corners @ axes, axis=0) > 2 * CAP * np.sqrt(2 * DISTANCES[1] / np.maximum(turns, 1e-3))):
        return None
    lower = np.zeros((2, 2))
    if other != GROUND_INDEX and not patch.flat(1 - own, at, FLAT_AROUND * float(asset.size.max())):
        under = scene.objects[other]
        vertices = under.pose.apply(under.asset.visual.vertices)
        bent = curvature(vertices, under.asset.visual.faces, patch.plane, at, -sign, float(under.asset.size.max()))
        if bent is None:
            return None
        lower = bent
    centre = pose.apply(np.array([asset.mass_properties.centre_of_mass]))
    found = rolling(upper, lower, sign * float(patch.plane.seen(centre)[0, 2]))
    # Along a line there may be a flat side that its ends do not show, so that it is only said that it may roll.
    straight = np.abs(turns).min() < STRAIGHT * np.abs(turns).max()
    return "neutral" if straight and found == "unstable" else found


def _worst(names: list[str], own: list[Patch], body: int) -> tuple[Excess, ...]:
    """The contacts of `body` that are furthest from true surfaces."""
    found = []
    for patch in own:
        if body not in patch.bodies:
            continue
        other = patch.bodies[1] if patch.bodies[0] == body else patch.bodies[0]
        corners = patch.corners(patch.air) if np.isfinite(patch.air) else None
        found.append(
            Excess(
                first=names[body],
                second=GROUND if other == GROUND_INDEX else names[other],
                air=patch.air,
                beyond=np.inf if corners is None else beyond(patch.points, corners),
            )
        )
    return tuple(sorted(found, key=lambda one: (-one.air, -one.beyond)))


def _joined(parts: list[Contacts]) -> Contacts:
    if not parts:
        return contacts_of([])
    return Contacts(
        bodies=np.concatenate([one.bodies for one in parts]),
        parts=np.concatenate([one.parts for one in parts]),
        points=np.concatenate([one.points for one in parts]),
        normals=np.concatenate([one.normals for one in parts]),
        gaps=np.concatenate([one.gaps for one in parts]),
    )
