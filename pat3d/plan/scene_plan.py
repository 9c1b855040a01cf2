"""What a planner returns: the objects to make and how they relate, before any geometry exists."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, Protocol

from pat3d.errors import PromptError
from pat3d.scene.model import Relation, check_tree, parent_of

Axis = Literal["height", "width", "depth", "length", "thickness"]


@dataclass(frozen=True, kw_only=True)
class Extent:
    """A length that an object is to have, its proportions kept."""

    metres: float
    axis: Axis | None = None
    """None for the longest side."""

    def factor(self, size: Sequence[float]) -> float:
        """By what to scale an object that measures `size` [m], shape (3,): x, y, z."""
        x, y, z = map(float, size)
        measured = {"height": z, "width": x, "depth": y, "length": max(x, y), "thickness": min(x, y, z)}
        return self.metres / (max(x, y, z) if self.axis is None else measured[self.axis])


@dataclass(frozen=True, kw_only=True)
class PlannedObject:
    """One object the prompt asks for (counts are expanded: "two pens" are two of these)."""

    name: str
    """Unique and readable: "black pen 1"."""
    noun: str
    """Catalogue noun; "box" for a proxy."""
    phrase: str = ""
    """The words of the prompt that asked for it."""
    colours: tuple[str, ...] = ()
    """Colour names in the order of the prompt, see pat3d.assets.colours."""
    material: str | None = None
    """Material name, see pat3d.assets.materials; None for the catalogue's default."""
    scale: float = 1.0
    """Factor on the catalogue's dimensions, from "small", "large", ..."""
    extent: Extent | None = None
    """What the prompt measures; the object is scaled to it, whatever `scale` is."""
    adjectives: tuple[str, ...] = ()
    """Words that describe the object and are neither colour, material nor size."""
    proxy: bool = False
    """Whether the noun was unknown and a plain box stands in for it."""


@dataclass(frozen=True, kw_only=True)
class ScenePlan:
    """Objects, relations and the scene tree of a prompt (paper, Algorithm 1)."""

    prompt: str
    objects: tuple[PlannedObject, ...]
    relations: tuple[Relation, ...] = ()
    set_aside: tuple[str, ...] = ()
    """Phrases recognised as background, camera or mood, which place nothing."""
    notes: tuple[str, ...] = field(default=())
    """What the planner decided where the prompt was silent ("stack of books: 3 assumed")."""

    def __post_init__(self) -> None:
        names = [obj.name for obj in self.objects]
        if not names:
            raise PromptError("the prompt names no object to place.")
        repeated = sorted({name for name in names if names.count(name) > 1})
        if repeated:
            raise PromptError(f"object names must be unique; repeated: {', '.join(repeated)}.")
        check_tree(names, self.relations)

    def parent(self, name: str) -> str:
        """Name of what supports object `name`: another object or the ground."""
        return parent_of(name, self.relations)

    def tree(self) -> Mapping[str, tuple[str, ...]]:
        """Children of every object that has some, and of the ground, in the order of the plan."""
        children: dict[str, list[str]] = {}
        for obj in self.objects:
            children.setdefault(self.parent(obj.name), []).append(obj.name)
        return {name: tuple(kids) for name, kids in children.items()}


class Planner(Protocol):
    """Turns a prompt into a plan."""

    def plan(self, prompt: str) -> ScenePlan:
        """Plan `prompt`.

        Raises:
            PromptError: the prompt names nothing that can be made.
        """
        ...
