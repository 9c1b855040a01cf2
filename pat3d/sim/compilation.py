"""Kernels compiled before they are needed, so that a watcher sees why the first run takes longer."""

from __future__ import annotations

import sys
from pathlib import Path

from pat3d.errors import SpecError
from pat3d.progress import Event, Progress, silent
from pat3d.sim.startup import quiet_warp


def prepare(device: str, progress: Progress = silent, *, deterministic: bool = False) -> str:
    """Load every kernel for `device` ("cpu" or "cuda"), compiling what no earlier run has compiled.

    Args:
        device: Warp's name of the device, or "cuda" for the first GPU.
        progress: called before every module.
        deterministic: whether all later runs of this process on a GPU give the same bits every time, for more time and
            memory (`pat3d.sim.determinism`); those on a CPU do anyway.

    Returns:
        Warp's name of the device.

    Raises:
        SpecError: there is no such device here.
    """
    wp, name = quiet_warp(), device_name(device)
    if deterministic and wp.get_device(name).is_cuda:
        from pat3d.sim import determinism

        determinism.enable()
    detail = "" if is_warm() else "compiling kernels, once, up to a minute"
    names = settling_modules()
    for number, module in enumerate(names):
        progress(Event(stage="preparing the simulator", detail=detail, step=number, steps=len(names)))
        wp.load_module(sys.modules[module], device=name)
    return name


def settling_modules() -> tuple[str, ...]:
    """Names of the modules whose kernels settling launches; they are imported then."""
    import pat3d.sim.settling  # noqa: F401
    from pat3d.sim.kernel_modules import declared_modules

    return tuple(module.name for module in declared_modules() if not module.gradients)


def device_name(device: str) -> str:
    """Warp's name of `device` ("cpu", or "cuda" for the first GPU).

    Raises:
        SpecError: there is no such device here.
    """
    known = [str(found.alias) for found in quiet_warp().get_devices()]
    name = next((alias for alias in known if alias == device or (device == "cuda" and alias.startswith("cuda"))), None)
    if name is None:
        raise SpecError(f'there is no device "{device}" here. Valid: {", ".join(known)}.')
    return name


def cache_folder() -> Path:
    """Where Warp keeps compiled kernels; it need not exist."""
    return Path(quiet_warp().config.kernel_cache_dir)


def is_warm() -> bool:
    """Whether every module was compiled by an earlier run (of any version of its kernels)."""
    try:
        compiled = [entry.name for entry in cache_folder().iterdir()]
    except OSError:
        return False
    return all(any(name.startswith(f"wp_{module}_") for name in compiled) for module in settling_modules())
