"""Files of photographs: what is taken from them, and that what is wrong with them is said and goes no further."""

import io
import json
import struct
import zipfile
import zlib

import numpy as np
import pytest
from PIL import Image

from pat3d.errors import SpecError
from pat3d.vision import files, intrinsics
from pat3d.vision.camera import Pinhole
from pat3d.vision.stance import Stance

NAMES = {"objects": [{"name": "red mug", "noun": "mug"}, {"name": "plate", "value": 7}]}


def write(path, document):
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def labels(tmp_path, document=NAMES):
    return files.read_labels(write(tmp_path / "labels.json", document))


def png_header(width: int, height: int) -> bytes:
    """A PNG that claims to be large and holds nothing."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")


def test_labels_have_nouns_and_values_of_their_own(tmp_path):
    one, two = labels(tmp_path).objects
    assert (one.noun, one.value, two.noun, two.value) == ("mug", 1, "plate", 7)


def test_labels_tell_how_things_stand_and_which_of_them_is_hidden_least(tmp_path):
    told = {"objects": [{"name": "mug", "posture": "on its side", "facing": "left"}, {"name": "plate"}]}
    found = labels(tmp_path, told | {"least_occluded": "plate"})
    assert [one.stance for one in found.objects] == [Stance(posture="on its side", facing="left"), Stance()]
    assert found.least_occluded == "plate"


@pytest.mark.parametrize(
    ("document", "said"),
    [
        ({"objects": []}, "objects"),
        ({"objects": [{"name": "mug"}, {"name": "mug"}]}, 'two objects have the name "mug"'),
        ({"objects": [{"name": "a", "value": 2}, {"name": "b"}]}, 'two objects have the value "2"'),
        ({"objects": [{"name": "../../etc/passwd"}]}, "name"),
        ({"objects": [{"name": "ground"}]}, "cannot be the name"),
        ({"objects": [{"name": "mug\x1b[2J"}]}, "name|character"),
        ({"objects": [{"name": "mug", "mesh": "/etc/passwd"}]}, "mesh"),
        ({"objects": [{"name": f"mug {k}"} for k in range(100)]}, "objects"),
        ({"objects": [{"name": "mug"}], "depth": "relative"}, "needs the size"),
        ({"objects": [{"name": "mug"}], "least_occluded": "cup"}, 'no object is called "cup"'),
        ({"objects": [{"name": "mug", "facing": "up"}]}, "facing"),
    ],
)
def test_labels_that_cannot_be_meant_are_refused(tmp_path, document, said):
    with pytest.raises(SpecError, match=said):
        labels(tmp_path, document)


def test_depth_is_metres_in_arrays_and_millimetres_in_pictures(tmp_path):
    metres = np.array([[0.5, np.nan], [np.inf, -1.0]])
    np.save(tmp_path / "depth.npy", metres)
    found = files.read_depth(tmp_path / "depth.npy")
    assert found[0, 0] == pytest.approx(0.5)
    assert np.isnan(found).sum() == 3
    Image.fromarray(np.array([[500, 0], [1250, 65535]], dtype=np.uint16)).save(tmp_path / "depth.png")
    found = files.read_depth(tmp_path / "depth.png")
    assert found[1].tolist() == pytest.approx([1.25, 65.535])
    assert np.isnan(found[0, 1])


def test_masks_of_pictures_and_arrays_agree(tmp_path):
    values = np.array([[0, 1, 1], [7, 7, 3]], dtype=np.uint8)
    Image.fromarray(values).save(tmp_path / "masks.png")
    np.save(tmp_path / "masks.npy", values)
    np.save(tmp_path / "layers.npy", np.stack([values == 1, *(values == 99 for _ in range(5)), values == 7]))
    known = labels(tmp_path)
    for name in ("masks.png", "masks.npy", "layers.npy"):
        assert files.instances_of(files.read_masks(tmp_path / name), known).tolist() == [[0, 1, 1], [2, 2, 0]]


def test_an_object_without_pixels_is_named(tmp_path):
    with pytest.raises(SpecError, match=r'no pixel of the masks shows "plate" \(value 7\). Values: 1'):
        files.instances_of(np.ones((4, 4), dtype=np.int32), labels(tmp_path))


def test_depth_of_nothing_is_refused(tmp_path):
    np.save(tmp_path / "depth.npy", np.full((4, 4), np.nan))
    with pytest.raises(SpecError, match="no pixel has a depth"):
        files.read_depth(tmp_path / "depth.npy")


def test_arrays_that_lie_about_their_size_or_hold_code_are_refused(tmp_path):
    path = tmp_path / "depth.npy"
    stream = io.BytesIO()
    header = {"descr": "<f4", "fortran_order": False, "shape": (10**6, 10**6)}
    np.lib.format.write_array_header_1_0(stream, header)
    path.write_bytes(stream.getvalue() + b"\0" * 64)
    with pytest.raises(SpecError, match=r"not a readable \.npy"):
        files.read_depth(path)
    np.save(path, np.array([{"a": 1}], dtype=object), allow_pickle=True)
    with pytest.raises(SpecError, match=r"not a readable \.npy"):
        files.read_depth(path)
    path.write_bytes(b"\x93NUMPY\x01")
    with pytest.raises(SpecError, match=r"not a readable \.npy"):
        files.read_depth(path)


def test_a_picture_of_100_megapixels_is_refused_before_it_is_decoded(tmp_path):
    path = tmp_path / "large.png"
    path.write_bytes(png_header(10_000, 10_000))
    with pytest.raises(SpecError, match="at most 50 million"):
        files.read_picture(path)
    path.write_bytes(png_header(2_000_000, 2_000_000))
    with pytest.raises(SpecError, match=r"large\.png"):
        files.read_picture(path)


def test_a_truncated_picture_is_refused(tmp_path):
    path = tmp_path / "half.png"
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (64, 64, 3), dtype=np.uint8)).save(path)
    path.write_bytes(path.read_bytes()[:4000])
    with pytest.raises(SpecError, match="cannot be read"):
        files.read_picture(path)


def test_of_a_file_that_is_two_kinds_at_once_only_the_pixels_are_taken(tmp_path):
    """A PNG with an archive behind it is a picture; an archive alone, or a program, is none."""
    path = tmp_path / "both.png"
    Image.fromarray(np.full((16, 16, 3), 9, dtype=np.uint8)).save(path)
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as file:
        file.writestr("secret.txt", "secret")
    path.write_bytes(path.read_bytes() + archive.getvalue())
    pixels, _ = files.read_picture(path)
    assert (pixels == 9).all()
    path.write_bytes(archive.getvalue())
    with pytest.raises(SpecError, match="not a PNG or JPEG"):
        files.read_picture(path)
    path.write_bytes(b"<svg onload='x'/>")
    with pytest.raises(SpecError, match="not a PNG or JPEG"):
        files.read_picture(path)


def test_the_notes_of_a_photograph_tell_its_angle_and_which_side_is_up(tmp_path):
    image = Image.fromarray(np.zeros((40, 80, 3), dtype=np.uint8))
    notes = image.getexif()
    notes.get_ifd(0x8769)[41989] = 18
    notes[0x0112] = 6
    image.save(tmp_path / "photo.jpg", exif=notes)
    pixels, angle = files.read_picture(tmp_path / "photo.jpg")
    assert pixels.shape == (80, 40, 3)
    assert angle == pytest.approx(90.0)


def test_thinning_keeps_what_pixels_look_at():
    """The ray of a thinned pixel is that of the whole picture's pixel that it was taken from."""
    width, height = 2 * files.WORKING_SIDE, 900
    columns = np.broadcast_to(np.arange(width, dtype=np.float32), (height, width))
    camera = Pinhole.of_angle(width, height, 60.0)
    one = files.Labels(objects=(files.Label(name="it", noun="it", value=1),))
    seen = files.observed(
        picture=np.zeros((height, width, 3), dtype=np.uint8),
        depth=1.0 + columns / 1e4,
        instances=np.ones((height, width), dtype=np.int32),
        labels=one,
        camera=camera,
    )
    assert max(seen.depth.shape) <= files.WORKING_SIDE
    taken = round(float(seen.depth[0, 100] - 1.0) * 1e4)
    assert seen.camera.slopes(100.5, 0.5)[0] == pytest.approx(camera.slopes(taken + 0.5, 0.5)[0], abs=1e-9)


def test_files_of_different_proportions_are_refused(tmp_path):
    one = files.Labels(objects=(files.Label(name="it", noun="it", value=1),))
    with pytest.raises(SpecError, match="proportions"):
        files.observed(
            picture=np.zeros((100, 100, 3), dtype=np.uint8),
            depth=np.ones((48, 64), dtype=np.float32),
            instances=np.ones((48, 64), dtype=np.int32),
            labels=one,
            camera=Pinhole.of_angle(64, 48),
        )
    write(tmp_path / "camera.json", {"width": 100, "height": 100, "fx": 90, "fy": 90, "cx": 50, "cy": 50})
    with pytest.raises(SpecError, match="proportions"):
        intrinsics.read_camera(tmp_path / "camera.json", 64, 48)
    write(tmp_path / "camera.json", {"fx": 90})
    with pytest.raises(SpecError, match="width, height, fy, cx, cy missing"):
        intrinsics.read_camera(tmp_path / "camera.json", 64, 48)
