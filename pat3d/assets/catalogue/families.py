"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    basics,
    fruit,
    tableware,
)

__all__ = [
    "basics",
    "fruit",
    "tableware",
]
