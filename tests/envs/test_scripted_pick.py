"""The scripted hand on a servo that notes where it is sent: over the object, down, closed, up."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.envs.grasping import scripted
from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.grasping.scripted import CLOSE_STEPS, LIFT, POSITION_STEP, ScriptedPick, Servo
from pat3d.errors import EnvironmentSetupError

TIP = 0.012
GRASPS = {
    "cup": tuple(Grasp(position=(0.3, y, 0.05), closing=0.4, bite=0.02, score=1.0, width=0.03) for y in (0.1, 0.2)),
    "pen": (),
}
AT = np.array([0.3, 0.1, 0.05 + TIP])
OVER = AT + [0.0, 0.0, HOVER]


def env_of(control: str = "osc", **state):
    return SimpleNamespace(
        control=control,
        robot="arm",
        placement=SimpleNamespace(grasps=GRASPS, yaw=state.pop("yaw", 0.0)),
        simulation=SimpleNamespace(
            whole=lambda action, side: action,
            state=SimpleNamespace(hand=np.zeros(3), hand_rotation=np.diag([1.0, -1.0, -1.0]), **state),
        ),
    )


@pytest.fixture(autouse=True)
def gripper(monkeypatch):
    made = SimpleNamespace(closing_axis=(0.0, 1.0, 0.0), tip=TIP)
    monkeypatch.setattr(scripted, "measure_gripper", lambda robot: made)


class Follower:
    """Is as far from where it is sent as one says, time after time."""

    def __init__(self, errors) -> None:
        self._errors, self.sent = iter(errors), []

    def towards(self, position, rotation, fingers):
        self.sent.append((*np.round(position, 12).tolist(), fingers))
        return np.zeros(7, dtype=np.float32), next(self._errors)


def sent(errors) -> list[tuple[float, ...]]:
    pick = ScriptedPick(env_of(), "cup")
    pick._servo = follower = Follower(errors)  # type: ignore[assignment]
    for _ in errors:
        pick.action()
    return follower.sent


def test_it_hovers_within_twelve_millimetres_descends_within_four_closes_and_lifts():
    """Open until it is there; however far the fingers push the hand while they close or lift, it goes on."""
    over, at, up = ((*np.round(place, 12).tolist(),) for place in (OVER, AT, AT + [0.0, 0.0, LIFT]))
    steps = [
        *((0.5, (*over, -1.0)), (0.0121, (*over, -1.0)), (0.0119, (*over, -1.0))),
        *((0.0119, (*at, -1.0)), (0.0041, (*at, -1.0)), (0.0039, (*at, -1.0))),
        *(CLOSE_STEPS * [(0.5, (*at, 1.0))]),
        *(3 * [(0.0, (*up, 1.0))]),
    ]
    assert sent([error for error, _ in steps]) == [place for _, place in steps]


def test_the_next_grasp_is_tried_by_the_next_attempt_round_and_round():
    for attempt, y in ((0, 0.1), (1, 0.2), (2, 0.1), (5, 0.2)):
        pick = ScriptedPick(env_of(), attempt=attempt)
        pick._servo = follower = Follower([1.0])  # type: ignore[assignment]
        pick.action()
        assert follower.sent[0][1] == y


def test_other_control_and_objects_without_a_grasp_are_refused():
    with pytest.raises(EnvironmentSetupError, match='needs control="osc", not "joint_position"'):
        ScriptedPick(env_of("joint_position"), "cup")
    for name in ("pen", "hat"):
        with pytest.raises(EnvironmentSetupError, match=f'no grasp of "{name}" is known.*: cup, pen'):
            ScriptedPick(env_of(), name)


@pytest.mark.parametrize("yaw", [0.0, 0.7, -2.0])
def test_a_servo_s_error_is_the_way_in_metres_and_five_centimetres_a_radian(yaw):
    """Its action is that way in the frame of the robot's base, twice as far as a step of the controller goes."""
    env = env_of(yaw=yaw)
    way, turn = np.array([0.003, -0.004, 0.012]), 0.2
    about_z = np.array([[math.cos(turn), -math.sin(turn), 0.0], [math.sin(turn), math.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    action, error = Servo(env).towards(way, about_z @ env.simulation.state.hand_rotation, -1.0)
    assert error == pytest.approx(0.013 + 0.05 * turn)
    c, s = math.cos(yaw), math.sin(yaw)
    base = [c * way[0] + s * way[1], c * way[1] - s * way[0], way[2]]
    np.testing.assert_allclose(action[:3], 2.0 * np.array(base) / POSITION_STEP, atol=1e-6)
    np.testing.assert_allclose(action[3:], [0.0, 0.0, turn / 0.5, -1.0], atol=1e-6)
