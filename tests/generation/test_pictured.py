"""`pat3d generate --image`: from files of a photograph to a verified scene, and what is refused on the way."""

import json

import numpy as np
import pytest
from PIL import Image

from pat3d.cli.main import main
from pat3d.cli.photographs import labeller_of
from pat3d.cli.reading import chat
from pat3d.errors import ModelError
from pat3d.generation.pictured import generate_from_image
from pat3d.plan.llm.chat import Chat
from pat3d.plan.llm.settings import ModelSettings
from pat3d.scene.io import load_scene
from pat3d.vision.listing import ChatLister
from pat3d.vision.looking import Lookers, Photograph
from tests.generation.pictured import CAMERA, THINGS, Truth, painted_and_labelled
from tests.plan.llm_server import fault, said, serving
from tests.vision.seen import HEIGHT, WIDTH, see


@pytest.fixture
def photographed(tmp_path):
    """Files of a photograph: words of a command line, without --out."""
    seen = see(THINGS, CAMERA)
    Image.fromarray(np.full((HEIGHT, WIDTH, 3), 120, dtype=np.uint8)).save(tmp_path / "photo.jpg")
    np.save(tmp_path / "depth.npy", seen.depth)
    Image.fromarray(seen.instances.astype(np.uint8)).save(tmp_path / "masks.png")
    labels = {"objects": [{"name": "box", "noun": "storage box"}, {"name": "mug", "noun": "chipped blue mug"}]}
    (tmp_path / "labels.json").write_text(json.dumps(labels))
    own = CAMERA.pinhole
    camera = {key: getattr(own, key) for key in ("width", "height", "fx", "fy", "cx", "cy")}
    (tmp_path / "camera.json").write_text(json.dumps(camera))
    named = {"image": "photo.jpg", "depth": "depth.npy", "masks": "masks.png"}
    named |= {"labels": "labels.json", "camera": "camera.json"}
    return {f"--{key}": str(tmp_path / name) for key, name in named.items()}


def words(files):
    return [word for pair in files.items() for word in pair]


@pytest.mark.slow
def test_a_photograph_becomes_a_verified_scene_and_the_same_one_again(photographed, tmp_path, capsys):
    out = tmp_path / "scene"
    assert main(["generate", "a desk", *words(photographed), "--out", str(out), "--resume"]) == 0
    scene = load_scene(out)
    assert scene.prompt == "a desk"
    assert [obj.name for obj in scene.objects] == ["box", "mug"]
    apart = np.subtract(scene["mug"].pose.position, scene["box"].pose.position)
    true = np.subtract(*(THINGS[name][1].position for name in ("mug", "box")))
    assert np.linalg.norm(apart[:2]) == pytest.approx(np.linalg.norm(true[:2]), abs=0.01)
    report = json.loads((out / "report.json").read_text())
    assert report["passed"]
    assert set(report["understood"]["picture"]) == {"picture", "depth", "masks", "labels", "camera"}
    assert all(0.97 < one["scale"] < 1.03 for one in report["understood"]["fits"].values())
    with Image.open(out / "picture.png") as row:
        assert row.width > 5 * WIDTH
    assert main(["generate", "a desk", *words(photographed), "--out", str(out), "--resume"]) == 0
    again = json.loads((out / "report.json").read_text())
    assert again["reused"] == ["layout 1", "settling 1"]


def test_what_a_photograph_needs_is_said(photographed, tmp_path, capsys):
    assert main(["generate", *words(photographed), "--out", str(tmp_path / "scene"), "--paint"]) == 2
    assert "--image FILE, or --paint" in capsys.readouterr().err
    del photographed["--image"]
    assert main(["generate", *words(photographed), "--out", str(tmp_path / "scene")]) == 2
    assert "--image FILE, or --paint" in capsys.readouterr().err
    assert main(["generate", "--paint", "--out", str(tmp_path / "scene")]) == 2
    assert "--paint needs a PROMPT" in capsys.readouterr().err


def test_relative_depth_is_a_file_s(photographed, tmp_path, capsys):
    del photographed["--depth"]
    assert main(["generate", *words(photographed), "--relative-depth", "--out", str(tmp_path / "scene")]) == 2
    assert "give it as --depth FILE" in capsys.readouterr().err


