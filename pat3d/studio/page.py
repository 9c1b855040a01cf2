"""The page that browsers load: viser's, with a word while it loads, and less to draw without a graphics card."""

from __future__ import annotations

import gzip
from functools import lru_cache
from pathlib import Path

ROOT = '<div id="root"></div>'
"""What viser's page fills; it takes away what stands in it."""
LOADING = '<div id="root"><p style="font: 16px sans-serif; padding: 2em">The studio is loading.</p></div>'

PLAINER = r"""
<script>
(() => {
  const names = /swiftshader|llvmpipe|softpipe|software/i;
  const context = HTMLCanvasElement.prototype.getContext;
  const { shaderSource, texParameteri } = WebGL2RenderingContext.prototype;
  let software = null;
  const drawnByProcessor = () => {
    const gl = context.call(document.createElement("canvas"), "webgl2");
    const info = gl && gl.getExtension("WEBGL_debug_renderer_info");
    const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
    if (gl) gl.getExtension("WEBGL_lose_context")?.loseContext();
    return names.test(name);
  };
  const given = `const in vec3 position, const in vec3 normal, const in vec3 view, const in vec3 coat,
    const in PhysicalMaterial material, inout ReflectedLight reflected`;
  const matt = `
    void mattDirect(const in IncidentLight light, ${given}) {
      vec3 irradiance = saturate(dot(normal, light.direction)) * light.color;
      reflected.directDiffuse += irradiance * BRDF_Lambert(material.diffuseColor);
    }
    void mattIndirect(const in vec3 irradiance, ${given}) {
      reflected.indirectDiffuse += irradiance * BRDF_Lambert(material.diffuseColor);
    }
    #define RE_Direct mattDirect
    #define RE_IndirectDiffuse mattIndirect
  `;
  const plainer = (text) => /#define USE_(ENVMAP|SHADOWMAP)\b/.test(text) ? text : text
    .replace(/#define RE_Indirect(Diffuse|Specular)\s+\w+_Physical/g, "")
    .replace(/#define RE_Direct\s+RE_Direct_Physical/, matt);
  HTMLCanvasElement.prototype.getContext = function (kind, wishes) {
    if (kind !== "webgl2" || !wishes?.antialias) return context.call(this, kind, wishes);
    software ??= drawnByProcessor();
    return context.call(this, kind, software ? {...wishes, antialias: false} : wishes);
  };
  WebGL2RenderingContext.prototype.shaderSource = function (shader, text) {
    return shaderSource.call(this, shader, software ? plainer(text) : text);
  };
  WebGL2RenderingContext.prototype.texParameteri = function (target, name, value) {
    const finest = software && value === this.LINEAR_MIPMAP_LINEAR;
    return texParameteri.call(this, target, name, finest ? this.LINEAR_MIPMAP_NEAREST : value);
  };
})();
</script>
"""
"""Where the processor draws: edges are not smoothed, and without shadows and reflections nothing shines.

The light is three.js's own diffuse term, and a texture is read from one of its sizes, not from two.
"""


@lru_cache(maxsize=1)
def page() -> bytes:
    """The page, compressed by gzip."""
    import viser

    html = (Path(viser.__file__).parent / "client" / "build" / "index.html").read_text(encoding="utf-8")
    return gzip.compress(html.replace("<head>", f"<head>{PLAINER}", 1).replace(ROOT, LOADING, 1).encode(), 1)
