"""What is no score: a broken installation, an environment that raises, a process that dies, a policy that is none."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pyarrow")
pytest.importorskip("gymnasium")

import pat3d
from pat3d.cli.main import main
from pat3d.errors import InfrastructureError
from pat3d.policies_eval.policies.registry import RandomPolicy
from pat3d.policies_eval.run.episodes import Setting, episodes_of
from pat3d.policies_eval.run.evaluate import evaluate
from pat3d.policies_eval.run.records import read_evaluation
from pat3d.policies_eval.run.settings import RolloutSettings

SHORT = RolloutSettings(max_steps=4, act_seconds=3600.0)
EPISODES = episodes_of([Setting(scene="", task="pick:red mug")], 3)


def command(code: str, *arguments: str, cwd: Path) -> subprocess.CompletedProcess:
    """`pat3d ARGUMENTS` in a process of its own, after `code`; worker processes start with the same code."""
    (cwd / "sitecustomize.py").write_text(code)
    path = os.pathsep.join([str(cwd), str(Path(pat3d.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, "-m", "pat3d", *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": path},
    )


BROKEN_ENVIRONMENT = """
import importlib.abc, sys
class Broken(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name == "pat3d.policies_eval.run.failures":
            sys.meta_path.remove(self)
            import pat3d.policies_eval.run.settings as settings
            def make_env(*args, **more):
                raise AttributeError("'MjData' object has no attribute 'qM'")
            settings.RolloutSettings.make_env = make_env
sys.meta_path.insert(0, Broken())
"""
"""As of a MuJoCo that the environments do not know: every environment raises when it is made."""


WITHOUT_GYMNASIUM = """
import importlib.abc, sys
class Absent(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.split(".")[0] == "gymnasium":
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Absent())
"""


def test_an_environment_that_raises_is_no_score_and_claims_no_folder(tmp_path):
    pytest.importorskip("robosuite")
    done = command(BROKEN_ENVIRONMENT, "evaluate", "--policy", "random", "--episodes", "3", "--out", "o", cwd=tmp_path)
    assert done.returncode == 1
    assert "has no attribute 'qM'" in done.stderr
    assert "This is no score" in done.stderr
    assert "Traceback" not in done.stderr
    assert "success" not in done.stdout
    assert not (tmp_path / "o").exists()


@pytest.mark.parametrize(
    ("arguments", "out"),
    [
        (["evaluate", "--policy", "random", "--episodes", "1"], "o"),
        (["demonstrate", "--episodes", "1"], "o.hdf5"),
        (["train", "--episodes", "1"], "o.pt"),
    ],
)
def test_without_gymnasium_the_command_says_how_to_get_it(tmp_path, arguments, out):
    done = command(WITHOUT_GYMNASIUM, *arguments, "--out", out, cwd=tmp_path)
    assert done.returncode == 2
    assert f"pat3d: pat3d {arguments[0]} needs gymnasium, which is not installed: pip install 'pat3d[" in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / out).exists()


@pytest.mark.parametrize("policy", ["scriptd", "no.such.module:make", f"{__name__}:nothing", "missing.pt"])
def test_a_misspelt_policy_claims_no_folder(tmp_path, capsys, policy):
    pytest.importorskip("robosuite")
    out = tmp_path / "o"
    assert main(["evaluate", "--policy", policy, "--episodes", "1", "--out", str(out)]) == 2
    streams = capsys.readouterr()
    assert "success" not in streams.out
    assert "Traceback" not in streams.err
    assert not out.exists()


def test_what_was_done_before_a_failure_is_kept_and_the_run_goes_on_when_it_is_mended(tmp_path, monkeypatch):
    pytest.importorskip("robosuite")
    from pat3d.policies_eval.run.rollout import Runner

    run = Runner.run

    def broken(self, episode, policy, watch=None):
        if episode.index == 1:
            raise RuntimeError("the engine is gone")
        return run(self, episode, policy, watch)

    monkeypatch.setattr(Runner, "run", broken)
    with pytest.raises(InfrastructureError, match=r"episode 1 could not be done: RuntimeError: the engine is gone"):
        evaluate(RandomPolicy(), EPISODES, tmp_path / "o", settings=SHORT, workers=0)
    assert [one.episode.index for one in read_evaluation(tmp_path / "o").results] == [0]
    monkeypatch.setattr(Runner, "run", run)
    found = evaluate(RandomPolicy(), EPISODES, tmp_path / "o", settings=SHORT, workers=0)
    assert [one.episode.index for one in found.results] == [0, 1, 2]


def test_overwriting_throws_nothing_away_before_there_is_something_new(tmp_path, monkeypatch):
    pytest.importorskip("robosuite")
    from pat3d.policies_eval.run.rollout import Runner

    evaluate(RandomPolicy(), EPISODES[:1], tmp_path / "o", settings=SHORT, workers=0)
    before = {path.name: path.read_bytes() for path in (tmp_path / "o").iterdir()}

    def broken(self, episode, policy, watch=None):
        raise RuntimeError("the engine is gone")

    run = Runner.run
    monkeypatch.setattr(Runner, "run", broken)
    with pytest.raises(InfrastructureError):
        evaluate(RandomPolicy(), EPISODES, tmp_path / "o", settings=SHORT, workers=0, overwrite=True)
    assert {path.name: path.read_bytes() for path in (tmp_path / "o").iterdir()} == before
    monkeypatch.setattr(Runner, "run", run)
    found = evaluate(RandomPolicy(), EPISODES[1:], tmp_path / "o", settings=SHORT, workers=0, overwrite=True)
    assert [one.episode.index for one in found.results] == [1, 2]
    assert read_evaluation(tmp_path / "o").manifest["episodes"] == 2


class Killed(RandomPolicy):
    """Its process is killed while it is made, which is before any policy was asked: once, or every time."""

    def __init__(self):
        mark = Path(os.environ["PAT3D_TEST_KILLED"])
        if mark.name == "always" or not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)

    def act(self, observation):
        return np.zeros(7)


@pytest.mark.slow
def test_a_process_that_dies_outside_of_the_policy_is_tried_again_once(tmp_path, monkeypatch):
    pytest.importorskip("robosuite")
    monkeypatch.setenv("PAT3D_TEST_KILLED", str(tmp_path / "once"))
    found = evaluate(f"{__name__}:Killed", EPISODES[:1], tmp_path / "o", settings=SHORT, workers=1)
    assert [one.outcome for one in found.results] == ["missed"]
    monkeypatch.setenv("PAT3D_TEST_KILLED", str(tmp_path / "always"))
    with pytest.raises(InfrastructureError, match="exit code -9, 2 times, outside of the policy"):
        evaluate(f"{__name__}:Killed", EPISODES[:1], tmp_path / "p", settings=SHORT, workers=1)
    assert not (tmp_path / "p").exists()
