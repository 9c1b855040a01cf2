"""The whole verification of a scene: balanced, disjoint, still in MuJoCo, faithful to its relations."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pat3d.check.certificate import Certificate, certify
from pat3d.check.loads import Load, carried_loads
from pat3d.check.metrics.drift import mean_drift, share_still
from pat3d.check.penetration import PenetrationReport, penetration
from pat3d.check.settle import SettleReport, settle_in_mujoco
from pat3d.layout.predicates import RelationResult, check_arranged, check_relations
from pat3d.progress import Event, Progress, silent
from pat3d.scene.model import Scene
from pat3d.scene.physics import STILL_SECONDS


@dataclass(frozen=True, kw_only=True)
class Verification:
    """What every check found."""

    certificate: Certificate
    penetration: PenetrationReport
    mujoco: SettleReport
    relations: tuple[RelationResult, ...]
    """Relations, arrangements and postures."""
    loads: tuple[Load, ...] = ()
    """What lies on several objects, and how much of its weight each carries in MuJoCo."""

    @property
    def failures(self) -> tuple[str, ...]:
        """One line for everything that contradicts the scene, with names and figures; none for a verified scene."""
        lines = [
            f'"{name}" is not in equilibrium: unbalanced by {self.certificate.residuals[name]:.2g} of its weight at '
            f"friction {self.certificate.friction:g}."
            for name in self.certificate.unbalanced
        ]
        if self.certificate.fragile:
            least = self.certificate.least_tilt
            lines.append(
                f"{_listed(self.certificate.first_to_go)} balances on too little: more than "
                f"{self.certificate.largest_tilt:.2f} degrees of tilt upset it. This scene has to stand "
                f"{least:.2f} degrees, a sideways push of {math.tan(math.radians(least)):.2g} of its weight."
            )
        lines += self.certificate.unreal
        for what, overlaps in (("parts", self.penetration.hulls), ("surfaces", self.penetration.visuals)):
            lines += [
                f'the {what} of "{pair.first}" and "{pair.second}" intersect, {1e3 * pair.depth:.3g} mm deep.'
                for pair in overlaps
            ]
        lines += [
            f'"{obj.name}" drifts {max(obj.centre_mm, obj.origin_mm):.2f} mm and {obj.degrees:.2f} degrees in '
            f"{self.mujoco.seconds:g} s of MuJoCo."
            for obj in self.mujoco.moved()
        ]
        lines += [f"MuJoCo warns: {warning}" for warning in self.mujoco.warnings]
        lines += [str(load) for load in self.loads if not load.carries]
        return (*lines, *self.broken, *(f"not met: {line}." for line in self.unmet))

    @property
    def broken(self) -> tuple[str, ...]:
        """Support relations that do not hold, a line each."""
        return broken(self.relations)

    @property
    def unmet(self) -> tuple[str, ...]:
        """Lateral relations that do not hold: nothing falls over, but the scene is not what was asked for."""
        return tuple(
            f"{found.relation} ({found.detail})"
            for found in self.relations
            if not found.relation.supports and not found.holds
        )

    @property
    def passed(self) -> bool:
        """Nothing contradicts the scene."""
        return not self.failures

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        held = sum(found.holds for found in self.relations)
        return {
            "passed": self.passed,
            "failures": list(self.failures),
            "certificate": self.certificate.as_dict(),
            "penetration": self.penetration.as_dict(),
            "mujoco": self.mujoco.as_dict(),
            "settings": "MuJoCo with the options of mjcf/scene.xml; for others see: pat3d check --settings all",
            "mean_drift_m": mean_drift(self.mujoco),
            "share_still": share_still(self.mujoco),
            **({"loads": [load.as_dict() for load in self.loads]} if self.loads else {}),
            "relations": {
                "held": held,
                "count": len(self.relations),
                "list": [
                    {
                        "relation": str(found.relation),
                        "kind": found.relation.kind,
                        "holds": found.holds,
                        "detail": found.detail,
                    }
                    for found in self.relations
                ],
            },
        }


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f'"{name}"' for name in names)


def broken(relations: tuple[RelationResult, ...]) -> tuple[str, ...]:
    """A line for every support relation that does not hold."""
    return tuple(
        f"broken: {found.relation} ({found.detail})."
        for found in relations
        if found.relation.supports and not found.holds
    )


def relations_at_rest(scene: Scene) -> tuple[RelationResult, ...]:
    """Every relation, arrangement and posture of `scene` with whether it holds at the objects' poses."""
    assets, poses = ({obj.name: getattr(obj, what) for obj in scene.objects} for what in ("asset", "pose"))
    return (
        *check_relations(scene.relations, assets, poses, attachments=scene.attachments),
        *check_arranged(scene.arrangements, scene.postures, assets, poses),
    )


def verify(
    scene: Scene, mjcf_path: str | Path, progress: Progress = silent, *, seconds: float = STILL_SECONDS
) -> Verification:
    """Check `scene`, written as MJCF at `mjcf_path`, in every way.

    Raises:
        CheckError: MuJoCo refuses the file.
    """
    progress(Event(stage="verifying", detail="static equilibrium", step=0, steps=4))
    certificate = certify(scene, margin=True)
    progress(Event(stage="verifying", detail="no intersections", step=1, steps=4))
    overlaps = penetration(scene)
    running = Event(stage="verifying", detail=f"{seconds:g} s in MuJoCo", step=2, steps=4)
    progress(running)
    mujoco = settle_in_mujoco(mjcf_path, seconds, alive=lambda: progress(running))
    progress(Event(stage="verifying", detail="relations", step=3, steps=4))
    return Verification(
        certificate=certificate,
        penetration=overlaps,
        mujoco=mujoco,
        relations=relations_at_rest(scene),
        loads=carried_loads(scene, mjcf_path, seconds),
    )
