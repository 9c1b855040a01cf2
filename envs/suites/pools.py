"""What tabletop scenes are made of: things a gripper takes, containers, and what may be said about their looks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

COLOURS = ("red", "blue", "green", "yellow", "orange", "purple", "white", "black", "pink", "teal")

FLAT, STANDING, PLAIN = "flat", "standing", "plain"


@dataclass(frozen=True, kw_only=True)
class Item:
    """A noun of the catalogue that a parallel gripper of 80 mm takes."""

    noun: str
    group: str
    """FLAT: coloured, carries others. STANDING: coloured, carries nothing. PLAIN: has the colour that it has."""
    width: float
    """Longest horizontal extent [m]."""
    height: float
    """At least [m]."""
    materials: tuple[str, ...] = ()
    """Materials that may be named instead of its own."""


_VARIED = ("wood", "rubber", "metal", "plastic")

ITEMS = (
    Item(noun="cube", group=FLAT, width=0.05, height=0.045, materials=_VARIED),
    Item(noun="block", group=FLAT, width=0.08, height=0.045, materials=_VARIED),
    Item(noun="cylinder", group=FLAT, width=0.05, height=0.055, materials=_VARIED),
    Item(noun="can", group=FLAT, width=0.075, height=0.105),
    Item(noun="soda can", group=FLAT, width=0.065, height=0.115),
    Item(noun="soap", group=FLAT, width=0.08, height=0.02),
    Item(noun="sponge", group=FLAT, width=0.11, height=0.025),
    Item(noun="salt shaker", group=STANDING, width=0.055, height=0.075, materials=("porcelain", "metal", "wood")),
    Item(noun="pepper mill", group=STANDING, width=0.06, height=0.185, materials=("wood", "metal", "plastic")),
    Item(noun="spray can", group=STANDING, width=0.075, height=0.185),
    Item(noun="toy car", group=STANDING, width=0.14, height=0.05, materials=("plastic", "metal", "wood")),
    Item(noun="tape measure", group=STANDING, width=0.10, height=0.065),
    Item(noun="soap dispenser", group=STANDING, width=0.075, height=0.165),
    Item(noun="shampoo", group=STANDING, width=0.085, height=0.185),
    Item(noun="bottle", group=STANDING, width=0.075, height=0.22, materials=("plastic", "metal", "glass")),
    Item(noun="stapler", group=STANDING, width=0.15, height=0.055),
    Item(noun="puzzle cube", group=PLAIN, width=0.06, height=0.055),
    Item(noun="apple", group=PLAIN, width=0.08, height=0.075),
    Item(noun="lemon", group=PLAIN, width=0.085, height=0.055),
    Item(noun="lime", group=PLAIN, width=0.075, height=0.045),
    Item(noun="orange", group=PLAIN, width=0.075, height=0.065),
    Item(noun="peach", group=PLAIN, width=0.07, height=0.065),
    Item(noun="plum", group=PLAIN, width=0.05, height=0.055),
    Item(noun="tomato", group=PLAIN, width=0.075, height=0.055),
    Item(noun="onion", group=PLAIN, width=0.075, height=0.07),
    Item(noun="potato", group=PLAIN, width=0.10, height=0.05),
    Item(noun="banana", group=PLAIN, width=0.21, height=0.03),
    Item(noun="egg", group=PLAIN, width=0.06, height=0.04),
    Item(noun="mushroom", group=PLAIN, width=0.05, height=0.035),
    Item(noun="strawberry", group=PLAIN, width=0.045, height=0.035),
    Item(noun="cupcake", group=PLAIN, width=0.075, height=0.08),
    Item(noun="muffin", group=PLAIN, width=0.085, height=0.065),
    Item(noun="cheese", group=PLAIN, width=0.125, height=0.05),
    Item(noun="milk carton", group=PLAIN, width=0.075, height=0.235),
)


@dataclass(frozen=True, kw_only=True)
class Container:
    """A noun of the catalogue that holds or carries several items side by side."""

    noun: str
    kind: str
    """"in" or "on"."""
    capacity: int
    """Items at most."""
    width: float
    """Of the widest item [m]."""
    coloured: bool = True
    lowest: float = 0.0
    """Height of the lowest item that fingers take out of it [m]: the hand stays above the rim."""


CONTAINERS = (
    Container(noun="bowl", kind="in", capacity=1, width=0.075),
    Container(noun="fruit bowl", kind="in", capacity=3, width=0.085, coloured=False),
    Container(noun="basket", kind="in", capacity=3, width=0.125, coloured=False, lowest=0.085),
    Container(noun="pot", kind="in", capacity=3, width=0.085, lowest=0.095),
    Container(noun="tray", kind="on", capacity=4, width=0.15),
    Container(noun="plate", kind="on", capacity=2, width=0.075),
    Container(noun="cutting board", kind="on", capacity=3, width=0.10, coloured=False),
)

HOMES = ("bowl", "pot")
"""What coloured things are sorted into."""

HOME_WIDTH = 0.082
"""Of the widest item that is sorted into a home [m]."""

HELD_OUT = 6
"""One noun of so many is kept for validation, and as many for testing, in every group."""


def partition(seed: int) -> dict[str, tuple[str, ...]]:
    """The nouns of moved objects for "train", "val" and "test": disjoint, and some of every group in each."""
    rng = np.random.default_rng([seed, *b"nouns"])
    parts: dict[str, list[str]] = {"train": [], "val": [], "test": []}
    for group in (FLAT, STANDING, PLAIN):
        # Sorting takes narrow coloured things, so every part gets some of those: the narrow ones are dealt first.
        nouns = [item.noun for item in ITEMS if item.group == group and item.width <= HOME_WIDTH]
        wide = [item.noun for item in ITEMS if item.group == group and item.width > HOME_WIDTH]
        nouns = [nouns[place] for place in rng.permutation(len(nouns))]
        few = max(1, round((len(nouns) + len(wide)) / HELD_OUT))
        parts["val"] += nouns[:few]
        parts["test"] += nouns[few : 2 * few]
        parts["train"] += [*nouns[2 * few :], *wide]
    return {name: tuple(sorted(nouns)) for name, nouns in parts.items()}


def item_of(noun: str) -> Item:
    """The item called `noun`."""
    return next(item for item in ITEMS if item.noun == noun)
