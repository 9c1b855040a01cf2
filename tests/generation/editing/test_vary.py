"""Variations: other scenes of the same relations."""

import csv
import json

import pytest

import pat3d
from pat3d.cli.main import main
from pat3d.errors import SpecError
from pat3d.generation.editing.variations import FRICTION_FACTORS, MASS_FACTORS, Variety, _objects, vary


def test_the_same_seed_varies_the_same_and_another_differently(desk):
    variety = Variety(objects=True, materials=True)
    first, again, other = (_objects(desk.scene, variety, seed) for seed in (1, 1, 2))
    masses = [[one.asset.mass_properties.mass for one in objects] for objects in (first, again, other)]
    assert masses[0] == masses[1]
    assert masses[0] != masses[2]
    assert [one.asset.noun for one in other] == [obj.asset.noun for obj in desk.scene.objects]


def test_materials_vary_within_their_bounds_and_leave_shapes_alone(desk):
    for seed in range(20):
        for old, new in zip(desk.scene.objects, _objects(desk.scene, Variety(materials=True), seed), strict=True):
            factor = new.asset.mass_properties.mass / old.asset.mass_properties.mass
            assert MASS_FACTORS[0] <= factor <= MASS_FACTORS[1]
            rub = new.asset.material.friction / old.asset.material.friction
            assert FRICTION_FACTORS[0] <= rub <= FRICTION_FACTORS[1]
            assert new.asset.parts is old.asset.parts


def test_nothing_to_vary_is_refused(desk_folder, tmp_path):
    with pytest.raises(SpecError, match="--layout"):
        Variety()
    assert main(["vary", str(desk_folder), "--out", str(tmp_path / "all")]) == 2
    assert not (tmp_path / "all").exists()


@pytest.mark.slow
def test_variations_are_verified_scenes_of_the_same_relations_and_are_kept(desk, desk_folder, tmp_path):
    out = tmp_path / "desks"
    argv = ["vary", str(desk_folder), "--count", "2", "--layout", "--objects", "same-kind", "--out", str(out)]
    assert main(argv) == 0
    rows = list(csv.DictReader((out / "scenes.csv").open()))
    assert [row["state"] for row in rows] == ["verified", "verified"]
    scenes = [pat3d.load_scene(out / row["folder"]) for row in rows]
    for scene in scenes:
        assert scene.relations == desk.scene.relations
        assert scene.prompt == desk.scene.prompt
    assert scenes[0]["vase"].pose != scenes[1]["vase"].pose
    before = json.loads((out / rows[0]["folder"] / "report.json").read_text())
    kept = list(vary(desk_folder, out, count=2, variety=Variety(layout=True, objects=True)))
    assert all(row.kept for row in kept)
    assert json.loads((out / rows[0]["folder"] / "report.json").read_text()) == before
