"""Diagnoses of suites: what speaks against one, and one made for real that goes on where it stopped."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from pat3d.envs.physics.loading import default_scene
from pat3d.envs.suites import sight
from pat3d.errors import EvaluationError
from pat3d.policies_eval.analysis.diagnosis import Diagnosis, Extent, decisions, settings_in
from pat3d.policies_eval.analysis.findings import Shares, judged, verdicts
from pat3d.policies_eval.analysis.statistics import Loss, episodes_for
from pat3d.policies_eval.analysis.survey import VIEWS, Surveyed, coverage, look, spread
from tests.envs.own_arm import own_arm


def scene(place: int = 0, **changes) -> Surveyed:
    plain = Surveyed(
        place=place, split="train", kind="pick", instruction="pick up the mug", wordings=5, ambiguous=(),
        seen={"agentview": {"mug": 0.002}, "closeview": {"mug": 0.02}}, nouns=(f"noun {place}",), sources=("ground",),
        grasps=("from above",), reach=(0.55,),
    )  # fmt: skip
    return replace(plain, **changes)


GOOD = [scene(place) for place in range(10)]


def shares(**rates: tuple[int, int]) -> Shares:
    """Successes and episodes on training scenes, a scene for each."""
    found = Shares()
    for policy, (good, count) in rates.items():
        for place in range(count):
            found.add(policy, "train", place, success=place < good)
    return found


def test_nothing_speaks_against_a_suite_without_shortcuts():
    assert judged(GOOD, shares(scripted=(20, 20), task=(15, 20), objects=(2, 20), words=(0, 20), robot=(0, 20))) == ()


@pytest.mark.parametrize(
    ("surveyed", "found", "said"),
    [
        ([*GOOD, scene(10, ambiguous=("mug 2",))], {}, "1 of 11 instructions do not mean one object: scene 10"),
        ([*GOOD, scene(10, seen={"agentview": {"a": 0.1, "b": 0.004}, "closeview": {"a": 0.1, "b": 0.0049}})], {},
         "covers less than 0.5 % of every fixed camera's picture; least 0.49 % in scene 10"),
        ([scene(k, nouns=("can",) if k < 4 else (f"n{k}",)) for k in range(10)], {}, '40 % of the objects that are'),
        (GOOD, {"robot": (8, 20)}, "neither objects nor words succeeds in 40.0 %"),
        (GOOD, {"words": (8, 20)}, "hears the instruction and sees nothing"),
        (GOOD, {"replay": (8, 20)}, "actions repeated from another start"),
        (GOOD, {"task": (16, 20), "objects": (16, 20)}, "language hardly matters"),
        (GOOD, {"scripted": (10, 20)}, "some scenes may be impossible"),
        (GOOD, {"task": (9, 20)}, "nothing is told of shortcuts and overfitting"),
    ],
)  # fmt: skip
def test_what_speaks_against_a_suite_is_told(surveyed, found, said):
    lines = judged(surveyed, shares(**found))
    assert len(lines) == 1
    assert said in lines[0]


@pytest.mark.parametrize("found", [{"robot": (3, 20)}, {"replay": (4, 20)}, {"task": (16, 20), "objects": (9, 20)}])
def test_what_chance_explains_is_not_told(found):
    assert judged(GOOD, shares(**found)) == ()


def test_training_that_does_not_carry_over_is_told():
    found = shares(task=(18, 20))
    for place in range(20):
        found.add("task", "new objects", place, success=place < 4)
        found.add("task", "new layouts", place, success=place < 14)
    (line,) = judged(GOOD, found)
    assert "does not carry over" in line
    assert "new objects" in line


@pytest.mark.parametrize(
    ("here", "there", "said"),
    [
        (95, 30, "loses 65 points [54, 74] on new layouts: training does not carry over"),
        (95, 93, "training carries over"),
        (60, 45, "too few scenes to tell"),
        (40, 0, "the baseline is too weak to tell"),
    ],
)
def test_what_the_baseline_loses_comes_with_an_interval_and_a_verdict(here, there, said):
    found = shares(task=(here, 100))
    for place in range(100):
        found.add("task", "new layouts", place, success=place < there)
    (text,) = verdicts(found).values()
    assert said in text
    assert (text in judged(GOOD, found)) == ("not carry over" in said)


def test_ten_scenes_say_less_than_a_hundred():
    """Episodes in one scene end alike: a hundred in ten scenes are worth ten."""
    few, many = shares(task=(90, 100)), shares(task=(90, 100))
    for episode in range(100):
        few.add("task", "new objects", episode % 10, success=episode % 10 < 6)
        many.add("task", "new objects", episode, success=episode % 10 < 6)
    losses = [one.loss("task", "new objects") for one in (few, many)]
    low = [one.low for one in losses if one is not None]
    assert low[0] < 0.1 < 0.15 < low[1]


def test_scenes_that_anybody_does_and_that_nobody_does():
    found = Shares()
    for policy, place, success in (("robot", 3, True), ("robot", 4, False), ("replay", 7, True), ("scripted", 4, False),
                                   ("scripted", 4, True), ("scripted", 5, False), ("scripted", 5, False)):  # fmt: skip
        found.add(policy, "train", place, success=success)
    assert found.done_by("robot", "replay") == (3, 7)
    assert found.never_done_by("scripted") == (5,)
    assert found.unlike("scripted", "train") == 0.5
    assert found.unlike("robot", "train") is None


def test_episodes_for_a_difference_are_those_of_the_normal_approximation():
    """By hand: z = 1.959964 and 0.841621; half of the pairs differ, by ten points."""
    by_hand = (1.959964 * 0.5**0.5 + 0.841621 * (0.5 - 0.01) ** 0.5) ** 2 / 0.01
    assert episodes_for(0.5, 0.1) == pytest.approx(by_hand, abs=1.0)
    found = decisions(0.04)
    assert found["unrelated failures"]["10 %"] == episodes_for(0.5, 0.1)
    # Fewer pairs than the difference cannot differ.
    assert found["as alike as two seeds"] == {
        "2 %": episodes_for(0.04, 0.02), "5 %": episodes_for(0.05, 0.05), "10 %": episodes_for(0.10, 0.10),
    }  # fmt: skip
    assert list(decisions(None)) == ["unrelated failures"]


def test_coverage_counts_what_is_moved_and_scenes_are_spread_over_the_suite():
    counted = coverage([scene(0, nouns=("can", "can"), reach=(0.31, 0.39)), scene(1, kind="sort", sources=("in",))])
    assert counted["noun"] == {"can": 2, "noun 1": 1}
    assert counted["task"] == {"pick": 1, "sort": 1}
    assert counted["from"] == {"ground": 1, "in": 1}
    assert counted["distance"] == {"0.3 m": 2, "0.5 m": 1}
    assert spread(range(100), 4) == (0, 25, 50, 75)  # type: ignore[arg-type]
    assert spread(range(3), 4) == (0, 1, 2)  # type: ignore[arg-type]


def test_a_scene_is_looked_at_and_tried_in_its_own_room(tmp_path, monkeypatch):
    """Pictures are drawn of a world with that room, and episodes of the networks are in it."""
    mujoco = pytest.importorskip("mujoco")
    pytest.importorskip("gymnasium")
    arm = tmp_path / "arm.xml"
    arm.write_text(own_arm())
    entry = SimpleNamespace(place=4, split="train", kind="pick", task="pick:red mug", room="kitchen:3")
    request = SimpleNamespace(robot=str(arm), rooms=("kitchen", "office"))
    folder = SimpleNamespace(scene=lambda place: default_scene())
    suite: Any = SimpleNamespace(entries=(entry,), request=request, folder=folder, verify=lambda entry: None)
    asked, plain = [], sight.shares

    def shares(pictures, *about):
        model = pictures._simulation.model
        asked.append(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_MATERIAL, "room/walls") >= 0)
        return plain(pictures, *about)

    monkeypatch.setattr(sight, "shares", shares)
    found = look(suite, entry)  # type: ignore
    assert asked == [True] * len(VIEWS)
    assert found.least_seen("agentview") > 0.0
    (setting,) = settings_in(suite, ("train",))
    assert (setting.room, setting.rooms) == ("kitchen:3", ("kitchen", "office"))


@pytest.mark.parametrize(
    "wrong", [{"scenes": 0}, {"rounds": -1}, {"curve": 9}, {"episodes": 0}, {"demonstrations": -1}, {"epochs": 0}]
)
def test_an_extent_that_is_none_is_refused(wrong):
    with pytest.raises(EvaluationError):
        Extent(**wrong)


@pytest.mark.slow
def test_a_suite_is_diagnosed_and_the_diagnosis_goes_on_where_it_stopped(tmp_path, capsys, monkeypatch):
    pytest.importorskip("robosuite")
    pytest.importorskip("torch")
    pytest.importorskip("pyarrow")
    from pat3d.cli.evaluation_documents import DiagnosisFacts
    from pat3d.envs.suites.generate import generate
    from pat3d.policies_eval.analysis import diagnosis
    from pat3d.policies_eval.run import evaluate
    from pat3d.policies_eval.training import KINDS
    from tests.documents import document_of
    from tests.envs.suites import SMALL

    suite, out = tmp_path / "suite", tmp_path / "diagnosis"
    generate(str(suite), replace(SMALL, robot="Panda"), workers=1)
    monkeypatch.setattr("pat3d.envs.suites.worker_pool.worker_count", lambda count: 0)
    command = ["suite", "diagnose", str(suite), "--out", str(out), "--demonstrations", "2", "--episodes", "2",
               "--epochs", "2", "--rounds", "0"]  # fmt: skip

    def stop(*_, **__):
        raise EvaluationError("stopped")

    monkeypatch.setattr(evaluate, "evaluate", stop)
    capsys.readouterr()
    from pat3d.cli.main import main

    assert main(command) == 2
    assert {one.name for one in out.iterdir()} >= {"request.json", "survey.json", "replay.json", "task.pt"}
    monkeypatch.undo()
    monkeypatch.setattr("pat3d.envs.suites.worker_pool.worker_count", lambda count: 0)
    monkeypatch.setattr(diagnosis, "survey", stop)
    found = document_of(capsys, command, DiagnosisFacts, code=1)
    assert found["looked_at"] == 4
    assert set(found["rates"]) == {"replay", "scripted", *KINDS}
    assert found["rates"]["scripted"]["train"]["successes"] == 2
    assert found["ambiguous"] == found["impossible"] == []
    assert found["least_seen"]["closeview"] >= 0.005
    assert main([*command, "--seed", "1"]) == 2
    assert "holds another diagnosis" in capsys.readouterr().err


def test_a_diagnosis_survives_json():
    import json

    found = Diagnosis(
        suite="s", checksum="c", surveyed=(scene(),), rates=shares(robot=(1, 3)).rates(), decisions=decisions(None),
        too_easy=(1,), impossible=(), findings=("x",), carried=("y",),
        losses={"new objects": Loss(value=0.1, low=-0.1, high=0.3)},
    )  # fmt: skip
    told = json.loads(json.dumps(found.to_json()))
    assert Surveyed.from_json(told["surveyed"][0]) == scene()
    assert told["rates"]["robot"]["train"]["successes"] == 1
