"""What commands and tools say of scenes to other programs: plain data, one form for each thing; see docs/json.md."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pat3d.check.verification import Verification
from pat3d.exporters.compare import ParityReport
from pat3d.generation.editing.resettling import Changes
from pat3d.plan.scene_plan import ScenePlan
from pat3d.plan.telling import tell
from pat3d.scene.history import Edit
from pat3d.scene.model import Scene


def plan_facts(plan: ScenePlan) -> dict[str, Any]:
    """How a sentence was read."""
    return {
        "prompt": plan.prompt,
        "told": tell(plan),
        "otherwise": plan.otherwise,
        "task": plan.task,
        "objects": [
            {
                "name": obj.name,
                "noun": obj.noun,
                "phrase": obj.phrase,
                "colours": list(obj.colours),
                "material": obj.material,
                "proxy": obj.proxy,
            }
            for obj in plan.objects
        ],
        "relations": [{"child": rel.child, "kind": rel.kind, "parent": rel.parent} for rel in plan.relations],
        "arrangements": [{"kind": one.kind, "objects": list(one.objects), "of": list(one.of)} for one in plan.held()],
        "notes": list(plan.notes),
        "set_aside": list(plan.set_aside),
    }


def scene_facts(scene: Scene) -> dict[str, Any]:
    """The objects of a scene, where they are and what they rest on."""
    return {
        "prompt": scene.prompt,
        "seed": scene.seed,
        "task": scene.task,
        "objects": [
            {
                "name": obj.name,
                "noun": obj.asset.noun,
                "rests_on": list(scene.carriers(obj.name)),
                "fixed": obj.fixed,
                "mass_kg": obj.asset.mass_properties.mass,
                "friction": obj.asset.material.friction,
                "material": obj.asset.material.name,
                "size_m": obj.asset.size.tolist(),
                "position_m": list(obj.pose.position),
                "quat_wxyz": list(obj.pose.quat_wxyz),
            }
            for obj in scene.objects
        ],
        "relations": [{"child": rel.child, "kind": rel.kind, "parent": rel.parent} for rel in scene.relations],
        "history": [str(edit) for edit in scene.history],
    }


def outcome_facts(
    scene: Scene,
    *,
    folder: str | Path,
    failures: Sequence[str],
    verification: Verification | None = None,
    exports: Mapping[str, ParityReport] | None = None,
    seconds: Mapping[str, float] | None = None,
    notes: Sequence[str] = (),
) -> dict[str, Any]:
    """A scene that was made, edited, settled or checked: whether it passed, and what is in it."""
    return {
        "folder": str(folder),
        "passed": not failures,
        "failures": list(failures),
        "notes": list(notes),
        "scene": scene_facts(scene),
        "verification": None if verification is None else verification_facts(verification),
        "exports": sorted(exports or ()),
        "seconds": None if seconds is None else seconds.get("total"),
    }


def verification_facts(verification: Verification) -> dict[str, Any]:
    """The figures of a verification."""
    certificate, mujoco = verification.certificate, verification.mujoco
    return {
        "unbalanced": certificate.worst,
        "friction": certificate.friction,
        "largest_tilt_degrees": certificate.largest_tilt,
        "intersections": len(verification.penetration.hulls) + len(verification.penetration.visuals),
        "mujoco_seconds": mujoco.seconds,
        "drift_mm": mujoco.worst_mm,
        "drift_degrees": mujoco.worst_degrees,
        "relations_held": sum(one.holds for one in verification.relations),
        "relations": len(verification.relations),
    }


def edit_facts(edits: Sequence[Edit], changes: Changes) -> dict[str, Any]:
    """What edits did."""
    return {"edits": [str(edit) for edit in edits], **changes.as_dict()}
