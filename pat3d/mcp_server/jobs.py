"""Long work in a thread, one job at a time, which tells of its progress and ends soon after it is cancelled."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, TypeVar

from pat3d.errors import Pat3dError
from pat3d.progress import Event, Progress

T = TypeVar("T")

TOLD_EVERY = 0.25
"""A client hears of a stage in progress at most this often [s]."""


class Jobs:
    """The jobs of one server."""

    def __init__(self) -> None:
        import anyio

        # Kernels and BLAS run in one thread; a second job waits for the first, cancelled or not, to have ended.
        self._one_at_a_time = anyio.CapacityLimiter(1)

    async def run(self, context: Any, work: Callable[[Progress], T]) -> T:
        """What `work` returns; it is called in a thread with a progress that raises once the request is cancelled.

        Raises:
            ToolError: `work` raised an error that PAT3D raises on purpose.
        """
        import anyio
        from mcp.server.mcpserver.exceptions import ToolError

        def job() -> T:
            return work(_Teller(context).tell)

        try:
            return await anyio.to_thread.run_sync(job, limiter=self._one_at_a_time)
        except Pat3dError as error:
            raise ToolError(f"{type(error).__name__}: {error}") from error


class _Teller:
    """Hands events of a thread to the client that waits."""

    def __init__(self, context: Any) -> None:
        self._context, self._told, self._stage, self._last = context, 0, "", 0.0

    def tell(self, event: Event) -> None:
        """Tell the client of `event`.

        Raises:
            CancelledError: of anyio, where nobody waits any more; what was begun is left out or put back on its way up.
        """
        from anyio import from_thread

        from_thread.check_cancelled()
        now = time.monotonic()
        if event.stage == self._stage and now - self._last < TOLD_EVERY:
            return
        self._stage, self._last, self._told = event.stage, now, self._told + 1
        step = "" if event.step is None or event.steps is None else f" {event.step + 1}/{event.steps}"
        message = f"{event.stage}{step}{f': {event.detail}' if event.detail else ''}"
        from_thread.run(self._context.report_progress, float(self._told), None, message)
