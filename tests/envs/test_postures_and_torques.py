"""Start postures on arms that reach what one wants, and the largest torques of motors of every kind."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mujoco
import numpy as np
import pytest

from pat3d.envs.robots import posture
from pat3d.envs.robots.description import Description
from pat3d.envs.robots.posture import FORWARD, LOWER, TRIES, UPWARD, start_posture
from pat3d.envs.robots.structure import Parts, torque_limits
from pat3d.errors import EnvironmentSetupError

LENGTH = 2.0
LOW, HIGH = np.array([-3.0, -1.0, 0.0]), np.array([3.0, 2.0, 4.0])


@dataclass(frozen=True)
class Robot:
    name: str = "arm"
    home: Any = None
    new_spec: Any = field(default=lambda: SimpleNamespace(compile=lambda: None))


class Arm:
    """Reaches places by a rule, with the joints that it starts from, and is as able as one says."""

    length = LENGTH
    limits = LOW, HIGH

    def __init__(self, reaches=lambda place: True, *, able=1.0, margin=lambda joints: 1.0, height=1.0, itself=False):
        self.reaches, self.able, self.margin = reaches, able, margin
        self.height, self.itself = height, itself
        self.asked: list[tuple[Any, Any, Any]] = []

    def solve(self, place, rotation, start):
        self.asked.append((place, rotation, start))
        return start if self.reaches(place) else None

    def jacobian(self, joints):
        """Of orthogonal columns whose shortest is `able` long."""
        turn = np.linalg.qr(np.random.default_rng(0).normal(size=(6, 6)))[0]
        return turn @ np.diag([3.0, self.able, 2.0, 5.0, 4.0, 9.0])

    def heights(self, joints):
        return np.array([self.height + 0.3, self.height, self.height + 0.1])

    def touches_itself(self, joints) -> bool:
        return self.itself


def start_of(arm: Arm, monkeypatch, known=()):
    monkeypatch.setattr(posture, "ArmKinematics", lambda robot, model: arm)
    return start_posture(Robot(), list(known)).home  # type: ignore[arg-type]


def places_of(arm: Arm) -> list[tuple[float, ...]]:
    """The places asked for in their order, each once."""
    return list(dict.fromkeys(tuple(np.round(place, 9).tolist()) for place, _, _ in arm.asked))


PLACES = [
    *((share * LENGTH * FORWARD, 0.0, share * LENGTH * UPWARD) for share in (1.0, 0.85, 0.7)),
    *((LENGTH * FORWARD, 0.0, LENGTH * lower) for lower in LOWER),
]


@pytest.mark.parametrize("which", range(len(PLACES)))
def test_the_hand_starts_as_far_ahead_as_it_gets_and_lower_only_where_it_must(which, monkeypatch):
    """In shares of the arm's length; where one place is reached no other is asked for."""
    arm = Arm(lambda place: np.allclose(place, PLACES[which]))
    start_of(arm, monkeypatch)
    np.testing.assert_allclose(places_of(arm), PLACES[: which + 1])


def test_an_arm_that_cannot_point_down_is_refused_with_its_length(monkeypatch):
    arm = Arm(lambda place: False)
    with pytest.raises(EnvironmentSetupError, match=r"^arm: .*, 2\.00 m long as it is\.$"):
        start_of(arm, monkeypatch)
    np.testing.assert_allclose(places_of(arm), PLACES)


def test_postures_of_the_file_are_tried_first_turned_by_quarters_then_the_middle_then_any(monkeypatch):
    """Each with the hand down, closing to the left and to the right."""
    arm = Arm()
    known = [np.array([1.0, 5.0, 3.0]), np.array([-2.0, 0.5, -1.0])]
    start_of(arm, monkeypatch, known)
    starts = [start for _, _, start in arm.asked[::2]]
    assert len(starts) == 2 * 4 + 1 + TRIES
    quarters = (0.0, np.pi / 2, -np.pi / 2, np.pi)
    expected = [np.clip(one + [turn, 0.0, 0.0], LOW, HIGH) for one in known for turn in quarters]
    np.testing.assert_allclose(starts[:9], [*expected, (LOW + HIGH) / 2])
    assert ((starts >= LOW) & (starts <= HIGH)).all()
    assert len(np.unique(starts[9:], axis=0)) == TRIES
    for number, (_, rotation, _) in enumerate(arm.asked):
        np.testing.assert_array_equal(rotation[:, 2], [0.0, 0.0, -1.0])
        np.testing.assert_array_equal(rotation[:, 1], [0.0, (-1.0) ** number, 0.0])
        assert np.linalg.det(rotation) == pytest.approx(1.0)


def test_of_all_postures_the_worthiest_is_taken(monkeypatch):
    """The one furthest from its limits; at equal margins the one least wound up."""
    known = [np.array([0.3, 0.2, 0.1]), np.array([0.2, 0.1, 0.3])]
    arm = Arm(margin=lambda joints: 0.9 if np.allclose(joints, known[1]) else 0.1)
    np.testing.assert_array_equal(start_of(arm, monkeypatch, known), known[1])
    flat = Arm()
    starts = start_of(flat, monkeypatch, known), [start for _, _, start in flat.asked]
    assert np.abs(starts[0]).max() == min(np.abs(start).max() for start in starts[1])


