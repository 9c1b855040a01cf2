"""Which models look at photographs, by the environment or the table `vision` of `pat3d.toml`; and how they are loaded.

Names are those of the Hugging Face hub, or folders. Weights are read as safetensors alone, which can hold no code.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from pat3d.errors import ModelError
from pat3d.plan.llm.settings import FILE, MAX_FILE_BYTES

INSTALL = "pip install 'pat3d[vision]'"
VARIABLES = {
    "depth": "PAT3D_DEPTH_MODEL",
    "detection": "PAT3D_DETECTION_MODEL",
    "segmentation": "PAT3D_SEGMENTATION_MODEL",
}
"""Of the environment, by the key in the file."""
EXAMPLES = {
    "depth": "depth-anything/Depth-Anything-V2-Metric-Indoor-Small-hf",
    "detection": "IDEA-Research/grounding-dino-tiny",
    "segmentation": "facebook/sam-vit-base",
}


@dataclass(frozen=True, kw_only=True)
class VisionModels:
    """Names or folders of models; None where none is named."""

    depth: str | None = None
    """Says how far away things are [m]."""
    detection: str | None = None
    """Finds boxes by words: Grounding DINO."""
    segmentation: str | None = None
    """Finds the masks of boxes: SAM, SAM 2; or of words, without boxes: SAM 3."""


def vision_models(environment: Mapping[str, str] | None = None, folder: Path | None = None) -> VisionModels:
    """The models that `environment` (the process's own) or the file in `folder` (the current one) names.

    Raises:
        ModelError: the file is not valid.
    """
    given = os.environ if environment is None else environment
    table = config_table("vision", given, folder)
    for key, value in table.items():
        if key not in VARIABLES or not isinstance(value, str):
            raise ModelError(
                f"{FILE}: [vision] may hold {', '.join(VARIABLES)}, each the name or the folder of a model; "
                f'got "{key}".'
            )
    return VisionModels(**{key: given.get(variable) or table.get(key) or None for key, variable in VARIABLES.items()})


def config_table(name: str, environment: Mapping[str, str], folder: Path | None = None) -> dict[str, Any]:
    """Table `name` of the file of settings; empty where there is none.

    Raises:
        ModelError: the file cannot be read, or the table is none.
    """
    path = Path(environment["PAT3D_CONFIG"]) if environment.get("PAT3D_CONFIG") else (folder or Path()) / FILE
    try:
        if not path.is_file():
            return {}
        if path.stat().st_size > MAX_FILE_BYTES:
            raise ModelError(f"{path} is larger than {MAX_FILE_BYTES} bytes.")
        table = tomllib.loads(path.read_text(encoding="utf-8")).get(name, {})
    except (OSError, ValueError) as error:
        raise ModelError(f"{path}: cannot be read: {error}") from error
    if not isinstance(table, dict):
        raise ModelError(f'{path}: "{name}" must be a table: [{name}].')
    return dict(table)


def can_load() -> bool:
    """Whether what loads such models is installed."""
    return find_spec("transformers") is not None and find_spec("torch") is not None


def loaded(role: str, name: str, device: str, model: Callable[[Any], Any], processor: Callable[[Any], Any]) -> Any:
    """The processor and the model called `name`, ready to look.

    Args:
        role: of the model, for messages.
        name: on the hub, or a folder.
        device: of torch.
        model: the class to load, of the module transformers.
        processor: of its inputs, likewise.

    Raises:
        ModelError: transformers is not installed, or the model cannot be loaded.
    """
    try:
        import transformers  # pyright: ignore[reportMissingImports]
    except ImportError as error:
        raise ModelError(f"a {role} model needs transformers and torch: {INSTALL}.") from error
    try:
        made = processor(transformers).from_pretrained(name)
        return made, model(transformers).from_pretrained(name, use_safetensors=True).to(device).eval()
    except (OSError, ValueError, RuntimeError, ImportError, KeyError, TypeError) as error:
        # Configurations are other people's files: what is wrong in them shows as any of these.
        raise ModelError(f'{role} model "{name}" cannot be loaded: {" ".join(str(error).split())[:300]}') from error


def model_type(role: str, name: str) -> str:
    """What architecture the model called `name` says it is: "sam2_video".

    Raises:
        ModelError: transformers is not installed, or nothing says so.
    """
    try:
        from transformers import AutoConfig  # pyright: ignore[reportMissingImports]
    except ImportError as error:
        raise ModelError(f"a {role} model needs transformers and torch: {INSTALL}.") from error
    try:
        return str(AutoConfig.from_pretrained(name).model_type)
    except (OSError, ValueError, RuntimeError, ImportError, KeyError, TypeError) as error:
        raise ModelError(f'{role} model "{name}" cannot be loaded: {" ".join(str(error).split())[:300]}') from error
