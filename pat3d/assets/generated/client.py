"""Requests to a mesh server: bounded in time and size, retried with backoff, never redirected."""

from __future__ import annotations

import http.client
import json
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from typing import Any, NoReturn

from pat3d.assets.generated.settings import ServerSettings
from pat3d.errors import AssetError

FIRST_WAIT, LONGEST_WAIT = 1.0, 60.0
"""Between requests [s]; every wait is twice the one before unless the server says how long."""
MAX_JSON = 2**20
"""Bytes of an answer that holds no mesh."""
MAX_SHOWN = 300
"""Characters of a server's words in an error."""
_PIECE = 2**16
_BUSY = frozenset({408, 425, 429, 500, 502, 503, 504})


class RefusedError(AssetError):
    """The server answered with a status that says no."""

    def __init__(self, message: str, status: int) -> None:
        """`status` is that of HTTP."""
        super().__init__(message)
        self.status = status


class _BusyError(Exception):
    """This request may be made again; says why, and after how many seconds where the server does."""

    def __init__(self, why: str, after: float | None = None, status: int = 0) -> None:
        super().__init__(why)
        self.after, self.status = after, status


class _Nowhere(urllib.request.HTTPRedirectHandler):
    """Redirects are refused: they would carry the key to a server that nobody named."""

    def redirect_request(self, *given: Any) -> None:
        """No request."""


