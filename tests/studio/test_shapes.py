"""What pages draw of a scene: fewer triangles from afar, one mesh for many parts, and lines around the objects."""

import io
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh

from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Material, VisualMesh
from pat3d.studio.shapes import FEW, METALLIC, OUTWARD, SEEN, glb, joined, levels
from pat3d.studio.surroundings import CELLS, extent, lines
from tests.scenes import asset_of


def visual_of(mesh):
    return VisualMesh.from_face_colours(mesh.vertices, mesh.faces, np.full((len(mesh.faces), 3), 99, dtype=np.uint8))


def loaded(data) -> Any:
    return trimesh.load(io.BytesIO(data), file_type="glb")


def test_what_a_ball_loses_with_distance_cannot_be_seen():
    """The sagitta of a sphere's triangles, from their longest side, is less than what is seen from there."""
    ball = replace(asset_of(box(0.1, 0.1, 0.1)), visual=visual_of(trimesh.creation.icosphere(radius=0.05)))
    count = len(ball.visual.faces)
    assert count > FEW
    steps = levels(ball)
    assert [share for _, share in steps] == sorted((share for _, share in steps), reverse=True)
    for distance, share in steps:
        side = np.sqrt(4 / np.sqrt(3) * 4 * np.pi * 0.05**2 / (share * count))
        assert 0.05 - np.sqrt(0.05**2 - side**2 / 4) < SEEN * distance


def test_a_mesh_of_few_triangles_stays_as_it_is():
    assert levels(asset_of(box(0.3, 0.2, 0.02), noun="board")) == ()


def test_joined_meshes_are_where_each_was_and_a_little_larger():
    cube = trimesh.creation.box((1.0, 1.0, 1.0))
    places = [Pose.from_yaw(0.3 * k, (2.0 * k, 0.0, 0.0)) for k in range(3)]
    vertices, faces = joined((place, cube.vertices, cube.faces) for place in places)
    pieces = trimesh.Trimesh(vertices, faces).split()
    assert [piece.is_watertight for piece in pieces] == [True] * 3
    assert all(1.0 < piece.volume < (1.0 + 2.0 * OUTWARD) ** 3 for piece in pieces)
    centres = sorted(tuple(piece.center_mass.round(3)) for piece in pieces)
    assert centres == [(0, 0, 0), (2, 0, 0), (4, 0, 0)]


def test_the_mesh_of_an_object_has_its_texture_and_is_not_all_metal():
    steel = Material(name="steel", density=7850.0, friction=0.4)
    can = asset_of(box(0.1, 0.1, 0.1), noun="can", material=steel)
    (mesh,) = loaded(glb(can)).geometry.values()
    assert np.allclose(mesh.extents, 0.1)
    assert mesh.visual.material.baseColorTexture is not None
    assert mesh.visual.material.metallicFactor <= METALLIC


@pytest.mark.parametrize("size", [0.05, 1.0, 12.0, 300.0])
def test_lines_go_around_the_objects_and_are_not_too_many(size):
    low, high = np.array([-0.3 * size, 0.1, 0.0]), np.array([0.7 * size, 0.1 + size, size])
    left, right, cell = extent(low, high)
    assert (np.array(left) < low[:2]).all()
    assert (np.array(right) > high[:2]).all()
    drawn = loaded(lines(left, right, cell))
    assert np.allclose(drawn.bounds, [[*left, 0.0], [*right, 0.0]], atol=1e-6 * size)
    ends = np.concatenate([one.vertices for one in drawn.geometry.values()])
    assert len(np.unique(ends[:, 0].round(6))) <= CELLS + 3
