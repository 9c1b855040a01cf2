"""Messages of openpi's policy servers: MessagePack, with NumPy arrays as maps of type, shape and bytes.

Nothing in a message is ever executed: arrays are numbers or truth values of a size that fits their bytes.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from pat3d.errors import EvaluationError

MAX_BYTES = 32 * 2**20
"""Of one message."""

MAX_DIMENSIONS = 8

INSTALL_HINT = "policy servers need websockets and msgpack: pip install 'pat3d[eval]'."


class WireError(ValueError):
    """A message that is none."""


def pack(message: Any) -> bytes:
    """`message` as bytes: maps, lists, texts, numbers and arrays."""
    return _msgpack().packb(message, default=_encode)


def unpack(data: bytes) -> Any:
    """What `pack` packed.

    Raises:
        WireError: not a message, or one with anything but numbers in its arrays.
    """
    if len(data) > MAX_BYTES:
        raise WireError(f"a message of {len(data)} bytes; at most {MAX_BYTES} are read")
    msgpack = _msgpack()
    try:
        return msgpack.unpackb(data, object_hook=_decode, strict_map_key=False)
    except WireError:
        raise
    except (ValueError, TypeError, RecursionError, msgpack.UnpackException) as error:
        raise WireError(f"no MessagePack: {type(error).__name__}: {error}") from error


def _encode(value: Any) -> Any:
    if isinstance(value, np.ndarray | np.generic) and value.dtype.kind not in "biufSU":
        raise TypeError(f"arrays of type {value.dtype} are not sent")
    if isinstance(value, np.ndarray):
        return {
            b"__ndarray__": True,
            b"data": value.tobytes(),
            b"dtype": value.dtype.str,
            b"shape": value.shape,
        }
    if isinstance(value, np.generic):
        return {b"__npgeneric__": True, b"data": value.item(), b"dtype": value.dtype.str}
    raise TypeError(f"a {type(value).__name__} is not sent")


def _decode(found: dict[Any, Any]) -> Any:
    if b"__ndarray__" in found:
        dtype, shape, data = _dtype(found.get(b"dtype")), found.get(b"shape"), found.get(b"data")
        if not isinstance(shape, list) or len(shape) > MAX_DIMENSIONS:
            raise WireError(f"an array of shape {shape!r:.80}")
        if not all(isinstance(size, int) and 0 <= size <= MAX_BYTES for size in shape):
            raise WireError(f"an array of shape {shape!r:.80}")
        if not isinstance(data, bytes) or len(data) != math.prod(shape) * dtype.itemsize:
            raise WireError(f"an array of shape {shape} whose bytes do not fit it")
        return np.frombuffer(data, dtype=dtype).reshape(shape).copy()
    if b"__npgeneric__" in found:
        try:
            return _dtype(found.get(b"dtype")).type(found.get(b"data"))
        except (TypeError, ValueError, OverflowError) as error:
            raise WireError(f"a number that is none: {error}") from error
    return found


def _dtype(name: Any) -> np.dtype[Any]:
    # Plain numbers only: no objects, no records, no texts of absurd length.
    if not isinstance(name, str) or len(name) > 4:
        raise WireError(f"an array of type {name!r:.40}")
    try:
        dtype = np.dtype(name)
    except TypeError as error:
        raise WireError(f"an array of type {name}") from error
    if dtype.kind not in "biuf" or dtype.itemsize > 8:
        raise WireError(f"an array of type {name}")
    return dtype


def _msgpack() -> Any:
    try:
        import msgpack
    except ImportError as error:
        raise EvaluationError(INSTALL_HINT) from error
    return msgpack
