"""Collects the objects of a composition, and says it in sentences that the grammar reads back."""

from __future__ import annotations

import numpy as np

from pat3d.assets import catalogue
from pat3d.envs.suites.fixtures import FIXTURES, fixture
from pat3d.envs.suites.pools import (
    COLOURS,
    CONTAINERS,
    FLAT,
    HOMES,
    ITEMS,
    PLAIN,
    STANDING,
    UNCOLOURED,
    Container,
    item_of,
)
from pat3d.plan.grammar.words.lexicon import SIZES
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.relations import GROUND, Relation, SupportKind

STACKED_WIDTH = 0.09
"""Of the widest thing put on top of another [m]."""

_NAMED_MATERIAL = 0.4
"""Share of things that come in several materials whose material is named."""


def natural(noun: str) -> set[str]:
    """Colours that a thing has of itself."""
    found = catalogue.find(noun)
    return set() if found is None else set(found.colours)


class ExhaustedError(Exception):
    """No noun or name is left that fits."""


class Composer:
    """Collects the objects of one composition."""

    def __init__(
        self,
        rng: np.random.Generator,
        *,
        moved: tuple[str, ...],
        others: tuple[str, ...],
        fixtures: tuple[str, ...] = FIXTURES,
    ) -> None:
        self.rng, self._nouns, self._fixtures = rng, {True: moved, False: others}, fixtures
        self.objects: list[PlannedObject] = []
        self.relations: list[Relation] = []
        self.moved: list[str] = []
        self.places: list[str] = []
        self.avoid: tuple[str, ...] = ()
        """Colours that mean something in this scene, so that bystanders have others."""
        self.container_colours: tuple[str, ...] | None = None
        """Of containers that are no homes; None for any colour that means nothing."""
        self.coloured_only = False
        self.least_silhouette = 0.0
        """Width times height that what is moved has at least [m^2], where anything that fits has as much."""
        self._asked: dict[str, str] = {}
        """Sentences that ask for something, by the names of what it is done to."""
        self._scales: dict[str, float] = {}
        """Of sizes that the moved things' names say, by the word; empty where they say none."""

    def item(
        self,
        parent: str = GROUND,
        kind: SupportKind = "on",
        *,
        moved: bool = False,
        groups: tuple[str, ...] = (FLAT, STANDING, PLAIN),
        width: float = 1.0,
        height: float = 0.0,
        colour: str | None = None,
    ) -> str:
        """Add something a gripper takes, at most `width` and at least `height` [m]; returns its name."""
        if colour is not None or self.coloured_only:
            groups = tuple(group for group in groups if group not in UNCOLOURED)
        size = self._pick(tuple(self._scales)) if moved and self._scales else ""
        if size:
            groups = tuple(group for group in groups if group not in UNCOLOURED) or groups
        scale = self._scales.get(size, 1.0)
        # What is moved is seen against what it comes from and goes to.
        hidden = self._colours({parent, *self.places} if moved else {parent})
        fitting = [
            item.noun
            for item in ITEMS
            if item.noun in self._nouns[moved]
            and item.group in groups
            and item.width * scale <= width
            and item.height * scale >= height
            and (item.sized or not size)
            and not (item.group in UNCOLOURED and hidden & natural(item.noun))
        ]
        if not fitting:
            raise ExhaustedError
        if moved and self.least_silhouette:
            fitting = [noun for noun in fitting if silhouette(noun, scale) >= self.least_silhouette] or fitting
        item = item_of(self._pick(fitting))
        material = None
        if item.materials and self.rng.random() < _NAMED_MATERIAL:
            material = self._pick(item.materials)
        if item.group in UNCOLOURED:
            colours: tuple[str, ...] = ()
        else:
            colours = (colour or self._pick([name for name in COLOURS if name not in {*self.avoid, *hidden}]),)
        name = self._add(item.noun, colours, material, parent, kind, size)
        if moved:
            self.moved.append(name)
        return name

    def size_words(self, kind: str) -> None:
        """Half of all compositions for a task say how large the moved things are; call it before any is added.

        What is to be sorted by its colour has its double in another colour always: one of its own has the same home.
        """
        if kind != "sort" and self.rng.random() < 0.5:
            self._scales = dict(_SIZES)

    def lookalikes(self, count: int) -> None:
        """Add loose things that are like those that are moved: of another size or colour, or of the same kind."""
        moved = [obj for obj in self.objects if obj.name in self.moved]
        if self._asked:
            # A second fixture has no room on a table.
            self.fill(len(self.objects) + count)
            return
        for number in range(count):
            like = moved[number % len(moved)]
            first = number < len(moved)
            if self._scales and first:
                sizes = tuple(word for word in self._scales if not like.name.startswith(f"{word} "))
                self._add(like.noun, like.colours, like.material, GROUND, "on", self._pick(sizes))
            elif like.colours:
                free = [name for name in COLOURS if name not in {*self.avoid, *like.colours}]
                size = next((word for word in self._scales if like.name.startswith(f"{word} ")), "")
                self._add(like.noun, (self._pick(free),), like.material, GROUND, "on", size)
            else:
                own = item_of(like.noun)
                kin = [
                    one.noun for one in ITEMS if one.group == own.group and one.meaning == own.meaning and one != own
                ]
                if not kin:
                    raise ExhaustedError
                self._add(self._pick(kin), (), None, GROUND, "on")

    def container(self, kind: str | None = None, *, capacity: int = 1, place: bool = False) -> tuple[str, Container]:
        """Add something that takes `capacity` items; returns its name and what it is."""
        fitting = [one for one in CONTAINERS if one.capacity >= capacity and kind in (None, one.kind)]
        chosen = fitting[int(self.rng.integers(len(fitting)))]
        free = self.container_colours or tuple(name for name in COLOURS if name not in self.avoid)
        colours = (self._pick(free),) if chosen.coloured else ()
        name = self._add(chosen.noun, colours, None, GROUND, "on")
        if place:
            self.places.append(name)
        return name, chosen

    def home(self, colour: str) -> str:
        """Add what things of one colour are sorted into."""
        name = self._add(self._pick(HOMES), (colour,), None, GROUND, "on")
        self.places.append(name)
        return name

    def fixture(self, kind: str) -> str:
        """Add a drawer or a door, and its case, to "open" or to "close"; returns its name."""
        made = fixture(kind, self._pick(self._fixtures), self._pick(COLOURS), self._pick)
        self.objects += [made.case, made.moved]
        self.relations.append(made.held)
        self.moved.append(made.moved.name)
        self.places.append(made.case.name)
        self._asked[made.case.name] = made.sentence
        return made.moved.name

    def into(self, where: tuple[str, Container], *, moved: bool = False) -> str:
        """Add something in or on a container."""
        name, container = where
        # The grammar reads a bowl of fruit as a fruit bowl.
        groups = (FLAT, STANDING) if container.noun == "bowl" else (FLAT, STANDING, PLAIN)
        kind: SupportKind = "in" if container.kind == "in" else "on"
        height = container.lowest if moved else 0.0
        return self.item(name, kind, moved=moved, groups=groups, width=container.width, height=height)

    def tower(self, height: int, *, parent: str = GROUND) -> str:
        """Add flat things one upon another; returns the topmost."""
        for _ in range(height):
            width = 1.0 if parent == GROUND else STACKED_WIDTH
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

    def _colours(self, names: set[str]) -> set[str]:
        """Of the objects with these names."""
        found = (set(obj.colours) or natural(obj.noun) for obj in self.objects if obj.name in names)
        return set().union(*found)

    def _pick(self, of: list[str] | tuple[str, ...]) -> str:
        return of[int(self.rng.integers(len(of)))]

    def _add(
        self,
        noun: str,
        colours: tuple[str, ...],
        material: str | None,
        parent: str,
        kind: SupportKind,
        size: str = "",
    ) -> str:
        # Naming a thing's own material would be no different from not naming it, but reads oddly beside "red".
        made_of = [_ADJECTIVES.get(material, material)] if material else []
        words = [*([size] if size else []), *colours, *made_of, noun]
        name = " ".join(words)
        if any(obj.name == name for obj in self.objects):
            raise ExhaustedError
        scale = _SIZES.get(size, 1.0)
        self.objects.append(
            PlannedObject(name=name, noun=noun, phrase=name, colours=colours, material=material, scale=scale)
        )
        if parent != GROUND:
            self.relations.append(Relation(child=name, kind=kind, parent=parent))
        return name

    def _sentence(self) -> str:
        roots = [obj.name for obj in self.objects if all(rel.child != obj.name for rel in self.relations)]
        shuffled = [roots[place] for place in self.rng.permutation(len(roots))]
        carriers = {rel.parent for rel in self.relations} - self._asked.keys()
        shuffled = [name for name in shuffled if name not in self._asked]
        loose = [_a(name) for name in shuffled if name not in carriers]
        # A sentence for each group: in a list, "on it" may be read as said of everything before.
        sentences = [self._words(name) for name in shuffled if name in carriers] + ([_listed(loose)] if loose else [])
        sentences = [*self._asked.values(), *sentences]
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


def silhouette(noun: str, scale: float) -> float:
    """Width times height of an item [m^2]."""
    item = item_of(noun)
    return item.width * item.height * scale**2


_ADJECTIVES = {"wood": "wooden"}

_SIZES = {word: SIZES[word] for word in ("small", "large")}


def _a(name: str) -> str:
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def _listed(parts: list[str]) -> str:
    if len(parts) < 3:
        return " and ".join(parts)
    return f"{', '.join(parts[:-1])}, and {parts[-1]}"
