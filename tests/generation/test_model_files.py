"""Objects of a specification that are others' models: their own shapes and masses, unless it says otherwise."""

from __future__ import annotations

import pytest

from pat3d.errors import SpecError
from pat3d.generation.spec import load_spec
from pat3d.progress import silent

BRICK = """<mujoco><worldbody><body name="brick"><freejoint/>
<geom type="box" size="0.1 0.05 0.03" mass="2" friction="0.6"/></body></worldbody></mujoco>"""


def made(folder, *objects: str):
    (folder / "brick.xml").write_text(BRICK)
    path = folder / "spec.yaml"
    path.write_text("objects:\n" + "".join(f"  - {{name: {one}}}\n" for one in objects))
    request = load_spec(path).request()
    return {one.name: one.asset for one in request.make_objects(0, silent)}


def test_a_model_keeps_what_it_says_unless_the_specification_says_otherwise(tmp_path):
    found = made(tmp_path, "a, model: brick.xml", "b, model: brick.xml", "c, model: brick.xml, mass: 1, friction: 0.2")
    assert found["a"] is found["b"]
    assert (found["a"].mass_properties.mass, found["a"].material.friction) == (2.0, 0.6)
    assert (found["c"].mass_properties.mass, found["c"].material.friction) == (1.0, 0.2)
    assert found["a"].size == pytest.approx([0.2, 0.1, 0.06])
    # A box's moment about z is m (x^2 + y^2) / 12.
    assert found["c"].mass_properties.inertia[2][2] == pytest.approx((0.04 + 0.01) / 12)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("a, model: brick.xml, noun: cup", "needs either a noun"),
        ("a, model: brick.xml, size: 0.1", '"size" is for what is no model only'),
        ("a, model: none.xml", 'no model file "none.xml"'),
        ("a, model: brick.xml, units: mm", '"units" is for meshes only'),
    ],
)
def test_what_a_model_cannot_be_is_said_with_its_line(tmp_path, wrong, said):
    with pytest.raises(SpecError, match=f"spec.yaml:2:.*{said}"):
        made(tmp_path, wrong)
