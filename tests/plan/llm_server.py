"""A server on the loopback that speaks chat completions: the tests script its answers, and see what it was asked."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from tests.loopback import Reply, listening


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
    made = Server("", list(replies))

    def answer(method: str, path: str, headers: Any, body: bytes) -> Reply:
        made.requests.append({"path": path, **json.loads(body)})
        made.keys.append(headers["Authorization"])
        return made.replies.pop(0) if made.replies else fault(418, "nothing more to say")

    with listening(answer) as url:
        made.url = f"{url}/v1"
        yield made
