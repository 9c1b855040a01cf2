"""What is told of two folders that differ: how much of it, and nothing but differences whatever a file states."""

import json

import numpy as np
import pytest

from pat3d.exporters.contents.compare import MAX_LINES, _folders


@pytest.mark.parametrize("count", [1, MAX_LINES - 1, MAX_LINES, MAX_LINES + 1, MAX_LINES + 9])
def test_every_difference_of_a_file_is_told_up_to_a_number_and_beyond_it_that_there_are_more(count, tmp_path):
    content = {f"key{k}": k for k in range(2 * MAX_LINES + 20)}
    for name, shift in (("found", 1), ("expected", 0)):
        (tmp_path / name).mkdir()
        changed = {key: value + shift if value < count else value for key, value in content.items()}
        (tmp_path / name / "a.json").write_text(json.dumps(changed))
        (tmp_path / name / "b.json").write_text(json.dumps(content))
    told = [line for _, line in _folders(tmp_path / "found", tmp_path / "expected")]
    assert sum("key" in line for line in told) == min(count, MAX_LINES)
    assert ("differs in more than that" in told) == (count > MAX_LINES)
    assert len(told) == min(count, MAX_LINES + 1)


def _layer(path, moments, axes, kind="Quatf"):
    """A layer with one asset whose moments [kg m^2] and principal axes are `moments` and `axes`."""
    from pxr import Gf, Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    prim = Sdf.CreatePrimInLayer(layer, "/one")
    prim.specifier = Sdf.SpecifierDef
    for name, sort, value in (
        ("physics:diagonalInertia", Sdf.ValueTypeNames.Float3, Gf.Vec3f(*moments)),
        (
            "physics:principalAxes",
            getattr(Sdf.ValueTypeNames, kind),
            Gf.Quatf(*axes) if kind == "Quatf" else axes,
        ),
    ):
        attribute = Sdf.AttributeSpec(prim, name, sort)
        attribute.default = value
    layer.Export(str(path))
    return path


MOMENTS = (1.0, 2.0, 3.0)
HALF = float(np.sqrt(0.5))


@pytest.mark.parametrize(
    ("moments", "axes", "kind", "same"),
    [
        (MOMENTS, (1, 0, 0, 0), "Quatf", True),
        (MOMENTS, (-1, 0, 0, 0), "Quatf", True),
        (MOMENTS, (0, 1, 0, 0), "Quatf", True),
        ((2.0, 1.0, 3.0), (HALF, 0, 0, HALF), "Quatf", True),
        ((2.0, 1.0, 3.0), (1, 0, 0, 0), "Quatf", False),
        (MOMENTS, (HALF, 0, 0, HALF), "Quatf", False),
        (MOMENTS, (0, 0, 0, 0), "Quatf", False),
        (MOMENTS, (np.nan, 0, 0, 0), "Quatf", False),
        (MOMENTS, (1, 0, 0, np.inf), "Quatf", False),
        (MOMENTS, "none", "String", False),
    ],
)
def test_axes_are_compared_by_their_tensor_and_those_that_are_no_rotation_differ(moments, axes, kind, same, tmp_path):
    """The tensor of half turns about its own axes is the same; a quarter turn about z swaps the first two moments."""
    pytest.importorskip("pxr")
    from pat3d.exporters.contents.usd_layers import layer_differences

    expected = _layer(tmp_path / "expected.usda", MOMENTS, (1, 0, 0, 0))
    found = _layer(tmp_path / "found.usda", moments, axes, kind)
    told = list(layer_differences(found, expected))
    assert (told == []) is same
    assert all("/one.physics:" in line for line in told)
