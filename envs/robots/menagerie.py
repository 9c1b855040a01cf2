"""Robots of MuJoCo Menagerie by short names, with a gripper where arm and gripper are apart.

The models come from the package `mujoco-menagerie`, which downloads each of them once (1 to 5 MB); MENAGERIE_ROOT names
a checkout to use instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from pat3d.envs.robots.description import Description, read_description
from pat3d.envs.robots.robot import Robot
from pat3d.errors import EnvironmentSetupError


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A robot of the Menagerie."""

    model: str
    file: str
    """Of the model's entry points."""
    payload: float
    """By the maker's data sheet [kg]; of so101, which has none, what its shoulder holds when it is stretched."""
    gripper: str = ""
    """Of GRIPPERS; none where the robot has its own."""
    attach: str = "attachment_site"
    """The site that carries the gripper."""
    grip_stiffness: float = 1.0
    """See Description."""
    grip_armature: float = 0.0
    """See Description."""
    hand: str = ""
    """See Description."""
    root: str = ""
    """See Description."""
    torques: tuple[float, ...] = ()
    """By the maker's data sheet [N m], where the model does not limit them."""


FRANKA_HAND = 100.0
"""The model presses with 100 N/m times the way that is left, 0.3 N on a rim; the hand itself with up to 70 N."""

ARMS = {
    "panda": Entry(model="franka_emika_panda", file="panda", payload=3.0, grip_stiffness=FRANKA_HAND),
    "fr3": Entry(model="franka_fr3", file="fr3", payload=3.0, gripper="panda_hand", grip_stiffness=FRANKA_HAND),
    "ur5e": Entry(model="universal_robots_ur5e", file="ur5e", payload=5.0, gripper="2f85"),
    "ur10e": Entry(model="universal_robots_ur10e", file="ur10e", payload=12.5, gripper="2f85"),
    "iiwa14": Entry(
        model="kuka_iiwa_14", file="iiwa14", payload=14.0, gripper="2f85",
        torques=(320.0, 320.0, 176.0, 176.0, 110.0, 40.0, 40.0),
    ),
    "gen3": Entry(model="kinova_gen3", file="gen3", payload=4.0, gripper="2f85", attach="pinch_site"),
    "xarm7": Entry(model="ufactory_xarm7", file="xarm7", payload=3.5),
    "sawyer": Entry(model="rethink_robotics_sawyer", file="sawyer", payload=4.0, gripper="2f85"),
    "vx300s": Entry(model="trossen_vx300s", file="vx300s", payload=0.75),
    "lite6": Entry(model="ufactory_lite6", file="lite6_gripper_narrow", payload=0.6),
    "z1": Entry(
        model="unitree_z1", file="z1_gripper", payload=2.0, hand="link06", grip_stiffness=0.04, grip_armature=0.01
    ),
    "so101": Entry(model="robotstudio_so101", file="so101", payload=0.5, hand="gripper"),
}  # fmt: skip
"""Every arm by its short name."""

HALVES = {
    f"aloha/{side}": Entry(model="aloha", file="aloha", payload=0.75, root=f"{side}/base_link")
    for side in ("left", "right")
}
"""Arms of models that have two, see `pat3d.envs.robots.pairs`."""

_HANDS = {"panda_hand": ("franka_emika_panda", "hand"), "2f85": ("robotiq_2f85", "2f85")}


def menagerie_file(model: str, file: str) -> Path:
    """The MJCF file of a model, downloaded on first use.

    Raises:
        EnvironmentSetupError: the package is not installed, or the model cannot be had.
    """
    try:
        import mujoco_menagerie
    except ImportError as error:
        raise EnvironmentSetupError(f"{error}; robots need pip install 'pat3d[robots]'.") from error
    try:
        return Path(mujoco_menagerie.get(model).xml(file))
    except (mujoco_menagerie.MenagerieError, OSError) as error:
        raise EnvironmentSetupError(
            f"{model} of MuJoCo Menagerie cannot be had: {error}. It is downloaded once; without a network, set "
            "MENAGERIE_ROOT to a checkout of github.com/google-deepmind/mujoco_menagerie, or take robot=PATH.xml."
        ) from error


def arms_here() -> tuple[str, ...]:
    """Names of ARMS whose models, and those of their grippers, are on this computer; needs mujoco_menagerie."""
    import mujoco_menagerie

    store = mujoco_menagerie.Cache()

    def here(model: str) -> bool:
        known = mujoco_menagerie.get(model)
        return (store.root / known.name).is_dir() if store.root else store.is_cached(known)

    return tuple(
        name
        for name, entry in ARMS.items()
        if here(entry.model) and (not entry.gripper or here(_HANDS[entry.gripper][0]))
    )


GRIPPERS = {name: partial(menagerie_file, *where) for name, where in _HANDS.items()}
"""MJCF file of every gripper that an arm can carry."""


def menagerie_robot(name: str) -> Robot:
    """The robot called `name`, one of ARMS or HALVES."""
    from pat3d.envs.robots.assembly import assemble

    entry = (ARMS | HALVES)[name]
    return assemble(
        Description(
            name=name,
            mjcf=menagerie_file(entry.model, entry.file),
            gripper=GRIPPERS[entry.gripper]() if entry.gripper else None,
            attach=entry.attach,
            root=entry.root,
            torques=entry.torques,
            hand=entry.hand,
            payload=entry.payload,
            grip_stiffness=entry.grip_stiffness,
            grip_armature=entry.grip_armature,
        )
    )


def described_file(name: str) -> Robot:
    """One's own robot: see `pat3d.envs.robots.description`."""
    from pat3d.envs.robots.assembly import assemble

    return assemble(read_description(Path(name), GRIPPERS))
