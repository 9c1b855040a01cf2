"""Imports every module of recipes; importing one registers its entries."""

from pat3d.assets.catalogue import (
    basics,
    desk,
    electronics,
    furniture,
    ornaments,
    room,
    stationery,
    storage,
    tools,
)

__all__ = [
    "basics",
    "desk",
    "electronics",
    "furniture",
    "ornaments",
    "room",
    "stationery",
    "storage",
    "tools",
]
