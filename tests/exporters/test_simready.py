"""Assets as NVIDIA's profile for props wants them: where files lie, what the layers say of themselves, labels."""

from __future__ import annotations

import json

import numpy as np
import pytest
from PIL import Image

from pat3d.exporters import export
from tests.exporters.things import mixed_scene

pytest.importorskip("pxr")
from pxr import Usd, UsdGeom, UsdPhysics, UsdSemantics, UsdShade

FIELDS = {
    "asset_name", "asset_type", "source_file", "usd_date_generated", "author", "asset_license", "category", "qcode",
    "rigid_body_count", "asset_extents", "mass",
}  # fmt: skip
"""Required by SR.004 of SimReady Foundation 2026.8."""


def test_every_asset_has_its_layer_thumbnail_facts_and_labels(tmp_path):
    scene = mixed_scene()
    index = json.loads(export(scene, ("simready",), tmp_path)["simready"].read_text())
    assert sorted(index["assets"]) == ["ball", "pencil_co", "red_mug_1", "wooden_table"]
    for name, file in index["assets"].items():
        # The profile: root folder, a folder in it, and a file with the root's name in its own.
        assert file == f"{name}/usd/{name}.usdc"
        path = tmp_path / "simready" / file
        with Image.open(path.parent / ".thumbs" / "256x256" / f"{path.name}.png") as picture:
            assert picture.size == (256, 256)
            assert np.asarray(picture).std() > 5.0
        stage = Usd.Stage.Open(str(path))
        data = dict(stage.GetRootLayer().customLayerData)
        facts = dict(data.pop("SimReady_Metadata"))
        assert set(facts) == FIELDS
        assert data == {key: facts[key] for key in ("asset_name", "asset_type", "source_file", "usd_date_generated")}
        assert all(value not in ("", None) for value in facts.values())
        root = stage.GetDefaultPrim()
        assert facts["mass"] == pytest.approx(UsdPhysics.MassAPI(root).GetMassAttr().Get())
        box = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default"]).ComputeWorldBound(root).ComputeAlignedRange()
        assert np.array(facts["asset_extents"]) == pytest.approx(np.array(box.GetSize()), abs=1e-6)
        materials = [prim for prim in stage.Traverse() if prim.IsA(UsdShade.Material)]
        assert len(materials) == 2
        for prim in materials:
            assert list(UsdSemantics.LabelsAPI(prim, "material").GetLabelsAttr().Get())
