"""A USD export beyond its bodies: a camera that sees the scene, faces that rounding flattens, what reading refuses."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

pytest.importorskip("pxr")
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade

from pat3d.assets.shapes import box
from pat3d.errors import ExportError
from pat3d.exporters.usd import stage as stage_module
from pat3d.exporters.usd.asset_layer import bind_physics, define_box, physics_material
from pat3d.exporters.usd.reader import read_usd
from pat3d.exporters.usd.stage import open_stage
from pat3d.exporters.usd.writer import write_usd, write_usd_asset
from pat3d.scene.asset import VisualMesh
from tests.scenes import GAP, asset_of, placed, scene_of


def _row(size):
    """Three boxes with sides of `size` [m], well apart and to one side of the origin."""
    one = asset_of(box(size, size, size))
    places = ((4, 1, 0), (6, 2, 0), (5, 1.5, 2))
    return scene_of(*(placed(f"b{k}", one, size * np.array(place) + (0, 0, GAP)) for k, place in enumerate(places)))


def _looks(scene, folder):
    """The frustum of the scene's camera, and the corners of every hull in the world [m]."""
    stage = Usd.Stage.Open(str(write_usd(scene, folder)))
    frustum = UsdGeom.Camera(stage.GetPrimAtPath("/World/Camera")).GetCamera(Usd.TimeCode.Default()).frustum
    corners = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.asset.parts])
    return frustum, corners


@pytest.mark.parametrize("size", [0.05, 0.5, 5.0])
def test_the_camera_looks_at_the_middle_of_the_scene_from_the_viewers_side_and_sees_all_of_it(size, tmp_path):
    frustum, corners = _looks(_row(size), tmp_path / "u")
    low, high = corners.min(axis=0), corners.max(axis=0)
    eye, ahead = np.array(frustum.GetPosition()), np.array(frustum.ComputeViewDirection())
    aside = np.cross((low + high) / 2 - eye, ahead)
    assert np.linalg.norm(aside) < 1e-6 * np.linalg.norm(high - low)
    assert ahead[0] == pytest.approx(0.0, abs=1e-9)
    assert ahead[1] > 0.5
    assert ahead[2] < 0.0
    assert np.array(frustum.ComputeUpVector())[2] > 0.0
    assert all(frustum.Intersects(Gf.Vec3d(*corner)) for corner in corners.tolist())
    # And it is not so far away that there is little to see.
    assert np.linalg.norm(high - low) > 0.4 * np.linalg.norm((low + high) / 2 - eye)


LINES = [
    ((2.0, 0.0, 0.0), 0.5),
    ((0.0, 0.0, 2.0), 0.25),
    ((2.0, 1.0, 0.5), 0.5),
    ((0.5, 2.0, 0.0), 0.75),
    ((1.0, 1.0, 1.0), 0.5),
]
"""Longest edges [m], and where along them the third corner lies, all exact in single precision."""


def test_faces_that_rounding_makes_a_line_become_triangles_about_a_rounding_error_high(tmp_path):
    """The corner between the other two is moved along the axis most across, so by sqrt(2/3) of a step at least."""
    whole = asset_of(box(0.5, 0.5, 0.5))
    flat = []
    for number, (edge, share) in enumerate(LINES):
        for turn, order in enumerate(permutations(range(3))):
            start = np.array([1.0 + 4 * number, 2.0 + 4 * turn, 3.0])
            corners = np.array([start, start + np.array(edge), start + share * np.array(edge)])
            flat.append(corners[list(order)])
    vertices = np.concatenate([whole.visual.vertices, *flat])
    count = len(whole.visual.vertices)
    faces = np.concatenate([whole.visual.faces, count + np.arange(3 * len(flat)).reshape(-1, 3)]).astype(np.int32)
    mesh = VisualMesh.from_face_colours(vertices, faces, np.zeros((len(faces), 3), np.uint8))
    stage = Usd.Stage.Open(str(write_usd_asset(replace(whole, visual=mesh), tmp_path / "u", "one")))
    points = np.array(UsdGeom.Mesh(stage.GetPrimAtPath("/one/visual")).GetPointsAttr().Get(), dtype=np.float64)
    step = float(np.spacing(np.float32(np.abs(vertices).max())))
    assert np.abs(points - vertices).max() <= 2.0 * step
    corners = points[faces[len(whole.visual.faces) :]]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert (doubled / edges.max(axis=1) > 0.99 * np.sqrt(2 / 3) * step).all()


