"""Static equilibrium, verified without a simulator: contact forces inside the friction cones that balance gravity.

For every free body b with mass m, centre of mass c and size L (longest side of its bounding box)

    r_force  = (m g + sum f) / (m |g|)          r_torque = (sum (x - c) x f) / (m |g| L)

over its contacts at x, with |f_tangent| <= mu f_normal, and over the anchors of its attachments, whose forces may have
any direction. A second-order-cone program finds the forces that make the largest |r| of each group of touching bodies
least. The residuals reported are computed from those forces afterwards, with each force first put back inside its cone,
so they do not rest on the solver's word.

An equilibrium can be real and worthless: a plum balances on the tip of a cone until something touches it. So the
largest tilt of the ground is found, too, under which such forces exist with every object where it is: towards each of
sixteen sides the largest s with g = |g| (s cos a, s sin a, -1) is a program of the same kind. The tilts that are stood
are a convex set, so what is stood towards sixteen sides is stood in the polygon between them, and the radius of the
circle that fits into it is stood whichever way. Friction there is that of the exports, since a scene that crept to rest
with less has none of that to spare; what hangs is clamped, since it swings and comes back. The tilt is the lesser of
what the convex parts stand in engines, which keep few contact points of a face, and of what the true surfaces stand
(see `support`), both on faces a little smaller than they are (see `wear`).

Forces must have a cause. Two walls could hold a block between them by friction, however little there is, if they only
pressed hard enough; nothing makes them. Of all forces that balance, those of least sum are looked at: where some of
them, along their normals, balance one another, no motion closes all these contacts, so no weight can have pressed them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from pat3d.check.balance import Balance
from pat3d.check.support import Support, true_support
from pat3d.check.wear import worn
from pat3d.errors import CheckError
from pat3d.geometry.contacts import Contacts, find_contacts, four_of_each
from pat3d.scene.model import Scene
from pat3d.scene.physics import LEAST_TILT, MAX_TILT

TOLERANCE = 1e-3
"""Largest residual, as a share of the weight, that passes."""

ACTIVATION = 3e-5
"""[m]; surfaces closer than this may press on each other. The simulator's press within 1.5e-5 m (`final_d_hat`), and
exports give each contact a margin of a fifth more than its gap; twice that distance leaves room for the rounding of
poses, and what is further away carries nothing before it has fallen."""

NEARLY_AT_REST = 2e-4
"""[m]; the same for layouts on their way to rest, whose steadiness is compared."""

CLOSING = 1e-6
"""Rate below which contacts do not close."""

CARRIES = 0.01
"""Share of the lighter object's weight from which a contact counts as carrying."""

MAX_FRICTION = 2.0
FRICTION_STEP = 0.005
"""Resolution of the smallest friction coefficient [-]."""

DIRECTIONS = 16
"""Towards which the ground is tilted."""

ROUNDING = 1e-6
"""Share of the largest tilt of interest that a solver may miss it by."""


