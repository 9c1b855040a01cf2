import subprocess
import sys

import pytest


def _run(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.parametrize("order", ["import gymnasium, pat3d", "import pat3d, gymnasium"])
def test_both_import_orders_register_the_environment(order):
    pytest.importorskip("gymnasium")
    assert _run(f"{order}; print(gymnasium.spec('PAT3D-v0').entry_point)") == "pat3d.envs.env:TabletopEnv"


def test_gymnasium_keeps_its_own_loader_and_pat3d_leaves_the_import_system_as_it_was():
    pytest.importorskip("gymnasium")
    code = (
        "import sys; before = list(sys.meta_path); import pat3d, gymnasium; "
        "print(sys.meta_path == before, type(gymnasium.__spec__.loader).__name__, gymnasium.__loader__ is "
        "gymnasium.__spec__.loader)"
    )
    assert _run(code) == "True SourceFileLoader True"


def test_importing_pat3d_imports_neither_gymnasium_nor_numpy():
    assert _run("import sys, pat3d; print({'gymnasium', 'numpy', 'mujoco', 'robosuite'} & set(sys.modules))") == "set()"


def test_a_missing_gymnasium_still_raises_its_own_error():
    code = (
        "import sys, pat3d\n"
        "from pat3d.envs.registration import _AfterImport\n"
        "sys.meta_path[:] = [one for one in sys.meta_path if isinstance(one, _AfterImport)]\n"
        "try:\n    import gymnasium\nexcept ModuleNotFoundError as error:\n    print(error.name)"
    )
    assert _run(code) == "gymnasium"
