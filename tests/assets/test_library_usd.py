"""USD objects: unit, axis, look, mass, friction and collision shapes are those that the stage says."""

import numpy as np
import pytest

from pat3d.assets.library.index import add_library
from pat3d.assets.library.readers.usd import read_usd
from pat3d.assets.library.source import LibrarySource
from pat3d.errors import AssetError

pytest.importorskip("pxr")

USDA = """#usda 1.0
(
    defaultPrim = "Crate"
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Xform "Crate" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{{
    float physics:mass = 2.5
    point3f physics:centerOfMass = (0, 6, 1)
    float3 physics:diagonalInertia = (100, 120, 140)
    def Mesh "Look"
    {{
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
        point3f[] points = [(-10, 0, -5), (-10, 0, 5), (-10, 12, -5), (-10, 12, 5),
                            (10, 0, -5), (10, 0, 5), (10, 12, -5), (10, 12, 5)]
        color3f[] primvars:displayColor = [(0.8, 0.2, 0.1)]
    }}
    def Cube "Hull" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {{
        uniform token purpose = "guide"
        double size = 2
        double3 xformOp:translate = (0, 6, 0)
        float3 xformOp:scale = (10, 6, 5)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }}
    {more}
}}
"""


def test_a_crate_in_centimetres_with_y_up(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_DATA", str(tmp_path / "data"))
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "crate.usda").write_text(USDA.format(more=""))
    (entry,) = add_library(tmp_path / "in", "stage", workers=1).entries
    assert entry.state == "ready", entry.reason
    asset = LibrarySource("stage").make("stage/crate")
    np.testing.assert_allclose(asset.size, [0.2, 0.1, 0.12], atol=1e-7)
    assert asset.mass_properties.mass == 2.5
    # Turned from y up to z up, +z of the file is -y: 6 cm high, 1 cm towards the front.
    np.testing.assert_allclose(asset.mass_properties.centre_of_mass, [0.0, -0.01, 0.06], atol=1e-7)
    np.testing.assert_allclose(np.diag(asset.mass_properties.inertia), [0.01, 0.014, 0.012], rtol=1e-6)
    assert len(asset.parts) == 1
    assert asset.parts[0].box is not None
    colour = asset.visual.texture.reshape(-1, 3)[0]
    np.testing.assert_allclose(colour, [204, 51, 26], atol=1)
    assert entry.facts["unit"]["reason"] == "the USD stage says so"


def test_joints_and_damage_are_refused_with_the_reason(tmp_path):
    path = tmp_path / "crate.usda"
    path.write_text(USDA.format(more='def PhysicsRevoluteJoint "Lid" {}'))
    with pytest.raises(AssetError, match="Lid"):
        read_usd(path, tmp_path)
    path.write_text("#usda 1.0\ndef {")
    with pytest.raises(AssetError, match="cannot be read as USD"):
        read_usd(path, tmp_path)
