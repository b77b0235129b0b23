// Histograms of the angles of the draws, and the integrated density as a line.
import { $, colours, say } from "./page.js";
import { Sheet } from "./canvas.js";
import { Plot, ticks } from "./plot.js";

const BINS = 512, THETAS = 45, PHIS = 36;

export class HistogramView {
    constructor(store, kernel) {
        Object.assign(this, { store, kernel, sheet: new Sheet($("histogram")) });
        this.expected = [new Float32Array(BINS + THETAS + PHIS), new Float32Array(BINS + THETAS + PHIS)];
        this.fresh = false;
    }

    /** What the density says, from whoever integrated it, and whether of the surface that is shown. */
    take(expected, fresh) {
        this.fresh = fresh;
        expected.forEach((values, k) => {
            this.expected[k].set(values);
            this.kernel.expected[k].set(values);
        });
    }

    /** Something has changed: until there are new integrals, the old line stays, faint, and no test is made. */
    age() {
        this.fresh = false;
    }

    draw() {
        const { sheet, kernel, store: { state } } = this, [w, h] = sheet.begin(), em = colours.size;
        for (let method = 0; method < 2; ++method) {
            kernel.observe(method, state.n);
            this.chi(method, state);
        }
        const width = (w - 6.2 * em) / 2;
        this.panel([2.6 * em, 1.5 * em, width, h - 4.4 * em], BINS, THETAS,
            { low: 0, high: 90, ticks: [0, 30, 60, 90], title: "θ of o (degrees)" }, state);
        this.panel([w - width - 0.8 * em, 1.5 * em, width, h - 4.4 * em], BINS + THETAS, PHIS,
            { low: -180, high: 180, ticks: [-180, -90, 0, 90, 180], title: "φ of o (degrees)" }, state);
    }

    panel(box, first, count, axis, state) {
        const { kernel } = this, width = (axis.high - axis.low) / count, methods = [0, 1].filter((k) => state.show === "both" || state.show === "ab"[k]);
        let top = 1e-6;
        for (const k of methods) for (let i = first; i < first + count; ++i)
            top = Math.max(top, this.expected[k][i], kernel.observed[k][i]);
        top *= 1.08 / width;
        const format = (v) => String(v).replace("-", "−");
        const plot = new Plot(this.sheet, box, { ...axis, format }, {
            low: 0, high: top, ticks: ticks(0, top, 4), format: (v) => v === 0 ? "0" : Number((100 * v).toPrecision(3)).toString(),
            title: first === BINS ? "% of the draws per degree" : "", indent: 2.2 * colours.size,
        });
        plot.frame();
        const c = this.sheet.context;
        for (const k of methods) {
            c.fillStyle = colours[`${"ab"[k]}-wash`];
            c.strokeStyle = colours["ab"[k]];
            for (let i = 0; i < count; ++i) {
                const x0 = plot.x(axis.low + i * width), x1 = plot.x(axis.low + (i + 1) * width);
                const y = plot.y(kernel.observed[k][first + i] / width);
                c.fillRect(x0, y, x1 - x0, plot.y(0) - y);
            }
        }
        c.globalAlpha = this.fresh ? 1 : 0.3;
        for (const k of methods)
            this.sheet.line(count, (i) => [plot.x(axis.low + (i + 0.5) * width), plot.y(this.expected[k][first + i] / width)],
                { colour: colours["ab"[k]], width: 1.8, dash: k ? [5, 3] : [] });
        c.globalAlpha = 1;
    }

    chi(method, state) {
        const { kernel } = this, id = `chi-${"ab"[method]}`;
        if (!this.fresh) return;
        kernel.chi_square(method, state.n);
        const [chi2, freedom, p] = kernel.result;
        if (!(freedom > 0)) return say(id, "too few draws for χ²");
        const numbers = `χ² = ${chi2.toFixed(1)} with ${freedom} degrees of freedom`;
        if (state.u !== "random") return say(id, `${numbers}; ${state.u} numbers spread more evenly than chance`);
        say(id, `${numbers}, p = ${p < 1e-4 ? p.toExponential(1) : p.toFixed(4)}`);
    }
}
