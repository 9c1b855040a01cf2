"""From the text after --policy to a policy."""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError, Pat3dError
from pat3d.policies_eval.policies.lerobot import LEROBOT, LeRobotPolicy, require_checkpoint
from pat3d.policies_eval.policies.policy import EpisodeStart, Policy

FORMS = (
    "random, scripted, ws://HOST:PORT (an openpi policy server), package.module:callable, FILE.pt (pat3d train), "
    "lerobot:FOLDER (a checkpoint of LeRobot)"
)

_CALLABLE = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*")


class RandomPolicy:
    """Uniform actions, drawn from the episode's seed."""

    def reset(self, episode: EpisodeStart) -> None:
        """Start the episode's own stream of random numbers."""
        self._random, self._size = np.random.default_rng([episode.seed, 0x70617433]), episode.action_size

    def act(self, observation: Any) -> NDArray[np.float64]:
        """Anything in [-1, 1]."""
        return self._random.uniform(-1.0, 1.0, self._size)


class CallablePolicy:
    """A plain function from observation to action."""

    def __init__(self, function: Callable[[Any], Any]) -> None:
        self._function = function

    def reset(self, episode: EpisodeStart) -> None:
        """Nothing to prepare."""

    def act(self, observation: Any) -> Any:
        """What the function says."""
        return self._function(observation)


def make_policy(spec: str) -> Policy:
    """The policy that `spec` names.

    "module:callable" may be a function from observation to action, a class with reset and act, or a function without
    arguments that makes such an object or such a function.

    Raises:
        EvaluationError: no such policy, or it cannot be made; says what is valid.
    """
    require_known(spec)
    if spec == "random":
        return RandomPolicy()
    if spec == "scripted":
        from pat3d.policies_eval.policies.scripted import ScriptedPolicy

        return ScriptedPolicy()
    if spec.startswith(("ws://", "wss://")):
        from pat3d.policies_eval.policies.server import ServerPolicy

        return ServerPolicy(spec)
    if spec.endswith(".pt"):
        from pat3d.policies_eval.policies.cloning import ClonedPolicy

        return ClonedPolicy(spec)
    if spec.startswith(LEROBOT):
        return LeRobotPolicy(spec)
    return _imported(spec)


def require_known(spec: str) -> None:
    """Raise EvaluationError unless `spec` has the form of a policy, and names a file that is there."""
    if spec.startswith(LEROBOT):
        require_checkpoint(spec)
        return
    plain = spec in ("random", "scripted") or spec.startswith(("ws://", "wss://"))
    if spec.endswith(".pt"):
        if not Path(spec).is_file():
            raise EvaluationError(f"{spec}: no such checkpoint; pat3d train writes one.")
    elif not plain and not _CALLABLE.fullmatch(spec):
        raise EvaluationError(f'no policy "{spec}". Policies: {FORMS}.')


def identity(spec: str) -> dict[str, str]:
    """What tells this policy from another with the same name: the checksum of a checkpoint."""
    if spec.startswith(LEROBOT):
        weights = Path(spec.removeprefix(LEROBOT)) / "model.safetensors"
        return {"checkpoint_sha256": hashlib.sha256(weights.read_bytes()).hexdigest()} if weights.is_file() else {}
    if spec.endswith(".pt") and Path(spec).is_file():
        return {"checkpoint_sha256": hashlib.sha256(Path(spec).read_bytes()).hexdigest()}
    return {}


def _imported(spec: str) -> Policy:
    module, name = spec.split(":")
    # The command line knows the packages of the folder it runs in, as `python -m` does.
    sys.path.insert(0, str(Path.cwd()))
    try:
        made = getattr(import_module(module), name)
        if isinstance(made, type) or _takes_nothing(made):
            made = made()
    except Pat3dError:
        raise
    except Exception as error:
        raise EvaluationError(f"{spec}: {type(error).__name__}: {error}") from error
    finally:
        sys.path.remove(str(Path.cwd()))
    if isinstance(made, Policy):
        return made
    if callable(made):
        return CallablePolicy(made)
    raise EvaluationError(f"{spec} gives a {type(made).__name__}; valid are objects with reset and act, and functions.")


def _takes_nothing(function: Any) -> bool:
    import inspect

    if not callable(function):
        return False
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return False
    return all(one.default is not one.empty or one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD) for one in parameters)
