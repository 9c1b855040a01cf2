"""What is seen through: surfaces at known distances, and pictures with and without what is behind."""

import numpy as np
import pytest

from pat3d.geometry.pose import Pose
from pat3d.view.camera import Camera
from pat3d.view.geometry import Geometry
from pat3d.view.panes import peeled
from pat3d.view.render import render
from tests.view.shapes import ball, block

CAMERA = Camera(position=(0.0, -2.0, 0.3), target=(0.0, 0.0, 0.3), field_of_view=20.0)
AT = Pose(position=(0.0, 0.0, 0.3))


def drawn(*items) -> np.ndarray:
    return render(list(items), camera=CAMERA, width=64, height=64, ground=0.0).astype(float)


def middle(picture: np.ndarray) -> np.ndarray:
    return picture[30:34, 30:34].mean(axis=(0, 1))


def test_a_ray_through_two_balls_passes_four_surfaces_of_which_two_face_it():
    """Balls of 10 and 20 cm around one middle, 2 m from the eye, a solid block 1 m behind it."""
    items = [
        (ball(0.1, detail=5), Pose(), 0.3),
        (ball(0.2, detail=5), Pose(), 0.6),
        (block((0.2, 0.2, 0.2)), Pose(position=(0.0, 1.1, 0.0))),
    ]
    geometry = Geometry(items)
    eye = np.array([0.0, -2.0, 0.0]) - geometry.origin
    ray = np.array([[1e-4, 1.0, 2e-4]], dtype=np.float32)
    hits, panes = peeled(geometry, eye.astype(np.float32), ray, 1e-3)
    assert [float(pane.opacity[0]) for pane in panes] == pytest.approx([0.6, 0.3, 0.0, 0.0])
    assert hits.item.tolist() == [2]
    assert hits.distance[0] == pytest.approx(3.0, abs=1e-3)


def test_a_solid_scene_has_no_panes_and_saying_so_changes_no_pixel():
    items = [(ball(0.1), AT), (block(), Pose(position=(0.2, 0.0, 0.05)))]
    assert peeled(Geometry(items), np.array([0, -2, 0], np.float32), np.array([[0, 1, 0]], np.float32), 1e-3)[1] == ()
    np.testing.assert_array_equal(drawn(*items), drawn(*((mesh, pose, 1.0) for mesh, pose in items)))


def test_what_is_in_a_see_through_ball_is_seen_and_fades_with_the_opacity():
    """A red block in a light blue ball: the redder, the clearer the ball."""
    inside, colour = (block((0.08, 0.08, 0.08), colour=(210, 30, 30)), AT), (190, 215, 230)
    red = [middle(drawn(inside, (ball(0.15, colour=colour), AT, opacity))) for opacity in (0.1, 0.4, 0.8, 1.0)]
    more = [float(one[0] - one[2]) for one in red]
    assert more[0] > more[1] > more[2] > more[3]
    assert more[0] > 60.0
    assert more[3] < 0.0


def test_the_edge_of_a_clear_ball_is_seen_better_than_its_middle():
    plain = drawn((block((0.01, 0.01, 0.01)), Pose(position=(0.0, 1.0, 0.005))))
    clear = drawn((block((0.01, 0.01, 0.01)), Pose(position=(0.0, 1.0, 0.005))), (ball(0.15, (90, 120, 120)), AT, 0.05))
    change = np.abs(clear - plain).max(axis=2)[32]
    radius = round(64 * 0.15 / (2.0 * 2.0 * np.tan(np.radians(10.0))))
    assert change[32 - radius : 32 - radius + 3].max() > change[32] + 10.0


def test_the_shadow_of_a_see_through_ball_is_between_that_of_a_solid_one_and_none():
    low = Pose(position=(0.0, 0.0, 0.11))
    camera = Camera(position=(0.0, -2.0, 2.0), target=(0.0, 0.0, 0.0), field_of_view=30.0)

    def darkest(*opacity: float) -> float:
        items = [(block((0.02, 0.02, 0.02)), Pose(position=(0.0, 0.5, 0.01))), *((ball(0.1), low, o) for o in opacity)]
        picture = render(items, camera=camera, width=96, height=96, ground=0.0)
        # The ground beside the ball.
        return float(np.sort(picture[40:75, :, 0].astype(float).ravel())[:300].mean())

    solid, clear, none = darkest(1.0), darkest(0.02), darkest()
    assert solid + 10.0 < clear < none - 1.0
