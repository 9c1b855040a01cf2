"""Slugs: file and body names from object names."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable

APART = "/"
"""Between the source of an asset and its noun: "ycb/power_drill"; the catalogue's nouns have none."""

SLUG_PATTERN = r"^[a-z0-9][a-z0-9_]{0,63}$"
"""What a slug looks like: safe as a file name, an XML name and a USD prim name's tail."""


def slug(name: str) -> str:
    """A safe lower-case name: "red mug 1" -> "red_mug_1"; "object" where nothing is left."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode("ascii").lower()
    return re.sub(r"[^a-z0-9]+", "_", plain).strip("_")[:56].strip("_") or "object"


def unique_slugs(names: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """A slug for every name, all different and none in `taken`; later clashes are numbered from 2."""
    used, result = set(taken), {}
    for name in names:
        base = candidate = slug(name)
        number = 1
        while candidate in used:
            number += 1
            candidate = f"{base}_{number}"
        used.add(candidate)
        result[name] = candidate
    return result
