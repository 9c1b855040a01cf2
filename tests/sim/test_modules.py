"""Modules with kernels: what they are compiled with, and whether they were."""

from __future__ import annotations

import sys
from types import ModuleType

import pytest
import warp as wp

from pat3d.sim import compilation, kernel_modules
from pat3d.sim.compilation import is_warm, settling_modules
from pat3d.sim.kernel_modules import add_options, declare_kernels, declared_modules


@pytest.fixture
def registry(monkeypatch):
    """An empty registry, for two modules of its own."""
    monkeypatch.setattr(kernel_modules, "_declared", {})
    monkeypatch.setattr(kernel_modules, "_options", list(kernel_modules._options))
    for name in ("early_kernels", "late_kernels"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))


def test_options_reach_the_modules_that_were_imported_before_and_after_them(registry):
    """Those of every module stay beside them; what is said of a module decides about it alone."""
    declare_kernels("early_kernels", most_records=3)
    add_options(lambda module: {"block_dim": 64 * (1 + module.most_records), "fast_math": True})
    declare_kernels("late_kernels", gradients=True)
    assert [module.name for module in declared_modules()] == ["early_kernels", "late_kernels"]
    for name, expected in (("early_kernels", 256), ("late_kernels", 64)):
        options = wp.get_module_options(module=sys.modules[name])
        assert options["block_dim"] == expected
        assert options["fast_math"]
        assert not options["enable_backward"]
        assert options["max_unroll"] == 0


def test_kernels_are_there_once_all_modules_are_compiled(tmp_path, monkeypatch):
    monkeypatch.setattr(compilation, "cache_folder", lambda: tmp_path / "cache")
    assert not is_warm(), "no folder"
    (tmp_path / "cache").mkdir()
    assert not is_warm(), "an empty folder"
    first, *others = settling_modules()
    for name in others:
        (tmp_path / "cache" / f"wp_{name}_0a1b2c3").mkdir()
        assert not is_warm(), name
    # The kernels of another module, whose name begins with this one's.
    (tmp_path / "cache" / f"wp_{first}").mkdir()
    assert not is_warm()
    (tmp_path / "cache" / f"wp_{first}_4d5e6f7").mkdir()
    assert is_warm()
