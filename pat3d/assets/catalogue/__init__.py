"""Parametric objects by noun: `make("mug", colours=["red"], seed=3)`."""

from pat3d.assets.catalogue.lookup import Entry, entries, find, make, names, nearest

__all__ = ["Entry", "entries", "find", "make", "names", "nearest"]
