"""The scripted policy picks up the red mug of the shipped scene, and a film of it is drawn on the CPU.

`pat3d evaluate` records the episode; `pat3d replay` does it again, compares every state with the record, and films it.

    python examples/film_an_episode.py           # writes eval/film and film.gif; takes about half a minute
"""

import subprocess
import sys


def pat3d(*arguments: str) -> None:
    """Run a command of PAT3D, as on a command line."""
    subprocess.run([sys.executable, "-m", "pat3d", *arguments], check=True)


pat3d("evaluate", "--policy", "scripted", "--episodes", "1", "--no-pictures", "--out", "eval/film")
pat3d("replay", "eval/film", "--episode", "0", "--video", "film.gif", "--size", "160x120")
