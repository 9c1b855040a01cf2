"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    animals,
    basics,
    birds,
    figures,
    outdoor,
    plush,
    sports,
    toys,
    wear,
)

__all__ = [
    "animals",
    "basics",
    "birds",
    "figures",
    "outdoor",
    "plush",
    "sports",
    "toys",
    "wear",
]
