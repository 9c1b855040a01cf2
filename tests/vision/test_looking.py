"""What a model measured of a photograph is kept, and measured again where the record of it is damaged."""

import json
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from pat3d.errors import ModelError, SpecError
from pat3d.progress import silent
from pat3d.vision.depth import MeasuredDepth
from pat3d.vision.looking import Lookers, Photograph, look

SHAPE = (24, 32)


class Counted:
    """A depth model that counts how often it is asked, or fails."""

    name = "counted"

    def __init__(self):
        self.asked, self.fails = 0, False

    def measure(self, picture):
        self.asked += 1
        if self.fails:
            raise ModelError("out of order")
        return MeasuredDepth(depth=np.full(SHAPE, 2.0, dtype=np.float32), angle=60.0)


@pytest.fixture
def looked(tmp_path, monkeypatch):
    """Looks at a photograph whose depth `counted` measures; the folder of what is kept."""
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path / "cache"))
    Image.fromarray(np.full((*SHAPE, 3), 90, dtype=np.uint8)).save(tmp_path / "photo.png")
    masks = np.zeros(SHAPE, dtype=np.uint8)
    masks[4:20, 4:20] = 1
    Image.fromarray(masks).save(tmp_path / "masks.png")
    (tmp_path / "labels.json").write_text(json.dumps({"objects": [{"name": "mug"}]}))
    photograph = Photograph(
        picture=tmp_path / "photo.png", masks=tmp_path / "masks.png", labels=tmp_path / "labels.json"
    )
    counted = Counted()

    def once(**more):
        return look(replace(photograph, **more), Lookers(depth=lambda: counted), prompt="", progress=silent)

    return counted, once, tmp_path


@pytest.mark.parametrize("damage", [lambda data: b"", lambda data: data[: len(data) // 2], lambda data: b"no zip"])
def test_a_damaged_record_is_measured_and_written_again(looked, damage):
    counted, once, folder = looked
    whole = once()
    (record,) = (folder / "cache" / "looked").iterdir()
    record.write_bytes(damage(record.read_bytes()))
    again = once()
    assert counted.asked == 2
    assert again.record["measured_by"].get("kept") is None
    assert once().record["measured_by"]["kept"]
    assert counted.asked == 2
    assert np.array_equal(again.seen.depth, whole.seen.depth)


def test_what_a_model_cannot_do_is_its_own_error_and_leaves_no_record(looked):
    counted, once, folder = looked
    counted.fails = True
    with pytest.raises(ModelError, match="out of order") as caught:
        once()
    assert caught.value.__context__ is None
    assert not (folder / "cache" / "looked").exists()


def test_depth_up_to_a_factor_needs_a_size(looked):
    _, once, folder = looked
    assert once().labels.metric
    with pytest.raises(SpecError, match="needs the size of at least one object"):
        once(relative=True)
    (folder / "labels.json").write_text(json.dumps({"objects": [{"name": "mug", "size": 0.1}]}))
    assert not once(relative=True).labels.metric
