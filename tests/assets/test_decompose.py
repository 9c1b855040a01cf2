"""Convex decomposition: isolated, bounded in time, cached by content, never unpickled."""

import subprocess
import sys

import manifold3d
import numpy as np
import pytest
import trimesh

from pat3d.assets.mesh import coacd_worker
from pat3d.assets.mesh import decompose as module
from pat3d.assets.mesh.cover import outside
from pat3d.assets.mesh.decompose import decompose
from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part
from pat3d.scene.cache import cache_root, load_points


@pytest.fixture(scope="module")
def bracket():
    """An L of two boxes, closed and manifold."""
    solid = manifold3d.Manifold.cube((0.1, 0.02, 0.02)) + manifold3d.Manifold.cube((0.02, 0.02, 0.08))
    mesh = solid.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3].copy(), np.asarray(mesh.tri_verts).astype(np.int32)


@pytest.fixture
def no_process(monkeypatch):
    """Fail if a process is started."""

    def refuse(*args, **kwargs):
        raise AssertionError("a process was started")

    monkeypatch.setattr(subprocess, "Popen", refuse)


def test_bracket_splits_into_parts_of_its_volume_once_ever(bracket, tmp_path, monkeypatch):
    vertices, faces = bracket
    first = decompose(vertices, faces, cache_dir=tmp_path)
    volume = sum(trimesh.convex.convex_hull(part).volume for part in first.parts)
    assert volume == pytest.approx(trimesh.Trimesh(vertices, faces).volume, rel=0.02)
    parts = [convex_part(part) for part in first.parts]
    assert outside(vertices, parts)[0].max() < 1e-5
    assert first.options["seed"] == 0
    assert first.options["preprocess_mode"] == "off"
    assert not first.cached

    monkeypatch.setattr(subprocess, "Popen", lambda *a, **k: pytest.fail("the cache was not used"))
    again = decompose(vertices, faces, cache_dir=tmp_path)
    assert again.cached
    assert all(np.array_equal(a, b) for a, b in zip(first.parts, again.parts, strict=True))
    monkeypatch.undo()

    # A damaged entry is made anew, bit for bit the same.
    (entry,) = tmp_path.rglob("*.npz")
    entry.write_bytes(entry.read_bytes()[:200])
    third = decompose(vertices, faces, cache_dir=tmp_path)
    assert not third.cached
    assert all(np.array_equal(a, b) for a, b in zip(first.parts, third.parts, strict=True))
    assert load_points(entry) is not None
    assert [path.suffix for path in tmp_path.rglob("*") if path.is_file()] == [".npz"]


def test_pickled_and_inconsistent_entries_are_no_entries(tmp_path):
    path = tmp_path / "entry.npz"
    for arrays in (
        {"points": np.array([{"a": 1}], dtype=object), "counts": np.array([1])},
        {"points": np.zeros((8, 3)), "counts": np.array([4, 5])},
        {"points": np.full((4, 3), np.nan), "counts": np.array([4])},
        {"points": np.zeros((4, 2)), "counts": np.array([4])},
        {"points": np.zeros((4, 3))},
    ):
        np.savez(path, allow_pickle=True, **arrays)
        assert load_points(path) is None
    assert load_points(tmp_path / "absent.npz") is None


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda v, f: (v, f[1:]), "open"),
        (lambda v, f: (v * np.array([1, 1, 0]), f), "flat"),
        (lambda v, f: (np.where(v == v[0], np.nan, v), f), "finite"),
        (lambda v, f: (v, f[:0]), "0 faces"),
        (lambda v, f: (v, np.concatenate([f, f])), "not manifold"),
    ],
)
def test_what_makes_coacd_abort_or_hang_never_reaches_it(bracket, tmp_path, no_process, change, message):
    vertices, faces = change(*bracket)
    with pytest.raises(AssetError, match=message):
        decompose(vertices, faces, cache_dir=tmp_path)


def test_a_hanging_worker_is_stopped_and_said_so(bracket, tmp_path, monkeypatch):
    script = tmp_path / "hang.py"
    script.write_text("import time\ntime.sleep(60)\n")
    monkeypatch.setattr(coacd_worker, "__file__", str(script))
    with pytest.raises(AssetError, match=r"did not end within 0\.3 s"):
        decompose(*bracket, cache_dir=tmp_path / "cache", timeout=0.3)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("import os; os.abort()", "SIGABRT"),
        ("raise SystemExit('no such option')", "exit code 1: no such option"),
        ("pass", "no usable parts"),
    ],
)
def test_a_crashing_worker_is_an_asset_error_with_the_reason(bracket, tmp_path, monkeypatch, line, message):
    script = tmp_path / "crash.py"
    script.write_text(line + "\n")
    monkeypatch.setattr(coacd_worker, "__file__", str(script))
    with pytest.raises(AssetError, match=message):
        decompose(*bracket, cache_dir=tmp_path / "cache")


def test_cache_root_follows_argument_then_environment(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "a"))
    assert cache_root() == tmp_path / "a"
    assert cache_root(tmp_path / "b") == tmp_path / "b"
    monkeypatch.delenv("PAT3D_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_root() == tmp_path / "pat3d"


def test_importing_the_module_does_not_import_coacd():
    code = f"import sys, {module.__name__}; sys.exit('coacd' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_decomposition_ends_with_its_processor_time_and_says_so(tmp_path):
    """CoACD takes far more than a second over a torus of 20,000 faces."""
    torus = trimesh.creation.torus(major_radius=0.1, minor_radius=0.03, major_sections=200, minor_sections=50)
    with pytest.raises(AssetError, match=r"20000 faces was given up after the 1 s of processor"):
        decompose(torus.vertices, torus.faces, cpu_limit=1.0, cache_dir=tmp_path, threshold=0.01)
