"""Policies behind a websocket, as openpi serves them; and a server for a policy of one's own.

After the connection is made the server sends its metadata. Then every message is an observation, and every answer a map
with "actions", shape (horizon, action size). A text instead of bytes is the server's own error.
"""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError
from pat3d.policies_eval.policies import wire
from pat3d.policies_eval.policies.policy import EpisodeStart, Policy, PolicyError

CONNECT_SECONDS = 20.0
"""For a server that is not there yet, or is there again soon [s]."""

RETRY_SECONDS = 0.5
ANSWER_SECONDS = 30.0
OPEN_SECONDS = 10.0


class ServerPolicy:
    """A policy on a server; connects when it is made, and again for the next episode when the connection is lost.

    Args:
        address: "ws://127.0.0.1:8000".
        connect_seconds: to wait for the server [s].
        answer_seconds: to wait for an answer [s].
    """

    def __init__(
        self, address: str, connect_seconds: float = CONNECT_SECONDS, answer_seconds: float = ANSWER_SECONDS
    ) -> None:
        self._address, self._connect_seconds, self._answer_seconds = address, connect_seconds, answer_seconds
        self._socket: Any = None
        self._open = contextlib.ExitStack()
        self._prompt = ""
        self.metadata: dict[Any, Any] = {}
        try:
            self._connect()
        except PolicyError as fault:
            raise EvaluationError(f"{address}: {fault.reason}") from fault

    def reset(self, episode: EpisodeStart) -> None:
        """The protocol has no reset; the instruction goes with every observation."""
        self._prompt = episode.instruction
        if self._socket is None:
            self._connect()

    def act(self, observation: Mapping[str, Any]) -> NDArray[Any]:
        """The server's actions for an observation."""
        if self._socket is None:
            self._connect()
        socket: Any = self._socket
        try:
            socket.send(wire.pack(message_of(observation, self._prompt)))
            answer = self._receive(self._answer_seconds)
        except BaseException:
            # An answer that comes late would be taken for the next one.
            self._drop()
            raise
        if not isinstance(answer, dict) or "actions" not in answer:
            raise PolicyError("bad answer", 'an answer is a map with "actions"')
        return answer["actions"]

    def close(self) -> None:
        """End the connection."""
        self._drop()

    def _connect(self) -> None:
        """Connect and read the metadata.

        Raises:
            PolicyError: no server within the time, or one that speaks another protocol.
        """
        websockets = _websockets()
        from websockets.sync import client

        last, until = "no answer", time.monotonic() + self._connect_seconds
        while True:
            try:
                # Observations are pictures already; compressing them again costs more than it saves.
                connection = client.connect(
                    self._address,
                    compression=None,
                    max_size=wire.MAX_BYTES,
                    proxy=None,
                    open_timeout=OPEN_SECONDS,
                    close_timeout=1.0,
                    ping_interval=None,
                )
                self._socket = self._open.enter_context(connection)
                break
            except (OSError, TimeoutError, websockets.exceptions.InvalidHandshake) as error:
                last = f"{type(error).__name__}: {error}"
            except websockets.exceptions.WebSocketException as error:
                raise PolicyError("no connection", f"{type(error).__name__}: {error}") from error
            if time.monotonic() + RETRY_SECONDS > until:
                raise PolicyError("no connection", f"no policy server within {self._connect_seconds:g} s ({last})")
            time.sleep(RETRY_SECONDS)
        try:
            metadata = self._receive(OPEN_SECONDS)
            if not isinstance(metadata, dict):
                raise PolicyError("bad answer", "the server's metadata is no map")
        except BaseException:
            self._drop()
            raise
        self.metadata = metadata

    def _receive(self, seconds: float) -> Any:
        websockets = _websockets()
        try:
            data = self._socket.recv(timeout=seconds)
        except TimeoutError:
            raise PolicyError("hang", f"no answer from the server within {seconds:g} s") from None
        except websockets.exceptions.ConnectionClosed as error:
            sent = error.sent
            if sent is not None and sent.code == 1009:
                raise PolicyError("too large", f"an answer of more than {wire.MAX_BYTES} bytes") from None
            raise PolicyError("disconnected", f"the server closed the connection ({error})") from None
        if isinstance(data, str):
            raise PolicyError("server error", data.strip().rsplit("\n", 1)[-1][:300])
        try:
            return wire.unpack(data)
        except wire.WireError as error:
            raise PolicyError("junk", str(error)) from None

    def _drop(self) -> None:
        self._socket = None
        with contextlib.suppress(Exception):
            self._open.close()


