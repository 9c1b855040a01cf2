"""Scenes in which `benchmarks/gradients.py` differentiates the simulator.

Bodies are tilted by 5e-3 rad against what they fall on: exactly parallel faces change their closest features in any
interval, as the last case shows.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.model import ModelBuilder


def box(x: float, y: float, z: float) -> NDArray[np.float64]:
    """Corners [m], shape (8, 3)."""
    return np.array([[i, j, k] for i in (-x / 2, x / 2) for j in (-y / 2, y / 2) for k in (-z / 2, z / 2)])


def ball(radius: float, points: int = 40) -> NDArray[np.float64]:
    """Points evenly on a sphere [m], shape (points, 3)."""
    z = 1 - (2 * np.arange(points) + 1) / points
    turn = np.pi * (1 + math.sqrt(5)) * np.arange(points)
    ring = np.sqrt(1 - z**2)
    return radius * np.stack([ring * np.cos(turn), ring * np.sin(turn), z], axis=1)


def bowl(radius: float, thick: float, sectors: int = 8, rings: int = 3) -> list[ConvexPart]:
    """Convex parts of a spherical shell up to 60 degrees from its lowest point, which is over the origin."""
    parts = []
    polar = np.linspace(0, np.pi / 3, rings + 1)
    around = np.linspace(0, 2 * np.pi, sectors + 1)
    for a, b in zip(polar[:-1], polar[1:], strict=True):
        for c, d in zip(around[:-1], around[1:], strict=True):
            rays = [
                (math.sin(p) * math.cos(t), math.sin(p) * math.sin(t), -math.cos(p)) for p in (a, b) for t in (c, d)
            ]
            rays = np.unique(np.round(rays, 12), axis=0)
            parts.append(convex_part(np.concatenate([radius * rays, (radius + thick) * rays]) + (0, 0, radius + thick)))
    return parts


def placed(x: float, y: float, z: float, *, turn: tuple[float, float, float] = (0, 0, 0)) -> Pose:
    """A pose whose rotation vector is `turn` [rad]."""
    angle = math.sqrt(sum(t * t for t in turn))
    axis = [t / max(angle, 1e-300) * math.sin(angle / 2) for t in turn]
    return Pose(position=(x, y, z), quat_wxyz=(math.cos(angle / 2), *axis))


def add(builder: ModelBuilder, points: NDArray[np.float64], pose: Pose, *, fixed: bool = False) -> int:
    """Add the hull of `points`, of the density of wood."""
    part = convex_part(points)
    solid = mass_properties(part.vertices, part.faces, density=500.0)
    return builder.add_body(
        [part],
        mass=solid.mass,
        volume=solid.volume,
        centre=np.array(solid.centre_of_mass),
        second_moment=solid.second_moment,
        pose=pose,
        fixed=fixed,
    )


def one_box() -> ModelBuilder:
    """A box a millimetre over the ground, tilted by 5e-3."""
    builder = ModelBuilder()
    add(builder, box(0.1, 0.08, 0.06), placed(0, 0, 0.0312, turn=(4e-3, 3e-3, 0.2)))
    return builder


def stack(count: int) -> Callable[[], ModelBuilder]:
    """Boxes on one another, each tilted by 5e-3 and turned about the vertical."""

    def build() -> ModelBuilder:
        builder = ModelBuilder()
        for k in range(count):
            size = (0.1, 0.08, 0.06) if k % 2 == 0 else (0.08, 0.1, 0.06)
            tilt = 5e-3 * np.array([math.cos(2.0 * k + 0.7), math.sin(2.0 * k + 0.7)])
            add(builder, box(*size), placed(0.004 * k, 0.003 * k, 0.0312 + 0.0617 * k, turn=(*tilt, 0.2 + 0.4 * k)))
        return builder

    return build


def balls_in_bowl() -> ModelBuilder:
    """Three polyhedral balls released on the wall of a bowl."""
    builder = ModelBuilder()
    parts = bowl(0.12, 0.012)
    builder.add_body(
        parts, mass=1.0, volume=1e-3, centre=np.zeros(3), second_moment=1e-3 * np.eye(3), pose=Pose(), fixed=True
    )
    for k, angle in enumerate((0.3, 2.4, 4.6)):
        reach = 0.12 - 0.038
        place = reach * np.array([math.sin(0.6) * math.cos(angle), math.sin(0.6) * math.sin(angle), -math.cos(0.6)])
        add(builder, ball(0.03), placed(*(place + (0, 0, 0.132)), turn=(0.3 * k, 0.2, 0.5 * k)))
    return builder


def incline(angle: float = 0.35) -> ModelBuilder:
    """A block on a fixed slope of 20 degrees, tilted against it by 5e-3."""
    builder = ModelBuilder()
    wedge = np.array([[x, y, z] for y in (-0.3, 0.3) for x, z in ((0, 0), (2.4, 0), (0, 2.4 * math.tan(angle)))])
    add(builder, wedge, Pose(), fixed=True)
    place = np.array([0.4, 0, 2.0 * math.tan(angle)]) + 0.0209 * np.array([math.sin(angle), 0, math.cos(angle)])
    add(builder, box(0.06, 0.06, 0.04), placed(*place, turn=(2e-3, angle + 4e-3, 2e-3)))
    return builder


def hung_rod() -> ModelBuilder:
    """A rod hung at one end, aslant, from an arm of a block that slides on the ground."""
    builder = ModelBuilder()
    block = add(builder, box(0.2, 0.2, 0.1), placed(0, 0, 0.0509, turn=(3e-3, 4e-3, 0.1)))
    rod = add(builder, box(0.2, 0.03, 0.03), placed(0.25, 0, 0.18, turn=(0.1, 0.2, 0.0)))
    builder.add_attachment(rod, np.array([-0.1, 0.0, 0.0]), block, np.array([0.15, 0.0, 0.15]))
    return builder


def aligned_boxes() -> ModelBuilder:
    """Two boxes with exactly parallel faces: every direction changes the closest features."""
    builder = ModelBuilder()
    add(builder, box(0.1, 0.1, 0.06), placed(0, 0, 0.0305))
    add(builder, box(0.1, 0.1, 0.06), placed(0, 0, 0.0911))
    return builder


@dataclass(frozen=True, kw_only=True)
class Case:
    """One row of the table."""

    name: str
    build: Callable[[], ModelBuilder]
    until: int | str
    friction: float = 0.3
    by: str = "q0"
    """What is varied: q0, friction, mass or d_hat."""
    finer: float = 1.0
    """Factor on the steps of the differences: smaller where the result depends steeply on the start."""
    quick: bool = False

    @property
    def kind(self) -> str:
        """One of "step", "frames" or "rest"."""
        return "rest" if self.until == "rest" else "step" if self.until == 1 else "frames"


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a case showed."""

    case: Case
    errors: NDArray[np.float64]
    """Relative error of every direction; nan where not smooth; shape (directions,)."""
    spread: float
    """Largest disagreement of neighbouring estimates, relative as the errors."""
    steps: NDArray[np.float64]
    """h of every chosen estimate, nan where not smooth."""
    one_sided: float
    """Largest difference between forward and backward differences where not smooth, relative as the errors."""
    curve: tuple[NDArray, NDArray, NDArray]
    """h, and forward and backward differences over the adjoint's derivative, in one direction."""
    seconds: float
    time_steps: int


