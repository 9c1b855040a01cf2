"""Suites made for real: two runs of one request, one with a worker killed and one killed itself, and what they hold."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import threading
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

pytest.importorskip("robosuite")
gymnasium = pytest.importorskip("gymnasium")

import pat3d  # noqa: E402, F401
from pat3d.cli.documents import ConventionFacts, SpecFacts, SuiteFacts  # noqa: E402
from pat3d.cli.main import main  # noqa: E402
from pat3d.envs.lerobot import make_env  # noqa: E402
from pat3d.envs.suites.check import check_suite  # noqa: E402
from pat3d.envs.suites.folder import MANIFEST, RECORD, SuiteFolder, checksum_of_document  # noqa: E402
from pat3d.envs.suites.generate import generate  # noqa: E402
from pat3d.envs.suites.page import page  # noqa: E402
from pat3d.envs.suites.request import Request  # noqa: E402
from pat3d.envs.suites.suite import Suite  # noqa: E402
from pat3d.envs.suites.worker_pool import WorkerPool  # noqa: E402
from pat3d.errors import EnvironmentSetupError, ExportError, SuiteError, UnsettledSceneError  # noqa: E402
from pat3d.policies_eval.policies.scripted import ScriptedPolicy  # noqa: E402
from tests.documents import document_of  # noqa: E402
from tests.envs.suites import SMALL, alive, files_of, wait, workers_of  # noqa: E402

REQUEST = SMALL


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A suite by two workers, the first of which is killed once it has made something."""
    folder = tmp_path_factory.mktemp("suites") / "two"
    killed = []

    def kill_one(status):
        if status.made and not killed:
            killed.append(workers_of(os.getpid())[0])
            os.kill(killed[0], signal.SIGKILL)

    status = generate(str(folder), REQUEST, workers=2, tell=kill_one)
    assert killed
    assert status.done == status.total == 4
    return folder


@pytest.fixture
def copy(made, tmp_path):
    """The suite in a folder that a test may spoil."""
    return Path(shutil.copytree(made, tmp_path / "copy"))


@pytest.mark.slow
def test_a_run_killed_and_started_again_makes_the_same_suite_bit_for_bit(made, tmp_path):
    """One worker and SIGKILL in the middle, against two workers of which one was killed: only the log may differ."""
    folder = tmp_path / made.name
    command = [sys.executable, "-m", "pat3d", "suite", "generate", str(folder), "--tasks", "pick,stack",
               "--scenes", "4", "--objects", "4-6", "--picture", "64", "--seed", "3", "--workers", "1"]  # fmt: skip
    first = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    scenes = SuiteFolder(folder)
    wait(lambda: len(scenes.done()) >= 2 and any(scenes.work.glob("*-0*")), lambda: first.poll() is None)
    workers = workers_of(first.pid)
    first.kill()
    first.wait()
    wait(lambda: not any(alive(pid) for pid in workers))
    kept = {place: (scenes.scene(place) / RECORD).stat().st_mtime_ns for place in scenes.done()}
    assert len(kept) < 4
    with pytest.raises(SuiteError, match=r"unfinished: [23] of 4 scenes"):
        Suite.open(folder)
    status = generate(str(folder), REQUEST, workers=1)
    assert status.made == 4 - len(kept)
    assert all((scenes.scene(place) / RECORD).stat().st_mtime_ns == then for place, then in kept.items())
    page_of_its_own = {"index.html"}
    assert files_of(folder, page_of_its_own) == files_of(made, page_of_its_own)
    assert not scenes.work.exists()


def test_a_finished_suite_is_left_as_it_is(made):
    before = {path: path.stat().st_mtime_ns for path in made.glob("scenes/*/*")}
    status = generate(str(made), REQUEST, workers=1)
    assert (status.made, status.done) == (0, 4)
    assert {path: path.stat().st_mtime_ns for path in made.glob("scenes/*/*")} == before


def test_a_folder_in_use_names_the_process_that_has_it(made):
    with (
        SuiteFolder(made).locked(),
        pytest.raises(SuiteError, match=f"in use by process {os.getpid()} on "),
    ):
        generate(str(made), REQUEST, workers=1)


