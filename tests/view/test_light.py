import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.view import light
from pat3d.view.camera import Camera
from pat3d.view.denoise import smooth
from pat3d.view.geometry import Geometry
from tests.view.shapes import ball

STUDIO = light.Studio.facing(Camera(position=(0.0, -1.0, 0.5), target=(0.0, 0.0, 0.0)).axes)
TILES = np.tile(np.arange(64, dtype=np.int32), 5)


def test_sample_set_puts_one_point_in_every_elementary_interval():
    points = light.sample_set(16, 4, seed=3).reshape(-1, 2)
    for columns in (1, 2, 4, 8, 16, 32, 64):
        cell = np.floor(points * (columns, 64 // columns)).astype(int)
        assert len({tuple(pair) for pair in cell}) == 64


def test_frames_are_right_handed_and_aligned():
    rng = np.random.default_rng(0)
    axis = rng.normal(size=(100, 3)).astype(np.float32)
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    columns = [light.around(axis, np.tile(np.eye(3, dtype=np.float32)[k], (100, 1))) for k in range(3)]
    frames = np.stack(columns, axis=2)
    np.testing.assert_allclose(frames.transpose(0, 2, 1) @ frames, np.broadcast_to(np.eye(3), (100, 3, 3)), atol=1e-5)
    np.testing.assert_allclose(np.linalg.det(frames), 1.0, atol=1e-5)
    np.testing.assert_allclose(columns[2], axis, atol=1e-6)


def test_open_ground_gets_the_whole_sky():
    geometry = Geometry([(ball(0.01), Pose(position=(50.0, 0.0, 0.0)))])
    up = np.tile(np.array([0.0, 0.0, 1.0], dtype=np.float32), (len(TILES), 1))
    points = np.zeros_like(up) - geometry.origin.astype(np.float32)
    dark = np.zeros_like(geometry.face_colours)
    found = light.sky_light(geometry, STUDIO, dark, None, points, up, TILES, seed=0)
    np.testing.assert_allclose(found.mean(axis=0), STUDIO.open_sky, rtol=5e-3)


def test_ball_hides_the_sky_by_its_form_factor():
    """A ball straight above covers sin^2 of its half angle of the cosine-weighted sky."""
    geometry = Geometry([(ball(0.5), Pose(position=(0.0, 0.0, 1.0)))])
    up = np.tile(np.array([0.0, 0.0, 1.0], dtype=np.float32), (len(TILES), 1))
    points = np.tile(np.array([0.0, 0.0, -1.0], dtype=np.float32), (len(TILES), 1))
    glow = np.ones_like(geometry.face_colours)
    level = np.full(3, 0.0, dtype=np.float32)
    black = light.Studio(
        key_direction=STUDIO.key_direction,
        fill_direction=STUDIO.fill_direction,
        key=level,
        fill=level,
        zenith=level,
        horizon=level,
    )
    found = light.sky_light(geometry, black, glow, None, points, up, TILES, seed=0)
    assert abs(found.mean() - 0.25) < 0.02


def test_key_light_is_seen_in_the_open_and_hidden_behind_a_ball():
    geometry = Geometry([(ball(0.5), Pose())])
    towards = STUDIO.key_direction
    normals = np.tile(towards, (len(TILES), 1))
    behind = np.tile(-1.0 * towards, (len(TILES), 1)).astype(np.float32)
    assert light.key_visibility(geometry, STUDIO, behind, normals, TILES, seed=0).max() == 0.0
    assert light.key_visibility(geometry, STUDIO, -behind, normals, TILES, seed=0).min() == 1.0


def test_smoothing_averages_a_tile_pattern_to_its_mean_and_respects_borders():
    h, w = 48, 40
    rows, columns = np.indices((h, w))
    flat = (rows.reshape(-1).astype(np.int32), columns.reshape(-1).astype(np.int32))
    places = light.tile_places(*flat).reshape(h, w)
    pattern = np.stack([places, places, places, places % 16], axis=2).astype(np.float32)
    surface = np.where(columns < 20, 1, 2).astype(np.int32)
    position = np.stack([columns, rows, np.zeros((h, w))], axis=2).astype(np.float32)
    normal = np.broadcast_to(np.array([0.0, 0.0, 1.0], dtype=np.float32), (h, w, 3))
    pixel = np.ones((h, w), dtype=np.float32)
    even = smooth(pattern, np.ones_like(surface), position, normal, pixel)
    inner = even[8:-8, 8:-8]
    np.testing.assert_allclose(inner, np.broadcast_to([31.5, 31.5, 31.5, 7.5], inner.shape), atol=1e-4)
    halves = np.repeat(np.where(columns < 20, 0.0, 1.0)[..., None], 4, axis=2).astype(np.float32)
    np.testing.assert_array_equal(smooth(halves, surface, position, normal, pixel), halves)
