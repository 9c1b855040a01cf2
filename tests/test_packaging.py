"""The wheel installs one name: the folders beside `pat3d` come along through links inside it."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LINKS = ("envs", "exporters", "policies_eval")


@pytest.mark.parametrize("name", LINKS)
def test_folders_beside_the_package_are_linked_by_relative_paths(name):
    link = ROOT / "pat3d" / name
    assert link.is_symlink()
    assert str(link.readlink()) == f"../{name}"


@pytest.fixture(scope="module")
def wheel_names(tmp_path_factory) -> list[str]:
    """Files in the wheel, built from a copy so that nothing is left in the source tree."""
    copy = tmp_path_factory.mktemp("source") / "pat3d"
    skip = shutil.ignore_patterns(".*", "__pycache__", "*.egg-info", "build", "dist", "scenes", "tests")
    shutil.copytree(ROOT, copy, symlinks=True, ignore=skip)
    code = "import sys; from setuptools.build_meta import build_wheel; print(build_wheel(sys.argv[1]))"
    done = subprocess.run(
        [sys.executable, "-c", code, str(copy.parent)], cwd=copy, capture_output=True, text=True, check=True
    )
    with zipfile.ZipFile(copy.parent / done.stdout.split()[-1]) as wheel:
        return wheel.namelist()


def test_the_wheel_installs_nothing_but_the_package(wheel_names):
    assert {name.split("/")[0] for name in wheel_names if ".dist-info/" not in name} == {"pat3d"}


def test_the_wheel_holds_every_module_of_the_tree(wheel_names):
    modules = {
        path.relative_to(ROOT).as_posix() for path in (ROOT / "pat3d").rglob("*.py") if "__pycache__" not in path.parts
    }
    for name in LINKS:
        modules |= {f"pat3d/{path.relative_to(ROOT).as_posix()}" for path in (ROOT / name).rglob("*.py")}
    assert modules <= set(wheel_names)
    assert "pat3d/py.typed" in wheel_names
    assert all(f"pat3d/{name}/__init__.py" in wheel_names for name in LINKS)
