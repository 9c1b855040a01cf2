"""Every script in `examples/` runs as its docstring says, in an empty folder, and what it prints is true."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

ROOT = Path(__file__).parents[1]
EXAMPLES = {path.stem: path for path in sorted((ROOT / "examples").glob("*.py"))}
MAX_LINES = 60


def printed(name: str, folder: Path) -> str:
    """What the example `name` prints when it is run in `folder`."""
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    done = subprocess.run(
        [sys.executable, EXAMPLES[name]],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": path, "PAT3D_RENDERER": "cpu"},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def numbers(pattern: str, text: str) -> list[float]:
    """Every number that the group of `pattern` matches; at least one."""
    found = [float(number) for number in re.findall(pattern, text)]
    assert found, f"{pattern} is not in:\n{text}"
    return found


def test_there_are_ten_examples_and_each_has_a_test():
    tested = {name.removeprefix("test_") for name in globals()}
    assert len(EXAMPLES) == 10
    assert set(EXAMPLES) <= tested


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_short_says_how_to_run_it_and_is_listed(name):
    text = EXAMPLES[name].read_text()
    assert len(text.splitlines()) < MAX_LINES
    about = ast.get_docstring(ast.parse(text)) or ""
    assert f"python examples/{name}.py" in about
    assert f"[{name}.py]({name}.py) | {about.splitlines()[0]} |" in (ROOT / "examples" / "README.md").read_text()


@pytest.mark.slow
def test_sentence_to_mujoco(tmp_path):
    output = printed("sentence_to_mujoco", tmp_path)
    assert (tmp_path / "scenes/books/scene.json").is_file()
    assert output.count(" kg") == 4
    assert "red mug: on book 3" in output
    assert max(numbers(r"MuJoCo: ([\d.]+) mm", output)) < 1.0


def test_settle_bodies(tmp_path):
    """The centres stand half a height over what carries them, and the gaps are under two hundredths of a millimetre."""
    output = printed("settle_bodies", tmp_path)
    assert "at rest: True" in output
    base, plank = numbers(r"position \[.* ([\d.]+)\] m", output)
    assert 0.0 <= base - 0.03 < 2e-5
    assert 0.0 <= plank - 0.07 < 4e-5


@pytest.mark.slow
def test_gradient_of_a_rollout(tmp_path):
    output = printed("gradient_of_a_rollout", tmp_path)
    gradient, difference = numbers(r"(?:d\(friction\) =|difference:) (-[\d.]+) m", output)
    assert gradient == pytest.approx(difference, rel=1e-4)


def test_random_actions(tmp_path):
    output = printed("random_actions", tmp_path)
    assert "instruction: pick up the red mug" in output
    assert 0.0 <= numbers(r"progress ([\d.]+)", output)[0] <= 1.0
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_read_certificate(tmp_path):
    output = printed("read_certificate", tmp_path)
    assert "passed: True" in output
    assert "intersecting pairs: 0 of hulls, 0 of surfaces" in output
    assert max(numbers(r"unbalanced by (\S+) of its weight", output)) < 1e-3
    assert numbers(r"stands a tilt of ([\d.]+) degrees", output)[0] > 0.57


@pytest.mark.slow
def test_own_meshes(tmp_path):
    """An L of two blocks is two convex parts, and its millimetres are read as such."""
    output = printed("own_meshes", tmp_path)
    assert "bracket: 0.12 kg, 2 convex parts, size [0.08 0.04 0.06] m" in output
    assert (tmp_path / "scenes/bracket/scene.json").is_file()


@pytest.mark.slow
def test_export_formats(tmp_path):
    output = printed("export_formats", tmp_path)
    assert len(numbers(r"largest error (\S+);", output)) == 4
    assert max(numbers(r"largest error (\S+);", output)) <= 1e-6
    assert "MuJoCo: 3 bodies" in output
    assert "OpenUSD: 3 rigid bodies" in output


@pytest.mark.slow
def test_film_an_episode(tmp_path):
    output = printed("film_an_episode", tmp_path)
    assert "success 100.0 %" in output
    assert "1 of 1 episodes went as recorded, bit for bit" in output
    with Image.open(tmp_path / "film.gif") as film:
        assert film.size == (160, 120)
        assert film.n_frames > 10


@pytest.mark.slow
def test_small_suite(tmp_path):
    output = printed("small_suite", tmp_path)
    assert "pass  3 scenes" in output
    assert [output.count(f"scene {index}: ") for index in range(4)] == [1, 1, 1, 0]


@pytest.mark.slow
def test_compare_policies(tmp_path):
    """Six wins of six have a two-sided probability of 2 / 2^6 under chance."""
    output = printed("compare_policies", tmp_path)
    assert "only the first 6, only the second 0" in output
    assert numbers(r"McNemar p = ([\d.]+)", output) == [pytest.approx(2 / 2**6, abs=1e-4)]
    assert (tmp_path / "eval/scripted/report.html").is_file()
