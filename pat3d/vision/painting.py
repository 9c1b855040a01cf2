"""Pictures painted from words, and parts of pictures painted anew: a role, and the adapter for OpenAI's protocol.

`/v1/images/generations` makes a picture of a prompt, `/v1/images/edits` repaints what a mask leaves transparent.
Answers are decoded to pixels at once, and nothing else of them is kept; links in answers are not followed.
"""

from __future__ import annotations

import base64
import binascii
import io
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ModelError
from pat3d.plan.llm.patience import patiently
from pat3d.plan.llm.settings import HOSTED, ModelSettings
from pat3d.scene.cache import cache_root, content_key
from pat3d.scene.replacement import write_bytes
from pat3d.vision.models import config_table

if TYPE_CHECKING:
    from openai import OpenAI

MODEL, URL = "PAT3D_IMAGE_MODEL", "PAT3D_IMAGE_URL"
KEYS = ("PAT3D_IMAGE_KEY", "OPENAI_API_KEY")
"""Environment variables of the key. The second goes only to a server that the environment names, never the file."""
SIDE = 1024
"""Of the pictures that are asked for, which are square [pixel]."""
MAX_ENCODED = 64 * 2**20
"""Characters of one answer's picture."""
MAX_PIXELS = 20_000_000
MAX_PROMPT = 2000
"""Characters."""
_SCENE = (
    "A photograph of {prompt}. Seen from a little above, at eye level of somebody who stands before it, in even light; "
    "everything that is named is whole and in view, the ground or the table around it is free, nothing else is there."
)
_WHOLE = "The whole {name}, as if nothing stood in front of it, in the same place, size, pose and light."
_TYPES = {"name": str, "base_url": str, "timeout": (int, float), "retries": int}


class Painter(Protocol):
    """Paints pictures."""

    def paint(self, prompt: str) -> NDArray[np.uint8]:
        """A picture of a scene, RGB, shape (height, width, 3)."""
        ...

    def completed(self, picture: NDArray[np.uint8], hidden: NDArray[np.bool_], name: str) -> NDArray[np.uint8]:
        """`picture` with object `name` whole: where `hidden`, shape (height, width), it is painted anew."""
        ...

    def record(self) -> Mapping[str, Any]:
        """What the report says: who painted, and what it has cost."""
        ...


@dataclass
class Spent:
    """What a run has asked of an image model."""

    requests: int = 0
    cached: int = 0
    """Pictures from the cache, which cost nothing."""
    images: int = 0
    seconds: float = 0.0
    """Of waiting."""


