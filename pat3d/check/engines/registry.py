"""The engines by name."""

from __future__ import annotations

from collections.abc import Iterable

from pat3d.check.engines.process import DRIVERS, ScriptEngine
from pat3d.check.engines.protocol import Engine
from pat3d.errors import SpecError

_ALL = (
    ScriptEngine(name="mujoco", title="MuJoCo", format="mjcf", driver=DRIVERS / "drive_mujoco.py", environment=None),
    ScriptEngine(
        name="mujoco-oldest",
        title="MuJoCo, oldest supported",
        format="mjcf",
        driver=DRIVERS / "drive_mujoco.py",
        environment="mujoco-oldest",
    ),
    ScriptEngine(
        name="mujoco-newest",
        title="MuJoCo, newest",
        format="mjcf",
        driver=DRIVERS / "drive_mujoco.py",
        environment="mujoco-newest",
    ),
    ScriptEngine(
        name="newton-mujoco",
        title="Newton, MuJoCo solver",
        format="usd",
        driver=DRIVERS / "drive_newton.py",
        environment="newton",
        variant="mujoco",
    ),
    ScriptEngine(
        name="newton-xpbd",
        title="Newton, XPBD solver",
        format="usd",
        driver=DRIVERS / "drive_newton.py",
        environment="newton",
        variant="xpbd",
    ),
    ScriptEngine(
        name="pybullet", title="PyBullet", format="urdf", driver=DRIVERS / "drive_pybullet.py", environment="pybullet"
    ),
    ScriptEngine(name="drake", title="Drake", format="urdf", driver=DRIVERS / "drive_drake.py", environment="drake"),
    ScriptEngine(
        name="physx", title="PhysX on the CPU", format="usd", driver=DRIVERS / "drive_physx.py", environment="physx"
    ),
)

ENGINES: dict[str, Engine] = {engine.name: engine for engine in _ALL}

GROUPS = {"newton": ("newton-mujoco", "newton-xpbd"), "all": tuple(ENGINES)}
"""Names that stand for several engines."""


def chosen(names: Iterable[str]) -> tuple[Engine, ...]:
    """The engines that `names` name, each once; commas within a name separate.

    Raises:
        SpecError: a name that is no engine's.
    """
    wanted: list[str] = []
    for name in (word.strip() for words in names for word in words.split(",")):
        if name not in ENGINES and name not in GROUPS:
            raise SpecError(f'unknown engine "{name}". Valid: {", ".join([*ENGINES, *GROUPS])}.')
        wanted += GROUPS.get(name, (name,))
    return tuple(ENGINES[name] for name in dict.fromkeys(wanted))
