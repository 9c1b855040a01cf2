"""What users hold: a scene of objects at rest.

Everything here is frozen, keyword-only and valid once constructed. Z is up; metres, kilograms,
seconds, radians; quaternions are (w, x, y, z).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SpecError
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.pose import Pose
from pat3d.scene.arrangements import Arrangement, Posture, PostureKind, check_arrangements
from pat3d.scene.asset import Asset
from pat3d.scene.history import Edit
from pat3d.scene.physics import LEAST_TILT, MAX_TILT, SETTLING_FRICTION
from pat3d.scene.relations import GROUND, Relation, carriers_of, check_tree, parent_of
from pat3d.scene.task_spec import named

Point = tuple[float, float, float]
"""[m]"""

MAX_ANCHORS = 64

SHOWN_OBJECTS = 16
"""Lines of a scene's `repr`."""


@dataclass(frozen=True, kw_only=True)
class Attachment:
    """`child` hangs from `parent` by points that stay together while both may turn: ropes, hooks, strings.

    One pair of points is a ball joint, two are a hinge. Both objects still collide, with each other too, so anchors
    belong where the surfaces are a little apart.
    """

    child: str
    parent: str
    anchors: tuple[tuple[Point, Point], ...]
    """Pairs of a point of the child and a point of the parent, each in its own asset frame [m]."""

    def __post_init__(self) -> None:
        if self.child == self.parent:
            raise SpecError(f'"{self.child}" cannot be attached to itself.')
        if GROUND in (self.child, self.parent):
            raise SpecError(f'"{self.child}" and "{self.parent}": attachments join two objects, never the ground.')
        points = np.array(self.anchors, dtype=np.float64) if _are_pairs_of_points(self.anchors) else None
        if points is None or not np.isfinite(points).all():
            raise SpecError(
                f'the attachment of "{self.child}" needs 1 to {MAX_ANCHORS} pairs of points, each of 3 finite numbers.'
            )
        anchors = tuple((tuple(map(float, first)), tuple(map(float, second))) for first, second in points)
        object.__setattr__(self, "anchors", anchors)

    def ends(self, child: Pose, parent: Pose) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Where the anchors are in the world [m], on the child at pose `child` and on the parent, shape (n, 3) each."""
        points = np.array(self.anchors)
        return child.apply(points[:, 0]), parent.apply(points[:, 1])


def check_least_tilt(degrees: float) -> None:
    """Raise SpecError unless a scene can be asked to stand a tilt of `degrees`."""
    if not (math.isfinite(degrees) and 0.0 <= degrees <= MAX_TILT):
        raise SpecError(f"the least tilt that a scene has to stand is 0 to {MAX_TILT:g} degrees, got {degrees:g}.")


def _are_pairs_of_points(anchors: object) -> bool:
    try:
        shape = np.shape(np.array(anchors, dtype=np.float64))
    except (TypeError, ValueError):
        return False
    return len(shape) == 3 and 1 <= shape[0] <= MAX_ANCHORS and shape[1:] == (2, 3)


@dataclass(frozen=True, kw_only=True, eq=False)
class SceneObject:
    """One object of a scene: an asset at a pose."""

    name: str
    """Unique in the scene, readable: "red mug", "black pen 2"."""
    phrase: str = ""
    """The words that asked for it."""
    asset: Asset
    pose: Pose
    """Equilibrium pose of the asset frame."""
    initial_pose: Pose
    """Pose in the intersection-free layout, before settling."""
    fixed: bool = False
    """Fixed objects have no degrees of freedom and are static in every export."""
    posture: PostureKind | None = None
    """How it is to be turned; None where nothing is said."""

    @property
    def parts(self) -> tuple[ConvexPart, ...]:
        """The asset's convex parts, in its frame."""
        return self.asset.parts

    def __repr__(self) -> str:
        x, y, z = self.pose.position
        how = ", fixed" if self.fixed else ""
        return f"SceneObject({self.name!r}, a {self.asset.noun} at ({x:.3f}, {y:.3f}, {z:.3f}) m{how})"

    def __post_init__(self) -> None:
        if not self.name or self.name == GROUND:
            raise SpecError(f'"{self.name}" is not a valid object name.')
        if self.posture is not None:
            Posture(object=self.name, kind=self.posture)


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """Objects at rest, what relates them, and where they came from."""

    objects: tuple[SceneObject, ...]
    relations: tuple[Relation, ...] = ()
    """The scene tree (support relations) and the lateral relations of the plan."""
    arrangements: tuple[Arrangement, ...] = ()
    """Rows, circles and all else that is said of more than a child and a parent, or of places on a surface."""
    attachments: tuple[Attachment, ...] = ()
    """What hangs by points, rather than rests on surfaces; at most one for every pair of objects."""
    prompt: str = ""
    task: str | None = None
    """What an environment has a robot do here where nobody says: "place:green apple:bowl"; None for no such task."""
    seed: int = 0
    settling_friction: float = SETTLING_FRICTION
    """Friction coefficient [-] of every contact while settling; exports carry each material's own."""
    least_tilt: float = LEAST_TILT
    """Tilt of the ground [degrees], whichever way, that the scene has to stand to be verified."""
    provenance: Mapping[str, Any] = field(default_factory=dict)
    """Versions, settings and inputs; JSON-serialisable."""
    history: tuple[Edit, ...] = ()
    """What was edited since it was made, in order."""

    def __post_init__(self) -> None:
        if not self.objects:
            raise SpecError("a scene needs at least one object.")
        check_least_tilt(self.least_tilt)
        names = [obj.name for obj in self.objects]
        repeated = sorted({name for name in names if names.count(name) > 1})
        if repeated:
            raise SpecError(f"object names must be unique; repeated: {', '.join(repeated)}.")
        check_tree(names, self.relations)
        check_arrangements(names, self.relations, self.arrangements)
        self._check_attachments(names)
        for name in named(self.task) if self.task is not None else ():
            if name not in names:
                raise SpecError(f'the task "{self.task}" names "{name}". Objects: {", ".join(names)}.')

    def _check_attachments(self, names: list[str]) -> None:
        pairs = set()
        for attachment in self.attachments:
            pair = frozenset((attachment.child, attachment.parent))
            for end in pair.difference(names):
                raise SpecError(f'an attachment names "{end}", which is not in the scene. Objects: {", ".join(names)}.')
            if pair in pairs:
                raise SpecError(f'"{attachment.child}" and "{attachment.parent}" are attached twice; use more anchors.')
            pairs.add(pair)

    def __repr__(self) -> str:
        """A line for the scene and one for each of its first objects: a screen, not the arrays of the meshes."""
        said = self.prompt if len(self.prompt) <= 60 else f"{self.prompt[:57]}..."
        lines = [f"Scene({said!r}, seed {self.seed}, {len(self.objects)} objects, {len(self.relations)} relations)"]
        lines += [f"  {obj!r} on {self.parent(obj.name)}" for obj in self.objects[:SHOWN_OBJECTS]]
        more = len(self.objects) - SHOWN_OBJECTS
        return "\n".join([*lines, f"  ... and {more} more"] if more > 0 else lines)

    def __getitem__(self, name: str) -> SceneObject:
        for obj in self.objects:
            if obj.name == name:
                return obj
        raise KeyError(f'no object "{name}"; the scene has: {", ".join(obj.name for obj in self.objects)}.')

    def parent(self, name: str) -> str:
        """Name of what supports object `name`: another object or the ground."""
        return parent_of(name, self.relations)

    def carriers(self, name: str) -> tuple[str, ...]:
        """Names of everything that carries object `name`: other objects, or the ground."""
        return carriers_of(name, self.relations)

    @property
    def postures(self) -> tuple[Posture, ...]:
        """How objects are to be turned, where something is said of it."""
        return tuple(Posture(object=obj.name, kind=obj.posture) for obj in self.objects if obj.posture is not None)
