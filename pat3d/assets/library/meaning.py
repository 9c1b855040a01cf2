"""Objects of libraries by meaning: names and requests as vectors, which an embeddings server of the user's makes.

The server is any that speaks OpenAI's `/embeddings`. Vectors of objects are kept in the index of their library, so that
a search asks for one: that of the request. Where no server is named nothing is asked and names alone decide.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.library.index import Library
from pat3d.assets.library.source import LibrarySource
from pat3d.assets.library.store import Entry
from pat3d.assets.source import Candidate
from pat3d.errors import ModelError
from pat3d.scene.replacement import replaced_file

MODEL, URL, KEY = "PAT3D_EMBEDDINGS", "PAT3D_EMBEDDINGS_URL", "PAT3D_EMBEDDINGS_KEY"
"""Environment variables: the model's name, where its server is, and the key, where that wants one."""
HOSTED = "https://api.openai.com/v1"
"""The server where none is named; the only one that is sent OPENAI_API_KEY."""

TIMEOUT, RETRIES = 60.0, 3
"""Longest wait for one answer [s], and requests more where the server is busy or cannot be reached."""
BATCH = 64
"""Texts a request."""
MAX_NUMBERS = 16_384
"""Of one vector."""
MAX_TEXT = 500
"""Characters that are sent of one text."""
MOST = 10
_FILE = "meaning.npz"


@dataclass(frozen=True, kw_only=True)
class EmbeddingSettings:
    """A model that makes vectors of texts, on a server."""

    model: str
    base_url: str = HOSTED
    key: str = field(default="", repr=False)

    def __post_init__(self) -> None:
        parts = urlsplit(self.base_url)
        if parts.scheme not in ("http", "https") or not parts.hostname or parts.username or parts.password:
            raise ModelError(
                f"{URL} must be http(s)://host/v1 without a user or password, got a URL of host "
                f'"{parts.hostname or ""}".'
            )

    @property
    def server(self) -> str:
        """Host and port, as errors name them."""
        return urlsplit(self.base_url).netloc


def embedding_settings(environment: Mapping[str, str] | None = None) -> EmbeddingSettings | None:
    """What `environment` (the process's own) names; None where it names no model.

    Raises:
        ModelError: the URL is none of a server.
    """
    given = os.environ if environment is None else environment
    if not given.get(MODEL, "").strip():
        return None
    url = given.get(URL) or HOSTED
    key = given.get(KEY) or (given.get("OPENAI_API_KEY", "") if url == HOSTED else "")
    return EmbeddingSettings(model=given[MODEL].strip(), base_url=url, key=key)


def search(
    phrase: str, libraries: Sequence[str], *, settings: EmbeddingSettings | None = None, most: int = MOST
) -> list[Candidate]:
    """What `phrase` may mean in `libraries`: what is called so, then, with `settings`, what is nearest in meaning.

    Scores of the latter are cosines.

    Raises:
        AssetError: there is no library of a name.
        ModelError: the server cannot be reached, refuses, or answers with something else.
    """
    opened = [LibrarySource(name) for name in libraries]
    named = sorted((one for source in opened for one in source.find(phrase)), key=lambda one: -one.score)
    if settings is None:
        return named[:most]
    asked = _unit(_vectors([phrase[:MAX_TEXT]], settings))[0]
    near: list[Candidate] = []
    for source in opened:
        entries = source.library.ready
        if not entries:
            continue
        cosines = np.clip(_known_vectors(source.library, entries, settings, len(asked)) @ asked, 0.0, 0.99)
        near += [
            Candidate(source=source.name, noun=f"{source.name}/{entry.key}", name=entry.name, score=float(cosine))
            for entry, cosine in zip(entries, cosines, strict=True)
        ]
    said = {one.noun for one in named}
    near.sort(key=lambda one: -one.score)
    return [*named, *(one for one in near if one.noun not in said)][:most]


def _text(entry: Entry) -> str:
    """What is known of an object in words."""
    return ", ".join(dict.fromkeys(word for word in (entry.name, *entry.synonyms, entry.like) if word))[:MAX_TEXT]


