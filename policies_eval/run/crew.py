"""The processes that share out an ensemble of episodes, or this one alone."""

from __future__ import annotations

import functools
import multiprocessing
from collections.abc import Mapping
from multiprocessing.connection import Connection
from typing import Any, Protocol

from pat3d.errors import EvaluationError, InfrastructureError, Pat3dError
from pat3d.policies_eval.run.ensemble import Ensemble, Part
from pat3d.policies_eval.run.processes import GRACE_SECONDS, POLL_SECONDS, cores, now, serve, thread_limit, told
from pat3d.policies_eval.run.settings import RolloutSettings


class GoneError(Exception):
    """A process ended, or its policies hung where no signal reaches them."""


class Member(Protocol):
    """Some of the episodes of an ensemble, here or in another process."""

    def ask(self, what: str, value: Any) -> None:
        """Have a method of the ensemble called."""
        ...

    def answer(self) -> Any:
        """What it returned. Raises GoneError where its process did not come back."""
        ...

    def close(self) -> None:
        """End it."""
        ...


class _Here:
    def __init__(self, part: Part, settings: RolloutSettings) -> None:
        self._ensemble = Ensemble(part, settings)
        self._answer: Any = None

    def ask(self, what: str, value: Any) -> None:
        try:
            self._answer = getattr(self._ensemble, what)(value)
        except (Pat3dError, ModuleNotFoundError):
            raise
        except Exception as error:
            raise InfrastructureError(_no_score(told(error))) from error

    def answer(self) -> Any:
        return self._answer

    def close(self) -> None:
        """Nothing to end."""


class _There:
    def __init__(self, part: Part, settings: RolloutSettings, count: int) -> None:
        # Spawned ones share no threads, locks, graphics contexts or devices with this process.
        context = multiprocessing.get_context("spawn")
        self._settings = settings
        self._pipe, there = context.Pipe()
        self._deadline = context.Value("d", 0.0, lock=False)
        self._process = context.Process(
            target=_work, args=(there, part, settings, self._deadline), daemon=True, name="pat3d-ensemble"
        )
        with thread_limit(max(1, cores() // count)):
            self._process.start()
        there.close()

    def ask(self, what: str, value: Any) -> None:
        try:
            self._pipe.send((what, value))
        except OSError:
            # It died meanwhile; `answer` sees the closed pipe.
            return

    def answer(self) -> Any:
        try:
            while not self._pipe.poll(POLL_SECONDS):
                limit = float(self._deadline.value)
                if limit and now() > limit + GRACE_SECONDS:
                    raise GoneError(f"hang: no answer within {self._settings.act_seconds:g} s, its process was ended")
            kind, content = self._pipe.recv()
        except (EOFError, OSError):
            self._process.join(GRACE_SECONDS)
            raise GoneError(f"the process ended with exit code {self._process.exitcode}") from None
        if kind == "missing":
            raise ModuleNotFoundError(f"No module named '{content}'", name=content)
        if kind == "error":
            raise EvaluationError(content)
        if kind == "broken":
            raise InfrastructureError(_no_score(content))
        return content

    def close(self) -> None:
        self._pipe.close()
        if self._process.is_alive():
            self._process.kill()
        self._process.join(GRACE_SECONDS)


def members(part: Part, settings: RolloutSettings, count: int) -> list[Member]:
    """So many processes; this one where it is 0."""
    if count == 0:
        return [_Here(part, settings)]
    return [_There(part, settings, count) for _ in range(count)]


def ask_all(crew: Mapping[int, Member], what: str, values: Mapping[int, Any]) -> tuple[dict[int, Any], dict[int, str]]:
    """Have a method called by several members at once.

    Args:
        crew: members by number.
        what: the method of the ensemble.
        values: its argument, by the number of the member.

    Returns:
        What they answered, and why those who are gone did not.
    """
    answers, gone = {}, {}
    for number, value in values.items():
        crew[number].ask(what, value)
    for number in values:
        try:
            answers[number] = crew[number].answer()
        except GoneError as why:
            gone[number] = str(why)
    return answers, gone


def _no_score(reason: str) -> str:
    return f"an episode could not be done: {reason}. This is no score; see pat3d doctor."


def _work(pipe: Connection, part: Part, settings: RolloutSettings, deadline: Any) -> None:
    """What a process does."""
    made = functools.cache(lambda: Ensemble(part, settings, deadline))
    serve(pipe, lambda asked: getattr(made(), asked[0])(asked[1]))
