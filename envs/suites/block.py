"""Units made together: laid out one after another, settled side by side on one device, then checked and written."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from typing import Any

from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.unit import Making, make_unit
from pat3d.envs.suites.worker_pool import Unit
from pat3d.errors import SimulationError
from pat3d.generation.attempts import Attempt
from pat3d.generation.settle_stage import SettledScene, settle_scenes
from pat3d.sim.compilation import device_name


def make_block(
    folder: SuiteFolder, request: Request, units: Sequence[Unit], alive: Callable[[], None] = lambda: None
) -> Iterator[dict[str, Any]]:
    """Make candidates; each is in the suite when its answer comes.

    Args:
        folder: of the suite.
        request: what it is made from.
        units: which; one alone is made as if there were no blocks.
        alive: called after every step that ends without an answer.

    Returns:
        What `make_unit` says of each, in the order of `units`.

    Raises:
        OSError, Pat3dError: the folder cannot be written.
    """
    if len(units) == 1:
        yield make_unit(folder, request, *units[0])
        return
    with ExitStack() as open_ones:
        makings, begun = [], []
        for place, candidate in units:
            making = open_ones.enter_context(Making(folder, request, place, candidate))
            with making.working():
                begun.append(making.attempts.begun())
            makings.append(making)
            alive()
        rests = _settled(makings, begun, request.device)
        alive()
        for making, attempt, rest in zip(makings, begun, rests, strict=True):
            with making.working():
                if rest is not None:
                    done = making.attempts.settled(attempt, rest)
                else:
                    done = attempt if attempt.scene is None else making.attempts.first()
            yield making.conclude(done)


def _settled(makings: Sequence[Making], begun: Sequence[Attempt], device: str) -> list[SettledScene | None]:
    """How the scenes of `begun` settle side by side; None where there is none, or all have to settle alone."""
    found: list[SettledScene | None] = [None] * len(begun)
    places = [number for number, attempt in enumerate(begun) if attempt.scene is not None]
    scenes = [attempt.scene for attempt in begun if attempt.scene is not None]
    if not scenes:
        return found
    start = time.perf_counter()
    try:
        rests = settle_scenes(scenes, device=device_name(device))
    except (SimulationError, RuntimeError, MemoryError):
        # One of them is to blame, or their number; each tells for itself.
        return found
    share = (time.perf_counter() - start) / len(scenes)
    for number, rest in zip(places, rests, strict=True):
        found[number] = rest
        makings[number].seconds += share
        makings[number].clock.add("settling", share)
    return found
