"""A request for a scene, whatever it came from, and the objects that a plan asks for, made from the catalogue."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.plan.telling import tell
from pat3d.progress import Event, Progress
from pat3d.scene.arrangements import Arrangement, PostureKind
from pat3d.scene.asset import Asset
from pat3d.scene.model import Relation
from pat3d.scene.naming import APART
from pat3d.scene.relations import built_together

if TYPE_CHECKING:
    from pat3d.assets.catalogue import Entry

MATCHING = frozenset({"bathroom", "furniture", "storage", "tableware"})
"""Families whose equal objects come as a set: four plates are four of one plate, four apples are four apples."""
_PAIRED = frozenset({"shoe", "boot", "slipper", "sock", "glove"})
"""Nouns of other families that are alike too: nobody has a yellow and a black boot."""
_PROPPED = frozenset({"picture frame"})
"""Nouns of what stands on a prop of its own, which is folded away where it leans on something."""
_BARS = frozenset({"towel rail"})
"""Nouns of what cloth hangs over in its whole width."""
_STOOD = frozenset({"plate", "saucer"})
"""Nouns of what stands on its edge between the pegs of a dish rack."""
_ONE_BY_ONE = frozenset({"cup", "mug"})
"""Nouns of such families of which people have one of each colour."""


@dataclass(frozen=True, kw_only=True, eq=False)
class UnplacedObject:
    """One object of a scene before it has a place."""

    name: str
    asset: Asset
    phrase: str = ""
    fixed: bool = False
    pose: Pose | None = None
    """Where the user wants it; None where the layout decides."""
    note: str = ""
    """What was decided about it where the prompt was silent."""
    posture: PostureKind | None = None
    """How it is turned; None where nothing is said."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SceneRequest:
    """What to make, whether it came from a sentence or from a specification."""

    prompt: str
    names: tuple[str, ...]
    relations: tuple[Relation, ...]
    fingerprint: Any
    """JSON data that decides the assets, the relations and the given poses, apart from the seed."""
    make_objects: Callable[[int, Progress], tuple[UnplacedObject, ...]]
    """Makes the objects, in the order of `names`, for a seed."""
    record: Mapping[str, Any] = field(default_factory=dict)
    """What the report says about how this was understood; JSON-serialisable."""
    arrangements: tuple[Arrangement, ...] = ()
    """What is said beyond the relations."""
    adjustable: bool = True
    """Whether another layout seed can make a difference."""
    task: str | None = None
    """What the environment of the scene is about where nobody says."""
    provenance: Mapping[str, Any] = field(default_factory=lambda: {"source": "prompt"})
    """Where it came from; JSON-serialisable."""


def derived_seed(seed: int, *words: str | int) -> int:
    """A seed that differs for every `seed` and every choice of `words`."""
    entropy = [seed]
    for word in words:
        entropy += [len(word), *word.encode()] if isinstance(word, str) else [word]
    return int(np.random.SeedSequence(entropy).generate_state(1)[0])


def request_of(plan: ScenePlan, allow_proxies: bool) -> SceneRequest:
    """What `plan` asks for."""
    objects = [_plain(obj) for obj in plan.objects]
    arranged = [[one.kind, one.objects, one.of] for one in plan.held()]
    postured = [[one.object, one.kind] for one in plan.turned()]
    foreign = foreign_assets(obj.noun for obj in plan.objects)
    return SceneRequest(
        prompt=plan.prompt,
        names=tuple(obj.name for obj in plan.objects),
        relations=plan.relations,
        fingerprint=[objects, [[rel.child, rel.kind, rel.parent] for rel in plan.relations], allow_proxies]
        + ([arranged, postured] if arranged or postured else [])
        + ([foreign] if foreign else [])
        + ([plan.task] if "beside:" in (plan.task or "") else []),
        arrangements=plan.held(),
        make_objects=lambda seed, progress: objects_of_plan(plan, seed, progress),
        task=plan.task,
        record={
            "objects": objects,
            "notes": list(plan.notes),
            "set_aside": list(plan.set_aside),
            "told": tell(plan),
            "otherwise": plan.otherwise,
            "task": plan.task,
            "arrangements": [asdict(each) for each in plan.arrangements],
            "postures": [asdict(each) for each in plan.postures],
            "proxies": [obj.name for obj in plan.objects if obj.proxy],
        },
    )


def foreign_assets(nouns: Iterable[str]) -> Mapping[str, str]:
    """What decides the assets of `nouns` that are not the catalogue's."""
    found = [noun for noun in nouns if APART in noun]
    if not found:
        return {}
    from pat3d.assets.sources import fingerprint

    return fingerprint(found)


