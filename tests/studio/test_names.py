"""Names stand where one sees them apart: none overlaps another, those of a stack are in its order."""

import numpy as np
import pytest

from pat3d.scene.io import load_scene
from pat3d.studio.names import AROUND, FARTHEST, HEIGHT, LETTER, Eye, arranged, standing
from tests.studio.bricks import bricks_in

UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Of an eye that looks along +y."""


def eye(rotation=UP, position=(0.0, -1.0, 0.0)):
    return Eye(position=np.array(position), rotation=rotation, focal=900.0)


def boxes(seen_by, places, names):
    """Left, right, top and bottom [pixels] of the names that are shown."""
    found = []
    for (x, y, _), name in zip(seen_by.seen(places), names, strict=True):
        if np.isnan(x):
            continue
        half = (LETTER * len(name) + AROUND) / 2
        found.append((x - half, x + half, y - HEIGHT, y))
    return found


def overlap(a, b):
    slack = 1e-6
    return a[0] < b[1] - slack and b[0] < a[1] - slack and a[2] < b[3] - slack and b[2] < a[3] - slack


def test_a_point_is_seen_where_a_pinhole_sees_it():
    np.testing.assert_allclose(eye().seen(np.array([[0.2, 1.0, 0.1]])), [[90.0, -45.0, 2.0]])


def test_a_name_with_nothing_in_its_way_stands_at_its_point():
    points = np.array([[0.0, 0.0, 0.0], [0.3, 0.0, 0.0]])
    np.testing.assert_array_equal(arranged(eye(), points, ["mug", "vase"]), points)


def test_the_names_of_a_stack_stand_one_above_the_other_in_its_order():
    heights = np.array([0.02, 0.0, 0.01])
    points = np.stack([np.zeros(3), np.zeros(3), heights], axis=1)
    names = ["top book", "bottom book", "middle book"]
    places = arranged(eye(), points, names)
    assert list(np.argsort(places[:, 2])) == [1, 2, 0]
    np.testing.assert_allclose(np.diff(np.sort(eye().seen(places)[:, 1])), HEIGHT)
    # As deep as before, straight above.
    np.testing.assert_allclose(places[:, :2], 0.0, atol=1e-12)


@pytest.mark.parametrize("seed", range(20))
def test_no_name_overlaps_another_however_many_there_are(seed):
    random = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
    seen_by = eye(turn, random.uniform(-1, 1, 3))
    points = seen_by.position + random.uniform((-0.3, -0.2, 0.5), (0.3, 0.2, 2.0), (40, 3)) @ turn.T
    names = ["x" * int(count) for count in random.integers(1, 20, 40)]
    places = arranged(seen_by, points, names)
    found = boxes(seen_by, places, names)
    assert len(found) > 10
    assert not any(overlap(a, b) for k, a in enumerate(found) for b in found[:k])
    raised = seen_by.seen(points)[:, 1] - seen_by.seen(places)[:, 1]
    assert np.nanmax(raised) <= FARTHEST * HEIGHT + 1e-6


def test_what_carries_others_is_named_at_its_front(tmp_path):
    points = standing(load_scene(bricks_in(tmp_path / "bricks")))
    np.testing.assert_allclose(points["board"][:2], (0.0, -0.1), atol=1e-9)
    np.testing.assert_allclose(points["brick"][:2], (0.05, 0.0), atol=1e-9)
    assert points["brick"][2] > 0.06


def test_what_is_behind_the_eye_or_has_no_room_has_no_name():
    assert np.isnan(arranged(eye(), np.array([[0.0, -2.0, 0.0]]), ["mug"])).all()
    many = arranged(eye(), np.zeros((FARTHEST + 3, 3)), ["book"] * (FARTHEST + 3))
    assert np.isnan(many[:, 0]).sum() == 2
