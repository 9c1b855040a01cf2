"""Does every one of several carriers carry? The contact forces of MuJoCo, once the scene has been simulated.

A plank that touches two blocks may lie on one of them alone. The predicate of pat3d.layout.predicates sees that it
touches; here the upward force of each carrier on it is compared with its weight.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.check.settle import object_name
from pat3d.scene.model import Scene
from pat3d.scene.physics import GRAVITY, STILL_SECONDS

LEAST = 0.02
"""Share of an object's weight from which a carrier carries it."""


@dataclass(frozen=True, kw_only=True)
class Load:
    """How much of one object lies on one of its carriers."""

    child: str
    carrier: str
    share: float
    """Upward force of the carrier on the object, in weights of the object; more than 1 under what carries others."""

    @property
    def carries(self) -> bool:
        """Whether weight lies on it."""
        return self.share >= LEAST

    def as_dict(self) -> dict[str, Any]:
        """Plain data for reports."""
        return {**asdict(self), "carries": self.carries}

    def __str__(self) -> str:
        return f'"{self.carrier}" carries {self.share:.0%} of "{self.child}" in MuJoCo (at least {LEAST:.0%}).'


def carried_loads(scene: Scene, mjcf_path: str | Path, seconds: float = STILL_SECONDS) -> tuple[Load, ...]:
    """The loads on all carriers of what has several, after `seconds` of MuJoCo; none where nothing has several."""
    wanted = [(obj.name, one) for obj in scene.objects if len(scene.carriers(obj.name)) > 1
              for one in scene.carriers(obj.name)]  # fmt: skip
    if not wanted:
        return ()
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(mjcf_path))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=max(1, round(seconds / model.opt.timestep)))
    mujoco.mj_forward(model, data)
    names = {body: object_name(mujoco, model, body) for body in range(1, model.nbody)}
    upward: defaultdict[tuple[str, str], float] = defaultdict(float)
    force = np.zeros(6)
    for index in range(data.ncon):
        contact = data.contact[index]
        first, second = (names.get(int(model.geom_bodyid[geom]), "") for geom in (contact.geom1, contact.geom2))
        mujoco.mj_contactForce(model, data, index, force)
        # The frame's rows are the normal, from the first geom to the second, and two tangents.
        lift = float((contact.frame.reshape(3, 3).T @ force[:3])[2])
        upward[second, first] += lift
        upward[first, second] -= lift
    return tuple(
        Load(
            child=child,
            carrier=carrier,
            share=float(upward[child, carrier]) / (scene[child].asset.mass_properties.mass * GRAVITY),
        )
        for child, carrier in wanted
    )
