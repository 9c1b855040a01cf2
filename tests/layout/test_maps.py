"""Height maps, rotations in containers, and what hangs plumb, against closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets import shapes
from pat3d.geometry.rotations import turn, yaw_matrix
from pat3d.layout.bodies import Body
from pat3d.layout.containers import Column, _choices, _upper_end
from pat3d.layout.group import Group
from pat3d.layout.hanging import _anchors, _plumb
from pat3d.layout.heightmap import bottom_map, top_map
from tests.layout.things import asset, block

CELL = 0.01


@pytest.mark.parametrize("yaw", [0.0, 45.0])
@pytest.mark.parametrize("widen", [0.0, 0.035])
@pytest.mark.parametrize("shift", [0.0, 0.3, 0.7])
def test_a_map_knows_a_block_where_it_is_and_nothing_further_away_than_it_is_widened(yaw, widen, shift):
    """A square of 20 cm whose sides move out by `widen`; its box does too, so that no corner reaches further."""
    body = Body("block", block(0.2, 0.2, 0.1)).at(yaw_matrix(math.radians(yaw)), np.array([0.0, 0.0, 0.5]))
    origin = np.full(2, -0.25 + shift * CELL + 1e-4)
    shape = (51, 47)
    ticks = [origin[k] + CELL * np.arange(shape[k]) for k in range(2)]
    points = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1)
    local = np.abs(points @ yaw_matrix(math.radians(yaw))[:2, :2])
    inside = (local <= 0.1 + widen).all(axis=-1) & (np.abs(points) <= body.high[:2] + widen).all(axis=-1)
    top = top_map([body], origin, CELL, shape, widen)
    bottom = bottom_map([body], origin, CELL, shape, widen)
    np.testing.assert_allclose(top, np.where(inside, 0.6, -np.inf))
    np.testing.assert_allclose(bottom, np.where(inside, 0.5, np.inf))


def test_what_stays_upright_is_tried_in_eight_directions():
    """Every eighth of a turn, about the vertical alone."""
    group = Group((Body("block", block(0.1, 0.2, 0.05)).at(np.eye(3), np.zeros(3)),))
    column = Column(centre=np.zeros(3), half_size=np.full(2, 0.3), yaw=0.0, disc=False, height=0.2, capped=False)
    (rotations,) = _choices(group, column, np.random.default_rng(0), upright=True)
    found = list(rotations)
    assert len(found) == 8
    np.testing.assert_allclose([one[:, 2] for one in found], [[0.0, 0.0, 1.0]] * 8, atol=1e-12)
    yaws = np.degrees([math.atan2(one[1, 0], one[0, 0]) for one in found])
    np.testing.assert_allclose(np.sort((yaws - yaws[0]) % 360.0 % (360.0 - 1e-6)), 45.0 * np.arange(8), atol=1e-6)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("end", [1, -1])
def test_the_wider_end_is_up_unless_its_weight_would_be_above_the_rim(axis, end):
    """A brush 40 cm long with a collar at its handle: the collar is wider than the head, but no end."""
    parts = [
        shapes.box(0.4, 0.02, 0.02),
        shapes.box(0.04, 0.06, 0.06).moved(x=0.18 * end),
        shapes.box(0.02, 0.1, 0.1).moved(x=-0.05 * end),
    ]
    shape = shapes.join(*parts)
    body = Body("brush", asset("brush", shape if axis == 0 else shape.turned("z", 90))).at(np.eye(3), np.zeros(3))
    heavy = end * float(body.centre_of_mass[axis])
    assert heavy > 0.0
    assert _upper_end(body, axis, 0.2 + heavy + 1e-3) == end
    assert _upper_end(body, axis, 0.2 + heavy - 1e-3) == -end


@pytest.mark.parametrize("seed", range(3))
def test_what_hangs_by_two_points_has_them_level_and_its_centre_of_mass_below_their_line(seed):
    """However it was turned; the centre of mass is beside the middle of the two, and off their line."""
    bent = asset("bent", shapes.join(shapes.box(0.3, 0.04, 0.1), shapes.box(0.04, 0.2, 0.04).moved(x=0.1, y=0.1)))
    hooked = replace(bent, anchors=((0.02, 0.0, 0.1), (0.14, 0.01, 0.08)))
    rng = np.random.default_rng(seed)
    rotation = turn(rng.normal(size=3), 0.4) @ yaw_matrix(float(rng.uniform(-3, 3)))
    found = _plumb(Group((Body("bent", hooked).at(rotation, np.zeros(3)),)))
    first, second = _anchors(found.root)
    assert first[2] == pytest.approx(second[2], abs=1e-9)
    along = (second - first) / np.linalg.norm(second - first)
    down = found.centre_of_mass - first
    across = down - (down @ along) * along
    np.testing.assert_allclose(across[:2], 0.0, atol=1e-9)
    assert across[2] < -0.01
