"""Checkpoints of LeRobot: what they see, what their answers become, and what is said where they cannot be used."""

from __future__ import annotations

import json
import sys
import types
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from pat3d.errors import EvaluationError  # noqa: E402
from pat3d.policies_eval.policies.lerobot import LeRobotPolicy  # noqa: E402
from pat3d.policies_eval.policies.policy import EpisodeStart  # noqa: E402
from pat3d.policies_eval.policies.registry import identity, make_policy  # noqa: E402
from pat3d.policies_eval.run.episodes import Episode  # noqa: E402
from pat3d.policies_eval.run.evaluate import evaluate  # noqa: E402
from pat3d.policies_eval.run.settings import RolloutSettings  # noqa: E402


class Pipeline:
    """Scales an action by 2, or notes what comes in, as a pipeline with normalisation would."""

    def __init__(self, work):
        self._work, self.resets = work, 0

    def __call__(self, value):
        return self._work(value)

    def reset(self):
        self.resets += 1


class Model:
    """Answers with the first seven values of the state."""

    made: ClassVar[list[Model]] = []

    def __init__(self, config):
        self.config, self.batches, self.resets, self.training = config, [], 0, True
        Model.made.append(self)

    @classmethod
    def from_pretrained(cls, folder, *, config):
        return cls(config)

    def eval(self):
        self.training = False

    def reset(self):
        self.resets += 1

    def select_action(self, batch):
        assert not torch.is_grad_enabled()
        self.batches.append(batch)
        return 0.25 * batch["observation.state"][:, :7]


@pytest.fixture
def lerobot(monkeypatch):
    """A stand-in for the parts of the package that are used."""

    class Config:
        @staticmethod
        def from_pretrained(folder):
            return types.SimpleNamespace(device=None, **json.loads((Path(folder) / "config.json").read_text()))

    def processors(*, policy_cfg, pretrained_path, preprocessor_overrides):
        assert preprocessor_overrides["device_processor"]["device"] == policy_cfg.device
        return Pipeline(lambda batch: batch), Pipeline(lambda action: 2.0 * action)

    def policy_class(kind):
        if kind != "act":
            raise ValueError(f"Policy type '{kind}' is not available.")
        return Model

    modules = {
        "lerobot": {},
        "lerobot.configs": {},
        "lerobot.configs.policies": {"PreTrainedConfig": Config},
        "lerobot.policies": {},
        "lerobot.policies.factory": {"get_policy_class": policy_class, "make_pre_post_processors": processors},
    }
    for name, content in modules.items():
        module = types.ModuleType(name)
        vars(module).update(content)
        monkeypatch.setitem(sys.modules, name, module)
    Model.made = []


def checkpoint(folder, kind="act", inputs=("observation.state",)):
    folder.mkdir()
    features = {name: {"type": "STATE", "shape": [7]} for name in inputs}
    (folder / "config.json").write_text(json.dumps({"type": kind, "input_features": features}))
    (folder / "model.safetensors").write_bytes(b"weights")
    return f"lerobot:{folder}"


def start(instruction="pick up the mug"):
    return EpisodeStart(
        instruction=instruction, task="pick:mug", seed=3, robot="Panda", control="osc", action_size=7, control_freq=20.0
    )


def seen(**more):
    return {
        "joint_pos": np.arange(7, dtype=np.float32) / 10,
        "gripper_pos": np.zeros(2, np.float32),
        "eef_pos": np.ones(3, np.float32),
        "eef_quat": np.zeros(4, np.float32),
        **more,
    }


def test_observations_come_under_the_names_of_our_datasets_and_actions_through_the_pipelines(lerobot, tmp_path):
    inputs = ("observation.state", "observation.images.wrist", "observation.environment_state")
    policy = make_policy(checkpoint(tmp_path / "a", inputs=inputs))
    policy.reset(start())
    image = np.zeros((8, 6, 3), np.uint8)
    image[2, 5, 1] = 255
    action = policy.act(seen(wrist_image=image, target=np.full(10, 2.0, np.float32)))
    assert np.allclose(action, 0.5 * np.arange(7) / 10)
    (model,) = Model.made
    (batch,) = model.batches
    assert not model.training
    assert model.resets == 1
    assert {name: tuple(batch[name].shape) for name in inputs} == {
        "observation.state": (1, 16),
        "observation.images.wrist": (1, 3, 8, 6),
        "observation.environment_state": (1, 10),
    }
    assert batch["observation.images.wrist"][0, 1, 2, 5] == 1.0
    assert batch["observation.images.wrist"].sum() == 1.0
    assert batch["task"] == ["pick up the mug"]


def test_a_checkpoint_is_evaluated_like_any_policy(lerobot, tmp_path):
    pytest.importorskip("robosuite")
    spec = checkpoint(tmp_path / "a")
    episode = Episode(index=0, scene="", task="pick:red mug", seed=0)
    done = evaluate(spec, [episode], tmp_path / "out", settings=RolloutSettings(max_steps=3), workers=0)
    assert [(one.steps, one.reason) for one in done.results] == [(3, "")]
    assert done.manifest["policy_details"] == identity(spec)
    assert len(identity(spec)["checkpoint_sha256"]) == 64


def test_what_the_checkpoint_wants_and_does_not_get_is_named(lerobot, tmp_path):
    policy = make_policy(checkpoint(tmp_path / "a", inputs=("observation.images.top",)))
    policy.reset(start())
    with pytest.raises(EvaluationError, match=r"sees observation\.images\.top.*observation\.images\.wrist.*--obs rgb"):
        policy.act(seen(wrist_image=np.zeros((8, 8, 3), np.uint8)))


def test_without_the_package_the_message_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "lerobot", None)
    with pytest.raises(EvaluationError, match="pip install lerobot"):
        make_policy(checkpoint(tmp_path / "a"))


@pytest.mark.parametrize("missing", ["config.json", "model.safetensors"])
def test_a_folder_without_a_checkpoint_says_what_is_missing_and_pickled_weights_are_not_read(tmp_path, missing):
    spec = checkpoint(tmp_path / "a")
    (tmp_path / "a" / missing).rename(tmp_path / "a" / "pytorch_model.bin")
    with pytest.raises(EvaluationError, match=missing):
        make_policy(spec)


@pytest.mark.parametrize("content", ["{", "[]", '{"type": 3}', "{}"])
def test_a_damaged_config_is_an_error(lerobot, tmp_path, content):
    spec = checkpoint(tmp_path / "a")
    (tmp_path / "a/config.json").write_text(content)
    with pytest.raises(EvaluationError, match="no type of policy"):
        LeRobotPolicy(spec)


def test_what_the_package_refuses_is_passed_on(lerobot, tmp_path):
    with pytest.raises(EvaluationError, match="cannot load it: ValueError: Policy type 'unknown'"):
        make_policy(checkpoint(tmp_path / "a", kind="unknown"))
