"""Whole evaluations: records, resuming, worker processes, comparison, report, command line."""

from __future__ import annotations

import json
import os
import re
import time
from collections import deque
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pyarrow")
pytest.importorskip("robosuite")

from pat3d.cli.evaluation_documents import ComparisonFacts, EvaluationFacts, RankedFacts, ReplayFacts
from pat3d.cli.main import main
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.charts import axis, interval_bar
from pat3d.policies_eval.analysis.compare import compare_evaluations, show_leaderboard, verdict
from pat3d.policies_eval.analysis.report import write_report
from pat3d.policies_eval.analysis.signing import Signature
from pat3d.policies_eval.analysis.statistics import Rate
from pat3d.policies_eval.analysis.summary import summarise
from pat3d.policies_eval.policies.registry import RandomPolicy
from pat3d.policies_eval.run import evaluate as module
from pat3d.policies_eval.run import records as records_module
from pat3d.policies_eval.run.episodes import Setting, episodes_of
from pat3d.policies_eval.run.evaluate import evaluate, next_episode
from pat3d.policies_eval.run.records import read_evaluation
from pat3d.policies_eval.run.settings import RolloutSettings
from tests.documents import document_of

SHORT = RolloutSettings(max_steps=8, act_seconds=3600.0)
"""No machine is so slow that an action of these policies takes an hour."""
EPISODES = episodes_of([Setting(scene="", task="pick:red mug")], 4)


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Four short episodes of the random policy."""
    return evaluate("random", EPISODES, tmp_path_factory.mktemp("eval") / "random", settings=SHORT, workers=0)


def test_records_come_back_as_they_were_written(done):
    again = read_evaluation(done.folder)
    assert [one.episode for one in again.results] == list(EPISODES)
    for mine, theirs in zip(done.results, again.results, strict=True):
        assert mine.to_json() == theirs.to_json()
        assert np.array_equal(mine.actions, theirs.actions)
        assert mine.final_state == theirs.final_state
    assert not (done.folder / "parts").exists()


def test_a_stopped_run_goes_on_where_it_stopped(done, tmp_path):
    class StopError(Exception):
        pass

    for stops in (2, 3):

        def stop(result, finished, wanted, stops=stops):
            if finished == stops:
                raise StopError

        with pytest.raises(StopError):
            evaluate("random", EPISODES, tmp_path, settings=SHORT, workers=0, report=stop)
        # What the earlier run did is still on disk after the later one was stopped too.
        assert len(read_evaluation(tmp_path).results) == stops
    seen = []
    found = evaluate("random", EPISODES, tmp_path, settings=SHORT, workers=0, report=lambda *a: seen.append(a))
    assert len(seen) == 1
    assert [one.state_hash for one in found.results] == [one.state_hash for one in done.results]


def test_episodes_that_take_longer_than_a_second_are_kept_at_once_and_shorter_ones_every_second(
    done, tmp_path, monkeypatch
):
    clock = [0.0]
    monkeypatch.setattr(records_module.time, "monotonic", lambda: clock[0])
    folder, kept = records_module.RecordFolder(tmp_path), []
    for result, seconds in zip(done.results, (0.4, 0.4, 0.4, 2.0), strict=True):
        clock[0] += seconds
        folder.add(result)
        kept.append([one.episode.index for one in records_module.RecordFolder(tmp_path).read()])
    assert kept == [[], [], [0, 1, 2], [0, 1, 2, 3]]


def test_another_evaluation_in_the_folder_is_not_mixed_with(done):
    with pytest.raises(EvaluationError, match="max_steps: 8 there, 9 now"):
        evaluate("random", EPISODES, done.folder, settings=replace(SHORT, max_steps=9), workers=0)


class Freezes:
    """Hangs where no Python exception reaches it, in the second episode; dies in the third."""

    def reset(self, episode):
        if episode.seed == EPISODES[1].seed:
            import signal

            signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGALRM])
            Path(os.environ["PAT3D_TEST_FROZEN"]).touch()
            time.sleep(100_000)
        if episode.seed == EPISODES[2].seed:
            os._exit(7)

    def act(self, observation):
        return np.zeros(7)


def test_a_worker_stays_with_its_scene_while_there_are_episodes_of_it():
    queue = deque(episodes_of([Setting(scene=name, task="pick:a") for name in "xyz"], 7))
    taken, about = [], ("", "")
    while queue:
        episode = next_episode(queue, about)
        taken.append(episode.index)
        about = (episode.scene, episode.task)
    assert taken == [0, 3, 6, 1, 4, 2, 5]


@pytest.mark.slow
def test_a_worker_that_hangs_or_dies_is_a_policy_error_and_the_run_goes_on(tmp_path, monkeypatch):
    """The policy says when it hangs, and only then has the parent's clock passed the hour that an action may take."""
    frozen = tmp_path / "frozen"
    monkeypatch.setenv("PAT3D_TEST_FROZEN", str(frozen))

    def now():
        late = 2 * SHORT.act_seconds if frozen.exists() else 0.0
        frozen.unlink(missing_ok=True)
        return time.monotonic() + late

    monkeypatch.setattr(module, "now", now)
    found = evaluate(f"{__name__}:Freezes", EPISODES, tmp_path / "f", settings=SHORT, workers=1)
    assert [one.outcome for one in found.results] == ["missed", "policy_error", "policy_error", "missed"]
    assert "hang" in found.results[1].reason
    assert "exit code 7" in found.results[2].reason
    summary = summarise(found)
    assert (summary.rate.episodes, summary.outcomes["policy_error"]) == (4, 2)


