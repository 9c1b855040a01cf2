"""Who may use a studio: its own page, and from another machine whoever opened its address with the token.

viser lets every page in the browser and everybody who reaches its port change the scene. So it listens at a port of
this machine that nobody is told, and the gate at the one that people open. The gate reads the first request of every
connection and hands bytes on both ways if it comes from the studio's own page and, where other machines reach the gate,
shows the token, which a cookie keeps.
"""

from __future__ import annotations

import asyncio
import hmac
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlsplit

from pat3d.errors import EnvironmentSetupError

COOKIE = "pat3d_studio"
MAX_HEAD = 16 * 1024
"""Longest head of a request [bytes]."""
PATIENCE = 10.0
"""[s] for the head of a request to arrive."""
Page = Callable[[], bytes]
"""What makes a page, as HTML compressed by gzip."""
_LOOPBACK = ("127.0.0.1", "localhost", "::1")


def is_loopback(host: str) -> bool:
    """Whether only programs on this machine reach `host`."""
    return host in _LOOPBACK


class Gate:
    """Listens until `close`."""

    def __init__(self, host: str, port: int, *, inner: int, token: str | None, page: Page | None = None) -> None:
        """Let those with `token` from `host`:`port` through to the port `inner` of this machine.

        Where `token` is None, `host` is this machine's own, and everybody on it passes. Browsers that ask for "/"
        get `page` instead of that of `inner`, where there is one.

        Raises:
            EnvironmentSetupError: nothing can listen there.
        """
        self.inner, self._token, self._page = inner, token, page
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True, name="pat3d studio gate")
        self._thread.start()
        # In its own thread from the beginning: a notebook's thread has a loop that runs already.
        starting = asyncio.start_server(self._serve, host, port, limit=MAX_HEAD)
        try:
            self._server = asyncio.run_coroutine_threadsafe(starting, self._loop).result()
        except OSError as error:
            self._end_loop()
            raise EnvironmentSetupError(
                f"{host}:{port} cannot be used ({error.strerror or error}). Give another: --port 0."
            ) from error
        self.port = int(self._server.sockets[0].getsockname()[1])

    def close(self) -> None:
        """Let nobody through any more."""

        async def end() -> None:
            self._server.close()
            waiting = [task for task in asyncio.all_tasks() if task is not asyncio.current_task()]
            for task in waiting:
                task.cancel()
            await asyncio.gather(*waiting, return_exceptions=True)

        asyncio.run_coroutine_threadsafe(end(), self._loop).result()
        self._end_loop()

    def _end_loop(self) -> None:
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            head = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), PATIENCE)
            answer = self._answer(head)
            if answer:
                writer.write(answer)
                await writer.drain()
                return
            away, back = await asyncio.open_connection("127.0.0.1", self.inner)
            try:
                back.write(head)
                one, other = asyncio.create_task(_pump(reader, back)), asyncio.create_task(_pump(away, writer))
                await asyncio.wait((one, other), return_when=asyncio.FIRST_COMPLETED)
                one.cancel()
                other.cancel()
            finally:
                back.close()
        except (OSError, TimeoutError, asyncio.IncompleteReadError, asyncio.LimitOverrunError):
            pass
        finally:
            writer.close()
            with suppress(OSError):
                await writer.wait_closed()

    def _answer(self, head: bytes) -> bytes:
        """What to answer a request instead of letting it through; empty to let it through."""
        line, _, rest = head.decode("latin-1").partition("\r\n")
        words = line.split(" ")
        if len(words) != 3:
            return _response("400 Bad Request", "not a request")
        headers = dict(_header(one) for one in rest.split("\r\n") if ":" in one)
        origin = headers.get("origin")
        # A page of somebody else that is open in the same browser must not use its cookie.
        if origin is not None and urlsplit(origin).netloc != headers.get("host"):
            return _response("403 Forbidden", "another page may not use this studio")
        if self._token is None:
            # A name that somebody else's server gave out for this machine is not the studio's page either.
            named = urlsplit(f"//{headers.get('host', '')}").hostname
            return (
                self._passed(words, headers)
                if named in _LOOPBACK
                else _response("403 Forbidden", "open the address that the studio printed")
            )
        if self._is_token(_cookie(headers.get("cookie", ""))):
            return self._passed(words, headers)
        if self._is_token(parse_qs(urlsplit(words[1]).query).get("token", [""])[0]):
            cookie = f"Set-Cookie: {COOKIE}={self._token}; HttpOnly; SameSite=Strict; Path=/\r\n"
            return _response("303 See Other", "", f"Location: /\r\n{cookie}")
        return _response("401 Unauthorized", "open the address that the studio printed, with its token")

    def _passed(self, words: list[str], headers: Mapping[str, str]) -> bytes:
        """What to answer those who pass: the page, or nothing where they are let through."""
        asked = words[0] == "GET" and urlsplit(words[1]).path == "/" and "upgrade" not in headers
        if self._page is None or not asked or "gzip" not in headers.get("accept-encoding", ""):
            return b""
        return _response("200 OK", self._page(), "Content-Encoding: gzip\r\n", kind="text/html")

    def _is_token(self, said: str) -> bool:
        return hmac.compare_digest(said.encode(), (self._token or "").encode()) and bool(said)


def _header(line: str) -> tuple[str, str]:
    name, _, value = line.partition(":")
    return name.strip().lower(), value.strip()


def _cookie(header: str) -> str:
    try:
        found = SimpleCookie(header).get(COOKIE)
    except CookieError:
        return ""
    return found.value if found is not None else ""


def _response(status: str, text: str | bytes, more: str = "", *, kind: str = "text/plain") -> bytes:
    body = text.encode() if isinstance(text, str) else text
    return (
        f"HTTP/1.1 {status}\r\nContent-Type: {kind}; charset=utf-8\r\nContent-Length: {len(body)}\r\n"
        f"{more}Connection: close\r\n\r\n"
    ).encode() + body


async def _pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    with suppress(OSError):
        while data := await reader.read(65536):
            writer.write(data)
            await writer.drain()
