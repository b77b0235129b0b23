// The sphere of directions: the surface of each method's density, its draws, and the directions one can drag.
import { $, colours, pressed, rgb } from "./page.js";
import { Columns, Points, program } from "./gl.js";
import { cameraOf, onSphere, seen, turnByDrag } from "./camera.js";
import { anglesOf, direction } from "./models.js";

const RINGS = 44, SECTORS = 96, MESH = (RINGS + 1) * (SECTORS + 1);
const LINES = 4096;

// positions are seen orthographically; uScale fits the sphere into the canvas
const PLACE = `
uniform vec3 uRight, uUp, uToward; uniform vec2 uScale;
vec4 place(vec3 p) { return vec4(uScale * vec2(dot(uRight, p), dot(uUp, p)), -0.4 * dot(uToward, p), 1.0); }`;
const COLUMNS = "layout(location = 0) in float x; layout(location = 1) in float y; layout(location = 2) in float z; layout(location = 3) in float w;";
const LINE = [`${PLACE} layout(location = 0) in vec3 p; out float front;
void main() { front = dot(uToward, p); gl_Position = place(p); }`,
`in float front; uniform vec4 uColour; out vec4 c;
void main() { c = uColour * vec4(1, 1, 1, front < -0.001 ? 0.35 : 1.0); c.rgb *= c.a; }`];
const DOTS = [`${PLACE} ${COLUMNS} uniform float uSize; out float front; out float left;
void main() { vec3 p = vec3(x, y, z); front = dot(uToward, p); left = w; gl_Position = place(p); gl_PointSize = w > 0.0 ? uSize : uSize * 1.3; }`,
`in float front; in float left; uniform vec4 uColour; out vec4 c;
void main() { float r = length(2.0 * gl_PointCoord - 1.0); if (r > 1.0 || (left == 0.0 && r < 0.45)) discard;
  c = uColour; c.a *= front < 0.0 ? 0.4 : 1.0; c.rgb *= c.a; }`];
const SURFACE = [`${PLACE} ${COLUMNS} uniform float uGain; out vec3 q;
void main() { q = uGain * w * vec3(x, y, z); gl_Position = place(q); }`,
`in vec3 q; uniform vec4 uColour; uniform vec3 uToward, uRight, uUp; out vec4 c;
void main() { vec3 n = normalize(cross(dFdx(q), dFdy(q))); if (dot(n, uToward) < 0.0) n = -n;
  float light = 0.5 + 0.5 * max(dot(n, normalize(uToward + 0.5 * uUp - 0.4 * uRight)), 0.0);
  c = vec4(uColour.rgb * light, 1.0) * uColour.a; }`];

function meshIndices() {
    const list = new Uint32Array(RINGS * SECTORS * 6), row = SECTORS + 1;
    let at = 0;
    for (let j = 0; j < RINGS; ++j)
        for (let k = 0; k < SECTORS; ++k) {
            const a = j * row + k;
            list.set([a, a + 1, a + row, a + 1, a + row + 1, a + row], at);
            at += 6;
        }
    return list;
}

export class SphereView {
    constructor(store, kernel) {
        this.store = store;
        this.kernel = kernel;
        this.canvas = $("sphere");
        this.peaks = [1, 1];
        const gl = this.gl = this.canvas.getContext("webgl2",
            { alpha: true, premultipliedAlpha: true, antialias: true });
        if (!gl) {
            $("sphere-note").textContent = "This browser has no WebGL2: the sphere stays empty, everything else works.";
        } else {
            this.setUp();
            this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
            this.canvas.addEventListener("webglcontextrestored", () => { this.setUp(); this.data(); this.draw(); });
        }
        turnByDrag(this.canvas, store, () => this.radius);
        this.handle();
        for (const which of ["a", "b", "both"])
            $(`show-${which}`).addEventListener("click", () => store.set({ show: which }));
    }

    setUp() {
        const { gl } = this;
        this.lineProgram = program(gl, ...LINE);
        this.dotProgram = program(gl, ...DOTS);
        this.surfaceProgram = program(gl, ...SURFACE);
        this.lines = new Points(gl, LINES);
        this.dots = [0, 1].map(() => new Columns(gl, this.kernel.rows));
        this.surfaces = [0, 1].map(() => new Columns(gl, MESH, meshIndices()));
    }

