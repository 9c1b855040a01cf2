"""Warp started without its banner, and without its notice that there is no GPU."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_NOTICES = (b"NVIDIA CUDA driver", b"CUDA error 100:")
"""No driver; a driver and no device."""


def quiet_warp() -> Any:
    """The initialised `warp` module, without its banner."""
    import warp as wp

    wp.config.log_level = max(wp.config.log_level, wp.LOG_WARNING)
    with _no_gpu_notice():
        wp.init()
    return wp


@contextmanager
def _no_gpu_notice() -> Iterator[None]:
    """Keep back what Warp's library prints where there is no GPU; it writes past Python, to the descriptor."""
    sys.stderr.flush()
    with tempfile.TemporaryFile() as caught:
        terminal = os.dup(2)
        os.dup2(caught.fileno(), 2)
        try:
            yield
        finally:
            os.dup2(terminal, 2)
            os.close(terminal)
            caught.seek(0)
            rest = b"".join(line for line in caught if not any(notice in line for notice in _NOTICES))
            if rest:
                os.write(2, rest)
