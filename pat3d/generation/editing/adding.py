"""Objects that a noun phrase adds: "a coffee mug on the stack of books", read by the planner, made from the catalogue.

What the phrase names with "the" is in the scene already; everything else is new.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from pat3d.errors import EditError, PromptError
from pat3d.generation.editing.draft import Draft
from pat3d.generation.editing.laying import laid_out
from pat3d.generation.editing.selecting import chosen
from pat3d.generation.editing.steps import exchanged, related
from pat3d.generation.request import UnplacedObject, derived_seed, objects_of_plan
from pat3d.plan.scene_plan import Planner, ScenePlan
from pat3d.progress import silent
from pat3d.scene.arrangements import Arrangement
from pat3d.scene.model import GROUND, Relation, Scene, SceneObject

_GROUND_WORDS = re.compile(r"\b(?:on|onto|to) the (?:ground|floor)\b", re.IGNORECASE)

_PLACES = 'Valid: "10 cm to the right", "onto the books", "to the left of the vase".'


@dataclass(frozen=True, kw_only=True)
class _Read:
    """A phrase, read against a scene."""

    plan: ScenePlan
    new: tuple[str, ...]
    """Objects of the plan that are not in the scene."""
    there: Mapping[str, tuple[str, ...]]
    """What each other object of the plan is in the scene: one, or the members of a stack or a set."""


def add(draft: Draft, phrase: str, planner: Planner) -> tuple[Draft, tuple[str, ...]]:
    """Add what `phrase` says; returns the names of the new objects too.

    Raises:
        PromptError: the phrase cannot be read, or names what cannot be made.
        EditError: it names nothing new, or with "the" what is not there.
        LayoutError: there is no room.
    """
    scene = draft.scene
    read = _read(scene, phrase, planner)
    if not read.new:
        raise EditError(f'"{phrase}" names nothing new: say "a mug on the books", not "the mug". Nothing was written.')
    names = _fresh_names({obj.name for obj in scene.objects}, read.new)
    made = _made(scene, read)
    relations = _relations(scene, read, names)
    loose = [name for name in names.values() if not any(rel.supports and rel.child == name for rel in relations)]
    grounded = _GROUND_WORDS.search(phrase) is not None
    for name in loose:
        carrier = GROUND if grounded else _usual_carrier(scene, name, relations)
        if carrier != GROUND:
            relations = (*relations, Relation(child=name, kind="on", parent=carrier))
    arrangements = _arrangements(read, names)
    objects = tuple(
        SceneObject(
            name=names[one.name],
            phrase=one.phrase,
            asset=one.asset,
            # The layout decides; until then nothing reads these.
            pose=scene.objects[0].pose,
            initial_pose=scene.objects[0].pose,
            posture=one.posture,
        )
        for one in made
    )
    changed = replace(
        scene,
        objects=(*scene.objects, *objects),
        relations=(*scene.relations, *relations),
        arrangements=(*scene.arrangements, *arrangements),
    )
    there = [obj.phrase for obj in read.plan.objects if obj.name in read.there]
    assumed = [note for note in read.plan.notes if not any(f'"{phrase}"' in note for phrase in there)]
    notes = [*assumed, *(one.note for one in made if one.note)]
    found = laid_out(draft.with_scene(changed, notes=notes), list(names.values()))
    return replace(found, asked=(*found.asked, *relations, *arrangements)), tuple(names.values())


def replaced(draft: Draft, name: str, phrase: str, planner: Planner) -> tuple[Draft, str]:
    """Put the one object that `phrase` names in the place of `name`; returns its name too.

    Raises:
        PromptError: the phrase cannot be read, or names what cannot be made.
        EditError: it names more than one thing, or there is no room.
        LayoutError: there is no room on it.
    """
    plan = planner.plan(phrase)
    if len(plan.objects) != 1:
        raise EditError(f'"{phrase}" names {len(plan.objects)} objects; one can take the place of "{name}".')
    scene = draft.scene
    read = _Read(plan=plan, new=(plan.objects[0].name,), there={})
    (made,) = _made(scene, read)
    new = _fresh_names({obj.name for obj in scene.objects} - {name}, (made.name,))[made.name]
    found = exchanged(
        draft, name, lambda asset: made.asset, lambda obj: replace(obj, name=new, phrase=made.phrase, posture=None)
    )
    return found, new


def moved_to(draft: Draft, name: str, where: str, planner: Planner) -> Draft:
    """Put `name` where words say: "onto the books", "to the left of the vase", "between the vase and the mug".

    Raises:
        EditError: the words name nothing that is there.
        LayoutError: there is no room.
    """
    scene = draft.scene
    if _GROUND_WORDS.fullmatch(where.strip()):
        relations = tuple(rel for rel in scene.relations if not (rel.supports and rel.child == name))
        return related(
            draft.with_scene(replace(scene, relations=relations)),
            name,
            [Relation(child=name, kind="on", parent=GROUND)],
        )
    said = re.sub(r"\bonto\b", "on", re.sub(r"\binto\b", "in", where))
    noun = scene[name].asset.noun
    try:
        read = _read(scene, f"a {noun} {said}", planner, first_is_new=True)
    except PromptError as error:
        raise EditError(f'"{where}" is no place that can be read. {_PLACES} {error}') from error
    lead = read.new[0]
    if len(read.new) != 1:
        raise EditError(f'"{where}" names what is not in the scene. Nothing was written.')
    names = {lead: name}
    relations, arrangements = _relations(scene, read, names), _arrangements(read, names)
    if not relations and not arrangements:
        raise EditError(f'"{where}" says no place. {_PLACES}')
    if not any(rel.supports and rel.child == name for rel in relations):
        carrier = _usual_carrier(scene, name, relations)
        extra = [Relation(child=name, kind="on", parent=carrier)] if carrier != GROUND else []
        if not extra:
            kept = tuple(rel for rel in scene.relations if not (rel.supports and rel.child == name))
            draft = draft.with_scene(replace(scene, relations=kept))
        relations = (*relations, *extra)
    return related(draft, name, relations, arrangements)


def _read(scene: Scene, phrase: str, planner: Planner, *, first_is_new: bool = False) -> _Read:
    # Planners read "the book", not "the book 2"; a phrase names one of a kind by its number.
    numbered = {name: re.sub(r" \d+$", "", name) for name in _numbered_names(scene, phrase)}
    for name, base in numbered.items():
        phrase = re.sub(rf"\b{re.escape(name)}\b", base, phrase, flags=re.IGNORECASE)
    plan = planner.plan(phrase)
    groups: dict[str, list[str]] = {}
    for obj in plan.objects:
        groups.setdefault(obj.phrase or obj.name, []).append(obj.name)
    new: list[str] = []
    there: dict[str, tuple[str, ...]] = {}
    for number, (said, members) in enumerate(groups.items()):
        definite = _is_definite(said, phrase) and not (first_is_new and number == 0)
        if not definite:
            new += members
            continue
        named = [name for name, base in numbered.items() if re.search(rf"\b{re.escape(base)}$", said, re.IGNORECASE)]
        if len(named) > 1:
            raise EditError(f'"{phrase}" names {", ".join(named)}; name one of a kind by its number at a time.')
        found = tuple(named) or chosen(scene, said, planner, several=True)
        there |= dict.fromkeys(members, found)
    meant = {name for found in there.values() for name in found}
    unread = [name for name in numbered if name not in meant]
    if unread:
        raise EditError(
            f'"{unread[0]}" was not read as something that is there: "a {numbered[unread[0]]} next to the '
            f'{numbered[unread[0]]}" is one to a planner. Name another landmark, or move it there after. Nothing was '
            "written."
        )
    return _Read(plan=plan, new=tuple(new), there=there)


def _numbered_names(scene: Scene, phrase: str) -> list[str]:
    """Names such as "book 2" that `phrase` says, the longest first."""
    numbered = [obj.name for obj in scene.objects if re.search(r" \d+$", obj.name)]
    said = [name for name in numbered if re.search(rf"\b{re.escape(name)}\b", phrase, re.IGNORECASE)]
    return sorted(said, key=len, reverse=True)


def _is_definite(said: str, phrase: str) -> bool:
    """Whether a noun phrase names what is there: "the books"; planners may leave out the article."""
    if re.match(r"(?:the|this|that|these|those|its|all|both)\b", said, re.IGNORECASE):
        return True
    return re.search(rf"\b(?:the|this|that)\s+{re.escape(said)}\b", phrase, re.IGNORECASE) is not None


def _fresh_names(there: set[str], wanted: Sequence[str]) -> dict[str, str]:
    """A name that is not `there` for each of `wanted`; later ones are numbered."""
    taken, names = set(there), {}
    for name in wanted:
        base, number, fresh = re.sub(r" \d+$", "", name), 1, name
        while fresh in taken:
            number += 1
            fresh = f"{base} {number}"
        taken.add(fresh)
        names[name] = fresh
    return names


def _made(scene: Scene, read: _Read) -> tuple[UnplacedObject, ...]:
    """Assets for the new objects."""
    new, plan = set(read.new), read.plan
    part = replace(
        plan,
        objects=tuple(obj for obj in plan.objects if obj.name in new),
        relations=tuple(rel for rel in plan.relations if {rel.child, rel.parent} <= {*new, GROUND}),
        arrangements=tuple(one for one in plan.arrangements if {*one.objects, *one.of} <= new),
        postures=tuple(one for one in plan.postures if one.object in new),
        task=None,
    )
    return objects_of_plan(part, derived_seed(scene.seed, "edit", len(scene.history)), silent)


def _relations(scene: Scene, read: _Read, names: Mapping[str, str]) -> tuple[Relation, ...]:
    """The plan's relations of new objects, to what is in the scene by its names there."""
    found = []
    for rel in read.plan.relations:
        if rel.child not in names and rel.parent not in names:
            continue
        ends = [
            names[end] if end in names else end if end == GROUND else _one_of(scene, read.there[end], rel, end)
            for end in (rel.child, rel.parent)
        ]
        one = Relation(child=ends[0], kind=rel.kind, parent=ends[1])
        if one.supports and one.parent == GROUND:
            continue
        if one not in found:
            found.append(one)
    return tuple(found)


