"""The page that browsers load: viser's, with a word while it loads, and less to draw without a graphics card."""

from __future__ import annotations

import gzip
from functools import lru_cache
from pathlib import Path

ROOT = '<div id="root"></div>'
"""What viser's page fills; it takes away what stands in it."""
LOADING = '<div id="root"><p style="font: 16px sans-serif; padding: 2em">The studio is loading.</p></div>'

PLAINER = """
<script>
(() => {
  const names = /swiftshader|llvmpipe|softpipe|software/i;
  const context = HTMLCanvasElement.prototype.getContext;
  let software = null;
  const drawnByProcessor = () => {
    const gl = context.call(document.createElement("canvas"), "webgl2");
    const info = gl && gl.getExtension("WEBGL_debug_renderer_info");
    const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
    if (gl) gl.getExtension("WEBGL_lose_context")?.loseContext();
    return names.test(name);
  };
  HTMLCanvasElement.prototype.getContext = function (kind, wishes) {
    if (kind !== "webgl2" || !wishes?.antialias) return context.call(this, kind, wishes);
    software ??= drawnByProcessor();
    return context.call(this, kind, software ? {...wishes, antialias: false} : wishes);
  };
})();
</script>
"""
"""Where the processor draws, edges are not smoothed: that takes a third of the time of a frame."""


@lru_cache(maxsize=1)
def page() -> bytes:
    """The page, compressed by gzip."""
    import viser

    html = (Path(viser.__file__).parent / "client" / "build" / "index.html").read_text(encoding="utf-8")
    return gzip.compress(html.replace("<head>", f"<head>{PLAINER}", 1).replace(ROOT, LOADING, 1).encode(), 1)
