"""A studio that is open: its address, and everything to be ended with it."""

from __future__ import annotations

import io
import secrets
import socket
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pat3d.errors import EvaluationError, SpecError
from pat3d.mcp_server.root import Root
from pat3d.progress import Event
from pat3d.studio.episodes import MOST, Episodes, listed
from pat3d.studio.gallery import Gallery
from pat3d.studio.gate import Gate, is_loopback
from pat3d.studio.jobs import warmed
from pat3d.studio.page import page
from pat3d.studio.panel import Panel
from pat3d.studio.session import Session
from pat3d.studio.status import StatusLine
from pat3d.studio.store import Store, name_of
from pat3d.studio.workbench import Watch, Workbench
from pat3d.studio.worker import Run, Worker

PORT = 8790
"""Where nobody says another."""

Page = Panel | Episodes
"""What a browser shows."""


@dataclass(frozen=True, kw_only=True)
class Studio:
    """What is open."""

    address: str
    """To open in a browser; with the token where one is needed."""
    bench: Workbench
    store: Store
    page: Page


@contextmanager
def opened(
    *shown: str | Path, root: str | Path | None = None, host: str = "127.0.0.1", port: int = PORT
) -> Iterator[Studio]:
    """A studio that serves browsers until the block ends.

    Args:
        shown: a folder with a scene or a suite, or one or two with evaluations; none to begin without.
        root: folder that scenes are saved in; where None the one that the scene is in, or "scenes".
        host: address to listen at. Other machines reach any but the loopback, and need the token of the address.
        port: 0 for any that is free.

    Raises:
        SpecError: there is no scene, or no such root; or the folders cannot be shown together.
        SuiteError: the suite is unfinished or damaged.
        EvaluationError: an evaluation cannot be read.
        EnvironmentSetupError: nothing can listen there.
    """
    import viser

    with ExitStack() as stack:
        folders = [Path(one).expanduser().absolute() for one in shown]
        kind = kind_of(folders)
        beside = "scenes" if kind in ("nothing", "suite") else folders[0].parent
        store = Store(Root.at(root if root is not None else beside))
        stack.callback(store.close)
        bench = Workbench(store.opened(folders[0]) if kind == "scene" else None)
        worker = Worker(store.scratch)
        stack.callback(worker.close)
        with redirect_stdout(io.StringIO()):
            # viser prints its own address, which is not the one to open.
            server = viser.ViserServer(host="127.0.0.1", port=0, label="PAT3D studio", verbose=False)
        stack.callback(server.stop)
        stack.callback(bench.wait, 60.0)
        stack.callback(bench.cancel)
        stack.callback(bench.forget)
        server.gui.configure_theme(control_width="large", show_logo=False)
        if kind != "evaluations":
            server.on_client_connect(_once(lambda: worker.warm(warmed)))
        shown_page = _page(kind, server, folders, bench, store, worker.run)
        token = None if is_loopback(host) else secrets.token_urlsafe(24)
        gate = Gate(host, port, inner=server.get_port(), token=token, page=page)
        stack.callback(gate.close)
        named = socket.gethostname() if host in ("0.0.0.0", "::", "") else host
        where = f"http://{f'[{named}]' if ':' in named else named}:{gate.port}/"
        address = where if token is None else f"{where}?token={token}"
        yield Studio(address=address, bench=bench, store=store, page=shown_page)


def _once(act: Callable[[], None]) -> Callable[[Any], None]:
    """What does `act` when it is first called."""
    left = [act]

    def hear(_: Any) -> None:
        if left:
            left.pop()()

    return hear


Kind = Literal["nothing", "scene", "suite", "evaluations"]


def kind_of(folders: Sequence[Path]) -> Kind:
    """What `folders` are, by the files in them.

    Raises:
        SpecError: they cannot be shown together.
    """
    if not folders:
        return "nothing"
    suites = [(folder / "suite.json").is_file() for folder in folders]
    evaluations = [(folder / "manifest.json").is_file() for folder in folders]
    if all(evaluations):
        if len(folders) > MOST:
            raise SpecError(f"{len(folders)} evaluations: {MOST} can be seen side by side.")
        return "evaluations"
    if len(folders) > 1:
        raise SpecError("give one scene, one suite, or one or two evaluations; several folders have to be evaluations.")
    return "suite" if suites[0] else "scene"


def _page(kind: Kind, server: Any, folders: Sequence[Path], bench: Workbench, store: Store, run: Run) -> Page:
    status = StatusLine(server.gui, bench)
    if kind == "evaluations":
        from pat3d.policies_eval.run.records import read_evaluation

        evaluations = [read_evaluation(folder) for folder in folders]
        if not listed(evaluations):
            raise EvaluationError(
                f"{' and '.join(map(str, folders))} share no episode; evaluate both with the same options."
            )
        return Episodes(server, bench, status, run, evaluations)
    if kind == "suite":
        from pat3d.envs.suites.suite import Suite

        suite = Suite.open(folders[0])

        def take(folder: Path) -> None:
            def work(now: Session | None, progress: Watch) -> tuple[Session, str]:
                progress(Event(stage="opening", detail=folder.name))
                found = store.opened(folder)
                gallery.hide()
                panel.veil(False)
                return found if now is None else now.stepped(found.current), f"opened {folder.name}."

            bench.start("Opening", work)

        gallery = Gallery(server, suite, take, lambda: panel.veil(True))
    panel = Panel(server, bench, status, store, name_of(folders[0]) if kind == "scene" else "scene", run)
    return panel
