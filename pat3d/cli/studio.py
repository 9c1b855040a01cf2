"""`pat3d studio`: a scene in the browser, to look at, edit and settle."""

from __future__ import annotations

import argparse
import threading

from pat3d.cli.options import command, option
from pat3d.errors import SpecError


@command(
    option("folders", "a scene, a suite, or one or two evaluations of the same episodes", metavar="FOLDER", nargs="*"),
    option("--root", "scenes are saved as its subfolders", metavar="FOLDER", shown="where the scene is, else scenes"),
    option("--host", "address to listen at; any but this machine's own needs a token", default="127.0.0.1"),
    option("--port", "0 for any that is free", type=int, default=8790),
    examples="""
    pat3d studio scenes/desk
    pat3d studio suites/tabletop                    a gallery of its scenes, with filters
    pat3d studio eval/picker eval/scripted          episodes of both side by side, with timelines of their states
    pat3d studio                                    begins with an empty page and a field for a sentence
    pat3d studio scenes/desk --host 0.0.0.0         for other machines; prints an address with a token
    """,
    notes="Ctrl-C ends it. What was not saved is lost. See docs/studio.md.",
)
def studio(options: argparse.Namespace) -> int:
    """`pat3d studio`."""
    if not 0 <= options.port <= 65535:
        raise SpecError(f"--port {options.port}: give 0 to 65535.")
    from pat3d.studio.server import opened

    with opened(*options.folders, root=options.root, host=options.host, port=options.port) as made:
        print(f"open {made.address}    (Ctrl-C ends the studio)", flush=True)
        try:
            threading.Event().wait()
        except KeyboardInterrupt:
            print("ended; what was not saved is lost.")
    return 0
