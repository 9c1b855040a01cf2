"""Whether MuJoCo can draw through EGL here, found out without risking this process."""

from __future__ import annotations

import os
import subprocess
import sys

_PROBE = """
import mujoco
model = mujoco.MjModel.from_xml_string(
    '<mujoco><worldbody><light pos="0 0 3"/><geom size="0.1" rgba="1 0 0 1"/></worldbody></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 64, 64) as renderer:
    renderer.update_scene(data)
    print("drawn" if renderer.render().any() else "empty")
"""


def probe_egl(timeout: float = 20.0) -> bool:
    """Whether MuJoCo's EGL renderer draws a picture here.

    Broken drivers crash or hang, so the attempt runs in a process of its own. Never raises.

    Args:
        timeout: [s] after which the answer is no.
    """
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-c", _PROBE],
            env={**os.environ, "MUJOCO_GL": "egl", "PYOPENGL_PLATFORM": "egl"},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=timeout,
            check=False,
        )
    except (OSError, ValueError, subprocess.SubprocessError):
        return False
    return done.returncode == 0 and done.stdout.strip().endswith(b"drawn")
