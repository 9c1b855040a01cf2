"""The measures that networks give: where the views are from, CLIP by its definition, the others by a server."""

from __future__ import annotations

import io
import json
import math

import numpy as np
import pytest
from PIL import Image

from pat3d.assets.shapes import box
from pat3d.check.metrics.appearance import AZIMUTHS, DEPRESSIONS, appearance, views
from pat3d.check.metrics.clip import clip_judge
from pat3d.check.metrics.judged import plausibility_judge, vqa_judge
from pat3d.check.metrics.subject import subject_of
from pat3d.cli.main import main
from pat3d.errors import CheckError
from pat3d.plan.llm.chat import Chat
from pat3d.plan.llm.critic import Picture
from pat3d.plan.llm.settings import ModelSettings
from pat3d.scene.io import save_scene
from tests.loopback import Reply
from tests.plan.llm_server import said, serving
from tests.scenes import asset_of, placed, scene_of

CUBE = asset_of(box(0.1, 0.1, 0.1))
TOWER = asset_of(box(0.1, 0.1, 0.4))
SCENE = scene_of(placed("cube", CUBE, (-0.3, 0, 1e-5)), placed("tower", TOWER, (0.3, 0, 1e-5)), prompt="two blocks")


@pytest.fixture(autouse=True)
def plain_environment(monkeypatch):
    monkeypatch.setattr("pat3d.check.metrics.appearance.SIDE", 24)
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY", "PAT3D_MODEL", "PAT3D_CONFIG"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")


def pixels(picture: Picture) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture.png)).convert("RGB"), dtype=float)


def test_eighteen_views_go_round_the_scene_at_three_heights():
    pictures = views(subject_of(SCENE), side=64)
    assert len({picture.caption for picture in pictures}) == len(pictures) == len(DEPRESSIONS) * len(AZIMUTHS) == 18
    # The blocks are saturated, ground and sky grey: the tower is right from the front, left from behind, and from
    # level with it, its top is seen from above alone.
    front, behind = pixels(pictures[0]), pixels(pictures[3])
    coloured = [np.ptp(one, axis=2) > 25 for one in (front, behind)]
    tall = [one[: int(0.4 * 64)].any(axis=0) for one in coloured]
    assert tall[0][40:].any()
    assert not tall[0][:24].any()
    assert tall[1][:24].any()
    assert not tall[1][40:].any()


def yes(*chances: tuple[str, float]) -> Reply:
    """A completion whose first word has these probabilities."""
    body = json.loads(said("Yes").body)
    top = [{"token": token, "logprob": math.log(chance), "bytes": None} for token, chance in chances]
    body["choices"][0]["logprobs"] = {"content": [{**top[0], "top_logprobs": top}], "refusal": None}
    return Reply(body=json.dumps(body).encode())


def chat(server, tmp_path) -> Chat:
    settings = ModelSettings(name="tiny", vision="seer", base_url=server.url, key="secret", retries=1)
    return Chat(settings, sleep=lambda _: None, cache_dir=tmp_path / "answers")


def test_the_vqa_score_is_the_mean_probability_of_yes_over_the_views(tmp_path):
    """Whatever its capitals and blanks: 0.5 + 0.25 at nine views, 0.1 at nine."""
    likely, unlikely = yes(("Yes", 0.5), (" yes", 0.25), ("No", 0.2)), yes(("no", 0.9), ("YES", 0.1))
    with serving(*[likely, unlikely] * 9) as server:
        found = appearance(subject_of(SCENE), vqa=lambda: vqa_judge(chat(server, tmp_path)))
        assert found.vqa is not None
        assert found.vqa.value == pytest.approx((0.75 + 0.1) / 2)
        assert len(server.requests) == 18
        assert {one["model"] for one in server.requests} == {"seer"}
        assert all(one["logprobs"] and one["max_completion_tokens"] == 1 for one in server.requests)
        assert all('"two blocks"' in one["messages"][0]["content"][-1]["text"] for one in server.requests)
        # Asked again, the answers are known.
        again = appearance(subject_of(SCENE), vqa=lambda: vqa_judge(chat(server, tmp_path)))
        assert again == found


def test_a_server_without_probabilities_gives_no_vqa_score(tmp_path):
    with serving(said("Yes")) as server:
        found = appearance(subject_of(SCENE), vqa=lambda: vqa_judge(chat(server, tmp_path)))
    assert found.vqa is not None
    assert found.vqa.value is None
    assert "logprobs" in found.vqa.absent


