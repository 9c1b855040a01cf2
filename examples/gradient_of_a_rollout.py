"""Differentiate through contact: how far a block slides down a slope depends on the friction coefficient.

torch carries the gradient of the block's final position back through every time step, contact and friction included;
a central difference confirms it. Needs torch: pip install 'pat3d[torch]'.

    python examples/gradient_of_a_rollout.py     # writes nothing
"""

import math

import numpy as np
import torch

from pat3d import sim
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.compilation import prepare

ANGLE, STEPS, FRICTION = 0.35, 20, 0.1


def add(builder: sim.ModelBuilder, points: np.ndarray, pose: Pose, *, fixed: bool = False) -> None:
    """Add the convex hull of `points` [m], of wood."""
    part = convex_part(points)
    solid = mass_properties(part.vertices, part.faces, density=500.0)
    centre, moment = np.array(solid.centre_of_mass), solid.second_moment
    builder.add_body(
        [part], mass=solid.mass, volume=solid.volume, centre=centre, second_moment=moment, pose=pose, fixed=fixed
    )


top = 2.4 * math.tan(ANGLE)
wedge = np.array([[x, y, z] for y in (-0.3, 0.3) for x, z in ((0.0, 0.0), (2.4, 0.0), (0.0, top))])
block = np.array([[x, y, z] for x in (-0.03, 0.03) for y in (-0.03, 0.03) for z in (-0.02, 0.02)])
above = np.array([0.4, 0.0, 2.0 * math.tan(ANGLE)]) + 0.0209 * np.array([math.sin(ANGLE), 0.0, math.cos(ANGLE)])
turn = ANGLE + 0.004  # faces that are exactly parallel have no unique closest points
builder = sim.ModelBuilder()
add(builder, wedge, Pose(), fixed=True)
add(builder, block, Pose(position=tuple(above), quat_wxyz=(math.cos(turn / 2), 0.0, math.sin(turn / 2), 0.0)))
model = builder.finalize(prepare("cpu"))
q0 = torch.tensor(model.q0).reshape(1, 2, 12)  # worlds, bodies, and the position with the affine map's columns


def slid(friction: torch.Tensor) -> torch.Tensor:
    """Distance [m] along x after STEPS time steps."""
    return (sim.rollout(model, q0, until=STEPS, friction=friction).q_end - q0)[0, 1, 0]


friction = torch.tensor(FRICTION, dtype=torch.float64, requires_grad=True)
distance = slid(friction)
distance.backward()
step = 1e-4
difference = (slid(friction.detach() + step) - slid(friction.detach() - step)).item() / (2 * step)
print(f"slid {distance.item():.4f} m; d(distance)/d(friction) = {friction.grad.item():.6f} m")
print(f"central difference: {difference:.6f} m")
