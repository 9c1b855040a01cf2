"""Painting pictures: the real client against a server on the loopback that answers as image models do, or worse."""

import base64
import io
import json
from email.parser import BytesParser
from email.policy import HTTP

import numpy as np
import pytest
from PIL import Image

from pat3d.errors import ModelError
from pat3d.plan.llm.settings import ModelSettings
from pat3d.vision.painting import ServedPainter, image_settings
from tests.loopback import Reply, listening
from tests.plan.llm_server import fault

KEY = "sk-very-secret-0123456789"


def png(array):
    stream = io.BytesIO()
    Image.fromarray(array).save(stream, format="PNG")
    return stream.getvalue()


def painted(data, **more):
    one = {"b64_json": base64.b64encode(data).decode()} if data is not None else {}
    return Reply(body=json.dumps({"created": 1, "data": [one | more]}).encode())


BLUE = np.zeros((128, 128, 3), dtype=np.uint8)
BLUE[..., 2] = 200


@pytest.fixture
def served(tmp_path, monkeypatch):
    """Makes a painter whose server gives these replies, and the list of what it was asked."""
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    asked = []

    def answer(method, path, headers, body):
        asked.append((path, headers, body))
        return replies.pop(0)

    replies: list[Reply] = []
    with listening(answer) as url:

        def made(*given, retries=1):
            replies[:] = given
            settings = ModelSettings(name="brush", base_url=f"{url}/v1", key=KEY, retries=retries, timeout=2.0)
            return ServedPainter(settings, sleep=lambda seconds: None, cache_dir=tmp_path / "pictures")

        yield made, asked


def test_a_prompt_becomes_the_pixels_that_the_server_sends_and_is_asked_once(served):
    made, asked = served
    painter = made(painted(png(BLUE)))
    assert np.array_equal(painter.paint("two mugs\non a table"), BLUE)
    path, headers, body = asked[0]
    request = json.loads(body)
    assert path == "/v1/images/generations"
    assert headers["Authorization"] == f"Bearer {KEY}"
    assert (request["model"], request["n"], request["size"]) == ("brush", 1, "1024x1024")
    assert "two mugs on a table" in request["prompt"]
    assert np.array_equal(made().paint("two mugs\non a table"), BLUE)
    assert len(asked) == 1
    record = painter.record()
    assert (record["images"], record["requests"], record["cached"]) == (1, 1, 0)
    assert KEY not in json.dumps(dict(record))


def test_a_model_that_knows_no_links_is_not_asked_for_data(served):
    made, asked = served
    painter = made(fault(400, "Unknown parameter: 'response_format'."), painted(png(BLUE)))
    assert np.array_equal(painter.paint("a mug"), BLUE)
    assert ["response_format" in json.loads(body) for _, _, body in asked] == [True, False]


def test_only_what_is_hidden_is_painted_and_the_mask_is_transparent_there(served):
    made, asked = served
    rng = np.random.default_rng(0)
    picture = rng.integers(0, 255, (90, 120, 3), dtype=np.uint8)
    hidden = np.zeros((90, 120), dtype=bool)
    hidden[30:60, 40:80] = True
    found = made(painted(png(BLUE))).completed(picture, hidden, "red mug")
    assert np.array_equal(found[~hidden], picture[~hidden])
    assert np.abs(found[hidden].astype(int) - (0, 0, 200)).max() <= 1
    path, headers, body = asked[0]
    assert path == "/v1/images/edits"
    message = BytesParser(policy=HTTP).parsebytes(
        b"Content-Type: " + headers["Content-Type"].encode() + b"\r\n\r\n" + body
    )
    parts = {part.get_param("name", header="content-disposition"): part.get_payload(decode=True)
             for part in message.iter_parts()}  # fmt: skip
    assert b"red mug" in parts["prompt"]
    sent = Image.open(io.BytesIO(parts["mask"]))
    assert (sent.size, sent.mode) == ((1024, 1024), "RGBA")
    # The picture is padded to a square of 120, so the hole is at these shares of it.
    alpha = np.array(sent)[..., 3]
    rows, columns = np.nonzero(alpha == 0)
    edges = np.array([columns.min(), columns.max() + 1, rows.min(), rows.max() + 1]) * 120 / 1024
    assert edges == pytest.approx([40, 80, 30, 60], abs=0.2)
    assert Image.open(io.BytesIO(parts["image"])).size == (1024, 1024)


POLYGLOT = b"<html><script>alert(1)</script>" + png(BLUE)


@pytest.mark.parametrize(
    ("replies", "says"),
    [
        ([fault(500, f"broken, {KEY}")], "status 500"),
        ([fault(429, "slow down")], "status 429"),
        ([fault(400, "content policy")], "content policy"),
        ([Reply(stalls=True)], "no answer in 2 s"),
        ([Reply(body=b'{"data": [', headers={})], "image model"),
        ([painted(None, url="http://127.0.0.1:9/x.png")], "a link instead of a picture"),
        ([Reply(body=b'{"created": 1, "data": []}')], "no picture"),
        ([painted(b"GIF89a" + bytes(50))], "no PNG, JPEG or WebP"),
        ([painted(POLYGLOT)], "no PNG, JPEG or WebP"),
        ([painted(png(BLUE)[:-400])], "no PNG, JPEG or WebP"),
        ([painted(png(np.zeros((5000, 5000), dtype=np.uint8)))], "5000 x 5000 pixels"),
        ([Reply(body=b'{"created": 1, "data": [{"b64_json": "@@@"}]}')], "no picture"),
    ],
)
def test_a_server_that_fails_is_told_of_without_its_key_and_nothing_is_kept(served, tmp_path, replies, says):
    with pytest.raises(ModelError, match=says) as raised:
        served[0](*replies, retries=0).paint("a mug")
    assert KEY not in str(raised.value)
    assert not list(tmp_path.rglob("*.png"))


def test_a_busy_server_is_asked_again(served):
    made, asked = served
    assert np.array_equal(made(fault(503, "loading"), painted(png(BLUE))).paint("a mug"), BLUE)
    assert len(asked) == 2


def test_the_model_is_the_environments_else_the_files_and_hosted_keys_stay_at_home(tmp_path):
    assert image_settings({}, tmp_path) is None
    (tmp_path / "pat3d.toml").write_text('[image]\nname = "x"\nbase_url = "http://other.example/v1"\nretries = 2\n')
    found = image_settings({"OPENAI_API_KEY": KEY}, tmp_path)
    assert found is not None
    assert (found.name, found.server, found.retries, found.key) == ("x", "other.example", 2, "")
    found = image_settings({"OPENAI_API_KEY": KEY, "PAT3D_IMAGE_URL": "http://mine.example/v1"}, tmp_path)
    assert found is not None
    assert (found.server, found.key) == ("mine.example", KEY)
    (tmp_path / "pat3d.toml").write_text('[image]\nname = "x"\napi_key = "y"\n')
    with pytest.raises(ModelError, match="PAT3D_IMAGE_KEY"):
        image_settings({}, tmp_path)
    (tmp_path / "pat3d.toml").write_text("[image]\nname = 3\n")
    with pytest.raises(ModelError, match="may hold name, base_url"):
        image_settings({}, tmp_path)
