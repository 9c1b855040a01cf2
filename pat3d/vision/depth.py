"""Metric depth of a picture: a role, and the adapter for the models of Hugging Face's transformers.

Depth Pro, ZoeDepth and the metric variants of Depth Anything say metres. Models that say which of two things is nearer,
and no more, are refused: from such depth neither gravity nor a size follows.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ModelError

VARIABLE = "PAT3D_DEPTH_MODEL"
FILE = "pat3d.toml"
"""In the current folder, unless PAT3D_CONFIG names another file; its table `vision` may hold `depth`."""
MAX_FILE_BYTES = 2**20
INSTALL = "pip install 'pat3d[vision]'"
EXAMPLE = "depth-anything/Depth-Anything-V2-Metric-Indoor-Small-hf"
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
        try:
            from transformers import (  # pyright: ignore[reportMissingImports]
                AutoImageProcessor,
                AutoModelForDepthEstimation,
            )
        except ImportError as error:
            raise ModelError(f"depth from a picture needs transformers and torch: {INSTALL}.") from error
        self.name, self._device = name, device
        try:
            self._processor: Any = AutoImageProcessor.from_pretrained(name)
            self._model: Any = AutoModelForDepthEstimation.from_pretrained(name, use_safetensors=True).to(device).eval()
        except (OSError, ValueError, RuntimeError, ImportError) as error:
            line = " ".join(str(error).split())[:300]
            raise ModelError(f'depth model "{name}" cannot be loaded: {line}') from error
        config = self._model.config
        metric = config.model_type in _METRIC or getattr(config, "depth_estimation_type", "") == "metric"
        if not metric:
            raise ModelError(
                f'depth model "{name}" does not say metres, from which sizes could follow; one that does is {EXAMPLE}.'
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


def can_load() -> bool:
    """Whether what loads depth models is installed."""
    return find_spec("transformers") is not None and find_spec("torch") is not None


def depth_model_named(environment: Mapping[str, str] | None = None, folder: Path | None = None) -> str | None:
    """The depth model that `environment` (the process's own) or the file in `folder` (the current one) names.

    Raises:
        ModelError: the file is not valid.
    """
    given = os.environ if environment is None else environment
    if given.get(VARIABLE):
        return given[VARIABLE]
    path = Path(given["PAT3D_CONFIG"]) if given.get("PAT3D_CONFIG") else (folder or Path()) / FILE
    try:
        if not path.is_file():
            return None
        if path.stat().st_size > MAX_FILE_BYTES:
            raise ModelError(f"{path} is larger than {MAX_FILE_BYTES} bytes.")
        table = tomllib.loads(path.read_text(encoding="utf-8")).get("vision", {})
    except (OSError, ValueError) as error:
        raise ModelError(f"{path}: cannot be read: {error}") from error
    if not isinstance(table, dict) or set(table) - {"depth"} or not isinstance(table.get("depth", ""), str):
        raise ModelError(f'{path}: [vision] may hold depth = "NAME", the name or the folder of a depth model, alone.')
    return table.get("depth") or None
