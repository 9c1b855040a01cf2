"""What we write comes back the same: every format of a scene, read as somebody else's file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pat3d.errors import AssetError
from pat3d.exporters import export
from pat3d.importers.scene import Imported, import_scene
from pat3d.scene.model import Scene, SceneObject
from pat3d.scene.naming import slug
from tests.exporters.things import hung_bar, mixed_scene

LIMITS = {"mjcf": 2e-7, "urdf": 1e-12, "sdf": 1e-12, "usd": 2e-7}
"""Relative to the largest number of each: MuJoCo keeps points, and USD points and masses, in single precision."""


@pytest.fixture(scope="module")
def scene() -> Scene:
    return mixed_scene()


@pytest.fixture(scope="module")
def exports(scene, tmp_path_factory) -> dict[str, Path]:
    pytest.importorskip("pxr")
    return export(scene, tuple(LIMITS), tmp_path_factory.mktemp("exports"))


@pytest.fixture(scope="module")
def imports(exports) -> dict[str, Imported]:
    return {name: import_scene(path.parent) for name, path in exports.items()}


def in_the_world(obj: SceneObject) -> dict[str, np.ndarray]:
    """What an engine sees of an object, whatever its own frame is."""
    turn, properties = obj.pose.rotation, obj.asset.mass_properties
    corners = [obj.pose.apply(part.vertices) for part in obj.parts]
    boxes = np.array([[points.min(axis=0), points.max(axis=0)] for points in corners])
    return {
        "mass": np.array(properties.mass),
        "centre": obj.pose.apply(np.array([properties.centre_of_mass])),
        "inertia": turn @ np.array(properties.inertia) @ turn.T,
        "friction": np.array(obj.asset.material.friction),
        "hulls": boxes[np.lexsort(np.round(boxes.reshape(len(boxes), -1), 6).T)],
        "picture": np.sort(obj.pose.apply(obj.asset.visual.vertices[np.unique(obj.asset.visual.faces)]), axis=0),
    }


@pytest.mark.parametrize("name", LIMITS)
def test_an_export_comes_back_as_the_scene_that_it_was(scene, imports, name):
    read = imports[name]
    assert (read.format, read.cut, read.lifted) == (name, 0, 0.0)
    back = {slug(obj.name): obj for obj in read.scene.objects}
    assert set(back) == {slug(obj.name) for obj in scene.objects}
    for obj in scene.objects:
        other = back[slug(obj.name)]
        assert other.fixed == obj.fixed
        assert sum(part.box is not None for part in other.parts) >= (
            sum(part.box is not None for part in obj.parts) if name in ("mjcf", "urdf", "sdf") else 0
        )
        expected, found = in_the_world(obj), in_the_world(other)
        for key, value in expected.items():
            assert found[key].shape == value.shape, key
            limit = LIMITS[name] * max(1.0 if key in ("centre", "hulls", "picture") else 0.0, np.abs(value).max())
            assert np.abs(found[key] - value).max() <= limit, (obj.name, key)


@pytest.mark.parametrize("name", ["mjcf", "urdf", "usd"])
def test_names_as_people_write_them_come_back(scene, imports, name):
    assert [obj.name for obj in imports[name].scene.objects] == [obj.name for obj in scene.objects]


@pytest.mark.parametrize("name", LIMITS)
def test_equal_objects_share_one_asset(imports, name):
    mugs = [obj for obj in imports[name].scene.objects if "mug" in obj.name]
    assert len(mugs) == 2
    assert mugs[0].asset is mugs[1].asset


@pytest.mark.parametrize("name", ["mjcf", "urdf"])
def test_what_hangs_by_points_still_does(tmp_path, name):
    scene = hung_bar()
    (path,) = export(scene, (name,), tmp_path).values()
    read = import_scene(path.parent).scene
    assert {(one.child, one.parent) for one in read.attachments} == {
        (one.child, one.parent) for one in scene.attachments
    }
    for one, other in zip(scene.attachments, read.attachments, strict=True):
        expected = one.ends(scene[one.child].pose, scene[one.parent].pose)
        found = other.ends(read[one.child].pose, read[one.parent].pose)
        np.testing.assert_allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("loose", [False, True])
def test_what_hangs_in_an_sdf_world_is_refused_by_its_joint_and_may_stand_still(tmp_path, loose):
    scene = hung_bar()
    if loose:
        scene = replace(scene, objects=tuple(replace(obj, fixed=False) for obj in scene.objects))
    (path,) = export(scene, ("sdf",), tmp_path).values()
    with pytest.raises(AssetError, match=r'"a_bar" by .*a_bar_hangs'):
        import_scene(path)
    still = import_scene(path, joints="fix").scene
    assert still["a_bar"].fixed
    np.testing.assert_allclose(still["a_bar"].pose.position, scene["a bar"].pose.position, atol=1e-12)
