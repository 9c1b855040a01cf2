"""What a robot would touch, on balls on rails whose distances are known."""

from __future__ import annotations

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from pat3d.envs.physics.clearance import DEPTH, NOTICED, Clearance
from pat3d.envs.physics.world import FLOOR, PREFIX, ROBOT, SUPPORT

RADIUS = 0.05
BALLS = """
<mujoco>
  <option gravity="0 0 0"/>
  <worldbody>
    <geom name="floor" type="plane" size="9 9 1" pos="0 0 -1"/>
    <geom name="support" type="box" size="0.1 0.1 0.1" pos="0 3 0"/>
    <body><joint name="robot/x" type="slide" axis="1 0 0"/><joint name="robot/y" type="slide" axis="0 1 0"/>
      <geom name="arm" size="0.05"/>
      <geom name="shown" size="0.5" contype="0" conaffinity="0"/>
      <body pos="0 0 0.5"><joint name="robot/finger" type="slide" axis="1 0 0"/><geom name="finger" size="0.05"/></body>
    </body>
    <body pos="1 0 0"><freejoint/><geom name="mug" size="0.05" {mug}/><geom size="0.3" contype="0" conaffinity="0"/>
    </body>
    <body pos="2 0 0"><freejoint/><geom name="bowl" size="0.05" {bowl}/></body>
  </worldbody>
</mujoco>"""


def balls(mug: str = "", bowl: str = "") -> Clearance:
    """An arm of one ball on two rails and a finger 50 cm above, a mug at x = 1 and a bowl at x = 2 [m]."""
    model = mujoco.MjModel.from_xml_string(BALLS.format(mug=mug, bowl=bowl))
    data = mujoco.MjData(model)
    named = {"floor": FLOOR, "support": SUPPORT, "arm": ROBOT, "shown": ROBOT, "finger": ROBOT, "mug": 0, "bowl": 1}
    # The drawn shell of the mug has no name.
    owner = np.array([named.get(model.geom(number).name, 0) for number in range(model.ngeom)])
    world = SimpleNamespace(
        model=model,
        robot=SimpleNamespace(arm_joints=("x", "y"), gripper_joints=("finger",)),
        scene=SimpleNamespace(objects=[SimpleNamespace(name="mug"), SimpleNamespace(name="bowl")]),
        owner=owner,
        idle=np.zeros(model.ngeom, dtype=bool),
        prefix=PREFIX,
        objects=("mug", "bowl"),
        positions=np.array([3, 10]),
    )
    return Clearance(SimpleNamespace(simulation=SimpleNamespace(world=world, data=data)))


def posture(x: float, y: float = 0.0, finger: float = 0.0):
    return np.array([x, y]), np.array([finger])


KINDS = [("", ""), ('contype="1" conaffinity="0"',) * 2, ('contype="0" conaffinity="1"',) * 2]
"""A geom may collide by what it is or by what it is open to."""


@pytest.mark.parametrize(("mug", "bowl"), KINDS)
def test_the_distance_of_a_ball_is_that_of_the_centres_less_both_radii(mug, bowl):
    """Up to what is noticed; what is only drawn is nowhere."""
    clearance = balls(mug, bowl)
    for gap in (0.002, 0.0055, 0.0079, -0.001):
        assert clearance.distance(*posture(0.9 - gap)) == pytest.approx(gap, abs=1e-6)
        assert clearance.distance(*posture(1.0, 0.1 + gap)) == pytest.approx(gap, abs=1e-6)
        # The finger goes by itself, and the nearest of all counts.
        assert clearance.distance(*posture(1.9 - gap)) == pytest.approx(gap, abs=1e-6)
    for away in (0.9 - NOTICED - 1e-6, 0.5, -3.0):
        assert clearance.distance(*posture(away)) == NOTICED


def test_what_is_carried_has_no_distance_and_everything_else_has():
    clearance = balls()
    assert clearance.distance(*posture(0.898)) == pytest.approx(0.002, abs=1e-6)
    assert clearance.distance(*posture(0.898), "mug") == NOTICED
    assert clearance.distance(*posture(1.898), "mug") == pytest.approx(0.002, abs=1e-6)


@pytest.mark.parametrize(("mug", "bowl"), KINDS)
def test_an_obstacle_is_what_the_robot_is_in_by_more_than_two_millimetres(mug, bowl):
    clearance = balls(mug, bowl)
    assert clearance.obstacle(*posture(0.9 + DEPTH - 1e-5)) == ""
    assert clearance.obstacle(*posture(0.9 + DEPTH + 1e-5)) == "mug"
    assert clearance.obstacle(*posture(2.0)) == "bowl"
    assert clearance.obstacle(*posture(0.0, 3.0)) == "ground"
    assert clearance.obstacle(*posture(0.0, 1.0)) == ""


def test_what_is_carried_is_no_obstacle_and_meets_its_own_when_it_is_moved_along():
    clearance = balls()
    assert clearance.obstacle(*posture(1.0), "mug") == ""
    onto, beside = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.5, 0.0])
    # Moved onto the bowl, and the robot with it or not.
    assert clearance.obstacle(*posture(0.0), "mug", onto) == "bowl"
    assert clearance.obstacle(*posture(0.0), "mug", beside) == ""
    assert clearance.obstacle(*posture(2.0), "mug", beside) == "bowl"
    assert clearance.obstacle(*posture(1.0, 0.5), "mug", beside) == ""
    # Where it is now plays no part, and the state stays as it is.
    assert clearance.obstacle(*posture(1.0), "mug", beside) == ""
    assert clearance.obstacle(*posture(1.0)) == "mug"
    # Without a move what is carried may be in anything.
    clearance._simulation.data.qpos[3] = 2.0
    assert clearance.obstacle(*posture(0.0), "mug") == ""


def test_an_object_fits_where_it_is_in_nothing_but_the_robot():
    clearance = balls()
    for shift, fits in (
        ((0.0, 0.0, 0.0), True),
        ((0.9 + DEPTH - 1e-5, 0.0, 0.0), True),
        ((0.9 + DEPTH + 1e-5, 0.0, 0.0), False),
        ((-1.0, 0.0, 0.0), True),
        ((-1.0, 3.0, 0.0), False),
        ((0.0, 0.0, -0.951), True),
        ((0.0, 0.0, -0.953), False),
    ):
        assert clearance.fits("mug", np.array(shift)) == fits
    # Two others in one another are not its concern.
    clearance._simulation.data.qpos[10] = 0.0
    clearance._simulation.data.qpos[0] = 0.0
    assert clearance.fits("mug", np.zeros(3))
