"""What commands and tools say of scenes to other programs: plain data, one form for each thing; see docs/json.md."""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pat3d.check.verification import Verification
from pat3d.exporters.compare import ParityReport
from pat3d.generation.editing.resettling import Changes
from pat3d.plan.scene_plan import ScenePlan
from pat3d.plan.telling import tell
from pat3d.scene.folder import finite
from pat3d.scene.history import Edit
from pat3d.scene.model import Relation, Scene


@dataclass(frozen=True, kw_only=True)
class RelationFacts:
    """`child` stands in relation `kind` to `parent`."""

    child: str
    kind: str
    parent: str


@dataclass(frozen=True, kw_only=True)
class PlannedFacts:
    """One object that a sentence asks for."""

    name: str
    noun: str
    phrase: str
    colours: list[str]
    material: str | None
    proxy: bool


@dataclass(frozen=True, kw_only=True)
class ArrangementFacts:
    """Objects that stand in an arrangement among each other, or to landmarks."""

    kind: str
    objects: list[str]
    of: list[str]


@dataclass(frozen=True, kw_only=True)
class PlanFacts:
    """How a sentence is read."""

    prompt: str
    told: str
    otherwise: str
    task: str | None
    objects: list[PlannedFacts]
    relations: list[RelationFacts]
    arrangements: list[ArrangementFacts]
    notes: list[str]
    set_aside: list[str]


@dataclass(frozen=True, kw_only=True)
class ObjectFacts:
    """One object of a scene."""

    name: str
    noun: str
    rests_on: list[str]
    fixed: bool
    mass_kg: float
    friction: float
    material: str
    size_m: list[float]
    position_m: list[float]
    quat_wxyz: list[float]


@dataclass(frozen=True, kw_only=True)
class SceneFacts:
    """What is in a scene."""

    prompt: str
    seed: int
    task: str | None
    objects: list[ObjectFacts]
    relations: list[RelationFacts]
    history: list[str]


@dataclass(frozen=True, kw_only=True)
class VerificationFacts:
    """The figures of a verification."""

    unbalanced: float | None
    friction: float
    largest_tilt_degrees: float | None
    intersections: int
    mujoco_seconds: float
    drift_mm: float | None
    drift_degrees: float | None
    relations_held: int
    relations: int


@dataclass(frozen=True, kw_only=True)
class OutcomeFacts:
    """A scene that was made, edited, settled or checked: whether it passed, and what is in it."""

    folder: str
    passed: bool
    failures: list[str]
    notes: list[str]
    scene: SceneFacts
    verification: VerificationFacts | None
    exports: list[str]
    seconds: float | None


@dataclass(frozen=True, kw_only=True)
class MotionFacts:
    """How far an object went."""

    mm: float
    degrees: float


@dataclass(frozen=True, kw_only=True)
class EditedFacts(OutcomeFacts):
    """An edited scene, and what the edits did."""

    edits: list[str]
    added: list[str]
    removed: list[str]
    moved: dict[str, MotionFacts]
    broke: list[str]


@dataclass(frozen=True, kw_only=True)
class ExportFacts:
    """A scene written for other programs."""

    folder: str
    passed: bool
    failures: list[str]
    files: dict[str, str]
    """The main file of every format."""


@dataclass(frozen=True, kw_only=True)
class KindFacts:
    """A kind of object that the catalogue can make."""

    noun: str
    family: str
    also_called: list[str]
    material: str


def kinds(words: str = "") -> list[KindFacts]:
    """Kinds whose noun, synonyms or family have `words` in them, or are spelt nearly so; all where empty."""
    from pat3d.assets import catalogue

    said = words.casefold().strip()
    near = set(catalogue.nearest(said, 5)) if said else set()
    return [
        KindFacts(noun=one.noun, family=one.family, also_called=list(one.synonyms), material=one.material)
        for one in catalogue.entries()
        if said in " ".join((one.noun, one.family, *one.synonyms, *one.plurals)) or near & {one.noun, *one.synonyms}
    ]


