"""Models of transformers with few random weights, in the files that real ones come in."""

from __future__ import annotations

import json
from pathlib import Path

import pytest


def _saved(model, folder: Path, seed: int = 0) -> None:
    import torch

    torch.manual_seed(seed)
    with torch.no_grad():
        for weights in model.parameters():
            weights.copy_(torch.randn_like(weights) * 0.2)
    model.save_pretrained(folder)


def grounding_dino(folder: Path) -> str:
    """A Grounding DINO that knows the words red, mug, book and a."""
    transformers = pytest.importorskip("transformers")
    backbone = transformers.SwinConfig(
        image_size=64, patch_size=4, embed_dim=8, depths=[1] * 4, num_heads=[1] * 4, window_size=4,
        out_indices=[2, 3, 4],
    )  # fmt: skip
    text = transformers.BertConfig(
        vocab_size=40, hidden_size=16, num_hidden_layers=1, num_attention_heads=2, intermediate_size=16,
        max_position_embeddings=64,
    )  # fmt: skip
    config = transformers.GroundingDinoConfig(
        backbone_config=backbone, text_config=text, num_queries=6, encoder_layers=1, decoder_layers=2, d_model=32,
        encoder_ffn_dim=16, decoder_ffn_dim=16, encoder_attention_heads=2, decoder_attention_heads=2, max_text_len=32,
        encoder_n_points=2, decoder_n_points=2,
    )  # fmt: skip
    _saved(transformers.GroundingDinoForObjectDetection(config), folder)
    words = ["[PAD]", "[UNK]", "[CLS]", "[SEP]", "[MASK]", ".", "red", "mug", "book", "a"]
    (folder / "vocab.txt").write_text("\n".join(words) + "\n")
    tokenizer = transformers.BertTokenizerFast.from_pretrained(folder)
    images = transformers.GroundingDinoImageProcessor(size={"shortest_edge": 64, "longest_edge": 96})
    transformers.GroundingDinoProcessor(images, tokenizer).save_pretrained(folder)
    return str(folder)


_PROMPTS = {"hidden_size": 16, "image_size": 64, "patch_size": 16, "mask_input_channels": 4}
_DECODER = {"hidden_size": 16, "mlp_dim": 16, "num_hidden_layers": 1, "num_attention_heads": 2,
            "iou_head_hidden_dim": 16}  # fmt: skip


def sam(folder: Path) -> str:
    """A first SAM."""
    transformers = pytest.importorskip("transformers")
    seen = transformers.SamVisionConfig(
        hidden_size=16, output_channels=16, num_hidden_layers=1, num_attention_heads=2, image_size=64, patch_size=16,
        window_size=2, global_attn_indexes=[0], num_pos_feats=8, mlp_dim=16,
    )  # fmt: skip
    config = transformers.SamConfig(vision_config=seen, prompt_encoder_config=_PROMPTS, mask_decoder_config=_DECODER)
    _saved(transformers.SamModel(config), folder)
    images = transformers.SamImageProcessor(
        size={"longest_edge": 64}, pad_size={"height": 64, "width": 64}, mask_size={"longest_edge": 16},
        mask_pad_size={"height": 16, "width": 16},
    )  # fmt: skip
    transformers.SamProcessor(images).save_pretrained(folder)
    return str(folder)


def sam2(folder: Path) -> str:
    """A SAM 2."""
    transformers = pytest.importorskip("transformers")
    needs_torchvision()
    backbone = transformers.Sam2HieraDetConfig(
        hidden_size=8, num_attention_heads=1, image_size=[64, 64], blocks_per_stage=[1, 1, 1, 2],
        embed_dim_per_stage=[8, 16, 32, 64], num_attention_heads_per_stage=[1, 1, 2, 2],
        window_size_per_stage=[4] * 4, window_positional_embedding_background_size=[4, 4], global_attention_blocks=[4],
    )  # fmt: skip
    seen = transformers.Sam2VisionConfig(
        backbone_config=backbone, backbone_channel_list=[64, 32, 16, 8],
        backbone_feature_sizes=[[16, 16], [8, 8], [4, 4]], fpn_hidden_size=16,
    )  # fmt: skip
    config = transformers.Sam2Config(vision_config=seen, prompt_encoder_config=_PROMPTS, mask_decoder_config=_DECODER)
    _saved(transformers.Sam2Model(config), folder)
    images = transformers.Sam2ImageProcessor(
        size={"height": 64, "width": 64}, mask_size={"height": 16, "width": 16}
    )  # fmt: skip
    transformers.Sam2Processor(images).save_pretrained(folder)
    return str(folder)


def sam3(folder: Path, seed: int = 0) -> str:
    """A SAM 3 that knows the letters a and b."""
    transformers = pytest.importorskip("transformers")
    needs_torchvision()
    small = {"hidden_size": 16, "num_attention_heads": 2}
    layers = {**small, "num_layers": 1, "intermediate_size": 16}
    backbone = {
        **small, "model_type": "sam3_vit_model", "intermediate_size": 16, "num_hidden_layers": 1, "image_size": 56,
        "pretrain_image_size": 56, "window_size": 2, "global_attn_indexes": [0],
    }  # fmt: skip
    text = {
        **small, "model_type": "clip_text_model", "intermediate_size": 16, "num_hidden_layers": 1, "vocab_size": 8,
        "max_position_embeddings": 32, "projection_dim": 16, "eos_token_id": 1, "bos_token_id": 0, "pad_token_id": 1,
    }  # fmt: skip
    config = transformers.Sam3Config(
        vision_config={
            "model_type": "sam3_vision_model", "backbone_config": backbone, "fpn_hidden_size": 16,
            "backbone_feature_sizes": [[16, 16], [8, 8], [4, 4]],
        },
        text_config=text, geometry_encoder_config=layers, detr_encoder_config=layers,
        detr_decoder_config={**layers, "num_queries": 5}, mask_decoder_config=small,
    )  # fmt: skip
    _saved(transformers.Sam3Model(config), folder, seed)
    vocabulary = {"<|startoftext|>": 0, "<|endoftext|>": 1, "a</w>": 2, "b</w>": 3, "a": 4, "b": 5}
    (folder / "vocab.json").write_text(json.dumps(vocabulary))
    (folder / "merges.txt").write_text("#version: 0.2\n")
    (folder / "tokenizer_config.json").write_text(
        json.dumps({"tokenizer_class": "CLIPTokenizer", "model_max_length": 16})
    )
    images = transformers.Sam3ImageProcessor(size={"height": 56, "width": 56})
    transformers.Sam3Processor(images, transformers.AutoTokenizer.from_pretrained(folder)).save_pretrained(folder)
    return str(folder)


def needs_torchvision() -> None:
    """Skip where torchvision is not installed, or not for this torch."""
    pytest.importorskip("torchvision", exc_type=(ImportError, RuntimeError))  # type: ignore[arg-type]
