import json
import math
import shutil
from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.catalogue import make
from pat3d.assets.shapes import ellipsoid
from pat3d.errors import ExportError, SpecError
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Region
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Attachment, Relation, SceneObject
from pat3d.scene.naming import slug, unique_slugs
from pat3d.scene.physics import LEAST_TILT
from tests.scenes import asset_of, placed, scene_of, tower


@pytest.fixture
def scene():
    rng = np.random.default_rng(3)
    quat = rng.normal(size=4)
    block = make("block", seed=5)
    return scene_of(
        SceneObject(
            name="red mug 1",
            phrase='a "red" mug, tasse à café',
            asset=block,
            pose=Pose(position=(0.1, 1 / 3, 0.7), quat_wxyz=tuple(quat / np.linalg.norm(quat))),
            initial_pose=Pose.from_yaw(0.3, (0.1, 0.2, 1e-17)),
        ),
        placed("red-mug/1", asset_of(ellipsoid(0.03)), (1, 2, 3), fixed=True),
        placed("second", block, (5, 0, 0)),
        relations=(Relation(child="second", kind="on", parent="red mug 1"),),
        prompt="two mugs",
        seed=7,
        settling_friction=0.15,
        provenance={"versions": {"pat3d": "0.1.0"}, "numbers": [1, 0.1]},
    )


def _edit(folder, change):
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    change(document)
    path.write_text(json.dumps(document))


def test_everything_reads_back_bit_for_bit(scene, tmp_path):
    save_scene(scene, tmp_path / "s")
    read = load_scene(tmp_path / "s")
    assert (read.prompt, read.seed, read.settling_friction) == (scene.prompt, scene.seed, scene.settling_friction)
    assert read.relations == scene.relations
    assert read.provenance == scene.provenance
    for new, old in zip(read.objects, scene.objects, strict=True):
        assert (new.name, new.phrase, new.pose, new.initial_pose, new.fixed) == (
            old.name,
            old.phrase,
            old.pose,
            old.initial_pose,
            old.fixed,
        )
        a, b = new.asset, old.asset
        assert (a.noun, a.mass_properties, a.material, a.regions) == (b.noun, b.mass_properties, b.material, b.regions)
        for name in ("vertices", "faces", "uv", "texture"):
            np.testing.assert_array_equal(getattr(a.visual, name), getattr(b.visual, name))
            assert getattr(a.visual, name).dtype == getattr(b.visual, name).dtype
        assert len(a.parts) == len(b.parts)
        for p, q in zip(a.parts, b.parts, strict=True):
            np.testing.assert_array_equal(p.vertices, q.vertices)
            np.testing.assert_array_equal(p.faces, q.faces)
            assert p.box == q.box


def test_an_infinite_region_height_survives_as_valid_json(scene, tmp_path):
    assert any(math.isinf(region.height) for region in scene.objects[0].asset.regions)
    save_scene(scene, tmp_path / "s")
    assert "Infinity" not in (tmp_path / "s" / "scene.json").read_text()
    assert any(math.isinf(region.height) for region in load_scene(tmp_path / "s").objects[0].asset.regions)
    assert all(isinstance(region, Region) for region in load_scene(tmp_path / "s").objects[0].asset.regions)


def test_a_shared_asset_is_stored_once_and_loaded_once(scene, tmp_path):
    save_scene(scene, tmp_path / "s")
    assert sorted(path.name for path in (tmp_path / "s" / "assets").iterdir()) == ["red_mug_1", "red_mug_1_2"]
    read = load_scene(tmp_path / "s")
    assert read["second"].asset is read["red mug 1"].asset


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("red mug 1", "red_mug_1"),
        ("../../etc/passwd", "etc_passwd"),
        ("Tasse à café", "tasse_a_cafe"),
        ("杯", "object"),
    ],
)
def test_slugs_are_safe_file_names(name, expected):
    assert slug(name) == expected


def test_clashing_slugs_are_numbered():
    assert unique_slugs(["a b", "a-b", "A B"]) == {"a b": "a_b", "a-b": "a_b_2", "A B": "a_b_3"}


