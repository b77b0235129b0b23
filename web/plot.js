// Axes with ticks and titles on a sheet.
import { colours } from "./page.js";

export class Plot {
    /** box: [left, top, width, height]; x and y: { low, high, ticks, title, format }. */
    constructor(sheet, box, x, y) {
        Object.assign(this, { sheet, box, xAxis: x, yAxis: y });
    }

    x(value) {
        return this.box[0] + this.box[2] * (value - this.xAxis.low) / (this.xAxis.high - this.xAxis.low);
    }

    y(value) {
        return this.box[1] + this.box[3] * (1 - (value - this.yAxis.low) / (this.yAxis.high - this.yAxis.low));
    }

    frame() {
        const { sheet, box: [l, t, w, h] } = this, c = sheet.context, em = colours.size;
        const text = (axis, value) => (axis.format ?? String)(value);
        c.strokeStyle = colours.faint;
        c.lineWidth = 1;
        c.beginPath();
        for (const value of this.xAxis.ticks) {
            c.moveTo(this.x(value), t);
            c.lineTo(this.x(value), t + h);
        }
        for (const value of this.yAxis.ticks) {
            c.moveTo(l, this.y(value));
            c.lineTo(l + w, this.y(value));
        }
        c.stroke();
        sheet.font(0.74);
        for (const value of this.xAxis.ticks)
            sheet.text(this.x(value), t + h + 0.35 * em, text(this.xAxis, value), { base: "top" });
        for (const value of this.yAxis.ticks)
            sheet.text(l - 0.35 * em, this.y(value), text(this.yAxis, value), { align: "right" });
        sheet.font(0.78);
        if (this.xAxis.title)
            sheet.text(l + w / 2, t + h + 1.35 * em, this.xAxis.title, { base: "top", colour: colours.ink });
        if (this.yAxis.title)
            sheet.text(l - (this.yAxis.indent ?? 0), t - 0.5 * em, this.yAxis.title,
                { align: "left", base: "bottom", colour: colours.ink });
        c.strokeStyle = colours.line;
        c.strokeRect(l, t, w, h);
    }
}

/** About `count` round numbers from low to high. */
export function ticks(low, high, count) {
    const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((k) => k * power >= rough);
    const out = [];
    for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step)
        out.push(Math.abs(v) < step * 1e-6 ? 0 : v);
    return out;
}
