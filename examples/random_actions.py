"""A robot in front of the scene that ships with the package, driven by random actions.

Shows the Gymnasium environment: its spaces, the instruction, and what `info` says after every step.

    python examples/random_actions.py            # writes nothing
"""

import gymnasium

import pat3d  # noqa: F401  (registers PAT3D-v0; import it after Gymnasium)

STEPS = 20

env = gymnasium.make("PAT3D-v0", reward="dense")
env.action_space.seed(0)
observation, info = env.reset(seed=0)
print("instruction:", info["instruction"])
print("actions:", env.action_space)
for name, value in observation.items():
    print(f"observation {name}: shape {value.shape}")
for _ in range(STEPS):
    observation, reward, success, truncated, info = env.step(env.action_space.sample())
    if success or truncated:
        observation, info = env.reset()
print(f"after {STEPS} steps: progress {info['progress']:.2f}, touched {info['touched']}, toppled {info['toppled']}")
env.close()
