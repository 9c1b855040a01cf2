"""A robot put into a scene: what is drawn of it, where it stands, and what it may not touch in its start posture."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import mujoco
import numpy as np
import pytest

from pat3d.envs.physics.simulation import Simulation
from pat3d.envs.physics.world import PREFIX, ROBOT, SUPPORT, Mounted, _attach
from pat3d.errors import EnvironmentSetupError

ARM = """<mujoco><compiler angle="radian"/><option timestep="0.004" gravity="0 0 -3"/><worldbody><body name="flange">
  <joint name="turn" axis="0 0 1"/>
  <geom name="hull" type="box" size="0.1 0.1 0.1"/>
  <geom name="skin" type="box" size="0.1 0.1 0.1" group="1"/>
  <geom name="paint" type="box" size="0.1 0.1 0.1" group="2" contype="0" conaffinity="0"/>
  <geom name="extra" type="box" size="0.1 0.1 0.1" group="5"/>
  <site name="grip" pos="0 0 0.2" group="1"/>
</body></worldbody></mujoco>"""

ROOM = """<mujoco><option timestep="0.002" gravity="0 0 -9.81"/><worldbody>
  <geom name="ground" type="box" size="1 1 0.1" pos="0 0 -0.1"/>
  <body name="cube" pos="0 0 0.5"><freejoint/><geom name="cube" type="box" size="0.05 0.05 0.05"/></body>
</worldbody></mujoco>"""


def test_a_robot_s_collision_geoms_and_sites_are_hidden_and_its_looks_are_not():
    """Of a robot's file group 0 collides; the scene's own groups stay, and so do its options."""
    spec = mujoco.MjSpec.from_string(ROOM)
    robot = SimpleNamespace(new_spec=lambda: mujoco.MjSpec.from_string(ARM), arm_joints=["turn"])
    _attach(mujoco, spec, robot, SimpleNamespace(base_position=(0.3, -0.2, 0.1), yaw=0.7))
    model = spec.compile()
    groups = {model.geom(geom).name: int(model.geom_group[geom]) for geom in range(model.ngeom)}
    robots = {PREFIX + "hull": 3, PREFIX + "skin": 1, PREFIX + "paint": 2, PREFIX + "extra": 5}
    assert groups == {"ground": 0, "cube": 0, **robots}
    assert model.site(PREFIX + "grip").group[0] == 4
    assert model.opt.timestep == 0.002
    np.testing.assert_array_equal(model.opt.gravity, [0.0, 0.0, -9.81])
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    np.testing.assert_allclose(data.body(PREFIX + "flange").xpos, [0.3, -0.2, 0.1])
    x = data.body(PREFIX + "flange").xmat.reshape(3, 3)[:, 0]
    np.testing.assert_allclose(x, [math.cos(0.7), math.sin(0.7), 0.0], atol=1e-12)
    # The first link, in the ground by its lower half, does not rub on what stands fixed around it.
    assert data.ncon == 0


ARMED = """<mujoco><compiler angle="radian"/><worldbody>
  <geom name="ground" type="box" size="1 1 0.1" pos="0 0 -0.1"/>
  {before}
  <body name="arm" pos="0 0 {height}"><joint name="robot/turn" axis="0 0 1"/>
    <geom name="link" type="box" size="0.2 0.02 0.02" pos="0.2 0 0"/></body>
  {after}
</worldbody></mujoco>"""
THING = (
    '<body name="{name}" pos="{x} {y} 0.3"><freejoint/><geom name="{name}" type="box" size="0.05 0.05 0.05"/></body>'
)
MUG, BOWL = THING.format(name="mug", x=0.0, y=0.3), THING.format(name="bowl", x=0.0, y=-0.3)


def at_start(start: float, *, before: str, after: str, height: float = 0.3):
    """The state at the start of a robot of one link, which points along +x at zero."""
    model = mujoco.MjModel.from_xml_string(ARMED.format(before=before, after=after, height=height))
    owners = {"ground": SUPPORT, "link": ROBOT, "mug": 0, "bowl": 1}
    robot: Any = SimpleNamespace(name="arm", arm_joints=("turn",), gripper_joints=(), gripper_home=())
    world = SimpleNamespace(
        robot=robot,
        arms=(Mounted(robot=robot, prefix=PREFIX, side="", yaw=0.0, start=(start,)),),
        idle=np.zeros(model.ngeom, dtype=bool),
        placement=SimpleNamespace(describe=lambda: "on the ground"),
        owner=np.array([owners[model.geom(geom).name] for geom in range(model.ngeom)]),
        scene=SimpleNamespace(objects=[SimpleNamespace(name="red mug"), SimpleNamespace(name="blue bowl")]),
    )
    made = object.__new__(Simulation)
    made._mujoco, made.world, made.model, made.data = mujoco, world, model, mujoco.MjData(model)
    made._arm = np.array([int(model.joint("robot/turn").qposadr[0])])
    made._signature = int(mujoco.mjtState.mjSTATE_INTEGRATION)
    return made, made._rest()


@pytest.mark.parametrize(("before", "after"), [(MUG + BOWL, ""), ("", MUG + BOWL), (MUG, BOWL), (BOWL, MUG)])
def test_a_robot_that_touches_an_object_at_the_start_is_told_which_in_whatever_order_they_are(before, after):
    for start, name in ((math.pi / 2, "red mug"), (-math.pi / 2, "blue bowl")):
        with pytest.raises(EnvironmentSetupError) as refused:
            at_start(start, before=before, after=after)
        assert str(refused.value) == f'arm touches "{name}" in its start posture (on the ground).'
    made, state = at_start(0.4, before=before, after=after)
    fresh = mujoco.MjData(made.model)
    mujoco.mj_setState(made.model, fresh, state, made._signature)
    assert fresh.joint("robot/turn").qpos == pytest.approx(0.4)
    np.testing.assert_array_equal(np.delete(fresh.qpos, made._arm), np.delete(made.model.qpos0, made._arm))


def test_a_robot_may_touch_what_the_scene_stands_on_and_objects_may_touch_one_another():
    beside = THING.format(name="bowl", x=0.0, y=0.399)
    at_start(0.0, before=MUG + beside, after="")
    made, _ = at_start(0.0, before="", after="", height=0.015)
    assert made.data.ncon
