"""Policies behind a websocket, against real servers on this machine."""

from __future__ import annotations

import contextlib
import threading

import numpy as np
import pytest

pytest.importorskip("msgpack")
pytest.importorskip("websockets")

from websockets.sync.server import serve as raw_server

from pat3d.errors import EvaluationError
from pat3d.policies_eval.policies import wire
from pat3d.policies_eval.policies.policy import PolicyError
from pat3d.policies_eval.policies.registry import make_policy
from pat3d.policies_eval.policies.server import ServerPolicy, message_of, serve

OBSERVATION = {
    "eef_pos": np.arange(3, dtype=np.float32),
    "eef_quat": np.array([np.cos(0.3), np.sin(0.3), 0, 0], dtype=np.float32),
    "gripper_pos": np.array([0.02, -0.02], dtype=np.float32),
    "agentview_image": np.zeros((8, 8, 3), dtype=np.uint8),
    "wrist_image": np.ones((8, 8, 3), dtype=np.uint8),
}


@contextlib.contextmanager
def raw(handler):
    """A server that does with its socket whatever `handler` does."""
    with raw_server(handler, "127.0.0.1", 0, max_size=None) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}"
        HELD.set()
        server.shutdown()
        thread.join(5)


class Echo:
    def reset(self, episode):
        self.prompt = episode.instruction

    def act(self, observation):
        assert self.prompt == "do it"
        assert observation["image"].shape == (8, 8, 3)
        return np.tile(observation["state"][:7], (4, 1))


def start(text="do it"):
    from pat3d.policies_eval.policies.policy import EpisodeStart

    return EpisodeStart(
        instruction=text, task="pick:a", seed=0, robot="Panda", control="osc", action_size=7, control_freq=20.0
    )


def test_metadata_comes_first_and_an_observation_gives_a_chunk_of_actions():
    with serve(Echo(), metadata={"model": "echo"}) as address:
        policy = make_policy(address)
        assert policy.metadata == {"model": "echo"}
        policy.reset(start())
        actions = policy.act(OBSERVATION)
        assert actions.shape == (4, 7)
        assert np.allclose(actions[0], [0, 1, 2, 0.6, 0, 0, 0.02])
        policy.close()


def test_an_observation_has_the_names_that_openpi_uses():
    message = message_of(OBSERVATION, "do it")
    assert message["prompt"] == "do it"
    assert {"observation/image", "observation/wrist_image", "observation/state"} <= message.keys()
    assert message["observation/state"].shape == (8,)


HELD = threading.Event()
"""Never set while a test waits for an answer."""


@pytest.fixture(autouse=True)
def release():
    HELD.clear()
    yield
    HELD.set()


def answering(reply):
    def handler(socket):
        socket.send(wire.pack({}))
        for _ in socket:
            reply(socket)

    return handler


@pytest.mark.parametrize(
    ("reply", "kind"),
    [
        (lambda socket: socket.send(b"\xc1\xff junk"), "junk"),
        (lambda socket: socket.send(wire.pack([1, 2])), "bad answer"),
        (lambda socket: socket.send("Traceback ...\nValueError: no image"), "server error"),
        (lambda socket: socket.close(), "disconnected"),
        (lambda socket: socket.send(b"\0" * 100_000_000), "too large"),
        (lambda socket: HELD.wait(), "hang"),
    ],
)
def test_what_a_server_may_do_wrong_is_a_policy_error(reply, kind):
    with raw(answering(reply)) as address:
        policy = ServerPolicy(address, connect_seconds=3600.0, answer_seconds=0.2 if kind == "hang" else 3600.0)
        policy.reset(start())
        with pytest.raises(PolicyError) as caught:
            policy.act(OBSERVATION)
        assert caught.value.kind == kind


def test_after_a_lost_connection_the_next_episode_has_a_new_one():
    calls = []

    def handler(socket):
        socket.send(wire.pack({}))
        socket.recv()
        calls.append(1)
        if len(calls) == 1:
            socket.close()
        else:
            socket.send(wire.pack({"actions": np.zeros((1, 7))}))

    with raw(handler) as address:
        policy = ServerPolicy(address, connect_seconds=3600.0)
        policy.reset(start())
        with pytest.raises(PolicyError, match="disconnected"):
            policy.act(OBSERVATION)
        policy.reset(start())
        assert policy.act(OBSERVATION).shape == (1, 7)


def test_a_server_that_is_not_there_is_an_error_before_the_first_episode():
    with pytest.raises(EvaluationError, match="no policy server"):
        ServerPolicy("ws://127.0.0.1:9", connect_seconds=0.1)
