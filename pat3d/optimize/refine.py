"""Gradient steps on one layout: Adam on where things stand, through the differentiable rollout.

Every iterate is free of intersection before it is rolled out: the step is projected, and where no free layout is
near it is halved.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import torch

from pat3d.errors import LayoutError, SimulationError
from pat3d.layout.predicates import check_relations
from pat3d.optimize.loss import SemanticLoss
from pat3d.optimize.placement import Placement
from pat3d.scene import Pose, Relation
from pat3d.sim.model import Model, ModelBuilder, poses_from_states
from pat3d.sim.rollout import rollout
from pat3d.sim.settle import SettleOptions

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
    """Mean over the gathered frames and the last one [m^2]."""
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
    for epoch in range(epochs + 1):
        try:
            run = rollout(model, placement.states(variables, poses)[None], until="still", options=settings)
        except SimulationError:
            break
        gathered = [*range(every, len(run.frames) - 1, every), -1]
        loss = loss_of(run.frames[gathered, 0]).mean()
        value = float(loss.detach())
        broken = _broken(model, placement, relations, run.q_end[0].detach().numpy())
        history.append(Epoch(start=start, epoch=epoch, loss=value, broken=broken))
        progress("epoch", epoch, value)
        if value < best:
            best, best_poses, since = value, poses, 0
        else:
            since += 1
        if broken == 0 and confirm(poses):
            return dict(poses)
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
    for name, asset in placement.assets.items():
        builder.add_asset(asset, placement.poses[name], fixed=name in placement.fixed, label=name)
    return builder.finalize(device)


def _broken(model: Model, placement: Placement, relations: tuple[Relation, ...], q: np.ndarray) -> int:
    """How many relations do not hold at states `q`, shape (bodies, 12)."""
    poses = dict(zip(placement.names, poses_from_states(model, q.reshape(-1, 4, 3)), strict=True))
    # Bodies still float within the barrier's reach while they drop.
    results = check_relations(relations, placement.assets, poses, touch=2e-3)
    return sum(not result.holds for result in results)
