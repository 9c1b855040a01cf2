"""Faults of a USD file that validators let pass and engines punish.

Each rule is a function from the opened file to its findings; `lint_usd` runs them all. A scene without findings has
everything an engine needs to hold it still: one physics scene, masses that a solid can have, colliders on every body
that are what they say, friction that every reader finds, joints that start closed, and no overlap.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from pat3d.check.usd_lint import colliders, joints, mass, stage
from pat3d.check.usd_lint.file import LintFile
from pat3d.exporters.usd.stage import open_stage

RULES = {
    "units": stage.units,
    "physics-scene": stage.physics_scene,
    "articulation": stage.articulation,
    "nested-bodies": stage.nested_bodies,
    "placement": stage.placement,
    "scale": stage.scale,
    "missing-collider": colliders.missing_collider,
    "mass": mass.mass,
    "mass-on-collider": mass.mass_on_collider,
    "inertia": mass.inertia,
    "approximation": colliders.approximation,
    "hull": colliders.hull,
    "friction": colliders.friction,
    "penetration": colliders.overlap,
    "joint": joints.joint,
}


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One fault."""

    rule: str
    """Name of the rule, such as "missing-collider"."""
    prim: str
    """Path of the prim in the file."""
    message: str
    """What is wrong and what would be right."""

    def __str__(self) -> str:
        return f"{self.rule}: {self.prim}: {self.message}"


def lint_usd(path: str | Path) -> tuple[Finding, ...]:
    """Every fault found in a .usdc, .usda or .usdz file, by rule; none in a file that this package wrote.

    A file whose default prim is a single object needs no physics scene.

    Raises:
        ExportError: not readable.
    """
    file = LintFile(open_stage(path))
    return tuple(
        Finding(rule=rule, prim=str(prim.GetPath()), message=message)
        for rule, check in RULES.items()
        for prim, message in check(file)
    )
