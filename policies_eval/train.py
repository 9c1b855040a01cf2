"""Demonstrations of the scripted policy, and a network trained on them.

While it demonstrates, the hand is pushed about by noise, and what is learned is the answer to it: a policy that has
only seen perfect motions does not know how to get back to them (Laskey et al. 2017, DART).
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError
from pat3d.policies_eval.cloning import features, make_network, save
from pat3d.policies_eval.episodes import Episode
from pat3d.policies_eval.policy import EpisodeStart
from pat3d.policies_eval.rollout import Runner
from pat3d.policies_eval.scripted import ScriptedPolicy
from pat3d.policies_eval.settings import RolloutSettings

BATCH = 256
RATE = 1e-3
SHARE_NOISY = 0.7
"""Of the demonstrations; the rest are as good as the scripted policy is."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Demonstration:
    """One successful episode."""

    episode: Episode
    instruction: str
    observations: dict[str, NDArray[Any]]
    """What was seen before every action, shape (steps, ...)."""
    actions: NDArray[np.float32]
    """What the scripted policy answered, shape (steps, action size)."""
    done: NDArray[np.float32]
    """What was done: the same with noise."""


class Demonstrator:
    """The scripted policy with an unsteady hand."""

    privileged = True

    def __init__(self, noise: float) -> None:
        self._policy, self._noise = ScriptedPolicy(), noise
        self.seen: list[dict[str, Any]] = []
        self.answers: list[NDArray[np.float32]] = []

    def reset(self, episode: EpisodeStart) -> None:
        """Start a new record."""
        self._policy.reset(episode)
        self._random = np.random.default_rng([episode.seed, 0x64656D6F])
        self._strength = self._noise if self._random.uniform() < SHARE_NOISY else 0.0
        self._push = np.zeros(episode.action_size - 1)
        self.seen, self.answers = [], []

    def act(self, observation: Mapping[str, Any]) -> NDArray[np.float32]:
        """The scripted action, which is kept, plus a push that lasts a few steps."""
        answer = self._policy.act(observation)
        self.seen.append({name: np.array(value) for name, value in observation.items()})
        self.answers.append(answer)
        self._push = 0.8 * self._push + 0.6 * self._strength * self._random.standard_normal(len(self._push))
        done = answer.copy()
        done[:-1] = np.clip(done[:-1] + self._push, -1.0, 1.0)
        return done


def demonstrate(
    episodes: Sequence[Episode], *, noise: float = 0.3, settings: RolloutSettings | None = None, target: Any = None
) -> list[Demonstration]:
    """Successful demonstrations of `episodes`.

    Args:
        episodes: to do.
        noise: of the hand, in actions.
        settings: of the environment; state observations.
        target: a console for the progress.

    Raises:
        EvaluationError: the scripted policy never succeeded.
    """
    if not 0.0 <= noise <= 1.0:
        raise EvaluationError(f"noise is 0 to 1, not {noise}.")
    runner, policy = Runner(settings or RolloutSettings()), Demonstrator(noise)
    found = []
    for episode in episodes:
        result = runner.run(episode, policy)
        if target is not None:
            target.print(f"demonstration {episode.index + 1}/{len(episodes)}: {result.outcome}", highlight=False)
        if result.success:
            keys = policy.seen[0]
            found.append(
                Demonstration(
                    episode=episode,
                    instruction=result.instruction,
                    observations={name: np.stack([seen[name] for seen in policy.seen]) for name in keys},
                    actions=np.stack(policy.answers),
                    done=result.actions,
                )
            )
    runner.close()
    if not found:
        raise EvaluationError(f"none of {len(episodes)} demonstrations succeeded; choose another scene or task.")
    return found


def fit(
    demonstrations: Sequence[Demonstration], *, epochs: int, seed: int = 0, target: Any = None
) -> tuple[Any, float]:
    """A network that imitates, and its mean squared error at the end."""
    from importlib import import_module

    if not 1 <= epochs <= 100_000:
        raise EvaluationError(f"1 to 100000 epochs, not {epochs}.")
    torch: Any = import_module("torch")
    torch.manual_seed(seed)
    seen = [
        features({name: values[step] for name, values in one.observations.items()})
        for one in demonstrations
        for step in range(len(one.actions))
    ]
    inputs = torch.from_numpy(np.stack(seen))
    answers = torch.from_numpy(np.concatenate([one.actions for one in demonstrations]))
    network = make_network(action_size=answers.shape[1])
    network.mean.copy_(inputs.mean(0))
    network.deviation.copy_(inputs.std(0).clamp(min=1e-3))
    optimiser = torch.optim.AdamW(network.parameters(), lr=RATE, weight_decay=1e-4)
    steps = epochs * -(-len(inputs) // BATCH)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, steps)
    error = 0.0
    for epoch in range(epochs):
        order, total = torch.randperm(len(inputs)), 0.0
        for batch in order.split(BATCH):
            loss = torch.nn.functional.mse_loss(network(inputs[batch]), answers[batch])
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            schedule.step()
            total += float(loss) * len(batch)
        error = total / len(inputs)
        if target is not None and (epoch + 1) % max(1, epochs // 10) == 0:
            target.print(f"epoch {epoch + 1}/{epochs}: mean squared error {error:.4f}", highlight=False)
    return network.eval(), error


def train(
    episodes: Sequence[Episode],
    out: str | Path,
    *,
    epochs: int = 200,
    seed: int = 0,
    noise: float = 0.3,
    demonstrations: str | Path | None = None,
    target: Any = None,
) -> None:
    """Demonstrate, train and write a checkpoint.

    Args:
        episodes: that are demonstrated.
        out: checkpoint, FILE.pt.
        epochs: passes over the demonstrations.
        seed: of the training.
        noise: of the demonstrating hand.
        demonstrations: HDF5 file for robomimic, if any.
        target: a console for the progress.
    """
    if Path(out).suffix != ".pt":
        raise EvaluationError(f'a checkpoint is FILE.pt, not "{out}".')
    begun = time.perf_counter()
    shown = demonstrate(episodes, noise=noise, target=target)
    if demonstrations is not None:
        from pat3d.policies_eval.robomimic_file import write_robomimic

        write_robomimic(shown, demonstrations)
    network, error = fit(shown, epochs=epochs, seed=seed, target=target)
    save(network, out, {"demonstrations": len(shown), "epochs": epochs, "error": error, "seed": seed})
    if target is not None:
        seconds = time.perf_counter() - begun
        target.print(f"{out}: {len(shown)} demonstrations, error {error:.4f}, {seconds:.0f} s", highlight=False)
