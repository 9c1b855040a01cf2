"""What a kind of mesh server is to the rest: whether it answers, and a mesh for a wish.

A third kind is a module with a class of these methods, and its place in `servers.ADAPTERS`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from pat3d.assets.generated.client import Client
from pat3d.assets.mesh.importing import UpAxis


@dataclass(frozen=True, kw_only=True)
class Picture:
    """A picture of what is wanted."""

    name: str
    """Of the file: "teapot_dinosaur.png"."""
    data: bytes
    kind: str
    """Media type: "image/png"."""


@dataclass(frozen=True, kw_only=True)
class Wish:
    """What a server is asked to make."""

    prompt: str
    seed: int
    """In [0, 2^31)."""
    picture: Picture | None = None


@dataclass(frozen=True, kw_only=True)
class Made:
    """What a server made."""

    data: bytes
    """A GLB file."""
    model: str = ""
    """That made it; empty where the server does not tell."""


class Adapter(Protocol):
    """One kind of mesh server."""

    @property
    def name(self) -> str:
        """As provenance names it."""
        ...

    @property
    def up(self) -> UpAxis:
        """Axis of its meshes that points up."""
        ...

    def answers(self, client: Client) -> bool:
        """Whether the server is of this kind; asks for nothing to be made."""
        ...

    def make(self, client: Client, wish: Wish) -> Made:
        """The mesh of `wish`.

        Raises:
            AssetError: there is none; whatever ends the wait, the server is told where its API allows.
        """
        ...
