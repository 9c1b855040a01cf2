"""`pat3d check --engines`: an engine that is named has to be here."""

import json
from pathlib import Path

import pytest

from pat3d.check.engines import registry
from pat3d.check.engines.protocol import EngineRun
from pat3d.cli.main import main
from pat3d.errors import CheckError
from pat3d.scene.io import load_scene, save_scene
from tests.cli.test_optimize import overhanging_scene


class Engine:
    """Here, where every object stands still; or absent."""

    format = "mjcf"

    def __init__(self, name, here):
        self.name, self.title, self.here = name, name.upper(), here

    def absence(self):
        return None if self.here else "not made"

    def run(self, folder, seconds, *, timeout):
        raise CheckError("it fell over")


@pytest.fixture
def scene(tmp_path, monkeypatch):
    save_scene(overhanging_scene(), tmp_path / "scene")
    engines = {one.name: one for one in (Engine("here", True), Engine("gone", False), Engine("lost", False))}
    monkeypatch.setattr(registry, "ENGINES", engines)
    monkeypatch.setattr(registry, "GROUPS", {"all": tuple(engines), "pair": ("gone", "lost")})

    def still(scene, run, seconds):
        from pat3d.check.settle import SettleReport

        return SettleReport(
            engine="HERE", version="1", seconds=seconds, wall_seconds=0.0, objects=(), settings={}, warnings=(),
            contacts=None,
        )  # fmt: skip

    monkeypatch.setattr("pat3d.check.engines.check.drifts", still)
    monkeypatch.setattr(Engine, "run", lambda self, folder, seconds, timeout: EngineRun)
    assert load_scene(tmp_path / "scene").objects
    return str(tmp_path / "scene")


@pytest.mark.parametrize(
    ("names", "code", "missed"),
    [
        (["here"], 0, []),
        (["all"], 0, []),
        (["gone"], 1, ["GONE"]),
        (["here,gone"], 1, ["GONE"]),
        (["all", "lost"], 1, ["LOST"]),
        (["pair", "here"], 1, ["GONE", "LOST"]),
    ],
)
def test_an_engine_that_was_named_and_is_absent_fails_the_check(scene, capfd, names, code, missed):
    assert main(["check", scene, "--engines", *names]) == code
    told = capfd.readouterr().err
    for name in ("GONE", "LOST"):
        assert (f"{name} was asked for and is not here" in told) == (name in missed)


@pytest.mark.parametrize("seconds", ["0", "601", "-1"])
def test_simulated_time_has_limits(scene, capfd, seconds):
    assert main(["check", scene, "--engines", "here", "--seconds", seconds]) == 2
    assert "at most 600 s" in capfd.readouterr().err


def test_what_engines_did_is_recorded_in_the_report(scene, capfd):
    report = Path(scene) / "report.json"
    assert main(["check", scene, "--engines", "here", "--record"]) == 2
    assert "there is no report to add to" in capfd.readouterr().err
    report.write_text('{"passed": true, "engines": {"drake": {"worst_mm": 0.5}}}', encoding="utf-8")
    assert main(["check", scene, "--engines", "all", "--seconds", "60", "--record"]) == 0
    document = json.loads(report.read_text(encoding="utf-8"))
    assert document["passed"] is True
    # The absent ones leave nothing, and other engines' earlier runs stay.
    assert set(document["engines"]) == {"drake", "here"}
    assert document["engines"]["here"]["seconds"] == 60


def test_nothing_is_recorded_of_the_check_itself(scene, capfd):
    assert main(["check", scene, "--record"]) == 2
    assert "--engines" in capfd.readouterr().err