    /** The handle of the direction: drag it, or move it by keys. */
    handle() {
        const element = $("direction"), { store } = this;
        let front = true, held = false;
        element.addEventListener("pointerdown", (event) => {
            held = true;
            front = seen(cameraOf(store.state), this.wi())[2] >= 0;
            element.setPointerCapture(event.pointerId);
        });
        element.addEventListener("pointermove", (event) => {
            if (!held) return;
            const box = this.canvas.getBoundingClientRect();
            const x = (event.clientX - box.left - box.width / 2) / this.radius;
            const y = (box.top + box.height / 2 - event.clientY) / this.radius;
            const found = anglesOf(onSphere(cameraOf(store.state), x, y, front));
            store.set({ theta: Math.round(found.theta * 10) / 10, phi: Math.round(found.phi * 10) / 10 });
        });
        for (const end of ["pointerup", "pointercancel"]) element.addEventListener(end, () => { held = false; });
        element.addEventListener("keydown", (event) => {
            const step = event.shiftKey ? 10 : 1, { theta, phi } = store.state;
            const moves = {
                ArrowUp: { theta: Math.max(0, theta - step) }, ArrowDown: { theta: Math.min(180, theta + step) },
                ArrowLeft: { phi: (phi - step + 540) % 360 - 180 }, ArrowRight: { phi: (phi + step + 540) % 360 - 180 },
                Home: { theta: 0 }, End: { theta: 180 },
            };
            if (!(event.key in moves)) return;
            event.preventDefault();
            store.set(moves[event.key]);
        });
    }

    wi() {
        return direction(this.store.state.theta, this.store.state.phi);
    }

    shown(method) {
        const { show } = this.store.state;
        return show === "both" || show === "ab"[method];
    }

    /** Reads draws and densities from the library. */
    data() {
        if (!this.gl) return;
        const { kernel, store: { state } } = this;
        for (let method = 0; method < 2; ++method) {
            const { wo, pdf } = kernel.draws[method];
            this.dots[method].write([...wo, pdf], state.n);
            kernel.mesh(method, RINGS, SECTORS);
            this.surfaces[method].write([...kernel.query, kernel.answer[0]], MESH);
            this.peaks[method] = kernel.answer[0].subarray(0, MESH).reduce((a, b) => Math.max(a, b), 1e-30);
        }
        this.makeLines(state);
    }

    /** Segments: surface and meridians; then axis and directions. */
    makeLines(state) {
        const { data } = this.lines;
        let at = 0;
        const point = (v, s = 1) => {
            data[at++] = s * v[0];
            data[at++] = s * v[1];
            data[at++] = s * v[2];
        };
        const circle = (of, steps) => {
            for (let k = 0; k < steps; ++k) {
                point(of(2 * Math.PI * k / steps));
                point(of(2 * Math.PI * (k + 1) / steps));
            }
        };
        for (const z of [0.5, 0.866, -0.5, -0.866]) {
            const r = Math.sqrt(1 - z * z);
            circle((t) => [r * Math.cos(t), r * Math.sin(t), z], 90);
        }
        for (let k = 0; k < 6; ++k) {
            const c = Math.cos(k * Math.PI / 6), s = Math.sin(k * Math.PI / 6);
            circle((t) => [c * Math.cos(t), s * Math.cos(t), Math.sin(t)], 90);
        }
        this.faint = at / 3;
        circle((t) => [Math.cos(t), Math.sin(t), 0], 120);
        if (state.nt !== null) {
            const g = direction(state.nt, state.np), b = direction(90, state.np + 90), d = direction(90 + state.nt, state.np);
            circle((t) => [0, 1, 2].map((i) => Math.cos(t) * b[i] + Math.sin(t) * d[i]), 120);
            point([0, 0, 0]);
            point(g, 1.08);
        }
        for (const axis of [[0, 0, 1.08], [1.08, 0, 0], [0, 1.08, 0], this.wi()]) {
            point([0, 0, 0]);
            point(axis);
        }
        this.strong = at / 3 - this.faint;
        this.lines.write(at / 3);
    }

    /** Where the canvas is: pixels, radius of the sphere. */
    measure() {
        const { canvas } = this, scale = Math.min(devicePixelRatio || 1, 2);
        const w = canvas.clientWidth, h = canvas.clientHeight;
        const pw = Math.round(w * scale), ph = Math.round(h * scale);
        if (canvas.width !== pw || canvas.height !== ph) {
            canvas.width = pw;
            canvas.height = ph;
        }
        this.radius = 0.43 * Math.min(w, h * 1.04);
        return [w, h, scale];
    }

