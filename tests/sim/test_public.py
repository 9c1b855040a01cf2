"""The simulator as others import it."""

import subprocess
import sys
from importlib import import_module
from types import FunctionType

import pytest
import torch

from pat3d import sim
from tests.scenes import tower


def run(code: str) -> str:
    """What a fresh interpreter prints."""
    return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split("\n")[
        -2
    ]


def test_four_lines_from_bodies_to_gradients():
    """Moving everything along x moves the top of the tower as far, wherever contact and friction lead it."""
    scene = tower(2, gap=5e-4)

    def semantic_loss(q: torch.Tensor) -> torch.Tensor:
        return q[:, 1, 0].sum()

    model = sim.ModelBuilder.from_scene(scene).finalize(device="cpu", worlds=3)
    q0 = torch.tensor(model.q0).reshape(3, 2, 12).requires_grad_()
    rollout = sim.rollout(model, q0, until="rest")
    loss = semantic_loss(rollout.q_end)
    loss.backward()

    assert rollout.at_rest.all()
    assert q0.grad is not None
    torch.testing.assert_close(q0.grad[..., 0].sum(dim=1), torch.ones(3, dtype=torch.float64), rtol=1e-6, atol=0.0)


def test_importing_the_simulator_loads_neither_torch_nor_warp():
    assert run("import sys; from pat3d import sim; print({'torch', 'warp'} & set(sys.modules))") == "set()"


def test_building_a_model_needs_no_torch():
    assert (
        run("import sys; from pat3d import sim; sim.ModelBuilder, sim.settle; print('torch' in sys.modules)") == "False"
    )


def test_names_are_functions_although_modules_were_imported():
    for module in ("settling", "rollouts", "model"):
        import_module(f"pat3d.sim.{module}")
    assert isinstance(sim.settle, FunctionType)
    assert isinstance(sim.rollout, FunctionType)


def test_every_public_name_is_there_and_no_other():
    assert set(sim.__all__) <= set(dir(sim))
    assert all(getattr(sim, name).__name__ == name for name in sim.__all__)
    with pytest.raises(AttributeError, match="It has: Model"):
        _ = sim.step


def test_settling_says_nothing_of_its_own():
    code = """
from pat3d import sim
from tests.scenes import tower
print(sim.settle(sim.ModelBuilder.from_scene(tower(1, gap=5e-4)).finalize()).at_rest)
"""
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("[ True]\n", "")
