import json
import sys

import numpy as np
import pytest
import trimesh
from PIL import Image

from pat3d.assets.catalogue import make
from pat3d.check.drop import ground_drop
from pat3d.cli.main import main
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.scene.io import load_scene, save_scene
from tests.exporters.things import mixed_scene
from tests.scenes import placed, scene_of


@pytest.fixture(autouse=True)
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))


@pytest.fixture
def folder(tmp_path):
    save_scene(mixed_scene(), tmp_path / "scene")
    return tmp_path / "scene"


def test_a_scene_is_written_in_every_format_and_read_back(folder, tmp_path, capfd):
    out = tmp_path / "exports" / "desk"
    assert main(["export", str(folder), "--formats", "mjcf,urdf", "sdf", "--out", str(out)]) == 0
    assert sorted(path.name for path in out.iterdir()) == ["checksums.json", "mjcf", "sdf", "urdf"]
    assert main(["check", str(out)]) == 0
    said = capfd.readouterr().out
    assert "MuJoCo" in said
    assert said.count("same") >= 4
    assert "FAIL" not in said
    assert str(out / "urdf" / "manifest.json") in said.replace("\n", "")


def test_formats_may_be_written_into_the_scene_s_own_folder(folder):
    assert main(["export", str(folder), "--formats", "urdf", "--out", str(folder)]) == 0
    load_scene(folder)
    assert (folder / "urdf" / "scene.dmd.yaml").is_file()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--formats", "mjcf,fbx"], 'unknown format "fbx". Valid: mjcf, usd, urdf, sdf, html, glb, simready.'),
        (["--formats", ","], "Valid: mjcf"),
        (["--formats", "mjcf", "--mass", "2"], "--mass is for meshes"),
    ],
)
def test_wrong_arguments_are_refused_before_anything_is_written(folder, tmp_path, capfd, arguments, words):
    assert main(["export", str(folder), *arguments, "--out", str(tmp_path / "out")]) == 2
    assert words in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_usd_without_its_package_names_the_extra(folder, tmp_path, capfd, monkeypatch):
    monkeypatch.setattr("pat3d.exporters.formats.find_spec", lambda name: None)
    assert main(["export", str(folder), "--formats", "usd", "--out", str(tmp_path / "out")]) == 2
    assert "pip install 'pat3d[usd]'" in capfd.readouterr().err


def test_a_foreign_file_or_folder_in_the_way_is_kept(folder, tmp_path, capfd):
    (tmp_path / "out" / "urdf").mkdir(parents=True)
    (tmp_path / "out" / "urdf" / "mine.urdf").write_text("mine")
    assert main(["export", str(folder), "--formats", "urdf", "--out", str(tmp_path / "out")]) == 2
    assert (tmp_path / "out" / "urdf" / "mine.urdf").read_text() == "mine"
    assert "not empty" in capfd.readouterr().err


def _glb(path, sizes=(0.2, 0.1, 0.05)):
    """A box of `sizes` along x, height and depth of glTF."""
    trimesh.creation.box(sizes).export(path)


def test_one_mesh_becomes_an_asset_folder_with_a_summary_and_a_picture(tmp_path, capfd):
    """A box of 0.3 kg, 20 x 5 x 10 cm once glTF's y is up: closed forms for inertia, volume, and fall."""
    _glb(tmp_path / "any.glb")
    assert (
        main(
            [
                "export",
                str(tmp_path / "any.glb"),
                "--mass",
                "0.3",
                "--formats",
                "mjcf",
                "urdf",
                "--out",
                str(tmp_path / "asset"),
            ]
        )
        == 0
    )
    found = json.loads((tmp_path / "asset" / "summary.json").read_text())
    assert found["mass_kg"] == pytest.approx(0.3, rel=1e-12)
    np.testing.assert_allclose(found["size_m"], [0.2, 0.05, 0.1], atol=1e-7)
    np.testing.assert_allclose(found["centre_of_mass_m"], [0, 0, 0.05], atol=1e-7)
    moments = 0.3 / 12 * np.array([0.05**2 + 0.1**2, 0.2**2 + 0.1**2, 0.2**2 + 0.05**2])
    np.testing.assert_allclose(np.diag(found["inertia_kg_m2"]), moments, rtol=1e-6)
    assert found["drop"]["height"] == pytest.approx(0.8, rel=1e-5)
    assert found["passed"]
    assert set(found["parity"]) == {"mjcf", "urdf"}
    assert Image.open(tmp_path / "asset" / "preview.png").size[0] > 1000
    assert load_scene(tmp_path / "asset").objects[0].name == "any"
    assert "0.3" in capfd.readouterr().out


@pytest.mark.slow
def test_a_folder_of_meshes_goes_on_after_one_that_cannot_be_used(tmp_path, capfd):
    (tmp_path / "meshes").mkdir()
    _glb(tmp_path / "meshes" / "one.glb")
    _glb(tmp_path / "meshes" / "two.glb", (0.1, 0.1, 0.1))
    (tmp_path / "meshes" / "torn.stl").write_text("solid nothing\nendsolid\n")
    assert main(["export", str(tmp_path / "meshes"), "--formats", "mjcf", "--out", str(tmp_path / "out")]) == 2
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["one", "two"]
    said = capfd.readouterr()
    assert "torn.stl" in said.err
    assert "two" in said.out


def test_nothing_to_export_is_an_error_that_lists_the_mesh_formats(tmp_path, capfd):
    assert main(["export", str(tmp_path), "--formats", "mjcf", "--out", str(tmp_path / "out")]) == 2
    assert "glb" in capfd.readouterr().err


def test_help_shows_examples(capsys):
    with pytest.raises(SystemExit):
        main(["export", "--help"])
    assert "pat3d export mug.glb --mass 0.3" in capsys.readouterr().out


def test_importing_the_exporters_imports_nothing_heavy():
    import subprocess

    code = "import sys, pat3d.exporters as e; print(sorted({'numpy', 'mujoco', 'pxr', 'scipy'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


@pytest.mark.parametrize("noun", ["mug", "pencil", "book"])
def test_things_that_stand_come_to_rest_after_the_ground_drop(tmp_path, noun):
    report = ground_drop(write_mjcf(scene_of(placed(noun, make(noun), (0, 0, 1e-5))), tmp_path / "mjcf"))
    assert report.passed, report.failures
    assert report.height == pytest.approx(8 * report.size)
    assert report.sunk < 1e-4


def test_a_thing_without_colliders_falls_through_and_fails_the_drop(tmp_path):
    path = write_mjcf(scene_of(placed("book", make("book"), (0, 0, 1e-5))), tmp_path / "mjcf")
    text = path.read_text()
    path.write_text(text.replace('class="collision" name="ground"', 'class="visual" name="ground"'))
    report = ground_drop(path)
    assert not report.passed
    assert any("through the floor" in line for line in report.failures)
