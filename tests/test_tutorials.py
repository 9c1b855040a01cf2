"""Every tutorial works as it is written: its commands and scripts, in order, in an empty folder."""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from pat3d.cli.main import parser
from tests.test_readme import ROOT, Block, blocks_of

TUTORIALS = sorted((ROOT / "docs" / "tutorials").glob("*.md"))


def run(block: Block, folder: Path) -> None:
    """Run a block as someone does who copies it; a shell stops at the first command that fails."""
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    environment = {**os.environ, "PYTHONPATH": path, "PAT3D_RENDERER": "cpu"}
    if block.language == "python":
        command = [sys.executable, "-c", block.code]
    else:
        command = ["bash", "-ec", f'pat3d() {{ "{sys.executable}" -m pat3d "$@"; }}\n{block.code}']
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, f"{block.place}:\n{done.stdout}\n{done.stderr}"


def test_there_are_tutorials_of_both_languages():
    assert {"first_scene", "own_meshes", "edit_a_scene", "suite_and_policy"} <= {page.stem for page in TUTORIALS}
    for page in TUTORIALS:
        assert {"bash", "python"} <= {block.language for block in blocks_of(page)}, page.name


@pytest.mark.parametrize("page", TUTORIALS, ids=lambda page: page.stem)
def test_commands_of_a_tutorial_are_ones_that_the_command_line_knows(page):
    for block in blocks_of(page):
        for line in block.code.splitlines() if block.language == "bash" else ():
            parser().parse_args(shlex.split(line, comments=True)[1:])


@pytest.mark.slow
@pytest.mark.parametrize("page", TUTORIALS, ids=lambda page: page.stem)
def test_a_tutorial_runs_as_it_is_written(page, tmp_path):
    if page.stem == "suite_and_policy":
        for package in ("gymnasium", "mujoco_menagerie", "pyarrow", "torch"):
            pytest.importorskip(package)
    for block in blocks_of(page):
        assert block.run, f"{block.place}: a tutorial is run as a whole"
        run(block, tmp_path)
    if page.stem == "suite_and_policy":
        from pat3d.policies_eval.run.records import read_evaluation

        # 19 of 20 as the page says; another machine rounds otherwise.
        assert sum(one.success for one in read_evaluation(tmp_path / "eval" / "picker").results) >= 16
        assert not any(one.success for one in read_evaluation(tmp_path / "eval" / "random").results)
