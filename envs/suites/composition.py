"""Sampled tabletop compositions: objects, what carries them, the sentence that says so, and the task they are for.

A composition is a core, which the task needs, a side group beside it, and loose objects up to the number asked for. Core
and side group together are the composition's structure. Some structures, and some nouns of moved objects, occur in no
training scene: they are what validation and testing by layout and by object are about.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pat3d.envs.suites.pools import (
    COLOURS,
    CONTAINERS,
    FLAT,
    HOME_WIDTH,
    HOMES,
    ITEMS,
    PLAIN,
    STANDING,
    Container,
    item_of,
    partition,
)
from pat3d.envs.suites.request import Request
from pat3d.gather import derived_seed
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene import GROUND, Relation, SupportKind

_NAMED_MATERIAL = 0.4
"""Share of things that come in several materials whose material is named."""

_STACKED_WIDTH = 0.09
"""Of the widest thing put on top of another [m]."""

_DRAWS = 200


@dataclass(frozen=True, kw_only=True)
class Draft:
    """A scene before anything of it is made."""

    plan: ScenePlan
    task: str
    """As `parse_task` reads it."""
    structure: str
    """Core and side group."""
    moved: tuple[str, ...]
    """Names of the objects that the task is to move."""
    places: tuple[str, ...]
    """Names of what they are moved from or to, apart from the ground."""
    scene_seed: int


@dataclass(frozen=True, kw_only=True)
class Core:
    """What a task needs in its scene."""

    name: str
    size: int
    """Objects that it adds."""
    build: Callable[[Composer], str]
    """Adds them, and says which task they are for."""


def draft(request: Request, place: int, candidate: int) -> Draft:
    """The `candidate`-th composition for a place of the suite, both from 0; the same arguments give the same one."""
    seed = derived_seed(request.seed, "suite", place, candidate)
    kind, split = request.task_of(place), request.split_of(place)
    part, _, held_out = split.partition("/")
    structures = structure_splits(request, kind)["train" if held_out == "object" else part]
    nouns = partition(request.seed)
    for draw in range(_DRAWS):
        rng = np.random.default_rng([seed, draw])
        core, side = structures[int(rng.integers(len(structures)))]
        composer = Composer(rng, moved=nouns[part if held_out == "object" else "train"], others=nouns["train"])
        try:
            task = core.build(composer)
            side.build(composer)
            least = max(request.objects[0], core.size + side.size)
            composer.fill(int(rng.integers(least, request.objects[1] + 1)))
        except _Exhausted:
            continue
        return Draft(
            plan=composer.plan(), task=task, structure=_name(core, side), moved=tuple(composer.moved),
            places=tuple(composer.places), scene_seed=derived_seed(seed, "scene"),
        )  # fmt: skip
    raise RuntimeError(f"no composition for place {place} of {request}")


def structure_splits(request: Request, kind: str) -> dict[str, list[tuple[Core, Core]]]:
    """The structures of a task for "train", "val" and "test": disjoint, a tenth and at least one for each of the last."""
    most = request.objects[1]
    known = [(core, side) for core in CORES[kind] for side in SIDES if core.size + side.size <= most]
    order = np.random.default_rng([request.seed, *f"structures {kind}".encode()]).permutation(len(known))
    few = max(1, round(len(known) / 10))
    dealt = [known[place] for place in order]
    return {"val": dealt[:few], "test": dealt[few : 2 * few], "train": dealt[2 * few :]}


def structure_names(request: Request, kind: str) -> dict[str, list[str]]:
    """`structure_splits` in words."""
    return {
        part: sorted(_name(core, side) for core, side in found)
        for part, found in structure_splits(request, kind).items()
    }


def _name(core: Core, side: Core) -> str:
    return f"{core.name} + {side.name}"


class _Exhausted(Exception):
    """No noun or name is left that fits."""


class Composer:
    """Collects the objects of one composition."""

    def __init__(self, rng: np.random.Generator, *, moved: tuple[str, ...], others: tuple[str, ...]) -> None:
        self.rng, self._nouns = rng, {True: moved, False: others}
        self.objects: list[PlannedObject] = []
        self.relations: list[Relation] = []
        self.moved: list[str] = []
        self.places: list[str] = []
        self.avoid: tuple[str, ...] = ()
        """Colours that mean something in this scene, so that bystanders have others."""
        self.coloured_only = False

    def item(
        self, parent: str = GROUND, kind: SupportKind = "on", *, moved: bool = False,
        groups: tuple[str, ...] = (FLAT, STANDING, PLAIN), width: float = 1.0, colour: str | None = None,
    ) -> str:  # fmt: skip
        """Add something a gripper takes, at most `width` [m] wide; returns its name."""
        if colour is not None or self.coloured_only:
            groups = tuple(group for group in groups if group != PLAIN)
        fitting = [
            item.noun for item in ITEMS
            if item.noun in self._nouns[moved] and item.group in groups and item.width <= width
        ]  # fmt: skip
        if not fitting:
            raise _Exhausted
        item = item_of(self._pick(fitting))
        material = None
        if item.materials and self.rng.random() < _NAMED_MATERIAL:
            material = self._pick(item.materials)
        if item.group == PLAIN:
            colours: tuple[str, ...] = ()
        else:
            colours = (colour or self._pick([name for name in COLOURS if name not in self.avoid]),)
        name = self._add(item.noun, colours, material, parent, kind)
        if moved:
            self.moved.append(name)
        return name

    def container(self, kind: str | None = None, *, room: int = 1, place: bool = False) -> tuple[str, Container]:
        """Add something that takes `room` items; returns its name and what it is."""
        fitting = [one for one in CONTAINERS if one.room >= room and kind in (None, one.kind)]
        chosen = fitting[int(self.rng.integers(len(fitting)))]
        colours = (self._pick([c for c in COLOURS if c not in self.avoid]),) if chosen.coloured else ()
        name = self._add(chosen.noun, colours, None, GROUND, "on")
        if place:
            self.places.append(name)
        return name, chosen

    def home(self, colour: str) -> str:
        """Add what things of one colour are sorted into."""
        name = self._add(self._pick(HOMES), (colour,), None, GROUND, "on")
        self.places.append(name)
        return name

    def into(self, where: tuple[str, Container], *, moved: bool = False) -> str:
        """Add something in or on a container."""
        name, container = where
        # The grammar reads a bowl of fruit as a fruit bowl.
        groups = (FLAT, STANDING) if container.noun == "bowl" else (FLAT, STANDING, PLAIN)
        kind: SupportKind = "in" if container.kind == "in" else "on"
        return self.item(name, kind, moved=moved, groups=groups, width=container.width)

    def tower(self, height: int, *, parent: str = GROUND) -> str:
        """Add flat things one upon another; returns the topmost."""
        for _ in range(height):
            width = 1.0 if parent == GROUND else _STACKED_WIDTH
            parent = self.item(parent, "on", groups=(FLAT,), width=width)
        return parent

    def fill(self, count: int) -> None:
        """Add loose things until there are `count` objects."""
        while len(self.objects) < count:
            self.item()

    def plan(self) -> ScenePlan:
        """Everything, with the sentence that describes it."""
        prompt = self._sentence()
        return ScenePlan(prompt=prompt, objects=tuple(self.objects), relations=tuple(self.relations))

    def _pick(self, of: list[str] | tuple[str, ...]) -> str:
        return of[int(self.rng.integers(len(of)))]

    def _add(
        self, noun: str, colours: tuple[str, ...], material: str | None, parent: str, kind: SupportKind
    ) -> str:  # fmt: skip
        # Naming a thing's own material would be no different from not naming it, but reads oddly beside "red".
        words = [*colours, *([_ADJECTIVES.get(material, material)] if material else []), noun]
        name = " ".join(words)
        if any(obj.name == name for obj in self.objects):
            raise _Exhausted
        self.objects.append(PlannedObject(name=name, noun=noun, phrase=name, colours=colours, material=material))
        if parent != GROUND:
            self.relations.append(Relation(child=name, kind=kind, parent=parent))
        return name

    def _sentence(self) -> str:
        roots = [obj.name for obj in self.objects if all(rel.child != obj.name for rel in self.relations)]
        shuffled = [roots[place] for place in self.rng.permutation(len(roots))]
        carriers = {rel.parent for rel in self.relations}
        loose = [_a(name) for name in shuffled if name not in carriers]
        # A sentence for each group: in a list, "on it" may be read as said of everything before.
        sentences = [self._words(name) for name in shuffled if name in carriers] + ([_listed(loose)] if loose else [])
        return " ".join(f"{text[0].upper()}{text[1:]}." for text in sentences)

    def _words(self, root: str) -> str:
        on = [rel for rel in self.relations if rel.parent == root]
        noun = next(obj.noun for obj in self.objects if obj.name == root)
        if any(noun == one.noun for one in CONTAINERS):
            return f"{_a(root)} with {_listed([_a(rel.child) for rel in on])} {on[0].kind} it"
        tower, top = [root], root
        while above := next((rel.child for rel in self.relations if rel.parent == top), None):
            tower.append(above)
            top = above
        return " on ".join(_a(name) for name in reversed(tower))


_ADJECTIVES = {"wood": "wooden"}


def _a(name: str) -> str:
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def _listed(parts: list[str]) -> str:
    if len(parts) < 3:
        return " and ".join(parts)
    return f"{', '.join(parts[:-1])}, and {parts[-1]}"


def _pick_loose(c: Composer) -> str:
    return f"pick:{c.item(moved=True)}"


def _pick_in(c: Composer) -> str:
    return f"pick:{c.into(c.container('in', place=True), moved=True)}"


def _pick_beside(c: Composer) -> str:
    carrier = c.container("on", room=2, place=True)
    target = c.into(carrier, moved=True)
    c.into(carrier)
    return f"pick:{target}"


def _pick_top(height: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        return f"pick:{_on_tower(c, height)}"

    return build


def _on_tower(c: Composer, height: int) -> str:
    """Something to move, on top of `height` others."""
    base = c.tower(height)
    c.places.append(base)
    return c.item(base, "on", moved=True, groups=(FLAT, STANDING), width=_STACKED_WIDTH)


def _place_loose(kind: str, companions: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, room=companions + 1, place=True)
        for _ in range(companions):
            c.into(where)
        return f"place:{c.item(moved=True, width=where[1].width)}:{where[0]}"

    return build


def _place_from_tower(c: Composer) -> str:
    where = c.container(place=True)
    base = c.tower(1)
    width = min(_STACKED_WIDTH, where[1].width)
    return f"place:{c.item(base, 'on', moved=True, groups=(FLAT, STANDING), width=width)}:{where[0]}"


def _place_across(c: Composer) -> str:
    where = c.container("in", place=True)
    source = c.container("on", place=True)
    width = min(where[1].width, source[1].width)
    return f"place:{c.item(source[0], 'on', moved=True, width=width)}:{where[0]}"


def _stack_loose(height: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        base = c.tower(height)
        c.places.append(base)
        return f"stack:{c.item(moved=True, groups=(FLAT, STANDING), width=_STACKED_WIDTH)}:{base}"

    return build


def _stack_from(kind: str) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        source = c.container(kind, place=True)
        base = c.tower(1)
        c.places.append(base)
        width = min(source[1].width, _STACKED_WIDTH)
        carried = "in" if source[1].kind == "in" else "on"
        return f"stack:{c.item(source[0], carried, moved=True, groups=(FLAT, STANDING), width=width)}:{base}"

    return build


def _sort(first: int, second: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        # White and black would make homes of the wooden and steel things that are called so.
        colours = [COLOURS[place] for place in c.rng.permutation(6)[:2]]
        c.avoid, c.coloured_only = tuple(colours), True
        for colour, count in zip(colours, (first, second), strict=True):
            c.home(colour)
            for _ in range(count):
                c.item(moved=True, colour=colour, width=HOME_WIDTH)
        return "sort"

    return build


def _unload(kind: str, count: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, room=count, place=True)
        for _ in range(count):
            c.into(where, moved=True)
        return f"unload:{where[0]}"

    return build


def _retrieve(height: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        target = c.item(moved=True, groups=(FLAT,), width=_STACKED_WIDTH)
        c.places.append(c.tower(height, parent=target))
        return f"retrieve:{target}"

    return build


def _core(name: str, size: int, build: Callable[[Composer], str]) -> Core:
    return Core(name=name, size=size, build=build)


CORES: dict[str, tuple[Core, ...]] = {
    "pick": (
        _core("loose", 1, _pick_loose), _core("in a container", 2, _pick_in),
        _core("beside another on a carrier", 3, _pick_beside), _core("on top of one", 2, _pick_top(1)),
        _core("on top of two", 3, _pick_top(2)),
    ),
    "place": (
        _core("into an empty container", 2, _place_loose("in", 0)),
        _core("onto an empty carrier", 2, _place_loose("on", 0)),
        _core("beside another in a container", 3, _place_loose("in", 1)),
        _core("beside another on a carrier", 3, _place_loose("on", 1)),
        _core("from a stack", 3, _place_from_tower), _core("from a carrier into a container", 3, _place_across),
    ),
    "stack": (
        _core("on one", 2, _stack_loose(1)), _core("on two", 3, _stack_loose(2)), _core("on three", 4, _stack_loose(3)),
        _core("from a carrier", 3, _stack_from("on")), _core("from a container", 3, _stack_from("in")),
    ),
    "sort": (
        _core("one and one", 4, _sort(1, 1)), _core("two and one", 5, _sort(2, 1)), _core("two and two", 6, _sort(2, 2)),
        _core("three and one", 6, _sort(3, 1)),
    ),
    "unload": (
        _core("two from a container", 3, _unload("in", 2)), _core("two from a carrier", 3, _unload("on", 2)),
        _core("three from a container", 4, _unload("in", 3)), _core("three from a carrier", 4, _unload("on", 3)),
    ),
    "retrieve": (_core("under one", 2, _retrieve(1)), _core("under two", 3, _retrieve(2))),
}  # fmt: skip


def _side_none(c: Composer) -> str:
    return ""


def _side_tower(height: int) -> Callable[[Composer], str]:
    return lambda c: c.tower(height)


def _side_container(kind: str, count: int) -> Callable[[Composer], str]:
    def build(c: Composer) -> str:
        where = c.container(kind, room=count)
        for _ in range(count):
            c.into(where)
        return where[0]

    return build


SIDES = (
    _core("nothing", 0, _side_none), _core("a stack of two", 2, _side_tower(2)), _core("a stack of three", 3, _side_tower(3)),
    _core("one in a container", 2, _side_container("in", 1)), _core("two on a carrier", 3, _side_container("on", 2)),
    _core("two in a container", 3, _side_container("in", 2)),
)  # fmt: skip