def test_every_model_that_is_missing_is_named_at_once(tmp_path, monkeypatch, capsys):
    for name in ("PAT3D_DEPTH_MODEL", "PAT3D_SEGMENTATION_MODEL", "PAT3D_IMAGE_MODEL", "PAT3D_MODEL", "PAT3D_CONFIG"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    chat.cache_clear()
    assert main(["generate", "a mug on a table", "--paint", "--out", str(tmp_path / "scene")]) == 2
    told = capsys.readouterr().err
    for name in ("PAT3D_IMAGE_MODEL", "PAT3D_SEGMENTATION_MODEL", "PAT3D_DEPTH_MODEL", "PAT3D_MODEL"):
        assert name in told


@pytest.mark.slow
def test_a_prompt_becomes_a_photograph_and_this_a_scene_and_what_models_said_is_not_asked_twice(tmp_path, monkeypatch):
    """Real clients of a painter and a vision-language model on the loopback; detector and depth are the truth."""
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    with painted_and_labelled() as (lookers, server):
        reports = []
        for _ in range(2):
            generate_from_image(Photograph(), out=tmp_path / "scene", prompt="a mug and a box", lookers=lookers)
            reports.append(json.loads((tmp_path / "scene" / "report.json").read_text())["understood"])
            assert len(server.requests) == 3
            assert lookers.finder().asked == 3
    assert [obj.name for obj in load_scene(tmp_path / "scene").objects] == ["box", "mug"]
    assert np.array(Image.open(tmp_path / "scene" / "photograph.png")).shape == (HEIGHT, WIDTH, 3)
    first, second = reports
    assert first["painted_by"]["images"] == 1
    assert first["found_by"]["model"] == first["measured_by"]["model"] == "truth"
    assert first["labelled_by"]["prompt_tokens"] == 200
    assert first["least_occluded"] == "box"
    assert '1 of 2 "mug" found by truth' in first["notes"]
    assert second["found_by"]["kept"]
    assert second["measured_by"]["kept"]
    assert second["painted_by"]["cached"] == 1
    assert all(0.97 < one["scale"] < 1.03 for one in second["fits"].values())
    assert "secret" not in json.dumps(reports)


def test_a_run_that_a_server_broke_leaves_nothing_and_goes_on_from_the_last_stage_that_was_done(tmp_path, monkeypatch):
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    Image.fromarray(np.full((HEIGHT, WIDTH, 3), 120, dtype=np.uint8)).save(tmp_path / "photo.png")
    truth = Truth(see(THINGS, CAMERA))
    kinds = {"kinds": [{"phrase": "box", "count": 1}, {"phrase": "mug", "count": 1}]}
    cut = said({"objects": []})
    cut.sent = 40
    runs = [
        ([fault(500, "broken, very-secret")], "status 500", 0),
        ([said(kinds), cut], "model", 3),
        ([fault(429, "slow down")], "status 429", 3),
        ([said("{"), said({"objects": [], "least_occluded": 1}), said("[]")], "no valid answer in 3", 3),
    ]
    for replies, says, asked in runs:
        with serving(*replies) as server:
            asks = Chat(ModelSettings(name="eyes", base_url=server.url, key="very-secret", retries=0))
            lookers = Lookers(
                lister=lambda asks=asks: ChatLister(asks),
                finder=lambda: truth,
                labeller=lambda asks=asks: labeller_of(asks),
                depth=lambda: truth,
            )
            with pytest.raises(ModelError, match=says) as raised:
                generate_from_image(Photograph(picture=tmp_path / "photo.png"), out=tmp_path / "scene", lookers=lookers)
            assert not server.replies
        assert truth.asked == asked
        assert "very-secret" not in str(raised.value)
        assert {one.name for one in tmp_path.iterdir()} <= {"cache", "photo.png"}
    assert not any(b"very-secret" in one.read_bytes() for one in tmp_path.rglob("*") if one.is_file())


def test_without_depth_and_without_a_model_both_are_named(photographed, tmp_path, monkeypatch, capsys):
    monkeypatch.delenv("PAT3D_DEPTH_MODEL", raising=False)
    monkeypatch.delenv("PAT3D_CONFIG", raising=False)
    monkeypatch.chdir(tmp_path)
    del photographed["--depth"]
    assert main(["generate", *words(photographed), "--out", str(tmp_path / "scene")]) == 2
    told = capsys.readouterr().err
    assert "--depth is missing" in told
    assert "PAT3D_DEPTH_MODEL" in told


def test_a_label_that_nothing_is_known_for_is_said_and_nothing_written(photographed, tmp_path, capsys):
    labels = {"objects": [{"name": "box", "noun": "storage box"}, {"name": "it", "noun": "flux capacitor"}]}
    (tmp_path / "labels.json").write_text(json.dumps(labels))
    before = sorted(tmp_path.iterdir())
    assert main(["generate", *words(photographed), "--out", str(tmp_path / "scene")]) == 2
    assert 'nothing is known for "it"' in capsys.readouterr().err
    assert sorted(tmp_path.iterdir()) == before


def test_a_mask_of_few_pixels_or_without_depth_is_said(photographed, tmp_path, capsys):
    masks = np.array(Image.open(tmp_path / "masks.png"))
    few = masks.copy()
    few[few == 2] = 0
    few[:5, :5] = 2
    Image.fromarray(few).save(tmp_path / "masks.png")
    assert main(["generate", *words(photographed), "--out", str(tmp_path / "scene")]) == 2
    assert 'the mask of "mug" has 25 pixels; at least 40' in capsys.readouterr().err
    Image.fromarray(masks).save(tmp_path / "masks.png")
    depth = np.load(tmp_path / "depth.npy")
    depth[masks == 1] = np.nan
    np.save(tmp_path / "depth.npy", depth)
    assert main(["generate", *words(photographed), "--out", str(tmp_path / "scene")]) == 2
    assert '0% of the pixels of "box" have a depth' in capsys.readouterr().err
    assert not (tmp_path / "scene").exists()