def _known_vectors(
    library: Library, entries: Sequence[Entry], settings: EmbeddingSettings, numbers: int
) -> NDArray[np.float64]:
    """Unit vectors of `entries`, those that nobody asked for yet asked for and kept, shape (entries, numbers)."""
    texts = [_text(entry) for entry in entries]
    keys = [hashlib.sha256(f"{settings.base_url}\n{settings.model}\n{text}".encode()).hexdigest() for text in texts]
    kept = {key: vector for key, vector in _kept(library).items() if vector.shape == (numbers,)}
    missing = {key: text for key, text in zip(keys, texts, strict=True) if key not in kept}
    if missing:
        made = _vectors(list(missing.values()), settings)
        kept = {key: kept[key] for key in keys if key in kept} | dict(zip(missing, made, strict=True))
        if any(len(vector) != numbers for vector in made):
            raise _failed(settings, "its vectors are of different lengths")
        with replaced_file(library.folder / _FILE) as temporary, temporary.open("wb") as file:
            np.savez(file, keys=np.array(list(kept)), vectors=np.array(list(kept.values()), dtype=np.float32))
    return _unit(np.array([kept[key] for key in keys], dtype=np.float64))


def _kept(library: Library) -> dict[str, NDArray[Any]]:
    """Vectors of the index by the checksum of server, model and text; none where the file is missing or damaged."""
    try:
        with np.load(library.folder / _FILE, allow_pickle=False) as data:
            return dict(zip(data["keys"].tolist(), data["vectors"], strict=True))
    except Exception:
        # A damaged archive raises whatever its damage happens to hit; everything is asked for again.
        return {}


def _vectors(texts: Sequence[str], settings: EmbeddingSettings) -> list[NDArray[np.float64]]:
    """The server's vectors of `texts`.

    Raises:
        ModelError: there are none.
    """
    try:
        import openai
    except ImportError:
        raise ModelError("search by meaning needs the package openai: pip install 'pat3d[models]'.") from None

    # Servers on one's own machine want no key, the client does.
    client = openai.OpenAI(
        api_key=settings.key or "none", base_url=settings.base_url, timeout=TIMEOUT, max_retries=RETRIES
    )
    found: list[NDArray[np.float64]] = []
    for start in range(0, len(texts), BATCH):
        batch = list(texts[start : start + BATCH])
        try:
            done = client.embeddings.create(model=settings.model, input=batch, encoding_format="float")
            rows = sorted(done.data, key=lambda one: one.index)
            vectors = [np.array(one.embedding, dtype=np.float64) for one in rows]
        except openai.APIStatusError as error:
            raise _failed(settings, f"status {error.status_code}: {error.message}") from None
        except openai.APIConnectionError as error:
            raise _failed(settings, f"no connection: {error.__cause__ or error}") from None
        except (openai.OpenAIError, ValueError, TypeError, AttributeError) as error:
            raise _failed(settings, f"its answer is no list of embeddings ({type(error).__name__})") from None
        if len(vectors) != len(batch):
            raise _failed(settings, f"{len(vectors)} vectors for {len(batch)} texts")
        if not all(one.ndim == 1 and 0 < len(one) <= MAX_NUMBERS and np.isfinite(one).all() for one in vectors):
            raise _failed(settings, "a vector is empty, too long or not finite")
        found += vectors
    return found


def _unit(vectors: Sequence[NDArray[np.float64]] | NDArray[np.float64]) -> NDArray[np.float64]:
    stacked = np.array(vectors, dtype=np.float64)
    return stacked / np.maximum(np.linalg.norm(stacked, axis=1, keepdims=True), 1e-300)


def _failed(settings: EmbeddingSettings, why: str) -> ModelError:
    said = why.replace(settings.key, "***") if settings.key else why
    line = "".join(letter if letter.isprintable() else " " for letter in said)[:500]
    return ModelError(f'embeddings of "{settings.model}" on {settings.server}: {line}')
