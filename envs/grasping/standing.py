"""What a task asks of a robot, and where the robot stands for it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from pat3d.envs.grasping.grasp import Grasp


@dataclass(frozen=True, kw_only=True)
class Needs:
    """What a task asks of the robot's hand."""

    grasp: tuple[str, ...] = ()
    """Objects to take."""
    push: tuple[str, ...] = ()
    """Objects to push along, which are not taken."""
    visit: tuple[tuple[float, float, float], ...] = ()
    """Points [m] that the fingertips have to get to, pointing down."""
    room: tuple[tuple[float, float], ...] = ()
    """Points seen from above [m] that a workbench has to reach, though nothing stands there yet."""
    swept: tuple[tuple[float, float], ...] = ()
    """Points seen from above [m] where something moves, beside which no base has room."""
    together: str = ""
    """"wide" or "near" for two hands that take the object at once, far from one another or not; "" for one hand."""
    cleared: bool = False
    """Whether the objects are taken one after the other, so that what was taken is no longer in the way."""
    facing: bool = False
    """Whether the robot has to face the viewer, so that left and right in a picture are those of the scene."""
    side: float | None = None
    """Where the robot has to stand as seen from its work [rad], about z from +x, its fingers across that at the points
    to visit; None for wherever there is room."""
    fronts: tuple[float, ...] = ()
    """The same of the fingers at each of the points to visit, where it is not `side` at all of them."""

    @property
    def visits(self) -> tuple[tuple[tuple[float, float, float], float | None], ...]:
        """The points to visit, each with what the fingers are across there."""
        return tuple(zip(self.visit, self.fronts or (self.side,) * len(self.visit), strict=True))


@dataclass(frozen=True, kw_only=True)
class Stand:
    """Where the other of two arms is bolted down, which has nothing to do for most tasks."""

    robot: str
    """Name of the arm."""
    side: str
    """"left" or "right"."""
    base_position: tuple[float, float, float]
    """[m]"""
    yaw: float
    """Direction in which it faces [rad], about z from +x."""
    start: tuple[float, ...]
    """Joint positions at the start [rad]."""
    grasps: Mapping[str, tuple[Grasp, ...]] = field(default_factory=dict)
    """Its grasp of what both arms take."""


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Where a scene stands and where its robot is bolted; of two arms the one that does the task, and the other."""

    base_position: tuple[float, float, float]
    """Of the robot's base [m]."""
    yaw: float
    """Direction in which the robot faces [rad], about z from +x."""
    bench: tuple[tuple[float, float], tuple[float, float]] | None
    """Lower and upper corner of the workbench's top [m], whose surface is z = 0; None for a scene on the floor."""
    host: str | None
    """The object that carries the work, where it is not the ground itself."""
    surface: float
    """Height of the surface that the work stands on [m]."""
    floor: float
    """Height of the floor [m]."""
    shown: tuple[str, ...]
    """Objects that the cameras show."""
    start: tuple[float, ...]
    """Joint positions of the arm at the start [rad]."""
    grasps: Mapping[str, tuple[Grasp, ...]] = field(default_factory=dict)
    """Grasps of every object of the task that are within reach, best first, and none of what is pushed; objects in the
    order of taking them."""
    reach: Mapping[str, float] = field(default_factory=dict)
    """Horizontal distance of every object of the task from the base [m]."""
    visit: tuple[tuple[float, float, float], ...] = ()
    """Points that the fingertips have to get to with what they hold [m]."""
    pedestal_radius: float = 0.1
    """[m]"""
    robot: str = ""
    """Name of the arm that does the task, where there are two."""
    side: str = ""
    """"left" or "right", where there are two arms."""
    other: Stand | None = None
    """The other arm."""
    view: float | None = None
    """Where the cameras are as seen from the work [rad], about z from +x; None for where the robot faces."""

    def describe(self) -> str:
        """One sentence on where the robot stands and why."""
        x, y, z = self.base_position
        where = "on a workbench" if self.bench is not None else f'beside "{self.host}"' if self.host else "on the floor"
        reached = ", ".join(f'"{name}" at {distance:.2f} m' for name, distance in self.reach.items())
        which = f"the {self.side} of two arms does it, its " if self.side else ""
        return (
            f"{which}base {where} at ({x:.2f}, {y:.2f}, {z:.2f}) m, facing {math.degrees(self.yaw):.0f} degrees; "
            f"reaches {reached or 'the work area'}"
        )
