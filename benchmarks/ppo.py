"""How fast PPO learns a task from state, with the dense reward, in many worlds on a GPU or in a few on one core.

    python -m benchmarks.ppo [--minutes 10] [--scene FOLDER] [--task pick:NAME] [--out FOLDER]
    python -m benchmarks.ppo --try FOLDER/policy.npz [--episodes 50]
    python -m benchmarks.ppo --draw FOLDER/curve.jsonl > docs/ppo.svg

The learner is stable-baselines3's (Schulman et al. 2017). Every row of the curve says how many of the last episodes
succeeded, with the exploration's noise. At the end the mean actions are tried in single environments with MuJoCo, in
other starts; `--try` does that again. With `--device cpu` MuJoCo steps the worlds too, one after the other.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections import deque
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import torch
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from stable_baselines3 import PPO  # pyright: ignore[reportMissingImports]
from stable_baselines3.common.callbacks import BaseCallback  # pyright: ignore[reportMissingImports]
from stable_baselines3.common.vec_env import VecEnv, VecNormalize  # pyright: ignore[reportMissingImports]

import pat3d.envs  # noqa: F401  registers PAT3D-v0
from pat3d.envs.env import TabletopEnv
from pat3d.envs.vector import BatchedTabletopEnv
from pat3d.policies_eval.analysis.statistics import wilson

TARGET = 0.8
"""Share of episodes that succeed, within 30 minutes on one H200."""

ROW = 20_000
"""Steps between two rows of the curve."""

UNSEEN = 100_000
"""First seed of starts that no training draws."""

LAST = 200
"""Episodes at least, of which a row says how many succeeded; as many as there are worlds where those are more."""

STEPS = 100
"""Of an episode: five times as long as the hand needs to the object and up."""

DISCOUNT = 0.95
"""The learner's, a step: it looks ahead for some 20 of them, a second. The reward's is 1, see pat3d.envs.reward."""

SCALE = np.array([0.8, 0.8, 0.8, 0.15, 0.15, 0.15, 1.0], dtype=np.float32)
"""Of the learner's actions: hands that turn while they explore meet more than they take."""

Values = NDArray[np.float32]


def features(seen: dict[str, NDArray[Any]]) -> Values:
    """Of observations of several worlds: the robot, and where object and goal are from the hand."""
    target = seen["target"]
    return np.concatenate(
        [
            seen["joint_pos"],
            0.2 * seen["joint_vel"],
            20.0 * seen["gripper_pos"],
            seen["eef_quat"],
            5.0 * seen["eef_pos"],
            10.0 * (target[:, :3] - seen["eef_pos"]),
            target[:, 3:7],
            10.0 * (target[:, 7:10] - target[:, :3]),
        ],
        axis=1,
    ).astype(np.float32)


class Worlds(VecEnv):
    """`BatchedTabletopEnv`, or a vector of single environments, as stable-baselines3 takes environments."""

    def __init__(self, envs: gymnasium.vector.VectorEnv[Any, Any, Any]) -> None:
        self.envs = envs
        seen, _ = envs.reset(seed=0)
        size = features(seen).shape[1]
        super().__init__(
            envs.num_envs, gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float32), envs.single_action_space
        )
        self._nothing: list[dict[str, Any]] = [{} for _ in range(envs.num_envs)]
        self.succeeded: deque[bool] = deque(maxlen=max(LAST, envs.num_envs))
        """The last episodes that ended."""
        self.ended = 0
        """Episodes."""
        self.progress = 0.0
        """Mean of all worlds after the last step."""

    def reset(self) -> Values:
        """Of all worlds."""
        return features(self.envs.reset()[0])

    def step_async(self, actions: NDArray[Any]) -> None:
        """Take the actions of the next step."""
        self._actions = actions

    def step_wait(self) -> Any:
        """Do them."""
        seen, rewards, success, truncated, info = self.envs.step(SCALE * np.clip(self._actions, -1.0, 1.0))
        self.progress = float(np.mean(info["progress"]))
        told = list(self._nothing)
        for world in np.flatnonzero(success | truncated).tolist():
            last = {name: values[None] for name, values in info["final_obs"][world].items()}
            told[world] = {"terminal_observation": features(last)[0], "TimeLimit.truncated": bool(truncated[world])}
            self.succeeded.append(bool(success[world]))
            self.ended += 1
        return features(seen), rewards.astype(np.float32), success | truncated, told

    def close(self) -> None:
        """Free the worlds."""
        self.envs.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """The worlds' common one."""
        return [getattr(self.envs, attr_name, None)] * self.num_envs

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """There is none to set."""
        raise NotImplementedError("worlds of a batch have no attributes of their own")

    def env_method(self, method_name: str, *arguments: Any, indices: Any = None, **named: Any) -> list[Any]:
        """There is none to call."""
        raise NotImplementedError("worlds of a batch have no methods of their own")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """They are not."""
        return [False] * self.num_envs


