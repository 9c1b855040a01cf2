"""Planes of convex parts: what lies beyond them, and which triangles are one face."""

from __future__ import annotations

import numpy as np

from pat3d.geometry.hulls import convex_part
from pat3d.geometry.planes import face_count, plane_distances, planes

CUBE = np.array([[x, y, z] for x in (0.0, 0.1) for y in (0.0, 0.1) for z in (0.0, 0.1)])


def test_a_tip_of_a_ten_thousandth_makes_four_faces_of_one():
    """0.01 mm on 10 cm is a hundred times what counts as flat."""
    tip = np.array([[0.05, 0.05, 0.1 + 1e-5]])
    assert face_count(convex_part(np.vstack([CUBE, tip]))) == 5 + 4


def test_planes_contain_the_part_and_measure_what_is_beyond():
    part = convex_part(CUBE)
    sides = planes(part)
    np.testing.assert_allclose(plane_distances(part.vertices, sides), 0.0, atol=1e-15)
    apart = plane_distances(np.array([[0.05, 0.05, 0.12], [0.05, 0.05, 0.06]]), sides)
    np.testing.assert_allclose(apart, [0.02, -0.04], rtol=1e-12)
