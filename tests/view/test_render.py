import math
import warnings

import numpy as np
import pytest
import trimesh

from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import VisualMesh
from pat3d.view.camera import Camera
from pat3d.view.light import Studio
from pat3d.view.render import frame_items, render
from tests.view.shapes import ball, block


@pytest.fixture(autouse=True)
def _warnings_are_errors():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def brightness(picture: np.ndarray, camera: Camera, point: tuple[float, float, float]) -> float:
    """Mean of 5 x 5 pixels around a world point [m]."""
    height, width = picture.shape[:2]
    x, y = camera.project(np.array([point]), width, height)[0].astype(int)
    return float(picture[y - 2 : y + 3, x - 2 : x + 3].mean())


@pytest.mark.parametrize("samples", [1, 8])
def test_silhouette_of_a_sphere_has_the_area_of_its_projection(samples):
    """A sphere in the middle of the picture is a disc of radius f r / sqrt(d^2 - r^2)."""
    radius, distance, size = 0.3, 2.0, 400
    camera = Camera(position=(0.0, -distance, 0.0), target=(0.0, 0.0, 0.0), field_of_view=30.0)
    mesh = ball(radius, colour=(20, 20, 20), detail=5)
    picture = render([(mesh, Pose())], camera=camera, width=size, height=size, ground=None, samples=samples)
    backdrop = picture[0, 0].astype(float).mean()
    focal = size / (2.0 * math.tan(math.radians(15.0)))
    expected = math.pi * (focal * radius / math.sqrt(distance**2 - radius**2)) ** 2
    covered = np.count_nonzero(picture.mean(axis=2) < backdrop / 2 + 30)
    # The border's pixels are half inside on average; 0.5 % is a tenth of a pixel of radius.
    assert covered == pytest.approx(expected, rel=0.005)


def test_edges_are_supersampled():
    camera = Camera(position=(0.0, -2.0, 0.0), target=(0.0, 0.0, 0.0), field_of_view=30.0)
    arguments = {"camera": camera, "width": 120, "height": 120, "ground": None}
    rough = render([(ball(0.3, colour=(20, 20, 20)), Pose())], samples=1, **arguments)
    fine = render([(ball(0.3, colour=(20, 20, 20)), Pose())], samples=8, **arguments)

    def between(picture):
        return np.count_nonzero((picture.mean(axis=2) > 110) & (picture.mean(axis=2) < 200))

    # A few pixels of the rim reflect the sky in a middle grey of their own.
    assert between(fine) > 5 * between(rough)
    assert between(fine) > 100


def textured_panel() -> VisualMesh:
    """A block whose front is red on its upper left, green upper right, blue lower left, yellow lower right."""
    box = trimesh.creation.box((0.4, 0.1, 0.4))
    vertices, faces = np.array(box.vertices), np.array(box.faces, dtype=np.int32)
    uv = np.clip((vertices[faces][..., [0, 2]] + 0.2) / 0.4, 0.0, 1.0)
    texture = np.zeros((128, 128, 3), dtype=np.uint8)
    texture[:64, :64], texture[:64, 64:] = (200, 40, 40), (40, 180, 40)
    texture[64:, :64], texture[64:, 64:] = (40, 40, 200), (200, 190, 40)
    return VisualMesh(vertices=vertices, faces=faces, uv=uv, texture=texture)


@pytest.mark.parametrize(
    ("corner", "hue"), [((-0.1, 0.1), 0), ((0.1, 0.1), 120), ((-0.1, -0.1), 240), ((0.1, -0.1), 56)]
)
def test_texture_appears_the_right_way_up_in_its_own_hue(corner, hue):
    import colorsys

    item = (textured_panel(), Pose(position=(0.0, 0.0, 0.2)))
    camera = frame_items([item])
    picture = render([item], camera=camera, width=240, height=180)
    x, y = camera.project(np.array([[corner[0], -0.05, 0.2 + corner[1]]]), 240, 180)[0].astype(int)
    seen, _, _ = colorsys.rgb_to_hsv(*(picture[y, x] / 255.0))
    assert abs((seen * 360 - hue + 180) % 360 - 180) < 8


def test_ground_is_darker_in_the_shadow_of_a_ball():
    items = [(ball(0.05), Pose(position=(0.0, 0.0, 0.12)))]
    camera = Camera(position=(0.2, -1.0, 0.6), target=(0.0, 0.0, 0.05), field_of_view=40.0)
    picture = render(items, camera=camera, width=320, height=240)
    towards = Studio.facing(camera.axes).key_direction
    reach = 0.12 / float(towards[2])
    shadow = (-reach * float(towards[0]), -reach * float(towards[1]), 0.0)
    lit = brightness(picture, camera, (-0.25, -0.1, 0.0))
    assert brightness(picture, camera, shadow) < 0.75 * lit
    assert lit > 200


