// Rejected share, furnace and variance of both methods, with their errors, beside the exact values.
import { $, colours, say } from "./page.js";
import { Sheet } from "./canvas.js";
import { Plot, ticks } from "./plot.js";

const fixed = (x, digits = 4) => Number.isFinite(x) ? x.toFixed(digits) : "—";

function cell(id, value, error) {
    const text = fixed(value), small = error === undefined ? "" : `± ${fixed(error)}`, td = $(id);
    if (td.dataset.text === text + small) return;
    td.dataset.text = text + small;
    const note = document.createElement("small");
    note.textContent = small;
    td.replaceChildren(text, ...(small ? [note] : []));
}

export class NumbersView {
    constructor(store, kernel) {
        Object.assign(this, { store, kernel, sheet: new Sheet($("numbers")), exact: NaN });
    }

    /** The exact value, from whoever integrated it, if it is of the surface that is shown. */
    take(exact, fresh) {
        if (fresh) this.exact = exact;
    }

    /** Something has changed: an exact value of another surface is not shown. */
    age() {
        this.exact = NaN;
    }

    draw() {
        const { kernel, store: { state } } = this, found = [];
        for (let method = 0; method < 2; ++method) {
            const k = "ab"[method];
            kernel.furnace(method, state.n);
            const [mean, meanError, share, shareError, variance] = kernel.result;
            found.push({ mean, meanError, share, shareError });
            say(`name-${k}`, `${k.toUpperCase()} ${state[k]}`);
            cell(`rejected-${k}`, share, shareError);
            cell(`furnace-${k}`, mean, meanError);
            cell(`variance-${k}`, variance);
        }
        const shares = [0, 1].map((method) => kernel.acceptance(method)).map((x) => x < 0 ? NaN : 1 - x);
        say("rejected-exact", shares.map((x) => fixed(x)).join(" / "));
        say("furnace-exact", fixed(this.exact, 5));
        this.plot(found, shares);
    }

    plot(found, shares) {
        const { sheet } = this, [w, h] = sheet.begin(), em = colours.size, height = h / 2 - 2.7 * em;
        const top = Math.max(...found.map((f) => f.share + 2 * f.shareError), 0.02);
        this.strip([1.4 * em, 1.3 * em, w - 2.8 * em, height], 0, Math.min(top * 1.1, 1.02), "rejected share",
            found.map((f) => [f.share, f.shareError]), shares);
        const low = Math.min(...found.map((f) => f.mean - 4 * f.meanError), this.exact || Infinity);
        const high = Math.max(...found.map((f) => f.mean + 4 * f.meanError), this.exact || -Infinity);
        const margin = Math.max(0.15 * (high - low), 1e-3);
        this.strip([1.4 * em, h / 2 + 1.3 * em, w - 2.8 * em, height], Math.max(low - margin, 0), high + margin, "white furnace",
            found.map((f) => [f.mean, f.meanError]), [this.exact, NaN]);
    }

    strip(box, low, high, title, points, exact) {
        const { sheet } = this, c = sheet.context, digits = Math.max(1, Math.ceil(-Math.log10((high - low) / 4)));
        const plot = new Plot(sheet, box, { low, high, ticks: ticks(low, high, 4), format: (v) => v.toFixed(digits) },
            { low: 0, high: 1, ticks: [], title });
        plot.frame();
        const bar = (x, y, half) => sheet.line(2, (k) => [x, y + (2 * k - 1) * half], { colour: colours.ink, width: 1.3, dash: [3, 3] });
        const [, top, , height] = box;
        points.forEach(([value, error], k) => {
            const y = top + height * (k ? 0.7 : 0.3), colour = colours["ab"[k]];
            if (Number.isFinite(exact[k])) bar(plot.x(exact[k]), Number.isFinite(exact[1]) ? y : top + height / 2, Number.isFinite(exact[1]) ? 0.25 * height : 0.5 * height);
            sheet.line(2, (i) => [plot.x(Math.min(Math.max(value + (2 * i - 1) * error, low), high)), y], { colour, width: 2 });
            c.beginPath();
            c.arc(plot.x(value), y, 0.24 * colours.size, 0, 2 * Math.PI);
            c.fillStyle = colour;
            c.fill();
        });
    }
}
