"""CLIP score (Hessel et al. 2021): how near a picture and its caption are in the space of a CLIP model."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

from pat3d.check.metrics.appearance import Judge
from pat3d.errors import CheckError
from pat3d.plan.llm.critic import Picture


def clip_judge(model: str) -> tuple[str, Judge]:
    """The model of a folder, or of a name that transformers fetches or has fetched.

    Raises:
        CheckError: transformers is not installed, or the weights are not there.
    """
    try:
        import transformers  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise CheckError("needs transformers: pip install 'pat3d[vision]'") from None
    try:
        loaded: Any = transformers.CLIPModel.from_pretrained(model)
        tokenizer: Any = transformers.AutoTokenizer.from_pretrained(model)
        processor: Any = transformers.CLIPImageProcessor.from_pretrained(model)
    except (OSError, ValueError) as error:
        first = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
        raise CheckError(f'no CLIP model at "{model}": {first}') from error
    loaded.eval()
    return model, lambda prompt, pictures: clip_score(loaded, tokenizer, processor, prompt, pictures)


def clip_score(model: Any, tokenizer: Any, processor: Any, prompt: str, pictures: Sequence[Picture]) -> float:
    """100 max(cos, 0) between the embeddings of prompt and picture, mean of all pictures.

    The prompt is cut where the model takes no more words.
    """
    import torch
    from PIL import Image

    images = [Image.open(io.BytesIO(picture.png)).convert("RGB") for picture in pictures]
    longest = model.config.text_config.max_position_embeddings
    words = tokenizer([prompt], return_tensors="pt", truncation=True, max_length=longest)
    with torch.no_grad():
        pixels = processor(images=images, return_tensors="pt")["pixel_values"]
        text = torch.nn.functional.normalize(model(**words, pixel_values=pixels[:1]).text_embeds, dim=-1)
        seen = torch.cat(
            [
                torch.nn.functional.normalize(model(**words, pixel_values=one[None]).image_embeds, dim=-1)
                for one in pixels
            ]
        )
    return float(100.0 * (seen @ text.T).clamp(min=0.0).mean())
