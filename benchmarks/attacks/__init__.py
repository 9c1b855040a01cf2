"""What somebody may do to a scene folder, one function each, for benchmarks/attack.py.

An attack changes the folder it is given, or returns False where the scene has nothing for it. Those on exports have to
be convicted by what the export says, too, in case the checksums are forged. The others change what a scene is
(scene.json, assets): with new checksums they would be another scene.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from benchmarks.attacks.deeds import Deed
from benchmarks.attacks.mjcf import MJCF
from benchmarks.attacks.scene import ASSETS, EDITED, WHOLE
from benchmarks.attacks.urdf_sdf import SDF, URDF
from benchmarks.attacks.usd import USD


@dataclass(frozen=True, kw_only=True)
class Attack:
    """One thing done to a folder."""

    name: str
    kind: str
    """Format, "scene", "assets", or "whole" for a folder that is consistent and false."""
    deed: Deed
    forged: bool
    """Whether new checksums leave it convicted."""


def attacks() -> Iterator[Attack]:
    """All of them."""
    for kind, table in (("mjcf", MJCF), ("usd", USD), ("urdf", URDF), ("sdf", SDF)):
        for name, deed in table.items():
            yield Attack(name=name, kind=kind, deed=deed, forged=True)
    for kind, table in (("scene", EDITED), ("assets", ASSETS), ("whole", WHOLE)):
        for name, deed in table.items():
            yield Attack(name=name, kind=kind, deed=deed, forged=False)
