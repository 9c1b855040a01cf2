"""The command that settles an edited scene."""

import subprocess
import sys


def test_settling_needs_no_torch():
    blocked = "import sys; sys.modules['torch'] = None; from pat3d.cli.main import main; main(['settle', '--help'])"
    answer = subprocess.run([sys.executable, "-c", blocked], capture_output=True, text=True)
    assert answer.returncode == 0, answer.stderr
    assert "pat3d settle scenes/desk" in answer.stdout