def plan_facts(plan: ScenePlan) -> PlanFacts:
    """How a sentence was read."""
    return PlanFacts(
        prompt=plan.prompt,
        told=tell(plan),
        otherwise=plan.otherwise,
        task=plan.task,
        objects=[
            PlannedFacts(
                name=obj.name,
                noun=obj.noun,
                phrase=obj.phrase,
                colours=list(obj.colours),
                material=obj.material,
                proxy=obj.proxy,
            )
            for obj in plan.objects
        ],
        relations=_relations(plan.relations),
        arrangements=[
            ArrangementFacts(kind=one.kind, objects=list(one.objects), of=list(one.of)) for one in plan.held()
        ],
        notes=list(plan.notes),
        set_aside=list(plan.set_aside),
    )


def scene_facts(scene: Scene) -> SceneFacts:
    """The objects of a scene, where they are and what they rest on."""
    return SceneFacts(
        prompt=scene.prompt,
        seed=scene.seed,
        task=scene.task,
        objects=[
            ObjectFacts(
                name=obj.name,
                noun=obj.asset.noun,
                rests_on=list(scene.carriers(obj.name)),
                fixed=obj.fixed,
                mass_kg=obj.asset.mass_properties.mass,
                friction=obj.asset.material.friction,
                material=obj.asset.material.name,
                size_m=obj.asset.size.tolist(),
                position_m=list(obj.pose.position),
                quat_wxyz=list(obj.pose.quat_wxyz),
            )
            for obj in scene.objects
        ],
        relations=_relations(scene.relations),
        history=[str(edit) for edit in scene.history],
    )


def _relations(relations: Sequence[Relation]) -> list[RelationFacts]:
    return [RelationFacts(child=rel.child, kind=rel.kind, parent=rel.parent) for rel in relations]


def outcome_facts(
    scene: Scene,
    *,
    folder: str | Path,
    failures: Sequence[str],
    verification: Verification | None = None,
    exports: Mapping[str, ParityReport] | None = None,
    seconds: float | None = None,
    notes: Sequence[str] = (),
) -> OutcomeFacts:
    """A scene that was made, edited, settled or checked."""
    return OutcomeFacts(
        folder=str(folder),
        passed=not failures,
        failures=list(failures),
        notes=list(notes),
        scene=scene_facts(scene),
        verification=None if verification is None else _verification(verification),
        exports=sorted(exports or ()),
        seconds=seconds,
    )


def edited_facts(outcome: OutcomeFacts, edits: Sequence[Edit], changes: Changes) -> EditedFacts:
    """The scene of `outcome`, and what `edits` did to it."""
    return EditedFacts(
        **{one.name: getattr(outcome, one.name) for one in dataclasses.fields(outcome) if one.name != "notes"},
        notes=[*outcome.notes, *changes.notes],
        edits=[str(edit) for edit in edits],
        added=list(changes.added),
        removed=list(changes.removed),
        moved={name: MotionFacts(mm=one.mm, degrees=one.degrees) for name, one in changes.moved.items()},
        broke=list(changes.broke),
    )


def _verification(verification: Verification) -> VerificationFacts:
    certificate, mujoco = verification.certificate, verification.mujoco
    numbers = {
        "unbalanced": certificate.worst,
        "largest_tilt_degrees": certificate.largest_tilt,
        "drift_mm": mujoco.worst_mm,
        "drift_degrees": mujoco.worst_degrees,
    }
    return VerificationFacts(
        # JSON has no infinity.
        **finite(numbers),
        friction=certificate.friction,
        intersections=len(verification.penetration.hulls) + len(verification.penetration.visuals),
        mujoco_seconds=mujoco.seconds,
        relations_held=sum(one.holds for one in verification.relations),
        relations=len(verification.relations),
    )


_PLAIN = {str: "string", bool: "boolean", int: "integer", float: "number", type(None): "null"}


def schema_of(kind: Any) -> dict[str, Any]:
    """JSON schema of a dataclass of this module."""
    if kind in _PLAIN:
        return {"type": _PLAIN[kind]}
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is list:
        return {"type": "array", "items": schema_of(inner[0])}
    if origin is dict:
        return {"type": "object", "additionalProperties": schema_of(inner[1])}
    if origin is types.UnionType:
        return {"anyOf": [schema_of(one) for one in inner]}
    hints = typing.get_type_hints(kind)
    names = [one.name for one in dataclasses.fields(kind)]
    return {
        "title": kind.__name__,
        "description": kind.__doc__,
        "type": "object",
        "properties": {name: schema_of(hints[name]) for name in names},
        "required": names,
        "additionalProperties": False,
    }