@pytest.mark.parametrize(
    "axes", [(np.inf, 0, 0, 0), (1, 0, 0, np.inf), (np.nan, 0, 0, 0), (0, 0, 1, np.nan), (0, 0, 0, 0)]
)
def test_principal_axes_that_are_no_rotation_are_refused(axes, tmp_path):
    path = write_usd_asset(asset_of(box(0.1, 0.2, 0.3)), tmp_path / "u", "one")
    assert len(read_usd(path)) == 1
    layer = Sdf.Layer.FindOrOpen(str(path))
    attribute = layer.GetAttributeAtPath("/one.physics:principalAxes")
    assert attribute is not None
    attribute.default = Gf.Quatf(*axes)
    layer.Save()
    with pytest.raises(ExportError, match="no rotation"):
        read_usd(path)


def test_a_stage_of_as_many_prims_as_are_allowed_is_read_and_one_with_more_is_not(tmp_path, monkeypatch):
    path = write_usd(scene_of(placed("one", asset_of(box(0.1, 0.1, 0.1)), (0, 0, GAP))), tmp_path / "u")
    stage = Usd.Stage.Open(str(path))
    count = len(list(stage.TraverseAll()))
    monkeypatch.setattr(stage_module, "MAX_PRIMS", count)
    assert open_stage(path)
    monkeypatch.setattr(stage_module, "MAX_PRIMS", count - 1)
    with pytest.raises(ExportError, match=f"more than {count - 1} prims"):
        open_stage(path)


HALF, CENTRE, TURN = (0.1, 0.2, 0.3), (1.0, -2.0, 0.5), (0.5, 0.5, 0.5, 0.5)
"""A third of a turn about the diagonal takes x to y, y to z and z to x."""


def test_a_box_is_a_collider_with_the_corners_and_the_bound_that_its_half_sizes_say():
    stage = Usd.Stage.CreateInMemory()
    box_prim = define_box(stage, "/box", CENTRE, HALF, TURN)  # type: ignore[arg-type]
    boundable = UsdGeom.Boundable(box_prim)
    np.testing.assert_array_equal(
        boundable.GetExtentAttr().Get(), UsdGeom.Boundable.ComputeExtentFromPlugins(boundable, Usd.TimeCode.Default())
    )
    np.testing.assert_array_equal(boundable.GetExtentAttr().Get(), [(-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)])
    purposes = [UsdGeom.Tokens.default_, UsdGeom.Tokens.guide]
    around = UsdGeom.BBoxCache(Usd.TimeCode.Default(), purposes).ComputeWorldBound(box_prim).ComputeAlignedRange()
    turned = np.array([HALF[2], HALF[0], HALF[1]])
    np.testing.assert_allclose(around.GetMin(), CENTRE - turned, atol=1e-9)
    np.testing.assert_allclose(around.GetMax(), CENTRE + turned, atol=1e-9)
    assert box_prim.HasAPI(UsdPhysics.CollisionAPI)


@pytest.mark.parametrize("friction", [0.0, 0.35, 1.2])
def test_a_surface_rubs_as_much_at_rest_as_in_motion_and_does_not_bounce(friction):
    """And every reader finds it, whichever purpose it looks for."""
    stage = Usd.Stage.CreateInMemory()
    prim = define_box(stage, "/box", CENTRE, HALF)  # type: ignore[arg-type]
    bind_physics(prim, physics_material(stage, Sdf.Path("/rubber"), friction))
    for purpose in ("physics", UsdShade.Tokens.allPurpose):
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(purpose)
        physics = UsdPhysics.MaterialAPI(material.GetPrim())
        assert physics.GetPath() == Sdf.Path("/rubber")
        assert physics.GetStaticFrictionAttr().Get() == pytest.approx(friction)
        assert physics.GetDynamicFrictionAttr().Get() == pytest.approx(friction)
        assert physics.GetRestitutionAttr().Get() == 0.0
