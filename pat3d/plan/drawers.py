"""Drawers of a plan, each in a row of a cabinet that is made for them, shut or open as what is said needs it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.relations import GROUND, Relation
from pat3d.scene.task_spec import AND_THEN, CHAIN, renamed, steps_of

DRAWER, OPEN_DRAWER, DRAWER_CABINET = "drawer", "open drawer", "drawer cabinet"
"""Catalogue nouns."""
DRAWERS = frozenset({DRAWER, OPEN_DRAWER})
CABINETS = frozenset({"cabinet", "dresser", "bedside table", "filing cabinet", DRAWER_CABINET})
"""Nouns of furniture that has drawers."""
_ROWS = {
    "top": ("top", "upper", "uppermost", "topmost", "highest", "first"),
    "middle": ("middle", "second", "center", "centre"),
    "bottom": ("bottom", "lower", "lowest", "lowermost", "third", "last"),
}  # fmt: skip
"""Rows of the cabinet from above, and the words for them."""


ROW_WORDS = frozenset({*(word for words in _ROWS.values() for word in words), "open", "opened", "closed", "shut"})
"""What tells one drawer from another, and how it is."""


def in_cabinets(plan: ScenePlan, said: str = "", colours: tuple[str, ...] = ()) -> ScenePlan:
    """`plan` with its drawers in a cabinet, which is made where none is named; as it is where there are none.

    `said` is what the prompt calls the furniture that they are in, `colours` those that it gives it.

    What is in a drawer or to be put there is reached when that is open, unless the task opens it first.

    Raises:
        PromptError: there are more drawers than a cabinet has rows.
    """
    drawers = [obj for obj in plan.objects if obj.noun in DRAWERS]
    if not drawers:
        return plan
    if len(drawers) > len(_ROWS):
        raise PromptError(
            f"{len(drawers)} drawers: a cabinet has {len(_ROWS)} rows. Name at most {len(_ROWS)} of them."
        )
    below = {rel.child: rel for rel in plan.relations if rel.supports}
    plan = _beside_cabinet(plan, [one.name for one in drawers], _cabinet(plan, said, colours).name)
    rows = _rows(drawers)
    called = {one.name: f"{row} drawer" for one in drawers if (row := _row_said(one)) is not None}
    if (
        called
        and len({*called.values()}) == len(called)
        and not {*called.values()} & {obj.name for obj in plan.objects}
    ):
        plan = _renamed(plan, called)
        drawers = [obj for obj in plan.objects if obj.noun in DRAWERS]
        rows = {called.get(name, name): row for name, row in rows.items()}
    cabinet, notes = _cabinet(plan, said, colours), list[str]()
    made = [replace(one, noun=OPEN_DRAWER if _is_open(plan, one, notes) else DRAWER, scale=cabinet.scale,
                    colours=one.colours or cabinet.colours, material=one.material or cabinet.material)
            for one in drawers]  # fmt: skip
    cabinet = replace(cabinet, adjectives=tuple(dict.fromkeys((*cabinet.adjectives, *rows.values()))))
    known = next((obj for obj in plan.objects if obj.name == cabinet.name), None)
    if known is None and not said:
        named = " and ".join(dict.fromkeys(f'"{one.phrase}"' for one in drawers))
        notes.append(f"{named}: what it is in is not said; a cabinet is made.")
    elif known is None or known.noun != DRAWER_CABINET:
        named = said if known is None else known.phrase
        notes.append(f'"{named}" is made as a cabinet of three rows, of which {_listed(rows)}.')
    for one in drawers:
        told = one.phrase.lower().split()
        notes += [f'not modelled: "{word}" of "{one.phrase}": drawers are above one another.'
                  for word in ("left", "right") if word in told]  # fmt: skip
        notes += [f'not modelled: "{word}" of "{one.phrase}": a cabinet has three rows.'
                  for word in ("fourth", "fifth", "sixth") if word in told]  # fmt: skip
        if "other" in told and len(drawers) == 1:
            notes.append(f'not modelled: "other" of "{one.phrase}": there is one.')
    own = {one.name for one in drawers}
    relations = [Relation(child=name, kind="in", parent=cabinet.name) for name in sorted(own, key=_place(rows))]
    carriers = [below[name] for name in sorted(own) if name in below and below[name].parent != cabinet.name]
    if cabinet.name not in below and carriers and carriers[0].parent != GROUND:
        relations.append(Relation(child=cabinet.name, kind="on", parent=carriers[0].parent))
    for rel in plan.relations:
        if rel.supports and rel.child in own:
            continue
        ends = [cabinet.name if name in own and rel.kind != "in" else name for name in (rel.child, rel.parent)]
        if ends[0] != ends[1]:
            relations.append(Relation(child=ends[0], kind=rel.kind, parent=ends[1]))
    objects: list[PlannedObject] = []
    for obj in plan.objects:
        if obj.name == cabinet.name:
            objects.append(cabinet)
        elif obj.name not in own:
            objects.append(obj)
        elif obj.name == drawers[0].name:
            objects += [*([cabinet] if known is None else []), *made]
    return replace(plan, objects=tuple(objects), relations=tuple(dict.fromkeys(relations)), notes=(*plan.notes, *notes))


def _cabinet(plan: ScenePlan, said: str, colours: tuple[str, ...]) -> PlannedObject:
    """The furniture of `plan` that has the drawers, as a cabinet; a new one where there is none, or more than one."""
    owners = [obj for obj in plan.objects if obj.noun in CABINETS]
    drawers = {obj.name for obj in plan.objects if obj.noun in DRAWERS}
    carrying = {rel.parent for rel in plan.relations if rel.supports and rel.child in drawers}
    owners = [obj for obj in owners if obj.name in carrying] or owners
    if len(owners) == 1:
        return replace(owners[0], noun=DRAWER_CABINET, extent=None, colours=owners[0].colours or colours)
    taken = {obj.name for obj in plan.objects}
    name = next(name for name in (said or "cabinet", "drawer cabinet", *(f"cabinet {n}" for n in range(2, 99)))
                if name not in taken)  # fmt: skip
    return PlannedObject(name=name, noun=DRAWER_CABINET, phrase=said, colours=colours)


def _beside_cabinet(plan: ScenePlan, drawers: list[str], cabinet: str) -> ScenePlan:
    """`plan` whose task puts beside the cabinet what it said to put beside a drawer, which stands nowhere by itself."""
    if plan.task is None:
        return plan
    steps = [
        [*step[:3], cabinet] if step[0] == "beside" and step[-1] in drawers else step for step in steps_of(plan.task)
    ]
    told = AND_THEN.join(":".join(step) for step in steps)
    return replace(plan, task=f"{CHAIN}:{told}" if len(steps) > 1 else told)


def _rows(drawers: list[PlannedObject]) -> dict[str, str]:
    """The row of every drawer, by its name: as is said of it, the others in those that are left, from above."""
    rows: dict[str, str] = {}
    for one in drawers:
        row = _row_said(one)
        if row is not None and row not in rows.values():
            rows[one.name] = row
    left = [row for row in _ROWS if row not in rows.values()]
    return rows | dict(zip((one.name for one in drawers if one.name not in rows), left, strict=False))


def _row_said(drawer: PlannedObject) -> str | None:
    """The row that the drawer is told by."""
    words = {*drawer.phrase.lower().split(), *drawer.adjectives}
    return next((row for row, names in _ROWS.items() if words & {*names}), None)


def _renamed(plan: ScenePlan, called: Mapping[str, str]) -> ScenePlan:
    """`plan` with other names of objects, by those that they have."""
    return replace(
        plan,
        objects=tuple(replace(obj, name=called.get(obj.name, obj.name)) for obj in plan.objects),
        relations=tuple(
            replace(rel, child=called.get(rel.child, rel.child), parent=called.get(rel.parent, rel.parent))
            for rel in plan.relations
        ),
        arrangements=tuple(
            replace(one, objects=tuple(called.get(name, name) for name in one.objects),
                    of=tuple(called.get(name, name) for name in one.of))
            for one in plan.arrangements
        ),
        postures=tuple(replace(one, object=called.get(one.object, one.object)) for one in plan.postures),
        task=renamed(plan.task, called) if plan.task else None,
    )  # fmt: skip


def _is_open(plan: ScenePlan, drawer: PlannedObject, notes: list[str]) -> bool:
    """Whether the drawer is open before anything is done; a note where that is for what is in it."""
    steps = steps_of(plan.task) if plan.task else []
    moved = next((kind for kind, *names in steps if kind in ("open", "close") and names == [drawer.name]), "")
    said = {*drawer.adjectives, *drawer.phrase.lower().split()}
    if moved or said & {"open", "opened", "closed", "shut"}:
        return moved == "close" or (not moved and bool(said & {"open", "opened"}))
    held = any(rel.kind == "in" and rel.parent == drawer.name for rel in plan.relations)
    if held or any(drawer.name in names[1:] for _, *names in steps):
        notes.append(f'"{drawer.phrase}" is made open, as what is in it is reached so.')
        return True
    return False


def _place(rows: dict[str, str]):
    return lambda name: list(_ROWS).index(rows[name])


def _listed(rows: dict[str, str]) -> str:
    named = [f"the {row}" for row in _ROWS if row in rows.values()]
    verb = "slides" if len(named) == 1 else "slide"
    return f"{re.sub(r', (?=[^,]*$)', ' and ', ', '.join(named))} {verb}"
