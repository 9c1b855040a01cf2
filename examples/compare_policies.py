"""Two policies on the same episodes, with intervals and a paired test.

The first is the scripted policy; the second is your own class with two methods, here one that moves the hand straight
down. Replace it with yours: `module:callable`, a checkpoint, or the address of a policy server.

    python examples/compare_policies.py          # writes my_policy.py and eval/; takes about half a minute
"""

import subprocess
import sys
from pathlib import Path

POLICY = """
import numpy as np


class Down:
    def reset(self, episode):  # episode.instruction, .task, .seed, .action_size, .robot, ...
        self.size = episode.action_size

    def act(self, observation):  # a dictionary of arrays
        action = np.zeros(self.size)
        action[2] = -0.2  # with the default controller: x, y, z, three rotations, gripper
        return action
"""


def pat3d(*arguments: str) -> None:
    """Run a command of PAT3D, as on a command line."""
    subprocess.run([sys.executable, "-m", "pat3d", *arguments], check=True)


Path("my_policy.py").write_text(POLICY)
episodes = ("--episodes", "6", "--seed", "0", "--max-steps", "100", "--no-pictures")
pat3d("evaluate", "--policy", "scripted", *episodes, "--out", "eval/scripted")
pat3d("evaluate", "--policy", "my_policy:Down", *episodes, "--out", "eval/down")
pat3d("compare", "eval/scripted", "eval/down")
pat3d("leaderboard", "eval/scripted", "eval/down")
