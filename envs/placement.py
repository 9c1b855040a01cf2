"""Where the robot stands."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Where a scene stands and where its robot is bolted."""

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
    focus: tuple[float, float, float]
    """Middle of the objects [m], where the cameras look."""
    focus_radius: float
    """Half of the largest horizontal extent of the objects [m]."""
    pedestal_radius: float = 0.1
    """[m]"""
