"""Depth models: the real classes of transformers, of a few random weights; and which model is meant."""

import numpy as np
import pytest

from pat3d.errors import ModelError
from pat3d.vision.depth import TransformersDepth
from pat3d.vision.models import vision_models

PICTURE = np.random.default_rng(0).integers(0, 255, (60, 80, 3), dtype=np.uint8)


@pytest.fixture
def tiny(tmp_path):
    """A folder of a Depth Anything of four layers."""
    transformers = pytest.importorskip("transformers")
    torch = pytest.importorskip("torch")

    def made(kind: str) -> str:
        stages = [f"stage{number}" for number in range(1, 5)]
        backbone = transformers.Dinov2Config(
            hidden_size=16, num_hidden_layers=4, num_attention_heads=2, mlp_ratio=2, image_size=56, patch_size=14,
            out_features=stages, reshape_hidden_states=False,
        )  # fmt: skip
        config = transformers.DepthAnythingConfig(
            backbone_config=backbone, reassemble_hidden_size=16, neck_hidden_sizes=[8] * 4, fusion_hidden_size=8,
            head_hidden_size=8, depth_estimation_type=kind, max_depth=20,
        )  # fmt: skip
        torch.manual_seed(0)
        folder = str(tmp_path / kind)
        model = transformers.DepthAnythingForDepthEstimation(config)
        # Random weights alone are the same everywhere.
        with torch.no_grad():
            for weights in model.parameters():
                weights.copy_(torch.randn_like(weights) * 0.5)
        model.save_pretrained(folder)
        transformers.DPTImageProcessor(size={"height": 56, "width": 56}, ensure_multiple_of=14).save_pretrained(folder)
        return folder

    return made


def test_a_metric_model_measures_every_pixel(tiny):
    model = TransformersDepth(tiny("metric"))
    found = model.measure(PICTURE)
    assert found.depth.shape == (60, 80)
    assert found.depth.dtype == np.float32
    assert np.nanmin(found.depth) > 0.0
    assert np.nanmax(found.depth) < 30.0
    assert np.nanstd(found.depth) > 0.0
    assert np.array_equal(found.depth, model.measure(PICTURE).depth, equal_nan=True)


def test_a_model_that_says_no_metres_is_refused(tiny):
    with pytest.raises(ModelError, match="does not say metres"):
        TransformersDepth(tiny("relative"))


def test_a_folder_without_a_model_is_refused(tmp_path):
    pytest.importorskip("transformers")
    with pytest.raises(ModelError, match="cannot be loaded"):
        TransformersDepth(str(tmp_path))


def test_the_model_is_the_environments_else_the_files(tmp_path):
    assert vision_models({}, tmp_path).depth is None
    (tmp_path / "pat3d.toml").write_text('[model]\nname = "x"\n[vision]\ndepth = "theirs"\n')
    assert vision_models({}, tmp_path).depth == "theirs"
    assert vision_models({"PAT3D_DEPTH_MODEL": "mine"}, tmp_path).depth == "mine"
    (tmp_path / "pat3d.toml").write_text("[vision]\ndeep = 1\n")
    with pytest.raises(ModelError, match=r"\[vision\] may hold depth, detection"):
        vision_models({}, tmp_path)
