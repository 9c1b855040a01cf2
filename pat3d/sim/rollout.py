"""Rollouts as a differentiable function of the initial state, for torch.

    model = builder.finalize("cpu")
    run = rollout(model, q0, until="rest")            # q0: [worlds, bodies, 12], requires_grad
    loss(run.q_end, run.frames).backward()            # q0.grad through contact and friction

Only the states between steps are kept, 96 bytes a body and step; the backward pass assembles each step's system anew.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import torch
from numpy.typing import NDArray

from pat3d.errors import SimulationError
from pat3d.sim.adjoint import backward
from pat3d.sim.model import Model
from pat3d.sim.settle import Progress, Run, SettleOptions, Tape

GRADIENT_RESIDUAL = 1.0e-9
"""Unbalanced force over weight to which the steps of a differentiated rollout are converged."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Rollout:
    """A finished rollout."""

    frames: torch.Tensor
    """State after every step, starting with the first state, shape (steps + 1, worlds, bodies, 12)."""
    at_rest: NDArray[np.bool_]
    """Whether every world came to rest, shape (worlds,); False where only frames were asked for."""
    residual: NDArray[np.float64]
    """Largest unbalanced force over weight, shape (worlds,)."""

    @property
    def q_end(self) -> torch.Tensor:
        """Final states (p, a_1, a_2, a_3), shape (worlds, bodies, 12)."""
        return self.frames[-1]


def rollout(
    model: Model,
    q0: torch.Tensor,
    *,
    until: Literal["rest", "still"] | int = "rest",
    options: SettleOptions | None = None,
    progress: Progress = lambda *_: None,
) -> Rollout:
    """Simulate from `q0` and record how the result depends on it.

    Args:
        model: worlds with equally many bodies.
        q0: initial states, shape (worlds, bodies, 12), float64.
        until: "rest" for settling with its polish, "still" for its drop alone, or a number of time steps.
        options: settings; every step is converged at least to GRADIENT_RESIDUAL.
        progress: called with the phase, step number and largest motion [m].

    Raises:
        SimulationError: wrong shape, or an initial state that intersects.
    """
    per_world = model.bodies // model.worlds
    if np.any(np.bincount(model.world_of, minlength=model.worlds) != per_world):
        raise SimulationError("a rollout needs worlds with equally many bodies.")
    if tuple(q0.shape) != (model.worlds, per_world, 12) or q0.dtype != torch.float64:
        raise SimulationError(
            f"q0 must be float64 of shape {(model.worlds, per_world, 12)}, got {q0.dtype} of shape {tuple(q0.shape)}."
        )
    options = options or SettleOptions()
    options = replace(
        options,
        drop_residual=min(options.drop_residual, GRADIENT_RESIDUAL),
        residual=min(options.residual, 10 * GRADIENT_RESIDUAL),
    )
    ended: dict[str, Any] = {}

    def forward(state: NDArray[np.float64]) -> Tape:
        tape = Tape()
        run = Run(model, options, progress, state, tape)
        run.refuse_intersections()
        run.set_reach(options.d_hat)
        run.drop(int(until) if until not in ("rest", "still") else None)
        if until == "rest":
            ended["at_rest"], ended["residual"] = run.polish()
        else:
            residual = run.potential.residual(run.potential.gradient(run.q, inertia=False))
            ended["at_rest"], ended["residual"] = np.zeros(model.worlds, dtype=bool), residual
        return tape

    frames: Any = _Steps.apply(q0, forward, lambda tape, losses: backward(model, options, tape, losses))
    return Rollout(frames=frames, **ended)


class _Steps(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, q0: torch.Tensor, run: Callable[..., Tape], pull_back: Callable[..., Any]) -> torch.Tensor:
        tape = run(q0.detach().cpu().numpy().reshape(-1, 4, 3))
        ctx.tape, ctx.pull_back, ctx.shape, ctx.device = tape, pull_back, tuple(q0.shape), q0.device
        return torch.from_numpy(np.stack(tape.states)).reshape(-1, *ctx.shape).to(q0.device)

    @staticmethod
    def backward(ctx: Any, *gradients: torch.Tensor) -> tuple[torch.Tensor, None, None]:
        gradient = gradients[0].detach().cpu().numpy().reshape(len(ctx.tape.states), -1, 4, 3)
        losses = {k: part for k, part in enumerate(gradient) if np.any(part)}
        result = ctx.pull_back(ctx.tape, losses)
        return torch.from_numpy(result).reshape(ctx.shape).to(ctx.device), None, None
