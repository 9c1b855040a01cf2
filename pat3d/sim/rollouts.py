"""Rollouts as differentiable functions of the initial state and of physical parameters, for torch.

    model = builder.finalize("cuda", worlds=256)
    run = rollout(model, q0, until="rest")            # q0: [worlds, bodies, 12], requires_grad
    loss(run.q_end, run.frames).backward()            # q0.grad through contact and friction

Memory: the frames that a rollout returns are all that it keeps of its states, 96 bytes a body and frame, and the
backward pass assembles each step's system anew. With `every` = K only each K-th state is a frame; the backward pass
runs the steps in between once more, K at a time, for about one forward pass more of time.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import torch
import warp as wp
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from pat3d.errors import SimulationError
from pat3d.sim.adjoint import backward
from pat3d.sim.model import Model
from pat3d.sim.recording import RecordedRun, Recording
from pat3d.sim.run import Progress, SettleOptions


@dataclass(frozen=True, kw_only=True, eq=False)
class Rollout:
    """A finished rollout."""

    frames: torch.Tensor
    """Kept states, the first and the last among them, shape (frames, worlds, bodies, 12)."""
    steps: NDArray[np.int64]
    """Number of the time step that each frame ends; 0 for the initial state; shape (frames,)."""
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
    every: int = 1,
    friction: torch.Tensor | float | None = None,
    mass: torch.Tensor | None = None,
    d_hat: torch.Tensor | float | None = None,
    options: SettleOptions | None = None,
    progress: Progress = lambda *_: None,
) -> Rollout:
    """Simulate from `q0` and record how the result depends on it and on the parameters given as tensors.

    How many steps are taken, and where friction is anchored, is decided by thresholds, and the gradient holds those
    decisions fixed. The stiffness of barriers and attachments stays that of the model's own masses.

    Args:
        model: worlds with equally many bodies.
        q0: initial states, shape (worlds, bodies, 12), float64.
        until: "rest" for settling with its polish, "still" for its drop alone, or a number of time steps.
        every: steps from one frame to the next; more than 1 bounds the memory for more time in the backward pass.
        friction: coefficient of every contact [-], one or shape (worlds,); that of `options` where None.
        mass: of every body [kg], its second moment in proportion, shape (worlds, bodies); the model's where None.
        d_hat: barrier activation distance of the drop [m], a scalar; that of `options` where None.
        options: settings; every step is converged to rounding all the same, which `drop_residual` need not ask for.
        progress: called with the phase, step number and largest motion [m].

    Raises:
        SimulationError: wrong shape or value, or an initial state that intersects.
    """
    options = options or SettleOptions()
    per_world = model.bodies // model.worlds
    if np.any(np.bincount(model.world_of, minlength=model.worlds) != per_world):
        raise SimulationError("a rollout needs worlds with equally many bodies.")
    if until not in ("rest", "still") and not (isinstance(until, int) and until > 0):
        raise SimulationError(f'until must be "rest", "still" or a positive number of steps, got {until!r}.')
    if every < 1:
        raise SimulationError(f"frames are a positive number of steps apart, got every={every}.")
    shape = (model.worlds, per_world, 12)
    if tuple(q0.shape) != shape or q0.dtype != torch.float64:
        raise SimulationError(f"q0 must be float64 of shape {shape}, got {q0.dtype} of shape {tuple(q0.shape)}.")
    own_mass = torch.from_numpy(model.body_mass.numpy().reshape(shape[:2]).copy())
    inputs = (
        q0,
        _parameter("friction", options.friction if friction is None else friction, shape[:1], zero=True),
        _parameter("mass", own_mass if mass is None else mass, shape[:2]),
        _parameter("d_hat", options.d_hat if d_hat is None else d_hat, ()),
    )
    distance = float(inputs[3].detach())
    if inputs[3].requires_grad and distance <= max(options.final_d_hat, options.friction_speed * options.time_step):
        raise SimulationError("d_hat has a gradient only above final_d_hat and above friction_speed * time_step.")
    options = replace(options, d_hat=distance)
    if mass is not None:
        model = _with_mass(model, inputs[2].detach().cpu().numpy().reshape(-1))
    run = RecordedRun(
        model, options, inputs[1].detach().cpu().numpy(), every, q0.detach().cpu().numpy().reshape(-1, 4, 3), progress
    )
    ended: dict[str, Any] = {"at_rest": np.zeros(model.worlds, dtype=bool)}

    def forward() -> tuple[Recording, torch.Tensor]:
        # Factorisations of a few hundred unknowns lose more to the threads of BLAS than they gain.
        with threadpool_limits(limits=1, user_api="blas"):
            run.refuse_intersections()
            run.set_d_hat(options.d_hat)
            run.drop(until if isinstance(until, int) else None)
            if until == "rest":
                ended["at_rest"], ended["residual"] = run.polish()
            else:
                ended["residual"] = run.potential.residual(run.potential.gradient(run.q, inertia=False))
        record, states = run.recorded()
        return record, torch.stack([wp.to_torch(state).reshape(shape) for state in states])

    frames: Any = _Steps.apply(forward, *inputs)
    return Rollout(frames=frames, steps=np.array(run.kept), **ended)


def _parameter(name: str, value: torch.Tensor | float, shape: tuple[int, ...], zero: bool = False) -> torch.Tensor:
    """`value` as a positive float64 tensor of the given shape, to which a scalar is spread."""
    tensor = torch.as_tensor(value, dtype=torch.float64)
    if tensor.ndim and tuple(tensor.shape) != shape:
        raise SimulationError(f"{name} must be a scalar or of shape {shape}, got shape {tuple(tensor.shape)}.")
    least = tensor.detach().min()
    if not bool(torch.isfinite(tensor.detach()).all()) or float(least) < 0 or (not zero and float(least) == 0):
        raise SimulationError(f"{name} must be finite and {'not negative' if zero else 'positive'}, got {value}.")
    return tensor.expand(shape)


def _with_mass(model: Model, mass: NDArray[np.float64]) -> Model:
    """`model` with other masses [kg], shape (bodies,), and second moments in proportion."""
    moment = model.body_moment.numpy() * (mass / model.body_mass.numpy())[:, None, None]
    return replace(
        model,
        body_mass=wp.array(mass, dtype=wp.float64, device=model.device),
        body_moment=wp.array(moment, dtype=wp.mat33d, device=model.device),
    )


class _Steps(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, run: Any, q0: torch.Tensor, *parameters: torch.Tensor) -> torch.Tensor:
        record, states = run()
        frames = states.to(q0.device)
        ctx.record, ctx.devices = record, [q0.device, *(parameter.device for parameter in parameters)]
        # Saved as torch saves: frames changed in place are noticed.
        ctx.save_for_backward(frames)
        return frames

    @staticmethod
    def backward(ctx: Any, *gradients: torch.Tensor) -> tuple[torch.Tensor | None, ...]:
        (frames,) = ctx.saved_tensors
        device = wp.device_to_torch(ctx.record.model.device)
        states, losses = (
            wp.from_torch(part.detach().to(device).reshape(len(frames), -1, 4, 3).contiguous(), dtype=wp.vec3d)
            for part in (frames, gradients[0])
        )
        with threadpool_limits(limits=1, user_api="blas"):
            found = backward(ctx.record, states, losses, d_hat=ctx.needs_input_grad[4])
        results = (
            found.q0.reshape(frames.shape[1:]),
            found.friction,
            found.mass.reshape(frames.shape[1:3]),
            np.asarray(found.d_hat),
        )
        return None, *(torch.from_numpy(x).to(device) for x, device in zip(results, ctx.devices, strict=True))
