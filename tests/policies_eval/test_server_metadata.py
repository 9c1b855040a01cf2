"""Before the first observation a server says what it is; and where the hand is told as a rotation vector."""

from __future__ import annotations

import contextlib
import threading

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

pytest.importorskip("msgpack")
pytest.importorskip("websockets")

from websockets.sync.server import serve as raw_server

from pat3d.errors import EvaluationError
from pat3d.policies_eval.policies import wire
from pat3d.policies_eval.policies.server import ServerPolicy, message_of


@contextlib.contextmanager
def _server(handler):
    """The address of a server that does with each socket what `handler` does."""
    with raw_server(handler, "127.0.0.1", 0) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}"
        server.shutdown()
        thread.join(5)


@pytest.mark.parametrize(
    ("first", "said"),
    [
        (lambda socket: socket.send(wire.pack([1, 2])), "no map"),
        (lambda socket: socket.send("Traceback ...\nRuntimeError: no weights"), "no weights"),
        (lambda socket: socket.send(b"\xc1\xff junk"), "ws://"),
        (lambda socket: socket.close(), "closed the connection"),
    ],
)
def test_a_server_that_begins_with_anything_but_a_map_is_an_error_and_is_left(first, said):
    left = threading.Event()

    def handler(socket):
        first(socket)
        with contextlib.suppress(Exception):
            socket.recv()
        left.set()

    with _server(handler) as address:
        with pytest.raises(EvaluationError, match=said) as caught:
            ServerPolicy(address, connect_seconds=3600.0)
        assert str(caught.value).startswith(address)
        assert left.wait(3600.0)


@pytest.mark.parametrize(
    "quat",
    [
        *Rotation.random(20, rng=np.random.default_rng(3)).as_quat(scalar_first=True).tolist(),
        *(sign * np.roll([0.0, 1.0, 0.0, 0.0], k) for sign in (1, -1) for k in range(3)),
        (0.0, 0.6, 0.0, 0.8),
        (0.0, -0.6, 0.8, 0.0),
        (1.0, 0.0, 0.0, 0.0),
        (-1.0, 0.0, 0.0, 0.0),
        (1.0, 1e-10, 0.0, 0.0),
        (np.cos(1e-4), 0.0, np.sin(1e-4), 0.0),
    ],
    ids=lambda quat: " ".join(f"{value:.2g}" for value in quat),
)
def test_the_turn_of_the_hand_is_the_shortest_rotation_vector(quat):
    """As SciPy gives it; a half turn goes about the quaternion's own axis, as what is a little less than one does."""
    axis = np.array(quat[1:])
    for given in (np.array(quat), -np.array(quat)):
        observation = {"eef_pos": np.zeros(3), "eef_quat": given, "gripper_pos": np.array([0.01, -0.01, 5.0])}
        state = message_of(observation, "")["observation/state"]
        assert state.dtype == np.float32
        expected = Rotation.from_quat(given, scalar_first=True).as_rotvec() if quat[0] else np.pi * axis
        np.testing.assert_allclose(state[3:6], expected, atol=3e-7)
        np.testing.assert_allclose(state[6:], [0.01, -0.01], atol=1e-8)
        axis = -axis