class Curve(BaseCallback):
    """Writes rows, and says when the time is over or `good` of the episodes succeed."""

    def __init__(self, worlds: Worlds, normal: VecNormalize, out: Path, seconds: float, good: float) -> None:
        super().__init__()
        self._worlds, self._normal, self._out = worlds, normal, out
        self._seconds, self._good = seconds, good
        self._begin, self._next = time.perf_counter(), ROW
        self.over = False
        """Whether to stop."""

    def _on_step(self) -> bool:
        return True

    def _on_rollout_end(self) -> None:
        spent, last = time.perf_counter() - self._begin, self._worlds.succeeded
        success = float(np.mean(last)) if last else 0.0
        self.over = spent > self._seconds or (len(last) == last.maxlen and success >= self._good)
        if self.num_timesteps < self._next and not self.over:
            return
        self._next = self.num_timesteps + ROW
        row = {
            "seconds": round(spent, 1),
            "steps": self.num_timesteps,
            "episodes": self._worlds.ended,
            "success": round(success, 4),
            "progress": round(self._worlds.progress, 4),
            "deviation": round(float(self.model.policy.log_std.exp().mean().detach()), 3),  # type: ignore[operator]
        }
        with (self._out / "curve.jsonl").open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        print(json.dumps(row), flush=True)


def save(model: PPO, normal: VecNormalize, path: Path) -> None:
    """The policy's weights and what its observations are scaled with."""
    statistics = normal.obs_rms
    weights = {name: value.detach().cpu().numpy() for name, value in model.policy.state_dict().items()}
    np.savez(path, mean=statistics.mean, var=statistics.var, **weights)


class Actor:
    """The mean actions of a saved policy: two hidden layers on scaled features."""

    def __init__(self, path: Path) -> None:
        with np.load(path, allow_pickle=False) as stored:
            found = {name: stored[name].astype(np.float64) for name in stored.files}
        self._mean, self._deviation = found["mean"], np.sqrt(found["var"] + 1e-8)
        names = ("mlp_extractor.policy_net.0", "mlp_extractor.policy_net.2", "action_net.0")
        self._layers = [(found[f"{name}.weight"], found[f"{name}.bias"]) for name in names]

    def act(self, seen: dict[str, NDArray[Any]]) -> Values:
        """For observations of several worlds."""
        values = np.clip((features(seen) - self._mean) / self._deviation, -10.0, 10.0)
        for number, (weight, bias) in enumerate(self._layers):
            values = values @ weight.T + bias
            if number + 1 < len(self._layers):
                values = np.where(values > 0, values, np.expm1(np.minimum(values, 0.0)))
        return SCALE * (values / (1.0 + np.abs(values))).astype(np.float32)


