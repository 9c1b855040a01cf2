"""Engines behind scripts: the MuJoCo driver for real, and drivers that misbehave in every way a script can."""

import json
import math
import sys
import time
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.check.engines import environments, process
from pat3d.check.engines.check import check_engines, drifts, failures
from pat3d.check.engines.process import DRIVERS, ScriptEngine, read_run
from pat3d.check.engines.protocol import Absent, EngineRun, Failed
from pat3d.check.engines.registry import ENGINES, GROUPS, chosen
from pat3d.check.settle import SettleReport, settle_in_mujoco
from pat3d.cli.main import main
from pat3d.errors import CheckError, SpecError
from pat3d.exporters.mjcf.writer import FOR_MUJOCO_3_3, SCENE, write_mjcf
from pat3d.geometry.pose import Pose
from pat3d.scene.io import save_scene
from tests.scenes import GAP, asset_of, placed, scene_of, tower

MUJOCO = chosen(["mujoco"])[0]

GOOD = {
    "format": "pat3d-engine-run",
    "engine": "Stand-in",
    "version": "1",
    "settings": {"timestep": 0.002},
    "warnings": [],
    "wall_seconds": 0.1,
    "times": [0.0, 1.0],
    "names": ["box_1"],
    "poses": [[[0, 0, GAP, 1, 0, 0, 0]]] * 2,
}


def _run(**changes):
    document = {**GOOD, **changes}
    return EngineRun(
        engine="Stand-in",
        version="1",
        settings={},
        warnings=(),
        wall_seconds=0.1,
        times=np.array(document["times"], dtype=float),
        names=tuple(document["names"]),
        poses=np.array(document["poses"], dtype=float),
        leans=np.zeros(len(document["times"])),
    )


def _engine(tmp_path, body, name="stand-in"):
    """An engine whose driver has the arguments in `out` and `seconds` and does `body`."""
    lines = [
        "import json, os, sys, time, signal",
        "out = sys.argv[sys.argv.index('--out') + 1]",
        f"good = {GOOD!r}",
        *body.splitlines(),
    ]
    driver = tmp_path / "driver.py"
    driver.write_text("\n".join(lines) + "\n")
    return ScriptEngine(name=name, title="Stand-in", format="mjcf", driver=driver, environment=None)


def _failure(tmp_path, body, timeout=20.0):
    (verdict,) = check_engines(tower(1), [_engine(tmp_path, body)], seconds=1.0, timeout=timeout)
    assert isinstance(verdict, Failed)
    assert failures([verdict]) == (verdict.reason,)
    return verdict.reason


def test_the_mujoco_driver_finds_the_drift_that_mujoco_in_this_process_finds(tmp_path):
    scene = tower(3)
    (report,) = check_engines(scene, [MUJOCO], seconds=1.0)
    assert isinstance(report, SettleReport)
    assert report.passed
    here = settle_in_mujoco(write_mjcf(scene, tmp_path / "mjcf"), 1.0)
    for there, own in zip(report.objects, here.objects, strict=True):
        assert there.name == own.name
        assert there.centre_mm == pytest.approx(own.centre_mm, abs=1e-3)
    assert report.settings["timestep"] == 0.002
    assert report.version == here.version
    json.dumps(report.as_dict(), allow_nan=False)


def test_gravity_that_leans_upsets_a_box_at_its_tilt_and_ends_the_run(tmp_path):
    """A box twice as high as it is wide stands atan(1 / 2) on its outline, and no further."""
    scene = scene_of(placed("box", asset_of(box(0.05, 0.05, 0.1)), (0, 0, GAP)))
    write_mjcf(scene, tmp_path / "mjcf")
    stands = MUJOCO.run(tmp_path / "mjcf", 4.0, timeout=100.0, lean=20.0)
    assert stands.leans[-1] == pytest.approx(20.0)
    assert drifts(scene, stands, 4.0).objects[0].centre_mm < 5.0
    falls = MUJOCO.run(tmp_path / "mjcf", 8.0, timeout=100.0, lean=45.0)
    assert falls.times[-1] < 7.9
    assert math.degrees(math.atan(0.5)) < falls.leans[-1] < 36.0


def test_gravity_leans_to_the_end_and_goes_around_while_it_does(monkeypatch):
    monkeypatch.syspath_prepend(str(DRIVERS))
    recording = import_module("recording")
    lean = recording.Lean(10.0, 20.0)
    assert lean.tilt(0.0) == 0.0
    assert lean.tilt(2.0) == pytest.approx(5.0)
    assert lean.tilt(20.0) == pytest.approx(10.0)
    x, y, z = lean.down(20.0)
    assert math.degrees(math.acos(-z)) == pytest.approx(10.0)
    assert math.degrees(math.atan2(y, x)) == pytest.approx(0.0, abs=1e-6)
    assert math.degrees(math.atan2(*lean.down(19.5)[1::-1])) == pytest.approx(-90.0)


