// The unit square of random numbers, and where each method takes it.
import { $, colours } from "./page.js";
import { Sheet, word } from "./canvas.js";

const LINES = 10, STEPS = 96;

export class GridView {
    constructor(store, kernel) {
        Object.assign(this, { store, kernel, sheet: new Sheet($("grid")) });
    }

    draw() {
        const { sheet, store: { state } } = this, [w, h] = sheet.begin(), em = colours.size;
        // a smaller square, and two disks
        const side = Math.min((w - 3.4 * em) / 2.7, h - 3.2 * em), gap = (w - em - 2.7 * side) / 3;
        const top = 1.5 * em + (h - 3.2 * em - side) / 2, square = 0.7 * side;
        const left = (k) => em + (k === 0 ? 0.5 * gap : 1.3 * gap + square + (k - 1) * (side + gap));
        const panels = [];
        this.square(left(0), top + 0.15 * side, square);
        for (let method = 0; method < 2; ++method) {
            const disk = { x: left(method + 1) + side / 2, y: top + side / 2, r: side / 2 };
            this.disk(disk, method, state);
            panels.push(disk);
        }
        this.dots(left(0), top + 0.15 * side, square, panels, state);
    }

    square(x, y, side) {
        const { sheet } = this, c = sheet.context;
        c.strokeStyle = colours.line;
        c.lineWidth = 1;
        c.strokeRect(x, y, side, side);
        for (let k = 0; k < LINES; ++k) {
            const t = side * (k + 0.5) / LINES;
            sheet.line(2, (i) => [x + t, y + i * side], { colour: colours.ink, width: 0.7 });
            sheet.line(2, (i) => [x + i * side, y + t], { colour: colours.soft, width: 0.5 });
        }
        sheet.font(0.8);
        sheet.text(x + side / 2, y + side + 0.4 * colours.size, "u₁", { base: "top" });
        sheet.text(x - 0.3 * colours.size, y + side / 2, "u₂", { align: "right" });
        sheet.text(x + side / 2, y - 0.4 * colours.size, "random numbers", { base: "bottom", colour: colours.ink });
    }

    disk({ x, y, r }, method, state) {
        const { sheet, kernel } = this, c = sheet.context;
        c.beginPath();
        c.arc(x, y, r, 0, 2 * Math.PI);
        c.strokeStyle = colours.line;
        c.lineWidth = 1;
        c.stroke();
        sheet.font(0.8);
        sheet.text(x, y - r - 0.4 * colours.size, `${"AB"[method]}: ${state["ab"[method]]}`, { base: "bottom", colour: colours["ab"[method]] });
        sheet.text(x, y + r + 0.4 * colours.size, "o from above", { base: "top" });
        kernel.grid(method, LINES, STEPS);
        const { query, answer } = kernel;
        for (let line = 0; line < 2 * LINES; ++line) {
            const first = line * (STEPS + 1), strong = line < LINES;
            for (const kept of [false, true])
                sheet.line(STEPS + 1, (k) => (answer[0][first + k] > 0) === kept
                    ? [x + r * query[0][first + k], y - r * query[1][first + k]] : null,
                { colour: kept ? colours["ab"[method]] : colours.soft, width: strong ? 1 : 0.6, dash: kept ? [] : [1, 3] });
        }
    }

    dots(left, top, side, disks, state) {
        const { sheet, kernel } = this, n = Math.min(state.n, 2048);
        const size = Math.max(1, Math.round((n > 512 ? 1.2 : 2.2) * sheet.scale));
        sheet.beginDots();
        const ink = word(colours.ink, 0.55);
        for (let k = 0; k < n; ++k)
            sheet.dot(left + side * kernel.numbers[0][k], top + side * kernel.numbers[1][k], ink, size);
        disks.forEach(({ x, y, r }, method) => {
            const { wo, pdf } = kernel.draws[method];
            for (let k = 0; k < n; ++k)
                if (pdf[k] > 0) sheet.dot(x + r * wo[0][k], y - r * wo[1][k], ink, size);
        });
        sheet.endDots();
    }
}
