"""Smooth shapes: closed-form volumes, containment in their convex parts, free cavities."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from pat3d.assets.catalogue.common import level_lean
from pat3d.assets.rounded import arc, clear_radius, extruded, hollow, lathe, lobed, lump, slab, tube
from pat3d.assets.shapes import SMOOTH_SEGMENTS, Shape
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.planes import face_count

INSCRIBED = math.sin(2 * math.pi / SMOOTH_SEGMENTS) / (2 * math.pi / SMOOTH_SEGMENTS)
"""Area of the drawn polygon over that of its circle."""

BALL = arc(1.0, -90, 90, 40)
CIRCLE = np.column_stack([arc(3.0, 0, 360, 65)[:-1], np.full(64, 1.0)])
SHAPES = {
    "ball": lathe(BALL),
    "bottle": lathe([(1, 0), (1, 2), (0.3, 3), (0.3, 4)], cuts=(3,)),
    "cup": hollow([(1, 0), (1.5, 2)], [(0.8, 0.2), (1.3, 2)]),
    "bowl": hollow([(1, 0), (1.8, 1), (2, 2)], [(0.7, 0.2), (1.6, 1), (1.8, 2)], levels=(1,), segments=8),
    "arch": tube(np.column_stack([arc(3, 0, 180, 40), np.zeros(40)]), np.linspace(0.5, 0.2, 40), 5),
    "ring": tube(CIRCLE, 1.0, 8, closed=True),
    "slab": slab(2, 1, 0.3, 0.2),
    "ribbed": lobed(lathe(BALL), 7, 0.2),
    "lump": lump(np.random.default_rng(0).normal(size=(300, 3))),
}


def outside(points: np.ndarray, shape: Shape) -> np.ndarray:
    sides = [ConvexHull(hull).equations for hull in shape.hulls]
    return np.min([(points @ side[:, :3].T + side[:, 3]).max(axis=1) for side in sides], axis=0)


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_convex_parts_contain_the_picture_and_stay_small(name: str):
    shape = SHAPES[name]
    vertices = np.asarray(shape.solid.to_mesh64().vert_properties)[:, :3]
    assert outside(vertices, shape).max() < 1e-6
    for hull in shape.hulls:
        part = convex_part(hull)
        assert len(part.vertices) <= 64
        assert face_count(part) <= 64


def test_volumes_are_those_of_the_closed_forms():
    ring = 2 * math.pi**2 * 3.0
    assert SHAPES["ring"].solid.volume() == pytest.approx(ring, rel=0.04)
    assert SHAPES["ball"].solid.volume() == pytest.approx(4 / 3 * math.pi * INSCRIBED, rel=3e-3)
    frustum = math.pi * 2 / 3 * (1 + 1.5 + 1.5**2) - math.pi * 1.8 / 3 * (0.8**2 + 0.8 * 1.3 + 1.3**2)
    assert SHAPES["cup"].solid.volume() == pytest.approx(frustum * INSCRIBED, rel=1e-7)
    rounded = 2 * 1 - (4 - math.pi) * 0.2**2
    assert SHAPES["slab"].solid.volume() == pytest.approx(0.3 * rounded, rel=2e-3)


def test_turned_part_stands_on_a_flat_base():
    """The lowest part of a ball has a ring of corners at the ball's lowest height: it does not roll."""
    base = SHAPES["ball"].hulls[0]
    lowest = base[np.abs(base[:, 2] + 1.0) < 1e-12]
    assert len(lowest) >= 8
    # As wide as the lowest ring that is drawn: 39 steps from pole to pole.
    assert np.linalg.norm(lowest[:, :2], axis=1).min() > math.sin(math.pi / 39)


def test_clear_radius_is_the_widest_free_cylinder():
    inner = [(0.7, 0.2), (1.6, 1), (1.8, 2)]
    radius = clear_radius(inner, (1,), 8)
    turn = np.linspace(0, 2 * np.pi, 400)
    for z in np.linspace(0.2001, 2, 15):
        for size, free in ((0.999 * radius, True), (1.6 * radius, False)):
            ring = np.column_stack([size * np.cos(turn), size * np.sin(turn), np.full(400, z)])
            inside = outside(ring, SHAPES["bowl"]).min() < 0
            if free:
                assert not inside
            elif z < 0.4:
                assert inside


def test_level_lean_lays_two_bodies_on_one_plane():
    head, grip = lathe(BALL).moved(z=4), extruded(arc(0.2, 0, 345, 24), 2)
    lean = level_lean(head, grip)
    low = [np.concatenate(shape.turned("y", lean).hulls)[:, 2].min() for shape in (head, grip)]
    assert low[0] == pytest.approx(low[1], abs=1e-12)