def message_of(observation: Mapping[str, Any], prompt: str) -> dict[str, Any]:
    """An observation as openpi's policies take it.

    "observation/state" is position [m] and axis-angle [rad] of the hand and the finger joints; pictures are
    "observation/image" (the first camera) and "observation/wrist_image". Everything else keeps its name behind
    "observation/".
    """
    message: dict[str, Any] = {"prompt": prompt}
    first = next((name for name in observation if name.endswith("_image") and not name.startswith("wrist")), None)
    for name, value in observation.items():
        short = "image" if name == first else name
        message[f"observation/{short}"] = np.ascontiguousarray(value)
    if {"eef_pos", "eef_quat", "gripper_pos"} <= observation.keys():
        message["observation/state"] = np.concatenate(
            [observation["eef_pos"], _axis_angle(observation["eef_quat"]), observation["gripper_pos"][:2]]
        ).astype(np.float32)
    return message


@contextlib.contextmanager
def serve(
    policy: Policy, host: str = "127.0.0.1", port: int = 0, metadata: dict[str, Any] | None = None
) -> Iterator[str]:
    """Serve a policy of one's own in a thread; gives the address.

    The policy is reset at every new connection only, as the protocol knows no episodes; its episode says so.

    Args:
        policy: gets "observation/NAME" as NAME; pictures as "image" and "wrist_image".
        host: to listen on.
        port: to listen on; 0 for any that is free.
        metadata: sent first.
    """
    websockets = _websockets()
    from websockets.sync import server

    def answer(socket: Any) -> None:
        socket.send(wire.pack(metadata or {}))
        started = False
        while True:
            try:
                message = wire.unpack(socket.recv())
                observation = {name.removeprefix("observation/"): value for name, value in message.items()}
                if not started:
                    policy.reset(_start(str(message.get("prompt", ""))))
                    started = True
                actions = np.atleast_2d(np.asarray(policy.act(observation)))
                socket.send(wire.pack({"actions": actions}))
            except websockets.exceptions.ConnectionClosed:
                return
            except Exception as error:
                socket.send(f"{type(error).__name__}: {error}")
                socket.close(1011, "the policy failed")
                return

    with server.serve(answer, host, port, compression=None, max_size=wire.MAX_BYTES) as running:
        thread = threading.Thread(target=running.serve_forever, daemon=True, name="pat3d-policy-server")
        thread.start()
        try:
            yield f"ws://{host}:{running.socket.getsockname()[1]}"
        finally:
            running.shutdown()
            thread.join(5.0)


def _start(prompt: str) -> EpisodeStart:
    return EpisodeStart(
        instruction=prompt, task="", seed=0, robot="Panda", control="osc", action_size=7, control_freq=20.0
    )


def _axis_angle(quat_wxyz: NDArray[Any]) -> NDArray[np.float64]:
    """Rotation vector [rad] of a quaternion, shape (3,)."""
    axis, w = np.asarray(quat_wxyz[1:], dtype=np.float64), float(quat_wxyz[0])
    if w < 0.0:
        axis, w = -axis, -w
    length = float(np.linalg.norm(axis))
    return axis * (2.0 * np.arctan2(length, w) / length) if length > 1e-9 else 2.0 * axis


def _websockets() -> Any:
    try:
        import websockets
        import websockets.exceptions
    except ImportError as error:
        raise EvaluationError(wire.INSTALL_HINT) from error
    return websockets
