"""Messages of policy servers."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

msgpack = pytest.importorskip("msgpack")

from pat3d.policies_eval.policies import wire  # noqa: E402


@pytest.mark.parametrize("dtype", ["<f4", "<f8", "|u1", "<i8", "|b1", "<u2", "<f2"])
@pytest.mark.parametrize("shape", [(), (0,), (7,), (2, 3, 4)])
def test_arrays_survive_the_way_there_and_back(dtype, shape):
    array = (np.random.default_rng(0).uniform(0, 200, shape)).astype(dtype)
    back = wire.unpack(wire.pack({"a": [array], "text": "x", "n": None}))
    assert back["a"][0].dtype == array.dtype
    assert np.array_equal(back["a"][0], array)
    assert (back["text"], back["n"]) == ("x", None)


def test_arrays_are_encoded_as_openpi_does():
    """Maps with bytes as keys: type, shape and the bytes of the array in C order."""
    raw = msgpack.unpackb(wire.pack({"actions": np.arange(6, dtype=np.float32).reshape(2, 3)}))
    assert raw["actions"] == {
        b"__ndarray__": True,
        b"data": np.arange(6, dtype="<f4").tobytes(),
        b"dtype": "<f4",
        b"shape": [2, 3],
    }
    assert msgpack.unpackb(wire.pack(np.float32(2.5))) == {b"__npgeneric__": True, b"data": 2.5, b"dtype": "<f4"}


@pytest.mark.parametrize(
    "array",
    [
        {b"__ndarray__": True, b"data": b"\0" * 8, b"dtype": "|O", b"shape": [1]},
        {b"__ndarray__": True, b"data": b"\0" * 8, b"dtype": "|V8", b"shape": [1]},
        {b"__ndarray__": True, b"data": b"\0" * 8, b"dtype": "<c8", b"shape": [1]},
        {b"__ndarray__": True, b"data": b"\0" * 4, b"dtype": "<f4", b"shape": [2]},
        {b"__ndarray__": True, b"data": b"", b"dtype": "<f4", b"shape": [2**40, 0, 2**40]},
        {b"__ndarray__": True, b"data": b"\0" * 4, b"dtype": "<f4", b"shape": [-1]},
        {b"__ndarray__": True, b"data": "text", b"dtype": "<f4", b"shape": [1]},
        {b"__ndarray__": True, b"data": b"\0" * 4, b"dtype": ["<f4"], b"shape": [1]},
        {b"__npgeneric__": True, b"data": "x", b"dtype": "<f4"},
        {b"__npgeneric__": True, b"data": 1, b"dtype": "O"},
    ],
)
def test_arrays_that_are_not_plain_numbers_are_refused(array):
    with pytest.raises(wire.WireError):
        wire.unpack(msgpack.packb({"actions": array}))


@settings(deadline=None)
@given(st.binary(max_size=200))
def test_junk_is_a_wire_error_or_plain_data(data):
    with contextlib.suppress(wire.WireError):
        wire.unpack(data)


def test_objects_are_not_sent():
    with pytest.raises(TypeError):
        wire.pack({"a": np.array([object()])})
