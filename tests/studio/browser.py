"""Chromium without a screen, as tests and measurements of the studio use it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

WIDTH, HEIGHT = 1280, 800
FLAGS = (
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    # Without a graphics card WebGL is drawn by the processor; how the page is put together is Chromium's own choice.
    "--enable-unsafe-swiftshader",
)


def chromium() -> str | None:
    """Path of an installed Chromium."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@contextmanager
def page() -> Iterator[Any]:
    """A page of a fresh browser."""
    from playwright.sync_api import sync_playwright

    flags = [*FLAGS, *(("--no-sandbox",) if os.geteuid() == 0 else ())]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=flags)
        try:
            made = browser.new_page(viewport={"width": WIDTH, "height": HEIGHT})
            made.set_default_timeout(120_000)
            yield made
        finally:
            browser.close()


def pixel(server: Any, point: Any) -> tuple[float, float]:
    """Where a point of the scene [m] is seen on the page of the only client."""
    (client,) = server.get_clients().values()
    camera = client.camera
    w, x, y, z = camera.wxyz
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    # Its axes are right, down and forward.
    right, down, forward = rotation.T @ (np.asarray(point, dtype=np.float64) - camera.position)
    focal = HEIGHT / 2 / np.tan(camera.fov / 2)
    return WIDTH / 2 + focal * right / forward, HEIGHT / 2 + focal * down / forward
