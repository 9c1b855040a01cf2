"""What suites have opened and shut: drawers of a cabinet, and doors of a microwave, a cabinet and a fridge."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pat3d.plan.doors import HINGED
from pat3d.plan.drawers import DRAWER, DRAWER_CABINET, OPEN_DRAWER
from pat3d.plan.scene_plan import PlannedObject
from pat3d.scene.relations import Relation

DRAWERS, MICROWAVE, CABINET, FRIDGE = FIXTURES = ("drawers", "microwave", "cabinet", "fridge")
_ROWS = ("top", "middle", "bottom")


@dataclass(frozen=True, kw_only=True)
class Fixture:
    """A case and what moves in it, as a sentence asks for it."""

    case: PlannedObject
    moved: PlannedObject
    sentence: str

    @property
    def held(self) -> Relation:
        """What moves is in its case."""
        return Relation(child=self.moved.name, kind="in", parent=self.case.name)


def fixtures(seed: int) -> dict[str, tuple[str, ...]]:
    """Two of the fixtures for training, one each for "val" and "test": those that are held out as objects are."""
    dealt = [FIXTURES[place] for place in np.random.default_rng([seed, *b"fixtures"]).permutation(len(FIXTURES))]
    return {"val": (dealt[0],), "test": (dealt[1],), "train": tuple(dealt[2:])}


def fixture(kind: str, which: str, colour: str, pick: Callable[[tuple[str, ...]], str]) -> Fixture:
    """A fixture that is to be opened or closed: the other way round before that.

    Args:
        kind: "open" or "close".
        which: one of FIXTURES.
        colour: of it.
        pick: draws one of several.
    """
    shut, verb = kind == "open", kind.capitalize()
    if which == DRAWERS:
        row = pick(_ROWS)
        case = _object("cabinet", DRAWER_CABINET, colour, row)
        moved = _object(f"{row} drawer", DRAWER if shut else OPEN_DRAWER, colour, row)
        return Fixture(case=case, moved=moved, sentence=f"{verb} the {row} drawer of the {colour} cabinet")
    name, noun = f"{colour} {which}", HINGED[which]
    moved = _object(f"{name} door", f"{noun} door" if shut else f"open {noun} door", colour)
    return Fixture(case=_object(name, noun, colour), moved=moved, sentence=f"{verb} the {name}")


def _object(name: str, noun: str, colour: str, *adjectives: str) -> PlannedObject:
    return PlannedObject(name=name, noun=noun, phrase=name, colours=(colour,), adjectives=adjectives)
