"""A suite of three scenes with tasks, and an environment that draws one of them at every reset.

Every scene is verified, and its task is rehearsed with the robot before it is accepted.

    python examples/small_suite.py               # writes suites/small; takes about half a minute
"""

import subprocess
import sys

import gymnasium

import pat3d  # noqa: F401  (registers PAT3D-v0; import it after Gymnasium)

command = "suite generate suites/small --tasks pick,place,stack --scenes 3 --objects 4-6 --picture 0 --workers 1"
subprocess.run([sys.executable, "-m", "pat3d", *command.split()], check=True)
subprocess.run([sys.executable, "-m", "pat3d", "suite", "check", "suites/small"], check=True)

env = gymnasium.make("PAT3D-v0", suite="suites/small")
for index in range(3):
    observation, info = env.reset(seed=0, options={"index": index})
    print(f"scene {index}: {info['instruction']}")
env.close()
