"""Canonical hard cases of contact, parametric and of household size: models ready to settle.

Erleben's (2018) wedges, spikes, holes, cliffs and internal edges; arches, card houses, slopes, towers and levers.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder
from tests.sim.builders import add_hull, box_points

Points = NDArray[np.float64]


def wedge(length: float = 0.1, width: float = 0.08, height: float = 0.1) -> Points:
    """A prism whose edge along x, at its top, is z = 0."""
    return np.array(
        [[x, y, z] for x in (-length / 2, length / 2) for y, z in ((-width / 2, -height), (width / 2, -height), (0, 0))]
    )


def spike(width: float = 0.06, height: float = 0.1) -> Points:
    """A pyramid whose tip, at its top, is the origin."""
    base = [[x, y, -height] for x in (-width / 2, width / 2) for y in (-width / 2, width / 2)]
    return np.array([*base, [0, 0, 0]])


def upside_down(points: Points) -> Points:
    """Turned by half a turn about x."""
    return points * [1, -1, -1]


def add_surface(builder: ModelBuilder, vertices: Points, faces: NDArray[np.int32], *, fixed: bool = False) -> int:
    """Add a body bounded by one closed surface, convex or not."""
    properties = mass_properties(vertices, faces, density=500.0)
    return builder.add_body(
        [ConvexPart(vertices=vertices, faces=faces)],
        mass=properties.mass,
        volume=properties.volume,
        centre=np.array(properties.centre_of_mass),
        second_moment=properties.second_moment,
        pose=Pose(),
        fixed=fixed,
    )


def terrain(heights: NDArray[np.float64], spacing: float, base: float) -> tuple[Points, NDArray[np.int32]]:
    """The closed solid between z = base and a height field [m], shape (n, m), about the z axis."""
    n, m = heights.shape
    x, y = np.meshgrid((np.arange(n) - (n - 1) / 2) * spacing, (np.arange(m) - (m - 1) / 2) * spacing, indexing="ij")
    top = np.stack([x, y, heights], axis=-1).reshape(-1, 3)
    index = np.arange(n * m).reshape(n, m)
    a, b, c, d = (index[i:, j:][: n - 1, : m - 1].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    rim = np.concatenate([index[:, 0], index[-1, 1:], index[-2::-1, -1], index[0, -2:0:-1]])
    foot = n * m + np.arange(len(rim))
    following, foot_following = np.roll(rim, -1), np.roll(foot, -1)
    sides = np.concatenate(
        [np.stack([rim, foot, foot_following], axis=1), np.stack([rim, foot_following, following], axis=1)]
    )
    centre = n * m + len(rim)
    floor = np.stack([foot, np.full(len(rim), centre), foot_following], axis=1)
    below = top[rim] * [1, 1, 0] + [0, 0, base]
    return (
        np.vstack([top, below, [[0, 0, base]]]),
        np.vstack([faces, sides, floor]).astype(np.int32),
    )


def pair(lower: Points, upper: Points, gap: float, yaw: float = 0.0) -> Model:
    """A fixed body and a free one whose origins are `gap` apart on the z axis."""
    builder = ModelBuilder()
    add_hull(builder, lower, Pose(position=(0, 0, 0.2)), fixed=True)
    add_hull(builder, upper, Pose.from_yaw(yaw, (0, 0, 0.2 + gap)))
    return builder.finalize("cpu")


def spike_in_pit(offset: float) -> Model:
    """A spike, point down, `offset` beside the axis of a square pit that narrows to a point."""
    builder = ModelBuilder()
    side = np.abs(np.arange(-4, 5))
    depth = np.clip(4 - np.maximum(side[:, None], side), 1, 4) - 1
    vertices, faces = terrain(0.12 - 0.03 * depth, 0.02, 0.01)
    add_surface(builder, vertices, faces, fixed=True)
    add_hull(builder, upside_down(spike(0.03, 0.08)), Pose(position=(offset, 0.3 * offset, 0.13)))
    return builder.finalize("cpu")


def cliff(lean: float) -> Model:
    """A box whose bottom edges lie exactly over the top edges of a frustum, moved by `lean`."""
    builder = ModelBuilder()
    frustum = np.vstack([box_points(0.16, 0.16, 0)[::2] + [0, 0, 0.01], box_points(0.1, 0.1, 0)[::2] + [0, 0, 0.1]])
    add_hull(builder, frustum, Pose(), fixed=True)
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(lean, 0, 0.1502)))
    return builder.finalize("cpu")


def box_on_tiles(tiles: int, yaw: float) -> Model:
    """A box on a flat floor of many triangles; at yaw 0 its edges and corners lie on theirs."""
    builder = ModelBuilder()
    vertices, faces = terrain(np.full((tiles + 1, tiles + 1), 0.05), 0.3 / tiles, 0.01)
    add_surface(builder, vertices, faces, fixed=True)
    add_hull(builder, box_points(0.1, 0.1, 0.06), Pose.from_yaw(yaw, (0, 0, 0.0805)))
    return builder.finalize("cpu")


def arch(stones: int, radius: float = 0.3, thickness: float = 0.1, gap: float = 1e-4) -> Model:
    """A half circle of stones on the ground, `gap` apart."""
    builder = ModelBuilder()
    step = np.pi / stones
    for i in range(stones):
        trim = 0.5 * gap / radius
        ends = (i * step + trim, (i + 1) * step - trim)
        ring = [(r * np.cos(a), r * np.sin(a)) for a in ends for r in (radius - thickness / 2, radius + thickness / 2)]
        points = np.array([[x, y, z + gap] for x, z in ring for y in (-0.04, 0.04)])
        add_hull(builder, points, Pose(), density=2000.0)
    return builder.finalize("cpu")


def card_house(levels: int, gap: float = 1e-4) -> Model:
    """Tents of cards leaning at 65 degrees, with one card across each level, `gap` apart."""
    builder = ModelBuilder()
    length, width, thickness, lean = 0.1, 0.06, 1e-3, np.deg2rad(65)
    card = box_points(length, width, thickness)
    half_x = 0.5 * (length * np.cos(lean) + thickness * np.sin(lean))
    height = length * np.sin(lean) + thickness * np.cos(lean)
    span = 4 * half_x + 2 * gap
    z = gap
    for level in range(levels):
        tents = levels - level
        centres = (np.arange(tents) - (tents - 1) / 2) * span
        for x in centres:
            for side in (-1, 1):
                quat = (np.cos(lean / 2), 0.0, side * np.sin(lean / 2), 0.0)
                add_hull(
                    builder, card, Pose(position=(x + side * (half_x + gap / 2), 0, z + height / 2), quat_wxyz=quat)
                )
        z += height + gap
        if tents > 1:
            roof = box_points((tents - 1) * span + 0.3 * length, width, thickness)
            add_hull(builder, roof, Pose(position=(0, 0, z + thickness / 2)))
        z += thickness + gap if tents > 1 else 0
    return builder.finalize("cpu")


def slope(angle: float) -> Model:
    """A block half a millimetre above a fixed slope [rad]."""
    builder = ModelBuilder()
    rise = np.tan(angle)
    points = [[x, y, z] for y in (-0.2, 0.2) for x, z in ((0, 0.01), (1.2, 0.01), (0, 0.01 + 1.2 * rise))]
    add_hull(builder, np.array(points), Pose(), fixed=True)
    foot = np.array([0.4, 0, 0.01 + 0.8 * rise])
    place = foot + 0.0205 * np.array([np.sin(angle), 0, np.cos(angle)])
    pose = Pose(position=tuple(place), quat_wxyz=(np.cos(angle / 2), 0, np.sin(angle / 2), 0))
    add_hull(builder, box_points(0.06, 0.06, 0.04), pose)
    return builder.finalize("cpu")


def overhang(blocks: int, share: float) -> Model:
    """Blocks stacked outwards by `share` of the harmonic overhang at which the stack is about to fall."""
    builder = ModelBuilder()
    x, length = 0.0, 0.1
    for i in range(blocks):
        add_hull(builder, box_points(length, 0.06, 0.03), Pose(position=(x, 0, 0.0152 + 0.0302 * i)))
        x += share * 0.5 * length / (blocks - 1 - i) if i < blocks - 1 else 0.0
    return builder.finalize("cpu")


def lever(ratio: float) -> Model:
    """A beam on a blunt fulcrum with a block on each end; the right one is `ratio` times as heavy."""
    builder = ModelBuilder()
    fulcrum = np.vstack([box_points(0.08, 0.06, 0)[::2] + [0, 0, 0.001], box_points(0.02, 0.06, 0)[::2] + [0, 0, 0.05]])
    add_hull(builder, fulcrum, Pose(), fixed=True)
    add_hull(builder, box_points(0.6, 0.05, 0.01), Pose(position=(0, 0, 0.0552)))
    add_hull(builder, box_points(0.04, 0.04, 0.04), Pose(position=(-0.25, 0, 0.0804)))
    add_hull(builder, box_points(0.04, 0.04, 0.04), Pose(position=(0.25, 0, 0.0804)), density=500.0 * ratio)
    return builder.finalize("cpu")


def edge_on_edge(angle: float, gap: float, frame: np.ndarray | None = None) -> Model:
    """A cube standing on its edge above the upper edge of another at `angle` [rad] to it; parallel at 0.

    `frame`, a rotation matrix, turns the axes in which the bodies are given, and nothing in the world.
    """
    builder = ModelBuilder()
    quarter = Pose(quat_wxyz=(np.cos(np.pi / 8), np.sin(np.pi / 8), 0.0, 0.0))
    half = 0.05 * np.sqrt(2)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    tilted = quarter.apply(box_points(0.1, 0.1, 0.1)) @ turn.T
    if frame is None:
        lower, upper = box_points(0.1, 0.1, 0.1), tilted
        below, above = quarter, Pose()
    else:
        lower, upper = box_points(0.1, 0.1, 0.1) @ frame.T, tilted @ frame.T
        below, above = Pose.from_matrix(quarter.rotation @ frame.T, np.zeros(3)), Pose.from_matrix(frame.T, np.zeros(3))
    add_hull(builder, lower, replace(below, position=(0, 0, 0.1)), fixed=True)
    add_hull(builder, upper, replace(above, position=(0, 0, 0.1 + 2 * half + gap)))
    return builder.finalize("cpu")


def tunnel(clearance: float) -> Model:
    """A cube between two fixed walls, `clearance` from each, above a fixed floor."""
    builder = ModelBuilder()
    for side in (-1, 1):
        wall = box_points(0.3, 0.02, 0.3)
        add_hull(builder, wall, Pose(position=(0, side * (0.06 + clearance), 0.17)), fixed=True)
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.2)))
    return builder.finalize("cpu")


def heavy_on_light(ratio: float) -> Model:
    """A cube on one that is `ratio` times lighter, of the same size."""
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.0505)), density=20.0)
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0.01, 0, 0.152)), density=20.0 * ratio)
    return builder.finalize("cpu")
