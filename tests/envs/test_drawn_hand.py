"""A hand of boxes drawn for its measures: two fingers of unlike thickness with a back plate and a knuckle each."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from pat3d.envs.robots.description import Description
from pat3d.envs.robots.fingers import SLICE, find_grip, measure
from pat3d.envs.robots.fingers import _inner as inner
from pat3d.envs.robots.structure import find_parts
from tests.envs.own_arm import jaw_arm, own_arm
from tests.envs.test_fingers import CUBE, OCTAHEDRON, names

HALF_OPEN, STROKE = 0.035, 0.03
"""From the middle to either pad, open, and what each finger moves [m]."""

LONG, SITE, KNUCKLE = 0.06, 0.048, 0.0315
"""Heights above the hand's frame of the fingertips, the grip site and the upper sides of the knuckles [m]."""

PLATE = 0.002
"""Behind either pad [m]."""


JAW = jaw_arm().replace("-1.7 0.2", "-0.7 0.2")
"""One jaw that opens by 0.7 rad; further it points aside, and its tip is behind that of the fixed one."""


def box(name: str, x: float, y: tuple[float, float], z: tuple[float, float]) -> str:
    return (
        f'<geom name="{name}" type="box" size="{x} {(y[1] - y[0]) / 2} {(z[1] - z[0]) / 2}" '
        f'pos="0 {sum(y) / 2} {sum(z) / 2}"/>'
    )


def finger(name: str, sign: float, pad: float) -> str:
    """With its pad at 3.5 cm, so thick without its plate, and a knuckle that reaches 3 mm further in."""

    def side(low: float, high: float) -> tuple[float, float]:
        a, b = sign * (HALF_OPEN + low), sign * (HALF_OPEN + high)
        return min(a, b), max(a, b)

    boxes = (
        box(f"{name}_pad", 0.01, side(0.0, pad), (0.02, LONG)),
        box(f"{name}_plate", 0.007, side(pad, pad + PLATE), (0.02, LONG)),
        box(f"{name}_knuckle", 0.006, side(-0.003, 0.0), (0.02, KNUCKLE)),
    )
    return f"""<body name="{name}"><joint name="{name}" type="slide" axis="0 {-sign} 0" damping="20"/>
      {"".join(boxes)}</body>"""


def measured(left: float, right: float):
    """The measures of a hand somewhere in the world, with pads so thick."""
    text = f"""<mujoco><compiler angle="radian"/><option gravity="0 0 0"/><worldbody>
      <body name="hand" pos="0.3 -0.1 0.5" euler="0.4 -0.8 1.9"><joint name="arm"/>
        <geom name="palm" type="box" size="0.025 0.07 0.02" pos="0 0 -0.01" mass="1"/>
        <site name="grip" pos="0 0 {SITE}"/>
        {finger("left", -1.0, left)}{finger("right", 1.0, right)}
      </body></worldbody><actuator>
        <position joint="left" kp="2000" name="left" ctrlrange="0 {STROKE}"/>
        <position joint="right" kp="2000" name="right" ctrlrange="0 {STROKE}"/>
      </actuator></mujoco>"""
    robot = SimpleNamespace(
        arm_joints=["arm"],
        home=[0.3],
        gripper_joints=["left", "right"],
        gripper_home=[0.0, 0.0],
        gripper_actuators=["left", "right"],
        grip_site="grip",
        fingers=[[f"{name}_{part}" for part in ("plate", "pad", "knuckle")] for name in ("left", "right")],
        new_drive=lambda: SimpleNamespace(format_action=lambda action: action),
    )
    return measure(robot, mujoco.MjModel.from_xml_string(text))  # type: ignore[arg-type]


@pytest.mark.parametrize(("left", "right"), [(0.008, 0.005), (0.004, 0.009), (0.006, 0.006)])
def test_a_hand_is_measured_as_it_was_drawn(left, right):
    found = measured(left, right)
    assert found.opening == pytest.approx(2 * HALF_OPEN, abs=1e-5)
    assert found.closed == pytest.approx(2 * (HALF_OPEN - STROKE), abs=1e-5)
    # Both fingers need the room of the thicker one.
    assert found.finger_thickness == pytest.approx(max(left, right) + PLATE, abs=1e-5)
    assert found.finger_width == pytest.approx(0.02)
    assert found.tip == pytest.approx(LONG - SITE)
    assert found.palm == pytest.approx(LONG - 0.01)
    assert found.hand == pytest.approx((0.14, 0.05))
    # The pads end, and the room between them narrows, in the slice in which the knuckles begin.
    assert found.pad == pytest.approx(math.floor((LONG - KNUCKLE) / SLICE) * SLICE)
    assert found.throat == pytest.approx(found.pad)
    assert found.open_joints == pytest.approx((0.0, 0.0), abs=1e-5)
    assert found.closed_joints == pytest.approx((STROKE, STROKE), abs=1e-5)


def test_of_several_geoms_of_a_finger_the_innermost_counts_on_either_side():
    """A tilted square and a cube beside one another on each side; either may be further in."""
    low, high = OCTAHEDRON - [0.0, 2.0, 0.0], OCTAHEDRON + [0.0, 2.0, 0.0]
    for away in (5.0, 2.5):
        sides = [[low, CUBE - [0.0, away, 0.0]], [high, CUBE + [0.0, away, 0.0]]]
        for order in (1, -1):
            found = inner([side[::order] for side in sides], 0.5, 0.7)
            assert found == pytest.approx((-min(1.5, away - 1.0), min(1.5, away - 1.0)))


def grip_of(text: str, hand: str):
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.gravity[:] = 0.0
    told = Description(name="drawn", mjcf=Path("drawn.xml"), hand=hand)
    return model, find_grip(model, find_parts(model, told), told)


@pytest.mark.parametrize(("text", "hand"), [(JAW, "palm"), (own_arm(), "link7")], ids=["jaw", "fingers"])
@pytest.mark.parametrize("place", ['pos="0 0 -5"', 'pos="3 -2 1" euler="1.2 -0.7 2.1"', 'euler="0 3.1 0"'])
def test_where_a_robot_stands_and_how_changes_nothing_of_its_grip(text, hand, place):
    """In the frame of the hand; which finger comes first may change with the sign of the closing direction."""
    assert text.count('<body name="base">') == 1
    model, here = grip_of(text, hand)
    _, there = grip_of(text.replace('<body name="base">', f'<body name="base" {place}>'), hand)
    np.testing.assert_allclose(there.position, here.position, atol=1e-6)
    sign = float(np.sign(here.rotation[:, 1] @ there.rotation[:, 1]))
    np.testing.assert_allclose(there.rotation * [sign, sign, 1.0], here.rotation, atol=1e-5)
    sides = [names(model, side) for side in there.fingers]
    assert sides[:: int(sign)] == [names(model, side) for side in here.fingers]
    assert there.closing == here.closing


def test_the_fixed_jaw_is_what_ends_as_far_ahead_as_the_moving_one_and_no_more_than_the_hand():
    model, grip = grip_of(JAW, "palm")
    assert sorted(sorted(names(model, side)) for side in grip.fingers) == [["fixed"], ["moving"]]