def test_comparison_pairs_episodes_and_refuses_what_cannot_be_compared(done, tmp_path):
    other = evaluate(RandomPolicy(), EPISODES[:3], tmp_path / "b", settings=SHORT, workers=0)
    found = compare_evaluations(done, other)
    assert (found.comparison.neither, found.left_out) == (3, 1)
    assert "No difference" in verdict(found)
    shifted = episodes_of([Setting(scene="", task="pick:red mug")], 3, seed=1)
    strange = evaluate("random", shifted, tmp_path / "c", settings=SHORT, workers=0)
    with pytest.raises(EvaluationError, match="seed"):
        compare_evaluations(done, strange)
    file = tmp_path / "b" / "manifest.json"
    manifest = json.loads(file.read_text())
    manifest["engine"]["mujoco"] = "2.0.0"
    file.write_text(json.dumps(manifest))
    with pytest.raises(EvaluationError, match=r"mujoco \(2.0.0"):
        compare_evaluations(done, read_evaluation(tmp_path / "b"))


@pytest.mark.slow
def test_two_runs_with_the_same_options_compare_and_others_say_which_differ(tmp_path, capsys):
    def run(policy, name, *more):
        episodes = ["--episodes", "2", "--max-steps", "4", "--no-pictures", *more]
        assert main(["evaluate", "--policy", policy, *episodes, "--out", str(tmp_path / name)]) == 0
        return str(tmp_path / name)

    first, second = run("scripted", "a"), run("random", "b")
    perturbed = run("random", "c", "--perturb", "pose=0.01")
    capsys.readouterr()
    assert main(["compare", first, second]) == 0
    assert "McNemar p = 1" in capsys.readouterr().out
    told = document_of(capsys, ["compare", first, second], ComparisonFacts)
    assert (told["neither"], told["p_value"], told["decided"]) == (2, 1.0, False)
    ranked = document_of(capsys, ["leaderboard", first, perturbed], list[RankedFacts])
    assert [one["rate"]["episodes"] for one in ranked] == [2, 2]
    assert ranked[0]["source"] != ranked[1]["source"]
    again = ["evaluate", "--policy", "random", "--episodes", "2", "--max-steps", "4", "--no-pictures", "--out", second]
    assert document_of(capsys, again, EvaluationFacts)["rate"]["successes"] == 0
    assert main(["compare", first, perturbed]) == 2
    assert "evaluate both with the same --perturb." in capsys.readouterr().err
    assert main(["leaderboard", first, second]) == 0


def test_the_leaderboard_keeps_engines_apart(done, tmp_path, capsys):
    from pat3d.cli.console import console

    other = read_evaluation(done.folder)
    other.manifest["engine"]["mujoco"] = "2.0.0"
    show_leaderboard(console(), [read_evaluation(done.folder), other], {done.folder: Signature(state="unsigned")})
    out = capsys.readouterr().out
    assert out.count("policy errors") == 2
    assert "not comparable" in out


def test_the_report_s_settings_come_first_and_without_brackets(done):
    run = read_evaluation(done.folder)
    run.manifest["source"] = {"perturbation": {"pose": 0.04, "mass": 0.0}, "tasks": ["pick:red mug", "pick:banana"]}
    page = write_report(run, summarise(run), pictures=False).read_text(encoding="utf-8")
    text = re.sub(r"<(style|svg)\b.*?</\1>|<[^>]*>", " ", page, flags=re.DOTALL)
    assert not set("{}[]'") & set(text)
    assert text.index("Settings") < text.index("How the episodes ended")
    assert re.search(r"robot\s+\w+", text)
    assert re.search(r"perturbation\s+pose 0.04\s+tasks\s+pick:red mug, pick:banana\s", text)