class ServedPainter:
    """Asks an image model behind OpenAI's protocol."""

    def __init__(
        self,
        settings: ModelSettings,
        *,
        sleep: Callable[[float], None] = time.sleep,
        cache_dir: Path | None = None,
    ) -> None:
        """Ask as `settings` say; pictures are kept in `cache_dir`, by default a folder of PAT3D's cache."""
        self.settings = settings
        self.spent = Spent()
        self._sleep = sleep
        self._cache = cache_dir or cache_root() / "pictures"
        self._format: dict[str, Any] = {"response_format": "b64_json"}

    def paint(self, prompt: str) -> NDArray[np.uint8]:
        """See `Painter`.

        Raises:
            ModelError: the server cannot be reached, refuses, or does not send a picture.
        """
        words = _SCENE.format(prompt=" ".join(prompt.split())[:MAX_PROMPT])
        return self._kept(
            {"prompt": words},
            {},
            lambda: self._client.images.generate(
                model=self.settings.name, prompt=words, n=1, size=f"{SIDE}x{SIDE}", **self._format
            ),
        )

    def completed(self, picture: NDArray[np.uint8], hidden: NDArray[np.bool_], name: str) -> NDArray[np.uint8]:
        """See `Painter`; what is not hidden comes back as it was.

        Raises:
            ModelError: as for `paint`.
        """
        from PIL import Image

        height, width = hidden.shape
        side = max(height, width)
        shown = np.full((side, side, 3), 127, dtype=np.uint8)
        shown[:height, :width] = picture
        alpha = np.full((side, side), 255, dtype=np.uint8)
        alpha[:height, :width][hidden] = 0
        size = (SIDE, SIDE)
        image = Image.fromarray(shown).resize(size, Image.Resampling.LANCZOS)
        mask = Image.fromarray(alpha).resize(size, Image.Resampling.NEAREST)
        words = _WHOLE.format(name=" ".join(name.split())[:MAX_PROMPT])
        # What is transparent is painted; its colours would only tell what hid the object.
        holed = Image.merge("RGBA", (*image.split(), mask))

        def ask() -> Any:
            return self._client.images.edit(
                model=self.settings.name,
                image=("picture.png", _png(image), "image/png"),
                mask=("mask.png", _png(holed), "image/png"),
                prompt=words,
                n=1,
                size=f"{SIDE}x{SIDE}",
                **self._format,
            )

        made = self._kept({"prompt": words}, {"picture": picture, "hidden": hidden}, ask)
        back = np.array(Image.fromarray(made).resize((side, side), Image.Resampling.LANCZOS))[:height, :width]
        return np.where(hidden[..., None], back, picture).astype(np.uint8)

    def record(self) -> Mapping[str, Any]:
        """See `Painter`."""
        spent = asdict(self.spent) | {"seconds": round(self.spent.seconds, 1)}
        return {"model": self.settings.name, "server": self.settings.server, **spent}

    @cached_property
    def _client(self) -> OpenAI:
        from openai import OpenAI

        return OpenAI(
            api_key=self.settings.key or "none",
            base_url=self.settings.base_url,
            timeout=self.settings.timeout,
            max_retries=0,
        )

    def _kept(
        self, said: Mapping[str, Any], shown: Mapping[str, NDArray[Any]], ask: Callable[[], Any]
    ) -> NDArray[np.uint8]:
        """The picture that an earlier run was given for the same words and pictures, or a new one."""
        settings = self.settings
        key = content_key(shown, {"model": settings.name, "url": settings.base_url, "side": SIDE, **said})
        path = self._cache / f"{key}.png"
        try:
            made = _decoded(path.read_bytes())
        except (OSError, ValueError):
            made = self._asked(ask)
            try:
                write_bytes(path, encoded(made))
            except OSError:
                # A cache that cannot be written costs the next run its pictures, and this one nothing.
                return made
        else:
            self.spent.cached += 1
        return made

    def _asked(self, ask: Callable[[], Any]) -> NDArray[np.uint8]:
        begin = time.monotonic()

        def once() -> Any:
            self.spent.requests += 1
            return ask()

        def adapted(error: Any) -> bool:
            """Whether pictures come without being asked for as data from now on; some models know no links."""
            new = bool(self._format) and "response_format" in str(error.message)
            if new:
                self._format = {}
            return new

        settings = self.settings
        try:
            done = patiently(
                once,
                retries=settings.retries,
                timeout=settings.timeout,
                sleep=self._sleep,
                failed=self._failed,
                adapted=adapted,
            )
        finally:
            self.spent.seconds += time.monotonic() - begin
        data = getattr(done, "data", None)
        coded = getattr(data[0], "b64_json", None) if data else None
        if not isinstance(coded, str):
            linked = bool(data) and bool(getattr(data[0], "url", None))
            raise self._failed("it sends a link instead of a picture" if linked else "its answer holds no picture")
        if len(coded) > MAX_ENCODED:
            raise self._failed(f"a picture of {len(coded)} characters")
        try:
            made = _decoded(base64.b64decode(coded, validate=True))
        except (ValueError, binascii.Error) as error:
            raise self._failed(f"its answer is no picture: {error}") from None
        self.spent.images += 1
        return made

    def _failed(self, why: str) -> ModelError:
        line = "".join(letter if letter.isprintable() else " " for letter in self.settings.hidden(why))[:500]
        return ModelError(f'image model "{self.settings.name}" on {self.settings.server}: {line}')


def image_settings(environment: Mapping[str, str] | None = None, folder: Path | None = None) -> ModelSettings | None:
    """The image model of `environment` (the process's own) or of the file's table `image`; None where none is named.

    Raises:
        ModelError: a setting is not valid.
    """
    given = os.environ if environment is None else environment
    table = config_table("image", given, folder)
    for key, value in table.items():
        if "key" in key.lower() or "token" in key.lower():
            raise ModelError(f"keys do not belong in a file; set {KEYS[0]} and delete [image] {key}.")
        if key not in _TYPES or not isinstance(value, _TYPES[key]) or isinstance(value, bool):
            raise ModelError(f'[image] may hold {", ".join(_TYPES)}; "{key}" is no such setting, or of a wrong type.')
    values = {**table, **{key: given[name] for key, name in (("name", MODEL), ("base_url", URL)) if given.get(name)}}
    if "name" not in values:
        return None
    # A file that came with somebody's folder must not send the user's hosted key to its own server.
    names = KEYS if given.get(URL) or values.get("base_url", HOSTED) == HOSTED else KEYS[:1]
    return ModelSettings(**values, key=next((given[name] for name in names if given.get(name)), ""))


def _decoded(data: bytes) -> NDArray[np.uint8]:
    """The pixels of a PNG, JPEG or WebP picture, and nothing else of it.

    Raises:
        ValueError: it is none, or too large.
    """
    from PIL import Image

    try:
        image = Image.open(io.BytesIO(data), formats=("PNG", "JPEG", "WEBP"))
        width, height = image.size
        if width * height > MAX_PIXELS or min(width, height) < 64:
            raise ValueError(f"{width} x {height} pixels")
        return np.array(image.convert("RGB"))
    except (OSError, SyntaxError, Image.DecompressionBombError) as error:
        raise ValueError(f"no PNG, JPEG or WebP ({type(error).__name__})") from error


def _png(image: Any) -> bytes:
    stream = io.BytesIO()
    image.save(stream, format="PNG")
    return stream.getvalue()


def encoded(picture: NDArray[np.uint8]) -> bytes:
    """An RGB picture as PNG."""
    from PIL import Image

    return _png(Image.fromarray(picture))
