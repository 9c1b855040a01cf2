import numpy as np
import trimesh
from scipy.ndimage import map_coordinates

from pat3d.geometry.normals import crease_normals
from pat3d.geometry.pose import Pose
from pat3d.view.geometry import Geometry
from pat3d.view.textures import TextureAtlas
from pat3d.view.tone import compress, decode, encode, quantise
from tests.view.shapes import ball, block


def test_normals_are_smooth_on_a_sphere():
    mesh = ball(radius=1.0, detail=3)
    normals = crease_normals(mesh.vertices, mesh.faces)
    cosine = np.einsum("fci,fci->fc", normals, mesh.vertices[mesh.faces])
    assert np.degrees(np.arccos(cosine.min())) < 2.0


def test_normals_are_sharp_on_a_cube():
    mesh = trimesh.creation.box((1.0, 2.0, 3.0))
    normals = crease_normals(np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32))
    np.testing.assert_allclose(normals, np.repeat(mesh.face_normals[:, None], 3, axis=1), atol=1e-6)


def test_normals_of_a_cylinder_are_radial_on_the_side_and_axial_on_the_caps():
    mesh = trimesh.creation.cylinder(radius=1.0, height=2.0, sections=24)
    normals = crease_normals(np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32))
    side = np.abs(mesh.face_normals[:, 2]) < 0.5
    np.testing.assert_allclose(np.abs(normals[~side][..., 2]), 1.0, atol=1e-6)
    radial = np.array(mesh.vertices)[mesh.faces[side]] * (1.0, 1.0, 0.0)
    # A vertex of the side has one or two triangles on its left, so its mean leans by less than half a segment.
    cosine = np.einsum("fci,fci->fc", normals[side], radial)
    assert np.degrees(np.arccos(cosine.min())) < 0.5 * 360 / 24


def test_slivers_do_not_bend_the_normals_of_a_flat_face():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, -1e-7, 1e-7]], dtype=float)
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 4, 1]], dtype=np.int32)
    normals = crease_normals(vertices, faces)
    np.testing.assert_allclose(normals[:2], np.broadcast_to([0.0, 0.0, 1.0], (2, 3, 3)), atol=1e-5)


def test_rays_hit_where_trimesh_says():
    pose = Pose.from_yaw(0.7, (0.3, -0.2, 0.1))
    mesh = block((0.2, 0.3, 0.1))
    geometry = Geometry([(mesh, pose)])
    rng = np.random.default_rng(0)
    rays = rng.normal(size=(200, 3)) * 0.08 + (0.0, 1.0, 0.0)
    rays = (rays / np.linalg.norm(rays, axis=1)[:, None]).astype(np.float32)
    eye = np.array([0.3, -1.5, 0.15])
    hits = geometry.trace((eye - geometry.origin).astype(np.float32), rays, 1e-3)
    oracle = trimesh.Trimesh(pose.apply(mesh.vertices), mesh.faces, process=False)
    points, which, _ = trimesh.ray.ray_triangle.RayMeshIntersector(oracle).intersects_location(
        np.tile(eye, (200, 1)), rays, multiple_hits=False
    )
    assert 20 < len(which) < 200
    order = np.argsort(which)
    np.testing.assert_array_equal(hits.which, which[order])
    np.testing.assert_allclose(hits.point + geometry.origin, points[order], atol=1e-5)


def test_texture_lookup_matches_scipy_bilinear_in_linear_light():
    rng = np.random.default_rng(1)
    image = rng.integers(0, 256, size=(90, 130, 3), dtype=np.uint8)
    uv = rng.random((500, 2)).astype(np.float32)
    atlas = TextureAtlas([np.zeros((4, 4, 3), dtype=np.uint8), image])
    found = atlas.colour(np.ones(500, dtype=np.int32), uv, np.full(500, 0.5, dtype=np.float32))
    rows, columns = (1 - uv[:, 1]) * 90 - 0.5, uv[:, 0] * 130 - 0.5
    expected = [
        map_coordinates(decode(image[..., channel] / 255.0), [rows, columns], order=1, mode="nearest")
        for channel in range(3)
    ]
    np.testing.assert_allclose(found, np.stack(expected, axis=1), atol=1e-3)


def test_distant_texture_shows_its_mean_light():
    board = np.kron(np.indices((64, 64)).sum(axis=0) % 2, np.ones((2, 2)))[..., None] * np.array([255, 255, 255])
    atlas = TextureAtlas([board.astype(np.uint8)])
    uv = np.random.default_rng(2).random((50, 2)).astype(np.float32)
    far = atlas.colour(np.zeros(50, dtype=np.int32), uv, np.full(50, 64.0, dtype=np.float32))
    np.testing.assert_allclose(far, 0.5, atol=0.01)


def test_tone_keeps_colours_below_the_shoulder_and_never_clips():
    values = np.linspace(0.0, 1.0, 256)
    np.testing.assert_allclose(encode(decode(values)), values, atol=1e-5)
    assert float(decode(0.5)) == np.float32(0.21404114)
    light = np.linspace(0.0, 20.0, 2000, dtype=np.float32)
    shown = compress(light)
    np.testing.assert_array_equal(shown[light < 0.7], light[light < 0.7])
    assert np.all(np.diff(shown) >= 0.0)
    assert shown.max() <= 1.0


def test_quantisation_keeps_the_mean_and_stays_within_a_level():
    row, column = np.divmod(np.arange(64 * 64, dtype=np.int32), np.int32(64))
    for level in (0.0, 100.3, 199.9, 255.0):
        stored = quantise(decode(np.full((64 * 64, 3), level / 255.0)), row, column).astype(float)
        assert np.abs(stored - level).max() <= 1.0
        assert abs(stored.mean() - level) < 0.05
