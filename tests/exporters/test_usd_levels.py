"""Levels of detail as variants: each is the mesh that it says, and nothing else of the scene depends on the choice."""

from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.cli.main import main
from pat3d.exporters import parity
from pat3d.exporters.formats import exported
from pat3d.exporters.usd.writer import write_usd
from pat3d.scene.io import save_scene
from pat3d.scene.model import Scene
from tests.assets.test_simplify import ball
from tests.scenes import asset_of, placed, scene_of

pytest.importorskip("pxr")
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, UsdValidation

LEVELS = (2000, 800)


@pytest.fixture(scope="module")
def scene() -> Scene:
    """Two equal balls, whose picture is kept once, a third one of its own, and a box without levels."""
    round_thing = replace(asset_of(box(1.0, 1.0, 1.0)), visual=ball())
    other = replace(round_thing, noun="other")
    return scene_of(
        placed("first", round_thing, (0, 0, 1)),
        placed("second", round_thing, (3, 0, 1)),
        placed("third", other, (6, 0, 1)),
        placed("box", asset_of(box(0.1, 0.1, 0.1)), (9, 0, 0.1)),
    )


@pytest.fixture(scope="module")
def path(scene, tmp_path_factory):
    return write_usd(scene, tmp_path_factory.mktemp("out") / "usd", levels=LEVELS, package=True)


def mesh(stage, name: str):
    visual = stage.GetPrimAtPath(f"/World/{name}/visual")
    return UsdGeom.Mesh(visual.GetChild("mesh") if visual.IsInstance() else visual)


def counts(stage, name: str) -> int:
    return len(mesh(stage, name).GetFaceVertexCountsAttr().Get())


def test_the_full_mesh_is_chosen_and_each_level_is_within_its_budget(path):
    stage = Usd.Stage.Open(str(path))
    full = len(ball().faces)
    assert [counts(stage, name) for name in ("first", "third")] == [full, full]
    choice = stage.GetPrimAtPath("/World/third/visual").GetVariantSets().GetVariantSet("lod")
    assert list(choice.GetVariantNames()) == ["lod0", "lod1", "lod2"]
    for number, budget in enumerate(LEVELS, start=1):
        choice.SetVariantSelection(f"lod{number}")
        assert budget / 2 < counts(stage, "third") <= budget
        material, _ = UsdShade.MaterialBindingAPI(mesh(stage, "third")).ComputeBoundMaterial()
        assert material
        coordinates = UsdGeom.PrimvarsAPI(mesh(stage, "third").GetPrim()).GetPrimvar("st").ComputeFlattened()
        assert len(coordinates) == 3 * counts(stage, "third")


def test_equal_objects_choose_apart_and_what_is_coarse_enough_has_no_choice(path):
    stage = Usd.Stage.Open(str(path))
    first, second = (stage.GetPrimAtPath(f"/World/{name}/visual") for name in ("first", "second"))
    assert first.GetPrototype() == second.GetPrototype()
    second.GetVariantSets().GetVariantSet("lod").SetVariantSelection("lod2")
    assert counts(stage, "second") <= LEVELS[1] < counts(stage, "first")
    assert not stage.GetPrimAtPath("/World/box/visual").HasVariantSets()


def test_colliders_and_masses_do_not_depend_on_the_choice(scene, path):
    assert parity(scene, path).passed
    stage = Usd.Stage.Open(str(path))

    def physics() -> list[tuple]:
        body = stage.GetPrimAtPath("/World/third")
        points = [UsdGeom.Xformable(one).GetLocalTransformation() for one in Usd.PrimRange(body)
                  if one.HasAPI(UsdPhysics.CollisionAPI)]  # fmt: skip
        return [UsdPhysics.MassAPI(body).GetMassAttr().Get(), *points]

    before = physics()
    stage.GetPrimAtPath("/World/third/visual").GetVariantSets().GetVariantSet("lod").SetVariantSelection("lod1")
    assert physics() == before


def test_validators_and_the_package_take_levels(path):
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    assert not context.Validate(Usd.Stage.Open(str(path)))
    _, _, missing = UsdUtils.ComputeAllDependencies(str(path.with_suffix(".usdz")))
    assert not missing
    assert counts(Usd.Stage.Open(str(path.with_suffix(".usdz"))), "first") == len(ball().faces)


def test_what_is_written_anew_has_the_levels_that_it_had(scene, path, tmp_path):
    _, settings = exported(path.parent.parent)
    assert settings == {"text": False, "package": True, "levels": LEVELS}
    again = write_usd(scene, tmp_path / "usd")
    assert exported(tmp_path)[1]["levels"] == ()
    again.write_bytes(b"PXR-USDC damaged")
    assert exported(tmp_path)[1]["levels"] == ()


def test_the_command_line_takes_levels_from_fine_to_coarse(scene, tmp_path, capfd):
    save_scene(scene, tmp_path / "scene")
    run = ["export", str(tmp_path / "scene"), "--formats", "usd", "--out", str(tmp_path / "out"), "--usd-levels"]
    for wrong in ("800,2000", "0", "many", "800,800"):
        assert main([*run, wrong]) == 2
        assert f"--usd-levels {wrong}: expected" in capfd.readouterr().err
    assert not (tmp_path / "out").exists()
    assert main([*run, "2000,800"]) == 0
    stage = Usd.Stage.Open(str(tmp_path / "out" / "usd" / "scene.usdc"))
    names = stage.GetPrimAtPath("/World/third/visual").GetVariantSets().GetVariantSet("lod").GetVariantNames()
    assert len(names) == 1 + len(LEVELS)
    assert np.isfinite(np.array(mesh(stage, "third").GetPointsAttr().Get())).all()
