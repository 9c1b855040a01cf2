"""What the documentation shows is what the code does: blocks run, commands parse, links and names lead somewhere."""

from __future__ import annotations

import ast
import os
import re
import shlex
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import pytest
import yaml

import pat3d
from pat3d.cli.main import main, parser
from tests.test_layers import FLOORS

ROOT = Path(__file__).parents[1]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
MORE = (
    *(ROOT / name for name in ("CHANGELOG.md", "examples/README.md", "benchmarks/RESULTS.md", "benchmarks/NOTES.md")),
    *sorted((ROOT / "docs").glob("*/*.md")),
)
NOT_RUN = "<!-- not run:"
"""A comment on the line before a block that this machine cannot run; its reason follows."""
MAX_README_LINES = 150


@dataclass(frozen=True)
class Block:
    """A fenced block of a page."""

    page: Path
    line: int
    """Of its first line of code, from 1."""
    language: str
    code: str
    run: bool

    @property
    def place(self) -> str:
        """For messages."""
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def blocks_of(page: Path) -> list[Block]:
    """Fenced blocks, in order."""
    text = page.read_text()
    found = []
    for match in re.finditer(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        before = text[: match.start()].splitlines()
        run = not (before and before[-1].startswith(NOT_RUN))
        found.append(Block(page, len(before) + 2, match[1], match[2], run))
    return found


BLOCKS = [block for page in PAGES for block in blocks_of(page)]
PYTHON = [block for block in BLOCKS if block.language == "python"]
COMMANDS = [
    (block.place, line)
    for block in BLOCKS
    if block.language == "bash"
    for line in block.code.splitlines()
    if line.startswith("pat3d ")
]


def run_block(block: Block, folder: Path) -> None:
    """Run a block by itself, as someone does who copies it."""
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    environment = {**os.environ, "PYTHONPATH": path, "PAT3D_RENDERER": "cpu"}
    command = [sys.executable, "-c", block.code]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, f"{block.place}:\n{done.stderr}"


def needs_suite(block: Block) -> bool:
    return "suites/" in block.code


def test_the_readme_is_short_and_has_a_snippet_of_everything():
    text = PAGES[0].read_text()
    assert len(text.splitlines()) < MAX_README_LINES
    assert text.count("![") == 1
    for heading in ("scene", "export", "environment", "suite", "evaluation"):
        section = re.search(rf"^## An? {heading}$(.*?)^## ", text, re.MULTILINE | re.DOTALL)
        assert section is not None
        assert "```" in section[1]


def test_python_blocks_run_as_they_stand(tmp_path):
    """The README's first block makes the scene that the others load."""
    for block in PYTHON:
        if block.run and not needs_suite(block):
            run_block(block, tmp_path)


@pytest.mark.slow
def test_python_blocks_about_suites_run_as_they_stand(tmp_path, monkeypatch):
    """With the suite that the README's command makes, but of two scenes for stacking, which are for training."""
    monkeypatch.chdir(tmp_path)
    line = next(line for _, line in COMMANDS if "suite generate" in line)
    shorter = re.sub(r"--tasks \S+ --scenes \d+", "--tasks stack --scenes 2 --picture 0", line).replace("auto", "1")
    assert main(shlex.split(shorter)[1:]) == 0
    blocks = [block for block in PYTHON if needs_suite(block)]
    assert blocks
    for block in blocks:
        run_block(block, tmp_path)


@pytest.mark.parametrize("block", [block for block in PYTHON if not block.run], ids=lambda block: block.place)
def test_blocks_that_are_not_run_import_what_exists(block):
    for node in ast.walk(ast.parse(block.code)):
        if isinstance(node, ast.ImportFrom):
            assert all(hasattr(import_module(node.module or ""), alias.name) for alias in node.names)
        if isinstance(node, ast.Import):
            for alias in node.names:
                import_module(alias.name)


@pytest.mark.parametrize(("place", "line"), COMMANDS, ids=[f"{place} {line[:40]}" for place, line in COMMANDS])
def test_commands_are_ones_that_the_command_line_knows(place, line):
    parser().parse_args(shlex.split(line, comments=True)[1:])


def test_there_are_commands_of_every_kind():
    kinds = {shlex.split(line, comments=True)[1] for _, line in COMMANDS}
    assert {"generate", "build", "check", "export", "suite", "evaluate", "compare", "replay"} <= kinds


def test_targets_of_make_exist():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    named = {
        name for page in PAGES for name in re.findall(r"(?:^    |`)make ([a-z-]+)", page.read_text(), re.MULTILINE)
    }
    assert {"demo", "test"} <= named <= targets


@pytest.mark.parametrize("page", [*PAGES, *MORE], ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_and_headings(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
        if target.startswith(("http://", "https://")):
            continue
        name, _, heading = target.partition("#")
        file = page if not name else page.parent / name
        assert file.exists(), f"{page.name}: {target}"
        if heading:
            titles = re.findall(r"^#+ (.*)$", file.read_text(), re.MULTILINE)
            assert heading in {title.lower().replace(" ", "-") for title in titles}, f"{page.name}: {target}"


@pytest.mark.parametrize("page", [*PAGES, *MORE], ids=lambda page: str(page.relative_to(ROOT)))
def test_files_named_in_the_text_exist(page):
    """Python files in backquotes, and the functions that follow them in brackets."""
    for name, functions in re.findall(r"`([\w/]+/\w+\.py)`(?: \(((?:`[\w.]+`(?:, )?)+)\))?", page.read_text()):
        file = next(
            (root / name for root in (ROOT, ROOT / "pat3d", ROOT / "exporters") if (root / name).is_file()), None
        )
        assert file is not None, f"{page.name}: {name}"
        defined = {
            node.name
            for node in ast.walk(ast.parse(file.read_text()))
            if isinstance(node, ast.FunctionDef | ast.ClassDef)
        } | set(re.findall(r"^(\w+)(?:: .*)? = ", file.read_text(), re.MULTILINE))
        for function in re.findall(r"`([\w.]+)`", functions):
            assert set(function.split(".")) <= defined, f"{page.name}: {name} has no {function}"


@pytest.mark.parametrize("page", [*PAGES, *MORE], ids=lambda page: str(page.relative_to(ROOT)))
def test_stillness_is_verified_and_never_said_to_be_proven(page):
    quoted = re.sub(r'"[^"]*"', "", page.read_text())
    assert re.findall(r"\b(?:un)?proven\b", quoted) == []


def test_every_dependency_has_its_licence_listed():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = {name: wanted for name, wanted in project["optional-dependencies"].items() if name != "dev"}
    wanted = [*project["dependencies"], *(one for group in extras.values() for one in group)]
    names = {re.match(r"[\w-]+", one)[0] for one in wanted} - {"pat3d"}  # type: ignore[index]
    listed = set(re.findall(r"[\w-]+", (ROOT / "docs" / "licences.md").read_text()))
    assert names - listed == set()


def test_the_citation_names_this_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert {"cff-version", "message", "title", "authors"} <= set(citation)
    assert (citation["version"], citation["license"]) == (pat3d.__version__, "Apache-2.0")


def test_the_picture_of_the_floors_is_drawn_from_its_script_and_names_every_floor(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs")
    drawing = import_module("draw_architecture")
    assert (ROOT / "docs" / "architecture.svg").read_text() == drawing.draw()
    drawn = [set(name.split(", ")) for name, _ in drawing.FLOORS]
    assert drawn == [set(floor) for floor in reversed(FLOORS) if floor != ("__main__",)]
    for floor, file, _ in drawing.WALK:
        assert any(
            (ROOT / part / name / file).is_file() for part in (".", "pat3d") for name in floor.split(", ") + [""]
        )
