"""Cabinet and drawer are bodies of their own in every format."""

from __future__ import annotations

import pytest

from pat3d.exporters import export, parity
from tests.drawers import cabinet_scene


def test_every_format_holds_cabinet_and_drawer_apart(tmp_path):
    pytest.importorskip("pxr")
    scene = cabinet_scene("open drawer", "drawer", inside="cube")
    for name, path in export(scene, ("mjcf", "usd", "urdf", "sdf"), tmp_path).items():
        report = parity(scene, path)
        assert report.passed, (name, report.failures)
