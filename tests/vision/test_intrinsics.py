"""Cameras as RGB-D recordings describe them: all of them are one and the same pinhole, or are refused."""

import json

import numpy as np
import pytest
from PIL import Image

from pat3d.errors import SpecError
from pat3d.vision.camera import Pinhole
from pat3d.vision.files import read_depth
from pat3d.vision.intrinsics import read_camera

TRUE = Pinhole(width=640, height=480, fx=525.5, fy=524.0, cx=319.25, cy=239.75)
OURS = {"width": 640, "height": 480, "fx": 525.5, "fy": 524.0, "cx": 319.25, "cy": 239.75}
OPEN3D = {"width": 640, "height": 480, "intrinsic_matrix": [525.5, 0, 0, 0, 524.0, 0, 319.25, 239.75, 1]}
REALSENSE = {"width": 640, "height": 480, "fx": 525.5, "fy": 524.0, "ppx": 319.25, "ppy": 239.75, "coeffs": [0.0] * 5}
MATRIX = "525.5 0 319.25\n0 524.0 239.75\n0 0 1\n"
SCANNET = "525.5 0 319.25 0\n0 524.0 239.75 0\n0 0 1 0\n0 0 0 1\n"


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("own.json", json.dumps(OURS)),
        ("open3d.json", json.dumps(OPEN3D)),
        ("realsense.json", json.dumps(REALSENSE)),
        ("tum.txt", "# fx fy cx cy\n525.5 524.0 319.25 239.75\n"),
        ("tum_lens.txt", "525.5 524.0 319.25 239.75 0 0 0 0 0"),
        ("matrix.txt", MATRIX),
        ("intrinsic_depth.txt", SCANNET),
    ],
)
def test_every_format_of_one_camera_is_that_camera(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    assert read_camera(tmp_path / name, 640, 480) == TRUE


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("a.txt", "525.5 524.0 319.25 239.75 0.1 0 0 0 0", "lens distortion"),
        ("b.txt", MATRIX.replace("525.5 0", "525.5 2"), "skew"),
        ("c.txt", "1 2 3", "3 numbers"),
        ("d.txt", "<html>", "not a file of numbers"),
        ("e.txt", "1170 1170 647.75 483.75", r"not in the depth's 640 x 480"),
        ("f.json", json.dumps(OPEN3D | {"intrinsic_matrix": [[1, 2, 3]]}), "nine numbers"),
        ("g.json", json.dumps(REALSENSE | {"coeffs": [0.2, 0, 0, 0, 0]}), "lens distortion"),
        ("h.json", json.dumps(REALSENSE | {"coeffs": "x"}), "numbers were expected"),
        ("i.json", json.dumps({key: value for key, value in OPEN3D.items() if key != "width"}), "width missing"),
        ("j.json", json.dumps(OPEN3D | {"intrinsic_matrix": [-1.0, 0, 0, 0, 524.0, 0, 319.25, 239.75, 1]}), "fx"),
    ],
)
def test_what_is_no_pinhole_or_another_picture_s_is_refused(tmp_path, name, text, says):
    (tmp_path / name).write_text(text)
    with pytest.raises(SpecError, match=says):
        read_camera(tmp_path / name, 640, 480)


@pytest.mark.parametrize(("said", "metres"), [({}, 2.5), ({"depth_per_metre": 5000}, 0.5)])
def test_the_numbers_of_a_depth_png_are_what_the_camera_says(tmp_path, said, metres):
    Image.fromarray(np.full((48, 64), 2500, dtype=np.uint16)).save(tmp_path / "depth.png")
    (tmp_path / "camera.json").write_text(json.dumps(OURS | said))
    assert read_depth(tmp_path / "depth.png", tmp_path / "camera.json") == pytest.approx(metres)
    assert read_depth(tmp_path / "depth.png") == pytest.approx(2.5)
    angle = {"angle": 60, **said}
    (tmp_path / "camera.json").write_text(json.dumps(angle))
    assert read_camera(tmp_path / "camera.json", 64, 48).fx == pytest.approx(32 / np.tan(np.radians(30)))
    assert read_depth(tmp_path / "depth.png", tmp_path / "camera.json") == pytest.approx(metres)