def test_saving_again_replaces_the_scene_and_leaves_other_files(scene, tmp_path):
    folder = tmp_path / "s"
    save_scene(scene, folder)
    (folder / "report.json").write_text("{}")
    save_scene(scene_of(placed("lone", asset_of(ellipsoid(0.02)))), folder)
    assert [obj.name for obj in load_scene(folder).objects] == ["lone"]
    assert sorted(path.name for path in folder.iterdir()) == ["assets", "report.json", "scene.json"]
    assert [path.name for path in (folder / "assets").iterdir()] == ["lone"]
    assert [path.name for path in tmp_path.iterdir()] == ["s"]


def test_a_failed_save_leaves_every_file_as_it_was(scene, tmp_path, monkeypatch):
    folder = tmp_path / "s"
    save_scene(scene, folder)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    from pathlib import Path

    rename = Path.rename

    def failing(self, target):
        if self.name == "scene.json" and self.parent.name == "new":
            raise OSError(28, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", failing)
    with pytest.raises(ExportError, match="No space left"):
        save_scene(scene_of(placed("lone", asset_of(ellipsoid(0.02)))), folder)
    monkeypatch.undo()
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
    with pytest.raises(SpecError, match="provenance"):
        save_scene(scene_of(placed("a", scene.objects[0].asset), provenance={"x": math.nan}), folder)
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
    assert [path.name for path in tmp_path.iterdir()] == ["s"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.update(version=3), "Upgrade pat3d"),
        (lambda d: d.update(format="other"), "not a PAT3D scene"),
        (lambda d: d["objects"][1].pop("pose"), r"objects\[1\]: 'pose' is a required property"),
        (lambda d: d["objects"][1]["pose"].update(position=[0, 0]), r"objects\[1\]\.pose\.position"),
        (lambda d: d["objects"][1]["pose"].update(position=[0, 0, math.nan]), "NaN"),
        (lambda d: d["objects"][1]["pose"].update(quat_wxyz=[1, 1, 0, 0]), "norm"),
        (lambda d: d["objects"][2].update(asset="nothing"), r'objects\[2\]\.asset: no asset "nothing"'),
        (lambda d: d["assets"]["red_mug_1"].update(visual="../../secret.obj"), r"red_mug_1\.visual.*leaves"),
        (lambda d: d["assets"]["red_mug_1"]["parts"][0].update(mesh="/etc/passwd"), r"parts\[0\]\.mesh.*leaves"),
        (lambda d: d["assets"]["red_mug_1"].update(visual="assets/none.obj"), "cannot be read"),
        (lambda d: d["assets"]["red_mug_1"]["mass_properties"].update(mass=-1), r"mass_properties\.mass"),
        (
            lambda d: d["assets"]["red_mug_1"]["mass_properties"].update(inertia=[[1, 0, 0], [0, 1, 0], [0, 0, 3]]),
            "sum",
        ),
        (lambda d: d["relations"][0].update(parent="moon"), "moon"),
        (lambda d: d.update(extra=1), "extra"),
        (lambda d: d.update(attachments=[{"child": "second", "parent": "red mug 1", "anchors": []}]), "anchors"),
        (
            lambda d: d.update(
                attachments=[{"child": "second", "parent": "moon", "anchors": [[[0, 0, 0], [0, 0, 1]]]}]
            ),
            "moon",
        ),
        (lambda d: d["assets"]["red_mug_1"].update(anchors=[[0, 0]]), r"red_mug_1\.anchors"),
    ],
)
def test_a_broken_scene_is_refused_with_the_place(scene, tmp_path, change, message):
    save_scene(scene, tmp_path / "s")
    _edit(tmp_path / "s", change)
    with pytest.raises(SpecError, match=message) as caught:
        load_scene(tmp_path / "s")
    assert "scene.json" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_number_too_large_for_a_float_is_refused(scene, tmp_path):
    save_scene(scene, tmp_path / "s")
    path = tmp_path / "s" / "scene.json"
    path.write_text(path.read_text().replace('"settling_friction": 0.15', '"settling_friction": 1e999'))
    with pytest.raises(SpecError, match=r"settling_friction.*not finite"):
        load_scene(tmp_path / "s")