    use({ program: p, at }, camera, w, h) {
        const { gl } = this;
        gl.useProgram(p);
        gl.uniform3fv(at.uRight, camera.right);
        gl.uniform3fv(at.uUp, camera.up);
        gl.uniform3fv(at.uToward, camera.toward);
        gl.uniform2f(at.uScale, 2 * this.radius / w, 2 * this.radius / h);
        return (name, alpha) => gl.uniform4f(at.uColour, ...rgb(colours[name]), alpha);
    }

    draw() {
        const { gl, store: { state } } = this, camera = cameraOf(state);
        const [w, h, scale] = this.measure();
        this.placeTags(camera, w, h);
        for (const which of ["a", "b", "both"]) pressed(`show-${which}`, state.show === which);
        if (!gl || gl.isContextLost() || w === 0) return;
        gl.viewport(0, 0, this.canvas.width, this.canvas.height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        this.drawSurfaces(camera, w, h);
        this.drawLines(camera, w, h);
        this.drawDots(camera, w, h, scale);
    }

    drawSurfaces(camera, w, h) {
        const { gl } = this, colour = this.use(this.surfaceProgram, camera, w, h);
        const both = this.shown(0) && this.shown(1), { peaks } = this;
        // on one scale, the higher one last: the other shines through it
        const order = peaks[0] > peaks[1] ? [1, 0] : [0, 1], shown = order.filter((method) => this.shown(method));
        gl.uniform1f(this.surfaceProgram.at.uGain, 0.96 / peaks[shown[shown.length - 1]]);
        gl.enable(gl.DEPTH_TEST);
        for (const method of shown) {
            gl.clear(gl.DEPTH_BUFFER_BIT);
            // first where it is nearest, then its colour: no surface shines through itself
            gl.depthFunc(gl.LESS);
            gl.colorMask(false, false, false, false);
            colour("ab"[method], 1);
            this.surfaces[method].draw(gl.TRIANGLES);
            gl.colorMask(true, true, true, true);
            gl.depthFunc(gl.LEQUAL);
            colour("ab"[method], both && method === order[1] ? 0.38 : 0.85);
            this.surfaces[method].draw(gl.TRIANGLES);
        }
        gl.disable(gl.DEPTH_TEST);
    }

    drawLines(camera, w, h) {
        const { gl } = this, colour = this.use(this.lineProgram, camera, w, h);
        gl.bindVertexArray(this.lines.array);
        colour("soft", 0.22);
        gl.drawArrays(gl.LINES, 0, this.faint);
        colour("ink", 0.75);
        gl.drawArrays(gl.LINES, this.faint, this.strong);
    }

    drawDots(camera, w, h, scale) {
        const { gl, store: { state: { n } } } = this, colour = this.use(this.dotProgram, camera, w, h);
        const size = n > 16384 ? 1.3 : n > 2048 ? 2 : n > 256 ? 3 : 5;
        gl.uniform1f(this.dotProgram.at.uSize, size * scale * Math.max(1, this.radius / 240));
        for (let method = 0; method < 2; ++method) {
            if (!this.shown(method)) continue;
            colour("ab"[method], n > 16384 ? 0.5 : 0.75);
            this.dots[method].draw(gl.POINTS);
        }
    }

    placeTags(camera, w, h) {
        const { state } = this.store;
        const place = (id, v, s) => {
            const p = seen(camera, v), element = $(id);
            element.style.transform = `translate(${(w / 2 + s * p[0] * this.radius).toFixed(1)}px, ${(h / 2 - s * p[1] * this.radius).toFixed(1)}px)`
                + (id === "direction" ? "" : " translate(-50%, -50%)");
            return p[2];
        };
        place("tag-z", [0, 0, 1], 1.15);
        place("tag-x", [1, 0, 0], 1.15);
        place("tag-y", [0, 1, 0], 1.15);
        $("tag-g").hidden = state.nt === null;
        if (state.nt !== null) place("tag-g", direction(state.nt, state.np), 1.15);
        const handle = $("direction");
        handle.classList.toggle("behind", place("direction", this.wi(), 1) < 0);
        handle.setAttribute("aria-valuenow", String(Math.round(state.theta)));
        handle.setAttribute("aria-valuetext", `theta ${Math.round(state.theta * 10) / 10}°, phi ${Math.round(state.phi * 10) / 10}°`);
    }
}
