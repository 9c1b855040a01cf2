"""Coarser levels of detail: closed, within the tolerance that is said, with the texture where it was."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from pat3d.assets.mesh.simplify import coarser, simplify, within_budget
from pat3d.errors import AssetError
from pat3d.scene.asset import VisualMesh
from tests.exporters.things import mixed_scene
from tests.scenes import placed, scene_of


def ball(*, closed: bool = True) -> VisualMesh:
    """A unit sphere; its halves are seen from above on two parts of a picture, with a seam at the equator."""
    made = trimesh.creation.icosphere(4)
    faces = made.faces if closed else made.faces[1:]
    upper = made.vertices[faces][:, :, 2].mean(axis=1) > 0.0
    uv = 0.25 + 0.24 * made.vertices[faces][:, :, :2]
    uv[upper] += 0.5
    texture = np.full((8, 8, 3), 128, dtype=np.uint8)
    return VisualMesh(vertices=made.vertices, faces=faces.astype(np.int32), uv=uv, texture=texture)


def test_a_coarser_ball_is_closed_and_as_near_as_it_says():
    full = ball()
    found = simplify(full, 800)
    mesh = trimesh.Trimesh(found.visual.vertices, found.visual.faces, process=False)
    assert 400 < len(mesh.faces) <= 800
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(4 / 3 * np.pi, rel=0.05)
    # By trimesh: of every corner of the full ball the nearest point of the coarser one.
    _, distance, _ = trimesh.proximity.closest_point(mesh, full.vertices)
    assert 0.1 * found.moved < distance.max() <= found.moved * (1 + 1e-9)
    known = {tuple(point) for point in full.vertices}
    assert all(tuple(point) in known for point in found.visual.vertices)


def test_texture_coordinates_stay_with_their_corners_on_both_sides_of_a_seam():
    found = simplify(ball(), 800).visual
    seen = found.vertices[found.faces][:, :, :2]
    lower = np.abs(found.uv - (0.25 + 0.24 * seen)).max(axis=(1, 2)) < 1e-12
    upper = np.abs(found.uv - (0.75 + 0.24 * seen)).max(axis=(1, 2)) < 1e-12
    assert (lower ^ upper).all()
    assert lower.any()
    assert upper.any()


def test_a_scene_keeps_what_it_is_within_a_budget():
    """Equal objects stay equal, masses and convex parts stay theirs, small meshes stay as they are."""
    scene = mixed_scene()
    coarse, notes = within_budget(scene, 100)
    for before, after in zip(scene.objects, coarse.objects, strict=True):
        assert after.asset.parts is before.asset.parts
        assert after.asset.mass_properties == before.asset.mass_properties
        assert len(after.asset.visual.faces) <= len(before.asset.visual.faces)
        assert (after.asset is before.asset) == (len(before.asset.visual.faces) <= 100)
    shared = {id(obj.asset) for obj in scene.objects}
    assert len({id(obj.asset) for obj in coarse.objects}) == len(shared)
    assert len(notes) == sum(
        len(one.visual.faces) > 100 for one in {id(o.asset): o.asset for o in scene.objects}.values()
    )


def test_what_cannot_be_made_coarser_is_told():
    asset = mixed_scene().objects[0].asset
    open_one = replace(asset, visual=ball(closed=False))
    same, note = coarser(open_one, 100, "ball")
    assert same is open_one
    assert '"ball" keeps its 5,119 triangles: its surface is not closed' in note
    least, note = coarser(replace(asset, visual=ball()), 12, "ball")
    assert len(least.visual.faces) > 12
    assert "fewer would be more than 2 % of its size off" in note
    with pytest.raises(AssetError, match="needs 12 triangles or more, not 3"):
        within_budget(scene_of(placed("ball", open_one, (0.0, 0.0, 1.0))), 3)