def cases() -> list[Case]:
    """All rows of the table."""
    scenes: list[tuple[str, Callable[[], ModelBuilder], float, bool]] = [
        ("box", one_box, 0.3, True),
        ("stack of 2", stack(2), 0.3, True),
        ("stack of 4", stack(4), 0.3, False),
        ("3 balls in a bowl", balls_in_bowl, 0.3, False),
        ("block slides (mu 0.3, slope 0.36)", incline, 0.3, True),
        ("block sticks (mu 0.5, slope 0.36)", incline, 0.5, True),
        ("rod hung from a block", hung_rod, 0.3, False),
    ]
    rows = []
    for until in (1, 60, "rest"):
        for name, build, mu, quick in scenes:
            # What slides never rests.
            if until != "rest" or not name.startswith("block slides"):
                finer = 1 / 16 if name.startswith("3 balls") else 1.0
                quick = quick and until != "rest"
                rows.append(Case(name=name, build=build, until=until, friction=mu, finer=finer, quick=quick))
    for by in ("friction", "mass", "d_hat"):
        for until in (1, 60):
            rows.append(Case(name="stack of 2", build=stack(2), until=until, by=by, quick=until == 1))
            rows.append(Case(name=scenes[4][0], build=incline, until=until, by=by))
    rows.append(Case(name="parallel boxes", build=aligned_boxes, until=1, quick=True))
    return rows
