"""One real step of every part of PAT3D, in the order in which a scene goes through them.

A part that works says what it did; one that does not raises whatever is wrong with this installation.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from pat3d.cli.extras import requirements
from pat3d.errors import CheckError
from pat3d.scene.model import Scene
from pat3d.scene.versions import version_of


@dataclass(frozen=True, kw_only=True)
class Part:
    """Something that an installation can do."""

    name: str
    step: Callable[[Path], str]
    """Does it in an empty folder; returns what was done, in words."""
    packages: tuple[str, ...] = ()
    """It needs beside those that everybody has; without them it is absent, not at fault."""
    extra: str = ""
    """All of whose packages it needs."""
    gpu: bool = False

    @property
    def missing(self) -> tuple[str, ...]:
        """Packages that are not installed."""
        own = tuple(one.name for one in requirements() if self.extra and one.extra == self.extra)
        return tuple(name for name in (*self.packages, *own) if version_of(name) is None)


@cache
def block() -> Scene:
    """A block at rest on the ground, made, laid out and settled by the parts of `pat3d generate`."""
    from pat3d.generation.attempts import Attempts
    from pat3d.generation.checkpoints import Workspace
    from pat3d.generation.request import request_of
    from pat3d.generation.settings import Settings
    from pat3d.generation.settle_stage import settle_scene
    from pat3d.plan.grammar.planner import GrammarPlanner
    from pat3d.progress import Clock, silent
    from pat3d.sim.compilation import prepare

    attempts = Attempts(
        request_of(GrammarPlanner().plan("a block"), False),
        seed=Settings.seed,
        friction=Settings.friction,
        device=Settings.device,
        workspace=Workspace(Path("unused"), keep=False),
        clock=Clock(),
        progress=silent,
        scratch=Path("unused"),
    )
    scene = attempts.layout()
    settled = settle_scene(scene, device=prepare(Settings.device, silent))
    if not settled.at_rest:
        raise CheckError(f"a block did not come to rest: {settled.record['status']}.")
    return settled.of(scene)


def _settling(folder: Path) -> str:
    (fell,) = block().objects
    drop = fell.initial_pose.position[2] - fell.pose.position[2]
    return f"a block fell {1e3 * drop:.1f} mm and came to rest"


def _verification(folder: Path) -> str:
    from pat3d.check.verification import verify
    from pat3d.exporters.mjcf.writer import write_mjcf

    found = verify(block(), write_mjcf(block(), folder / "mjcf"))
    if found.failures:
        raise CheckError(found.failures[0])
    return f"the block is in equilibrium, and still in MuJoCo {found.mujoco.version}"


def _formats(names: tuple[str, ...]) -> Callable[[Path], str]:
    def step(folder: Path) -> str:
        from pat3d.exporters.compare import parity
        from pat3d.exporters.formats import export

        for name, path in export(block(), names, folder).items():
            report = parity(block(), path)
            if not report.passed:
                raise CheckError(f"{name}: {report.failures[0]}")
        return f"{', '.join(names)} written and read back the same"

    return step


def _pictures(folder: Path) -> str:
    from pat3d.view.preview import save_preview

    save_preview(block(), folder / "preview.png")
    return "the block was drawn on the CPU; no GL library is needed"


def _gradient(folder: Path) -> str:
    import torch

    from pat3d import sim

    model = sim.ModelBuilder.from_scene(block()).finalize()
    q0 = torch.from_numpy(model.q0.reshape(1, 1, 12).copy()).requires_grad_()
    sim.rollout(model, q0, until=1).q_end.sum().backward()
    if q0.grad is None or not bool(torch.isfinite(q0.grad).all()):
        raise CheckError("the gradient of a step is not finite.")
    return "a step was differentiated"


def _environment(folder: Path) -> str:
    from pat3d.envs.physics.loading import DEFAULT_TASK
    from pat3d.policies_eval.run.settings import RolloutSettings

    settings = RolloutSettings()
    env = settings.make_env("", DEFAULT_TASK)
    try:
        env.reset(seed=0)
        observation = env.step(np.zeros(env.action_space.shape, dtype=np.float32))[0]
        numbers = [np.asarray(value) for value in observation.values()]
        if not all(np.isfinite(value).all() for value in numbers):
            raise CheckError("an observation after one step is not finite.")
    finally:
        env.close()
    return f"{settings.robot} did a step in the shipped scene"


def _worlds(folder: Path) -> str:
    from pat3d.envs.vector import BatchedTabletopEnv

    env = BatchedTabletopEnv(2, device="cuda")
    try:
        env.reset(seed=0)
        env.step(np.zeros(env.action_space.shape or (), dtype=np.float32))
    finally:
        env.close()
    return "two worlds did a step on the GPU"


def _records(folder: Path) -> str:
    from pyarrow import parquet, table

    parquet.write_table(table({"index": [1]}), folder / "rows.parquet")
    if parquet.read_table(folder / "rows.parquet").to_pydict() != {"index": [1]}:
        raise CheckError("a row of Parquet came back changed.")
    return "a row was written and read back"


def _servers(folder: Path) -> str:
    from pat3d.policies_eval.policies.policy import EpisodeStart
    from pat3d.policies_eval.policies.registry import RandomPolicy
    from pat3d.policies_eval.policies.server import ServerPolicy, serve

    start = EpisodeStart(instruction="", task="", seed=0, robot="", control="osc", action_size=7, control_freq=20.0)
    with serve(RandomPolicy()) as address:
        policy = ServerPolicy(address)
        policy.reset(start)
        policy.act({"gripper_pos": np.zeros(2, dtype=np.float32)})
        policy.close()
    return "a policy answered over a websocket"


def _films(folder: Path) -> str:
    from pat3d.policies_eval.video import write_video

    write_video([np.zeros((32, 32, 3), dtype=np.uint8)] * 2, folder / "film.mp4", 10.0)
    return "two frames became a film"


def _signature(folder: Path) -> str:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

    key = Ed25519PrivateKey.generate()
    key.public_key().verify(key.sign(b"result"), b"result")
    return "a result signed and verified"


def _hdf5(folder: Path) -> str:
    import h5py

    with h5py.File(folder / "rows.hdf5", "w") as file:
        file.attrs["said"] = json.dumps({})
    return "a file for robomimic was written"


PARTS = (
    Part(name="settling", step=_settling),
    Part(name="verification", step=_verification),
    Part(name="formats", step=_formats(("mjcf", "urdf", "sdf"))),
    Part(name="pictures", step=_pictures),
    Part(name="USD", step=_formats(("usd",)), packages=("usd-core",)),
    Part(name="gradients", step=_gradient, packages=("torch",)),
    Part(name="environments", step=_environment, extra="robots"),
    Part(name="worlds", step=_worlds, packages=("mujoco-warp",), extra="robots", gpu=True),
    Part(name="records", step=_records, packages=("pyarrow",)),
    Part(name="servers", step=_servers, packages=("websockets", "msgpack")),
    Part(name="films", step=_films, packages=("imageio-ffmpeg",)),
    Part(name="HDF5", step=_hdf5, packages=("h5py",)),
    Part(name="signatures", step=_signature, packages=("cryptography",)),
)