@dataclass(frozen=True, kw_only=True)
class Certificate:
    """Whether contact forces can hold every body still, and how well."""

    friction: float
    """Coulomb coefficient [-] of every contact."""
    residuals: Mapping[str, float]
    """Unbalanced force or torque of every free object over its weight (times its size), whichever is larger."""
    contacts: int
    """Contact points within the activation distance."""
    activation: float
    """[m]"""
    smallest_friction: float | None = None
    """The least coefficient [-] at which the certificate holds, to 0.005; infinite if none does; None if not asked."""
    largest_tilt: float | None = None
    """Tilt of the ground, whichever way, that is stood with the exports' friction [degrees], at most 8; None if not
    asked."""
    outline_tilt: float | None = None
    """The same with all contact points of every face [degrees]; None if not asked."""
    least_tilt: float = LEAST_TILT
    """Of the ground that has to be stood [degrees]."""
    first_to_go: tuple[str, ...] = ()
    """Objects that slide or tip over first when the ground is tilted further, those that move most in front."""
    largest_gap: float | None = None
    """Between parts that carry weight [m]; None if not asked."""
    jammed: tuple[str, ...] = ()
    """Objects that only forces without a cause hold: pairs of contacts that press because they press."""
    support: Support | None = None
    """What holds on true surfaces; None if not asked."""

    @property
    def worst(self) -> float:
        """Largest residual of any object [-]."""
        return max(self.residuals.values(), default=0.0)

    @property
    def passed(self) -> bool:
        """Every residual is at most 1e-3 of the weight.

        If asked, that is so on true surfaces and by forces that have a cause, and the least tilt is stood.
        """
        return not self.unbalanced and not self.fragile and not self.unreal

    @property
    def unreal(self) -> tuple[str, ...]:
        """A line for everything that is balanced, and not by what gravity presses on what is there."""
        lines = [
            f'"{name}" is jammed: no weight can have pressed the contacts that would have to hold it by friction.'
            for name in self.jammed
        ]
        return (*lines, *(self.support.failures if self.support else ()))

    @property
    def unbalanced(self) -> tuple[str, ...]:
        """Objects that the contacts cannot hold still."""
        return tuple(name for name, residual in self.residuals.items() if not residual <= TOLERANCE)

    @property
    def fragile(self) -> bool:
        """Whether it is balanced, and a touch upsets it."""
        return not self.unbalanced and self.largest_tilt is not None and self.largest_tilt < self.least_tilt

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        least = self.smallest_friction
        return {
            **asdict(replace(self, support=None)),
            "residuals": dict(self.residuals),
            "smallest_friction": None if least is None or math.isinf(least) else least,
            "first_to_go": list(self.first_to_go),
            "jammed": list(self.jammed),
            "support": self.support and self.support.as_dict(),
            "worst": self.worst,
            "passed": self.passed,
        }


def certify(
    scene: Scene, friction: float | None = None, activation: float = ACTIVATION, *, margin: bool = False
) -> Certificate:
    """Find contact forces that hold every object of `scene` still at its pose.

    Args:
        scene: what to verify.
        friction: coefficient [-] of every contact; None for the one the scene was settled with.
        activation: surfaces closer than this touch [m].
        margin: also find the smallest friction coefficient that suffices, and the largest tilt that is stood.

    Raises:
        CheckError: `friction` is negative or not finite.
    """
    friction = scene.settling_friction if friction is None else friction
    if not (math.isfinite(friction) and friction >= 0.0):
        raise CheckError(f"friction must be a number that is not negative, got {friction}.")
    names = [obj.name for obj in scene.objects]
    contacts = find_contacts(scene.objects, activation)
    balance = Balance(scene, contacts)
    found: dict[int, float] = {}
    for group in balance.groups:
        residuals = group.residuals(np.full(group.contacts, friction))
        found |= dict(zip(group.members, residuals.tolist(), strict=True))
    certificate = Certificate(
        friction=friction,
        residuals={names[body]: found[body] for body in sorted(found)},
        contacts=balance.found,
        activation=activation,
        least_tilt=scene.least_tilt,
    )
    if not margin:
        return certificate
    gap, jammed = _pressed(balance, contacts, friction)
    true = true_support(scene, contacts, balance, friction, TOLERANCE)
    faces = worn(contacts)
    surfaces, parts = (_largest_tilt(Balance(scene, one), None) for one in (worn(true.contacts), faces))
    outline, first = min(surfaces, parts, key=lambda one: one[0])
    tilt = min(outline, _in_engines(scene, faces, parts[0]))
    return replace(
        certificate,
        smallest_friction=_smallest_friction(balance),
        largest_tilt=0.0 if certificate.unbalanced else tilt,
        outline_tilt=0.0 if certificate.unbalanced else outline,
        first_to_go=tuple(names[body] for body in first),
        largest_gap=gap,
        jammed=tuple(names[body] for body in jammed),
        support=true.support,
    )


def smallest_friction(scene: Scene, activation: float = ACTIVATION) -> float:
    """The least uniform friction coefficient [-] at which the certificate holds, to 0.005; infinite if none up to 2."""
    return _smallest_friction(Balance(scene, find_contacts(scene.objects, activation)))


