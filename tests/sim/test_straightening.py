import numpy as np
import pytest

from pat3d.geometry.pose import Pose
from pat3d.sim import straightening
from pat3d.sim.model import ModelBuilder, poses_from_states
from pat3d.sim.run import SettleOptions
from pat3d.sim.settling import settle
from tests.sim.builders import add_hull, box_points

SLOPE = np.deg2rad(0.5)
"""Of the sides of a plug to the vertical."""


def plug_between_walls():
    """A world with a plug between two fixed walls, pressed on with sixty times its weight, and one with a box."""
    outline = [(0.05 + SLOPE * 0.05, 0.1), (0.05 - SLOPE * 0.05, 0.0)]
    plug = np.array([(side * x, y, z) for x, z in outline for side in (-1, 1) for y in (-0.05, 0.05)])
    line = [(0.05 + SLOPE * 0.15, 0.2), (0.05 - SLOPE * 0.15, -0.1)]
    builder = ModelBuilder()
    builder.new_world()
    for side in (-1, 1):
        wall = np.array([(side * (x + d), y, z) for x, z in line for d in (0.0, 0.05) for y in (-0.1, 0.1)])
        add_hull(builder, wall, Pose(position=(side * 2e-4, 0, 0.2)), fixed=True)
    add_hull(builder, plug, Pose(position=(0, 0, 0.2)), density=4000.0)
    builder.new_world()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.0503)))
    return builder.finalize("cpu")


def narrowest(model, settled):
    """Least distance between the plug at its rigid pose and a wall [m]."""
    pose = poses_from_states(model, settled.q)[2]
    corners = pose.apply(model.vertex_rest.numpy()[model.vertex_body.numpy() == 2] + model.centres[2])
    normal = np.array([-np.cos(SLOPE), 0, np.sin(SLOPE)])
    return min(((corners * (side, 1, 1) - (0.05 + 2e-4, 0, 0.25)) @ normal).min() for side in (-1, 1))


@pytest.fixture(scope="module")
def bent():
    """The plug as one polish leaves it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(straightening, "TIMES", 0)
        return settle(plug_between_walls(), SettleOptions(friction=0.0))


def test_a_wedged_body_is_straightened_until_its_rigid_pose_keeps_the_gap(bent):
    model = plug_between_walls()
    straight = settle(model, SettleOptions(friction=0.0))
    assert straight.at_rest.all()
    assert straight.residual.max() < 1e-6
    reach = SettleOptions().final_d_hat
    assert narrowest(model, bent) < 0.0
    assert reach / 3 < narrowest(model, straight) < reach
    np.testing.assert_array_equal(straight.q[3], bent.q[3], "the box, which is not bent, is left as it was")


def test_a_world_that_finds_no_rest_when_stiffer_stays_as_it_was(bent, monkeypatch):
    monkeypatch.setattr(straightening, "STIFFER", np.nan)
    settled = settle(plug_between_walls(), SettleOptions(friction=0.0))
    np.testing.assert_array_equal(settled.q, bent.q)
    assert settled.at_rest.all()
