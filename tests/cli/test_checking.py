"""`pat3d check --engines`: an engine that is named has to be here."""

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