def test_the_mujoco_driver_takes_the_file_for_mujoco_3_3_there_and_the_scene_elsewhere():
    source = (DRIVERS / "drive_mujoco.py").read_text(encoding="utf-8")
    assert f'"{FOR_MUJOCO_3_3}" if version.startswith("3.3.") else "{SCENE}"' in source


def test_a_falling_object_is_convicted_with_its_fall_and_fixed_ones_are_not_asked_for():
    asset = asset_of(box(0.1, 0.1, 0.1))
    scene = scene_of(placed("shelf", asset, (1, 0, 2), fixed=True), placed("dropped one", asset, (0, 0, 5)))
    (report,) = check_engines(scene, [MUJOCO], seconds=0.5)
    assert [obj.name for obj in report.objects] == ["dropped one"]
    assert report.worst_mm == pytest.approx(1226, rel=0.01)
    assert "dropped one" in failures([report])[0]


def test_an_export_that_is_there_is_what_is_checked(tmp_path):
    """The file in the folder has the box half a metre up, whatever the scene says."""
    lifted = tower(1)
    lifted = replace(lifted, objects=(replace(lifted.objects[0], pose=Pose(position=(0, 0, 0.5))),))
    write_mjcf(lifted, tmp_path / "mjcf")
    (report,) = check_engines(tower(1), [MUJOCO], tmp_path, seconds=0.1)
    assert report.worst_mm > 400


def test_drift_is_measured_from_the_scene_and_not_from_where_the_engine_put_it():
    pose = [0.003, 0, GAP, *np.array([np.cos(0.01), 0, 0, np.sin(0.01)])]
    report = drifts(tower(1), _run(poses=[[pose]] * 2), 1.0)
    assert report.objects[0].origin_mm == pytest.approx(3.0)
    assert report.objects[0].degrees == pytest.approx(np.degrees(0.02))


def test_the_worst_moment_counts_and_the_sign_of_a_quaternion_does_not():
    poses = [[[0, 0, GAP, 1, 0, 0, 0]], [[0, 0.002, GAP, -1, 0, 0, 0]], [[0, 0, GAP, 1, 0, 0, 0]]]
    report = drifts(tower(1), _run(poses=poses, times=[0, 0.5, 1.0]), 1.0)
    assert report.worst_mm == pytest.approx(2.0)
    assert report.worst_degrees == pytest.approx(0.0, abs=1e-6)


def test_a_centre_of_mass_off_the_origin_moves_with_the_rotation():
    """A box of 6 cm on its base turned about its base's middle by 0.1 rad: the centre goes 2 * 30 mm * sin(0.05)."""
    pose = [0, 0, GAP, np.cos(0.05), np.sin(0.05), 0, 0]
    report = drifts(tower(1), _run(poses=[[pose]] * 2), 1.0)
    assert report.objects[0].origin_mm == pytest.approx(0.0, abs=1e-9)
    assert report.objects[0].centre_mm == pytest.approx(60.0 * np.sin(0.05), rel=1e-6)


def test_poses_that_are_not_numbers_are_drift_without_bound(tmp_path):
    body = "good['poses'] = [[[0, 0, float('nan'), 1, 0, 0, 0]]] * 2\njson.dump(good, open(out, 'w'))"
    (report,) = check_engines(tower(1), [_engine(tmp_path, body)], seconds=1.0)
    assert report.objects[0].centre_mm == np.inf
    assert not report.passed


def test_a_run_that_ends_early_is_a_failure():
    with pytest.raises(CheckError, match=r"ended after 1 s of 5 s"):
        drifts(tower(1), _run(), 5.0)


def test_an_object_that_the_engine_lost_is_a_failure():
    with pytest.raises(CheckError, match='"box 2" is not among the moving bodies: box_1'):
        drifts(tower(2), _run(), 1.0)


def test_names_that_usd_had_to_change_are_found():
    scene = scene_of(placed("2 cups", asset_of(box(0.1, 0.1, 0.1)), (0, 0, GAP)))
    assert drifts(scene, _run(names=["_2_cups"]), 1.0).passed


def test_a_crash_is_told_with_the_signal_and_the_last_line(tmp_path):
    assert "signal SIGABRT" in _failure(tmp_path, "os.abort()")
    assert "exit code 3: no such mesh" in _failure(tmp_path, "print('no such mesh', file=sys.stderr)\nsys.exit(3)")
    assert "RuntimeError: refused" in _failure(tmp_path, "raise RuntimeError('refused')")


def test_a_driver_that_hangs_is_ended_with_what_it_started(tmp_path):
    mark = tmp_path / "pid"
    body = (
        "import subprocess\n"
        "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(100_000)'])\n"
        f"open({str(mark)!r}, 'w').write(str(child.pid))\ntime.sleep(100_000)"
    )
    assert "within 5 s" in _failure(tmp_path, body, timeout=5.0)
    stat = Path(f"/proc/{int(mark.read_text())}/stat")
    while _lives(stat):
        time.sleep(0.02)