def objects_of_plan(plan: ScenePlan, seed: int, progress: Progress) -> tuple[UnplacedObject, ...]:
    """An asset for every planned object; equal objects of a set share one."""
    from pat3d.assets import catalogue, sources
    from pat3d.assets.variant import ON_A_HOOK, OVER_A_BAR, WITH_PEGS, Variant
    from pat3d.generation.sizing import crossings, enlarged_trays, fitting_lids, high_hooks

    together = built_together([obj.name for obj in plan.objects], plan.relations)
    planned = {obj.name: obj for obj in plan.objects}
    colours = _different_colours(plan.objects, seed)
    leaning = {name for one in plan.held() if one.kind == "leaning_against" for name in one.objects}

    hung = {rel.child: rel.parent for rel in plan.relations if rel.kind == "hangs_from"}

    racks = {rel.parent for rel in plan.relations if rel.kind == "in" and planned[rel.child].noun in _STOOD}

    def adjectives(obj: PlannedObject) -> tuple[str, ...]:
        """What is said of it, and what follows from how it is held and from what it holds."""
        if obj.name in racks and obj.noun == "dish rack":
            return (*obj.adjectives, WITH_PEGS)
        if obj.name in hung:
            return (*obj.adjectives, OVER_A_BAR if planned[hung[obj.name]].noun in _BARS else ON_A_HOOK)
        folded = obj.name in leaning and obj.noun in _PROPPED
        return (*obj.adjectives, "leaning") if folded else obj.adjectives

    def make(name: str, factor: float = 1.0) -> Asset:
        obj = planned[name]
        asked = Variant(
            # What carries one thing together has to be of one height, whatever its colour.
            seed=derived_seed(seed, together.get(name, name)),
            scale=obj.scale,
            colours=obj.colours or colours.get(name, ()),
            material=obj.material,
            adjectives=adjectives(obj),
        )
        if obj.extent is not None:
            usual = sources.make(obj.noun, asked)
            asked = replace(asked, scale=asked.scale * obj.extent.factor(usual.size.tolist()))
        return sources.make(obj.noun, replace(asked, scale=asked.scale * factor))

    made: dict[tuple, Asset] = {}
    assets: dict[str, Asset] = {}
    for number, obj in enumerate(plan.objects):
        progress(Event(stage="making assets", detail=obj.name, step=number, steps=len(plan.objects)))
        look = (obj.noun, obj.colours, obj.material, obj.scale, obj.extent, adjectives(obj))
        entry = catalogue.find(obj.noun)
        shared = entry is not None and _is_set(entry)
        key = (look, colours.get(obj.name), obj.phrase if shared else together.get(obj.name, obj.name))
        if key not in made:
            made[key] = make(obj.name)
        assets[obj.name] = made[key]
    notes: dict[str, str] = {}
    for name, (larger, factor) in enlarged_trays(plan, assets, make).items():
        assets[name] = larger
        notes[name] = f'"{name}" is {factor:g} times its usual size, for all that is on it to stand side by side.'
    for name, (other, factor) in crossings(plan, assets, make).items():
        assets[name] = other
        notes[name] = f'"{name}" is {factor:g} times its usual size, for one thing to lie across another.'
    for name, (taller, factor) in high_hooks(plan, assets, make).items():
        assets[name] = taller
        notes[name] = f'"{name}" is {factor:g} times its usual size, for what hangs on it to be off the ground.'
    for name, (fitting, factor) in fitting_lids(plan, assets, make).items():
        assets[name] = fitting
        notes[name] = f'"{name}" is {factor:g} times its usual size, to close what it is on.'
    turned: dict[str, PostureKind] = {one.object: one.kind for one in plan.turned()}
    return tuple(
        UnplacedObject(
            name=obj.name,
            asset=assets[obj.name],
            phrase=obj.phrase,
            note=notes.get(obj.name, ""),
            posture=turned.get(obj.name),
        )
        for obj in plan.objects
    )


def _is_set(entry: Entry) -> bool:
    return (entry.family in MATCHING and entry.noun not in _ONE_BY_ONE) or entry.noun in _PAIRED


def _different_colours(objects: Sequence[PlannedObject], seed: int) -> dict[str, tuple[str, ...]]:
    """Colours of equal objects that the plan leaves open, as different as the catalogue has them, by name."""
    from pat3d.assets import catalogue

    open_ones: dict[str, list[str]] = {}
    for obj in objects:
        if not obj.colours and not obj.material:
            open_ones.setdefault(obj.noun, []).append(obj.name)
    found: dict[str, tuple[str, ...]] = {}
    for noun, names in open_ones.items():
        entry = catalogue.find(noun)
        if len(names) > 1 and entry is not None and len(entry.colours) > 1 and not _is_set(entry):
            order = np.random.default_rng(derived_seed(seed, "colours", noun)).permutation(len(entry.colours))
            found |= {name: (entry.colours[order[k % len(order)]],) for k, name in enumerate(names)}
    return found


def _plain(obj: PlannedObject) -> dict[str, Any]:
    """A planned object as JSON data."""
    return {
        "name": obj.name,
        "noun": obj.noun,
        "phrase": obj.phrase,
        "colours": list(obj.colours),
        "material": obj.material,
        "scale": obj.scale,
        "adjectives": list(obj.adjectives),
        "proxy": obj.proxy,
        "extent": asdict(obj.extent) if obj.extent else None,
    }
