"""Static equilibrium, proved without a simulator: contact forces inside the friction cones that balance gravity.

For every free body b with mass m, centre of mass c and size L (longest side of its bounding box)

    r_force  = (m g + sum f) / (m |g|)          r_torque = (sum (x - c) x f) / (m |g| L)

over its contacts at x, with |f_tangent| <= mu f_normal, and over the anchors of its attachments, whose forces may have
any direction. A second-order-cone program finds the forces that make the
largest |r| of each group of touching bodies least. The residuals reported are computed from those forces afterwards,
with each force first put back inside its cone, so they do not rest on the solver's word.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.contacts import Contacts, find_contacts, merged
from pat3d.errors import CheckError
from pat3d.scene import Scene

GRAVITY = 9.81
"""[m/s^2], along -z."""

TOLERANCE = 1e-3
"""Largest residual, as a share of the weight, that passes."""

ACTIVATION = 2e-4
"""[m]; surfaces closer than this may press on each other."""

ATTACHED = 1e-3
"""[m]; an anchor whose ends are further apart carries nothing."""

MAX_FRICTION = 2.0
FRICTION_STEP = 0.005
"""Resolution of the smallest friction coefficient [-]."""

MAX_TILT = 8.0
TILT_STEP = 0.25
"""Resolution of the steadiness [degrees]."""
DIRECTIONS = 8
"""Towards which the ground is tilted."""


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

    @property
    def worst(self) -> float:
        """Largest residual of any object [-]."""
        return max(self.residuals.values(), default=0.0)

    @property
    def passed(self) -> bool:
        """Every object's residual is at most 1e-3 of its weight."""
        return all(residual <= TOLERANCE for residual in self.residuals.values())

    @property
    def unbalanced(self) -> tuple[str, ...]:
        """Objects that the contacts cannot hold still."""
        return tuple(name for name, residual in self.residuals.items() if not residual <= TOLERANCE)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        least = self.smallest_friction
        return {
            **asdict(self),
            "residuals": dict(self.residuals),
            "smallest_friction": None if least is None or math.isinf(least) else least,
            "worst": self.worst,
            "passed": self.passed,
        }


def certify(
    scene: Scene, friction: float | None = None, activation: float = ACTIVATION, *, margin: bool = False
) -> Certificate:
    """Find contact forces that hold every object of `scene` still at its pose.

    Args:
        scene: what to prove.
        friction: coefficient [-] of every contact; None for the one the scene was settled with.
        activation: surfaces closer than this touch [m].
        margin: also find the smallest friction coefficient that suffices.

    Raises:
        CheckError: `friction` is negative or not finite.
    """
    friction = scene.settling_friction if friction is None else friction
    if not (math.isfinite(friction) and friction >= 0.0):
        raise CheckError(f"friction must be a number that is not negative, got {friction}.")
    problem = _Problem(scene, activation)
    return Certificate(
        friction=friction,
        residuals=problem.residuals(friction),
        contacts=problem.found,
        activation=activation,
        smallest_friction=problem.smallest_friction() if margin else None,
    )


def smallest_friction(scene: Scene, activation: float = ACTIVATION) -> float:
    """The least uniform friction coefficient [-] at which the certificate holds, to 0.005; infinite if none up to 2."""
    return _Problem(scene, activation).smallest_friction()


def steadiness(scene: Scene, friction: float | None = None, activation: float = ACTIVATION) -> float:
    """How far the ground can be tilted, whichever way, before the certificate fails [degrees], to 0.25 and at most 8.

    Objects stay where they are on it. What slides as well as what tips over fails; negative where it fails on level
    ground already.

    Args:
        scene: at rest.
        friction: coefficient [-] of every contact; None for the one the scene was settled with.
        activation: surfaces closer than this touch [m].
    """
    friction = scene.settling_friction if friction is None else friction
    return _Problem(scene, activation).steadiness(friction)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Anchors:
    """Points at which pairs of objects hold each other."""

    bodies: NDArray[np.int64]
    """Indices into scene.objects, shape (anchors, 2)."""
    points: NDArray[np.float64]
    """Midway between the two ends [m], shape (anchors, 3)."""

    def of(self, bodies: list[int]) -> _Anchors:
        """Those that hold any of `bodies`."""
        index = np.isin(self.bodies, bodies).any(axis=1)
        return _Anchors(bodies=self.bodies[index], points=self.points[index])


