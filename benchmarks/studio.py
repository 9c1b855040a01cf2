r"""First paint and frame rate of the studio in headless Chromium, and what a frame costs whom.

    pat3d generate "a stack of three books, a vase, a red mug, a bowl with two apples and a laptop on a desk" \
        --out scenes/ten
    python -m benchmarks.studio scenes/ten [--repeats 5]

Needs Chromium and `pip install 'pat3d[studio]' playwright`. From the navigation on: "first paint" is the browser's own
first-contentful-paint (a word that the studio is loading), "controls" when the panel can be used. Then the mouse turns
the scene for five seconds or longer, with all names shown, without and with shadows and reflections. "frames" are
those in which something was drawn. Of a frame: "page" is the processor time of the page's process, "script" that of
JavaScript in it, which a computer with a graphics card spends too; "drawing" is the processor time of the process that
draws, here without a graphics card (SwiftShader), and "calls" and "triangles" are what it is asked to draw. "width" is
that of the picture: viser draws fewer pixels and enlarges them where a page is slow.
"""

from __future__ import annotations

import argparse
import math
import os
import statistics
import time
from collections import Counter
from collections.abc import Mapping
from typing import Any

from pat3d.studio.server import opened
from tests.studio.browser import HEIGHT, WIDTH, page

UNITS = {
    "first paint": "s",
    "controls": "s",
    "frames": "a second",
    "page": "ms a frame",
    "script": "ms a frame",
    "drawing": "ms a frame",
    "calls": "a frame",
    "triangles": "a frame",
    "messages": "a frame",
    "width": "pixels",
}
GOALS = {"first paint": 2.0, "frames": 30.0}
RICH = " with shadows"
SECONDS, LONGEST, FEWEST = 5.0, 60.0, 10
"""[s] that the mouse turns the scene, at least and at most, and frames that are enough."""

PAINT = "performance.getEntriesByName('first-contentful-paint')[0].startTime / 1000"
DRAWN = "document.querySelector('canvas[data-engine]').width"
COUNTER = """
window.counted = {frames: 0, calls: 0, triangles: 0};
let before = 0;
for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...given) {
        window.counted.calls += 1;
        const corners = given[name.startsWith('drawElements') ? 1 : 2];
        const instances = name.endsWith('Instanced') ? given[given.length - 1] : 1;
        if (given[0] === this.TRIANGLES) window.counted.triangles += corners * instances / 3;
        return draw.apply(this, given);
    };
}
(function next() {
    if (window.counted.calls !== before) { window.counted.frames += 1; before = window.counted.calls; }
    requestAnimationFrame(next);
})();
"""


class Visit:
    """One page that is open."""

    def __init__(self, browser: Any, address: str) -> None:
        """Load `address` into the page `browser`."""
        self._page = browser
        self._messages = 0
        browser.on("websocket", self._listen)
        browser.add_init_script(COUNTER)
        self._system = browser.context.browser.new_browser_cdp_session()
        self._main = browser.context.new_cdp_session(browser)
        self._main.send("Performance.enable", {"timeDomain": "threadTicks"})
        start = time.perf_counter()
        browser.goto(address)
        browser.get_by_text("it does not move").wait_for()
        controls = time.perf_counter() - start
        self.loading = {"first paint": float(browser.evaluate(PAINT)), "controls": controls}
        # The meshes have arrived by then.
        browser.wait_for_timeout(4000)

    def turned(self) -> dict[str, float]:
        """What frames cost while the mouse turns the scene."""
        mouse, x, y = self._page.mouse, 0.12 * WIDTH, 0.75 * HEIGHT
        mouse.move(x, y)
        mouse.down()
        mouse.move(x + 5, y)
        self._page.wait_for_timeout(1000)
        before, start, step = self._state(), time.perf_counter(), 0
        after, end, last = before, start + SECONDS, start + LONGEST
        # A busy machine takes longer to draw enough frames for a mean.
        while after["frames"] - before["frames"] < FEWEST and time.perf_counter() < last:
            while time.perf_counter() < end:
                step += 1
                mouse.move(x + 0.1 * WIDTH * math.sin(step / 20), y + 0.05 * HEIGHT * math.sin(step / 31))
            after, end = self._state(), end + SECONDS
        seconds, frames = time.perf_counter() - start, after["frames"] - before["frames"]
        mouse.up()
        if not frames:
            raise TimeoutError(f"nothing was drawn in {seconds:.0f} s: the machine is too busy to measure.")
        each = {name: (value - before[name]) / frames for name, value in after.items()}
        return {**each, "frames": frames / seconds, "width": float(self._page.evaluate(DRAWN))}

    def shadows(self) -> None:
        """Switch shadows and reflections on or off."""
        self._page.get_by_text("Shadows, reflections", exact=True).click()
        self._page.wait_for_timeout(3000)

    def _listen(self, socket: Any) -> None:
        def count(_: Any) -> None:
            self._messages += 1

        socket.on("framesent", count)
        socket.on("framereceived", count)

    def _state(self) -> dict[str, float]:
        seconds: Counter[str] = Counter()
        for one in self._system.send("SystemInfo.getProcessInfo")["processInfo"]:
            seconds[one["type"]] += one["cpuTime"]
        main = {one["name"]: one["value"] for one in self._main.send("Performance.getMetrics")["metrics"]}
        return {
            **self._page.evaluate("window.counted"),
            "page": 1e3 * seconds["renderer"],
            "script": 1e3 * main["ScriptDuration"],
            "drawing": 1e3 * seconds["GPU"],
            "messages": self._messages,
        }


def measured(address: str) -> Mapping[str, float]:
    """One visit of the page, a figure for each name."""
    with page() as browser:
        visit = Visit(browser, address)
        plain = visit.turned()
        visit.shadows()
        rich = {f"{name}{RICH}": value for name, value in visit.turned().items()}
        visit.shadows()
        return {**visit.loading, **plain, **rich}


def main() -> None:
    """Visit several times and print medians."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", help="scene folder")
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    loads, visits = [], []
    with opened(options.scene, port=0) as studio:
        for _ in range(options.repeats):
            visits.append(measured(studio.address))
            loads.append(os.getloadavg()[0])
    for name in visits[0]:
        values, what = sorted(one[name] for one in visits), name.removesuffix(RICH)
        goal = f" (goal {GOALS[what]:g})" if what in GOALS else ""
        print(
            f"{name}: median {statistics.median(values):.4g} {UNITS[what]}, {values[0]:.4g} to {values[-1]:.4g}{goal}"
        )
    print(f"load of the machine: {min(loads):.0f} to {max(loads):.0f}")


if __name__ == "__main__":
    main()
