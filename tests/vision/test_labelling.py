"""A vision-language model says what masks show: the real client against a server on the loopback."""

import base64
import io
import json

import numpy as np
import pytest
from PIL import Image

from pat3d.cli.main import main
from pat3d.cli.reading import chat
from pat3d.errors import ModelError
from pat3d.plan.llm.chat import Chat
from pat3d.plan.llm.settings import ModelSettings
from pat3d.vision.labelling import ChatLabeller
from tests.loopback import Reply
from tests.plan.llm_server import fault, said, serving

KEY = "sk-very-secret-0123456789"
PICTURE = np.zeros((60, 80, 3), dtype=np.uint8)
MASKS = np.zeros((60, 80), dtype=np.int32)
MASKS[10:30, 10:30], MASKS[10:30, 40:70] = 3, 9
PICTURE[MASKS == 3] = (250, 0, 0)


def described(*objects, least=1):
    usual = {"colours": [], "material": None, "size": 0.1, "posture": "usual", "facing": "unclear"}
    found = [usual | {"number": k} | one for k, one in enumerate(objects, start=1)]
    return {"objects": found, "least_occluded": least}


RIGHT = described(
    {"name": "red mug", "noun": "mug", "colours": ["red", "mauvish"], "material": "ceramic"},
    {"name": "book", "noun": "book", "material": "unobtainium", "size": 0.24, "posture": "leaning", "facing": "left"},
    least=2,
)


@pytest.fixture
def labeller(tmp_path, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")

    def made(server):
        settings = ModelSettings(name="eyes", base_url=server.url, key=KEY, retries=1, timeout=2.0)
        asked = Chat(settings, sleep=lambda seconds: None, cache_dir=tmp_path / "answers")
        return ChatLabeller(asked, ["mug", "book"], materials=["ceramic"], colours=["red"])

    return made


def test_masks_get_the_labels_of_the_cut_outs_that_were_sent(labeller):
    with serving(said(RIGHT)) as server:
        own = labeller(server)
        labels = own.labels(PICTURE, MASKS)
    found = labels.objects
    assert [(one.name, one.noun, one.value, one.size) for one in found] == [
        ("red mug", "mug", 3, 0.1),
        ("book", "book", 9, 0.24),
    ]
    assert (found[0].colours, found[0].material, found[1].material) == (("red",), "ceramic", None)
    assert [(one.posture, one.facing) for one in found] == [("usual", "unclear"), ("leaning", "left")]
    assert labels.least_occluded == "book"
    (request,) = server.requests
    schema = request["response_format"]["json_schema"]["schema"]
    assert schema["properties"]["objects"]["items"]["properties"]["noun"]["enum"] == ["book", "mug"]
    parts = request["messages"][1]["content"]
    assert [part["text"] for part in parts if part["type"] == "text"] == ["Object 1:", "Object 2:"]
    sent = base64.b64decode(parts[2]["image_url"]["url"].partition(",")[2])
    crop = np.array(Image.open(io.BytesIO(sent)))
    assert crop.shape[0] < 40
    assert tuple(crop[crop.shape[0] // 2, crop.shape[1] // 2]) == (250, 0, 0)
    record = own.record()
    assert (record["model"], record["requests"], record["prompt_tokens"]) == ("eyes", 1, 100)
    assert KEY not in json.dumps(record)


@pytest.mark.parametrize(
    ("bad", "says"),
    [
        (described({"name": "mug", "noun": "mug"}), "every object from 1 to 2"),
        (described({"name": "a", "noun": "mug"}, {"name": "a", "noun": "mug"}), "unique"),
        (described({"name": "../x", "noun": "mug"}, {"name": "b", "noun": "mug"}), "no slash"),
        (described({"name": "a", "noun": "mug", "size": 4e3}, {"name": "b", "noun": "mug"}), "a size of 4000 m"),
        (described({"name": "a", "noun": "rm -rf"}, {"name": "b", "noun": "mug"}), "not valid"),
        (described({"name": "a", "noun": "mug"}, {"name": "b", "noun": "mug"}, least=3), "least_occluded is 3"),
        (described({"name": "a", "noun": "mug", "facing": "up"}, {"name": "b", "noun": "mug"}), "not valid"),
        ("[1, 2", "not JSON"),
    ],
)
def test_an_answer_that_cannot_be_goes_back_with_the_reason(labeller, bad, says):
    with serving(said(bad), said(RIGHT)) as server:
        assert [one.name for one in labeller(server).labels(PICTURE, MASKS).objects] == ["red mug", "book"]
    assert says in server.requests[1]["messages"][-1]["content"]


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (fault(500, f"broken, {KEY}"), "status 500"),
        (fault(429, "slow down"), "status 429"),
        (Reply(body=b'{"choices": [', headers={}), "model"),
        (Reply(body=b"{}" * 50, sent=10), "model"),
        (Reply(stalls=True), "no answer in 2 s"),
    ],
)
def test_a_server_that_fails_is_told_of_without_its_key(labeller, reply, says):
    with serving(reply, reply) as server, pytest.raises(ModelError, match=says) as raised:
        labeller(server).labels(PICTURE, MASKS)
    assert KEY not in str(raised.value)


def test_without_labels_and_without_a_model_both_are_named(tmp_path, monkeypatch, capsys):
    for name in ("PAT3D_MODEL", "PAT3D_MODEL_URL", "OPENAI_BASE_URL", "PAT3D_CONFIG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    chat.cache_clear()
    words = ["generate", "--image", "a.png", "--depth", "d.npy", "--masks", "m.png", "--out", str(tmp_path / "scene")]
    assert main(words) == 2
    told = capsys.readouterr().err
    assert "--labels" in told
    assert "PAT3D_MODEL" in told
