"""How far parts reach out of the picture (benchmarks/inflation.py), where it is known."""

import math

import numpy as np
import pytest

from benchmarks.inflation import outside, reaches
from pat3d.assets.shapes import box, cylinder, ellipsoid, join
from tests.scenes import asset_of

CORNERS = 1.0839
"""Radius of a pentakis dodecahedron's corners over that of the ball in it: the best of 60 faces."""


def test_a_balls_part_reaches_out_by_its_corners():
    # The picture of a ball is a polyhedron of 48 sides, which sags by 0.2 % at most.
    assert reaches(asset_of(ellipsoid(0.05)))[0] == pytest.approx(0.05 * (CORNERS - 1), rel=0.03)


def test_a_cylinders_part_reaches_out_by_the_corners_of_its_polygon():
    found = reaches(asset_of(cylinder(0.05, 0.1, sides=10)))
    assert found[0] == pytest.approx(0.05 * (1 / math.cos(math.pi / 10) - 1), rel=0.05)


def test_corners_inside_of_the_picture_reach_nowhere():
    """A post through a table top has its corners outside of the top, and none outside of the picture."""
    assert reaches(asset_of(join(box(0.1, 0.1, 0.02), box(0.02, 0.02, 0.1).moved(z=-0.04)))).max() == 0.0


def test_points_are_told_apart_by_winding():
    mesh = asset_of(box(0.1, 0.1, 0.1)).visual
    points = np.array([[0.0, 0.0, 0.05], [0.0, 0.0, 0.11], [0.049, 0.049, 0.001], [0.06, 0.0, 0.05]])
    assert outside(mesh.vertices, mesh.faces, points).tolist() == [False, True, False, True]
