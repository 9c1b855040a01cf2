"""Two arms in one environment: how they are named, and how they stand to one another.

    robot="aloha"                two arms of one model, facing each other as far apart as they are bolted there
    robot=["panda", "xarm7"]     any two arms side by side, the left one first; as text "panda+xarm7"

Left and right are the arms' own where they stand side by side, and those of who looks at them where they face each
other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from pat3d.envs.robots.menagerie import ARMS
from pat3d.errors import EnvironmentSetupError

SIDES = ("left", "right")
"""Of two arms, in the order of their names, their actions and their observations."""

JOIN = "+"
"""Between the names of two arms."""

_FILES = (".xml", ".yaml", ".yml")


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two arms."""

    arms: tuple[str, str]
    """Names of the left and of the right one."""
    facing: float | None = None
    """Between the bases of arms that face each other [m]; None for arms that stand side by side."""


PAIRS = {"aloha": Pair(arms=("aloha/left", "aloha/right"), facing=0.938)}
"""Robots of MuJoCo Menagerie with two arms, by their short names."""


def robot_name(given: str | Sequence[str]) -> str:
    """One name for what was given as `robot`: a name, or the names of one or two arms.

    Raises:
        EnvironmentSetupError: neither one arm nor two.
    """
    if isinstance(given, str):
        return given
    names = tuple(given)
    if not 1 <= len(names) <= 2 or not all(isinstance(name, str) and name for name in names):
        raise EnvironmentSetupError(f'a robot is one arm or two, as ["panda", "panda"], not {list(names)!r}.')
    both = [name for name in names if len(names) == 2 and name in PAIRS]
    if both:
        raise EnvironmentSetupError(f'"{both[0]}" is two arms already; a robot has two at most.')
    return JOIN.join(names)


def pair_of(robot: str) -> Pair | None:
    """The two arms that `robot` names; None for a single one."""
    if robot in PAIRS:
        return PAIRS[robot]
    left, plus, right = robot.partition(JOIN)
    known = plus and all(name in ARMS or name.endswith(_FILES) for name in (left, right))
    return Pair(arms=(left, right)) if known else None


def arms_of(robot: str) -> tuple[str, ...]:
    """Names of the arms of `robot`, the left one first where there are two."""
    pair = pair_of(robot)
    return (robot,) if pair is None else pair.arms
