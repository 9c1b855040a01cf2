"""A studio that is open: its address, and everything to be ended with it."""

from __future__ import annotations

import io
import secrets
import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

from pat3d.mcp_server.root import Root
from pat3d.studio.gate import Gate, is_loopback
from pat3d.studio.panel import Panel
from pat3d.studio.store import Store, name_of
from pat3d.studio.workbench import Workbench
from pat3d.studio.worker import Worker

PORT = 8790
"""Where nobody says another."""


@dataclass(frozen=True, kw_only=True)
class Studio:
    """What is open."""

    address: str
    """To open in a browser; with the token where one is needed."""
    bench: Workbench
    store: Store
    panel: Panel


@contextmanager
def opened(
    scene: str | Path | None = None, *, root: str | Path | None = None, host: str = "127.0.0.1", port: int = PORT
) -> Iterator[Studio]:
    """A studio that serves browsers until the block ends.

    Args:
        scene: folder to open; None to begin without.
        root: folder that scenes are saved in; the one that `scene` is in where None, else "scenes".
        host: address to listen at. Other machines reach any but the loopback, and need the token of the address.
        port: 0 for any that is free.

    Raises:
        SpecError: there is no scene, or no such root.
        EnvironmentSetupError: nothing can listen there.
    """
    import viser

    with ExitStack() as stack:
        folder = None if scene is None else Path(scene).expanduser().absolute()
        store = Store(Root.at(root if root is not None else "scenes" if folder is None else folder.parent))
        stack.callback(store.close)
        session = None if folder is None else store.opened(folder)
        bench = Workbench(session)
        worker = Worker(store.scratch)
        stack.callback(worker.close)
        with redirect_stdout(io.StringIO()):
            # viser prints its own address, which is not the one to open.
            server = viser.ViserServer(host="127.0.0.1", port=0, label="PAT3D studio", verbose=False)
        stack.callback(server.stop)
        stack.callback(bench.wait, 60.0)
        stack.callback(bench.cancel)
        server.gui.configure_theme(control_width="large", show_logo=False)
        panel = Panel(server, bench, store, name_of(folder) if folder is not None else "scene", worker.run)
        token = None if is_loopback(host) else secrets.token_urlsafe(24)
        gate = Gate(host, port, inner=server.get_port(), token=token)
        stack.callback(gate.close)
        named = socket.gethostname() if host in ("0.0.0.0", "::", "") else host
        where = f"http://{f'[{named}]' if ':' in named else named}:{gate.port}/"
        address = where if token is None else f"{where}?token={token}"
        yield Studio(address=address, bench=bench, store=store, panel=panel)
