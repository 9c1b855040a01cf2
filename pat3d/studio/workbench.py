"""One session that several browsers share: changes one at a time, long work in a thread that can be cancelled."""

from __future__ import annotations

import threading
import traceback
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

from pat3d.errors import EditError, Pat3dError
from pat3d.progress import Event
from pat3d.studio.session import Session

Change = Callable[[Session | None], Session | None]


MAX_WAITING = 20
"""Orders that wait at a time."""


class CancelledError(Exception):
    """Somebody does not want the work any more."""


class Watch:
    """The progress of work that can be cancelled."""

    def __init__(self, tell: Callable[[Event], None], cancelled: Callable[[], bool]) -> None:
        self._tell, self._cancelled = tell, cancelled

    def __call__(self, event: Event) -> None:
        """Hear of an event.

        Raises:
            CancelledError: the work is to end.
        """
        self.check()
        self._tell(event)

    def followed(self, hear: Callable[[Event], None]) -> Watch:
        """One that tells `hear` as well."""

        def tell(event: Event) -> None:
            self._tell(event)
            hear(event)

        return Watch(tell, self._cancelled)

    def check(self) -> None:
        """Raise CancelledError where the work is to end."""
        if self._cancelled():
            raise CancelledError


Work = Callable[[Session | None, Watch], tuple[Session | None, str]]
"""Takes minutes; returns the new session and what to say of it."""


@dataclass(frozen=True, kw_only=True)
class Status:
    """What the studio does and what came of the last thing."""

    said: str = ""
    """What came of it, in words."""
    failed: bool = False
    working: str = ""
    """Name of the work that is going on; empty for none."""
    stage: str = ""
    share: float | None = None
    """Of the stage that is done [-]; None where nobody knows."""


@dataclass(frozen=True, kw_only=True)
class Order:
    """Long work that waits for its turn, or had it."""

    title: str
    state: Literal["waiting", "working", "done", "refused", "cancelled"] = "waiting"
    said: str = ""
    """What came of it."""


class Workbench:
    """Holds the session; every method may be called from any thread."""

    def __init__(self, session: Session | None, changed: Callable[[], None] = lambda: None) -> None:
        """Begin with `session`; `changed` is called after the session or the status changed, from whichever thread."""
        self.changed = changed
        self._lock = threading.Lock()
        self._session, self._status = session, Status()
        self._thread: threading.Thread | None = None
        self._cancel = threading.Event()
        self._orders: list[Order] = []
        self._waiting: deque[tuple[int, str, Work]] = deque()
        """Place in the list of orders, name and work."""

    @property
    def orders(self) -> tuple[Order, ...]:
        """Everything that was ordered, in order."""
        return tuple(self._orders)

    @property
    def session(self) -> Session | None:
        """As it is now; None where no scene was opened or made."""
        return self._session

    @property
    def status(self) -> Status:
        """As it is now."""
        return self._status

    def do(self, change: Change, said: str = "") -> bool:
        """Change the session at once; whether it could be changed. Where not, the status says why."""
        with self._lock:
            if self._status.working:
                self._status = replace(
                    self._status, said=f"{self._status.working} is going on: wait for it or cancel it.", failed=True
                )
                done = False
            else:
                done = not self._tried(lambda: (change(self._session), said)).failed
        self.changed()
        return done

    def start(self, name: str, work: Work) -> bool:
        """Begin long work in a thread; False where other work goes on. What fails or is cancelled changes nothing."""
        with self._lock:
            free = not self._status.working
            if free:
                self._begin(name, work, None)
        if free:
            self.changed()
        return free

    def order(self, name: str, title: str, work: Work) -> bool:
        """Begin long work, after what goes on and what was ordered before; False where too much waits already."""
        with self._lock:
            room = len(self._waiting) < MAX_WAITING
            if room:
                self._waiting.append((len(self._orders), name, work))
                self._orders.append(Order(title=title))
        self._next()
        return room

    def forget(self) -> None:
        """Drop what waits; what goes on is not cancelled."""
        with self._lock:
            for place, _, _ in self._waiting:
                self._orders[place] = replace(self._orders[place], state="cancelled")
            self._waiting.clear()
        self.changed()

    def cancel(self) -> None:
        """Ask the work that is going on to end: at once where a worker does it, else at its next step."""
        self._cancel.set()

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the work that is going on and what was ordered; whether all has ended in `seconds` for each."""
        ended: threading.Thread | None = None
        while True:
            with self._lock:
                thread = self._thread
            if thread is ended:
                return True
            if thread is not None:
                thread.join(seconds)
                if thread.is_alive():
                    return False
            ended = thread

    def _next(self) -> None:
        """Begin what has waited longest, where nothing goes on."""
        with self._lock:
            if self._waiting and not self._status.working:
                place, name, work = self._waiting.popleft()
                self._orders[place] = replace(self._orders[place], state="working")
                self._begin(name, work, place)
        self.changed()

    def _begin(self, name: str, work: Work, place: int | None) -> None:
        self._cancel = threading.Event()
        self._status = Status(working=name, stage="beginning")
        self._thread = threading.Thread(target=self._run, args=(name, work, place), daemon=True, name="pat3d studio")
        self._thread.start()

    def _run(self, name: str, work: Work, place: int | None) -> None:
        before, cancel = self._session, self._cancel

        def tell(event: Event) -> None:
            step, steps = event.step, event.steps
            share = None if step is None or not steps else min(1.0, (step + 1) / steps)
            words = f"{event.stage}: {event.detail}" if event.detail else event.stage
            counted = words if step is None else f"{words}, step {step + 1}"
            self._status = replace(self._status, stage=counted, share=share)
            self.changed()

        cancelled = False

        def ended() -> tuple[Session | None, str]:
            nonlocal cancelled
            try:
                return work(before, Watch(tell, cancel.is_set))
            except CancelledError:
                cancelled = True
                return before, f"{name} was cancelled; nothing changed."

        # Outside the lock, so that the session can be looked at; nothing else changes it while work is going on.
        found = self._tried(ended)
        if place is not None:
            state = "cancelled" if cancelled else "refused" if found.failed else "done"
            self._orders[place] = replace(self._orders[place], state=state, said=found.said)
        self._next()

    def _tried(self, step: Callable[[], tuple[Session | None, str]]) -> Status:
        try:
            session, said = step()
        except Pat3dError as error:
            found = Status(said=str(error), failed=True)
        except Exception as error:
            # A studio outlives a fault of one step; the terminal has the traceback.
            traceback.print_exc()
            found = Status(said=f"{type(error).__name__}: {error}", failed=True)
        else:
            self._session = session
            found = Status(said=said)
        self._status = found
        return found


def needed(session: Session | None) -> Session:
    """The session.

    Raises:
        EditError: there is none yet.
    """
    if session is None:
        raise EditError("there is no scene yet: make one from a sentence.")
    return session
