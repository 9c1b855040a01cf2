"""From a sentence in another language to a folder, by a model that plans, looks, and plans once more."""

import json

import pytest

from pat3d.cli import reading
from pat3d.cli.main import main
from tests.plan.llm_server import Server, fault, said, serving
from tests.plan.test_llm import KEY, obj, plan

PROMPT = "dos bloques, uno rojo"
HOSTILE = "../../etc/<b>passwd"
FIRST = plan(obj(HOSTILE, "block", colours=["blue"]))
SECOND = plan(obj(HOSTILE, "block", colours=["red"]), obj("other block", "block"))
QUESTIONS = {"questions": [{"text": "Is a block red?", "about": "colour"}]}
YES, NO = ({"answers": [{"number": 1, "answer": word, "seen": "a block"}]} for word in ("yes", "no"))


@pytest.fixture
def environment(monkeypatch, tmp_path):
    """Settings for a server; answers are kept in a folder of the test's own."""
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.chdir(tmp_path)

    def use(server: Server) -> None:
        reading.chat.cache_clear()
        monkeypatch.setenv("PAT3D_MODEL_URL", server.url)
        monkeypatch.setenv("PAT3D_MODEL", "test")
        monkeypatch.setenv("PAT3D_MODEL_KEY", KEY)
        monkeypatch.setattr("pat3d.plan.llm.chat.cache_root", lambda: tmp_path / "cache")

    yield use
    reading.chat.cache_clear()


def generated(tmp_path, *more: str) -> dict:
    words = ["generate", PROMPT, "--planner", "llm", "--out", str(tmp_path / "scenes" / "blocks"), *more]
    assert main(words) == 0
    return json.loads((tmp_path / "scenes" / "blocks" / "report.json").read_text())


@pytest.mark.slow
def test_what_the_critic_denies_is_planned_once_more_and_the_better_scene_is_kept(environment, tmp_path, capsys):
    with serving(*map(said, (FIRST, QUESTIONS, NO, SECOND, YES))) as server:
        environment(server)
        report = generated(tmp_path, "--critic")
    assert len(server.requests) == 5
    assert "Is a block red? No: a block" in json.dumps(server.requests[3]["messages"])
    parts = server.requests[2]["messages"][1]["content"]
    pictures = [part["image_url"]["url"] for part in parts if part["type"] == "image_url"]
    assert len(pictures) == 4
    assert all(url.startswith("data:image/png;base64,iVBORw0KGgo") for url in pictures)
    assert [one["name"] for one in report["objects"]] == [HOSTILE, "other block"]
    critic = report["critic"]
    assert [one["answers"][0]["answer"] for one in critic["rounds"]] == ["no", "yes"]
    assert [one["kept"] for one in critic["rounds"]] == [False, True]
    assert (critic["prompt_tokens"], critic["completion_tokens"]) == (500, 100)
    assert report["understood"]["planner"]["model"] == "test"
    assert report["passed"]
    # A label is a label: nothing is written but below the scene's folder, and no key anywhere.
    assert [path.name for path in (tmp_path / "scenes").iterdir()] == ["blocks"]
    assert {path.name for path in tmp_path.iterdir()} == {"scenes", "cache"}
    texts = [path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()]
    assert not any(KEY.encode() in text for text in texts)
    said_words = capsys.readouterr()
    assert "critic" in said_words.out
    assert main(["check", str(tmp_path / "scenes" / "blocks")]) == 0


@pytest.mark.slow
def test_a_revision_that_is_no_better_or_cannot_be_made_leaves_the_first_scene(environment, tmp_path):
    with serving(*map(said, (FIRST, QUESTIONS, NO)), fault(400, "no credit left")) as server:
        environment(server)
        report = generated(tmp_path, "--critic")
    assert [one["name"] for one in report["objects"]] == [HOSTILE]
    assert "no credit left" in report["critic"]["rounds"][1]["error"]
    assert report["critic"]["rounds"][0]["kept"]


def test_a_model_that_is_not_set_up_is_an_error_that_says_what_to_set(monkeypatch, tmp_path, capsys):
    reading.chat.cache_clear()
    monkeypatch.chdir(tmp_path)
    for name in ("PAT3D_MODEL", "PAT3D_CONFIG"):
        monkeypatch.delenv(name, raising=False)
    assert main(["plan", "--planner", "llm", "una taza"]) == 2
    assert "PAT3D_MODEL" in capsys.readouterr().err
    assert main(["generate", "a mug", "--critic", "--out", "mug"]) == 2
    assert not (tmp_path / "mug").exists()