class Client:
    """Asks one server for one mesh; all its requests together have `settings.seconds`."""

    def __init__(
        self,
        settings: ServerSettings,
        *,
        sleep: Callable[[float], None] = time.sleep,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """The time begins to run now."""
        self.settings = settings
        self._sleep, self._clock = sleep, clock
        self._end = clock() + settings.seconds
        self._opener = urllib.request.build_opener(_Nowhere())

    def json(
        self, path: str, *, data: Any = None, form: Any = None, limit: int = MAX_JSON, retries: int | None = None
    ) -> Any:
        """The JSON data at `path`; posts `data` as JSON, or `form` (body and content type), where given.

        Raises:
            RefusedError: the server says no.
            AssetError: it cannot be reached, answers something else, or takes too long.
        """
        body, kind = form or ((json.dumps(data).encode(), "application/json") if data is not None else (None, ""))
        answer = self._asked(path, body=body, kind=kind, limit=limit, retries=retries)
        try:
            return json.loads(answer)
        except (ValueError, RecursionError):
            self.fail(f"{path} is not JSON")

    def bytes(self, path: str, *, data: Any = None) -> bytes:
        """What is at `path`, a mesh; posts `data` as JSON where given, and then waits as long as a mesh takes.

        Raises:
            AssetError: as for `json`, or it is larger than a mesh may be.
        """
        body = None if data is None else json.dumps(data).encode()
        kind = "" if data is None else "application/json"
        return self._asked(path, body=body, kind=kind, limit=self.settings.max_bytes, makes=data is not None)

    def delete(self, path: str) -> None:
        """Tell the server that nobody waits for `path` any more; what it says to that makes no difference."""
        try:
            self._once(self._request(path, None, "", "DELETE"), MAX_JSON, 5.0)
        except (_BusyError, AssetError):
            return

    def wait(self) -> None:
        """Wait before asking again whether the mesh is ready.

        Raises:
            AssetError: the time is over.
        """
        self._pause(self.settings.poll_seconds)

    def fail(self, why: str) -> NoReturn:
        """Raises: AssetError: `why`, in a line, without the key."""
        raise AssetError(self._told(why))

    def _told(self, why: str) -> str:
        return f"mesh server {self.settings.server}: {_line(self.settings.hidden(why))}"

    def _left(self) -> float:
        left = self._end - self._clock()
        if left <= 0.0:
            self.fail(f"no mesh in {self.settings.seconds:g} s; PAT3D_MESH_TIMEOUT allows more")
        return left

    def _pause(self, seconds: float) -> None:
        if seconds > self._left():
            self.fail(f"no mesh in {self.settings.seconds:g} s; PAT3D_MESH_TIMEOUT allows more")
        self._sleep(seconds)

    def _request(self, path: str, body: bytes | None, kind: str, method: str) -> urllib.request.Request:
        headers = {"Accept": "*/*", "User-Agent": "pat3d"}
        if kind:
            headers["Content-Type"] = kind
        if self.settings.key:
            headers["Authorization"] = f"Bearer {self.settings.key}"
        return urllib.request.Request(self.settings.url + path, data=body, headers=headers, method=method)

    def _asked(
        self, path: str, *, body: bytes | None, kind: str, limit: int, makes: bool = False, retries: int | None = None
    ) -> bytes:
        request = self._request(path, body, kind, "GET" if body is None else "POST")
        wait, left = FIRST_WAIT, self.settings.retries if retries is None else retries
        while True:
            silence = self._left() if makes else min(self._left(), self.settings.answer_seconds)
            try:
                return self._once(request, limit, silence)
            except _BusyError as error:
                if not left or (error.after or 0.0) > LONGEST_WAIT:
                    raise RefusedError(self._told(str(error)), error.status) from None
                pause = wait if error.after is None else error.after
            self._pause(pause)
            wait, left = min(2.0 * wait, LONGEST_WAIT), left - 1

    def _once(self, request: urllib.request.Request, limit: int, silence: float) -> bytes:
        """The body of one answer.

        Raises:
            _BusyError: asking again may help.
            AssetError: it would not.
        """
        try:
            with self._opener.open(request, timeout=silence) as answer:
                return self._read(answer, limit)
        except urllib.error.HTTPError as error:
            with error:
                try:
                    said = error.read(4 * MAX_SHOWN).decode("utf-8", "replace")
                except (OSError, http.client.HTTPException):
                    said = ""
            why = f"status {error.code}: {_words(said)}"
            if error.code in _BUSY:
                raise _BusyError(why, _retry_after(error.headers.get("Retry-After")), error.code) from None
            raise RefusedError(self._told(why), error.code) from None
        except TimeoutError:
            raise _BusyError(f"no answer in {silence:.3g} s") from None
        except urllib.error.URLError as error:
            if isinstance(error.reason, TimeoutError):
                raise _BusyError(f"no answer in {silence:.3g} s") from None
            raise _BusyError(f"no connection: {error.reason}") from None
        except (http.client.HTTPException, OSError) as error:
            raise _BusyError(f"the connection broke: {type(error).__name__} {error}") from None
        except ValueError as error:
            self.fail(f"no valid HTTP: {error}")

    def _read(self, answer: Any, limit: int) -> bytes:
        length = answer.headers.get("Content-Length")
        if length is not None and length.isdecimal() and int(length) > limit:
            self.fail(f"an answer of {int(length) / 1e6:.0f} MB; at most {limit / 1e6:.0f} MB are read")
        pieces, total = [], 0
        # read1 returns with what is there, so that a server that trickles meets the end of the time.
        while piece := answer.read1(_PIECE):
            total += len(piece)
            if total > limit:
                self.fail(f"an answer of more than {limit / 1e6:.0f} MB, which is as much as is read")
            pieces.append(piece)
            self._left()
        if length is not None and length.isdecimal() and total < int(length):
            raise _BusyError(f"the answer breaks off after {total} of {length} bytes")
        return b"".join(pieces)


def _words(said: str) -> str:
    """What an error's body says, whichever of the usual shapes it has."""
    try:
        data = json.loads(said)
    except (ValueError, RecursionError):
        return said
    found = data.get("detail") or data.get("error") or data.get("message") or data.get("text") if isinstance(
        data, dict
    ) else None  # fmt: skip
    found = found.get("message", found) if isinstance(found, dict) else found
    return found if isinstance(found, str) else said


def _line(text: str) -> str:
    """One printable line of a server's words."""
    line = " ".join("".join(letter if letter.isprintable() else " " for letter in text).split())
    return line if len(line) <= MAX_SHOWN else f"{line[:MAX_SHOWN]}..."


def _retry_after(said: str | None) -> float | None:
    """How long a server asks to wait [s]; None where it does not say, or says a date."""
    try:
        return max(0.0, float(said or ""))
    except ValueError:
        return None
