"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    animals,
    bags,
    basics,
    birds,
    figures,
    games,
    outdoor,
    plush,
    sports,
    toys,
    wear,
)

__all__ = [
    "animals",
    "bags",
    "basics",
    "birds",
    "figures",
    "games",
    "outdoor",
    "plush",
    "sports",
    "toys",
    "wear",
]
