"""Orders: what a server is to make for a noun that nothing else has, kept so that a plan's noun says all of it."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass

from pat3d.assets.generated.settings import server_settings
from pat3d.assets.generated.sizes import usual_size
from pat3d.errors import AssetError, PromptError
from pat3d.scene.cache import data_root
from pat3d.scene.naming import APART, slug
from pat3d.scene.replacement import write_text

SOURCE = "mesh"
"""Before the nouns, and before the URL in `--assets mesh:URL`."""
MAX_WORDS = 80
"""Characters of a name."""
_KEY = re.compile(r"[a-z0-9][a-z0-9_]{0,63}")


@dataclass(frozen=True, kw_only=True)
class Order:
    """Something that a server is to make."""

    words: str
    """As people call it, in the singular, without colours: "teapot dinosaur"."""
    url: str
    metres: float
    """Longest side, from words, never from the mesh."""
    why: str
    """Where `metres` come from."""
    like: str = ""
    """Catalogue noun that it is a kind of."""

    @property
    def noun(self) -> str:
        """As plans name it; another server or size is another noun."""
        digest = hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()
        return f"{SOURCE}{APART}{slug(self.words)[:40].strip('_')}_{digest[:6]}"


class Orders:
    """What one server is to make for the plans of a run."""

    def __init__(self, url: str) -> None:
        """Raises: AssetError: `url` is none of a server."""
        self.settings = server_settings(url)
        self._orders: dict[str, Order] = {}

    def order(self, words: str) -> Order:
        """The order for what `words` name; nothing is asked of the server, and nothing kept, yet."""
        name = " ".join(words.split()).lower()[:MAX_WORDS]
        sized = usual_size(name)
        made = Order(words=name, url=self.settings.url, metres=sized.metres, why=sized.why, like=sized.like)
        self._orders[made.noun] = made
        return made

    def told(self, order: Order) -> str:
        """What a plan says of it."""
        return (
            f'"{order.words}" is made by the mesh server {self.settings.server}, {order.metres:g} m long where the '
            f"sentence gives no size ({order.why})."
        )

    def names(self) -> dict[str, str]:
        """The noun of everything that was ordered, by its name."""
        return {order.words: noun for noun, order in self._orders.items()}

    def keep(self, nouns: Iterable[str]) -> None:
        """Keep the orders of those of `nouns` that are ordered here."""
        for noun in sorted({*nouns} & self._orders.keys()):
            path = data_root() / "orders" / f"{noun.split(APART, 1)[1]}.json"
            write_text(path, json.dumps(asdict(self._orders[noun]), indent=1))


def orders_of(assets: str | None) -> Orders | None:
    """What `--assets` names; None where it names nothing.

    Raises:
        AssetError: it is no "mesh:URL".
    """
    if assets is None:
        return None
    kind, _, url = assets.partition(":")
    if kind != SOURCE or not url:
        raise AssetError(f'assets come from a mesh server, "mesh:http://127.0.0.1:8080", not from "{assets[:80]}".')
    return Orders(url)


def kept_order(noun: str) -> Order:
    """The order that a plan's noun means.

    Raises:
        PromptError: there is none.
        AssetError: it is damaged.
    """
    key = noun.split(APART, 1)[-1]
    path = data_root() / "orders" / f"{key}.json"
    if not _KEY.fullmatch(key) or not path.is_file():
        raise PromptError(f'"{noun}" was not ordered here. Name it in a sentence with --assets {SOURCE}:URL.')
    try:
        order = Order(**json.loads(path.read_text(encoding="utf-8")))
        whole = order.noun == f"{SOURCE}{APART}{key}"
    except (OSError, ValueError, TypeError, AttributeError) as error:
        raise AssetError(f'"{path}" cannot be read: {error}.') from error
    if not whole:
        raise AssetError(f'"{path}" was changed: it is not what "{noun}" was ordered as.')
    return order


def kept_orders() -> list[str]:
    """The nouns of all orders."""
    return sorted(f"{SOURCE}{APART}{path.stem}" for path in (data_root() / "orders").glob("*.json"))