def test_plausibility_is_asked_once_with_all_views_and_a_score_out_of_range_goes_back(tmp_path):
    with serving(said({"score": 870, "reason": "fine"}), said({"score": 87, "reason": "fine"})) as server:
        found = appearance(subject_of(SCENE), plausibility=lambda: plausibility_judge(chat(server, tmp_path)))
        assert found.plausibility is not None
        assert found.plausibility.value == 87.0
        kinds = [part["type"] for part in server.requests[0]["messages"][1]["content"]]
        assert kinds.count("image_url") == 18
        assert "0 to 100" in server.requests[1]["messages"][-1]["content"]


def test_the_clip_score_is_the_cosine_that_the_model_s_own_functions_give(tmp_path):
    transformers, torch = pytest.importorskip("transformers"), pytest.importorskip("torch")
    folder = tiny_clip(transformers, torch, tmp_path / "clip")
    rng = np.random.default_rng(0)
    pictures = []
    for _ in range(3):
        file = io.BytesIO()
        Image.fromarray(rng.integers(0, 255, (40, 40, 3), dtype=np.uint8)).save(file, format="PNG")
        pictures.append(Picture(caption="", png=file.getvalue()))
    prompt = "a b " * 40
    by, score = clip_judge(str(folder))
    assert by == str(folder)
    model = transformers.CLIPModel.from_pretrained(folder).eval()
    words = transformers.AutoTokenizer.from_pretrained(folder)(
        [prompt], return_tensors="pt", truncation=True, max_length=16
    )
    shown = transformers.CLIPImageProcessor.from_pretrained(folder)(
        images=[Image.open(io.BytesIO(one.png)) for one in pictures], return_tensors="pt"
    )
    with torch.no_grad():
        # What the model itself makes of them: cosines times exp(logit_scale).
        logits = model(**words, **shown).logits_per_image[:, 0] / model.logit_scale.exp()
    expected = 100.0 * logits.clamp(min=0).mean().item()
    assert score(prompt, pictures) == pytest.approx(expected, abs=1e-4)


def tiny_clip(transformers, torch, folder):
    """A CLIP of random weights, in the files that real ones come in."""
    torch.manual_seed(0)
    text = {"hidden_size": 16, "intermediate_size": 16, "num_hidden_layers": 1, "num_attention_heads": 2,
            "vocab_size": 8, "max_position_embeddings": 16, "eos_token_id": 1, "bos_token_id": 0}  # fmt: skip
    vision = {"hidden_size": 16, "intermediate_size": 16, "num_hidden_layers": 1, "num_attention_heads": 2,
              "image_size": 32, "patch_size": 16}  # fmt: skip
    config = transformers.CLIPConfig(text_config=text, vision_config=vision, projection_dim=8)
    transformers.CLIPModel(config).save_pretrained(folder)
    transformers.CLIPImageProcessor(size={"shortest_edge": 32}, crop_size={"height": 32, "width": 32}).save_pretrained(
        folder
    )
    vocabulary = {"<|startoftext|>": 0, "<|endoftext|>": 1, "a</w>": 2, "b</w>": 3, "a": 4, "b": 5}
    (folder / "vocab.json").write_text(json.dumps(vocabulary))
    (folder / "merges.txt").write_text("#version: 0.2\n")
    (folder / "tokenizer_config.json").write_text(json.dumps({"tokenizer_class": "CLIPTokenizer"}))
    return folder


def test_a_model_that_is_not_there_is_absent_and_not_a_number(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    save_scene(SCENE, tmp_path / "blocks")
    assert main(["metrics", "blocks", "--clip", str(tmp_path / "no"), "--vqa", "--plausibility", "--json"]) == 0
    row = json.loads(capsys.readouterr().out)["scenes"][0]["appearance"]
    assert [row[name]["value"] for name in ("clip", "vqa", "plausibility")] == [None] * 3
    assert "no language model is named" in row["vqa"]["absent"]
    assert row["clip"]["absent"]
    pytest.importorskip("transformers")
    with pytest.raises(CheckError, match="no CLIP model at"):
        clip_judge(str(tmp_path / "no"))


def test_without_a_prompt_there_is_nothing_to_compare_with():
    silent = scene_of(placed("cube", CUBE, (0, 0, 1e-5)))
    found = appearance(subject_of(silent), clip=lambda: ("never", lambda *_: 1.0))
    assert found.clip is not None
    assert found.clip.value is None
    assert "--prompt" in found.clip.absent
