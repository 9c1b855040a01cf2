"""Contacts of boxes that cannot be are mended, and those that can be stay as they are."""

from __future__ import annotations

import numpy as np
import pytest

wp = pytest.importorskip("warp")

from pat3d.envs.batch.phantoms import BOX, NOWHERE, mend_phantoms  # noqa: E402

GROUND, BRICK = (5.0, 5.0, 0.5), (0.1, 0.05, 0.02)
DEPTH = 3e-5


def _mended(place, dist, *, brick=(1.0, 2.0, 0.02 - DEPTH), shape=6, normal=(0.0, 0.0, 1.0), first=0):
    """Place and distance of a contact between the ground below z = 0, geom 0, and a brick turned by 30 degrees."""
    turned = np.array([[0.75**0.5, -0.5, 0.0], [0.5, 0.75**0.5, 0.0], [0.0, 0.0, 1.0]])
    frame = np.zeros((1, 3, 3))
    frame[0, 0] = normal

    def array(values, dtype):
        return wp.array(np.asarray(values), dtype=dtype, device="cpu")

    places, distances = array([place], wp.vec3), array([dist], wp.float32)
    wp.launch(
        mend_phantoms,
        dim=2,
        inputs=[
            array([1], int),
            array([[first, 1 - first]], wp.vec2i),
            array(frame, wp.mat33),
            array([0], int),
            array([BOX, shape], int),
            array([[GROUND, BRICK]], wp.vec3),
            array([[(0.0, 0.0, -0.5), brick]], wp.vec3),
            array([[np.eye(3), turned]], wp.mat33),
            places,
            distances,
        ],
        device="cpu",
    )
    return places.numpy()[0], float(distances.numpy()[0])


@pytest.mark.parametrize("first", [0, 1])
def test_a_contact_deeper_than_the_boxes_overlap_comes_under_the_middle_of_the_smaller(first):
    """The normal is from the first geom to the second."""
    place, dist = _mended((1.4, 1.7, 0.0), -0.78, first=first, normal=(0.0, 0.0, 1.0 - 2.0 * first))
    # Single precision knows half a metre to 6e-8.
    np.testing.assert_allclose(place, (1.0, 2.0, -0.5 * DEPTH), atol=2e-7)
    assert dist == pytest.approx(-DEPTH, abs=2e-7)


def test_under_a_box_that_hangs_over_the_edge_there_is_nothing():
    _, dist = _mended((1.4, 1.7, 0.0), -0.78, brick=(5.01, 2.0, 0.02 - DEPTH))
    assert dist == NOWHERE


@pytest.mark.parametrize("dist", [-DEPTH, -1e-6, 2e-5])
def test_contacts_that_can_be_stay(dist):
    place, found = _mended((1.08, 2.09, 0.0), dist)
    np.testing.assert_array_equal(place, np.float32((1.08, 2.09, 0.0)))
    assert found == np.float32(dist)


def test_other_shapes_are_left_alone():
    place, dist = _mended((1.4, 1.7, 0.0), -0.78, shape=7)
    np.testing.assert_array_equal(place, np.float32((1.4, 1.7, 0.0)))
    assert dist == np.float32(-0.78)


def test_a_normal_that_is_aslant_measures_the_overlap_along_itself():
    """Along (0.6, 0, 0.8) the boxes overlap by the sum of what each reaches, less the distance of their middles."""
    normal = (0.6, 0.0, 0.8)
    reach = 0.6 * 5.0 + 0.8 * 0.5
    turned = np.array([[0.75**0.5, -0.5, 0.0], [0.5, 0.75**0.5, 0.0], [0.0, 0.0, 1.0]])
    reach += float(np.abs(turned.T @ normal) @ BRICK)
    overlap = reach - abs(0.6 * 1.0 + 0.8 * (0.52 - DEPTH))
    assert _mended((1.0, 2.0, 0.0), -0.999 * overlap, normal=normal)[1] == np.float32(-0.999 * overlap)
    assert _mended((1.0, 2.0, 0.0), -1.001 * overlap, normal=normal)[1] != np.float32(-1.001 * overlap)
