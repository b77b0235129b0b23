// Stretched space on the unit sphere: the region of reflections that leave the surface, caps, draws.
import { $, colours } from "./page.js";
import { Sheet, word } from "./canvas.js";
import { cameraOf, dot, seen, turnByDrag } from "./camera.js";
import { direction } from "./models.js";

export const CAPS = ["caps", "bounded", "optimal"];
const TITLES = { caps: "previous cap", bounded: "bounded cap", optimal: "optimal cap" };
const DASHES = { caps: [7, 4], bounded: [], optimal: [9, 3, 2, 3] };

/** A cap of method A or B has that method's colour; the others stay in the background. */
export function capPen(state, cap) {
    const own = state.a === cap ? "a" : state.b === cap ? "b" : null;
    return { title: TITLES[cap], own, colour: colours[own ?? "soft"], width: own ? 2.4 : 1.2, dash: DASHES[cap] };
}

/** Entries of a legend: text with a line of the colour beside it. */
export function legend(id, entries) {
    const key = JSON.stringify(entries);
    if ($(id).dataset.key === key) return;
    $(id).dataset.key = key;
    $(id).replaceChildren(...entries.map(({ title, colour, dashed }) => {
        const item = document.createElement("span"), line = document.createElement("span");
        item.className = "item";
        line.className = "swatch";
        line.style.borderTopColor = colour;
        if (dashed) line.style.borderTopStyle = "dashed";
        item.append(line, title);
        return item;
    }));
}

export const hasCaps = (state) => state.ndf === "ggx" && state.masking === "smith";

export class StretchedView {
    constructor(store, kernel, models) {
        Object.assign(this, { store, kernel, models, sheet: new Sheet($("stretched")) });
        turnByDrag($("stretched"), store, () => this.radius);
    }

    draw() {
        const { sheet, store: { state } } = this, [w, h] = sheet.begin();
        this.radius = (Math.min(w, h) / 2 - 0.7 * colours.size) / 1.08;
        this.camera = cameraOf(state);
        this.at = (v) => {
            const p = seen(this.camera, v);
            return [w / 2 + this.radius * p[0], h / 2 - this.radius * p[1], p[2]];
        };
        this.outline(w, h);
        this.region(state);
        this.dots(state);
        this.curves(state);
        this.arrows();
    }

    outline(w, h) {
        const c = this.sheet.context;
        c.beginPath();
        c.arc(w / 2, h / 2, this.radius, 0, 2 * Math.PI);
        c.fillStyle = colours.faint;
        c.fill();
        c.strokeStyle = colours.line;
        c.lineWidth = 1;
        c.stroke();
        this.circle((t) => [Math.cos(t), Math.sin(t), 0], { colour: colours.line, width: 1 });
    }

    circle(of, pen) {
        const points = Array.from({ length: 121 }, (_, k) => this.at(of(k * Math.PI / 60)));
        this.curve(points, pen);
    }

    /** What is behind the sphere is fainter. */
    curve(points, pen) {
        const c = this.sheet.context;
        for (const front of [false, true]) {
            c.globalAlpha = front ? 1 : 0.35;
            this.sheet.line(points.length, (k) => (points[k][2] >= 0) === front ? points[k] : null, pen);
        }
        c.globalAlpha = 1;
    }

    read(count) {
        const { curve } = this.kernel;
        return Array.from({ length: count }, (_, k) => this.at([curve[0][k], curve[1][k], curve[2][k]]));
    }

    /** What leaves the surface, as a patch of the visible half. */
    region(state) {
        const { kernel, sheet: { context: c } } = this, { query } = kernel, rings = 18, sectors = 72;
        this.horizon = this.read(kernel.horizon(0, 0, 1));
        this.tilted = state.nt === null ? null : this.read(kernel.horizon(...direction(state.nt, state.np)));
        kernel.region(rings, sectors);
        const g = state.nt === null ? null : direction(state.nt, state.np);
        const corner = (j, k) => {
            const at = j * (sectors + 1) + k;
            return this.at([query[0][at], query[1][at], query[2][at]]);
        };
        c.fillStyle = colours.region;
        c.beginPath();
        for (let j = 0; j < rings; ++j)
            for (let k = 0; k < sectors; ++k) {
                if (g && dot(g, direction(90 * (j + 0.5) / rings, 360 * (k + 0.5) / sectors)) < 0) continue;
                const quad = [corner(j, k), corner(j, k + 1), corner(j + 1, k + 1), corner(j + 1, k)];
                if (quad.some((p) => p[2] < 0)) continue;
                c.moveTo(quad[0][0], quad[0][1]);
                for (let i = 1; i < 4; ++i) c.lineTo(quad[i][0], quad[i][1]);
            }
        c.fill();
    }

    dots(state) {
        const { kernel, sheet } = this, { query } = kernel, n = Math.min(state.n, 10000);
        const size = Math.max(1, Math.round((n > 4096 ? 1 : n > 512 ? 1.5 : 3) * sheet.scale));
        sheet.beginDots();
        for (let method = 0; method < 2; ++method) {
            if (state.show !== "both" && state.show !== "ab"[method]) continue;
            const colour = colours["ab"[method]], near = word(colour, n > 2000 ? 0.55 : 0.8), far = word(colour, 0.16);
            kernel.stretch_draws(method, n);
            const { right, up, toward } = this.camera, [cx, cy] = this.at([0, 0, 0]), r = this.radius;
            for (let k = 0; k < n; ++k) {
                const x = query[0][k], y = query[1][k], z = query[2][k];
                sheet.dot(cx + r * (right[0] * x + right[1] * y), cy - r * (up[0] * x + up[1] * y + up[2] * z),
                    toward[0] * x + toward[1] * y + toward[2] * z >= 0 ? near : far, size);
            }
        }
        sheet.endDots();
    }

    curves(state) {
        const { kernel, models } = this, entries = [{ title: "horizon of the surface", colour: colours["region-line"] }];
        if (hasCaps(state))
            for (const cap of CAPS) {
                const pen = capPen(state, cap);
                this.curve(this.read(kernel.cap_rim(models.methods.indexOf(cap))), pen);
                entries.push({ title: pen.own ? `${pen.title} (${pen.own.toUpperCase()})` : pen.title, colour: pen.colour, dashed: cap !== "bounded" });
            }
        this.curve(this.horizon, { colour: colours["region-line"], width: 2 });
        if (this.tilted) {
            this.curve(this.tilted, { colour: colours.ink, width: 1.6, dash: [2, 4] });
            entries.push({ title: "horizon of g", colour: colours.ink, dashed: true });
        }
        legend("stretched-legend", entries);
    }

    arrows() {
        const { kernel, sheet } = this, centre = this.at([0, 0, 0]);
        kernel.stretch_wi();
        const i = Array.from(kernel.result.subarray(0, 3));
        for (const [v, label] of [[[0, 0, 1], "z"], [i, "î"]]) {
            const tip = this.at(v), out = this.at(v.map((x) => 1.07 * x));
            sheet.line(2, (k) => k ? tip : centre, { colour: colours.ink, width: 1.4 });
            const c = sheet.context;
            c.beginPath();
            c.arc(tip[0], tip[1], 3.2, 0, 2 * Math.PI);
            c.fillStyle = tip[2] < 0 ? colours.soft : colours.ink;
            c.fill();
            sheet.font(0.9, "italic");
            sheet.text(out[0], out[1], label, { colour: colours.ink });
        }
    }
}
