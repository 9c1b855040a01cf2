import json

import numpy as np
import pytest

from pat3d.assets.shapes import box, cylinder, soft_box, vessel
from pat3d.check.metrics.drift import mean_drift, share_still
from pat3d.check.settle import settle_in_mujoco
from pat3d.errors import CheckError
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.geometry.pose import Pose
from tests.scenes import GAP, asset_of, placed, scene_of, tower


def _settle(scene, folder, seconds=2.0):
    return settle_in_mujoco(write_mjcf(scene, folder / "mjcf"), seconds)


def test_a_tower_of_five_boxes_drifts_under_a_tenth_of_a_millimetre(tmp_path):
    report = _settle(tower(5), tmp_path, 5.0)
    assert report.worst_mm < 0.1
    assert report.worst_degrees < 0.1
    assert report.passed
    assert report.warnings == ()


def test_a_shifted_and_turned_tower_of_boxes_drifts_under_50_micrometres(tmp_path):
    rng = np.random.default_rng(0)
    asset = asset_of(box(0.06, 0.06, 0.06))
    scene = scene_of(
        *(
            placed(
                f"box {k}",
                asset,
                pose=Pose.from_yaw(rng.uniform(-0.1, 0.1), (*rng.uniform(-0.003, 0.003, 2), GAP + k * (0.06 + GAP))),
            )
            for k in range(8)
        )
    )
    assert _settle(scene, tmp_path).worst_mm < 0.05


def test_hulls_on_a_table_stay_put(tmp_path):
    """A many-part mug and a cylinder, none of them a primitive, on a table on the ground."""
    mug = asset_of(vessel([(0.03, 0), (0.04, 0.09)], [(0.026, 0.006), (0.036, 0.09)]))
    can = asset_of(cylinder(0.03, 0.08))
    scene = scene_of(
        placed("table", asset_of(box(0.4, 0.3, 0.02)), (0, 0, GAP)),
        placed("mug", mug, (0.05, 0.02, 0.02 + 2 * GAP)),
        placed("can", can, (-0.1, 0.02, 0.02 + 2 * GAP)),
        placed("can 2", can, (0.5, 0.0, GAP)),
    )
    report = _settle(scene, tmp_path)
    assert report.worst_mm < 0.02
    assert [drift.name for drift in report.objects] == ["table", "mug", "can", "can 2"]


def test_a_falling_object_is_reported_with_its_fall(tmp_path):
    """Half a second of free fall from far up is 1.226 m, and only that object moves."""
    asset = asset_of(box(0.1, 0.1, 0.1))
    report = _settle(scene_of(placed("still", asset, (0, 0, GAP)), placed("dropped", asset, (1, 0, 5))), tmp_path, 0.5)
    assert [drift.name for drift in report.moved()] == ["dropped"]
    assert report.worst_mm == pytest.approx(1226, rel=0.01)
    assert not report.passed
    assert share_still(report) == 0.5
    assert mean_drift(report) == pytest.approx(report.worst_mm / 2e3, rel=1e-3)


def test_a_tipping_object_is_reported_in_degrees(tmp_path):
    plank = asset_of(box(0.02, 0.1, 0.3))
    lean = Pose(position=(0, 0, 0.005), quat_wxyz=(np.cos(0.1), 0, np.sin(0.1), 0))
    assert _settle(scene_of(placed("plank", plank, pose=lean)), tmp_path).worst_degrees > 60


def test_fixed_objects_are_not_counted_and_settings_are_stated(tmp_path):
    asset = asset_of(box(0.1, 0.1, 0.1))
    scene = scene_of(placed("shelf", asset, (0, 0, 1), fixed=True), placed("cup", asset, (0, 0, 1.1 + GAP)))
    report = _settle(scene, tmp_path, 0.5)
    assert [drift.name for drift in report.objects] == ["cup"]
    assert report.settings["cone"] == "elliptic"
    assert report.settings["multiccd"] is True
    assert (report.settings["impratio"], report.settings["timestep"]) == (10, 0.002)
    assert report.version.count(".") == 2
    json.dumps(report.as_dict(), allow_nan=False)


def test_a_warning_of_the_engine_is_in_the_report_and_leaves_no_log_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "unstable.xml"
    spring = '<joint type="slide" stiffness="-1e9" springref="1"/>'
    path.write_text(f'<mujoco><worldbody><body>{spring}<geom size="0.01" pos="1 0 0"/></body></worldbody></mujoco>')
    report = settle_in_mujoco(path, 1.0)
    assert report.warnings
    assert not report.passed
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()


def test_a_file_that_mujoco_refuses_is_an_error(tmp_path):
    (tmp_path / "scene.xml").write_text("<mujoco><worldbody><nonsense/></worldbody></mujoco>")
    with pytest.raises(CheckError, match="nonsense"):
        settle_in_mujoco(tmp_path / "scene.xml")


def test_half_a_minute_tells_creep_and_a_box_has_none(tmp_path):
    report = _settle(tower(1), tmp_path, 30.0)
    assert report.worst_creep_mm is not None
    assert report.worst_creep_degrees is not None
    assert report.worst_creep_mm < 1e-3
    assert report.worst_creep_degrees < 1e-3
    assert report.creeping() == ()
    assert report.as_dict()["worst_creep_mm_per_minute"] == report.worst_creep_mm


def test_what_still_moves_late_in_the_run_is_named(tmp_path):
    """A box far up falls for longer than the run, from its third quarter to its last at 3/4 g T on average."""
    cube = asset_of(box(0.1, 0.1, 0.1))
    report = _settle(scene_of(placed("low", cube, (0, 0, GAP)), placed("high", cube, (1, 0, 1e4))), tmp_path, 30.0)
    assert [obj.name for obj in report.creeping()] == ["high"]
    speed = 9.81 * 0.75 * 30.0
    assert report.worst_creep_mm == pytest.approx(60e3 * speed, rel=1e-3)


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_a_flush_tower_of_hulls_that_are_no_boxes_stands(tmp_path):
    """Each face meets another of eight corners; colliders of meshes find many contacts there, and stop at none."""
    block = asset_of(soft_box(0.1, 0.1, 0.05, 0.004))
    assert block.parts[0].box is None
    tower = [placed(f"block {k}", block, (0, 0, GAP + k * (0.05 + GAP))) for k in range(8)]
    report = _settle(scene_of(*tower), tmp_path, 1.0)
    assert report.passed
    assert report.warnings == ()


def test_an_engine_that_stops_is_a_scene_that_moves_and_no_crash(tmp_path, monkeypatch):
    """MuJoCo raises where a collider finds more contacts than there is room for."""
    import mujoco

    def stop(*arguments, **keywords):
        raise mujoco.FatalError("9 contacts, at most 8")

    path = write_mjcf(tower(2), tmp_path / "mjcf")
    monkeypatch.setattr(mujoco, "mj_step", stop)
    report = settle_in_mujoco(path, 0.1)
    assert not report.passed
    assert report.warnings == ("stopped: 9 contacts, at most 8",)
    assert len(report.moved()) == 2
