"""Which way an imported mesh stands and how large it is, told by a mesh that looks different from every side."""

import numpy as np
import pytest
import trimesh

from pat3d.assets.mesh.importing import METRES, TO_Z_UP, import_mesh

AXES = {sign + name: (-1.0 if sign else 1.0) * np.eye(3)["xyz".index(name)] for sign in ("", "-") for name in "xyz"}


@pytest.mark.parametrize("up", sorted(AXES))
def test_what_is_up_in_the_file_is_up_in_the_scene(tmp_path, up):
    """A crate with a knob at its upper end, and a smaller one on its side that shows a mirror image."""
    third = AXES["y" if up.endswith("x") else "x"]
    knob, mark = (trimesh.creation.box((side,) * 3) for side in (0.02, 0.01))
    knob.apply_translation(0.16 * AXES[up])
    mark.apply_translation(0.155 * third)
    path = tmp_path / "crate.stl"
    trimesh.util.concatenate([trimesh.creation.box((0.3, 0.3, 0.3)), knob, mark]).export(path)
    asset = import_mesh(path, up=up, parts="box")
    top = asset.visual.vertices[np.argmax(asset.visual.vertices[:, 2])]
    assert asset.size[2] == pytest.approx(0.32)
    assert np.abs(top[:2]).max() < 0.02
    turn = np.array(TO_Z_UP[up], dtype=float)
    np.testing.assert_array_equal(turn @ AXES[up], [0.0, 0.0, 1.0])
    assert np.linalg.det(turn) == pytest.approx(1.0)
    far = asset.visual.vertices @ (turn @ third)
    middle = asset.visual.vertices[asset.visual.vertices[:, 2] < 0.299] @ (turn @ third)
    assert far.max() > 0.15
    assert middle.size


@pytest.mark.parametrize(
    ("units", "length"), [("m", 0.3), ("cm", 30.0), ("mm", 300.0), ("in", 0.3 / 0.0254), (None, 0.3)]
)
def test_thirty_centimetres_are_that_in_every_unit(tmp_path, units, length):
    path = tmp_path / "cube.stl"
    trimesh.creation.box((length,) * 3).export(path)
    assert import_mesh(path, units=units, parts="box").size == pytest.approx([0.3] * 3, rel=1e-6)


def test_ten_of_a_smaller_unit_make_one_of_the_next():
    """No decimetres: a centimetre is a hundredth of a metre, a millimetre a tenth of that."""
    assert METRES == {"m": 1.0, "cm": 1.0 / 100, "mm": 1.0 / 1000, "in": 25.4 / 1000}