def test_while_every_posture_touches_itself_others_are_looked_for_and_the_best_is_taken(monkeypatch):
    arm = Arm(itself=True)
    assert start_of(arm, monkeypatch) is not None
    np.testing.assert_allclose(places_of(arm), PLACES)


@pytest.mark.parametrize(
    ("about", "expected"),
    [
        ({}, 1.0 + 0.8 + 1.0),
        # Beyond a radian from the limits, and beyond a fifth of ability, there is nothing to gain.
        ({"margin": lambda joints: 1.5}, 2.8),
        ({"margin": lambda joints: 0.4}, 2.2),
        ({"able": 0.2}, 2.8),
        ({"able": 0.3}, 2.8),
        ({"able": 0.15}, 2.6),
        ({"able": 0.0}, 2.0),
        ({"height": 0.25}, 2.05),
        ({"itself": True}, -7.2),
    ],
)
def test_a_posture_is_worth_its_margin_ability_and_height_less_what_it_is_wound_up(about, expected):
    arm = Arm(**about)
    assert posture._worth(arm, np.zeros(6)) == pytest.approx(expected)  # type: ignore[arg-type]
    assert posture._worth(arm, np.array([2.0, -4.0])) == pytest.approx(expected - 0.2)  # type: ignore[arg-type]


def test_an_arm_of_five_joints_counts_as_half_able():
    """Its hand cannot turn every way anyhow."""
    arm = Arm()
    arm.jacobian = lambda joints: np.ones((6, 5))  # type: ignore[method-assign]
    assert posture._worth(arm, np.zeros(5)) == pytest.approx(1.0 + 0.4 + 1.0)  # type: ignore[arg-type]


JOINTS = {
    "force": ("", '<motor joint="force" gear="-3" forcerange="-5 5"/>', 15.0),
    "control": ("", '<motor joint="control" gear="2" ctrlrange="-7 7"/>', 14.0),
    "gain": ('actuatorfrcrange="-90 90"', '<general joint="gain" gainprm="4" ctrlrange="-3 3"/>', 12.0),
    "joint": ('actuatorfrcrange="-9 9"', '<motor joint="joint" ctrlrange="-20 20"/>', 9.0),
    # What a position actuator is told is a position.
    "place": ('actuatorfrcrange="-40 40"', '<position joint="place" kp="100" ctrlrange="-3 3"/>', 40.0),
    "both": ("", '<motor joint="both" forcerange="-8 8"/><motor joint="both" forcerange="-6 6"/>', 6.0),
    "first": ("", '<motor joint="first" forcerange="-11 11" ctrlrange="-2 2"/>', 11.0),
}
"""Attributes of a joint, its motors, and its largest torque [N m]."""

TOLD = Description(name="own", mjcf=Path("own.xml"))


def limited(**joints) -> tuple[Any, Parts]:
    """An arm of such joints, with its motors in the opposite order."""
    body = '<geom size="0.1"/>'
    for name, (attributes, _, _) in reversed(joints.items()):
        body = f'<body><joint name="{name}" {attributes}/><geom size="0.1"/>{body}</body>'
    motors = "".join(motor for _, motor, _ in reversed(joints.values()))
    text = f"<mujoco><worldbody>{body}</worldbody><actuator>{motors}</actuator></mujoco>"
    model = mujoco.MjModel.from_xml_string(text)
    parts = Parts(
        arm_joints=tuple(range(model.njnt)),
        hand=model.nbody - 1,
        gripper_joints=(),
        arm_actuators=tuple(range(model.nu)),
        gripper_actuators=(),
    )
    return model, parts


def test_the_largest_torque_of_a_joint_is_that_of_its_own_motors_or_its_own():
    """The least of a motor's force or control, times its gear and gain, and of the joint's range of force."""
    model, parts = limited(**JOINTS)
    assert torque_limits(model, parts, TOLD) == [most for _, _, most in JOINTS.values()]
    told = Description(name="own", mjcf=Path("own.xml"), torques=tuple(float(k) for k in range(len(JOINTS))))
    assert torque_limits(model, parts, told) == list(told.torques)


def test_joints_without_a_largest_torque_are_named_and_so_many_are_needed_as_there_are():
    model, parts = limited(
        **JOINTS,
        free=("", '<motor joint="free"/>', None),
        loose=("", '<position joint="loose" ctrlrange="0 1"/>', None),
    )
    with pytest.raises(EnvironmentSetupError, match=r"own: no largest torque of an arm joint.* free, loose\.") as told:
        torque_limits(model, parts, TOLD)
    assert not any(name in str(told.value).split("There are")[-1] for name in JOINTS)
    with pytest.raises(EnvironmentSetupError, match=r"^own: 2 torques, 9 arm joints\.$"):
        torque_limits(model, parts, Description(name="own", mjcf=Path("own.xml"), torques=(1.0, 2.0)))
