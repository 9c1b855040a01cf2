"""Cabinet and drawer, and case and door, are bodies of their own in every format."""

from __future__ import annotations

import pytest

from pat3d.exporters import export, parity
from tests.doors import door_scene
from tests.drawers import cabinet_scene


@pytest.mark.parametrize(
    "scene", [cabinet_scene("open drawer", "drawer", inside="cube"), door_scene("microwave", "open ", inside="mug")]
)
def test_every_format_holds_what_moves_and_what_holds_it_apart(scene, tmp_path):
    pytest.importorskip("pxr")
    for name, path in export(scene, ("mjcf", "usd", "urdf", "sdf"), tmp_path).items():
        report = parity(scene, path)
        assert report.passed, (name, report.failures)
