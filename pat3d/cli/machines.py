"""PAT3D for other programs, language models among them: `pat3d mcp`, and what --json prints."""

from __future__ import annotations

import argparse
import dataclasses
import json
from collections.abc import Sequence
from typing import Any

from pat3d.cli.options import command, option

JSON = option("--json", "print what came of it as JSON, as docs/json.md describes", action="store_true")


def print_facts(facts: Any) -> None:
    """Print a dataclass of pat3d.generation.facts, or several, as JSON."""
    several = isinstance(facts, Sequence)
    plain = [dataclasses.asdict(one) for one in facts] if several else dataclasses.asdict(facts)
    print(json.dumps(plain, indent=2, allow_nan=False, ensure_ascii=False))


@command(
    option(
        "--root", "the only folder that is read and written; scenes are its subfolders", metavar="FOLDER", required=True
    ),
    examples="""
    pat3d mcp --root scenes        speaks the Model Context Protocol on stdin and stdout
    """,
    notes='A client starts the command itself: {"command": "pat3d", "args": ["mcp", "--root", "FOLDER"]}. '
    "See docs/machines.md.",
)
def mcp(options: argparse.Namespace) -> int:
    """`pat3d mcp`."""
    from pat3d.mcp_server.server import server

    server(options.root).run("stdio")
    return 0
