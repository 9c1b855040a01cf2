"""Whether MuJoCo can draw through EGL or OSMesa here, found out without risking this process."""

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
    drawn = renderer.render().any()
    from OpenGL import GL
    print(GL.glGetString(GL.GL_RENDERER).decode("ascii", "replace") if drawn else "")
"""


KINDS = ("egl", "osmesa")
"""Ways to draw without a window, the better one first; EGL has the graphics card where there is one."""

SOFTWARE = ("llvmpipe", "softpipe", "swrast", "software")
"""In the names of renderers that are no graphics card."""


def is_software(renderer: str) -> bool:
    """Whether `renderer`, as GL names it, computes on the CPU."""
    return any(word in renderer.lower() for word in SOFTWARE)


def gl_renderer(kind: str, timeout: float = 20.0) -> str | None:
    """The name of what draws MuJoCo's pictures through `kind` here, None where nothing does.

    Broken drivers crash or hang, so the attempt runs in a process of its own. Never raises.

    Args:
        kind: one of KINDS.
        timeout: [s] after which the answer is None.
    """
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-c", _PROBE],
            env={**os.environ, "MUJOCO_GL": kind, "PYOPENGL_PLATFORM": kind},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=timeout,
            check=False,
        )
    except (OSError, ValueError, subprocess.SubprocessError):
        return None
    name = done.stdout.decode("ascii", "replace").strip()
    return name if done.returncode == 0 and name else None
