"""What is loaded: verified scenes, and nothing that moves."""

from __future__ import annotations

import shutil

import numpy as np
import pytest

from pat3d.envs.physics.loading import default_scene, load
from pat3d.errors import SpecError, UnsettledSceneError
from pat3d.exporters.mjcf.writer import write_mjcf


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def folder(tmp_path, breakfast):
    """A writable copy of the shipped scene with its MJCF."""
    shutil.copytree(default_scene(), tmp_path / "scene")
    write_mjcf(breakfast, tmp_path / "scene" / "mjcf")
    return tmp_path / "scene"


def test_the_shipped_scene_is_small_and_whole():
    files = [path for path in default_scene().rglob("*") if path.is_file()]
    assert sum(path.stat().st_size for path in files) < 1.2 * 2**20
    assert (default_scene() / "scene.json").is_file()


@pytest.mark.slow
def test_the_shipped_scene_is_what_its_sentence_and_seed_give_today(tmp_path, breakfast):
    """Generated anew it has the same objects in the same places; a change here asks for a new shipped scene."""
    from pat3d.generation.pipeline import generate

    fresh = generate(breakfast.prompt, out=tmp_path / "fresh", seed=breakfast.seed)
    assert [obj.name for obj in fresh.objects] == [obj.name for obj in breakfast.objects]
    assert fresh.relations == breakfast.relations
    for new, old in zip(fresh.objects, breakfast.objects, strict=True):
        np.testing.assert_allclose(new.pose.position, old.pose.position, atol=1e-4)
        np.testing.assert_allclose(new.asset.size, old.asset.size, atol=1e-6)


def test_a_scene_without_an_export_is_exported_once_into_the_cache(cache):
    first = load(None)
    assert first.mjcf.is_relative_to(cache)
    written = first.mjcf.stat().st_mtime_ns
    second = load(None)
    assert second.mjcf == first.mjcf
    assert second.checksum == first.checksum
    assert second.mjcf.stat().st_mtime_ns == written


def test_processes_that_export_the_same_scene_at_once_do_not_take_each_other_s_files(cache, monkeypatch):
    """While one writes, another is done and reads: its files stay."""
    from pat3d.exporters.mjcf import writer as mjcf

    write, before = mjcf.write_mjcf, []

    def slowly(scene, folder, *rest, **options):
        found = write(scene, folder, *rest, **options)
        if not before:
            before.append(None)
            before[0] = {path: path.stat().st_ino for path in load(None).mjcf.parent.rglob("*") if path.is_file()}
        return found

    monkeypatch.setattr(mjcf, "write_mjcf", slowly)
    second = load(None)
    assert before[0]
    assert {path: path.stat().st_ino for path in second.mjcf.parent.rglob("*") if path.is_file()} == before[0]
    assert [path.name for path in second.mjcf.parents[1].iterdir()] == [second.mjcf.parent.name]


def test_a_scene_that_moves_is_refused_by_name_and_drift_the_second_time_too(cache, folder):
    """The mug is lifted by 5 cm in the MJCF: it falls back, and both loads say so."""
    path = folder / "mjcf" / "scene.xml"
    text = path.read_text(encoding="utf-8")
    start = text.index('<body name="red_mug"')
    position = text[start:].split('pos="', 1)[1].split('"', 1)[0]
    x, y, z = position.split()
    path.write_text(text.replace(f'pos="{position}"', f'pos="{x} {y} {float(z) + 0.05!r}"', 1), encoding="utf-8")
    for _ in range(2):
        with pytest.raises(UnsettledSceneError, match=r'"red mug" by \d+(\.\d+)? mm'):
            load(folder)


def test_the_verification_is_repeated_when_a_file_changes(cache, folder):
    first = load(folder)
    path = folder / "mjcf" / "scene.xml"
    path.write_text(path.read_text(encoding="utf-8") + "<!-- -->\n", encoding="utf-8")
    assert load(folder).checksum != first.checksum
    assert len(list((cache / "settled").iterdir())) == 2


def test_a_damaged_record_of_the_verification_is_not_believed(cache, folder):
    load(folder)
    (record,) = (cache / "settled").iterdir()
    record.write_text('{"passed": "yes"}', encoding="utf-8")
    load(folder)
    assert "true" in record.read_text(encoding="utf-8")


def test_no_scene_is_an_error_that_names_the_file(tmp_path):
    with pytest.raises(SpecError, match="nowhere"):
        load(tmp_path / "nowhere")
