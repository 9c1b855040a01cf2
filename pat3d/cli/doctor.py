"""What works on this computer, and what would enable more."""

from __future__ import annotations

import os
import platform
import re
import sys
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.scene.versions import version_of

if TYPE_CHECKING:
    from rich.console import Console

NEEDED = {
    "numpy": "2.0",
    "scipy": "1.13",
    "warp-lang": "1.15",
    "mujoco": "3.9",
    "trimesh": "4.5",
    "manifold3d": "3.0",
    "coacd": "1.0.5",
    "python-fcl": "0.7.0.8",
    "clarabel": "0.9",
    "embreex": "2.17",
    "pillow": "10.0",
    "pyyaml": "6.0",
    "jsonschema": "4.20",
    "networkx": "3.0",
    "rich": "13.0",
    "ipctk": "1.3",
}
"""Least versions that are supported."""

OPTIONAL = {
    "torch": "losses and gradients in PyTorch",
    "usd-core": "USD files",
    "gymnasium": "reinforcement-learning environments",
    "robosuite": "robots and controllers",
    "pyarrow": "records of policy evaluations",
    "websockets": "policies on openpi servers",
    "imageio-ffmpeg": "films of episodes as MP4",
    "h5py": "demonstrations for robomimic",
    "lerobot": "checkpoints of LeRobot as policies",
    "ray": "suites made by a cluster",
    "mujoco-warp": "thousands of scenes at once on a GPU",
}


def examine(target: Console) -> int:
    """Print what was found; returns 1 if something that is needed is missing."""
    from rich.table import Table

    good = True
    table = Table(box=None, pad_edge=False, show_header=False)
    table.add_column(width=6)
    table.add_column()
    table.add_column(overflow="fold")

    def row(state: str, what: str, text: str) -> None:
        text = text.replace("[", r"\[")
        colour = {"ok": "green", "no": "yellow", "FAULT": "red"}[state]
        table.add_row(f"[{colour}]{state}[/]", what, text)

    row("ok" if sys.version_info >= (3, 11) else "FAULT", "Python", f"{platform.python_version()}, {sys.executable}")
    row("ok", "computer", f"{platform.system()} {platform.machine()}, {_cores()} cores, {_memory()}")
    for package, least in NEEDED.items():
        found = version_of(package)
        fits = found is not None and _number(found) >= _number(least)
        good &= fits
        advice = "" if fits else ": pip install pat3d again"
        row("ok" if fits else "FAULT", package, f"{found or 'missing'} (needs {least} or newer){advice}")
    good &= _warp(row)
    row("ok", "pictures", "drawn on the CPU; no GL library is needed")
    _egl(row)
    for package, what in OPTIONAL.items():
        found = version_of(package)
        if found:
            row("ok", package, f"{found}: {what}")
        else:
            row("no", package, f"not installed; would enable {what}: {_extra(package)}")
    _engines(row)
    from pat3d.scene.cache import cache_root

    row("ok", "mesh cache", _folder(cache_root()))
    target.print(table)
    return 0 if good else 1


def _warp(row: Any) -> bool:
    """Report Warp's devices and its compiled kernels."""
    try:
        from pat3d.sim.compilation import cache_folder, is_warm, quiet_warp

        devices = [f"{device.alias} ({device.name})" for device in quiet_warp().get_devices()]
        gpus = [name for name in devices if name.startswith("cuda")]
        row("ok", "simulator", "runs on " + ", ".join(devices))
        if not gpus:
            row("no", "GPU", "none that CUDA knows; an NVIDIA driver would enable --device cuda")
        warm = "compiled" if is_warm() else "not compiled yet; the first run takes up to a minute longer"
        row("ok", "kernels", f"{warm}: {_folder(cache_folder())}")
    except Exception as error:
        # Whatever a broken installation raises is the finding.
        row("FAULT", "simulator", f"Warp does not start: {type(error).__name__}: {error}")
        return False
    return True


def _engines(row: Any) -> None:
    """Report which engines `pat3d check --engines` can run."""
    from pat3d.check.engines.environments import NAMES, engines_root, how_to_get, is_made

    for name in NAMES:
        if is_made(name):
            row("ok", name, f"engine for pat3d check --engines, in {engines_root() / name}")
        else:
            row("no", name, f"would let pat3d check --engines run scenes there: {how_to_get(name)}")


def _egl(row: Any) -> None:
    from pat3d.view.gl import egl_renderer, is_software

    card = egl_renderer()
    if card is None:
        row("no", "EGL", "MuJoCo's own renderer does not work here; libegl1 and a driver would enable it")
    elif is_software(card):
        row("ok", "EGL", f"MuJoCo's own renderer works, on the CPU ({card}); environments trace rays instead")
    else:
        row("ok", "EGL", f"MuJoCo's own renderer works too, and draws the pictures of environments ({card})")


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _memory() -> str:
    try:
        size = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return "memory unknown"
    return f"{size / 2**30:.1f} GiB of memory"


def _folder(path: Path) -> str:
    """A folder and how much is in it."""
    try:
        size = sum(file.stat().st_size for file in path.rglob("*") if file.is_file())
    except OSError:
        size = 0
    return f"{path} ({size / 1e6:.0f} MB)" if path.is_dir() else f"{path} (made when needed)"


def _number(version: str) -> tuple[int, ...]:
    """The numbers of a version: (3, 9, 0) for "3.9.0rc1"."""
    return tuple(int(part) for part in re.findall(r"\d+", re.split(r"[a-z+]", version)[0]))


def _extra(package: str) -> str:
    """How to install an optional package."""
    try:
        wanted = [line for line in metadata.requires("pat3d") or [] if line.lower().startswith(package)]
    except metadata.PackageNotFoundError:
        wanted = []
    extra = re.search(r"extra == ['\"](\w+)['\"]", wanted[0]) if wanted else None
    return f"pip install 'pat3d[{extra.group(1)}]'" if extra else f"pip install {package}"
