import numpy as np
import trimesh

from pat3d.assets.shapes import box, cylinder
from pat3d.geometry.normals import corner_normals
from pat3d.scene.obj_files import write_visual
from tests.scenes import asset_of


def test_a_box_keeps_its_edges_sharp():
    mesh = asset_of(box(1, 2, 3)).visual
    corners = mesh.vertices[mesh.faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    np.testing.assert_allclose(
        corner_normals(mesh.vertices, mesh.faces), np.repeat(flat[:, None], 3, axis=1), atol=1e-12
    )


def test_a_cylinder_is_round_at_the_side_and_flat_at_the_ends():
    mesh = asset_of(cylinder(1.0, 2.0)).visual
    normals = corner_normals(mesh.vertices, mesh.faces)
    side = np.abs(normals[..., 2]) < 0.5
    radial = mesh.vertices[mesh.faces][side][:, :2]
    np.testing.assert_allclose(normals[side][:, 2], 0.0, atol=1e-9)
    np.testing.assert_allclose(normals[side][:, :2], radial / np.linalg.norm(radial, axis=1, keepdims=True), atol=1e-6)
    np.testing.assert_allclose(np.abs(normals[~side][:, 2]), 1.0, atol=1e-12)


def test_trimesh_reads_the_written_mesh_with_its_texture(tmp_path):
    asset = asset_of(cylinder(0.03, 0.08))
    loaded = trimesh.load(write_visual(asset.visual, tmp_path), process=False, force="mesh")
    assert np.isclose(loaded.volume, asset.mass_properties.volume, rtol=1e-9)
    image = np.asarray(loaded.visual.material.image.convert("RGB"))
    np.testing.assert_array_equal(image, asset.visual.texture)
    # Two colours alternate over the faces; look them up through the texture coordinates of the file.
    uv = np.asarray(loaded.visual.uv)[loaded.faces].mean(axis=1)
    height, width = image.shape[:2]
    seen = [tuple(image[int((1 - v) * height), int(u * width)].tolist()) for u, v in uv]
    assert sorted(map(seen.count, set(seen))) == [len(seen) // 2, len(seen) - len(seen) // 2]
    assert set(seen) == {(60, 120, 200), (200, 120, 60)}
