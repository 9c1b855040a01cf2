"""Every option is declared once, and what the help says of it is what happens."""

import argparse
import inspect
import re
import shlex
from dataclasses import MISSING, dataclass, fields

import pytest

from pat3d.cli import options as declared
from pat3d.cli.commands import COMMANDS, find
from pat3d.cli.episodes import settings_of
from pat3d.cli.main import main, parser
from pat3d.generation.optimize_folder import optimize_folder
from pat3d.generation.pipeline import build, generate
from pat3d.generation.settings import Settings
from pat3d.optimize.optimize import OptimizeOptions
from pat3d.policies_eval.run.settings import RolloutSettings


@dataclass(frozen=True, kw_only=True)
class Example:
    count: int = 3
    share: float = 0.5
    names: tuple[str, ...] = ("a", "b")
    quick: bool = False


def parsed(*given, words=()):
    made = argparse.ArgumentParser(prog="x")
    declared.Command(run=lambda options: 0, options=given).describe(made)
    return made.parse_args(list(words)), made.format_help()


def test_an_option_of_a_field_has_the_field_s_type_and_default_and_its_help_says_so():
    made = declared.fields(Example, count="how many", share="of all %", names="which", quick="hurry")
    options, said = parsed(*made)
    assert declared.values(Example, options) == {"count": 3, "share": 0.5, "names": ("a", "b"), "quick": False}
    for text in ("how many (3)", "of all % (0.5)", "which (a, b)", "hurry\n"):
        assert text in said
    options, _ = parsed(*made, words=["--count", "7", "--share", "0.25", "--names", "c", "--quick"])
    assert Example(**declared.values(Example, options)) == Example(count=7, share=0.25, names=("c",), quick=True)


def test_rivals_exclude_one_another_and_groups_have_headings():
    given = [declared.option(name, "text", group="meshes", rival="weight") for name in ("--mass", "--density")]
    assert "meshes:" in parsed(*given)[1]
    with pytest.raises(SystemExit):
        parsed(*given, words=["--mass", "1", "--density", "2"])


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_describes_itself(name, capsys):
    with pytest.raises(SystemExit) as ended:
        main([name, "--help"])
    assert ended.value.code == 0
    said = " ".join(capsys.readouterr().out.lower().split())
    assert COMMANDS[name][1].lower() in said
    assert "examples:" in said


@pytest.mark.parametrize("name", COMMANDS)
def test_examples_in_the_help_are_command_lines_that_parse(name):
    seen = set()
    for line in find(name).examples.strip().splitlines():
        # What stands behind two spaces explains the line.
        words = shlex.split(re.split(r" {2,}", line.strip())[0])
        words = words[: words.index(">")] if ">" in words else words
        assert words[0] == "pat3d"
        seen.add(parser([words[1]]).parse_args(words[1:]).command)
    assert name in seen


def test_defaults_of_the_library_are_those_of_the_command_line():
    options = parser(["generate"]).parse_args(["generate", "a mug"])
    assert Settings(**declared.values(Settings, options)) == Settings()
    options = parser(["evaluate"]).parse_args(["evaluate", "--policy", "random", "--out", "x"])
    assert settings_of(options) == RolloutSettings()
    options = parser(["optimize"]).parse_args(["optimize", "x"])
    assert (options.epochs, options.starts) == (OptimizeOptions.epochs, OptimizeOptions.starts)
    for function, settings in ((generate, Settings), (build, Settings), (optimize_folder, OptimizeOptions)):
        parameters = inspect.signature(function).parameters
        for one in fields(settings):
            if one.name in parameters and one.default is not MISSING and parameters[one.name].default is not None:
                assert parameters[one.name].default == one.default


def test_a_bare_command_prints_the_help(capsys):
    assert main([]) == 0
    assert capsys.readouterr().out.startswith("usage: pat3d")


def test_a_misspelt_command_is_told_the_right_ones(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["genrate", "x"])
    assert ended.value.code == 2
    assert "generate" in capsys.readouterr().err
