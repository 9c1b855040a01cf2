"""Requests to servers that are busy, fail, or cannot be reached for a while: asked again, after growing waits."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from pat3d.errors import ModelError

Found = TypeVar("Found")

FIRST_WAIT, LONGEST_WAIT = 1.0, 60.0
"""Between requests [s]; every wait is twice the one before unless the server says how long."""


def patiently(
    ask: Callable[[], Found],
    *,
    retries: int,
    timeout: float,
    sleep: Callable[[float], None],
    failed: Callable[[str], ModelError],
    adapted: Callable[[Any], bool],
) -> Found:
    """What `ask` gives; asked again after a wait where the server is busy or cannot be reached.

    Args:
        ask: makes one request through the client `openai`.
        retries: requests more.
        timeout: of one request, for messages [s].
        sleep: waits.
        failed: the error that says why in the end.
        adapted: whether the next request will be another one, after a refusal of this one.

    Raises:
        ModelError: it fails for good.
    """
    import openai

    wait, left = FIRST_WAIT, retries
    while True:
        try:
            return ask()
        except openai.APIStatusError as error:
            if error.status_code in (400, 404, 422) and adapted(error):
                continue
            busy = error.status_code in (408, 409, 429) or error.status_code >= 500
            asked = _retry_after(error.response.headers)
            if not busy or not left or (asked or 0.0) > LONGEST_WAIT:
                raise failed(f"status {error.status_code}: {error.message}") from None
            pause = wait if asked is None else asked
        except openai.APITimeoutError:
            if not left:
                raise failed(f"no answer in {timeout:g} s") from None
            pause = wait
        except openai.APIConnectionError as error:
            if not left:
                raise failed(f"no connection: {error.__cause__ or error}") from None
            pause = wait
        except (openai.OpenAIError, ValueError) as error:
            raise failed(f"{type(error).__name__}: {error}") from None
        sleep(pause)
        wait, left = min(2.0 * wait, LONGEST_WAIT), left - 1


def _retry_after(headers: Mapping[str, str]) -> float | None:
    """How long a server asks to wait [s]; None where it does not say, or says a date."""
    try:
        return max(0.0, float(headers["retry-after"]))
    except (KeyError, ValueError):
        return None
