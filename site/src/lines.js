// Many lines by WebGL 2: a canvas strokes sixty thousand edges slower than they are triangulated.

const VERTEX = `#version 300 es
in vec2 place; uniform vec2 size;
void main() { vec2 p = place / size * 2.0 - 1.0; gl_Position = vec4(p.x, -p.y, 0, 1); }`;
const FRAGMENT = `#version 300 es
precision mediump float; uniform vec4 colour; out vec4 shown;
void main() { shown = colour; }`;

/** A drawer of edges on a canvas of its own behind another one; it says whether it can: without WebGL 2 it cannot. */
export function lines(front) {
  let draw;
  // Begun when it is needed: a page has room for few of them.
  return (made, coords, size) => {
    if (draw === undefined && made) draw = begin(front) ?? null;
    draw?.(made, coords, size);
    return Boolean(draw);
  };
}

function begin(front) {
  const canvas = document.createElement("canvas");
  const gl = canvas.getContext("webgl2", {antialias: true, premultipliedAlpha: true});
  if (!gl) return undefined;
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "place");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return undefined;
  gl.useProgram(program);
  const both = document.createElement("div");
  both.className = "layers";
  front.replaceWith(both);
  canvas.setAttribute("aria-hidden", "true");
  both.append(canvas, front);
  const [size, colour] = ["size", "colour"].map((name) => gl.getUniformLocation(program, name));
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  let places = new Float32Array(0);
  let indices = new Uint32Array(0);

  /** Draws all edges of a triangulation in a colour "#rrggbb"; without one it takes away what was drawn. */
  return (made, coords, {width, height, worldWidth, worldHeight, colour: shade, alpha = 1}) => {
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!made) return;
    const {triangles, halfedges} = made;
    if (places.length < coords.length) places = new Float32Array(coords.length);
    if (indices.length < 2 * triangles.length) indices = new Uint32Array(2 * triangles.length);
    places.set(coords);
    let count = 0;
    for (let e = 0; e < triangles.length; e++) {
      if (halfedges[e] > e) continue;
      indices[count++] = triangles[e];
      indices[count++] = triangles[e % 3 === 2 ? e - 2 : e + 1];
    }
    gl.uniform2f(size, worldWidth, worldHeight);
    const part = (k) => parseInt(shade.slice(1 + 2 * k, 3 + 2 * k), 16) / 255;
    gl.uniform4f(colour, part(0) * alpha, part(1) * alpha, part(2) * alpha, alpha);
    gl.bufferData(gl.ARRAY_BUFFER, places.subarray(0, coords.length), gl.STREAM_DRAW);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices.subarray(0, count), gl.STREAM_DRAW);
    gl.drawElements(gl.LINES, count, gl.UNSIGNED_INT, 0);
  };
}
