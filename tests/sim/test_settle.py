import ipctk
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.sim.model import ModelBuilder, poses_from_states
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.settling import Settled, settle
from tests.sim.builders import add_hull, box_points, random_hull


def has_intersection(model, q: np.ndarray) -> bool:
    """By another library, on the vertices at state q, shape (bodies, 4, 3); the ground counts."""
    body, rest = model.vertex_body.numpy(), model.vertex_rest.numpy()
    x = q[body, 0] + np.einsum("vj,vji->vi", rest, q[body, 1:])
    mesh = ipctk.CollisionMesh(x, model.edges.numpy(), model.triangles.numpy())
    return bool(ipctk.has_intersections(mesh, x)) or x[:, 2].min() <= 0


def settle_hulls(
    *bodies: tuple[np.ndarray, Pose], fixed: tuple[int, ...] = (), **options
) -> tuple[Settled, list[Pose]]:
    builder = ModelBuilder()
    for i, (points, pose) in enumerate(bodies):
        add_hull(builder, points, pose, fixed=i in fixed)
    model = builder.finalize("cpu")
    settled = settle(model, SettleOptions(**options), throw=False)
    return settled, poses_from_states(model, settled.q)


def test_a_dropped_box_ends_flat_a_hair_above_the_ground():
    settled, (pose,) = settle_hulls((box_points(0.1, 0.08, 0.06), Pose(position=(0, 0, 0.05))))
    assert settled.at_rest.all()
    assert settled.residual[0] < 1e-6
    gap = pose.position[2] - 0.03
    assert 0.5 * SettleOptions().final_d_hat < gap < SettleOptions().final_d_hat
    np.testing.assert_allclose(np.abs(pose.quat_wxyz), [1, 0, 0, 0], atol=1e-6)


@pytest.mark.parametrize(("friction", "sticks"), [(0.62, True), (0.54, False)])
def test_block_sticks_on_a_30_degree_slope_exactly_above_mu_tan_30(friction, sticks):
    """tan(30 deg) = 0.577; the block lies on a fixed wedge and starts a millimetre above it."""
    slope = np.deg2rad(30)
    wedge = np.array([[x, y, z] for y in (-0.2, 0.2) for x, z in ((0, 0), (1.2, 0), (0, 1.2 * np.tan(slope)))])
    normal = np.array([np.sin(slope), 0, np.cos(slope)])
    foot = np.array([0.4, 0, 0.8 * np.tan(slope)])
    half = Pose(position=tuple(foot + 0.0215 * normal), quat_wxyz=(np.cos(slope / 2), 0, np.sin(slope / 2), 0))
    settled, _ = settle_hulls(
        (wedge, Pose()),
        (box_points(0.06, 0.06, 0.04), half),
        fixed=(0,),
        friction=friction,
        max_frames=30,
        max_polish_steps=40,
    )
    assert settled.at_rest.all() == sticks
    # The free fall of the first step ends a few millimetres down the slope; from there on a stuck block stays.
    slid = np.linalg.norm(settled.q[1, 0] - settled.trajectory[1, 1, 0])
    assert (slid < 2e-3) if sticks else (slid > 1e-2)


def test_tower_of_ten_stands():
    bodies = [
        (box_points(0.06, 0.06, 0.04), Pose.from_yaw(0.1 * i, (0.003 * (i % 2), 0, 0.022 + 0.042 * i)))
        for i in range(10)
    ]
    settled, poses = settle_hulls(*bodies)
    assert settled.at_rest.all()
    for i, pose in enumerate(poses):
        assert pose.position[2] == pytest.approx(0.02 + 0.04 * i, abs=(i + 1) * SettleOptions().final_d_hat)


def test_worlds_move_as_they_would_alone():
    rng = np.random.default_rng(3)
    shapes = [[random_hull(rng) for _ in range(3)] for _ in range(2)]
    poses = [Pose(position=(0.02 * i, 0, 0.1 + 0.13 * i)) for i in range(3)]

    def dropped(worlds):
        builder = ModelBuilder()
        for world in worlds:
            builder.new_world()
            for points, pose in zip(shapes[world], poses, strict=True):
                add_hull(builder, points, pose)
        options = SettleOptions(drop_residual=1e-10)
        run = Run(builder.finalize("cpu"), options, lambda *_: None)
        run.set_d_hat(options.d_hat)
        run.drop(12)
        assert run.potential.friction.count > 0
        return run.state()

    alone = np.concatenate([dropped([0]), dropped([1])])
    # Steps are converged to 1e-10 of the weight; a dozen steps of contact amplify that by less than a thousand.
    np.testing.assert_allclose(dropped([0, 1]), alone, atol=1e-7)


def test_settling_repeats_bit_for_bit():
    rng = np.random.default_rng(4)
    bodies = [(random_hull(rng), Pose(position=(0.03 * i, 0, 0.1 + 0.12 * i))) for i in range(4)]
    first, second = settle_hulls(*bodies)[0], settle_hulls(*bodies)[0]
    assert first.q.tobytes() == second.q.tobytes()


def drop_and_check(seed: int) -> None:
    rng = np.random.default_rng(seed)
    builder = ModelBuilder()
    for i in range(4):
        points = random_hull(rng) * rng.uniform(0.3, 1.2)
        quat = rng.normal(size=4)
        pose = Pose(
            position=(*rng.uniform(-0.03, 0.03, 2), 0.1 + 0.14 * i), quat_wxyz=tuple(quat / np.linalg.norm(quat))
        )
        add_hull(builder, points, pose, density=float(10 ** rng.uniform(1.5, 3.5)))
    model = builder.finalize("cpu")
    settled = settle(model, SettleOptions(max_frames=120), throw=False)
    for q in (*settled.trajectory.astype(np.float64), settled.q):
        assert not has_intersection(model, q)


@settings(max_examples=5, deadline=None, derandomize=True)
@given(st.integers(0, 2**32 - 1))
def test_random_drops_never_intersect_at_any_frame(seed):
    drop_and_check(seed)


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_many_random_drops_never_intersect_at_any_frame(seed):
    drop_and_check(seed)


def test_a_start_that_intersects_is_refused_with_the_pair():
    with pytest.raises(SimulationError, match='"body" and "body"'):
        settle_hulls(
            (box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.1))),
            (box_points(0.1, 0.1, 0.1), Pose(position=(0.05, 0, 0.1))),
        )
