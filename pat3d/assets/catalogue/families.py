"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    animals,
    basics,
    birds,
    outdoor,
    plush,
    wear,
)

__all__ = [
    "animals",
    "basics",
    "birds",
    "outdoor",
    "plush",
    "wear",
]
