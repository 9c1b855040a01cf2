"""The differentiable affine-body simulator, usable alone.

    from pat3d import sim

    builder = sim.ModelBuilder()
    builder.add_asset(asset, pose)
    model = builder.finalize(device="cuda", worlds=256)
    settled = sim.settle(model)                             # numpy, without gradients
    rollout = sim.rollout(model, q0, until="rest")          # q0: torch tensor [worlds, bodies, 12]
    loss(rollout.q_end).backward()                          # q0.grad through contact and friction

The names below load what they need, Warp and for rollouts torch, when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pat3d.sim.failure import Status
    from pat3d.sim.model import Model, ModelBuilder, poses_from_states
    from pat3d.sim.rollouts import Rollout, rollout
    from pat3d.sim.run import SettleOptions
    from pat3d.sim.settling import Settled, UnsettledError, settle

__all__ = [
    "Model",
    "ModelBuilder",
    "Rollout",
    "SettleOptions",
    "Settled",
    "Status",
    "UnsettledError",
    "poses_from_states",
    "rollout",
    "settle",
]

_HOMES = {
    "Model": "pat3d.sim.model",
    "ModelBuilder": "pat3d.sim.model",
    "Rollout": "pat3d.sim.rollouts",
    "SettleOptions": "pat3d.sim.run",
    "Settled": "pat3d.sim.settling",
    "Status": "pat3d.sim.failure",
    "UnsettledError": "pat3d.sim.settling",
    "poses_from_states": "pat3d.sim.model",
    "rollout": "pat3d.sim.rollouts",
    "settle": "pat3d.sim.settling",
}


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f'module "pat3d.sim" has no attribute "{name}". It has: {", ".join(__all__)}.')


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
