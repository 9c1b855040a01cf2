"""A scene file of any format as a MuJoCo model specification, which MuJoCo's own compiler then judges.

MJCF and URDF are read by MuJoCo itself. SDF and USD are translated first, see `sdf` and `usd`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pat3d.errors import CheckError

MAX_BYTES = 256 * 2**20
"""Largest scene file, its meshes not counted."""

SUFFIXES = (".xml", ".mjcf", ".urdf", ".sdf", ".world", ".usd", ".usda", ".usdc", ".usdz")


@dataclass(frozen=True, kw_only=True, eq=False)
class ForeignScene:
    """What was read from a file."""

    path: Path
    format: str
    """mjcf, urdf, sdf or usd."""
    spec: Any
    """mujoco.MjSpec"""
    notes: tuple[str, ...] = ()
    """What was left out or assumed."""

    def compile(self) -> Any:
        """The mujoco.MjModel.

        Raises:
            CheckError: MuJoCo refuses it; the message is MuJoCo's.
        """
        import mujoco

        try:
            return self.spec.compile()
        except (ValueError, mujoco.FatalError) as error:
            line = " ".join(str(error).split())
            raise CheckError(f"MuJoCo {mujoco.__version__} refuses {self.path}: {line}") from error


def load_foreign(path: str | Path) -> ForeignScene:
    """Read the scene file at `path`.

    Raises:
        CheckError: missing, too large, of no known format, or not readable; the message says why.
    """
    path = Path(path)
    kind = path.suffix.lower()
    if kind not in SUFFIXES:
        raise CheckError(f'"{path}" is of no known scene format. Valid: {", ".join(SUFFIXES)}.')
    try:
        size = path.stat().st_size
    except OSError as error:
        raise CheckError(f'"{path}" cannot be read ({error.strerror}).') from error
    if size > MAX_BYTES:
        raise CheckError(f'"{path}" has {size} bytes; at most {MAX_BYTES} are read.')
    if kind in (".xml", ".mjcf", ".urdf"):
        return _by_mujoco(path)
    if kind in (".sdf", ".world"):
        from pat3d.check.foreign.sdf import read_sdf_scene

        spec, notes = read_sdf_scene(path)
        return ForeignScene(path=path, format="sdf", spec=spec, notes=notes)
    from pat3d.check.foreign.usd import read_usd_scene

    spec, notes = read_usd_scene(path)
    return ForeignScene(path=path, format="usd", spec=spec, notes=notes)


def _by_mujoco(path: Path) -> ForeignScene:
    import mujoco

    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except (ValueError, mujoco.FatalError) as error:
        line = " ".join(str(error).split())
        raise CheckError(f"MuJoCo {mujoco.__version__} cannot read {path}: {line}") from error
    urdf = path.suffix.lower() == ".urdf" or b"<robot" in path.read_bytes()[:4096]
    return ForeignScene(path=path, format="urdf" if urdf else "mjcf", spec=spec)
