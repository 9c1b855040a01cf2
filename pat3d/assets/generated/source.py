"""What mesh servers make as a source of assets, through the gates of a user's own file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.catalogue import lookup
from pat3d.assets.colours import COLOURS, find_colour
from pat3d.assets.generated.adapter import Picture, Wish
from pat3d.assets.generated.client import Client
from pat3d.assets.generated.orders import SOURCE, Order, kept_order, kept_orders
from pat3d.assets.generated.servers import VERSION, fetch, forget
from pat3d.assets.generated.settings import ServerSettings, server_settings
from pat3d.assets.library.resting import resting_poses, standing
from pat3d.assets.library.store import is_plain, painted, scaled
from pat3d.assets.materials import material as find_material
from pat3d.assets.mesh.importing import TO_Z_UP, Placing, asset_of
from pat3d.assets.mesh.load import load_mesh
from pat3d.assets.source import Candidate, Known, candidates
from pat3d.assets.variant import USUAL, Variant
from pat3d.errors import AssetError, PromptError
from pat3d.progress import CpuBudget
from pat3d.scene.asset import Asset
from pat3d.scene.cache import content_key
from pat3d.scene.naming import slug

MAX_PICTURE = 20_000_000
"""Bytes."""
CPU_SECONDS = 120.0
"""Processor time for the repair and the convex parts of one mesh [s]."""
_PICTURES = {"png": "image/png", "jpg": "image/jpeg", "jpeg": "image/jpeg", "webp": "image/webp"}


class MeshServers:
    """Everything that was ordered of a mesh server."""

    name = SOURCE

    def __init__(self, connect: Callable[[ServerSettings], Client] = Client) -> None:
        """Speak to servers through what `connect` makes."""
        self._connect = connect

    def nouns(self) -> Sequence[Known]:
        """Every order that is kept."""
        found = []
        for noun in kept_orders():
            with suppress(PromptError, AssetError):
                order = kept_order(noun)
                found.append(Known(noun=noun, names=(order.words,), like=order.like))
        return found

    def find(self, phrase: str) -> Sequence[Candidate]:
        """Orders by their words."""
        return candidates(self, phrase)

    def digest(self, noun: str) -> str:
        """What is asked, and of whom; the mesh of a seed does not change while it is kept.

        Raises:
            PromptError: it was not ordered.
        """
        order = kept_order(noun)
        picture = _picture(server_settings(order.url), order)
        shown = {} if picture is None else {"picture": np.frombuffer(picture.data, dtype=np.uint8)}
        return content_key(shown, {"order": vars(order), "version": VERSION})

    def make(self, noun: str, variant: Variant = USUAL) -> Asset:
        """What the server makes of the order's words and the variant's, of the order's size.

        Raises:
            PromptError: it was not ordered.
            AssetError: the server gives no mesh, or one that no object can be made of.
        """
        order = kept_order(noun)
        settings = server_settings(order.url)
        named = [found for name in variant.colours if (found := find_colour(name))]
        said = " ".join(
            dict.fromkeys([*variant.adjectives, " and ".join(named), variant.material or "", *order.words.split()])
        )
        wish = Wish(
            prompt=f"{' '.join(said.split())}, one object, standing upright",
            seed=variant.seed % 2**31,
            picture=_picture(settings, order),
        )
        fetched = fetch(settings, wish, connect=self._connect)
        made_of = variant.material or ((entry.material if (entry := lookup.find(order.like)) else None) or "plastic")
        try:
            asset = _imported(fetched.path, fetched.record["sha256"], fetched.up, order.words, order.metres, made_of)
        except AssetError as error:
            forget(fetched)
            raise AssetError(
                f'the mesh that {settings.server} made of "{wish.prompt}" (seed {wish.seed}) is of no use: {error} '
                "Try another seed."
            ) from error
        record: dict[str, Any] = {
            "source": SOURCE,
            **fetched.record,
            "up": fetched.up,
            "longest_side": order.metres,
            "size_from": order.why,
            **({"scale_asked": variant.scale} if variant.scale != 1.0 else {}),
            **asset.provenance,
        }
        asset = scaled(asset, variant.scale)
        if named and is_plain(asset):
            asset = painted(asset, COLOURS[named[0]])
            record["colours"] = named
        return replace(asset, provenance=record)


@lru_cache(maxsize=16)
def _imported(path: Path, sha256: str, up: str, name: str, metres: float, made_of: str) -> Asset:
    """The mesh, its longest side `metres`, at rest as near to upright as it can.

    Raises:
        AssetError: it is over the limits, holds nothing, or bounds no solid.
    """
    loaded = load_mesh(path)
    turn = np.array(TO_Z_UP[up], dtype=np.float64)
    points = loaded.vertices[np.unique(loaded.faces)]
    longest = float(np.ptp(points, axis=0).max())
    if not (np.isfinite(longest) and longest > 0.0):
        raise AssetError("it has no extent: all its vertices coincide or overflow.")
    turn, doubt = standing(turn, resting_poses(points @ turn.T * (metres / longest)))
    turned = points @ turn.T
    low, high = turned.min(axis=0), turned.max(axis=0)
    placing = Placing(
        turn=turn,
        origin=np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]]),
        factors=np.full(3, metres / float((high - low).max())),
    )
    made = asset_of(loaded, placing, name=name, material=find_material(made_of), budget=CpuBudget(CPU_SECONDS))
    notes = [*made.provenance["notes"], *([doubt] if doubt else [])]
    return replace(made, provenance={**made.provenance, "notes": notes, "turned": turn.tolist()})


def _picture(settings: ServerSettings, order: Order) -> Picture | None:
    """The picture of an order in the folder of pictures, or None.

    Raises:
        AssetError: it cannot be read, or is too large.
    """
    if settings.pictures is None:
        return None
    for ending, kind in _PICTURES.items():
        path = settings.pictures / f"{slug(order.words)}.{ending}"
        if path.is_file():
            try:
                if path.stat().st_size > MAX_PICTURE:
                    raise AssetError(f'"{path}" is larger than {MAX_PICTURE / 1e6:.0f} MB.')
                return Picture(name=path.name, data=path.read_bytes(), kind=kind)
            except OSError as error:
                raise AssetError(f'"{path}" cannot be read: {error}.') from error
    return None