def _lives(stat):
    try:
        return stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("not json", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[]", "malformed"),
        ('{"format": "other"}', "malformed"),
        (json.dumps({**GOOD, "names": "box_1"}), "malformed"),
        (json.dumps({**GOOD, "names": ["box_1", "box_1"]}), "malformed"),
        (json.dumps({**GOOD, "poses": [[[0, 0, 0]]]}), "malformed"),
        (json.dumps({**GOOD, "poses": [["x" * 7]] * 2}), "malformed"),
        (json.dumps({**GOOD, "times": []}), "malformed"),
        (json.dumps({**GOOD, "times": None}), "malformed"),
        (json.dumps({**GOOD, "settings": []}), "malformed"),
        (json.dumps({**GOOD, "wall_seconds": "soon"}), "malformed"),
        (json.dumps({key: value for key, value in GOOD.items() if key != "times"}), "malformed"),
    ],
)
def test_results_that_are_not_results_are_refused(tmp_path, text, message):
    (tmp_path / "run.json").write_text(text)
    with pytest.raises(CheckError, match=message):
        read_run(tmp_path / "run.json", "Stand-in")


def test_a_driver_that_writes_nothing_or_too_much_is_a_failure(tmp_path, monkeypatch):
    assert "wrote no result" in _failure(tmp_path, "pass")
    monkeypatch.setattr(process, "MAX_BYTES", 1000)
    assert "at most" in _failure(tmp_path, "open(out, 'w').write(' ' * 2000)")


def test_a_driver_sees_no_secrets_of_ours(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_TEST_TOKEN", "secret")
    body = "good['engine'] = str('PAT3D_TEST_TOKEN' in os.environ)\njson.dump(good, open(out, 'w'))"
    (report,) = check_engines(tower(1), [_engine(tmp_path, body)], seconds=1.0)
    assert report.engine == "False"


def test_an_absent_engine_says_how_to_get_it_and_stops_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_ENGINES", str(tmp_path / "none"))
    absent, found = check_engines(tower(1), [*chosen(["drake"]), MUJOCO], seconds=0.1)
    assert isinstance(absent, Absent)
    assert "make engine-drake" in absent.reason
    assert isinstance(found, SettleReport)
    assert failures([absent, found]) == ()


def test_an_environment_of_other_pins_counts_as_absent(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_ENGINES", str(tmp_path))
    python = environments.interpreter("drake")
    python.parent.mkdir(parents=True)
    python.symlink_to(sys.executable)
    pins = environments.PINS / "drake.txt"
    (tmp_path / "drake" / "pins.txt").write_bytes(pins.read_bytes())
    assert environments.is_made("drake")
    (tmp_path / "drake" / "pins.txt").write_text("drake==0.1\n")
    assert "another version" in chosen(["drake"])[0].absence()


def test_every_engine_has_a_driver_and_every_environment_its_pins():
    for engine in ENGINES.values():
        assert engine.driver.is_file()
        assert engine.environment is None or engine.environment in environments.NAMES
    for name in environments.NAMES:
        lines = (environments.PINS / f"{name}.txt").read_text().split()
        assert lines
        assert all(line.count("==") == 1 for line in lines)


def test_groups_and_commas_name_engines_once_and_unknown_names_are_told():
    assert [engine.name for engine in chosen(["newton,mujoco", "newton-xpbd"])] == [*GROUPS["newton"], "mujoco"]
    assert len(chosen(["all"])) == len(ENGINES)
    with pytest.raises(SpecError, match=r'unknown engine "bullet". Valid: mujoco'):
        chosen(["bullet"])


def test_the_command_prints_the_table_and_fails_on_what_falls(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("PAT3D_ENGINES", str(tmp_path / "none"))
    save_scene(tower(2), tmp_path / "still")
    assert main(["check", str(tmp_path / "still"), "--engines", "mujoco", "--seconds", "0.2"]) == 0
    assert main(["check", str(tmp_path / "still"), "--engines", "mujoco,drake", "--seconds", "0.2"]) == 1
    shown = capsys.readouterr().out
    assert "box 1" in shown
    assert "pass" in shown
    # Long paths wrap the line.
    assert "make engine-drake" in " ".join(shown.split())
    assert main(["check", str(tmp_path / "still"), "--engines", "drake"]) == 1
    assert "nothing was measured" in capsys.readouterr().err
    assert main(["check", str(tmp_path / "still"), "--engines", "unreal"]) == 2
    assert main(["check", str(tmp_path / "still"), "--engines", "mujoco", "--seconds", "nan"]) == 2
    save_scene(scene_of(placed("cup", asset_of(box(0.1, 0.1, 0.1)), (0, 0, 1))), tmp_path / "falls")
    assert main(["check", str(tmp_path / "falls"), "--engines", "mujoco", "--seconds", "0.2"]) == 1
    assert '"cup" drifts' in capsys.readouterr().err