def steadiness(scene: Scene, friction: float | None = None, activation: float = NEARLY_AT_REST) -> float:
    """How far the ground can be tilted, whichever way, before the certificate fails [degrees], at most 8.

    Objects stay where they are on it, on faces with worn edges. What slides as well as what tips over fails; 0 where it
    fails on level ground already.

    Args:
        scene: at rest.
        friction: coefficient [-] of every contact; None for what the exports carry, at each contact the lower one of
            the two materials.
        activation: surfaces closer than this touch [m].
    """
    return _largest_tilt(Balance(scene, worn(find_contacts(scene.objects, activation))), friction)[0]


def _pressed(balance: Balance, contacts: Contacts, friction: float) -> tuple[float, list[int]]:
    """The largest gap [m] of a contact that carries weight, and the bodies that forces without a cause hold."""
    largest, jammed = 0.0, []
    for group in balance.groups:
        forces = group.least_forces(np.full(group.contacts, friction), TOLERANCE)
        if forces is None:
            continue
        carrying = np.flatnonzero(forces >= CARRIES)
        if not len(carrying):
            continue
        largest = max(largest, float(contacts.gaps[group.source[carrying]].max()))
        if group.closing(carrying) < CLOSING:
            jammed += group.members
    return largest, jammed


def _in_engines(scene: Scene, contacts: Contacts, outline: float) -> float:
    """What engines stand [degrees] of the tilt `outline` that the parts' contacts do.

    They keep four contact points of a face and rock on to others. In MuJoCo feet of 6 to 16 corners stand 0.79 to 0.97
    of what their outline does, and four of their corners would 0.5 to 0.71: half-way is stood, to a tenth.
    """
    four = four_of_each(contacts)
    if len(four) == len(contacts):
        return outline
    return (outline + min(outline, _largest_tilt(Balance(scene, four), None)[0])) / 2


def _smallest_friction(balance: Balance) -> float:
    """Bisection on the friction coefficient of each group; the worst group's."""
    least = 0.0
    for group in balance.groups:

        def holds(friction: float, group=group) -> bool:
            return bool(group.residuals(np.full(group.contacts, friction)).max() <= TOLERANCE)

        if holds(least):
            continue
        low, high = least, max(0.2, 2 * least)
        while not holds(high):
            if high >= MAX_FRICTION:
                return math.inf
            low, high = high, min(2 * high, MAX_FRICTION)
        while high - low > FRICTION_STEP:
            middle = (low + high) / 2
            low, high = (low, middle) if holds(middle) else (middle, high)
        least = high
    return least


def _largest_tilt(balance: Balance, friction: float | None) -> tuple[float, tuple[int, ...]]:
    """What the worst group endures [degrees], and the bodies of it that go first beyond; none where it is MAX_TILT."""
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    most, first = math.tan(math.radians(MAX_TILT)), ()
    # Far enough for a circle of radius `most` to fit into the polygon.
    limit = most / math.cos(math.pi / DIRECTIONS)
    for group in balance.groups:
        mu = group.exported if friction is None else np.full(group.contacts, friction)
        found = [group.largest_tilt(mu, angle, limit, TOLERANCE) for angle in angles]
        radius = _inscribed(
            [tilt * np.array([math.cos(a), math.sin(a)]) for (tilt, _), a in zip(found, angles, strict=True)]
        )
        if radius < most * (1.0 - ROUNDING):
            most, first = radius, min(found, key=lambda one: one[0])[1]
    return math.degrees(math.atan(most)), first


def _inscribed(corners: list[np.ndarray]) -> float:
    """Radius of the circle about the origin that fits into a polygon around it; corners in order."""
    least = math.inf
    for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
        edge = b - a
        square = float(edge @ edge)
        t = min(1.0, max(0.0, -float(a @ edge) / square)) if square > 0.0 else 0.0
        least = min(least, float(np.linalg.norm(a + t * edge)))
    return least
