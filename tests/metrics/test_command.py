"""`pat3d metrics` as it is typed."""

import json

from pat3d.assets.shapes import box
from pat3d.cli.main import main
from pat3d.scene.io import save_scene
from tests.scenes import asset_of, placed, scene_of

CUBE = asset_of(box(0.1, 0.1, 0.1))


def test_metrics_tells_both_measures_and_writes_a_report(tmp_path, capsys):
    save_scene(scene_of(placed("low", CUBE, (0, 0, 1e-5)), placed("sunk", CUBE, (0.03, 0.02, 0.09))), tmp_path / "bad")
    save_scene(scene_of(placed("low", CUBE, (0, 0, 1e-6))), tmp_path / "good")
    report = tmp_path / "found.json"
    assert main(["metrics", str(tmp_path / "bad"), str(tmp_path / "good"), "--report", str(report)]) == 0
    written = json.loads(report.read_text())
    assert (written["format"], written["version"]) == ("pat3d-metrics", 1)
    bad, good = written["scenes"]
    assert bad["name"] == "bad"
    assert bad["displacement"]["engine"] == "MuJoCo"
    assert bad["delivered"]["pairs"] > 0
    assert good["displacement"]["engine"] == "PAT3D"
    assert good["delivered"]["value"] == 0
    said = capsys.readouterr().out
    assert "MuJoCo simulated it" in said
    assert '"low" and "sunk"' in said or '"sunk" and "low"' in said


def test_metrics_refuses_what_is_no_scene(tmp_path, capsys):
    assert main(["metrics", str(tmp_path)]) == 2
    assert "holds no meshes" in capsys.readouterr().err