def test_another_request_is_refused_in_a_folder_that_has_a_suite(made):
    with pytest.raises(SuiteError, match="holds a suite with seed 3;"):
        generate(str(made), replace(REQUEST, seed=4), workers=1)
    with pytest.raises(SuiteError, match="longer, not shorter"):
        generate(str(made), replace(REQUEST, scenes=2), workers=1)


def test_a_folder_with_other_things_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("x")
    with pytest.raises(ExportError, match=r"holds files but no suite.json"):
        generate(str(tmp_path), REQUEST, workers=1)
    assert [one.name for one in tmp_path.iterdir()] == ["thesis.tex"]


def test_an_unknown_robot_is_answered_before_anything_is_written(tmp_path):
    with pytest.raises(EnvironmentSetupError, match="Robots: panda"):
        generate(str(tmp_path / "new"), replace(REQUEST, robot="Marvin"), workers=1)
    assert not (tmp_path / "new").exists()


@pytest.mark.slow
def test_a_worker_that_cannot_write_stops_the_run_and_nothing_is_lost(copy):
    """What a full disk does, by a file where the scene's folder has to go."""
    folder = SuiteFolder(copy)
    shutil.rmtree(folder.scene(1))
    shutil.rmtree(copy / "rejected", ignore_errors=True)
    (copy / "scenes").rename(copy / "aside")
    (copy / "scenes").write_text("no room")
    with pytest.raises(SuiteError, match=r"a worker had to stop: .*run the same command again"):
        generate(str(copy), replace(REQUEST, scenes=4), workers=1)
    (copy / "scenes").unlink()
    (copy / "aside").rename(copy / "scenes")
    assert folder.done() == {0, 2, 3}


@pytest.mark.slow
def test_a_scene_that_hangs_is_ended_and_recorded_and_another_takes_its_place(tmp_path, monkeypatch):
    """Whoever begins the first candidate of scene 1 is stopped by the system and never goes on by itself.

    The run's clock goes only while somebody hangs, so that a slow machine ends nobody.
    """
    folder, over = SuiteFolder(tmp_path / "hanging"), threading.Event()
    hung: set[int] = set()
    now = 0.0

    def clock() -> float:
        nonlocal now
        now += any(alive(pid) for pid in list(hung))
        return now

    monkeypatch.setattr(WorkerPool, "clock", staticmethod(clock))

    def hang() -> None:
        while not over.wait(0.005):
            for scratch in folder.work.glob("*-000001-00"):
                pid = int(scratch.name.split("-")[0])
                with suppress(ProcessLookupError):
                    # What one that has been ended left behind.
                    os.kill(pid, signal.SIGSTOP)
                hung.add(pid)

    thread = threading.Thread(target=hang)
    thread.start()
    try:
        status = generate(str(folder.path), replace(REQUEST, scenes=2, picture=0), workers=1, limit=6.0)
    finally:
        over.set()
        thread.join()
    assert status.done == 2
    assert len(hung) == 2, "it is tried twice"
    assert not any(alive(pid) for pid in hung)
    rejection = json.loads(folder.rejection(1, 0).read_text())
    assert rejection["reason"] == "time limit"
    assert "was not done after 6 s" in rejection["message"]
    assert Suite.open(folder.path).document["scenes"][1]["candidate"] >= 1


def test_every_scene_is_verified_and_the_manifest_says_so(made):
    suite = Suite.open(made)
    assert check_suite(suite) == []
    numbers = suite.document["numbers"]
    assert numbers["scenes"] == 4
    assert numbers["candidates"] == 4 + len(suite.document["rejected"])
    assert numbers["intersections"] == 0
    assert all(one["reason"] and one["message"] for one in suite.document["rejected"])
    assert set(suite.document["versions"]) >= {"pat3d", "mujoco", "warp-lang", "robosuite"}


def test_a_scene_whose_files_changed_is_refused_by_environments_and_by_the_check(copy):
    part = next(copy.glob("scenes/000002/mjcf/**/*.xml"))
    part.write_text(part.read_text() + " ")
    suite = Suite.open(copy)
    with pytest.raises(UnsettledSceneError, match="their checksum differs"):
        suite.load(suite.entries[2])
    assert check_suite(suite, settle=False) == [
        "scene 2: its files are not those that were verified (their checksum differs)."
    ]
    assert main(["suite", "check", str(copy), "--quick"]) == 1


