"""What a task puts things in, by its catalogue noun: what it names else they are put on."""

from __future__ import annotations

_HOLLOW = frozenset({"bowl", "cup", "mug", "glass", "pot", "jar", "vase", "basket", "bucket", "bin", "crate",
                     "beaker", "pitcher", "sink", "flask", "ramekin", "mortar", "creamer", "colander",
                     "planter", "teacup", "pool", "holder", "caddy"})  # fmt: skip
"""Last words of nouns of what things are put in."""
_OPEN = frozenset({"storage box", "lunch box", "open toolbox", "open treasure chest", "open cookie jar", "paper bag",
                   "measuring spoon", "graduated cylinder", "ice cube tray", "bathtub", "washtub", "aquarium", "tureen",
                   "umbrella stand", "drawer", "open drawer", "open microwave", "open toaster oven", "open oven",
                   "open fridge", "open dishwasher", "open cabinet", "open wardrobe", "hinged microwave",
                   "hinged cabinet", "hinged fridge"})  # fmt: skip
"""Other nouns of what things are put in."""
FLAT = ("plate", "saucer", "platter", "tray", "baking tray", "pan", "frying pan", "wok", "soap dish", "dish rack",
        "dustpan", "paper tray", "toy truck", "baking dish", "petri dish", "drawer organizer", "cube tray", "wine rack",
        "toy wagon", "test tube rack", "egg carton")  # fmt: skip
"""What things are put on as well as in."""
HOUSING = ("birdcage", "dollhouse", "file sorter")
"""What things stand in, on a floor inside of it, whatever is said of where: a doll on a doll's house is in it."""
TIER_PARTS = frozenset({"shelf", "level", "tier", "rack", "row", "compartment", "storey"})
"""What the boards and compartments of furniture are called."""
TIER_HEIGHTS = frozenset({"top", "upper", "uppermost", "topmost", "highest", "bottom", "lower", "lowest", "lowermost",
                          "bottommost", "middle", "center", "centre", "central", "second", "third"})  # fmt: skip
"""What tells one of them from the others."""
_SHUT = frozenset({"magnifying glass", "moka pot", "jam jar", "cookie jar", "specimen jar", "sugar bowl"})
"""Nouns of what is closed, or has no inside, whatever its last word."""


def holds(noun: str) -> bool:
    """Whether what is put to a thing of catalogue noun `noun` is put in it, and not on it."""
    own = noun.rpartition("/")[2].replace("_", " ").replace("-", " ")
    return own in _OPEN or (own not in _SHUT and own.split()[-1] in _HOLLOW)
