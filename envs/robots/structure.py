"""Which parts of a MJCF are the arm, the hand and its actuators, found by the tree of bodies.

From the root on, bodies that carry one moving body only make up the arm; the first that carries several is the hand,
and what it carries are the fingers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pat3d.envs.robots.description import Description
from pat3d.errors import EnvironmentSetupError


@dataclass(frozen=True, kw_only=True)
class Parts:
    """Of a robot, as MuJoCo's numbers."""

    arm_joints: tuple[int, ...]
    hand: int
    """The body that carries the fingers."""
    gripper_joints: tuple[int, ...]
    arm_actuators: tuple[int, ...]
    gripper_actuators: tuple[int, ...]


def find_parts(model: Any, told: Description) -> Parts:
    """The parts of a compiled robot.

    Raises:
        EnvironmentSetupError: something is missing; says what, what there is, and how to name it.
    """
    import mujoco

    moving = _carries_joints(model)
    hand, chain = 0, []
    while True:
        chain += range(model.body_jntadr[hand], model.body_jntadr[hand] + model.body_jntnum[hand])
        ahead = [body for body in range(1, model.nbody) if model.body_parentid[body] == hand and moving[body]]
        if len(ahead) != 1 or model.body(hand).name == told.hand:
            break
        hand = ahead[0]
    if told.arm_joints:
        chain = [_named(model, told, "joint", name) for name in told.arm_joints]
    if told.hand:
        hand = _named(model, told, "body", told.hand)
    rest = [joint for joint in range(model.njnt) if _within(model, int(model.jnt_bodyid[joint]), hand)]
    fingers = tuple(joint for joint in rest if joint not in chain)
    if not chain or any(model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_HINGE for joint in chain):
        raise _missing(told, "no arm: hinges one after the other from the base", "arm_joints", _names(model, "joint"))
    if not fingers:
        raise _missing(
            told,
            "no fingers: bodies that move on the hand",
            "gripper (2f85, panda_hand) or hand",
            _names(model, "body"),
        )
    driven = {number: _driven(model, number) for number in range(model.nu)}
    gripper = tuple(number for number, joints in driven.items() if joints & set(fingers))
    if told.gripper_actuators:
        gripper = tuple(_named(model, told, "actuator", name) for name in told.gripper_actuators)
    if not gripper or not all(model.actuator_ctrllimited[number] for number in gripper):
        raise _missing(
            told, "no actuator with a ctrlrange that drives the fingers", "gripper_actuators", _names(model, "actuator")
        )
    return Parts(
        arm_joints=tuple(chain),
        hand=hand,
        gripper_joints=fingers,
        arm_actuators=tuple(number for number in driven if number not in gripper),
        gripper_actuators=gripper,
    )


def torque_limits(model: Any, parts: Parts, told: Description) -> list[float]:
    """Largest torque of every joint of the arm [N m].

    Raises:
        EnvironmentSetupError: the file limits neither the joint nor its actuator, and nothing is said.
    """
    if told.torques:
        if len(told.torques) != len(parts.arm_joints):
            raise EnvironmentSetupError(
                f"{told.name}: {len(told.torques)} torques, {len(parts.arm_joints)} arm joints."
            )
        return list(told.torques)
    limits = []
    for joint in parts.arm_joints:
        found = [np.inf]
        if model.jnt_actfrclimited[joint]:
            found.append(float(model.jnt_actfrcrange[joint, 1]))
        for number in parts.arm_actuators:
            if joint in _driven(model, number):
                gear = abs(float(model.actuator_gear[number, 0]))
                if model.actuator_forcelimited[number]:
                    found.append(gear * float(model.actuator_forcerange[number, 1]))
                elif model.actuator_ctrllimited[number] and not model.actuator_biastype[number]:
                    gain = float(model.actuator_gainprm[number, 0])
                    found.append(gear * gain * float(model.actuator_ctrlrange[number, 1]))
        limits.append(min(found))
    if not np.isfinite(limits).all():
        names = [
            model.joint(joint).name for joint, most in zip(parts.arm_joints, limits, strict=True) if most == np.inf
        ]
        raise _missing(told, "no largest torque of an arm joint", "torques", names)
    return limits


def _carries_joints(model: Any) -> list[bool]:
    found = [bool(count) for count in model.body_jntnum]
    for body in range(model.nbody - 1, 0, -1):
        found[model.body_parentid[body]] |= found[body]
    return found


def _within(model: Any, body: int, ancestor: int) -> bool:
    while body > ancestor:
        body = int(model.body_parentid[body])
    return body == ancestor


def _driven(model: Any, actuator: int) -> set[int]:
    """Joints that an actuator moves, by itself or through a tendon."""
    import mujoco

    kind, target = int(model.actuator_trntype[actuator]), int(model.actuator_trnid[actuator, 0])
    if kind in (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT):
        return {target}
    if kind == mujoco.mjtTrn.mjTRN_TENDON:
        wraps = range(model.tendon_adr[target], model.tendon_adr[target] + model.tendon_num[target])
        joint = mujoco.mjtWrap.mjWRAP_JOINT
        return {int(model.wrap_objid[wrap]) for wrap in wraps if model.wrap_type[wrap] == joint}
    return set()


def _named(model: Any, told: Description, what: str, name: str) -> int:
    try:
        return int(getattr(model, what)(name).id)
    except KeyError:
        names = ", ".join(_names(model, what))
        raise EnvironmentSetupError(f'{told.name}: no {what} "{name}". There are: {names}.') from None


def _names(model: Any, what: str) -> list[str]:
    count = {"joint": model.njnt, "body": model.nbody, "actuator": model.nu}[what]
    return [getattr(model, what)(number).name for number in range(count)]


def _missing(told: Description, what: str, key: str, there: list[str]) -> EnvironmentSetupError:
    return EnvironmentSetupError(
        f"{told.name}: {what} found. Name them under {key} in {told.mjcf.with_suffix('.yaml').name}. "
        f"There are: {', '.join(there) or 'none'}."
    )
