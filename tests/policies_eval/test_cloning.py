"""Cloned policies: what they see, what they learn, and checkpoints that are none."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

torch = pytest.importorskip("torch")

from pat3d.errors import EvaluationError  # noqa: E402
from pat3d.policies_eval.datasets.demonstrations import Demonstration, demonstrate  # noqa: E402
from pat3d.policies_eval.policies.cloning import ClonedPolicy, load, make_network, save  # noqa: E402
from pat3d.policies_eval.policies.cloning_features import FEATURES, features  # noqa: E402
from pat3d.policies_eval.run.episodes import Episode  # noqa: E402
from pat3d.policies_eval.run.settings import RolloutSettings  # noqa: E402
from pat3d.policies_eval.train import fit  # noqa: E402


def observation(random, turn=None, shift=(0.0, 0.0, 0.0)):
    hand, target = Rotation.random(rng=random), Rotation.random(rng=random)
    at, goal = random.uniform(-0.2, 0.2, (2, 3))
    place = random.uniform(-0.2, 0.2, 3)
    if turn is not None:
        hand, target = turn * hand, turn * target
        at, place, goal = (turn.apply(one) + shift for one in (at, place, goal))
    quat = [rotation.as_quat(scalar_first=True) for rotation in (hand, target)]
    return {
        "eef_pos": at.astype(np.float32),
        "eef_quat": quat[0].astype(np.float32),
        "gripper_pos": np.array([0.03, -0.03], dtype=np.float32),
        "target": np.concatenate([place, quat[1], goal]).astype(np.float32),
    }


def test_the_hand_in_the_frame_of_the_object_does_not_depend_on_where_the_two_are():
    turn, shift = Rotation.from_euler("z", 1.1), np.array([0.3, -0.2, 0.0])
    here = features(observation(np.random.default_rng(4)))
    there = features(observation(np.random.default_rng(4), turn, shift))
    assert here.shape == (FEATURES,)
    # Entries 3 to 9: the way to the object in its own frame and in the hand's.
    assert np.allclose(here[3:9], there[3:9], atol=1e-5)
    assert not np.allclose(here[:3], there[:3], atol=1e-2)


def test_a_network_learns_to_move_towards_the_object():
    random = np.random.default_rng(0)
    seen = [observation(random) for _ in range(400)]
    away = np.stack([one["target"][:3] - one["eef_pos"] for one in seen])
    actions = np.zeros((400, 7), dtype=np.float32)
    actions[:, :3], actions[:, 6] = np.tanh(3 * away), np.sign(away[:, 2])
    shown = Demonstration(
        episode=Episode(index=0, scene="", task="pick:a", seed=0),
        instruction="",
        observations={name: np.stack([one[name] for one in seen]) for name in seen[0]},
        actions=actions,
        done=actions,
    )
    _, error = fit([shown], epochs=60)
    assert error < 0.02 < float(actions.var())


def test_a_checkpoint_comes_back_with_its_weights(tmp_path):
    network = make_network(width=16, layers=1)
    save(network, tmp_path / "a.pt", {"epochs": 1})
    again = load(tmp_path / "a.pt")
    seen = torch.randn(3, FEATURES)
    assert torch.equal(network(seen), again(seen))
    assert ClonedPolicy(tmp_path / "a.pt").act(observation(np.random.default_rng(1))).shape == (7,)


class Evil:
    def __reduce__(self):
        return (print, ("executed",))


def test_nothing_in_a_checkpoint_is_executed(tmp_path, capsys):
    (tmp_path / "a.pt").write_bytes(pickle.dumps(Evil()))
    torch.save({"kind": "pat3d cloned policy", "weights": Evil()}, tmp_path / "b.pt")
    for name in ("a.pt", "b.pt"):
        with pytest.raises(EvaluationError, match="safely"):
            load(tmp_path / name)
    assert "executed" not in capsys.readouterr().out


@pytest.mark.parametrize("change", ["kind", "format", "width", "nan", "weights"])
def test_a_checkpoint_that_does_not_fit_is_an_error(tmp_path, change):
    network = make_network(width=16, layers=1)
    save(network, tmp_path / "a.pt", {})
    content = torch.load(tmp_path / "a.pt", weights_only=True)
    if change == "width":
        content["config"]["width"] = 10**9
    elif change == "nan":
        content["weights"]["mean"][0] = float("nan")
    elif change == "weights":
        del content["weights"]["mean"]
    else:
        content[change] = 99
    torch.save(content, tmp_path / "a.pt")
    with pytest.raises(EvaluationError):
        load(tmp_path / "a.pt")


def test_demonstrations_keep_the_answer_and_not_the_push(tmp_path):
    pytest.importorskip("robosuite")
    h5py = pytest.importorskip("h5py")
    from pat3d.policies_eval.datasets.robomimic import write_robomimic

    episode = Episode(index=0, scene="", task="pick:red mug", seed=3)
    shown = demonstrate([episode], noise=0.2, settings=RolloutSettings(max_steps=200))[0]
    steps = len(shown.actions)
    assert shown.observations["eef_pos"].shape == (steps, 3)
    assert not np.array_equal(shown.actions, shown.done)
    assert np.array_equal(shown.actions[:, 6], shown.done[:, 6])
    write_robomimic([shown], tmp_path / "a.hdf5")
    with h5py.File(tmp_path / "a.hdf5") as file:
        assert file["data"].attrs["total"] == steps
        assert file["data/demo_0/actions"].shape == (steps, 7)
        assert file["data/demo_0/obs/target"].shape == (steps, 10)
        assert file["data/demo_0/dones"][-1] == 1
        assert file["mask/train"][0] == b"demo_0"
