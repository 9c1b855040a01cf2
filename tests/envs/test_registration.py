import subprocess
import sys

import pytest


def _run(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_pat3d_imported_after_gymnasium_registers_the_environment():
    pytest.importorskip("gymnasium")
    code = "import gymnasium, pat3d; print(gymnasium.spec('PAT3D-v0').entry_point)"
    assert _run(code) == "pat3d.envs.env:TabletopEnv"


def test_gymnasium_finds_the_environment_by_the_name_of_the_package():
    pytest.importorskip("robosuite")
    assert _run("import gymnasium; print(gymnasium.make('pat3d:PAT3D-v0').spec.id)") == "PAT3D-v0"


def test_importing_the_environments_registers_them_even_where_pat3d_came_first():
    pytest.importorskip("gymnasium")
    code = "import pat3d, gymnasium, pat3d.envs; print(gymnasium.spec('PAT3D-v0').id)"
    assert _run(code) == "PAT3D-v0"


def test_importing_pat3d_imports_neither_gymnasium_nor_numpy():
    assert _run("import sys, pat3d; print({'gymnasium', 'numpy', 'mujoco', 'robosuite'} & set(sys.modules))") == "set()"
