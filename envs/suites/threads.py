"""Keeps a worker to one thread: the workers themselves are what fills the cores."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "RAYON_NUM_THREADS"), "1"
)
"""Environment of a worker; libraries read it when they are loaded."""


def keep_to_one_thread() -> None:
    """Let Manifold and embree, for which no variable exists, start no threads: they count cores when first used."""
    from manifold3d import Manifold

    with _on_one_core():
        ball = Manifold.sphere(1.0, 32)
        (ball ^ ball.translate((0.3, 0.1, 0.2))).volume()
        try:
            from embreex.rtcore_scene import EmbreeScene
        except ImportError:
            # Nothing is drawn, then.
            return
        EmbreeScene()


@contextmanager
def _on_one_core() -> Iterator[None]:
    try:
        own = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {min(own)})
    except (AttributeError, OSError):
        # There is no such call here, or it is not allowed.
        yield
        return
    try:
        yield
    finally:
        os.sched_setaffinity(0, own)
