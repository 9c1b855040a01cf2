"""The `pat3d` command."""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence
from typing import Any

import pat3d
from pat3d.cli.commands import COMMANDS, find
from pat3d.cli.options import sentence
from pat3d.errors import Pat3dError


def parser(chosen: Sequence[str] = tuple(COMMANDS)) -> argparse.ArgumentParser:
    """The command line; of the commands that are not `chosen` it knows the names and summaries only."""
    made = argparse.ArgumentParser(
        prog="pat3d",
        description="From a sentence to a manipulation scene that does not move when a simulator loads it.",
        epilog="`pat3d COMMAND --help` tells of one command, with examples.",
    )
    made.add_argument("--version", action="version", version=f"pat3d {pat3d.__version__}")
    commands = made.add_subparsers(dest="command", metavar="COMMAND")
    for name, (_, summary) in COMMANDS.items():
        one = commands.add_parser(name, help=summary, description=sentence(summary))
        if name in chosen:
            find(name).describe(one)
    return made


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line `argv`; returns the exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    # Options stand behind the command, so its module is the only one that is needed.
    named = next((word for word in words if not word.startswith("-")), None)
    previous = signal.getsignal(signal.SIGTERM)
    try:
        # Ended by another program, a run tidies up as after Ctrl-C.
        signal.signal(signal.SIGTERM, _interrupt)
    except ValueError:
        previous = None
    try:
        made = parser([named] if named in COMMANDS else [])
        options = made.parse_args(words)
        if options.command is None:
            made.print_help()
            return 0
        return options.run(options)
    except Pat3dError as error:
        return _fault(error, error.exit_code)
    except ModuleNotFoundError as error:
        from pat3d.cli.extras import how_to_install

        advice = how_to_install(error.name or "")
        if advice is None:
            raise
        package = (error.name or "").split(".")[0]
        return _fault(f"pat3d {named} needs {package}, which is not installed: {advice}", 2)
    except KeyboardInterrupt:
        return _fault("interrupted", 130)
    except BrokenPipeError:
        sys.stderr.close()
        return 141
    finally:
        if previous is not None:
            signal.signal(signal.SIGTERM, previous)


def _fault(what: object, code: int) -> int:
    kind = f"{type(what).__name__}: " if isinstance(what, Pat3dError) else ""
    print(f"pat3d: {kind}{what}", file=sys.stderr)
    return code


def _interrupt(*_: Any) -> None:
    raise KeyboardInterrupt
