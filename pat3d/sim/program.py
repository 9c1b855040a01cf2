"""Fixed sequences of kernel launches, replayed without Python between them."""

from __future__ import annotations

from collections.abc import Callable

import warp as wp


class Program:
    """Launches that are the same every time: recorded once as a graph, then replayed.

    A launch from Python costs 20 us, a replayed one 0.3 us on a CPU and 2 us on a GPU.
    """

    def __init__(self, device: str, launches: Callable[[], None]):
        """Of the kernels that `launches` launches; it must not read anything back."""
        self._device = wp.get_device(device)
        self._launches = launches
        self._graph: wp.Graph | None = None
        self._runs = 0

    def run(self) -> None:
        """Launch everything."""
        self._runs += 1
        # The first run may load modules, which must not happen while recording.
        if self._runs == 1:
            self._launches()
            return
        if self._graph is None:
            with wp.ScopedCapture(self._device, force_module_load=False) as capture:
                self._launches()
            self._graph = capture.graph
        assert self._graph is not None
        wp.capture_launch(self._graph)

    def forget(self) -> None:
        """Record anew: an array was replaced or a number of threads has changed."""
        self._graph = None