def _anchors(scene: Scene) -> _Anchors:
    names = [obj.name for obj in scene.objects]
    bodies, points = [], []
    for one in scene.attachments:
        first, second = one.ends(scene[one.child].pose, scene[one.parent].pose)
        near = np.linalg.norm(first - second, axis=1) <= ATTACHED
        points += list((first + second)[near] / 2)
        bodies += [(names.index(one.child), names.index(one.parent))] * int(near.sum())
    return _Anchors(bodies=np.array(bodies, dtype=np.int64).reshape(-1, 2), points=np.array(points).reshape(-1, 3))


class _Problem:
    """What holds a scene, split into groups of free bodies that press on or hang from one another."""

    def __init__(self, scene: Scene, activation: float) -> None:
        contacts = find_contacts(scene, activation)
        self.found = len(contacts)
        contacts = merged(contacts)
        self.names = [obj.name for obj in scene.objects]
        free = [k for k, obj in enumerate(scene.objects) if not obj.fixed]
        self.centre = np.array([obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0]
                                for obj in scene.objects])  # fmt: skip
        self.weight = np.array([obj.asset.mass_properties.mass * GRAVITY for obj in scene.objects])
        self.size = np.array([float(obj.asset.size.max()) for obj in scene.objects])
        anchors = _anchors(scene)
        self.groups = [
            (bodies, contacts.pick(np.flatnonzero(np.isin(contacts.bodies, bodies).any(axis=1))), anchors.of(bodies))
            for bodies in _groups(free, np.concatenate([contacts.bodies, anchors.bodies]))
        ]

    def residuals(self, friction: float) -> dict[str, float]:
        """Largest residual of every free object, in the order of the scene."""
        found: dict[int, float] = {}
        for bodies, contacts, anchors in self.groups:
            found |= dict(zip(bodies, self._balance(bodies, contacts, anchors, friction), strict=True))
        return {self.names[body]: found[body] for body in sorted(found)}

    def smallest_friction(self) -> float:
        """Bisection on the friction coefficient of each group; the worst group's."""
        least = 0.0
        for group in self.groups:

            def holds(friction: float, group=group) -> bool:
                bodies, contacts, anchors = group
                return max(self._balance(bodies, contacts, anchors, friction)) <= TOLERANCE

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

    def steadiness(self, friction: float) -> float:
        """Bisection on the tilt of each group; the worst group's [degrees]."""
        angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        most = MAX_TILT
        for bodies, contacts, anchors in self.groups:

            def holds(tilt: float, bodies=bodies, contacts=contacts, anchors=anchors) -> bool:
                s, c = math.sin(math.radians(tilt)), math.cos(math.radians(tilt))
                downs = [(s * math.cos(a), s * math.sin(a), -c) for a in angles] if tilt else [(0.0, 0.0, -1.0)]
                return all(max(self._balance(bodies, contacts, anchors, friction, down)) <= TOLERANCE for down in downs)

            if holds(most):
                continue
            if not holds(0.0):
                return -TILT_STEP
            low, high = 0.0, most
            while high - low > TILT_STEP:
                middle = (low + high) / 2
                low, high = (middle, high) if holds(middle) else (low, middle)
            most = low
            if most == 0.0:
                break
        return most

    def _balance(
        self, bodies: list[int], contacts: Contacts, anchors: _Anchors, friction: float,
        down: tuple[float, float, float] = (0.0, 0.0, -1.0),
    ) -> list[float]:  # fmt: skip
        """Residuals of a group's bodies under the best forces at contacts and anchors, with gravity along `down`."""
        rows = {body: 6 * k for k, body in enumerate(bodies)}
        gravity = np.tile([*down, 0.0, 0.0, 0.0], len(bodies))
        if not len(contacts) + len(anchors.bodies):
            return [1.0] * len(bodies)
        frames = np.concatenate([_frames(contacts.normals), np.tile(np.eye(3), (len(anchors.bodies), 1, 1))])
        pairs = np.concatenate([contacts.bodies, anchors.bodies]).tolist()
        points = np.concatenate([contacts.points, anchors.points])
        # One unit of force is the load of the lighter body of a pair, so that pens on a table stay visible.
        wrench = np.zeros((6 * len(bodies), 3 * len(pairs)))
        unit = np.array([min(self.weight[b] for b in pair if b in rows) for pair in pairs])
        for k, (pair, point, frame) in enumerate(zip(pairs, points, frames, strict=True)):
            for body, sign in zip(pair, (1.0, -1.0), strict=True):
                if body not in rows:
                    continue
                force = sign * unit[k] / self.weight[body] * frame
                row, column = rows[body], 3 * k
                wrench[row : row + 3, column : column + 3] = force
                arm = (point - self.centre[body]) / self.size[body]
                wrench[row + 3 : row + 6, column : column + 3] = np.cross(arm, force, axisb=0, axisc=0)
        forces = _solve(wrench, gravity, friction, len(contacts))
        if forces is None:
            return [1.0] * len(bodies)
        forces = forces.reshape(-1, 3)
        forces[: len(contacts)] = _inside_cones(forces[: len(contacts)], friction)
        forces = forces.reshape(-1)
        blocks = np.linalg.norm((gravity + wrench @ forces).reshape(-1, 2, 3), axis=2)
        return [float(value) for value in blocks.max(axis=1)]


