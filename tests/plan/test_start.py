"""A sentence is read without what assets and scenes are made of, so that its reading shows at once."""

import subprocess
import sys

HEAVY = {"numpy", "scipy", "torch", "warp", "mujoco", "trimesh", "importlib.metadata"}
CODE = f"""
import sys
from pat3d.cli.main import main
main(["plan", "a red mug and two plates on a table"])
print("heavy:", sorted({HEAVY!r} & set(sys.modules)))
"""


def test_reading_a_sentence_imports_nothing_heavy():
    """With the catalogue's names in the cache, which the first call makes."""
    subprocess.run([sys.executable, "-c", CODE], check=True, capture_output=True)
    again = subprocess.run([sys.executable, "-c", CODE], check=True, capture_output=True, text=True)
    assert "A table stands on the ground." in again.stdout
    assert again.stdout.splitlines()[-1] == "heavy: []"
