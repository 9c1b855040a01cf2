"""What a robot's MJCF does not say by itself: which parts of it are the arm, the hand and the fingers.

All of it is found by structure where it can be (`pat3d.envs.robots.structure`); a small YAML file beside one's own MJCF
names what cannot:

    mjcf: arm.xml               # the file; PATH.xml with PATH.yaml beside it need not say so
    gripper: 2f85               # of the table, or a MJCF file, where arm and gripper are apart
    attach: attachment_site     # the site of the arm that carries the gripper
    root: left_base             # of a file with several arms, the body with which this one begins
    arm_joints: [j1, j2, j3]    # hinges from the base to the hand
    hand: palm                  # the body that carries the fingers
    gripper_actuators: [grip]
    torques: [87, 87, 12]       # of the arm's joints [N m], where the MJCF does not limit them
    payload: 3.0                # [kg]
    grip_stiffness: 100         # factor, where the gripper hardly presses
    grip_armature: 0.01         # of the finger joints [kg m^2], where the gripper trembles
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from pat3d.errors import EnvironmentSetupError

PAYLOAD = 2.0
"""Of an arm of which nothing is said [kg]."""


@dataclass(frozen=True, kw_only=True)
class Description:
    """A robot's files, and what is said about them."""

    name: str
    mjcf: Path
    gripper: Path | None = None
    attach: str = "attachment_site"
    root: str = ""
    arm_joints: tuple[str, ...] = ()
    hand: str = ""
    gripper_actuators: tuple[str, ...] = ()
    torques: tuple[float, ...] = ()
    payload: float = PAYLOAD
    grip_stiffness: float = 1.0
    """By how much the gripper's actuators are stiffer than their file says: some press with less than 1 N."""
    grip_armature: float = 0.0
    """Of the finger joints [kg m^2], with actuators that are critically damped; 0 for what the file says.

    A damped actuator at its largest force is damped no more. Where the fingers are so light that a time step of that
    force makes them faster than the damping allows, they tremble instead of closing.
    """


def read_description(path: Path, grippers: Mapping[str, Any]) -> Description:
    """The description of one's own robot: PATH.xml, with PATH.yaml beside it or not, or PATH.yaml.

    Args:
        path: of either file.
        grippers: by name, functions that give their MJCF file.

    Raises:
        EnvironmentSetupError: a file is missing or says what is not understood; says what is.
    """
    told = path if path.suffix != ".xml" else path.with_suffix(".yaml")
    said: dict[str, Any] = {}
    if told.is_file():
        import yaml

        try:
            said = yaml.safe_load(told.read_text(encoding="utf-8")) or {}
        except yaml.YAMLError as error:
            raise EnvironmentSetupError(f"{told}: {error}") from error
    valid = [field.name for field in fields(Description) if field.name != "name"]
    if not isinstance(said, dict) or set(said) - set(valid):
        unknown = ", ".join(sorted(set(said) - set(valid))) if isinstance(said, dict) else "no mapping"
        raise EnvironmentSetupError(f"{told}: {unknown} is not understood. Keys: {', '.join(valid)}.")
    mjcf = told.parent / said["mjcf"] if "mjcf" in said else path.with_suffix(".xml")
    if not mjcf.is_file():
        raise EnvironmentSetupError(f'no robot "{path}": {mjcf} is no file.')
    gripper = said.get("gripper")
    file = None if gripper is None else grippers[gripper]() if gripper in grippers else told.parent / gripper
    if file is not None and not file.is_file():
        raise EnvironmentSetupError(f'{told}: no gripper "{gripper}". Grippers: {", ".join(grippers)}, or a MJCF file.')
    lists = {key: tuple(said[key]) for key in ("arm_joints", "gripper_actuators", "torques") if key in said}
    rest = {
        key: said[key]
        for key in ("attach", "root", "hand", "payload", "grip_stiffness", "grip_armature")
        if key in said
    }
    return Description(name=str(path), mjcf=mjcf, gripper=file, **lists, **rest)
