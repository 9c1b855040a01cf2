"""What a run found: report.json, and the summary that a person reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pat3d.check.verification import Verification
    from pat3d.exporters.compare import ParityReport
    from pat3d.generation.attempts import ChosenAttempt
    from pat3d.generation.settle_stage import SettledScene
    from pat3d.scene.model import Scene

FORMAT = "pat3d-report"
VERSION = 3


@dataclass(frozen=True, kw_only=True, eq=False)
class Report:
    """A finished run."""

    understood: Mapping[str, Any]
    """How the prompt or the specification was understood."""
    chosen: ChosenAttempt
    reused: tuple[str, ...] = ()
    """Stages taken from an earlier run."""
    seconds: Mapping[str, float]

    exports: Mapping[str, ParityReport] = field(default_factory=dict)
    """What was found in every format when it was read back."""
    critic: Mapping[str, Any] | None = None
    """What a critic has said of the scene's pictures; None where nobody was asked."""

    @property
    def passed(self) -> bool:
        """Whether the scene is verified, and every format says the same."""
        return self.chosen.best.passed and all(report.passed for report in self.exports.values())

    @property
    def failures(self) -> tuple[str, ...]:
        """What contradicts the scene, a line each."""
        lines = [line for report in self.exports.values() for line in report.failures]
        return (*self.chosen.best.failures, *lines)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        best, checked = self.chosen.best, self.chosen.checked
        scene = checked.scene
        return {
            "format": FORMAT,
            "version": VERSION,
            "prompt": scene.prompt,
            "seed": scene.seed,
            "passed": self.passed,
            "failures": list(self.failures),
            "seconds": dict(self.seconds),
            "versions": scene.provenance.get("versions", {}),
            **of_scene(scene, checked.settled, checked.verification),
            "understood": dict(self.understood),
            "layout": {"seed": best.layout_seed, "notes": list(best.notes)},
            "exports": {name: report.as_dict() for name, report in self.exports.items()},
            "attempts": [attempt.as_dict() for attempt in self.chosen.tried],
            "delivered_attempt": best.number + 1,
            "inputs": {"request": self.chosen.key, **best.inputs},
            "reused": list(self.reused),
            **({} if self.critic is None else {"critic": dict(self.critic)}),
        }


def of_scene(scene: Scene, settled: SettledScene, verification: Verification) -> dict[str, Any]:
    """What the report says about a scene at rest, however it came about."""
    drifts = {obj.name: obj for obj in verification.mujoco.objects}
    objects = []
    for obj in scene.objects:
        drift = drifts.get(obj.name)
        objects.append(
            {
                "name": obj.name,
                "noun": obj.asset.noun,
                "fixed": obj.fixed,
                "mass_kg": obj.asset.mass_properties.mass,
                "parts": len(obj.asset.parts),
                "size_m": obj.asset.size.tolist(),
                "residual": verification.certificate.residuals.get(obj.name),
                "drift_mm": None if drift is None else max(drift.centre_mm, drift.origin_mm),
                "drift_degrees": None if drift is None else drift.degrees,
            }
        )
    return {
        "objects": objects,
        "settling": {**settled.record, "friction": scene.settling_friction},
        "optimisation": settled.optimisation,
        "verification": verification.as_dict(),
    }
