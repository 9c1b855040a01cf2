"""A GPU takes the same steps as a CPU, and on request the same bits every time."""

import ast
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import warp as wp

import pat3d.sim
import pat3d.sim.adjoint  # so that every module with kernels is declared
from pat3d.sim import determinism
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.kernel_modules import declared_modules
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.settling import settle
from tests.sim.drops import KINDS, add_random_bodies, random_scene
from tests.sim.test_clusters import pair_of_lumps, positions

needs_gpu = pytest.mark.skipif(wp.get_cuda_device_count() == 0, reason="no CUDA device")


def random_bodies(kind: str, seed: int, device: str) -> Model:
    builder = ModelBuilder()
    add_random_bodies(builder, kind, seed)
    return builder.finalize(device)


def after(model: Model, frames: int, q0: np.ndarray | None = None, **options) -> np.ndarray:
    run = Run(model, SettleOptions(**options), lambda *_: None, q0)
    run.set_d_hat(run.options.d_hat)
    run.drop(frames)
    return run.state()


@needs_gpu
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("frames", [0, 4, 20])
def test_a_step_on_a_gpu_is_that_on_a_cpu(kind, frames):
    start = after(random_bodies(kind, 11, "cpu"), frames)
    ends = [after(random_bodies(kind, 11, device), 1, start, drop_residual=1e-10) for device in ("cpu", "cuda")]
    np.testing.assert_allclose(ends[1], ends[0], rtol=0, atol=1e-9)


@needs_gpu
def test_a_step_of_detailed_bodies_on_a_gpu_is_that_on_a_cpu():
    start = after(pair_of_lumps().finalize("cpu"), 4)
    ends = [after(pair_of_lumps().finalize(device), 1, start, drop_residual=1e-10) for device in ("cpu", "cuda")]
    np.testing.assert_allclose(ends[1], ends[0], rtol=0, atol=1e-9)


def settle_repeatedly() -> None:
    """Print a digest and the seconds of runs on a GPU, two of each scene."""
    import hashlib

    from pat3d.sim.compilation import prepare

    device = prepare("cuda", deterministic="deterministic" in sys.argv)
    for kind in KINDS:
        for _ in range(2):
            model = random_bodies(kind, 4, device)
            begin = time.perf_counter()
            settled = settle(model, SettleOptions(max_frames=60, max_polish_steps=60), throw=False)
            digest = hashlib.sha256(settled.q.tobytes() + settled.trajectory.tobytes()).hexdigest()
            print(kind, digest, round(time.perf_counter() - begin, 3))


@needs_gpu
def test_deterministic_runs_on_a_gpu_end_in_the_same_bits():
    command = [sys.executable, "-m", "tests.sim.test_gpu", "deterministic"]
    lines: list[str] = []
    # The mode is of a whole process.
    for _ in range(2):
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, done.stderr[-2000:]
        lines += [line for line in done.stdout.splitlines() if line.split(" ")[0] in KINDS]
    digests = {kind: {line.split()[1] for line in lines if line.startswith(kind + " ")} for kind in KINDS}
    assert len(lines) == 4 * len(KINDS)
    assert {kind: len(found) for kind, found in digests.items()} == dict.fromkeys(KINDS, 1)


def test_sorted_candidates_are_the_same_in_whatever_order_they_were_found():
    model = pair_of_lumps().finalize("cpu")
    candidates, x = Candidates(model), positions(model)
    candidates.cover(x, x, 2e-3, 1e-3)

    def rows() -> np.ndarray:
        return np.column_stack([candidates.kind.numpy(), candidates.primitives.numpy()])[: candidates.count].copy()

    found = rows()
    candidates.sort()
    expected = rows()
    assert {tuple(row) for row in found} == {tuple(row) for row in expected}
    shuffled = np.random.default_rng(0).permutation(found)
    for array, values in ((candidates.kind, shuffled[:, 0]), (candidates.primitives, shuffled[:, 1:])):
        filled = array.numpy()
        filled[: candidates.count] = values
        array.assign(filled)
    candidates.sort()
    np.testing.assert_array_equal(rows(), expected)


def functions_in(tree: ast.AST) -> list[ast.FunctionDef]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]


def adds(function: ast.FunctionDef, adding: set[str]) -> bool:
    """Whether a function adds to an array, which is atomic in Warp, or calls one of those that do."""
    nodes = list(ast.walk(function))
    return any(isinstance(node, ast.Call) and ast.unparse(node.func) in adding for node in nodes) or any(
        isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Subscript) for node in nodes
    )


def test_determinism_covers_every_module_that_adds_numbers_in_threads():
    """Whether its kernels add by themselves or through functions of other modules.

    Lists of pairs are sorted instead, and what is only read as a maximum or minimum has no order.
    """
    folder = Path(pat3d.sim.__path__[0])
    functions = {
        "pat3d.sim." + ".".join(path.relative_to(folder).with_suffix("").parts): functions_in(
            ast.parse(path.read_text())
        )
        for path in folder.rglob("*.py")
    }
    of_warp = [f for some in functions.values() for f in some if "wp.func" in map(ast.unparse, f.decorator_list)]
    adding = {"wp.atomic_add"}
    for _ in of_warp:
        adding |= {function.name for function in of_warp if adds(function, adding)}
    declared = {module.name: module.most_records for module in declared_modules()}
    for name, some in functions.items():
        kernels = [function for function in some if "wp.kernel" in map(ast.unparse, function.decorator_list)]
        assert bool(kernels) == (name in declared), name
        sums = any(adds(kernel, adding) for kernel in kernels)
        lists = name in ("pat3d.sim.contact.boxes", "pat3d.sim.contact.broad_phase")
        assert (declared.get(name, 0) > 0) == (sums and not lists), name


def test_a_cpu_needs_no_mode_to_repeat():
    ends = [after(random_scene("concave", 2), 15) for _ in range(2)]
    assert ends[0].tobytes() == ends[1].tobytes()
    assert not determinism.enabled()


if __name__ == "__main__":
    settle_repeatedly()
