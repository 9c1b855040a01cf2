"""PAT3D for other programs, language models among them: `pat3d mcp`."""

from __future__ import annotations

import argparse

from pat3d.cli.options import command, option


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