def test_an_axis_says_where_on_a_bar_the_quarters_are():
    """Labels, ticks, the rate and its interval are shares of the same width."""
    bar = interval_bar(Rate(successes=1, episodes=2, low=0.25, high=0.75))
    labels = re.findall(r'left:([\d.]+)%"[^>]*>([\d.]+) %', axis())
    assert [float(at) for at, _ in labels] == [float(told) for _, told in labels] == [0.0, 25.0, 50.0, 75.0, 100.0]
    assert [float(at) for at in re.findall(r'class="tick" style="left:([\d.]+)%', bar)] == [0, 25, 50, 75, 100]
    assert float(re.search(r'class="rate" style="left:([\d.]+)%', bar)[1]) == 50.0
    left, wide = map(float, re.search(r'class="span" style="left:([\d.]+)%;width:([\d.]+)%', bar).groups())
    assert (left, left + wide) == (25.0, 75.0)


def test_the_report_is_one_page_without_links_to_anything(done):
    page = write_report(done, summarise(done), pictures=True).read_text(encoding="utf-8")
    assert "0.0 %" in page
    assert "data:image/jpeg;base64," in page
    assert "http" not in page.replace("http-equiv", "")
    assert 'src="data:' in page
    assert page.count("<section") == page.count("</section>")


def test_hostile_records_are_errors(tmp_path, done):
    with pytest.raises(EvaluationError, match="no evaluation"):
        read_evaluation(tmp_path)
    (tmp_path / "manifest.json").write_text("[1]")
    with pytest.raises(EvaluationError, match="format"):
        read_evaluation(tmp_path)
    good = (done.folder / "manifest.json").read_text()
    (tmp_path / "manifest.json").write_text(good.replace('"format": 1', '"format": 99'))
    with pytest.raises(EvaluationError, match="upgrade"):
        read_evaluation(tmp_path)
    (tmp_path / "manifest.json").write_text(good)
    (tmp_path / "episodes.parquet").write_bytes(b"PAR1 junk")
    with pytest.raises(EvaluationError, match="not readable"):
        read_evaluation(tmp_path)


def test_a_film_shows_one_episode(done, tmp_path, capsys):
    folder = str(done.folder)
    arguments = ["replay", folder, "--episode", "1", "--size", "64x48"]
    assert main([*arguments, "--video", str(tmp_path / "x.gif"), "--picture", str(tmp_path / "x.png")]) == 0
    assert (tmp_path / "x.png").stat().st_size > 1000
    assert (tmp_path / "x.gif").read_bytes()[:4] == b"GIF8"
    told = capsys.readouterr()
    assert "1 of 1 episodes went as recorded" in told.out
    assert "filming 1/" in told.err
    told = document_of(capsys, [*arguments, "--picture", str(tmp_path / "y.png")], ReplayFacts)
    assert told["files"] == [str(tmp_path / "y.png")]
    assert (told["replayed"], told["different"]) == (1, [])
    assert main(["replay", folder, "--episode", "99"]) == 2
    assert "done: 0 to 3" in capsys.readouterr().err
    assert main(["replay", folder, "--video", str(tmp_path / "x.gif")]) == 2


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--policy", "nonsense"], "scripted"),
        (["--policy", "random", "--task", "pick:octopus"], "red mug"),
        (["--policy", "random", "--scene", "nowhere"], "scene folder"),
        (["--policy", "random", "--perturb", "wind=1"], "Axes"),
        (["--policy", "random", "--workers", "many"], "auto"),
        (["--policy", "random", "--episodes", "0"], "episodes"),
    ],
)
def test_what_the_user_got_wrong_is_said_without_a_traceback(arguments, words, tmp_path, capsys):
    assert main(["evaluate", *arguments, "--out", str(tmp_path / "o")]) == 2
    assert words in capsys.readouterr().err


class Broken:
    def reset(self, episode):
        pass

    def act(self, observation):
        raise RuntimeError("no weights")


class Excessive(Broken):
    def act(self, observation):
        return np.full(7, 3.0)


@pytest.mark.slow
def test_an_evaluation_of_nothing_but_policy_errors_exits_with_1_and_says_so(tmp_path, capsys):
    common = ["--episodes", "2", "--max-steps", "3", "--no-pictures"]
    assert main(["evaluate", "--policy", f"{__name__}:Broken", *common, "--out", str(tmp_path / "broken")]) == 1
    assert "every episode ended by an error of the policy, RuntimeError: no weights" in capsys.readouterr().err
    assert main(["evaluate", "--policy", f"{__name__}:Excessive", *common, "--out", str(tmp_path / "loud")]) == 0
    assert "clipped: 42 of 42 action values" in capsys.readouterr().out
    assert (
        main(["evaluate", "--policy", f"{__name__}:Excessive", "--strict", *common, "--out", str(tmp_path / "x")]) == 1
    )
