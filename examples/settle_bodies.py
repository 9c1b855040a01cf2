"""The simulator alone: your own convex bodies, dropped and settled to equilibrium.

`sim.settle` is intersection-free at every step and needs neither a scene nor torch.

    python examples/settle_bodies.py             # writes nothing
"""

import numpy as np

from pat3d import sim
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.compilation import prepare

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)


def add_block(builder: sim.ModelBuilder, half_size: list[float], pose: Pose, label: str) -> None:
    """Add a wooden block of the given half sizes [m]."""
    part = convex_part(CORNERS * half_size)
    properties = mass_properties(part.vertices, part.faces, density=600.0)
    builder.add_body(
        [part],
        mass=properties.mass,
        volume=properties.volume,
        centre=np.array(properties.centre_of_mass),
        second_moment=properties.second_moment,
        pose=pose,
        label=label,
    )


builder = sim.ModelBuilder()
add_block(builder, [0.05, 0.05, 0.03], Pose(position=(0, 0, 0.04)), "base")
add_block(builder, [0.12, 0.02, 0.01], Pose.from_yaw(0.3, (0.02, 0, 0.09)), "plank")
model = builder.finalize(prepare("cpu"))
settled = sim.settle(model)
print(f"at rest: {settled.at_rest.all()}, unbalanced by {settled.residual.max():.1e} of a weight")
for label, pose in zip(model.labels, sim.poses_from_states(model, settled.q), strict=True):
    print(f"{label}: position {np.round(pose.position, 5)} m")