def test_suites_from_a_newer_version_and_damaged_ones_are_told_apart(copy):
    document = json.loads((copy / MANIFEST).read_text())
    for change, message in (
        ({"version": 99}, "reads 2. Upgrade pat3d"),
        ({"version": 1}, "reads 2. Generate the suite again"),
        ({"format": "other"}, "not a suite's description"),
        ({"scenes": document["scenes"][:1]}, "does not list 4 scenes"),
        (
            {"scenes": [{**document["scenes"][0], "place": "../.."}, *document["scenes"][1:]]},
            "of scene 0 is incomplete",
        ),
    ):
        (copy / MANIFEST).write_text(json.dumps({**document, **change}))
        with pytest.raises(SuiteError, match=message):
            Suite.open(copy)
    with pytest.raises(SuiteError, match=r"is no suite: it has no suite.json"):
        Suite.open(copy / "scenes")


def test_an_environment_draws_the_suite_s_scenes_by_its_seed(made):
    env = gymnasium.make("PAT3D-v0", suite=made)
    drawn = [env.reset(seed=seed)[1]["index"] for seed in range(6)]
    assert drawn == [env.reset(seed=seed)[1]["index"] for seed in range(6)]
    assert len(set(drawn)) > 1
    entries = Suite.open(made).entries
    for index in range(4):
        observation, info = env.reset(options={"index": index})
        assert info["task"] == entries[index].task
        assert info["instruction"] == entries[index].instruction
        assert observation in env.observation_space
    with pytest.raises(SuiteError, match="valid are 0 to 3"):
        env.reset(options={"index": 4})


def test_split_and_kind_of_task_choose_scenes_and_unknown_ones_list_the_valid(made):
    env = gymnasium.make("PAT3D-v0", suite=made, split="train", task="stack", index=0)
    assert env.reset(seed=0)[1]["task"].startswith("stack:")
    for wrong, message in (
        ({"split": "tset"}, "Splits: train, val, test"),
        ({"task": "juggle"}, "Its tasks: pick, stack"),
        ({"split": "val/object"}, r"has no scene for any task; there are: train \d"),
    ):
        with pytest.raises(SuiteError, match=message):
            gymnasium.make("PAT3D-v0", suite=made, **wrong)
    with pytest.raises(EnvironmentSetupError, match="give suite=FOLDER too"):
        gymnasium.make("PAT3D-v0", split="train")


def test_vector_environments_over_a_suite(made):
    envs = gymnasium.make_vec("PAT3D-v0", num_envs=2, suite=made, vectorization_mode="sync")
    observations, infos = envs.reset(seed=0)
    free = [mujoco.MjModel.from_xml_path(str(path)).njnt for path in made.rglob("mjcf/scene.xml")]
    assert len(free) == 4
    assert observations["objects"].shape == (2, max(free), 7)
    assert np.all(infos["index"] < 4)
    envs.close()


def test_lerobot_gets_a_vector_environment_for_every_kind_of_task(made):
    envs = make_env(made, split="train", n_envs=1, image_size=(32, 32))
    assert set(envs) == {"pick", "stack"}
    observations, _ = envs["pick"][0].reset(seed=0)
    assert observations["pixels"]["agentview"].shape == (1, 32, 32, 3)
    assert envs["pick"][0].call("task_description")[0].startswith("pick up the ")
    assert observations in envs["pick"][0].observation_space


