"""Doors of a plan that are opened or shut: each a thing of its own, in a case that is made for it."""

from __future__ import annotations

import re
from dataclasses import replace

from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.relations import Relation
from pat3d.scene.task_spec import AND_THEN, CHAIN, SLIDING, steps_of

HINGED = {noun: f"hinged {of}" for of in ("microwave", "cabinet", "fridge") for noun in (of, f"open {of}")}
"""Catalogue nouns of furniture whose door turns, by what it is otherwise made as."""
DOORS = {f"{state}{case} door": bool(state) for case in HINGED.values() for state in ("", "open ")}
"""Nouns of doors, and whether they are open."""
_NUMBERED = re.compile(r"^(.+?)( \d+)?$")
_WHOLE = re.compile(r'"[^"]*\bdoors?\b[^"]*": "[^"]*" has no parts of its own and is meant\.')
_OPENED = '"{phrase}" is made open, as what is in it is reached so.'


def with_doors(plan: ScenePlan) -> ScenePlan:
    """`plan` with a door in all that its task opens or shuts; as it is where there is none."""
    steps = steps_of(plan.task) if plan.task else []
    moved = {step[1]: step[0] for step in reversed(steps) if step[0] in SLIDING}
    cases = {obj.name: obj for obj in plan.objects if obj.name in moved and obj.noun in HINGED}
    if not cases:
        return plan
    doors = {name: _NUMBERED.sub(r"\1 door\2", name, count=1) for name in cases}
    objects: list[PlannedObject] = []
    for obj in plan.objects:
        if obj.name not in cases:
            objects.append(obj)
            continue
        case = HINGED[obj.noun]
        state = "open " if moved[obj.name] == "close" else ""
        door = replace(obj, name=doors[obj.name], noun=f"{state}{case} door", extent=None,
                       phrase=f"{obj.phrase.removesuffix(' door')} door")  # fmt: skip
        objects += [replace(obj, noun=case, extent=None), door]
    told = [":".join([kind, *(doors.get(name, name) if kind in SLIDING else name for name in names)])
            for kind, *names in steps]  # fmt: skip
    sized = [f'not modelled: the size of "{obj.phrase}".' for obj in cases.values() if obj.extent is not None]
    untrue = {_OPENED.format(phrase=obj.phrase) for obj in cases.values()}
    return replace(
        plan,
        objects=tuple(objects),
        relations=(*plan.relations, *(Relation(child=doors[name], kind="in", parent=name) for name in cases)),
        task=f"{CHAIN}:{AND_THEN.join(told)}" if len(told) > 1 else told[0],
        notes=(*(note for note in plan.notes if note not in untrue and not _WHOLE.fullmatch(note)), *sized),
    )
