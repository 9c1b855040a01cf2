"""What a process keeps of worlds that it no longer needs: no more than a bound, however many scenes it goes through.

MuJoCo's compiler keeps meshes and textures of files that it has read, 500 MB of them. Those of the robot are wanted
again for every world; those of a scene hardly ever. The C library keeps memory that was freed, in pieces too small for
the next world.
"""

from __future__ import annotations

import ctypes
import functools
import sys

COMPILER_CACHE = 128_000_000
"""Of files that MuJoCo's compiler has read [bytes]; a Panda's are 62 MB, of which what is used most stays longest."""


@functools.cache
def bound_compiler_cache() -> None:
    """Have MuJoCo's compiler keep no more than COMPILER_CACHE, once in a process; more may be allowed it afterwards."""
    import mujoco

    cache = mujoco.mj_getCache()
    mujoco.mj_setCacheCapacity(cache, min(COMPILER_CACHE, mujoco.mj_getCacheCapacity(cache)))


def give_back() -> None:
    """Give the system back what is free; other C libraries than glibc decide that themselves."""
    trim = _trim()
    if trim is not None:
        trim(0)


@functools.cache
def _trim() -> ctypes._NamedFuncPointer | None:
    return getattr(ctypes.CDLL(None), "malloc_trim", None) if sys.platform == "linux" else None
