"""A network trained on demonstrations of the scripted policy."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import EvaluationError
from pat3d.policies_eval.datasets.demonstrations import Demonstration, demonstrate
from pat3d.policies_eval.datasets.files import write_demonstrations
from pat3d.policies_eval.policies.cloning import make_network, save
from pat3d.policies_eval.policies.inputs import Inputs
from pat3d.policies_eval.run.episodes import Episode
from pat3d.policies_eval.run.settings import NOISE, RolloutSettings

BATCH = 256
RATE = 1e-3


def fit(
    demonstrations: Sequence[Demonstration], *, epochs: int, seed: int = 0, sees: str = "task", target: Any = None
) -> tuple[Any, float]:
    """A network that imitates, and its mean squared error at the end.

    Args:
        demonstrations: to imitate.
        epochs: passes over them.
        seed: of the training.
        sees: one of `pat3d.policies_eval.policies.inputs.KINDS`.
        target: a console for the progress.
    """
    import torch

    if not 1 <= epochs <= 100_000:
        raise EvaluationError(f"1 to 100000 epochs, not {epochs}.")
    torch.manual_seed(seed)
    # The network is small: threads would only wait for one another.
    torch.set_num_threads(1)
    rows = max((len(one.observations["objects"][0]) for one in demonstrations), default=0) if sees == "objects" else 0
    inputs_of = Inputs.of(sees, (one.instruction for one in demonstrations), rows)
    seen = [
        inputs_of.see({name: values[step] for name, values in one.observations.items()}, one.instruction, step)
        for one in demonstrations
        for step in range(len(one.actions))
    ]
    inputs = torch.from_numpy(np.stack(seen))
    answers = torch.from_numpy(np.concatenate([one.actions for one in demonstrations]))
    network = make_network(action_size=answers.shape[1], inputs=inputs_of)
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
            total += float(loss.detach()) * len(batch)
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
    noise: float = NOISE,
    successes: int | None = None,
    demonstrations: str | Path | None = None,
    overwrite: bool = False,
    sees: str = "task",
    settings: RolloutSettings | None = None,
    target: Any = None,
) -> int:
    """Demonstrate, train and write a checkpoint; returns how many demonstrations it learned from.

    Args:
        episodes: that are demonstrated.
        out: checkpoint, FILE.pt.
        epochs: passes over the demonstrations.
        seed: of the training.
        noise: of the demonstrating hand.
        successes: after which no more are demonstrated; None for all episodes.
        demonstrations: file or folder to write them to, if any.
        overwrite: replace what is there.
        sees: what of the observations it gets, see `fit`.
        settings: of the environment.
        target: a console for the progress.
    """
    if Path(out).suffix != ".pt":
        raise EvaluationError(f'a checkpoint is FILE.pt, not "{out}".')
    begun = time.perf_counter()
    shown = demonstrate(episodes, noise=noise, successes=successes, settings=settings, target=target)
    if demonstrations is not None:
        write_demonstrations(shown, demonstrations, overwrite=overwrite)
    network, error = fit(shown, epochs=epochs, seed=seed, sees=sees, target=target)
    save(network, out, {"demonstrations": len(shown), "epochs": epochs, "error": error, "seed": seed})
    if target is not None:
        seconds = time.perf_counter() - begun
        target.print(f"{out}: {len(shown)} demonstrations, error {error:.4f}, {seconds:.0f} s", highlight=False)
    return len(shown)