def _one_of(scene: Scene, members: tuple[str, ...], rel: Relation, end: str) -> str:
    """The one of `members` that a relation is to: what is on a stack is on its top, beside it is beside its foot."""
    if len(members) == 1:
        return members[0]
    inner = {one.parent for one in scene.relations if one.supports and one.child in members and one.parent in members}
    free = [name for name in members if name not in inner]
    feet = [name for name in members if scene.parent(name) not in members]
    ends = free if rel.supports else feet
    if len(ends) == 1 or not rel.supports:
        return ends[0]
    listed = ", ".join(f'"{name}"' for name in ends)
    raise EditError(f'"{end}" may be {listed}: say on which of them. Nothing was written.')


def _arrangements(read: _Read, names: Mapping[str, str]) -> tuple[Arrangement, ...]:
    def called(name: str) -> str:
        return names[name] if name in names else read.there[name][0]

    return tuple(
        replace(one, objects=tuple(map(called, one.objects)), of=tuple(map(called, one.of)))
        for one in read.plan.held()
        if set(names) & {*one.objects, *one.of}
    )


def _usual_carrier(scene: Scene, name: str, relations: Sequence[Relation]) -> str:
    """What carries a new object where nobody says: what carries its neighbour, else what carries the most."""
    for rel in relations:
        if not rel.supports and name in (rel.child, rel.parent):
            other = rel.parent if rel.child == name else rel.child
            if other in {obj.name for obj in scene.objects}:
                return scene.parent(other)
    counts: dict[str, int] = {}
    for obj in scene.objects:
        if obj.name != name:
            counts[scene.parent(obj.name)] = counts.get(scene.parent(obj.name), 0) + 1
    # Rather the table than the floor that the table stands on.
    return max(counts, key=lambda one: counts[one] if one != GROUND else 0.5, default=GROUND)
