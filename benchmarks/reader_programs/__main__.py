"""What readers of scene formats make of a file, each run in an environment of its own.

    python reader_programs READER FILE ...

Prints one line of JSON for every file: the version, how many bodies can move, and what they weigh together [kg], or an
error. Needs the reader's own package and nothing else, least of all ours.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import read_mjcf
import read_sdf
import read_urdf
import read_usd

PROGRAMS = {
    function.__name__: function for module in (read_mjcf, read_urdf, read_sdf, read_usd) for function in module.PROGRAMS
}


def main(reader: str, files: list[str]) -> None:
    """Read one file after the other; the line of each tells its name."""
    for file in files:
        try:
            found = PROGRAMS[reader](Path(file).resolve())
        except Exception as error:
            # Whatever a reader raises is the answer to whether it reads the file.
            lines = [line for line in str(error).splitlines() if line.strip()]
            found = {"error": f"{type(error).__name__}: {lines[-1] if lines else ''}"}
        print("\n" + json.dumps({"file": file, **found}), flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
