// A canvas of two dimensions that is as sharp as the screen; and dots by the ten thousand.
import { colours } from "./page.js";

export class Sheet {
    constructor(canvas) {
        this.canvas = canvas;
        this.context = canvas.getContext("2d");
        this.dots = document.createElement("canvas");
    }

    /** Clears, and returns width and height in CSS pixels. */
    begin() {
        const scale = Math.min(devicePixelRatio || 1, 2), { clientWidth: w, clientHeight: h } = this.canvas;
        const pw = Math.max(1, Math.round(w * scale)), ph = Math.max(1, Math.round(h * scale));
        if (this.canvas.width !== pw || this.canvas.height !== ph) {
            this.canvas.width = this.dots.width = pw;
            this.canvas.height = this.dots.height = ph;
            this.image = null;
        }
        this.scale = scale;
        const c = this.context;
        c.setTransform(scale, 0, 0, scale, 0, 0);
        c.clearRect(0, 0, w, h);
        c.lineJoin = c.lineCap = "round";
        this.font();
        return [w, h];
    }

    font(size = 0.78, style = "") {
        this.context.font = `${style} ${size * colours.size}px system-ui, "Segoe UI", Arial, sans-serif`;
    }

    text(x, y, text, { align = "center", base = "middle", colour = colours.soft } = {}) {
        const c = this.context;
        c.textAlign = align;
        c.textBaseline = base;
        c.fillStyle = colour;
        c.fillText(text, x, y);
    }

    /** A line through (x[k], y[k]); NaN interrupts it. */
    line(count, at, { colour, width = 1.5, dash = [] }) {
        const c = this.context;
        c.beginPath();
        let pen = false;
        for (let k = 0; k < count; ++k) {
            const p = at(k);
            if (p === null || Number.isNaN(p[1])) { pen = false; continue; }
            if (pen) c.lineTo(p[0], p[1]);
            else c.moveTo(p[0], p[1]);
            pen = true;
        }
        c.strokeStyle = colour;
        c.lineWidth = width;
        c.setLineDash(dash);
        c.stroke();
        c.setLineDash([]);
    }

    /** Starts an image for dots, as large as the canvas; the image and its words are kept. */
    beginDots() {
        const c = this.dots.getContext("2d");
        if (!this.image) {
            this.image = c.createImageData(this.dots.width, this.dots.height);
            this.words = new Uint32Array(this.image.data.buffer);
        }
        this.words.fill(0);
    }

    /** A square of `size` device pixels. */
    dot(x, y, word, size) {
        const w = this.dots.width, h = this.dots.height;
        const px = Math.round(x * this.scale - size / 2), py = Math.round(y * this.scale - size / 2);
        if (px < 0 || py < 0 || px + size > w || py + size > h) return;
        for (let j = py; j < py + size; ++j)
            for (let i = px; i < px + size; ++i) this.words[j * w + i] = word;
    }

    endDots() {
        this.dots.getContext("2d").putImageData(this.image, 0, 0);
        const c = this.context;
        c.save();
        c.setTransform(1, 0, 0, 1, 0, 0);
        c.drawImage(this.dots, 0, 0);
        c.restore();
    }
}

/** "#rrggbb" and an opacity as a word of an image. */
export function word(hex, alpha) {
    const v = parseInt(hex.slice(1, 7), 16);
    return ((alpha * 255) << 24 | (v & 255) << 16 | (v >> 8 & 255) << 8 | v >> 16) >>> 0;
}
