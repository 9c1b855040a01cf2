"""Worlds that are copies of one another."""

import dataclasses
from typing import Any

import numpy as np
import pytest
import warp as wp

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder
from tests.sim.builders import add_hull, box_points


def built(worlds: int) -> ModelBuilder:
    """A fixed shelf, two boxes of it and an anchor, built again for every world."""
    builder = ModelBuilder()
    for _ in range(worlds):
        builder.new_world()
        first = add_hull(builder, box_points(0.3, 0.3, 0.1), Pose(), fixed=True)
        add_hull(builder, box_points(0.1, 0.08, 0.06), Pose(position=(0, 0, 0.1)))
        add_hull(builder, box_points(0.05, 0.05, 0.05), Pose(position=(0.1, 0, 0.1)))
        builder.add_attachment(first + 1, np.zeros(3), first + 2, np.array([-0.1, 0.0, 0.0]))
    return builder


def contents(model: Model) -> dict[str, Any]:
    values = {field.name: getattr(model, field.name) for field in dataclasses.fields(model)}
    return {name: value.numpy() if isinstance(value, wp.array) else value for name, value in values.items()}


def test_copies_of_a_world_are_what_building_it_again_gives():
    again, copied = contents(built(3).finalize("cpu")), contents(built(1).finalize("cpu", worlds=3))
    for name, value in again.items():
        np.testing.assert_array_equal(copied[name], value, err_msg=name)
        if isinstance(value, np.ndarray):
            assert copied[name].dtype == value.dtype, name


@pytest.mark.parametrize(("worlds", "copies"), [(2, 3), (1, 0)])
def test_only_one_world_can_be_copied_and_at_least_once(worlds, copies):
    with pytest.raises(SimulationError, match="only one world can be copied"):
        built(worlds).finalize("cpu", worlds=copies)
