"""Metric depth of a picture: a role, and the adapter for the models of Hugging Face's transformers.

Depth Pro, ZoeDepth and the metric variants of Depth Anything say metres. Models that say which of two things is nearer,
and no more, are refused: from such depth neither gravity nor a size follows.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ModelError
from pat3d.vision.models import EXAMPLES, loaded

_METRIC = frozenset({"depth_pro", "zoedepth"})


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredDepth:
    """What a model makes of a picture."""

    depth: NDArray[np.float32]
    """Along the optical axis [m], NaN where it is not known, shape (height, width)."""
    angle: float | None = None
    """Opening angle across the longer side [deg], where the model says one."""


class DepthModel(Protocol):
    """Says how far away the things in a picture are."""

    @property
    def name(self) -> str:
        """As reports name it."""
        ...

    def measure(self, picture: NDArray[np.uint8]) -> MeasuredDepth:
        """Depth of every pixel of an RGB picture, shape (height, width, 3)."""
        ...


class TransformersDepth:
    """A depth model of transformers, by its name on the hub or its folder; its weights are safetensors only."""

    def __init__(self, name: str, *, device: str = "cpu") -> None:
        """Load the model.

        Raises:
            ModelError: it cannot be loaded, or does not say metres.
        """
        self.name, self._device = name, device
        self._processor, self._model = loaded(
            "depth", name, device, lambda one: one.AutoModelForDepthEstimation, lambda one: one.AutoImageProcessor
        )
        config = self._model.config
        metric = config.model_type in _METRIC or getattr(config, "depth_estimation_type", "") == "metric"
        if not metric:
            raise ModelError(
                f'depth model "{name}" does not say metres, from which sizes could follow; one that does is '
                f"{EXAMPLES['depth']}."
            )

    def measure(self, picture: NDArray[np.uint8]) -> MeasuredDepth:
        """See `DepthModel`.

        Raises:
            ModelError: the model gives no depth.
        """
        import torch

        height, width = picture.shape[:2]
        with torch.inference_mode():
            inputs = self._processor(images=picture, return_tensors="pt").to(self._device)
            found = self._processor.post_process_depth_estimation(
                self._model(**inputs), target_sizes=[(height, width)]
            )[0]
        depth = found["predicted_depth"].float().cpu().numpy().astype(np.float32)
        if depth.shape != (height, width):
            raise ModelError(f'depth model "{self.name}" gives {depth.shape} numbers for {(height, width)} pixels.')
        depth = np.where(np.isfinite(depth) & (depth > 0.0), depth, np.nan).astype(np.float32)
        if np.isnan(depth).all():
            raise ModelError(f'depth model "{self.name}" gives no depth for any pixel.')
        across = found.get("field_of_view")
        if across is None:
            return MeasuredDepth(depth=depth)
        # Depth Pro tells the angle across the width.
        half = np.tan(np.radians(float(across)) / 2.0) * max(width, height) / width
        return MeasuredDepth(depth=depth, angle=float(np.degrees(2.0 * np.arctan(half))))
