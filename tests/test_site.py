"""The site has every page of docs/, and its reference pages say what the code says."""

from __future__ import annotations

import inspect
import re
import shlex
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import pat3d.errors
import pat3d.exporters
from pat3d.cli.commands import COMMANDS, find
from pat3d.cli.main import main, parser
from pat3d.cli.options import Command
from tests.test_readme import blocks_of, run_block

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
FENCE = re.compile(r"^```\{toctree\}\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.fixture
def site(monkeypatch) -> Any:
    monkeypatch.syspath_prepend(DOCS)
    return import_module("site_pages")


SAID = re.findall(r"^\$ (pat3d .+)\n(.+)$", (DOCS / "reference" / "errors.md").read_text(), re.MULTILINE)


@pytest.mark.parametrize(("line", "message"), SAID, ids=[line for line, _ in SAID])
def test_errors_are_as_their_page_says(line, message, tmp_path, monkeypatch, capsys):
    for name in ("PAT3D_MODEL", "PAT3D_MODEL_URL", "PAT3D_MODEL_KEY", "PAT3D_CONFIG", "OPENAI_API_KEY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    here = tmp_path / "here"
    (here / "letters").mkdir(parents=True)
    (here / "letters" / "one.txt").write_text("mine")
    monkeypatch.chdir(here)
    assert main(shlex.split(line)[1:]) == getattr(pat3d.errors, message.split(":")[0]).exit_code
    assert capsys.readouterr().err.splitlines()[-1] == f"pat3d: {message}"
    assert sorted(path.name for path in here.rglob("*")) == ["letters", "one.txt"]


def test_code_of_the_page_of_errors_runs(tmp_path):
    for block in blocks_of(DOCS / "reference" / "errors.md"):
        if block.language == "python":
            run_block(block, tmp_path)


def test_the_gallery_is_what_its_script_draws(monkeypatch):
    monkeypatch.syspath_prepend(DOCS)
    drawn = import_module("draw_gallery")
    assert drawn.page() == (DOCS / "gallery.md").read_text()
    wanted = {drawn.picture_of(one) for one in drawn.SENTENCES}
    assert len(wanted) == len(drawn.SENTENCES) == 30
    assert wanted == set(drawn.PICTURES.iterdir())
    assert sum(path.stat().st_size for path in wanted) < 1.5e6


def listed(page: Path) -> list[str]:
    """Pages that the toctrees of `page` name, from docs/."""
    lines = [line for tree in FENCE.findall(page.read_text()) for line in tree.splitlines()]
    return [line for line in lines if line and not line.startswith(":")]


def test_the_tables_of_contents_name_every_page_once():
    pages = {str(page.relative_to(DOCS).with_suffix("")) for page in DOCS.rglob("*.md")}
    found = listed(DOCS / "index.md")
    assert sorted(found) == sorted(pages - {"index"})


def test_every_page_begins_with_its_title(site):
    for page in DOCS.rglob("*.md"):
        assert site.filled(page.read_text(), str(page.relative_to(DOCS))).startswith("# "), page.name


def test_every_option_of_every_command_is_in_the_reference(site):
    text = site.commands()
    for name in COMMANDS:
        section = text[text.index(f"## pat3d {name}\n") :]
        for one in options_of(find(name)):
            assert f"| `{one.usage}` | " in section, (name, one.name)


def options_of(command: Command) -> list[Any]:
    return [*command.options, *(one for verb in command.verbs.values() for one in options_of(verb))]


@pytest.mark.parametrize("name", [name for name in COMMANDS if not find(name).verbs])
def test_usage_of_an_option_is_what_argparse_shows(name, capsys):
    """What takes several values is "FORMAT ..." here and "FORMAT [FORMAT ...]" there."""
    with pytest.raises(SystemExit):
        parser([name]).parse_args([name, "--help"])
    shown = " ".join(capsys.readouterr().out.split())
    for one in find(name).options:
        assert one.usage.removesuffix(" ...") in shown


def test_every_key_of_a_schema_is_in_the_reference(site):
    text = site.schemas()
    for module, name, _ in site.SCHEMAS.values():
        keys = set(keys_of(getattr(import_module(module), name)))
        assert keys
        for key in keys:
            assert re.search(rf"[`.]{re.escape(key)}[`.\[]", text), (name, key)


def keys_of(schema: Any) -> list[str]:
    if isinstance(schema, list):
        return [key for one in schema for key in keys_of(one)]
    if not isinstance(schema, dict):
        return []
    own = list(schema["properties"]) if isinstance(schema.get("properties"), dict) else []
    parts = [part for key, part in schema.items() if key not in ("if", "then", "else", "not")]
    return own + [key for part in parts for key in keys_of(part)]


def test_public_names_exist_and_have_docstrings(site):
    named = {name for group in site.PUBLIC.values() for name in group}
    assert {f"pat3d.{name}" for name in pat3d.__all__ if name != "__version__"} <= named
    assert {f"pat3d.exporters.{name}" for name in pat3d.exporters.__all__ if name.islower()} <= named
    for name in named:
        assert inspect.getdoc(site.found(name)), name


def test_links_between_folders_lead_to_pages_of_the_site(site):
    seen = site.relinked("[a](../benchmarks/RESULTS.md) [b](scenes.md#x)", "docs/exports.md", "exports.md")
    assert seen == "[a](reference/benchmarks.md) [b](scenes.md#x)"
    readme = site.relinked("[a](docs/exports.md) [b](LICENSE)", "README.md", "reference/changelog.md")
    assert readme == "[a](../exports.md) [b](../../LICENSE)"
    assert site.relinked("[nouns](../examples/nouns)", "docs/libraries.md", "libraries.md") == "[nouns]"


@pytest.mark.slow
def test_the_site_builds_without_warnings(tmp_path):
    for package in ("sphinx", "myst_parser", "furo"):
        pytest.importorskip(package)
    command = [sys.executable, "-m", "sphinx", "--fail-on-warning", "-q", str(DOCS), str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "TabletopEnv" in (tmp_path / "reference" / "python.html").read_text()
