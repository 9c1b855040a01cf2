"""How large what a server makes is: as the catalogue's thing of that kind, or as such things usually are.

The meshes of text-to-3D models fill a unit cube, whatever they show, so that their own size says nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

from pat3d.assets.catalogue import lookup

ASSUMED = 0.2
"""Longest side [m] of what nothing is known about: something to stand on a table."""

USUAL: dict[str, float] = {
    "accordion": 0.4, "anchor": 0.3, "anvil": 0.3, "astrolabe": 0.2, "bagpipe": 0.6, "banjo": 0.9, "barrel": 0.9,
    "bicycle": 1.7, "birdcage": 0.5, "bonsai": 0.35, "boot": 0.3, "bust": 0.45, "cactus": 0.25, "canoe": 2.0,
    "car": 0.3, "castle": 0.35, "cello": 1.2, "chandelier": 0.7, "chest": 0.6, "clarinet": 0.65, "cradle": 0.9,
    "crown": 0.2, "dragon": 0.25, "drone": 0.35, "drum": 0.4, "dumbbell": 0.3, "fountain": 1.0, "gargoyle": 0.4,
    "gnome": 0.35, "gramophone": 0.6, "harmonica": 0.12, "harp": 1.0, "helmet": 0.32, "hourglass": 0.2,
    "lighthouse": 0.3, "locomotive": 0.3, "mandolin": 0.7, "mask": 0.25, "motorcycle": 2.0, "periscope": 0.5,
    "phonograph": 0.5, "piano": 1.5, "pipe": 0.15, "quill": 0.25, "rocket": 0.3, "saddle": 0.6, "samovar": 0.45,
    "saxophone": 0.65, "scooter": 1.0, "sculpture": 0.4, "sextant": 0.25, "shield": 0.6, "skateboard": 0.8,
    "skull": 0.22, "sled": 1.0, "snowman": 0.3, "spaceship": 0.3, "statue": 0.45, "submarine": 0.3, "sundial": 0.3,
    "tank": 0.3, "telescope": 0.8, "theremin": 0.5, "throne": 1.3, "totem": 0.5, "trombone": 1.1, "trophy": 0.35,
    "trumpet": 0.5, "tuba": 1.0, "typewriter": 0.38, "unicorn": 0.25, "violin": 0.6, "wheelbarrow": 1.4,
    "windmill": 0.35, "xylophone": 0.4, "zeppelin": 0.3,
}  # fmt: skip
"""Longest side [m] of things that the catalogue lacks; vehicles and buildings as models of them, where one stands in a
scene of things."""


@dataclass(frozen=True, kw_only=True)
class Sized:
    """How long something is, and why."""

    metres: float
    """Of the longest side."""
    why: str
    like: str = ""
    """The catalogue noun that it is a kind of; empty for none."""


def usual_size(words: str) -> Sized:
    """The size of what `words` name, in the singular: "teapot dinosaur" is as long as a dinosaur of the catalogue.

    The last word tells what it is, with those before it where the catalogue has the whole ("cutting board").
    """
    said = words.lower().split()
    for start in range(len(said)):
        ending = " ".join(said[start:])
        if ending in USUAL:
            return Sized(metres=USUAL[ending], why=f"as a {ending} usually is")
        if (entry := lookup.find(ending)) is not None:
            longest = round(float(max(lookup.make(entry.noun).size)), 3)
            return Sized(metres=longest, why=f"as a {entry.noun} of the catalogue is", like=entry.noun)
    return Sized(metres=ASSUMED, why="assumed; say another size in the sentence")
