"""Commands and their options, each declared once: what argparse is told, and what `--help` says, come from here.

    @command(option("folder", "scene folder", metavar="SCENE"), *fields(Settings, seed="the same seed, the same scene"))
    def check(options: argparse.Namespace) -> int: ...

An option that sets a field of a settings dataclass takes its type and its default from the field.
"""

from __future__ import annotations

import argparse
import dataclasses
import textwrap
import typing
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

LEAST_TILT = "tilt of the ground, whichever way, that a verified scene stands, at most 8"
"""Help of --least-tilt, wherever it is an option."""

DEGREES = {"metavar": "DEGREES", "shown": "0.57"}
"""argparse's keywords for it."""

Run = Callable[[argparse.Namespace], int]
"""Does what a command line asks for; returns the exit code."""


@dataclass(frozen=True)
class Option:
    """An argument of a command: `keywords` are those of `argparse.ArgumentParser.add_argument`."""

    name: str
    """"--seed"; without dashes, a positional argument."""
    help: str
    keywords: Mapping[str, Any] = field(default_factory=dict)
    shown: str | None = None
    """What stands for the default in the help; None for the default itself, empty for nothing."""
    group: str = ""
    """Heading in the help that it stands under."""
    rival: str = ""
    """Options of one command with the same word exclude one another."""

    @property
    def text(self) -> str:
        """The help, with the default in brackets."""
        default = self.keywords.get("default")
        shown = self.shown
        if shown is None:
            shown = "" if default is None or default is False or default in ("", (), []) else _in_words(default)
        return f"{self.help} ({shown})" if shown else self.help

    @property
    def usage(self) -> str:
        """How it is typed: "--seed SEED"."""
        if self.keywords.get("action") in ("store_true", "version"):
            return self.name
        choices = self.keywords.get("choices")
        plain = self.name.lstrip("-").replace("-", "_")
        plain = plain.upper() if self.name.startswith("-") else plain
        value = self.keywords.get("metavar") or (f"{{{','.join(map(str, choices))}}}" if choices else plain)
        value = " ".join(value) if isinstance(value, tuple) else value
        value = f"{value} ..." if self.keywords.get("nargs") in ("+", "*") else value
        return f"{self.name} {value}" if self.name.startswith("-") else value

    def add_to(self, parser: Any) -> None:
        """Declare it to argparse."""
        parser.add_argument(self.name, help=self.text.replace("%", "%%"), **self.keywords)


def option(
    name: str, help: str, *, shown: str | None = None, group: str = "", rival: str = "", **keywords: Any
) -> Option:
    """An option, or a positional argument; `keywords` are argparse's."""
    return Option(name, help, keywords, shown=shown, group=group, rival=rival)


def fields(settings: Any, only: Mapping[str, Any] | None = None, /, **helps: str) -> tuple[Option, ...]:
    """Options that set fields of the dataclass `settings`: names with their help; flags where a field is a truth value.

    Args:
        settings: the dataclass, whose fields have defaults.
        only: argparse's keywords for some of the fields, by name: metavar, choices, another default.
        helps: what each field is.
    """
    known = {one.name: one for one in dataclasses.fields(settings)}
    hints = typing.get_type_hints(settings)
    made = []
    for name, text in helps.items():
        default, hint = known[name].default, hints[name]
        more = dict((only or {}).get(name, {}))
        shown = more.pop("shown", None)
        if hint is bool:
            keywords: dict[str, Any] = {"action": "store_true"}
        elif typing.get_origin(hint) is tuple:
            keywords = {"nargs": "+", "default": default}
        else:
            keywords = {"type": hint if hint in (int, float) else str, "default": default}
        made.append(Option(f"--{name.replace('_', '-')}", text, keywords | more, shown=shown))
    return tuple(made)


def values(settings: Any, options: argparse.Namespace) -> dict[str, Any]:
    """What a command line says about the fields of the dataclass `settings`."""
    found = {one.name: getattr(options, one.name) for one in dataclasses.fields(settings) if hasattr(options, one.name)}
    return {name: tuple(value) if isinstance(value, list) else value for name, value in found.items()}


def _in_words(default: Any) -> str:
    if isinstance(default, list | tuple):
        return ", ".join(map(_in_words, default))
    return f"{default:g}" if isinstance(default, float) else str(default)


@dataclass(frozen=True, kw_only=True)
class Command:
    """What a word after `pat3d` means."""

    run: Run
    summary: str = ""
    """Where the command is a verb of another one."""
    options: tuple[Option, ...] = ()
    examples: str = ""
    """Command lines, a line each."""
    notes: str = ""
    """What the help says after the examples."""
    verbs: Mapping[str, Command] = field(default_factory=dict)
    """Where the command takes a second word."""

    def __call__(self, options: argparse.Namespace) -> int:
        """Do it."""
        return self.run(options)

    def describe(self, parser: argparse.ArgumentParser) -> None:
        """Declare the options and the verbs to argparse."""
        if self.examples:
            lines = (f"  {line.strip()}" for line in self.examples.strip().splitlines())
            notes = ("", *textwrap.wrap(self.notes, 100)) if self.notes else ()
            parser.epilog = "\n".join(("examples:", *lines, *notes))
            parser.formatter_class = argparse.RawDescriptionHelpFormatter
        groups: dict[str, Any] = {"": parser}
        rivals: dict[str, Any] = {}
        for one in self.options:
            if one.group not in groups:
                groups[one.group] = parser.add_argument_group(one.group)
            target = groups[one.group]
            if one.rival and one.rival not in rivals:
                rivals[one.rival] = target.add_mutually_exclusive_group()
            one.add_to(rivals[one.rival] if one.rival else target)
        if self.verbs:
            verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
            for name, verb in self.verbs.items():
                made = verbs.add_parser(name, help=verb.summary, description=sentence(verb.summary))
                verb.describe(made)
                made.set_defaults(run=verb.run)
        parser.set_defaults(run=self.run)


def command(*options: Option, examples: str = "", notes: str = "", summary: str = "") -> Callable[[Run], Command]:
    """Make a function the command that takes `options`."""
    return lambda run: Command(run=run, options=options, examples=examples, notes=notes, summary=summary)


def with_verbs(*, examples: str, **verbs: Command) -> Command:
    """A command that takes one of `verbs` as its second word."""

    def choose(options: argparse.Namespace) -> int:
        return verbs[options.verb].run(options)

    return Command(run=choose, verbs=verbs, examples=examples)


def sentence(summary: str) -> str:
    """A summary as a sentence of its own."""
    return f"{summary[0].upper()}{summary[1:]}."
