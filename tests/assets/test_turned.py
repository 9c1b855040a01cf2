"""Parts of turned solids: around the solid, no further beyond it than is said, few."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from pat3d.assets.rounded import arc
from pat3d.assets.turned import EXACT, allowed, outline, sides_of, turned_parts
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.planes import face_count

BALL = 0.03 * arc(1.0, -90, 90, 40)
BOTTLE = np.array([(0.030, 0.0), (0.033, 0.003), (0.033, 0.14), (0.028, 0.16), (0.012, 0.18), (0.012, 0.2)])
CAN = np.array([(0.033, 0.0), (0.033, 0.1)])
PROFILES = {"ball": BALL, "bottle": BOTTLE, "can": CAN, "funnel": np.array([(0.01, 0.0), (0.01, 0.05), (0.06, 0.1)])}


def parts_of(profile: np.ndarray, **given) -> list[np.ndarray]:
    return turned_parts(profile, (float(profile[:, 1].min()), float(profile[:, 1].max())), **given)


def beyond(points: np.ndarray, profile: np.ndarray) -> np.ndarray:
    """Distance of `points` from the solid that `profile` bounds, found by sampling the profile."""
    at = np.linspace(0, len(profile) - 1, 4000)
    fine = np.column_stack([np.interp(at, np.arange(len(profile)), profile[:, k]) for k in (0, 1)])
    reach = np.column_stack([np.hypot(points[:, 0], points[:, 1]), points[:, 2]])
    inside = reach[:, 0] <= np.interp(reach[:, 1], fine[:, 1], fine[:, 0]) + 1e-9
    return np.where(inside, 0.0, np.linalg.norm(reach[:, None] - fine, axis=2).min(axis=1))


@pytest.mark.parametrize("name", sorted(PROFILES))
def test_parts_contain_the_solid_and_have_corners_and_faces_that_a_gpu_takes(name: str):
    profile = PROFILES[name]
    hulls = parts_of(profile)
    turn = np.linspace(0.0, 2 * np.pi, 97)
    solid = np.concatenate([np.column_stack([r * np.cos(turn), r * np.sin(turn), np.full(97, z)]) for r, z in profile])
    sides = [ConvexHull(hull).equations for hull in hulls]
    assert np.min([(solid @ one[:, :3].T + one[:, 3]).max(axis=1) for one in sides], axis=0).max() < 1e-8
    for part in map(convex_part, hulls):
        assert len(part.vertices) <= 64
        assert face_count(part) <= 64


@pytest.mark.parametrize(("name", "share"), [("ball", 1.2), ("bottle", 1.0), ("can", 1.0), ("funnel", 1.0)])
def test_corners_are_within_what_is_allowed_beyond_the_solid(name: str, share: float):
    """Seven parts leave 1.2 of it around a ball; one part of 64 corners 8 % of the radius at best, 4 times of it."""
    profile = PROFILES[name]
    size = max(float(np.ptp(profile[:, 1])), 2 * float(profile[:, 0].max()))
    assert max(beyond(hull, profile).max() for hull in parts_of(profile)) <= share * allowed(size)


def test_base_keeps_its_outline():
    hulls = parts_of(BOTTLE)
    points = np.concatenate(hulls)
    base = points[points[:, 2] < 1e-9]
    assert np.hypot(base[:, 0], base[:, 1]).max() - 0.030 <= EXACT
    (can,) = parts_of(CAN)
    assert np.hypot(can[:, 0], can[:, 1]).max() - 0.033 <= EXACT


def test_nothing_reaches_beyond_a_plane_that_is_kept():
    """A carrot lies on the plane that touches it along one side, whatever its parts are."""
    slope = math.radians(-30.0)
    normal = np.array([math.cos(slope), math.sin(slope)])
    furthest = float((BALL @ normal).max())
    for hull in parts_of(BALL, angles=(-30.0, 0.0)):
        # The side of a regular polygon that faces x is as far out as the circle.
        assert (hull[:, [0, 2]] @ normal).max() <= furthest + 1e-9


def test_sides_are_as_few_as_keep_corners_close():
    assert sides_of(0.005) == 16
    for radius in (0.012, 0.02, 0.04):
        n = sides_of(radius)
        assert radius * (1 / math.cos(math.pi / n) - 1) <= EXACT
    assert sides_of(0.5) == 32


def test_outline_is_outside_of_a_piece_and_convex():
    corners = outline(BOTTLE, 0.0, 6)
    assert len(corners) <= 6
    slopes = np.diff(corners[:, 0]) / np.diff(corners[:, 1])
    assert (np.diff(slopes) < 1e-9).all()
    assert (BOTTLE[:, 0] <= np.interp(BOTTLE[:, 1], corners[:, 1], corners[:, 0]) + 1e-9).all()
