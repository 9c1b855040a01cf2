"""Gradient steps on one layout: Adam on where things stand, through the differentiable rollout.

Every iterate is free of intersection before it is rolled out: the step is projected, and where no free layout is
near it is halved. What happens after something has fallen is chaos, of which the gradient is noise: the scene counts as
lost from then on, with the loss of that frame, and the next rollouts go little further.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import torch

from pat3d.errors import LayoutError, SimulationError
from pat3d.geometry.pose import Pose
from pat3d.layout.predicates import check_relations
from pat3d.optimize.loss import SemanticLoss
from pat3d.optimize.placement import Placement
from pat3d.scene.model import Relation
from pat3d.sim.model import Model, ModelBuilder, poses_from_states
from pat3d.sim.rollouts import rollout
from pat3d.sim.run import SettleOptions

HALVINGS = 5
"""How often a step that cannot be made is halved."""


@dataclass(frozen=True, kw_only=True)
class Epoch:
    """One gradient step."""

    start: int
    """Which of the refined starts, from 0."""
    epoch: int
    """From 0, the start itself."""
    loss: float
    """Mean over the gathered frames of the longest rollout [m^2]; frames after a fall count like that one."""
    broken: int
    """Relations that do not hold at the end of the rollout."""


def refine(
    placement: Placement,
    relations: tuple[Relation, ...],
    *,
    confirm: Callable[[Mapping[str, Pose]], bool],
    start: int,
    history: list[Epoch],
    progress: Callable[[str, int, float], None],
    epochs: int,
    learning_rate: float,
    every: int,
    patience: int,
    frames: int,
    settings: SettleOptions,
    device: str,
) -> dict[str, Pose]:
    """Follow the gradient from the layout of `placement`.

    Args:
        placement: the layout and its variables.
        relations: of its objects.
        confirm: settles a layout whose relations hold at the end of a rollout; True ends the search.
        start: number of this layout in the history.
        history: epochs are appended.
        progress: called with "epoch", its number and its loss [m^2].
        epochs: gradient steps at most.
        learning_rate: of Adam [m].
        every: frames between those gathered.
        patience: epochs without a lower loss that end the search.
        frames: of a rollout at most.
        settings: of the rollouts.
        device: "cpu" or "cuda".

    Returns:
        The layout that was confirmed, else the one of the least loss.
    """
    model = _model(placement, device)
    loss_of = SemanticLoss(placement.assets, relations, placement.poses)
    movable = torch.from_numpy(placement.movable)[:, None]
    variables = torch.zeros((len(placement.names), 3), dtype=torch.float64, requires_grad=True)
    adam = torch.optim.Adam([variables], lr=learning_rate)
    poses = placement.poses
    best, best_poses, since = np.inf, poses, 0
    horizon, until = frames, "still"
    for epoch in range(epochs + 1):
        try:
            while True:
                q0 = placement.states(variables, poses)[None]
                run = rollout(model, q0, until=until, options=replace(settings, max_frames=horizon))
                loss, fell = _gathered(loss_of, run.frames[:, 0], every, frames)
                if fell is not None or horizon >= frames or len(run.frames) <= horizon:
                    break
                # Nothing fell in the shorter rollout: see whether it stays up.
                horizon = frames
        except SimulationError:
            break
        if until == "still":
            horizon = frames if fell is None else min(frames, 3 * fell // 2 + every)
        value = float(loss.detach())
        broken = _broken(model, placement, relations, run.q_end[0].detach().numpy())
        history.append(Epoch(start=start, epoch=epoch, loss=value, broken=broken))
        progress("epoch", epoch, value)
        if value < best:
            best, best_poses, since = value, poses, 0
        else:
            since += 1
        if broken == 0:
            if confirm(poses):
                return dict(poses)
            if until == "still":
                # What stands through the drop and falls later is judged by whole settling runs.
                horizon, until = settings.max_frames, "rest"
                continue
        if epoch == epochs or since >= patience or not loss.requires_grad:
            break
        adam.zero_grad()
        loss.backward()
        if variables.grad is None or not torch.isfinite(variables.grad).all() or not variables.grad.any():
            break
        variables.grad *= movable
        before = variables.detach().clone()
        adam.step()
        found = _projected(placement, variables, before)
        if found is None:
            break
        poses = found
    return dict(best_poses)


def _gathered(loss_of: SemanticLoss, frames: torch.Tensor, every: int, longest: int) -> tuple[torch.Tensor, int | None]:
    """Loss [m^2] of a rollout, frames of shape (steps + 1, bodies, 12), and the frame at which something had fallen.

    The mean over `longest` frames: the last gathered frame stands for all that were not simulated or came after a fall.
    """
    index = [*range(every, len(frames) - 1, every), len(frames) - 1]
    terms = loss_of.terms(frames[index])
    if not terms:
        return frames.sum() * 0.0, None
    values = torch.stack(list(terms.values())).sum(dim=0)
    lost = torch.nonzero(loss_of.lost(terms)).flatten()
    last = int(lost[0]) if len(lost) else len(index) - 1
    count = max(longest // every, last + 1)
    loss = (values[:last].sum() + (count - last) * values[last]) / count
    return loss, index[last] if len(lost) else None


def _projected(placement: Placement, variables: torch.Tensor, before: torch.Tensor) -> dict[str, Pose] | None:
    """Intersection-free poses of `variables`, which are drawn back towards `before` until there are some."""
    for _ in range(HALVINGS):
        try:
            return placement.project(variables.detach().numpy())
        except LayoutError:
            with torch.no_grad():
                variables.copy_(before + 0.5 * (variables - before))
    return None


def _model(placement: Placement, device: str) -> Model:
    builder = ModelBuilder()
    builder.add_scene(placement.scene(placement.poses, placement.attachments))
    return builder.finalize(device)


def _broken(model: Model, placement: Placement, relations: tuple[Relation, ...], q: np.ndarray) -> int:
    """How many relations do not hold at states `q`, shape (bodies, 12)."""
    poses = dict(zip(placement.names, poses_from_states(model, q.reshape(-1, 4, 3)), strict=True))
    # Bodies still float within the barrier's reach while they drop.
    results = check_relations(relations, placement.assets, poses, touch=2e-3, attachments=placement.attachments)
    return sum(not result.holds for result in results)
