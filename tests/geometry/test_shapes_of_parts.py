"""Normals, edges, planes and mass of shapes whose values are known."""

import numpy as np
import pytest
import trimesh

from pat3d.errors import AssetError
from pat3d.geometry.edges import sharp_edges
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.normals import area_vectors, enclosed_volume, triangle_areas, unit_normals
from pat3d.geometry.planes import face_count, plane_distances, planes

SIZE = np.array([0.2, 0.3, 0.5])
BOX = convex_part(np.array([[x, y, z] for x in (0, 0.2) for y in (0, 0.3) for z in (0, 0.5)]) + [5.0, -7.0, 1.0])


def test_a_box_has_six_normals_its_area_and_its_volume():
    corners = BOX.vertices[BOX.faces]
    assert {tuple(np.round(normal, 12) + 0.0) for normal in unit_normals(corners)} == {
        tuple(sign * axis + 0.0) for axis in np.eye(3) for sign in (-1.0, 1.0)
    }
    assert triangle_areas(corners).sum() == pytest.approx(2 * (0.06 + 0.1 + 0.15))
    np.testing.assert_allclose(np.linalg.norm(area_vectors(corners), axis=1), 2 * triangle_areas(corners))
    assert enclosed_volume(corners) == pytest.approx(0.03)
    assert enclosed_volume(corners[:, ::-1]) == pytest.approx(-0.03)


def test_the_diagonals_of_a_box_are_no_edges_of_it():
    ends = BOX.vertices[sharp_edges(BOX)]
    assert len(ends) == 12
    assert sorted(np.round(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), 9)) == [0.2] * 4 + [0.3] * 4 + [0.5] * 4


def test_an_edge_folded_back_on_itself_is_sharp():
    """Two triangles back to back: normals are opposite, their cross product is zero."""
    sheet = ConvexPart(vertices=np.eye(3), faces=np.array([[0, 1, 2], [0, 2, 1]], dtype=np.int32))
    assert len(sharp_edges(sheet)) == 3


LOOSE = np.concatenate([BOX.faces, np.array([[8, 9, 10], [11, 12, 13]], dtype=np.int32)])
"""All edges of the box have two faces; those of two triangles more have one."""


@pytest.mark.parametrize("faces", [BOX.faces[1:], np.concatenate([BOX.faces, BOX.faces]), LOOSE])
def test_an_open_or_doubled_surface_has_no_edges_to_speak_of(faces):
    with pytest.raises(AssetError, match="every edge needs exactly two faces"):
        sharp_edges(ConvexPart(vertices=BOX.vertices, faces=faces))


def test_planes_tell_how_far_a_point_is_outside():
    low = BOX.bounds[0]
    points = np.array([low + SIZE / 2, low + SIZE * [1.5, 0.5, 0.5], low - [0.0, 0.0, 0.25]])
    np.testing.assert_allclose(plane_distances(points, planes(BOX)), [-0.1, 0.1, 0.25], atol=1e-12)


def test_a_turned_box_is_recognised_and_a_squeezed_one_is_not():
    turned = trimesh.transformations.euler_matrix(0.3, -0.5, 0.8)[:3, :3]
    part = convex_part(BOX.vertices @ turned.T)
    assert part.box is not None
    assert sorted(part.box[1]) == pytest.approx([0.1, 0.15, 0.25])
    squeezed = BOX.vertices.copy()
    squeezed[squeezed[:, 2] > 1.2, 0] *= 0.99
    assert convex_part(squeezed).box is None


def test_the_second_moment_of_a_box():
    """Integral of x^2 over a box of mass m and side a is m a^2 / 12 about its centre; products vanish."""
    properties = mass_properties(BOX.vertices, BOX.faces, mass=2.0)
    np.testing.assert_allclose(properties.second_moment, np.diag(2.0 * SIZE**2 / 12), atol=1e-12)
    np.testing.assert_allclose(properties.centre_of_mass, BOX.bounds.mean(axis=0), atol=1e-12)
    x, y, z = 2.0 * SIZE**2 / 12
    np.testing.assert_allclose(properties.inertia, np.diag([y + z, x + z, x + y]), atol=1e-12)


@pytest.mark.parametrize("kept", [np.float64, np.float32])
@pytest.mark.parametrize("sides", [3, 17, 62])
def test_a_prism_has_two_faces_more_than_sides_in_single_precision_too(kept, sides):
    angles = 2.0 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([0.05 * np.cos(angles), 0.05 * np.sin(angles)])
    points = np.vstack([np.column_stack([ring, np.full(sides, height)]) for height in (0.02, 0.024)])
    turned = trimesh.transformations.rotation_matrix(0.7, [1.0, 2.0, 3.0])[:3, :3]
    assert face_count(convex_part((points @ turned.T).astype(kept))) == sides + 2


def test_every_triangle_of_an_icosahedron_is_a_face():
    assert face_count(convex_part(np.asarray(trimesh.creation.icosahedron().vertices))) == 20
    assert face_count(BOX) == 6
