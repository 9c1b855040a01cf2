r"""First paint and frame rate of the studio in headless Chromium.

    pat3d generate "a stack of three books, a vase, a red mug, a bowl with two apples and a laptop on a desk" \
        --out scenes/ten
    python benchmarks/studio.py scenes/ten [--repeats 5]

Needs Chromium and `pip install 'pat3d[studio]' playwright`. "first paint" is the browser's own first-contentful-paint,
"controls" when the panel can be used, both from the navigation on. "frames" are those in which something was drawn, in
five seconds in which the camera goes around the scene, with all names shown; "with shadows" the same with them. Without
a graphics card the processor draws (SwiftShader).
"""

from __future__ import annotations

import argparse
import math
import os
import statistics
import threading
import time
from typing import Any

import numpy as np

from pat3d.studio.server import Studio, opened
from tests.studio.browser import page

GOALS = {"first paint": 2.0, "controls": 2.0, "frames": 30.0, "with shadows": 30.0}
"""[s], [s], a second, a second."""
SECONDS = 5.0

PAINT = "performance.getEntriesByName('first-contentful-paint')[0].startTime / 1000"
COUNTER = """
window.drawn = 0;
let calls = 0, before = 0;
for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...given) { calls += 1; return draw.apply(this, given); };
}
(function next() {
    if (calls !== before) { window.drawn += 1; before = calls; }
    requestAnimationFrame(next);
})();
"""


def measured(studio: Studio) -> dict[str, float]:
    """One visit of the page."""
    with page() as browser:
        browser.add_init_script(COUNTER)
        start = time.perf_counter()
        browser.goto(studio.address)
        browser.get_by_text("it does not move").wait_for()
        controls = time.perf_counter() - start
        # The meshes have arrived by then.
        browser.wait_for_timeout(4000)
        found = {"first paint": float(browser.evaluate(PAINT)), "controls": controls}
        found["frames"] = frames(studio, browser)
        browser.get_by_text("Shadows", exact=True).click()
        browser.wait_for_timeout(2000)
        found["with shadows"] = frames(studio, browser)
        browser.get_by_text("Shadows", exact=True).click()
        browser.wait_for_timeout(1000)
        return found


def frames(studio: Studio, browser: Any) -> float:
    """Drawn in a second while the camera goes around."""
    (client,) = studio.page.server.get_clients().values()
    middle = np.array(client.camera.look_at)
    away = np.array(client.camera.position) - middle
    ended = threading.Event()

    def turn() -> None:
        step = 0
        while not ended.wait(1 / 60):
            step += 1
            angle = 0.4 * math.sin(step / 40)
            sideways = np.array([-away[1], away[0], 0.0])
            flat = away * (1.0, 1.0, 0.0)
            client.camera.position = middle + away + (math.cos(angle) - 1.0) * flat + math.sin(angle) * sideways

    turning = threading.Thread(target=turn)
    turning.start()
    browser.wait_for_timeout(500)
    before, start = float(browser.evaluate("window.drawn")), time.perf_counter()
    browser.wait_for_timeout(1000 * SECONDS)
    drawn = (float(browser.evaluate("window.drawn")) - before) / (time.perf_counter() - start)
    ended.set()
    turning.join()
    return drawn


def main() -> None:
    """Visit several times and print medians."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="scene folder")
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    with opened(options.scene, port=0) as studio:
        visits = [measured(studio) for _ in range(options.repeats)]
    for name, goal in GOALS.items():
        values = sorted(one[name] for one in visits)
        print(f"{name}: median {statistics.median(values):.2f}, {values[0]:.2f} to {values[-1]:.2f} (goal {goal:g})")
    print(f"load of the machine: {os.getloadavg()[0]:.0f}")


if __name__ == "__main__":
    main()
