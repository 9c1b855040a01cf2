"""Buffers of contacts grow when they are full: from tiny ones a run ends in the same bits as from large ones."""

import numpy as np
import pytest

from pat3d.sim.contact import boxes, broad_phase
from pat3d.sim.model import Model
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.terms import friction
from tests.sim.drops import random_scene
from tests.sim.test_clusters import pair_of_lumps


def dropped(model: Model, frames: int) -> tuple[bytes, Run]:
    run = Run(model, SettleOptions(), lambda *_: None)
    run.set_d_hat(run.options.d_hat)
    run.drop(frames)
    return run.state().tobytes(), run


def drop_with(monkeypatch, model: Model, frames: int, capacity: int) -> tuple[bytes, Run]:
    for module, name in ((broad_phase, "CAPACITY"), (boxes, "CLUSTER_PAIRS"), (friction, "CAPACITY")):
        monkeypatch.setattr(module, name, capacity)
    return dropped(model, frames)


@pytest.mark.parametrize("kind", ["concave", "sharp"])
def test_hulls_fall_alike_whatever_the_capacity_at_first(monkeypatch, kind):
    model = random_scene(kind, 7)
    small, run = drop_with(monkeypatch, model, 25, 1)
    large, ample = drop_with(monkeypatch, model, 25, 1 << 16)
    assert small == large
    assert run.potential.candidates.count == ample.potential.candidates.count > 1
    assert run.potential.candidates.capacity < 1 << 16
    assert ample.potential.candidates.capacity == ample.potential.friction.capacity == 1 << 16


def test_detailed_bodies_fall_alike_whatever_the_capacity_at_first(monkeypatch):
    model = pair_of_lumps().finalize("cpu")
    small, run = drop_with(monkeypatch, model, 3, 1)
    large, _ = drop_with(monkeypatch, model, 3, 1 << 16)
    assert small == large
    assert run.potential.friction.count > 1
    assert run.potential.candidates.count > 1


def test_contacts_that_appear_while_a_run_goes_on_are_all_kept(monkeypatch):
    """Friction's contacts are those candidates that are closer than d_hat, counted by another way."""
    model = random_scene("concave", 3)
    _, run = drop_with(monkeypatch, model, 30, 1)
    potential = run.potential
    run.record_friction()
    from pat3d.sim.contact.distance import POINT_GROUND

    kinds = potential.candidates.kind.numpy()[: potential.candidates.count]
    pairs = potential.candidates.primitives.numpy()[: potential.candidates.count]
    height = potential.vertex_positions.numpy()[:, 2]
    grounded = pairs[kinds == int(POINT_GROUND), 0]
    assert len(set(grounded)) == len(grounded)
    assert set(np.flatnonzero(height < run.options.d_hat)) <= set(grounded)
    assert potential.friction.count >= np.sum(height < run.options.d_hat)