def test_ground_darkens_towards_a_contact():
    items = [(block((0.2, 0.2, 0.2)), Pose(position=(0.0, 0.0, 0.1)))]
    camera = Camera(position=(0.0, -1.0, 1.0), target=(0.0, 0.0, 0.05), field_of_view=40.0)
    picture = render(items, camera=camera, width=320, height=240)
    assert brightness(picture, camera, (0.0, -0.115, 0.0)) < brightness(picture, camera, (0.0, -0.35, 0.0)) - 5


def test_inside_of_a_closed_corner_is_not_black():
    """One bounce of light keeps an object that stands in shadow readable."""
    items = [
        (block((0.3, 0.3, 0.02), (220, 210, 200)), Pose(position=(0.0, 0.0, 0.2))),
        (ball(0.04, (180, 60, 50)), Pose(position=(0.0, 0.0, 0.04))),
    ]
    camera = Camera(position=(0.0, -1.0, 0.1), target=(0.0, 0.0, 0.08), field_of_view=30.0)
    picture = render(items, camera=camera, width=240, height=180)
    assert brightness(picture, camera, (0.0, -0.04, 0.04)) > 40


def test_shading_is_smooth_on_a_ball_and_flat_on_a_cube():
    camera = Camera(position=(0.0, -2.0, 0.0), target=(0.0, 0.0, 0.0), field_of_view=12.0)
    arguments = {"camera": camera, "width": 200, "height": 200, "ground": None}
    rounded = render([(ball(0.15, (150, 150, 150), detail=3), Pose())], **arguments)[60:140, 60:140].mean(axis=2)
    # Steps between facets of a coarse ball would stand out as second differences.
    assert np.abs(np.diff(rounded, n=2, axis=1)).max() < 6
    face = render([(block((0.2, 0.2, 0.2), (150, 150, 150)), Pose())], **arguments)[70:130, 70:130].mean(axis=2)
    assert np.ptp(face) < 8


def test_flat_ground_shows_no_grain():
    items = [(block(), Pose(position=(0.0, 0.0, 0.05)))]
    picture = render(items, width=320, height=240).astype(float).mean(axis=2)
    corner = picture[:40, :80]
    assert np.abs(corner - corner.mean(axis=1, keepdims=True)).max() < 4


def test_same_arguments_give_the_same_picture_bit_for_bit():
    items = [(ball(), Pose(position=(0.0, 0.0, 0.05))), (block(), Pose.from_yaw(0.3, (0.15, 0.1, 0.05)))]
    first = render(items, width=160, height=120)
    again = render([(ball(), items[0][1]), (block(), items[1][1])], width=160, height=120)
    np.testing.assert_array_equal(first, again)


def test_picture_does_not_depend_on_where_the_scene_is():
    def at(x):
        return [(block(), Pose(position=(x, 0.0, 0.05)))]

    here, there = (render(at(x), width=160, height=120).astype(int) for x in (0.0, 40.0))
    assert np.percentile(np.abs(here - there), 99) <= 2


def test_every_frame_of_a_video_may_use_one_camera():
    mesh = ball()
    poses = [Pose(position=(0.0, 0.0, z)) for z in (0.3, 0.1)]
    camera = frame_items([(mesh, pose) for pose in poses])
    frames = [render([(mesh, pose)], camera=camera, width=80, height=60) for pose in poses]
    heights = [np.argmax((frame[..., 0].astype(int) - frame[..., 2]).max(axis=1) > 60) for frame in frames]
    assert heights[0] < heights[1]


def test_back_sides_of_an_open_mesh_are_lit():
    sheet = trimesh.Trimesh([[-0.2, 0, 0], [0.2, 0, 0], [0.2, 0, 0.4], [-0.2, 0, 0.4]], [[0, 2, 1], [0, 3, 2]])
    mesh = VisualMesh.from_face_colours(
        np.array(sheet.vertices), np.array(sheet.faces, dtype=np.int32), np.full((2, 3), 180, dtype=np.uint8)
    )
    camera = frame_items([(mesh, Pose())])
    picture = render([(mesh, Pose())], camera=camera, width=160, height=120)
    assert brightness(picture, camera, (0.0, 0.0, 0.2)) > 90


def test_nothing_to_draw_and_bad_sizes_are_refused():
    with pytest.raises(SpecError, match="nothing to draw"):
        render([])
    with pytest.raises(SpecError, match="8 to 8192"):
        render([(block(), Pose())], width=100_000)
    empty = VisualMesh(
        vertices=np.zeros((0, 3)),
        faces=np.zeros((0, 3), dtype=np.int32),
        uv=np.zeros((0, 3, 2)),
        texture=np.zeros((4, 4, 3), dtype=np.uint8),
    )
    with pytest.raises(SpecError, match="no triangles"):
        render([(empty, Pose())])
