"""A server on the loopback that speaks chat completions: the tests script its answers, and see what it was asked."""

from __future__ import annotations

import json
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any


@dataclass(kw_only=True)
class Reply:
    """One answer of the server."""

    status: int = 200
    body: bytes = b"{}"
    headers: dict[str, str] = field(default_factory=dict)
    sent: int | None = None
    """Bytes of the body after which the connection breaks; None for all of them."""
    stalls: bool = False
    """Whether it says nothing until the client has gone."""


def said(content: Any, *, finish: str = "stop", refusal: str | None = None, tokens: tuple[int, int] = (100, 20)):
    """A completion; `content` is a text, or data that becomes JSON."""
    text = content if isinstance(content, str) else json.dumps(content)
    body = {
        "id": "chatcmpl-1",
        "object": "chat.completion",
        "created": 1,
        "model": "test",
        "choices": [
            {
                "index": 0,
                "finish_reason": finish,
                "message": {"role": "assistant", "content": None if refusal else text, "refusal": refusal},
            }
        ],
        "usage": {"prompt_tokens": tokens[0], "completion_tokens": tokens[1], "total_tokens": sum(tokens)},
    }
    return Reply(body=json.dumps(body).encode())


def fault(status: int, message: str = "no", **headers: str) -> Reply:
    """An error as servers tell it."""
    body = json.dumps({"error": {"message": message, "type": "error", "code": status}}).encode()
    return Reply(status=status, body=body, headers={name.replace("_", "-"): text for name, text in headers.items()})


@dataclass
class Server:
    url: str
    replies: list[Reply]
    """What is left to say."""
    requests: list[dict[str, Any]] = field(default_factory=list)
    """Bodies of what was asked, in order."""
    keys: list[str] = field(default_factory=list)


@contextmanager
def serving(*replies: Reply) -> Iterator[Server]:
    """A server that gives `replies` in order, and status 418 when there are none left."""
    ended = threading.Event()

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            length = int(self.headers["Content-Length"])
            made.requests.append({"path": self.path, **json.loads(self.rfile.read(length))})
            made.keys.append(self.headers["Authorization"])
            reply = made.replies.pop(0) if made.replies else fault(418, "nothing more to say")
            if reply.stalls:
                ended.wait(10.0)
                self.close_connection = True
                return
            self.send_response(reply.status)
            for name, text in ({"Content-Type": "application/json"} | reply.headers).items():
                self.send_header(name, text)
            self.send_header("Content-Length", str(len(reply.body)))
            self.end_headers()
            self.wfile.write(reply.body[: reply.sent])
            if reply.sent is not None:
                self.wfile.flush()
                self.connection.shutdown(socket.SHUT_RDWR)
                self.close_connection = True

        def log_message(self, *words: Any) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    made = Server(f"http://127.0.0.1:{server.server_address[1]}/v1", list(replies))
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02})
    thread.start()
    try:
        yield made
    finally:
        ended.set()
        server.shutdown()
        server.server_close()
        thread.join()
