"""The union of convex parts contains the visual mesh: its points, and what is between them."""

import numpy as np
import pytest
import trimesh

from pat3d.assets.mesh.cover import TOLERANCE, cover, outside, surface_patches, surface_points

LEFT = np.array([[x, y, z] for x in (0.0, 0.09) for y in (0.0, 0.1) for z in (0.0, 0.1)])
RIGHT = LEFT + [0.11, 0.0, 0.0]
"""Two blocks with a slit of 2 cm between them."""


def _bar():
    """A bar through both blocks, whose corners are in them and whose middle is in the slit."""
    mesh = trimesh.creation.box((0.03, 0.02, 0.02))
    return mesh.vertices + [0.1, 0.05, 0.05], np.asarray(mesh.faces)


def test_patches_have_the_area_of_the_mesh_and_its_points():
    mesh = trimesh.creation.icosphere(subdivisions=1)
    points, triangles = surface_patches(mesh.vertices, mesh.faces)
    corners = points[triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert areas.sum() == pytest.approx(mesh.area, rel=1e-12)
    assert len(triangles) > 50 * len(mesh.faces)
    np.testing.assert_array_equal(points, surface_points(mesh.vertices, mesh.faces))


def test_patches_of_small_faces_are_the_faces():
    vertices, faces = LEFT, np.array([[0, 1, 3], [0, 3, 2]])
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    for _ in range(7):
        mesh = mesh.subdivide()
    points, triangles = surface_patches(mesh.vertices, mesh.faces)
    assert len(points) == len(np.unique(mesh.faces))
    assert sorted(map(sorted, points[triangles].mean(axis=1).tolist())) == sorted(
        map(sorted, mesh.triangles.mean(axis=1).tolist())
    )


def test_points_alone_leave_a_bar_that_crosses_a_slit_outside():
    vertices, _ = _bar()
    done = cover([LEFT, RIGHT], vertices)
    assert done.before == done.after == 0.0
    assert outside(np.array([[0.1, 0.05, 0.05]]), done.parts)[0][0] == pytest.approx(0.01)


def test_a_triangle_whose_corners_are_in_different_parts_is_given_to_one():
    vertices, faces = _bar()
    parts = cover([LEFT, RIGHT], vertices, faces).parts
    dense = trimesh.sample.sample_surface(trimesh.Trimesh(vertices, faces, process=False), 5000, seed=0)[0]
    assert outside(dense, parts)[0].max() <= TOLERANCE


def test_points_outside_all_parts_are_contained_at_the_end():
    far = np.array([[0.3, 0.05, 0.05], [-0.02, 0.0, 0.0]])
    done = cover([LEFT, RIGHT], far)
    assert done.before == pytest.approx(0.1)
    assert done.after <= TOLERANCE
    assert outside(far, done.parts)[0].max() <= TOLERANCE


def test_the_part_that_is_nearest_grows_and_the_other_stays():
    stray = np.array([[0.215, 0.05, 0.05]])
    done = cover([LEFT, RIGHT], stray)
    assert done.before == pytest.approx(0.015, abs=1e-6)
    assert done.after <= TOLERANCE
    parts = done.parts
    assert parts[0].bounds.tolist() == [LEFT.min(axis=0).tolist(), LEFT.max(axis=0).tolist()]
    assert parts[1].bounds[1, 0] == pytest.approx(0.215, abs=TOLERANCE)
