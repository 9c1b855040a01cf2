"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    basics,
    furniture,
    ornaments,
    room,
    storage,
)

__all__ = [
    "basics",
    "furniture",
    "ornaments",
    "room",
    "storage",
]
