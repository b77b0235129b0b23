// The sphere in a studio: method A left of the split, B right of it.
import { $, colours, say } from "./page.js";

export class PictureView {
    constructor(store, side) {
        this.store = store;
        this.side = side;
        this.canvas = $("picture");
        this.canvas.width = this.canvas.height = side;
        this.context = this.canvas.getContext("2d");
        this.halves = [0, 1].map(() => {
            const canvas = document.createElement("canvas");
            canvas.width = canvas.height = side;
            return { canvas, context: canvas.getContext("2d"), image: new ImageData(side, side) };
        });
        this.drag();
        $("split").addEventListener("input", (event) => store.set({ split: Number(event.target.value) }));
    }

    drag() {
        let held = false;
        const move = (event) => {
            const box = this.canvas.getBoundingClientRect();
            const split = 100 * (event.clientX - box.left) / box.width;
            this.store.set({ split: Math.round(Math.min(100, Math.max(0, split))) });
        };
        this.canvas.addEventListener("pointerdown", (event) => {
            held = true;
            this.canvas.setPointerCapture(event.pointerId);
            move(event);
        });
        this.canvas.addEventListener("pointermove", (event) => { if (held) move(event); });
        for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => { held = false; });
    }

    /** Rows [first, first + count) of both pictures. */
    take(first, count, rows) {
        this.halves.forEach(({ context, image }, k) => {
            image.data.set(rows[k], 4 * this.side * first);
            context.putImageData(image, 0, 0, 0, first, this.side, count);
        });
        this.draw();
    }

    /** Mean variance of the pixels of A and B; null: not known yet. */
    noise(values, spp) {
        if (!values) return;
        const [a, b] = values.map(Math.sqrt);
        if (!(a > 0) || !(b > 0)) return say("noise", spp < 2 ? "One sample a pixel: noise is told from 4 on." : "");
        const ratio = (a / b) ** 2;
        say("noise", `Noise (RMSE): A ${a.toFixed(4)}, B ${b.toFixed(4)}. ` + (Math.abs(ratio - 1) < 0.02 ? "As good as equal."
            : `${ratio > 1 ? "A" : "B"} needs ${Math.max(ratio, 1 / ratio).toFixed(2)} times the samples of ${ratio > 1 ? "B" : "A"} for the same.`));
    }

    draw() {
        const { context: c, side, store: { state } } = this, x = side * state.split / 100;
        c.clearRect(0, 0, side, side);
        const part = (k, from, to) => {
            if (to - from >= 1) c.drawImage(this.halves[k].canvas, from, 0, to - from, side, from, 0, to - from, side);
        };
        part(0, 0, Math.round(x));
        part(1, Math.round(x), side);
        c.fillStyle = colours.ink;
        c.fillRect(Math.min(Math.max(Math.round(x) - 0.5, 0), side - 1), 0, 1, side);
        if (document.activeElement !== $("split") || Number($("split").value) !== state.split) $("split").value = state.split;
        $("split").setAttribute("aria-valuetext", `${Math.round(state.split)} percent of the picture is method A`);
    }
}