def evaluated(envs, episodes: int, *, seed: int | None, films: int = 0):
    """What `lerobot.scripts.lerobot_eval.eval_policy` (0.4.4) does with a vector environment and a still policy.

    Returns:
        Successes and instructions by episode, and the pictures of the first ones.
    """
    successes, told, pictures = [], [], []
    for batch in range(-(-episodes // envs.num_envs)):
        first = None if seed is None else seed + batch * envs.num_envs
        envs.reset(seed=None if first is None else list(range(first, first + envs.num_envs)))
        limit = envs.call("_max_episode_steps")[0]
        assert hasattr(envs.envs[0], "task_description")
        assert hasattr(envs.envs[0], "task")
        told += envs.call("task_description")
        done, won = np.zeros(envs.num_envs, dtype=bool), np.zeros(envs.num_envs, dtype=bool)
        for step in range(limit):
            pictures += [one.render() for one in envs.envs[:films]]
            *_, ended, cut, info = envs.step(np.zeros((envs.num_envs, 7), dtype=np.float32))
            if "final_info" in info:
                won |= ~done & np.array(info["final_info"]["is_success"].tolist())
            done |= ended | cut | (step + 1 == limit)
            if done.all():
                break
        successes += won.tolist()
    return successes[:episodes], told[:episodes], pictures


@pytest.mark.parametrize(
    ("count", "seed"),
    [pytest.param(1, 1000, marks=pytest.mark.slow), (2, 1000), pytest.param(1, None, marks=pytest.mark.slow)],
)
def test_lerobot_s_evaluator_sees_successes_instructions_films_and_every_scene_once(made, monkeypatch, count, seed):
    """The pick of the first scene succeeds by itself after three steps; nothing else is ever done."""
    from pat3d.envs.tasks import judges, task

    monkeypatch.setattr(task, "FIRST_MOVE", 0.3)
    entries = Suite.open(made).select("train", "pick")
    assert len(entries) == 2
    update, calls = judges.LiftJudge.update, []

    def won(judge, seconds):
        calls.append(judge)
        verdicts = update(judge, seconds)
        lucky = calls.count(judge) > 3 and entries[0].task.endswith(
            judge.states.world.scene.objects[judge._target].name
        )
        return verdicts._replace(success=np.array([lucky]))

    monkeypatch.setattr(judges.LiftJudge, "update", won)
    envs = make_env(made, split="train", n_envs=count, image_size=(32, 32))["pick"][0]
    successes, told, pictures = evaluated(envs, 2, seed=seed, films=1)
    assert told == [one.instruction for one in entries]
    assert successes == [True, False]
    assert pictures[0].shape == (32, 32, 3)
    assert pictures[0].dtype == np.uint8
    assert envs.unwrapped.metadata["render_fps"] == 20
    assert len({type(one) for one in envs.envs}) == 1
    envs.close()


def test_pictures_are_of_one_size_wherever_nobody_asks_for_another(made):
    from inspect import signature

    from pat3d.envs.config import TabletopConfig
    from pat3d.policies_eval.run.settings import RolloutSettings

    side = RolloutSettings().image_size
    assert TabletopConfig().image_size == signature(make_env).parameters["image_size"].default == (side, side)


@pytest.mark.parametrize("everywhere", [False, True])
def test_check_convicts_an_edited_task_or_instruction(copy, everywhere):
    """Where the record and the manifest's checksum were edited too, the scene itself says what its instruction is."""
    document = json.loads((copy / MANIFEST).read_text())
    scene = document["scenes"][0]
    scene["instruction"] = "throw it all on the floor"
    if everywhere:
        record = copy / "scenes" / "000000" / RECORD
        record.write_text(json.dumps({**json.loads(record.read_text()), "instruction": scene["instruction"]}))
        document["manifest_sha256"] = checksum_of_document(document)
    (copy / MANIFEST).write_text(json.dumps(document))
    found = "\n".join(check_suite(Suite.open(copy), settle=False))
    if everywhere:
        assert '"throw it all on the floor" is not the instruction of' in found
    else:
        assert "suite.json was edited" in found
        assert "scene 0: record.json and suite.json differ in instruction." in found
    document["scenes"][0]["task"] = "pick:moon"
    (copy / MANIFEST).write_text(json.dumps(document))
    assert "suite.json was edited" in "\n".join(check_suite(Suite.open(copy), settle=False))


def test_a_scene_that_mujoco_cannot_compile_is_rejected_and_its_worker_goes_on(tmp_path, monkeypatch):
    """`mujoco.FatalError` is no ValueError: the first file of the run raises it, and another candidate is made."""
    import mujoco

    from pat3d.envs.suites.unit import make_unit

    load, calls = mujoco.MjModel.from_xml_path, []

    class Model(mujoco.MjModel):
        @staticmethod
        def from_xml_path(*given):
            calls.append(given)
            if len(calls) == 1:
                raise mujoco.FatalError("mj_stackAlloc: insufficient memory")
            return load(*given)

    monkeypatch.setattr(mujoco, "MjModel", Model)
    folder = SuiteFolder(tmp_path / "one")
    answers = [make_unit(folder, REQUEST, 0, candidate) for candidate in (0, 1)]
    assert answers[0]["reason"] == "simulation"
    assert "insufficient memory" in json.dumps(json.loads(folder.rejection(0, 0).read_text()))
    assert len(calls) >= 2


@pytest.mark.slow
def test_a_stable_suite_rejects_what_rests_on_its_round_side(tmp_path):
    """A pool ball lies on the table of this candidate, which is verified, and may roll."""
    from pat3d.envs.suites.unit import make_unit

    request = Request(scenes=20, picture=0, stable=True)
    assert Request.from_dict(request.as_dict(), "here") == request
    folder = SuiteFolder(tmp_path / "one")
    answer = make_unit(folder, request, 6, 0)
    assert answer["reason"] == "rolling"
    assert "pool ball" in json.loads(folder.rejection(6, 0).read_text())["message"]
    assert make_unit(folder, replace(request, stable=False), 6, 0)["reason"] == ""


def test_a_suite_s_robot_is_the_one_it_was_made_for(made, monkeypatch):
    from pat3d.envs.config import TabletopConfig

    monkeypatch.setenv("PAT3D_ROBOT", "ur5e")
    assert TabletopConfig(suite=made).arms == Suite.open(made).request.robot == "Panda"
    assert TabletopConfig(suite=made, robot="so101").arms == "so101"
    assert TabletopConfig().arms == "ur5e"


def test_a_suite_tells_its_interface_and_checks_a_policy_against_it(made, copy, capsys):
    folder = copy
    assert main(["suite", "spec", str(folder), "--episodes", "1"]) == 0
    told = json.loads((folder / "spec.json").read_text())
    assert told["robot"] == "Panda"
    assert told["suite"]["checksum"] == Suite.open(made).document["checksum"]
    assert len(told["statistics"]["action"]["std"]) == told["action"]["size"] == 7
    assert main(["suite", "check", str(folder), "--quick"]) == 0
    capsys.readouterr()
    asked = ["suite", "check-policy", str(folder), "--episodes", "1", "--policy"]
    assert main([*asked, "scripted"]) == 0
    assert capsys.readouterr().out.count("as it should be") == 3
    assert main([*asked, f"{__name__}:Flipped"]) == 1
    assert "gripper: flipped; positive closes" in "".join(capsys.readouterr())


class Flipped(ScriptedPolicy):
    """Opens where it should close."""

    def act(self, observation):
        return super().act(observation) * [1, 1, 1, 1, 1, 1, -1]


def test_the_description_and_a_policy_s_conventions_are_documents(copy, capsys):
    written = document_of(capsys, ["suite", "spec", str(copy), "--episodes", "0", "--cameras"], SpecFacts)
    told = json.loads((copy / "spec.json").read_text())
    assert written["scenes"] == len(told["cameras_of_scenes"]) == 4
    assert set(told["cameras_of_scenes"]["3"]) == {"agentview", "frontview", "closeview"}
    # Those of the first scene are the suite's own.
    assert all(told["cameras"][name] == one for name, one in told["cameras_of_scenes"]["0"].items())
    places = [tuple(one["closeview"]["position"]) for one in told["cameras_of_scenes"].values()]
    assert len(set(places)) == 4
    assert Path(written["file"]).is_file()
    asked = ["suite", "check-policy", str(copy), "--policy", "scripted", "--episodes", "1", "--steps", "8"]
    found = document_of(capsys, asked, ConventionFacts)
    assert found["passed"]
    assert found["explained"]["position"] == pytest.approx(1.0)


def test_the_page_shows_every_scene_and_escapes_what_it_is_told(made, capsys):
    assert main(["suite", "show", str(made)]) == 0
    assert "scenes from" in capsys.readouterr().out
    told = document_of(capsys, ["suite", "show", str(made)], SuiteFacts)
    assert told["scenes"] == sum(told["splits"]["train"].values()) + sum(told["splits"]["test"].values()) == 4
    text = (made / "index.html").read_text()
    assert text.count("<figure ") == 4
    assert all((made / f"scenes/{place:06d}/preview.png").is_file() for place in range(4))
    document = Suite.open(made).document
    scenes = [{**document["scenes"][0], "prompt": "<script>"}, *document["scenes"][1:]]
    hostile = page("x", {**document, "scenes": scenes})
    assert hostile.count("<script>") == text.count("<script>") == 1
    assert text.index("<figure") < text.index("<table")
