"""Recorded launches do what launching them does, whatever Python clears away meanwhile."""

import gc

import numpy as np
import pytest
import warp as wp

from pat3d.sim.launch_graph import LaunchGraph

needs_gpu = pytest.mark.skipif(wp.get_cuda_device_count() == 0, reason="no CUDA device")


def collect_where_python_may() -> None:
    """A cyclic collection at the worst moment; none where the collector is held back."""
    if gc.isenabled():
        gc.collect()


class Cycle:
    """Garbage that only the collector finds, and that says when it was found."""

    def __init__(self, found: list[bool], recording: list[bool]):
        self.itself, self.found, self.recording = self, found, recording

    def __del__(self):
        self.found.append(bool(self.recording))


def test_the_collector_waits_until_launches_are_recorded():
    value, found, recording = wp.zeros(1, dtype=float, device="cpu"), [], []
    rounds = 0

    def launches():
        nonlocal rounds
        rounds += 1
        if rounds == 2:  # the first run is launched, not recorded
            recording.append(True)
            Cycle(found, recording)
            collect_where_python_may()
        value.fill_(float(rounds))
        recording.clear()

    graph = LaunchGraph("cpu", launches)
    graph.run()
    assert gc.isenabled()
    graph.run()
    assert gc.isenabled()
    gc.collect()
    assert found == [False]
    assert value.numpy() == 2.0


def test_the_collector_is_back_when_launches_fail():
    def launches():
        if fails:
            raise ValueError("no")

    fails: list[bool] = []
    graph = LaunchGraph("cpu", launches)
    graph.run()
    fails.append(True)
    with pytest.raises(ValueError, match="no"):
        graph.run()
    assert gc.isenabled()


@needs_gpu
def test_a_graph_of_torch_that_is_garbage_does_not_break_what_is_recorded():
    torch = pytest.importorskip("torch")
    value = wp.zeros(4, dtype=float, device="cuda")
    view = wp.to_torch(value)
    old = LaunchGraph("cuda", lambda: view.add_(1.0), torch)
    old.run()
    old.run()
    garbage: list[object] = [old]
    garbage.append(garbage)

    def launches():
        nonlocal garbage, old
        if recorded:
            del garbage, old
            collect_where_python_may()
        value.fill_(7.0)

    recorded = False
    graph = LaunchGraph("cuda", launches)
    graph.run()
    recorded = True
    graph.run()
    wp.synchronize()
    np.testing.assert_array_equal(value.numpy(), 7.0)
