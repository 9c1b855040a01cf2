"use strict";
// Draws the scene of the JSON element above with WebGL 2: one shadow map, one pass, and one pass of a pixel to pick.
(async () => {
  const $ = (id) => document.getElementById(id);
  const scene = JSON.parse($("scene").textContent);
  const canvas = $("view");
  const fail = (text) => { $("trouble").textContent = text; $("trouble").hidden = false; };

  $("title").textContent = scene.title;
  $("version").textContent = scene.version;
  let chosen = -1, pointed = -1, dirty = true;
  const buttons = scene.objects.map((object, index) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = object.name;
    button.setAttribute("aria-pressed", "false");
    button.onclick = () => select(chosen === index ? -1 : index);
    button.onmouseenter = () => { pointed = index; dirty = true; };
    button.onmouseleave = () => { pointed = -1; dirty = true; };
    $("objects").appendChild(document.createElement("li")).appendChild(button);
    return button;
  });
  function select(index) {
    chosen = index;
    buttons.forEach((button, other) => button.setAttribute("aria-pressed", String(other === index)));
    $("facts").replaceChildren();
    $("facts").hidden = index < 0;
    for (const [name, value] of index < 0 ? [] : scene.objects[index].facts) {
      $("facts").appendChild(document.createElement("dt")).textContent = name;
      $("facts").appendChild(document.createElement("dd")).textContent = value;
    }
    if (index >= 0) buttons[index].scrollIntoView({ block: "nearest" });
    dirty = true;
  }
  const said = [...scene.relations, ...scene.history.map((edit) => "edit: " + edit)];
  for (const line of said) $("said").querySelector("ul").appendChild(document.createElement("li")).textContent = line;
  $("said").hidden = said.length === 0;

  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return fail("This browser has no WebGL 2, so the scene cannot be drawn. The list on the side is complete.");
  if (typeof DecompressionStream === "undefined") return fail("This browser is too old to unpack the scene.");

  // Matrices are columns of four, as WebGL takes them.
  const multiply = (a, b) => {
    const out = new Float32Array(16);
    for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += a[k * 4 + r] * b[c * 4 + k];
      out[c * 4 + r] = sum;
    }
    return out;
  };
  const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = (a) => { const length = Math.hypot(...a) || 1; return a.map((value) => value / length); };
  function lookAt(eye, target, up) {
    const z = unit(subtract(eye, target)), x = unit(cross(up, z)), y = cross(z, x);
    return new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
      -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
  }
  function perspective(angle, aspect, near, far) {
    const f = 1 / Math.tan(angle / 2);
    return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1,
      0, 0, 2 * far * near / (near - far), 0]);
  }
  const orthographic = (half, near, far) => new Float32Array([1 / half, 0, 0, 0, 0, 1 / half, 0, 0,
    0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1]);
  function rotation(w, x, y, z) {
    return [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
      2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
      2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)];
  }
  function placement(pose) {
    const r = rotation(...pose.slice(3));
    return new Float32Array([r[0], r[1], r[2], 0, r[3], r[4], r[5], 0, r[6], r[7], r[8], 0, pose[0], pose[1], pose[2], 1]);
  }

  function program(vertex, fragment) {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, "#version 300 es\nprecision highp float;precision highp int;precision highp sampler2DShadow;\n" + source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    gl.bindAttribLocation(made, 0, "position");
    gl.bindAttribLocation(made, 1, "normal");
    gl.bindAttribLocation(made, 2, "uv");
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const at = {};
    for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); i++) {
      const name = gl.getActiveUniform(made, i).name;
      at[name] = gl.getUniformLocation(made, name);
    }
    return { made, at };
  }
  const VERTEX = `
    in vec4 position; in vec4 normal; in vec2 uv;
    uniform mat4 camera, place, light; uniform vec3 low, span;
    out vec3 world, direction; out vec2 texel; out vec4 lit;
    void main() {
      vec4 at = place * vec4(low + span * position.xyz, 1.0);
      world = at.xyz; direction = mat3(place) * normal.xyz; texel = vec2(uv.x, 1.0 - uv.y);
      lit = light * at; gl_Position = camera * at;
    }`;
  const SHADOW = `
    uniform sampler2DShadow shadow; in vec4 lit;
    float shade(float bias) {
      vec3 at = lit.xyz / lit.w * 0.5 + 0.5;
      if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
      float sum = 0.0, texel = 1.0 / 2048.0;
      for (int i = -2; i <= 2; i++) for (int j = -2; j <= 2; j++)
        sum += texture(shadow, vec3(at.xy + vec2(i, j) * texel * 1.3, at.z - bias));
      return sum / 25.0;
    }`;
  const solid = program(VERTEX, SHADOW + `
    in vec3 world, direction; in vec2 texel; out vec4 colour;
    uniform sampler2D picture; uniform vec3 sun, eye; uniform float marked;
    void main() {
      vec3 n = normalize(direction), view = normalize(eye - world);
      if (dot(n, view) < 0.0) n = reflect(n, view);
      vec3 base = pow(texture(picture, texel).rgb, vec3(2.2));
      float key = max(dot(n, sun), 0.0) * shade(0.0015);
      float sky = 0.5 + 0.5 * n.z, fill = max(dot(n, normalize(vec3(view.xy, 0.4))), 0.0);
      vec3 light = vec3(1.0, 0.97, 0.92) * key * 1.25 + mix(vec3(0.32, 0.3, 0.28), vec3(0.58, 0.61, 0.66), sky) * 0.8 + 0.18 * fill;
      float gleam = pow(max(dot(n, normalize(sun + view)), 0.0), 48.0) * key * 0.12;
      vec3 out_colour = base * light + gleam;
      out_colour = mix(out_colour, vec3(0.05, 0.35, 0.9), marked * (0.12 + 0.6 * pow(1.0 - max(dot(n, view), 0.0), 2.0)));
      colour = vec4(pow(out_colour / (1.0 + 0.18 * out_colour), vec3(1.0 / 2.2)), 1.0);
    }`);
  const floor = program(`
    in vec4 position; uniform mat4 camera, light; uniform vec3 middle; uniform float reach;
    out vec3 world; out vec4 lit;
    void main() { world = vec3(middle.xy + position.xy * reach, 0.0); lit = light * vec4(world, 1.0); gl_Position = camera * vec4(world, 1.0); }`,
    SHADOW + `
    in vec3 world; out vec4 colour; uniform vec3 middle; uniform float reach;
    void main() {
      float fade = 1.0 - smoothstep(0.35, 1.0, length(world.xy - middle.xy) / reach);
      colour = vec4(vec3(0.06, 0.07, 0.1), (1.0 - shade(0.0008)) * 0.42 * fade + 0.03 * fade);
    }`);
  const depth = program(VERTEX, "void main() {}");
  const pick = program(VERTEX, "out vec4 colour; uniform vec4 name; void main() { colour = name; }");

  async function unpack(text) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Response(stream).arrayBuffer();
  }
  async function upload(mesh) {
    const data = await unpack(mesh.data), n = mesh.count;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Uint8Array(data, 0, 16 * n), gl.STATIC_DRAW);
    for (const [place, size, kind, begin] of [[0, 4, gl.UNSIGNED_SHORT, 0], [1, 4, gl.BYTE, 8 * n], [2, 2, gl.UNSIGNED_SHORT, 12 * n]]) {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, kind, true, 0, begin);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint8Array(data, 16 * n, 4 * mesh.corners), gl.STATIC_DRAW);
    const image = new Image();
    image.src = mesh.texture;
    await image.decode();
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    // Palettes have blocks of four texels, which smaller levels would mix.
    const small = Math.max(image.width, image.height) <= 64;
    if (!small) gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, small ? gl.LINEAR : gl.LINEAR_MIPMAP_LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return { ...mesh, array, texture };
  }
  const meshes = [];
  for (const mesh of scene.meshes) meshes.push(await upload(mesh));
  const places = { pose: scene.objects.map((one) => placement(one.pose)), initial: scene.objects.map((one) => placement(one.initial)) };
  let now = "pose";

  const quad = gl.createVertexArray();
  gl.bindVertexArray(quad);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);

  // The box around everything, for the camera and the light.
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  scene.objects.forEach((object, index) => {
    const mesh = meshes[object.mesh], m = places.pose[index];
    for (let corner = 0; corner < 8; corner++) {
      const p = [0, 1, 2].map((k) => mesh.low[k] + (corner >> k & 1) * mesh.span[k]);
      for (let k = 0; k < 3; k++) {
        const value = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
        low[k] = Math.min(low[k], value); high[k] = Math.max(high[k], value);
      }
    }
  });
  const middle = low.map((value, k) => (value + high[k]) / 2);
  const radius = Math.max(0.02, Math.hypot(...subtract(high, low)) / 2);
  const sun = unit([-0.45, -0.55, 1.0]);
  const lightView = multiply(orthographic(1.3 * radius, 0.1 * radius, 8 * radius),
    lookAt(middle.map((value, k) => value + 4 * radius * sun[k]), middle, [0, 1, 0]));
  const map = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, map);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.DEPTH_COMPONENT24, 2048, 2048, 0, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT, null);
  for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE], [gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
  const dark = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, dark);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, map, 0);
  let shadowOf = "";

  const ANGLE = 0.6;
  const camera = {};
  function home() {
    Object.assign(camera, { yaw: -0.5, pitch: 0.5, distance: 1.15 * radius / Math.sin(ANGLE / 2), target: middle.slice() });
    dirty = true;
  }
  home();
  $("home").onclick = home;
  $("initial").onchange = (event) => { now = event.target.checked ? "initial" : "pose"; dirty = true; };
  const eye = () => [
    camera.target[0] + camera.distance * Math.cos(camera.pitch) * Math.sin(camera.yaw),
    camera.target[1] - camera.distance * Math.cos(camera.pitch) * Math.cos(camera.yaw),
    camera.target[2] + camera.distance * Math.sin(camera.pitch)];
  function view() {
    const aspect = canvas.width / canvas.height;
    // A narrow window sees as much from side to side as a wide one from top to bottom.
    const angle = aspect >= 1 ? ANGLE : 2 * Math.atan(Math.tan(ANGLE / 2) / aspect);
    return multiply(perspective(angle, aspect, camera.distance * 0.02, camera.distance + 30 * radius), lookAt(eye(), camera.target, [0, 0, 1]));
  }
  function drawObjects(used, seen, each) {
    gl.useProgram(used.made);
    gl.uniformMatrix4fv(used.at.camera, false, seen);
    if (used.at.light) gl.uniformMatrix4fv(used.at.light, false, lightView);
    scene.objects.forEach((object, index) => {
      const mesh = meshes[object.mesh];
      gl.uniformMatrix4fv(used.at.place, false, places[now][index]);
      gl.uniform3fv(used.at.low, mesh.low);
      gl.uniform3fv(used.at.span, mesh.span);
      each(index, mesh);
      gl.bindVertexArray(mesh.array);
      gl.drawElements(gl.TRIANGLES, mesh.corners, gl.UNSIGNED_INT, 0);
    });
  }
  function draw() {
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    if (shadowOf !== now) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, dark);
      gl.viewport(0, 0, 2048, 2048);
      gl.clear(gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(2, 4);
      drawObjects(depth, lightView, () => {});
      gl.disable(gl.POLYGON_OFFSET_FILL);
      shadowOf = now;
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.957, 0.957, 0.949, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const seen = view();
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, map);
    gl.activeTexture(gl.TEXTURE0);
    drawObjects(solid, seen, (index, mesh) => {
      gl.uniform1i(solid.at.picture, 0);
      gl.uniform1i(solid.at.shadow, 1);
      gl.uniform3fv(solid.at.sun, sun);
      gl.uniform3fv(solid.at.eye, eye());
      gl.uniform1f(solid.at.marked, index === chosen ? 1 : index === pointed ? 0.6 : 0);
      gl.bindTexture(gl.TEXTURE_2D, mesh.texture);
    });
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(floor.made);
    gl.uniformMatrix4fv(floor.at.camera, false, seen);
    gl.uniformMatrix4fv(floor.at.light, false, lightView);
    gl.uniform3fv(floor.at.middle, middle);
    gl.uniform1f(floor.at.reach, 3 * radius);
    gl.uniform1i(floor.at.shadow, 1);
    gl.bindVertexArray(quad);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }
  function frame() {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * scale)), height = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; dirty = true; }
    if (dirty) { dirty = false; draw(); }
    requestAnimationFrame(frame);
  }
  function objectAt(x, y) {
    const box = canvas.getBoundingClientRect();
    const scaleX = canvas.width / box.width, scaleY = canvas.height / box.height;
    const target = gl.createFramebuffer(), colour = gl.createRenderbuffer(), far = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, colour);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, canvas.width, canvas.height);
    gl.bindRenderbuffer(gl.RENDERBUFFER, far);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, canvas.width, canvas.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, colour);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, far);
    const px = Math.floor((x - box.left) * scaleX), py = canvas.height - 1 - Math.floor((y - box.top) * scaleY);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(px, py, 1, 1);
    gl.disable(gl.BLEND);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    drawObjects(pick, view(), (index) => {
      const name = index + 1;
      gl.uniform4f(pick.at.name, (name & 255) / 255, (name >> 8 & 255) / 255, (name >> 16 & 255) / 255, 1);
    });
    const found = new Uint8Array(4);
    gl.readPixels(px, py, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, found);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    for (const buffer of [colour, far]) gl.deleteRenderbuffer(buffer);
    gl.deleteFramebuffer(target);
    return found[0] + 256 * found[1] + 65536 * found[2] - 1;
  }

  const pointers = new Map();
  let travelled = 0, pinch = 0;
  function shift(dx, dy) {
    const z = unit(subtract(eye(), camera.target)), x = unit(cross([0, 0, 1], z)), y = cross(z, x);
    const step = 2 * camera.distance * Math.tan(ANGLE / 2) / canvas.clientHeight;
    camera.target = camera.target.map((value, k) => value + step * (-dx * x[k] + dy * y[k]));
  }
  function turn(dx, dy) {
    camera.yaw -= dx * 0.008;
    camera.pitch = Math.min(1.55, Math.max(-0.2, camera.pitch + dy * 0.008));
  }
  function zoom(factor) { camera.distance = Math.min(40 * radius, Math.max(0.05 * radius, camera.distance * factor)); }
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    travelled = 0; pinch = 0;
  };
  canvas.onpointermove = (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1];
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    travelled += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
      const [a, b] = [...pointers.values()], span = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (pinch) zoom(pinch / span);
      pinch = span;
      shift(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons & 6) shift(dx, dy);
    else turn(dx, dy);
    dirty = true;
  };
  canvas.onpointerup = canvas.onpointercancel = (event) => {
    if (event.type === "pointerup" && pointers.size === 1 && travelled < 4) select(objectAt(event.clientX, event.clientY));
    pointers.delete(event.pointerId);
    dirty = true;
  };
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(event.deltaY * 0.001)); dirty = true; }, { passive: false });
  canvas.onkeydown = (event) => {
    const keys = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, 20], ArrowDown: [0, -20] };
    if (keys[event.key]) turn(...keys[event.key]);
    else if (event.key === "+" || event.key === "=") zoom(0.9);
    else if (event.key === "-") zoom(1.1);
    else if (event.key === "Escape") select(-1);
    else return;
    event.preventDefault();
    dirty = true;
  };
  canvas.addEventListener("webglcontextlost", () => fail("The graphics driver stopped; reload the page."));
  new ResizeObserver(() => { dirty = true; }).observe(canvas);
  frame();
  document.documentElement.dataset.drawn = "yes";
})().catch((error) => { const box = document.getElementById("trouble"); box.textContent = "The scene cannot be drawn: " + error.message; box.hidden = false; });
