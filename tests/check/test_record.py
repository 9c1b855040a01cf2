"""What other engines did, as report.json keeps it."""

import json

import numpy as np
import pytest
from rich.console import Console

from pat3d.assets.shapes import box
from pat3d.check.engines.check import drifts
from pat3d.check.engines.protocol import Absent, EngineRun, Failed
from pat3d.check.engines.record import KEY, record
from pat3d.check.engines.registry import chosen
from pat3d.cli.console import show_engines
from tests.scenes import GAP, asset_of, placed, scene_of

SECONDS, SPEED, TURN = 60.0, 2e-6, 1e-5
"""Of a run [s], of the box in it [m/s] and [rad/s]."""


def _creeping():
    """A scene of one box, and what an engine says of it that lets it creep and turn about its centre."""
    scene = scene_of(placed("box", asset_of(box(0.1, 0.1, 0.1)), (0, 0, GAP)))
    times = np.linspace(0.0, SECONDS, 601)
    poses = np.zeros((601, 1, 7))
    poses[:, 0, 0] = SPEED * times
    poses[:, 0, 2] = GAP
    poses[:, 0, 3], poses[:, 0, 6] = np.cos(TURN * times / 2), np.sin(TURN * times / 2)
    run = EngineRun(
        engine="Drake", version="1", settings={}, warnings=(), wall_seconds=1.0, times=times, names=("box",),
        poses=poses, leans=np.zeros(601),
    )  # fmt: skip
    return scene, drifts(scene, run, SECONDS)


def test_the_report_has_mm_and_degrees_a_minute_of_every_engine(tmp_path):
    _, verdict = _creeping()
    (tmp_path / "report.json").write_text('{"passed": true}', encoding="utf-8")
    engines = chosen(["drake", "pybullet", "physx"])
    record(
        tmp_path, engines, (verdict, Failed(engine="PyBullet", reason="it fell over"), Absent(engine="x", reason="y"))
    )
    found = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))[KEY]
    assert set(found) == {"drake", "pybullet"}
    assert found["drake"]["worst_creep_mm_per_minute"] == pytest.approx(60e3 * SPEED, rel=1e-6)
    assert found["drake"]["worst_creep_degrees_per_minute"] == pytest.approx(np.degrees(60 * TURN), rel=1e-6)
    assert found["drake"]["objects"][0]["creep_mm"] == pytest.approx(60e3 * SPEED, rel=1e-6)
    assert found["pybullet"]["failed"] == "it fell over"


def test_the_table_tells_creep_beside_drift():
    scene, verdict = _creeping()
    console = Console(width=200, record=True, quiet=False)
    with console.capture() as told:
        show_engines(console, scene, (verdict,))
    # 2 um a second for a minute, twice: how far it came, and its speed.
    assert "0.120, 0.034; 0.12, 0.034" in told.get()