def learn(options: argparse.Namespace) -> None:
    """Train, and judge the mean actions in all worlds."""
    out = Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    about: dict[str, Any] = {
        "scene": options.scene, "task": options.task, "robot": options.robot, "reward": "dense", "discount": 1.0,
        "max_episode_steps": STEPS,
    }  # fmt: skip
    large = options.device.startswith("cuda")
    options.worlds = options.worlds or (4096 if large else 16)
    if large:
        envs = BatchedTabletopEnv(options.worlds, options.device, autoreset_mode=AutoresetMode.SAME_STEP, **about)
    else:
        torch.set_num_threads(1)
        envs = gymnasium.make_vec(
            "PAT3D-v0", options.worlds, "sync", {"autoreset_mode": AutoresetMode.SAME_STEP}, **about
        )
    rollout = options.rollout or (16 if large else 128)
    worlds = Worlds(envs)
    normal = VecNormalize(worlds, norm_obs=True, norm_reward=True, gamma=options.discount)
    model = PPO(
        "MlpPolicy",
        normal,
        learning_rate=options.rate or (1e-3 if large else 3e-4),
        n_steps=rollout,
        batch_size=min(options.worlds * rollout // 16, 8192),
        n_epochs=5 if large else 10,
        gamma=options.discount,
        gae_lambda=0.95,
        ent_coef=options.entropy,
        policy_kwargs={
            "net_arch": {"pi": [256, 128], "vf": [256, 128]},
            "activation_fn": torch.nn.ELU,
            "log_std_init": -0.7,
        },
        seed=0,
        device="cuda" if large else "cpu",
    )
    # Means stay within the bounds of actions: beyond them noise changes nothing, and nothing is learned.
    model.policy.action_net = torch.nn.Sequential(model.policy.action_net, torch.nn.Softsign())
    print(f"{options.task}, {options.worlds} worlds, {options.device}", flush=True)
    curve = Curve(worlds, normal, out, 60.0 * options.minutes, options.good)
    batch = options.worlds * rollout
    model.learn(batch, callback=curve)
    while not curve.over:
        model.learn(batch, callback=curve, reset_num_timesteps=False)
        save(model, normal, out / "policy.npz")
    save(model, normal, out / "policy.npz")
    envs.close()
    attempt(out / "policy.npz", options)


def attempt(path: Path, options: argparse.Namespace) -> None:
    """The mean actions of a saved policy in single environments."""
    actor = Actor(path)
    env = TabletopEnv(options.scene, task=options.task, robot=options.robot)
    succeeded = 0
    for seed in range(options.episodes):
        seen, _ = env.reset(seed=UNSEEN + seed)
        for _ in range(STEPS):
            action = actor.act({name: values[None] for name, values in seen.items()})[0]
            seen, _, success, broken, _ = env.step(action)
            if success or broken:
                succeeded += success
                break
    told(succeeded, options.episodes, f"mean actions, within {STEPS} steps, one environment with MuJoCo")


def drawn(path: Path) -> str:
    """The curve as a picture in SVG: how many of the last episodes succeeded, over the minutes of training."""
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    points = [(row["seconds"] / 60.0, row["success"]) for row in rows if row["episodes"] >= LAST]
    minutes = max(5.0, math.ceil(rows[-1]["seconds"] / 300.0) * 5.0)

    def at(minute: float, share: float) -> str:
        return f"{50 + 520 * minute / minutes:.1f},{210 - 180 * share:.1f}"

    lines = []
    for share in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0):
        (left, y), right = at(0, share).split(","), at(minutes, share).split(",")[0]
        colour = "#c33" if share == TARGET else "#ddd"
        lines.append(f'<path d="M{left},{y}H{right}" stroke="{colour}"/>')
        lines.append(f'<text x="44" y="{float(y) + 4:.0f}" text-anchor="end">{100 * share:.0f} %</text>')
    for minute in np.arange(0.0, minutes + 1.0, 5.0 if minutes > 5.0 else 1.0):
        lines.append(f'<text x="{at(minute, 0).split(",")[0]}" y="228" text-anchor="middle">{minute:.0f} min</text>')
    curve = " ".join(at(*point) for point in points)
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 600 240" font-family="sans-serif" font-size="12">'
        '<rect width="600" height="240" fill="white"/>'
        + "".join(lines)
        + f'<polyline points="{curve}" fill="none" stroke="#246" stroke-width="2"/></svg>'
    )


def told(succeeded: int, episodes: int, what: str) -> None:
    """Print a rate with its interval."""
    print(f"{what}: {wilson(succeeded, episodes)} (target {100 * TARGET:.0f} %)", flush=True)


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--worlds", type=int, help="4096 on a GPU and 16 on the CPU")
    parser.add_argument("--device", default="cuda", help="cuda, or cpu: single environments, one after the other")
    parser.add_argument("--scene", help="a folder; the shipped scene without")
    parser.add_argument("--task", default="pick:red mug")
    parser.add_argument("--robot", default="panda", help="the same wherever the policy runs")
    parser.add_argument("--discount", type=float, default=DISCOUNT)
    parser.add_argument("--rate", type=float, help="the learner's: 1e-3 on a GPU and 3e-4 on the CPU")
    parser.add_argument("--rollout", type=int, help="steps of every world between two updates: 16 and 128")
    parser.add_argument("--entropy", type=float, default=0.0, help="its weight in the learner's aim")
    parser.add_argument("--good", type=float, default=0.97, help="stop at this share of successes")
    parser.add_argument("--out", default="ppo")
    parser.add_argument("--try", dest="policy", type=Path, help="a saved policy to run on the CPU")
    parser.add_argument("--episodes", type=int, default=50)
    parser.add_argument("--draw", type=Path, metavar="CURVE", help="of a training, as a picture in SVG")
    options = parser.parse_args()
    if options.draw:
        print(drawn(options.draw))
        return
    if options.policy:
        attempt(options.policy, options)
    else:
        learn(options)


if __name__ == "__main__":
    main()
