"""Makes "PAT3D-v0" known to Gymnasium, which has no plug-in loader: `import pat3d` does it where Gymnasium is loaded.

`import gymnasium, pat3d`, or `gymnasium.make("pat3d:PAT3D-v0")`, which imports pat3d itself.
"""

from __future__ import annotations

ENV_ID = "PAT3D-v0"

MAX_EPISODE_STEPS = 400
"""20 s at 20 actions a second: time to move one object. Tasks that move several say themselves how long they take."""

IMAGE_SIDE = 128
"""Of observed pictures, unless one asks for another [pixel]: in environments, evaluations, demonstrations, LeRobot."""


def register_with_gymnasium() -> None:
    """Register the environment, once."""
    import gymnasium

    if ENV_ID not in gymnasium.registry:
        gymnasium.register(
            id=ENV_ID,
            entry_point="pat3d.envs.env:TabletopEnv",
            vector_entry_point="pat3d.envs.vector:make_vector",
            max_episode_steps=MAX_EPISODE_STEPS,
        )
