"""Lines through convex parts, and height maps, on which grasps are judged: against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import ndimage

from pat3d.envs.grasping import grasp, height_grid
from pat3d.envs.grasping.grasp import find_grasps
from pat3d.envs.grasping.height_grid import CELL, HeightGrid
from pat3d.scene.model import Scene
from tests.envs.test_grasp import GRIPPER, bar

SIDES = np.array([axis * sign for axis in np.eye(3) for sign in (1.0, -1.0)])
"""Normals of a cube."""


def through(start, direction, normals, offsets):
    """Where one line enters and leaves, and both cosines."""
    found = grasp._through(
        np.array(start)[None, None, None], np.array(direction)[None], np.array(normals), np.array(offsets)
    )
    enter, leave, cosines = found
    return float(enter[0, 0, 0]), float(leave[0, 0, 0]), *cosines[:, 0, 0, 0].tolist()


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.0, 2.5, -1.2])
def test_a_line_meets_a_ball_where_geometry_says(angle):
    """Tangent planes of a ball all around one height: the chord at distance b from the middle is 2 sqrt(r^2 - b^2)."""
    turns = np.linspace(0.0, 2 * math.pi, 7200, endpoint=False)
    normals = np.stack([np.cos(turns), np.sin(turns), 0.0 * turns], axis=1)
    towards, across = (
        np.array([math.cos(angle), math.sin(angle), 0.0]),
        np.array([-math.sin(angle), math.cos(angle), 0.0]),
    )
    for off in (0.0, 0.02, -0.04):
        start = 0.01 * towards + off * across
        enter, leave, first, last = through(start, towards, normals, np.full(len(turns), 0.05))
        chord = math.sqrt(0.05**2 - off**2)
        assert enter == pytest.approx(-chord - 0.01, abs=1e-7)
        assert leave == pytest.approx(chord - 0.01, abs=1e-7)
        assert first == pytest.approx(chord / 0.05, abs=1e-3)
        assert last == pytest.approx(chord / 0.05, abs=1e-3)


def test_a_line_beside_a_face_it_is_parallel_to_misses_the_part():
    towards = (1.0, 0.0, 0.0)
    assert through((0.3, 0.99, 0.0), towards, SIDES, np.ones(6)) == (-1.3, 0.7, 1.0, 1.0)
    # A part has its surface: a line in a face, or along an edge, meets it.
    assert through((0.3, 1.0, 0.0), towards, SIDES, np.ones(6)) == (-1.3, 0.7, 1.0, 1.0)
    assert through((0.3, -1.0, 1.0), towards, SIDES, np.ones(6)) == (-1.3, 0.7, 1.0, 1.0)
    for start in ((0.0, 1.01, 0.0), (0.0, 0.0, -1.01)):
        assert through(start, towards, SIDES, np.ones(6))[:2] == (math.inf, -math.inf)


@pytest.mark.parametrize("slope", [1.5e-9, 1e-6, 0.1])
def test_a_line_that_is_the_least_bit_inclined_to_a_face_crosses_its_plane(slope):
    """From a hair outside of a half space: it was inside up to hair / slope behind, or will be from there on."""
    hair, level = 1e-11, math.sqrt(1.0 - slope**2)
    enter, leave, *_ = through((0.0, 0.0, hair), (1.0, 0.0, 0.0), [[slope, 0.0, level]], [0.0])
    assert enter == -math.inf
    assert leave == pytest.approx(-hair * level / slope, rel=1e-9)
    enter, leave, *_ = through((0.0, 0.0, hair), (1.0, 0.0, 0.0), [[-slope, 0.0, level]], [0.0])
    assert enter == pytest.approx(hair * level / slope, rel=1e-9)
    assert leave == math.inf


def test_what_is_beside_a_map_is_not_looked_at(monkeypatch):
    """A room full of other things costs nothing: on any of the four sides, and none where they reach into the map."""
    far = [bar(f"far {x} {y}", (0.1, 0.1, 0.1), (x, y)) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    near = bar("near", (0.1, 0.1, 0.01), (0.12, 0.0))
    scene = Scene(objects=(bar("bar", (0.1, 0.04, 0.05)), near, *far))
    looked_at, real = [], height_grid.height_map

    def counted(parts, cells):
        looked_at.append(np.concatenate([part.vertices for part in parts])[:, :2].mean(axis=0).round(6).tolist())
        return real(parts, cells)

    monkeypatch.setattr(height_grid, "height_map", counted)
    assert find_grasps(scene, "bar", GRIPPER)
    assert looked_at == [[0.0, 0.0], [0.12, 0.0]]


def test_a_map_has_the_height_of_what_is_under_each_cell_turned_as_the_fingers_close():
    grid = HeightGrid.around(np.array([-0.1, -0.1]), np.array([0.1, 0.1]))
    blocks = [bar("low", (0.08, 0.04, 0.02)), bar("high", (0.02, 0.02, 0.06), (0.03, 0.0))]
    for angle in (0.0, math.pi / 2, math.pi, 0.6):
        seen = grid.turned(grid.heights(blocks), angle)
        # Cells of map and turn are rounded to whole ones, so that a cell's height is its own or a neighbour's.
        near = ndimage.maximum_filter(seen, size=3)
        x, y = grid.world(angle)
        on_low = np.maximum(np.abs(x) - 0.04, np.abs(y) - 0.02)
        on_high = np.maximum(np.abs(x - 0.03), np.abs(y)) - 0.01
        np.testing.assert_allclose(near[(on_low < -CELL) & (on_high > 3.0 * CELL)], 0.02, atol=1e-9)
        np.testing.assert_allclose(near[on_high < -CELL], 0.06, atol=1e-9)
        assert (on_high < -CELL).any()
        assert not np.isfinite(seen[on_low > 1.5 * CELL]).any()
