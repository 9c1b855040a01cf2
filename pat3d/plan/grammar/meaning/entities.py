"""What a sentence tells of while it is being read: objects, what carries them, where they stand, what is to be done."""

from __future__ import annotations

from dataclasses import dataclass, field

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.rewriting.instructions import Manner
from pat3d.plan.grammar.words.links import Link
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS, Modifiers
from pat3d.plan.grammar.words.shapes import COURSES
from pat3d.plan.scene_plan import ArrangementKind
from pat3d.scene.relations import RelationKind


@dataclass(kw_only=True, eq=False)
class Item:
    """One object."""

    group: Group
    colours: tuple[str, ...] | None = None
    """Its own, where the prompt tells it from the others of its group."""
    told: Modifiers = NO_MODIFIERS
    """What the prompt says of it alone."""
    place: str = ""
    """By which it is told from its like: "left" for "the left box"."""
    placed_by: str = ""
    """The words that tell it so: "the left box"."""


@dataclass(kw_only=True, eq=False)
class Group:
    """Objects asked for by one noun phrase."""

    phrase: Phrase
    noun: str
    said: str
    modifiers: Modifiers
    items: list[Item] = field(default_factory=list)
    counted: bool = False
    """Whether the prompt gives the number."""
    exact: bool = False
    """Whether it is a number of objects and not "some"."""
    height: int = 1
    """Objects in each stack; 1 where they are not stacked."""
    rows: int = 0
    """Rows that the objects stand in; 0 where nothing is said."""
    pyramid: bool = False
    heap: bool = False
    proxy: bool = False
    multiplied: bool = False
    """Whether there are as many for each of several objects: "three plates, each with two eggs"."""
    replaced: bool = False
    """A generic whose members were listed ("plush toys, including ...")."""

    @property
    def words(self) -> str:
        """As written in the prompt."""
        return self.phrase.words

    @property
    def lowest(self) -> int:
        """Members in the lowest row of the pyramid that they stand in; 0 where they stand in none."""
        return COURSES.get(len(self.items), 0) if self.pyramid else 0

    @property
    def cycle(self) -> tuple[str, ...]:
        """Nouns standing in turn for a generic ("fruit")."""
        return self.phrase.cycle


@dataclass(kw_only=True, eq=False)
class Edge:
    """A support, or a lateral relation, of `child`."""

    child: Item
    kind: RelationKind
    parent: Item
    weak: bool = False
    """Guessed from "with": gives way to anything the prompt says outright."""


@dataclass(kw_only=True, eq=False)
class Sided:
    """Objects said to be on the left, in the middle, behind, ... of something that is not said with it."""

    items: list[Item]
    side: str
    """left, right, one, other, centre, front or back."""
    owner: list[Item]
    """What has the side, where the prompt lets know."""
    implied: list[Item]
    """What they stand beside where nothing else is on a side."""
    begun: bool = False
    """Whether the clause begins with `implied`, so that the side is its side: "a mug, a spoon on the left"."""


@dataclass(kw_only=True, eq=False)
class Arranged:
    """What people say about places beyond relations."""

    kind: ArrangementKind
    items: list[Item]
    of: list[Item]
    arranged: bool = False
    otherwise: str = ""
    """What a note says of it where the scene cannot hold it; empty where the relations say it in any case."""
    exact: bool = True
    """Whether the kind is what was said: "gazing at" says more than "facing"."""


@dataclass(frozen=True, kw_only=True)
class Step:
    """One thing to do."""

    manner: Manner
    said: str
    """The clause, as written."""
    verb: str = ""
    part: str = ""
    """What of the clause says it, where that asks for several: "the fork beside it"."""
    items: tuple[Item, ...]
    link: Link | None = None
    goal: tuple[Item, ...] = ()
