"""What is loaded when: importing PAT3D and asking for help load nothing heavy, and a command its own module."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pat3d
from pat3d.cli.commands import COMMANDS

ROOT = Path(__file__).parents[1]
HEAVY = {
    "numpy", "scipy", "warp", "mujoco", "trimesh", "torch", "pxr", "manifold3d", "coacd", "yaml", "rich", "PIL",
    "jsonschema", "networkx", "fcl", "clarabel", "gymnasium", "robosuite", "pyarrow", "h5py",
}  # fmt: skip
LOADED = "import atexit, sys; atexit.register(lambda: print('loaded:', *sys.modules)); "


def run(code: str) -> subprocess.CompletedProcess:
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, "-c", LOADED + code],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": path},
    )


def loaded(said: str) -> set[str]:
    """Modules in `sys.modules` at the end."""
    return set(said.split("loaded:")[-1].split())


def test_importing_the_package_imports_nothing_heavy():
    modules = loaded(run("import pat3d").stdout)
    assert not HEAVY & modules
    ours = {name for name in modules if name.startswith("pat3d")}
    assert ours <= {"pat3d", "pat3d.scene", "pat3d.scene.versions"}


@pytest.mark.parametrize("words", [["--help"], []])
def test_help_names_every_command_and_loads_none_of_them(words):
    """Nor does it load what is heavy: how fast help appears follows from that."""
    said = run(f"from pat3d.cli.main import main; raise SystemExit(main({words!r}))").stdout
    assert all(f"  {command} " in said or f"  {command}\n" in said for command in COMMANDS)
    modules = loaded(said)
    assert not HEAVY & modules
    assert not {f"pat3d.cli.{module}" for module, _ in COMMANDS.values()} & modules


def test_a_command_loads_the_module_of_its_own_group_only():
    said = run("from pat3d.cli.main import main; main(['compare', '--help'])").stdout
    groups = {f"pat3d.cli.{module}" for module, _ in COMMANDS.values()}
    assert groups & loaded(said) == {"pat3d.cli.evaluation"}


def test_the_version_is_the_distribution_s():
    declared = re.search(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert declared is not None
    assert declared.group(1) == pat3d.__version__


def test_lazy_names_are_the_real_functions():
    from pat3d.generation.pipeline import build, generate
    from pat3d.scene.io import load_scene

    assert (pat3d.generate, pat3d.build, pat3d.load_scene) == (generate, build, load_scene)


def test_dir_shows_what_is_public_and_nothing_else():
    assert dir(pat3d) == sorted(pat3d.__all__)
    assert all(getattr(pat3d, name) is not None for name in dir(pat3d))


def test_an_unknown_name_lists_what_there_is():
    with pytest.raises(AttributeError, match="generate"):
        _ = pat3d.genrate
