"""Checkpoints of LeRobot as policies: "lerobot:FOLDER", where the package lerobot is installed.

The folder is what LeRobot's `save_pretrained` writes: config.json, model.safetensors, and its processors, which hold
the normalisation. Observations come under the names that `write_lerobot` gives them in a dataset.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.observations import state_keys
from pat3d.errors import EvaluationError
from pat3d.policies_eval.policies.policy import EpisodeStart

LEROBOT = "lerobot:"
"""Before the folder of a checkpoint."""

IMAGES = "observation.images."
"""Before the name of every camera."""

INSTALL_HINT = "policies of LeRobot need its package: pip install lerobot."

MAX_CONFIG = 2**20

_NEEDED = ("config.json", "model.safetensors")


def require_checkpoint(spec: str) -> Path:
    """The folder in "lerobot:FOLDER".

    Raises:
        EvaluationError: no checkpoint is there; weights in another form than safetensors are not read.
    """
    folder = Path(spec.removeprefix(LEROBOT))
    missing = [name for name in _NEEDED if not (folder / name).is_file()]
    if missing:
        raise EvaluationError(
            f"{folder}: no checkpoint of LeRobot: {', '.join(missing)} missing. Give the folder that save_pretrained "
            "wrote, often .../checkpoints/last/pretrained_model."
        )
    return folder


class LeRobotPolicy:
    """A checkpoint of LeRobot.

    Args:
        spec: "lerobot:FOLDER".

    Raises:
        EvaluationError: no checkpoint, lerobot is not installed, or it cannot load the checkpoint; says why.
    """

    def __init__(self, spec: str) -> None:
        folder = require_checkpoint(spec)
        kind = _kind(folder)
        try:
            import torch
            from lerobot.configs import policies as configs  # type: ignore[import-not-found]
            from lerobot.policies import factory  # type: ignore[import-not-found]
        except ImportError as error:
            raise EvaluationError(f"{INSTALL_HINT} ({error})") from error
        self._torch: Any = torch
        try:
            make = factory.get_policy_class(kind)
            config = configs.PreTrainedConfig.from_pretrained(str(folder))
            config.device = "cuda" if self._torch.cuda.is_available() else "cpu"
            self._policy = make.from_pretrained(str(folder), config=config)
            self._policy.eval()
            self._before, self._after = factory.make_pre_post_processors(
                policy_cfg=config,
                pretrained_path=str(folder),
                preprocessor_overrides={"device_processor": {"device": config.device}},
            )
        except Exception as error:
            # Whatever a checkpoint of another version makes the package raise.
            raise EvaluationError(f"{folder}: LeRobot cannot load it: {type(error).__name__}: {error}") from error
        self._inputs = tuple(config.input_features)
        self._instruction = ""

    def reset(self, episode: EpisodeStart) -> None:
        """Forget the actions that are left of a chunk."""
        # Policies that sample draw from the episode's seed.
        self._torch.manual_seed(episode.seed)
        self._instruction = episode.instruction
        self._policy.reset()
        for pipeline in (self._before, self._after):
            pipeline.reset()

    def act(self, observation: Mapping[str, Any]) -> NDArray[np.float32]:
        """The next action, shape (action size,)."""
        torch = self._torch
        batch: dict[str, Any] = {name: torch.from_numpy(self._input(name, observation))[None] for name in self._inputs}
        batch["task"] = [self._instruction]
        with torch.inference_mode():
            action = self._after(self._policy.select_action(self._before(batch)))
        return np.asarray(action.detach().cpu().numpy(), dtype=np.float32).reshape(-1)

    def _input(self, name: str, observation: Mapping[str, Any]) -> NDArray[np.float32]:
        """What the checkpoint calls `name`: a vector, or a picture with values in [0, 1], shape (3, height, width)."""
        if name == "observation.state":
            return np.concatenate([observation[key] for key in state_keys(observation)]).astype(np.float32)
        if name == "observation.environment_state" and "target" in observation:
            return np.asarray(observation["target"], dtype=np.float32)
        key = f"{name.removeprefix(IMAGES)}_image"
        if name.startswith(IMAGES) and key in observation:
            return np.ascontiguousarray(np.moveaxis(observation[key], -1, 0), dtype=np.float32) / 255.0
        there = [f"{IMAGES}{key.removesuffix('_image')}" for key in observation if key.endswith("_image")]
        there += ["observation.environment_state"] * ("target" in observation)
        raise EvaluationError(
            f"the checkpoint sees {name}; here are observation.state, {', '.join(there)}. Pictures need --obs rgb, the "
            "environment's state --obs state."
        )


def _kind(folder: Path) -> str:
    """Of the policy, by its config.json."""
    file = folder / "config.json"
    try:
        if file.stat().st_size > MAX_CONFIG:
            raise ValueError(f"larger than {MAX_CONFIG} bytes")
        kind = json.loads(file.read_text(encoding="utf-8"))["type"]
        if not isinstance(kind, str):
            raise TypeError(f"a type that is {kind!r}")
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise EvaluationError(f"{file}: says no type of policy: {type(error).__name__}: {error}") from error
    return kind