def test_a_link_out_of_the_folder_is_refused(scene, tmp_path):
    save_scene(scene, tmp_path / "s")
    visual = tmp_path / "s" / "assets" / "red_mug_1" / "visual.obj"
    shutil.move(visual, tmp_path / "outside.obj")
    visual.symlink_to(tmp_path / "outside.obj")
    with pytest.raises(SpecError, match="leads out"):
        load_scene(tmp_path / "s")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("v 0 0 nan\nf 1 1 1\n", "finite"),
        ("v 0 0 0\nf 1 2 3\n", "names vertex 3 of 1"),
        ("v 0 0\nf 1 1 1\n", "line"),
        ("", "needs both"),
        ("v 0 0 0\nf 0 1 1\n", "indices start at 1"),
    ],
)
def test_a_broken_mesh_file_is_refused(scene, tmp_path, text, message):
    save_scene(scene, tmp_path / "s")
    (tmp_path / "s" / "assets" / "red_mug_1" / "parts" / "part_000.obj").write_text(text)
    with pytest.raises(SpecError, match=message):
        load_scene(tmp_path / "s")


def test_a_folder_without_a_scene_is_refused(tmp_path):
    with pytest.raises(SpecError, match="no scene can be read"):
        load_scene(tmp_path)


def test_attachments_and_anchors_read_back_and_are_written_only_where_there_are_any(scene, tmp_path):
    save_scene(scene, tmp_path / "plain")
    assert '"attachments"' not in (tmp_path / "plain" / "scene.json").read_text()
    assert '"anchors"' not in (tmp_path / "plain" / "scene.json").read_text()
    assert load_scene(tmp_path / "plain").attachments == ()
    swing = make("swing")
    attachment = Attachment(
        child="swing", parent="second", anchors=tuple((point, (1 / 3, 0.1, 1e-17)) for point in swing.anchors)
    )
    hung = scene_of(*scene.objects, placed("swing", swing), attachments=(attachment,))
    save_scene(hung, tmp_path / "hung")
    read = load_scene(tmp_path / "hung")
    assert read.attachments == (attachment,)
    assert read["swing"].asset.anchors == swing.anchors


def test_a_task_reads_back_and_is_written_only_where_there_is_one(scene, tmp_path):
    save_scene(scene, tmp_path / "plain")
    assert '"task"' not in (tmp_path / "plain" / "scene.json").read_text()
    assert load_scene(tmp_path / "plain").task is None
    told = replace(scene, task="pick:second")
    save_scene(told, tmp_path / "told")
    assert load_scene(tmp_path / "told").task == "pick:second"


def test_a_task_for_what_is_not_there_is_refused(scene):
    with pytest.raises(SpecError, match='the task "pick:spoon" names "spoon"'):
        replace(scene, task="pick:spoon")


@pytest.mark.parametrize(
    "task", ["chain:place:red mug 1:second:then:pick:red-mug/1", "beside:red mug 1:behind:second", "sort"]
)
def test_a_task_of_several_steps_or_of_a_place_reads_back(scene, tmp_path, task):
    save_scene(replace(scene, task=task), tmp_path / "told")
    assert load_scene(tmp_path / "told").task == task


@pytest.mark.parametrize(
    "task",
    ["chain:place:second:spoon:then:pick:red mug 1", "beside:second:behind:spoon", "beside:second:spoon:red mug 1"],
)
def test_every_step_of_a_task_is_about_what_is_there(scene, task):
    with pytest.raises(SpecError, match='names "'):
        replace(scene, task=task)


def test_a_file_that_is_no_json_or_too_large_is_refused(scene, tmp_path, monkeypatch):
    path = save_scene(scene, tmp_path / "s")
    monkeypatch.setattr("pat3d.scene.io.MAX_JSON_BYTES", path.stat().st_size - 1)
    with pytest.raises(SpecError, match="larger than"):
        load_scene(tmp_path / "s")
    monkeypatch.undo()
    path.write_text(path.read_text()[:-3])
    with pytest.raises(SpecError, match="not valid JSON"):
        load_scene(tmp_path / "s")


def test_the_least_tilt_is_kept_and_said_only_where_it_is_not_the_usual_one(tmp_path):
    usual = tower(1)
    save_scene(usual, tmp_path / "usual")
    assert "least_tilt" not in json.loads((tmp_path / "usual" / "scene.json").read_text())
    assert load_scene(tmp_path / "usual").least_tilt == LEAST_TILT
    save_scene(replace(usual, least_tilt=2.0), tmp_path / "asked")
    assert load_scene(tmp_path / "asked").least_tilt == 2.0
