r"""First paint and frame rate of the studio in headless Chromium.

    pat3d generate "a stack of three books, a vase, a red mug, a bowl with two apples and a laptop on a desk" \
        --out scenes/ten
    python benchmarks/studio.py scenes/ten [--repeats 5]

Needs Chromium and `pip install 'pat3d[studio]' playwright`. "first paint" is the browser's own first-contentful-paint,
"controls" when the panel can be used, both from the navigation on. Frames are counted for three seconds by
requestAnimationFrame while the camera is turned with the mouse, the scene and all names shown. Without a graphics card
the processor draws them (SwiftShader).
"""

from __future__ import annotations

import argparse
import statistics
import time

from pat3d.studio.server import opened
from tests.studio.browser import HEIGHT, WIDTH, page

GOALS = {"first paint": 2.0, "controls": 2.0, "frames": 30.0}
"""[s], [s], a second."""
SECONDS = 3.0

PAINT = "performance.getEntriesByName('first-contentful-paint')[0].startTime / 1000"
COUNT = """seconds => new Promise(done => {
    let frames = 0; const start = performance.now();
    function next(now) {
        frames += 1;
        if (now - start > 1000 * seconds) done(1000 * frames / (now - start)); else requestAnimationFrame(next);
    }
    requestAnimationFrame(next);
})"""


def measured(address: str) -> dict[str, float]:
    """One visit of the page."""
    with page() as browser:
        start = time.perf_counter()
        browser.goto(address)
        browser.get_by_text("it does not move").wait_for()
        controls = time.perf_counter() - start
        # The meshes have arrived by then.
        browser.wait_for_timeout(3000)
        paint = float(browser.evaluate(PAINT))
        browser.evaluate(f"window.counted = ({COUNT})({SECONDS})")
        browser.mouse.move(WIDTH / 3, HEIGHT / 2)
        browser.mouse.down()
        end = time.perf_counter() + SECONDS
        step = 0
        while time.perf_counter() < end:
            step += 1
            browser.mouse.move(WIDTH / 3 + 40 * (step % 2), HEIGHT / 2)
            browser.wait_for_timeout(30)
        browser.mouse.up()
        return {"first paint": paint, "controls": controls, "frames": float(browser.evaluate("window.counted"))}


def main() -> None:
    """Visit several times and print medians."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="scene folder")
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    with opened(options.scene, port=0) as studio:
        visits = [measured(studio.address) for _ in range(options.repeats)]
    for name, goal in GOALS.items():
        values = sorted(one[name] for one in visits)
        print(f"{name}: median {statistics.median(values):.2f}, {values[0]:.2f} to {values[-1]:.2f} (goal {goal:g})")


if __name__ == "__main__":
    main()