def _groups(free: list[int], pairs: NDArray[np.int64]) -> list[list[int]]:
    """Free bodies connected by pairs of bodies, shape (n, 2); the ground and fixed bodies connect nothing."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    place = {body: k for k, body in enumerate(free)}
    edges = [(place[a], place[b]) for a, b in pairs.tolist() if a in place and b in place]
    first, second = np.array(edges, dtype=int).reshape(-1, 2).T
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(len(free), len(free)))
    count, label = connected_components(graph, directed=False)
    return [[body for body in free if label[place[body]] == group] for group in range(count)]


def _frames(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rotation of every contact with columns (normal, tangent, tangent), shape (contacts, 3, 3)."""
    axis = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    first = np.asarray(np.cross(normals, axis), dtype=np.float64)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.asarray(np.stack([normals, first, np.cross(normals, first)], axis=2), dtype=np.float64)


def _solve(
    wrench: NDArray[np.float64], gravity: NDArray[np.float64], friction: float, count: int
) -> NDArray[np.float64] | None:
    """Forces (normal, tangent, tangent) that make the largest residual least, or None.

    Variables are the forces and the bound t; the cones are |f_tangent| <= friction f_normal for the first `count`
    forces, those of the contacts, and |residual| <= t for the force and the torque of every body.
    """
    from scipy import sparse

    clarabel: Any = import_module("clarabel")
    rows = wrench.shape[0]
    scale = sparse.diags(np.tile([friction, 1.0, 1.0], count)) if friction > 0 else None
    if scale is None:
        wrench = np.concatenate([wrench[:, : 3 * count : 3], wrench[:, 3 * count :]], axis=1)
        cone_block, cones = sparse.identity(count), [clarabel.NonnegativeConeT(count)]
    else:
        cone_block, cones = scale, [clarabel.SecondOrderConeT(3)] * count
    residual = sparse.lil_matrix((rows // 3 * 4, wrench.shape[1] + 1))
    target = np.zeros(rows // 3 * 4)
    for block in range(rows // 3):
        residual[4 * block, -1] = -1.0
        residual[4 * block + 1 : 4 * block + 4, :-1] = -wrench[3 * block : 3 * block + 3]
        target[4 * block + 1 : 4 * block + 4] = gravity[3 * block : 3 * block + 3]
    height = count if scale is None else 3 * count
    matrix: Any = sparse.vstack(
        [
            sparse.hstack([-cone_block, sparse.csc_matrix((height, wrench.shape[1] + 1 - height))]),
            residual.tocsc(),
        ],
        format="csc",
    )
    cones = [*cones, *([clarabel.SecondOrderConeT(4)] * (rows // 3))]
    width = wrench.shape[1] + 1
    objective = np.zeros(width)
    objective[-1] = 1.0
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_iter = 100
    solution = clarabel.DefaultSolver(
        sparse.csc_matrix((width, width)),
        objective,
        matrix,
        np.concatenate([np.zeros(height), target]),
        cones,
        settings,
    ).solve()
    found = np.asarray(solution.x)[:-1]
    if not np.isfinite(found).all():
        return None
    if scale is None:
        pressed = np.column_stack([found[:count], np.zeros((count, 2))]).reshape(-1)
        return np.concatenate([pressed, found[count:]])
    return found


def _inside_cones(forces: NDArray[np.float64], friction: float) -> NDArray[np.float64]:
    """Forces (normal, tangent, tangent) with the normal not negative and the tangent cut to the cone; shape (n, 3)."""
    normal = np.maximum(forces[:, 0], 0.0)
    tangent = forces[:, 1:]
    size = np.linalg.norm(tangent, axis=1)
    shrink = np.minimum(1.0, friction * normal / np.maximum(size, 1e-300))
    return np.column_stack([normal, tangent * shrink[:, None]])
