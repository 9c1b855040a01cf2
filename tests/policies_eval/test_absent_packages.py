"""Optional packages that are not there: what needs one says how to install it, and leaves nothing behind."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from pat3d.errors import EvaluationError
from pat3d.policies_eval.datasets.robomimic import write_robomimic
from pat3d.policies_eval.policies.cloning import make_network
from pat3d.policies_eval.policies.server import ServerPolicy, serve
from pat3d.policies_eval.policies.wire import pack
from pat3d.policies_eval.run.records import arrow
from pat3d.policies_eval.video import FilmWriter, can_write_mp4, write_video


def _served(folder):
    with serve(None):  # type: ignore[arg-type] it fails before there is a policy to ask
        pass


@pytest.mark.parametrize(
    ("package", "use", "extra"),
    [
        ("imageio_ffmpeg", lambda folder: FilmWriter(folder / "a.mp4", (4, 4), 20.0), "eval"),
        ("imageio_ffmpeg", lambda folder: write_video([np.zeros((4, 4, 3), np.uint8)], folder / "a.mp4", 20.0), "eval"),
        ("h5py", lambda folder: write_robomimic([], folder / "a.hdf5"), "eval"),
        ("pyarrow", lambda folder: arrow(), "eval"),
        ("torch", lambda folder: make_network(), "torch"),
        ("msgpack", lambda folder: pack({}), "eval"),
        ("websockets", lambda folder: ServerPolicy("ws://127.0.0.1:9", connect_seconds=0.0), "eval"),
        ("websockets", _served, "eval"),
    ],
)
def test_what_needs_an_absent_package_says_how_to_install_it(tmp_path, monkeypatch, package, use, extra):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(EvaluationError, match=rf"pip install 'pat3d\[{extra}\]'"):
        use(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("there", [True, False])
def test_mp4_can_be_written_exactly_where_there_is_ffmpeg(monkeypatch, there):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", np if there else None)
    assert can_write_mp4() is there
