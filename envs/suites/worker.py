"""A worker process: reads blocks of units from its input, a JSON line each, and answers with a line for every unit.

It has no other tie to its run and ends when its input does, in the middle of a unit too: a run that is killed leaves
nobody behind who still writes.
"""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Callable, Iterator
from queue import SimpleQueue
from typing import Any, TextIO

from pat3d.envs.suites.folder import SuiteFolder
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.worker_pool import Unit
from pat3d.errors import Pat3dError


def main() -> int:
    """Serve one run; the first line of the input says which."""
    units: SimpleQueue[dict[str, Any]] = SimpleQueue()
    # The protocol keeps the real output to itself; whatever libraries print goes to the log.
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    threading.Thread(target=_listen, args=(units,), daemon=True).start()
    try:
        order = units.get()
        folder, request = SuiteFolder(order["folder"]), Request.from_dict(order["request"], "worker")
        prepare_for(request)
        _say(out, {"ready": True})
        while True:
            block = [(place, candidate) for place, candidate in units.get()["units"]]
            for answer in _made(folder, request, block, lambda: _say(out, {"alive": True})):
                _say(out, answer)
    except (OSError, MemoryError, Pat3dError) as error:
        _say(out, {"fatal": f"{type(error).__name__}: {error}"})
        return 1


def _made(
    folder: SuiteFolder, request: Request, block: list[Unit], alive: Callable[[], None]
) -> Iterator[dict[str, Any]]:
    from pat3d.envs.suites.block import make_block

    return make_block(folder, request, block, alive)


def prepare_for(request: Request) -> None:
    """Everything that is slow the first time."""
    from pat3d.envs.robots.arms import require_robot
    from pat3d.envs.suites.threads import keep_to_one_thread
    from pat3d.sim.compilation import prepare

    keep_to_one_thread()
    require_robot(request.robot)
    prepare(request.device)


def _listen(units: SimpleQueue[dict[str, Any]]) -> None:
    for line in sys.stdin:
        units.put(json.loads(line))
    os._exit(0)


def _say(out: TextIO, answer: dict[str, Any]) -> None:
    out.write(json.dumps(answer) + "\n")
    out.flush()


if __name__ == "__main__":
    sys.exit(main())
