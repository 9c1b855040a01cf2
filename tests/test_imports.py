import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

import pat3d

ROOT = Path(__file__).parents[1]
HEAVY = ("numpy", "scipy", "warp", "mujoco", "trimesh", "torch", "pxr", "manifold3d", "coacd", "yaml", "rich", "PIL")


def run(*arguments: str) -> subprocess.CompletedProcess:
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, check=True, env={**os.environ, "PYTHONPATH": path}
    )


def test_importing_the_package_imports_nothing_heavy():
    loaded = run("-c", "import sys, pat3d; print(*sys.modules)").stdout.split()
    assert not set(HEAVY) & set(loaded)


def test_importing_the_package_takes_less_than_three_tenths_of_a_second():
    """The best of five, so that a busy machine does not decide."""
    code = "import time; a = time.perf_counter(); import pat3d; print(time.perf_counter() - a)"
    assert min(float(run("-c", code).stdout) for _ in range(5)) < 0.3


def test_help_appears_within_a_second_and_names_every_command():
    best = float("inf")
    for _ in range(3):
        start = time.perf_counter()
        text = run("-m", "pat3d", "--help").stdout
        best = min(best, time.perf_counter() - start)
    assert best < 1.0
    assert all(command in text for command in ("generate", "build", "optimize", "check", "catalogue", "doctor"))


def test_the_version_is_the_distribution_s():
    declared = re.search(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert declared is not None
    assert declared.group(1) == pat3d.__version__


def test_lazy_names_are_the_real_functions():
    from pat3d.generation.pipeline import build, generate
    from pat3d.scene.io import load_scene

    assert (pat3d.generate, pat3d.build, pat3d.load_scene) == (generate, build, load_scene)
    assert {"generate", "build", "load_scene", "__version__"} <= set(dir(pat3d))


def test_an_unknown_name_lists_what_there_is():
    with pytest.raises(AttributeError, match="generate"):
        _ = pat3d.genrate
