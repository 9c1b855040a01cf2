"""Normals of face corners against the definition, one corner at a time."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull

from pat3d.geometry.normals import CREASE_DEGREES, crease_normals


def hull(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A hull of random points, every second one near another: its edges fold much and little."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(20, 3))
    points = np.concatenate([points, points + 0.05 * rng.normal(size=points.shape)])
    found = ConvexHull(points)
    mesh = trimesh.Trimesh(points, found.simplices)
    trimesh.repair.fix_normals(mesh)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces, dtype=np.int32)


def expected(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The area-weighted mean over the faces at a corner's vertex that fold by less than the crease angle."""
    corners = vertices[faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = area / np.linalg.norm(area, axis=1, keepdims=True)
    normals = np.zeros((len(faces), 3, 3))
    for face in range(len(faces)):
        for corner in range(3):
            at_vertex = (faces == faces[face, corner]).any(axis=1)
            near = np.degrees(np.arccos(np.clip(unit @ unit[face], -1, 1))) < CREASE_DEGREES
            total = area[at_vertex & near].sum(axis=0)
            normals[face, corner] = total / np.linalg.norm(total)
    return normals


@pytest.mark.parametrize("seed", range(4))
def test_corners_take_the_mean_of_the_faces_within_the_crease_angle(seed: int):
    """Float32 rounds a unit vector by less than 1e-7."""
    vertices, faces = hull(seed)
    wanted = expected(vertices, faces)
    flat = np.cross(*np.moveaxis(np.diff(vertices[faces], axis=1), 1, 0))
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    assert 0.05 < np.mean(np.abs(wanted - flat[:, None]).max(axis=2) > 1e-6) < 0.95, "both smooth and sharp corners"
    np.testing.assert_allclose(crease_normals(vertices, faces), wanted, atol=2e-7)
