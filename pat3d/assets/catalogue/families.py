"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    basics,
    food,
    fruit,
    kitchen,
    pantry,
    tableware,
)

__all__ = [
    "basics",
    "food",
    "fruit",
    "kitchen",
    "pantry",
    "tableware",
]
